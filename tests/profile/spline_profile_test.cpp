#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>
#include <wheelrail/contact/find_contact.hpp>
#include <wheelrail/profile/convex_modification.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/profile/spline_profile.hpp>
#include <wheelrail/track/tangent_track.hpp>
#include <wheelrail/wheelset/touching_position.hpp>
#include <wheelrail/wheelset/wheelset.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::StrictScalar;
using Spline = SplineProfile<double>;
using Analytic = PiecewiseProfile<double>;
using Head = RailHead<double>;

namespace {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double lower, double upper) {
    return lower + (upper - lower) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  // Of variance 1: 12 uniform numbers.
  double normal() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += between(0, 1);
    return sum;
  }

 private:
  std::mt19937 engine_;
};

struct Points {
  std::vector<double> laterals, values;
};

// Points of a profile at about a spacing along its arc, each off by noise across and along it.
template <class P>
Points points_of(const P& profile, double lower, double upper, double spacing, double noise = 0,
                 unsigned seed = 1) {
  Random random(seed);
  Points points;
  for (double u = lower; u <= upper;) {
    const auto at = profile.evaluate(u);
    const double cosine = 1 / std::sqrt(1 + at.slope * at.slope), sine = at.slope * cosine;
    const double across = noise * random.normal(), along = noise * random.normal();
    points.laterals.push_back(u - across * sine + along * cosine);
    points.values.push_back(at.value + across * cosine + along * sine);
    u += spacing * cosine;
  }
  return points;
}

// The wheel from the flange's top to the tread's end; a rail to where its corner's slope is 8.
Points wheel_points(double spacing, double noise = 0, unsigned seed = 1) {
  return points_of(s1002<double>(), -0.062, 0.0595, spacing, noise, seed);
}
double rail_end(const Head& head) {
  return head.dimensions().width / 2 - 9e-5;
}
Points rail_points(const Head& head, double spacing, double noise = 0, unsigned seed = 2) {
  return points_of(head, -rail_end(head), rail_end(head), spacing, noise, seed);
}

Spline fitted(const Points& points, double noise = 0) {
  return Spline(points.laterals, points.values, {.noise = noise});
}

// The greatest distance across the profile between two of them, and the root mean square.
template <class P>
std::pair<double, double> distance(const Spline& spline, const P& profile) {
  constexpr int grid = 5000;
  double worst = 0, sum = 0;
  for (int i = 0; i <= grid; ++i) {
    const double u = spline.lower() + (spline.upper() - spline.lower()) * i / grid;
    if (u < profile.lower() || profile.upper() < u) continue;
    const auto at = profile.evaluate(u);
    const double across =
        (spline.evaluate(u).value - at.value) / std::sqrt(1 + at.slope * at.slope);
    worst = std::max(worst, std::abs(across));
    sum += across * across;
  }
  return {worst, std::sqrt(sum / grid)};
}

std::vector<WheelPlacement<double>> poses_over(const Head& head, int count) {
  const Wheelset<Analytic> wheelset{s1002<double>(), 0.43, 1.5};
  const TangentTrack<Head> track{head};
  Random random(5);
  std::vector<WheelPlacement<double>> poses;
  for (int i = 0; i < 10 * count && static_cast<int>(poses.size()) < count; ++i) {
    const double shift = random.between(-0.006, 0.0065), yaw = random.between(-0.01, 0.01);
    const auto down =
        touching_position(wheelset, track, shift, yaw, {.gap = -random.between(2e-5, 8e-5)});
    if (down.status != SolveStatus::converged) continue;
    poses.push_back(place_wheel(wheelset, track, Side::left, down.position));
  }
  REQUIRE(static_cast<int>(poses.size()) == count);
  return poses;
}

double deepest(const ContactResult<double>& result) {
  double most = 0;
  for (const auto& patch : result.patches) most = std::max(most, patch.penetration);
  return most;
}

// Whether each patch of `one` deeper than `doubt` lies in a zone of `other` that is as deep but for
// `doubt`: two pairs of profiles that are no farther apart than that must agree so.
bool agree(const ContactResult<double>& one, const ContactResult<double>& other, double doubt) {
  return std::all_of(one.patches.begin(), one.patches.end(), [&](const auto& patch) {
    return patch.penetration <= doubt ||
           std::any_of(other.patches.begin(), other.patches.end(), [&](const auto& zone) {
             return zone.zone_lower <= patch.wheel_lateral &&
                    patch.wheel_lateral <= zone.zone_upper &&
                    patch.penetration - doubt <= zone.penetration;
           });
  });
}

template <class Function>
std::string message_of(Function&& function) {
  try {
    function();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace

static_assert(HasDerivativeBounds<Spline> && HasClosestPoint<Spline>);

TEST_CASE("SplineProfile: a straight line and a parabola are met", "[profile]") {
  Points line, parabola;
  for (int i = 0; i <= 40; ++i) {
    const double u = -0.02 + 0.001 * i + 0.0002 * std::sin(i);
    line.laterals.push_back(u);
    line.values.push_back(0.003 - 2.7 * u);
    parabola.laterals.push_back(u);
    parabola.values.push_back(-2 * u * u);
  }
  for (const double noise : {0.0, 1e-6, 1e-5}) {
    const Spline spline = fitted(line, noise);
    CHECK(spline.lower() == Approx(-0.02).margin(1e-14).epsilon(0));
    for (double u = spline.lower(); u < spline.upper(); u += 1e-4) {
      const auto at = spline.evaluate(u);
      CHECK(at.value == Approx(0.003 - 2.7 * u).margin(1e-14).epsilon(0));
      CHECK(at.slope == Approx(-2.7).epsilon(1e-12));
      CHECK(at.second_derivative == Approx(0).margin(1e-7));
    }
  }
  // Over its arc length a parabola is no cubic, but spacing^4 / 384 times its fourth derivative, 64 /m3,
  // is 1e-12 m; the polynomials are within 1e-10 m of that, the least tolerance that there is.
  const Spline spline = fitted(parabola);
  for (double u = spline.lower(); u < spline.upper(); u += 1e-4) {
    const auto at = spline.evaluate(u);
    CHECK(at.value == Approx(-2 * u * u).margin(1.02e-10).epsilon(0));
    CHECK(at.slope == Approx(-4 * u).margin(1e-7));
    CHECK(at.second_derivative == Approx(-4).margin(1e-3));
  }
}

TEST_CASE("SplineProfile: the value is C2 and the pieces are its own", "[profile]") {
  for (const double noise : {0.0, 1e-5}) {
    const Spline spline = fitted(wheel_points(2e-4, noise), noise);
    CHECK(spline.piece_count() == (spline.report().polynomial_count + 1) / 2);
    CHECK(spline.report().polynomial_count < 160);
    for (const auto& joint : inspect_joints(spline)) {
      CAPTURE(noise, joint.lateral);
      CHECK(std::abs(joint.value_jump) < 1e-16);
      CHECK(std::abs(joint.slope_jump) < 1e-12);
      CHECK(std::abs(joint.curvature_jump) < 1e-7);
    }
    // And inside the pieces: the second derivative changes with its bounded rate at most.
    for (int piece = 0; piece < spline.piece_count(); ++piece) {
      const double lower = spline.joint(piece), upper = spline.joint(piece + 1);
      const double third = spline.derivative_bounds(piece, lower, upper).greatest_third;
      double last = spline.evaluate(piece, lower).second_derivative;
      for (int i = 1; i <= 2000; ++i) {
        const double second =
            spline.evaluate(piece, lower + (upper - lower) * i / 2000).second_derivative;
        REQUIRE(std::abs(second - last) <= 1.0001 * third * (upper - lower) / 2000 + 1e-6);
        last = second;
      }
    }
  }
}

TEST_CASE("SplineProfile: slope and second derivative are those of the value", "[profile]") {
  const Spline spline = fitted(wheel_points(5e-4, 1e-5), 1e-5);
  for (double u = spline.lower() + 1e-5; u < spline.upper() - 1e-5; u += 7.3e-5) {
    const double h = 1e-7;
    const auto at = spline.evaluate(u), left = spline.evaluate(u - h),
               right = spline.evaluate(u + h);
    CAPTURE(u);
    CHECK(at.slope == Approx((right.value - left.value) / (2 * h)).margin(2e-6));
    CHECK(at.second_derivative == Approx((right.slope - left.slope) / (2 * h)).margin(0.5));
  }
}

TEST_CASE("SplineProfile: derivative and curvature bounds hold and become tight",
          "[profile][random]") {
  Random random(3);
  for (const double noise : {0.0, 1e-5}) {
    const Spline spline = fitted(wheel_points(1e-3, noise), noise);
    for (int piece = 0; piece < spline.piece_count(); ++piece) {
      for (int i = 0; i < 40; ++i) {
        const double left = spline.joint(piece), width = spline.joint(piece + 1) - left;
        const double one = random.between(0, 1), other = random.between(0, 1);
        const double lower = left + width * std::min(one, other);
        const double upper = left + width * std::max(one, other);
        const auto bounds = spline.derivative_bounds(piece, lower, upper);
        const auto curved = spline.curvature_bounds(piece, lower, upper);
        double before = spline.evaluate(piece, lower).second_derivative;
        for (int k = 0; k <= 50; ++k) {
          const double u = lower + (upper - lower) * k / 50;
          const auto at = spline.evaluate(piece, u);
          const double second = at.second_derivative, own = curvature(at);
          const double rounding = 1e-9 * (1 + std::abs(second));
          REQUIRE(bounds.least_second <= second + rounding);
          REQUIRE(second - rounding <= bounds.greatest_second);
          REQUIRE(curved.least <= own + rounding);
          REQUIRE(own - rounding <= curved.greatest);
          if (k > 0) {
            const double step = (upper - lower) / 50;
            REQUIRE(std::abs(second - before) <=
                    bounds.greatest_third * step * (1 + 1e-9) + rounding);
          }
          before = second;
        }
        const auto narrow = spline.derivative_bounds(piece, lower, lower);
        CHECK(narrow.least_second == narrow.greatest_second);
      }
    }
  }
}

TEST_CASE("SplineProfile: the report says what came of the points", "[profile]") {
  Points points = wheel_points(2e-4, 1e-5);
  points.values[300] += 80e-6;
  const Spline spline = fitted(points, 1e-5);
  const auto& report = spline.report();
  CHECK(report.status == SmoothingStatus::at_noise);
  CHECK(report.noise == 1e-5);
  const double doubled = 2 * static_cast<double>(points.laterals.size());
  CHECK(report.rms_deviation == Approx(1e-5 * (1 + 2 / std::sqrt(doubled))).epsilon(0.005));
  CHECK(report.greatest_deviation_index == 300);
  CHECK(report.greatest_deviation > 60e-6);
  CHECK(report.greatest_deviation < 100e-6);
  CHECK(report.curve_deviation < 1e-8);
  CHECK(report.least_radius * std::abs(report.greatest_curvature) == Approx(1));
  // The flange's arcs of 12 mm, the fillet's of 13 mm; what noise makes of them is within a fifth.
  CHECK(report.least_radius == Approx(0.012).epsilon(0.2));
  CHECK(curvature(spline.evaluate(report.greatest_curvature_lateral)) ==
        Approx(report.greatest_curvature).epsilon(1e-9));
  CHECK(report.steepest_slope == Approx(2.75).margin(0.2));
  // Across the profile, recomputed from the profile itself: but for the curve's own deviation.
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < points.laterals.size(); ++i) {
    const double u = points.laterals[i];
    if (u < spline.lower() || spline.upper() < u) continue;
    const auto at = spline.evaluate(u);
    const double across = (points.values[i] - at.value) / std::sqrt(1 + at.slope * at.slope);
    sum += across * across;
    ++count;
  }
  CHECK(std::sqrt(sum / count) == Approx(report.rms_deviation).epsilon(0.01));

  const auto through = fitted(points).report();
  CHECK(through.status == SmoothingStatus::interpolating);
  CHECK(through.smoothing_parameter == 0);
  CHECK(through.greatest_deviation < 1e-16);
  CHECK(through.curve_deviation < 1.001e-10);
}

TEST_CASE("SplineProfile: points of the standard profiles give these back",
          "[profile][reference]") {
  // Without noise: where its second derivative jumps by J, a cubic spline is off by 0.0304 J spacing^2 at
  // most (that of (x - t)^2 / 2 for x > t, over all t). The greatest jumps are 77 /m, at the fillet and
  // at the corners of the heads.
  for (const double spacing : {1e-4, 2e-4, 5e-4, 1e-3}) {
    CAPTURE(spacing);
    const double bound = 0.0304 * 77 * spacing * spacing + 2e-10;
    CHECK(distance(fitted(wheel_points(spacing)), s1002<double>()).first < bound);
    for (const Head& head : {uic50<double>(), rail_60e1<double>()}) {
      CHECK(distance(fitted(rail_points(head, spacing)), head).first < bound);
    }
    // With 10 um of noise: less than the noise in the mean; nowhere off by more than four times
    // that: it bends the ends and where the curvature jumps. Of 60 seeds the worst is 26 um off at
    // 0.1 mm, 43 um at 1 mm.
    for (const unsigned seed : {1U, 2U, 3U}) {
      const auto [wheel, wheel_rms] =
          distance(fitted(wheel_points(spacing, 1e-5, seed), 1e-5), s1002<double>());
      CHECK(wheel_rms < 1e-5);
      CHECK(wheel < 4e-5);
      for (const Head& head : {uic50<double>(), rail_60e1<double>()}) {
        const auto [rail, rail_rms] =
            distance(fitted(rail_points(head, spacing, 1e-5, seed), 1e-5), head);
        CHECK(rail_rms < 1e-5);
        CHECK(rail < 4e-5);
      }
    }
  }
}

TEST_CASE("SplineProfile: rails with noise stay convex, because of the margin",
          "[profile][random]") {
  int without = 0;
  for (const Head& head : {uic50<double>(), rail_60e1<double>()}) {
    for (const double spacing : {1e-4, 2e-4, 5e-4, 1e-3}) {
      for (unsigned seed = 101; seed <= 115; ++seed) {
        CAPTURE(head.dimensions().width, spacing, seed);
        const Points points = rail_points(head, spacing, 1e-5, seed);
        CHECK(Rail<Spline>(fitted(points, 1e-5)).is_proved_convex());
        // The noise of a sample may be above its level; what is missing is made up by waves.
        const Spline at_level(points.laterals, points.values, {.noise = 1e-5, .margin = 0});
        CHECK(at_level.report().rms_deviation == Approx(1e-5).epsilon(2e-3));
        if (Rail<Spline>(at_level).is_proved_convex()) ++without;
      }
    }
  }
  // Of 120.
  CHECK(without >= 100);
  CHECK(without < 120);
}

TEST_CASE("SplineProfile: the nearest point is that of Newton's method", "[profile][random]") {
  const Head head = uic50<double>();
  const Spline spline = fitted(rail_points(head, 5e-4, 1e-5), 1e-5);
  const Rail<Spline> rail(spline);
  REQUIRE(rail.is_proved_convex());
  Random random(8);
  int beyond = 0;
  for (int i = 0; i < 2000; ++i) {
    // Outside the head or less than 4 mm inside it.
    const double lateral = random.between(-0.05, 0.05);
    const bool is_over = spline.lower() < lateral && lateral < spline.upper();
    const double up = is_over ? spline.evaluate(lateral).value + random.between(-0.004, 0.02)
                              : random.between(-0.04, 0.02);
    const auto own = spline.closest_point(lateral, up);
    const auto other = rail_foot_newton(spline, lateral, up);
    CAPTURE(lateral, up);
    CHECK(own.lateral == Approx(other.lateral).margin(1e-14).epsilon(0));
    CHECK(own.penetration == Approx(other.penetration).margin(1e-15).epsilon(0));
    CHECK(own.normal_rail.x() == Approx(other.normal_rail.x()).margin(1e-11).epsilon(0));
    CHECK(own.curvature == Approx(other.curvature).margin(1e-6).epsilon(0));
    if (own.lateral < spline.lower() || spline.upper() < own.lateral) ++beyond;
  }
  CHECK(beyond > 100);
  CHECK(beyond < 1500);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(spline.closest_point(nan, 0.0).penetration));
}

TEST_CASE("SplineProfile: sampled S1002 on sampled rails touches as the analytic pair",
          "[profile][reference]") {
  const Wheel<Analytic> wheel(s1002<double>(), 0.43);
  for (const Head& head : {uic50<double>(), rail_60e1<double>()}) {
    const auto poses = poses_over(head, 150);
    const Rail<Head> rail(head);
    for (const double noise : {0.0, 1e-5}) {
      for (const double spacing : {1e-4, 2e-4, 5e-4, 1e-3}) {
        CAPTURE(head.dimensions().width, noise, spacing);
        const Spline wheel_profile = fitted(wheel_points(spacing, noise, 11), noise);
        const Spline rail_profile = fitted(rail_points(head, spacing, noise, 12), noise);
        const Wheel<Spline> spline_wheel(wheel_profile, 0.43);
        const Rail<Spline> spline_rail(rail_profile);
        // Needed for a proof.
        REQUIRE(spline_rail.is_proved_convex());
        // The depth of a point changes by no more than both profiles do.
        const double doubt = distance(wheel_profile, s1002<double>()).first +
                             distance(rail_profile, head).first + 1e-9;
        int other_counts = 0, evaluations = 0, analytic_evaluations = 0;
        std::vector<double> moved;
        for (const auto& pose : poses) {
          const auto expected = find_contact(wheel, rail, pose);
          const auto found = find_contact(spline_wheel, spline_rail, pose);
          CHECK(found.is_proved);
          CHECK(found.status == SearchStatus::complete);
          CHECK(std::abs(deepest(found) - deepest(expected)) <= doubt);
          CHECK(agree(expected, found, doubt));
          CHECK(agree(found, expected, doubt));
          evaluations += found.evaluations;
          analytic_evaluations += expected.evaluations;
          if (found.patches.size() != expected.patches.size()) {
            ++other_counts;
            continue;
          }
          for (std::size_t k = 0; k < found.patches.size(); ++k) {
            moved.push_back(
                std::abs(found.patches[k].wheel_lateral - expected.patches[k].wheel_lateral));
          }
        }
        std::sort(moved.begin(), moved.end());
        REQUIRE(moved.size() >= 150);
        // Without noise no patch is born or gone. Beside a jump J of the curvature the slope is off by
        // 0.144 J spacing, 11 /m times spacing, at most: over a difference of the curvatures of as much
        // a patch moves by a spacing; half of them lie away from jumps and do not move. With
        // noise a zone shallower than the doubt may be there on one pair only, and a slope that is
        // off by 1e-3 moves a patch by a millimetre where the curvatures differ by 1 /m.
        CHECK(other_counts <= (noise == 0 ? 0 : 9));
        if (noise == 0) CHECK(moved.back() < spacing);
        CHECK(moved[moved.size() / 2] < (noise == 0 ? 0.05 * spacing : 1e-3));
        CHECK(evaluations < 2 * analytic_evaluations);
      }
    }
  }
}

TEST_CASE("SplineProfile: its convex modification touches as that of the analytic profile",
          "[profile][reference]") {
  using Modified = ConvexModification<Spline>;
  const ConvexModification expected_profile(s1002<double>());
  const Wheel<ConvexModification<Analytic>> wheel(expected_profile, 0.43);
  const Head head = rail_60e1<double>();
  const auto poses = poses_over(head, 100);
  const Rail<Head> rail(head);
  for (const double noise : {0.0, 1e-5}) {
    for (const double spacing : {1e-4, 2e-4, 5e-4, 1e-3}) {
      CAPTURE(noise, spacing);
      const Modified profile(fitted(wheel_points(spacing, noise, 11), noise));
      const Spline rail_profile = fitted(rail_points(head, spacing, noise, 12), noise);
      const Wheel<Modified> spline_wheel(profile, 0.43);
      const Rail<Spline> spline_rail(rail_profile);
      // One corner is that of the fillet; noise and waves beside jumps make small ones.
      REQUIRE(!profile.corners().empty());
      double worst = 0;
      for (int i = 0; i <= 5000; ++i) {
        const double u = profile.lower() + (profile.upper() - profile.lower()) * i / 5000;
        const auto at = expected_profile.evaluate(u);
        const double off = profile.evaluate(u).value - at.value;
        worst = std::max(worst, std::abs(off) / std::sqrt(1 + at.slope * at.slope));
      }
      // The fillet's corner is where two tangents meet, 14 mm along the flange's face and 48 mm
      // along the tread from where they touch. Where the face ends and the fillet begins the
      // curvature jumps by 77 /m: what smooths 10 um of noise away turns the face by some 8 mrad
      // there.
      CHECK(worst < (noise == 0 ? 1e-4 : 2.5e-4));
      const double doubt = worst + distance(rail_profile, head).first + 1e-9;
      for (const auto& pose : poses) {
        const auto expected = find_contact(wheel, rail, pose);
        const auto found = find_contact(spline_wheel, spline_rail, pose);
        CHECK(found.is_proved);
        CHECK(found.status == SearchStatus::complete);
        CHECK(std::abs(deepest(found) - deepest(expected)) <= doubt);
        CHECK(agree(expected, found, doubt));
        CHECK(agree(found, expected, doubt));
      }
    }
  }
}

TEST_CASE("SplineProfile: searches do not allocate", "[profile][no-alloc]") {
  const Head head = uic50<double>();
  const auto poses = poses_over(head, 10);
  const Wheel<Spline> wheel(fitted(wheel_points(2e-4, 1e-5), 1e-5), 0.43);
  const Rail<Spline> rail(fitted(rail_points(head, 2e-4, 1e-5), 1e-5));
  std::size_t patches = 0;
  CHECK(wheelrail_test::allocations_of([&] {
          for (const auto& pose : poses) patches += find_contact(wheel, rail, pose).patches.size();
        }) == 0);
  CHECK(patches >= poses.size());
}

TEST_CASE("SplineProfile: float and long double agree with double, a strict scalar exactly",
          "[profile]") {
  const Points points = wheel_points(1e-3, 1e-5);
  const auto fit = [&](auto zero, double noise) {
    using T = decltype(zero);
    std::vector<T> laterals, values;
    for (std::size_t i = 0; i < points.laterals.size(); ++i) {
      laterals.push_back(T(points.laterals[i]));
      values.push_back(T(points.values[i]));
    }
    return SplineProfile<T>(laterals, values, {.noise = T(noise)});
  };
  for (const double noise : {0.0, 1e-5}) {
    const auto in_double = fit(0.0, noise);
    const auto in_float = fit(0.0F, noise);
    const auto in_long = fit(0.0L, noise);
    const auto strict = fit(StrictScalar(0.0), noise);
    CHECK(strict.piece_count() == in_double.piece_count());
    for (double u = -0.0618; u < 0.0594; u += 1.7e-4) {
      CAPTURE(noise, u);
      const auto expected = in_double.evaluate(u);
      const auto own = strict.evaluate(StrictScalar(u));
      CHECK(own.value.as_double() == expected.value);
      CHECK(own.second_derivative.as_double() == expected.second_derivative);
      // A float's coordinates are rounded to 4 nm, its curve tolerance is 0.5 um; the parameters are
      // found to a part in 10^4 of the deviation each.
      CHECK(static_cast<double>(in_float.evaluate(static_cast<float>(u)).value) ==
            Approx(expected.value).margin(2e-6).epsilon(0));
      CHECK(static_cast<double>(in_long.evaluate(static_cast<long double>(u)).value) ==
            Approx(expected.value).margin(1e-9).epsilon(0));
    }
  }
}

TEST_CASE("SplineProfile: bad points are named", "[profile][bad-input]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> laterals{0, 0.001, 0.002, 0.003, 0.004}, values{0, 0, 0, 0, 0};
  CHECK(message_of([] {
          Spline({0, 0.001, 0.002}, {0, 0, 0});
        }) ==
        "spline profile: there are 3 lateral coordinates and 3 values, but must be as many, at "
        "least 4");
  CHECK(message_of([&] {
          Spline(laterals, {0, 0, 0, 0});
        }) ==
        "spline profile: there are 5 lateral coordinates and 4 values, but must be as many, at "
        "least 4");
  CHECK(message_of([&] { Spline(laterals, values, {.noise = -1e-6}); }) ==
        "spline profile: noise is -1e-06, but must be finite and >= 0 [m]");
  CHECK(message_of([&] { Spline(laterals, values, {.margin = -1}); }) ==
        "spline profile: margin is -1, but must be finite and >= 0 [-]");
  CHECK(message_of([&] { Spline(laterals, values, {.curve_tolerance = nan}); }) ==
        "spline profile: curve tolerance is nan, but must be finite and >= 0 [m]");
  CHECK(message_of([&] {
          Spline({0, 0.001, nan, 0.003, 0.004}, values);
        }) == "spline profile: lateral of point 2 is nan, but must be finite");
  CHECK(message_of([&] {
          Spline(laterals, {0, 0, 0, 0, 1 / 0.0});
        }) == "spline profile: value of point 4 is inf, but must be finite");
  CHECK(
      message_of([&] {
        Spline({0, 0.001, 0.0008, 0.003, 0.004}, values, {.noise = 0});
      }) ==
      "spline profile: lateral of point 2 is 0.0008, but must be greater than the greatest before "
      "it, 0.001 m, less 6 times the noise");
  CHECK(message_of([&] {
          Spline({0.004, 0.003, 0.002, 0.001, 0}, values);
        }) ==
        "spline profile: lateral of point 1 is 0.003, but must be greater than the greatest before "
        "it, 0.004 m, less 6 times the noise");
  CHECK(message_of([&] {
          Spline({0, 0.001, 0.001, 0.003, 0.004}, values, {.noise = 0});
        }) ==
        "spline profile: lateral of point 2 is 0.001, but must be greater than the greatest before "
        "it, 0.001 m, less 6 times the noise");
  CHECK(message_of([&] {
          Spline({0, 0.001, 0.001, 0.003, 0.004}, values, {.noise = 1e-5});
        }) ==
        "spline profile: lateral of point 2 is 0.001, but must be different from that of the "
        "point before, or its value must");
  // A face that rises by 1 mm over 1 um is too steep; one that turns back within the noise too.
  CHECK(message_of([&] {
          Spline({0, 0.001, 0.002, 0.002001, 0.002002, 0.003}, {0, 0, 0, 0.001, 0.002, 0.003},
                 {.noise = 0});
        }).find("the slope of the curve is ") != std::string::npos);
  // What no polynomials follow: below rounding.
  CHECK(message_of([&] {
          Spline(laterals, {0, 1e-3, 0, 1e-3, 0}, {.noise = 0, .curve_tolerance = 1e-22});
        }).find("must be at most the curve tolerance, 1e-22 m") != std::string::npos);
  // What the noise explains may step back.
  Points points = points_of(rail_60e1<double>(), -0.02, 0.02, 2e-5, 1e-5);
  CHECK(!std::is_sorted(points.laterals.begin(), points.laterals.end()));
  CHECK_NOTHROW(Spline(points.laterals, points.values));
}
