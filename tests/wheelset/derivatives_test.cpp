// Derivatives through profile, surface, contact, force and wheelset: dual numbers against differences
// of long double runs, against other equations for the same contact, and against each other.

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>
#include <wheelrail/wheelrail.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

// What the results are differentiated by.
enum Parameter {
  lateral_shift,
  height,
  roll,
  yaw,
  velocity_x,
  velocity_y,
  velocity_z,
  angular_x,
  angular_y,
  angular_z,
  nominal_radius,
  profile_spacing,
  gauge,
  inclination,
  corner_radius,  // of the rail
  tilt,           // of the wheel's profile about the tread circle
  count
};
// How far the differences step, about: small against what each of them does to a contact.
constexpr std::array<long double, count> scales{1e-7L, 1e-7L, 1e-7L, 1e-6L, 1e-5L, 1e-5L,
                                                1e-5L, 1e-5L, 1e-5L, 1e-5L, 1e-7L, 1e-7L,
                                                1e-7L, 1e-7L, 1e-7L, 1e-7L};

using Number = Dual<double, count>;

template <class T>
using Values = std::array<T, count>;

Values<Number> variables(const Values<double>& x) {
  Values<Number> result;
  for (std::size_t k = 0; k < count; ++k) result[k] = Number(x[k], k);
  return result;
}

// The S1002, tilted; a user's own profile, which knows neither bounds nor casts.
template <class T>
struct TiltedS1002 {
  using Scalar = T;
  T tilt;
  PiecewiseProfile<T> upright = s1002<T>();

  T lower() const { return upright.lower(); }
  T upper() const { return upright.upper(); }
  int piece_count() const { return upright.piece_count(); }
  T joint(int i) const { return upright.joint(i); }
  ProfilePoint<T> evaluate(const T& u) const { return evaluate(piece_of(*this, u), u); }
  ProfilePoint<T> evaluate(int piece, const T& u) const {
    ProfilePoint<T> point = upright.evaluate(piece, u);
    point.value += tilt * u;
    point.slope += tilt;
    return point;
  }
};

template <class T>
WheelsetForces<T> forces(const Values<T>& x) {
  const Wheelset wheelset(TiltedS1002<T>{x[tilt]}, x[nominal_radius], x[profile_spacing]);
  RailHeadDimensions<T> head = uic50<T>().dimensions();
  head.corner_radius = x[corner_radius];
  const TangentTrack track(RailHead<T>(head), {.gauge = x[gauge], .inclination = x[inclination]});
  const ContactForceModel<T> steel;
  const auto at = WheelsetPosition<T>::of(x[lateral_shift], x[height], x[roll], x[yaw]);
  const WheelsetMotion<T> motion{{x[velocity_x], x[velocity_y], x[velocity_z]},
                                 {x[angular_x], x[angular_y], x[angular_z]}};
  return wheelset_forces(wheelset, track, at, motion, steel);
}

// All numbers that are compared: the wrench, and of each patch its places, its depth, its force.
template <class T>
std::vector<T> numbers(const WheelsetForces<T>& forces) {
  std::vector<T> all;
  for (int i = 0; i < 3; ++i) all.push_back(forces.force_track(i));
  for (int i = 0; i < 3; ++i) all.push_back(forces.moment_track(i));
  for (const auto& wheel : forces.wheels) {
    for (const auto& p : wheel.patches) {
      for (const T& x :
           {p.patch.wheel_lateral, p.patch.rail_lateral, p.patch.wheel_angle, p.patch.penetration,
            p.patch.zone_lower, p.patch.zone_upper, p.patch.contact_angle, p.patch.rolling_radius,
            p.patch.wheel_lateral_curvature, p.contact.normal, p.contact.creep.longitudinal,
            p.contact.creep.lateral, p.contact.ellipse.a, p.contact.ellipse.b}) {
        all.push_back(x);
      }
    }
  }
  return all;
}

// The pieces of wheel and rail that the patches lie on, which must not change under a difference.
template <class T>
std::vector<int> pieces(const WheelsetForces<T>& forces) {
  std::vector<int> all;
  for (const auto& wheel : forces.wheels) {
    for (const auto& p : wheel.patches) {
      all.push_back(p.patch.wheel_piece);
      all.push_back(piece_of(uic50<T>(), p.patch.rail_lateral));
      all.push_back(piece_of(s1002<T>(), p.patch.zone_lower));
      all.push_back(piece_of(s1002<T>(), p.patch.zone_upper));
    }
    all.push_back(-1);
  }
  return all;
}

// A wheelset that rests on both rails, or runs with its left wheel's flange on the rail.
Values<double> random_state(std::mt19937& generator) {
  const auto between = [&](double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(generator);
  };
  const double shift = between(-7e-3, 7e-3), turn = between(-0.02, 0.02);
  const Wheelset wheelset(s1002<double>(), 0.43, 1.5);
  const TangentTrack track(uic50<double>());
  const auto touching =
      touching_position(wheelset, track, shift, turn, {.gap = -between(3e-5, 2e-4)});
  REQUIRE(touching.status == SolveStatus::converged);
  return {shift,
          touching.height,
          touching.roll,
          turn,
          10,
          between(-0.02, 0.02),
          between(-0.01, 0.01),
          between(-0.01, 0.01),
          10 / 0.43 * between(0.995, 1.005),
          between(-0.02, 0.02),
          0.43,
          1.5,
          1.435,
          0.05,
          0.013,
          0.0};
}

// The derivatives of all numbers by parameter k: differences of second order extrapolated twice.
std::vector<long double> differences(const Values<double>& x, int k, const std::vector<int>& where,
                                     bool& is_smooth) {
  const auto i = static_cast<std::size_t>(k);
  const auto at = [&](long double step) {
    Values<long double> moved;
    for (std::size_t j = 0; j < count; ++j) moved[j] = static_cast<long double>(x[j]);
    moved[i] += step;
    const auto result = forces(moved);
    is_smooth = is_smooth && pieces(result) == where;
    return numbers(result);
  };
  std::array<std::vector<long double>, 3> slopes;
  for (std::size_t level = 0; level < 3 && is_smooth; ++level) {
    const long double step = scales[i] / static_cast<long double>(1 << level);
    const auto above = at(step), below = at(-step);
    if (!is_smooth) break;
    for (std::size_t n = 0; n < above.size(); ++n) {
      slopes[level].push_back((above[n] - below[n]) / (2 * step));
    }
  }
  std::vector<long double> result;
  for (std::size_t n = 0; is_smooth && n < slopes[0].size(); ++n) {
    const long double once = (4 * slopes[1][n] - slopes[0][n]) / 3;
    const long double twice = (4 * slopes[2][n] - slopes[1][n]) / 3;
    result.push_back((16 * twice - once) / 15);
  }
  return result;
}

}  // namespace

TEST_CASE("wheelset_forces: dual numbers have the derivatives of differences",
          "[wheelset][autodiff][random]") {
  constexpr int poses = 12;
  std::mt19937 generator(20261122);
  int compared = 0, with_flange = 0;
  std::array<bool, count> acts{};
  double worst = 0;
  for (int pose = 0; pose < poses; ++pose) {
    const Values<double> x = random_state(generator);
    const auto dual = forces(variables(x));
    const auto plain = forces(x);
    const auto duals = numbers(dual);
    const auto plains = numbers(plain);
    REQUIRE(duals.size() == plains.size());
    for (std::size_t n = 0; n < duals.size(); ++n) {
      CHECK(value_of(duals[n]) == Approx(plains[n]).epsilon(1e-9).margin(1e-12));
    }
    std::array<std::vector<long double>, count> expected;
    bool is_smooth = true;
    const auto where = pieces(plain);
    for (int k = 0; k < count && is_smooth; ++k) {
      expected[static_cast<std::size_t>(k)] = differences(x, k, where, is_smooth);
    }
    if (!is_smooth) continue;  // a joint of the profiles, or a birth, is too near for differences
    ++compared;
    with_flange += plain.wheels[0].patches.size() + plain.wheels[1].patches.size() > 2 ||
                   std::abs(x[lateral_shift]) > 5e-3;
    for (std::size_t n = 0; n < duals.size(); ++n) {
      // Relative to what all parameters do to this number over their scales.
      double size = 0;
      for (std::size_t k = 0; k < count; ++k) {
        size = std::max(size, static_cast<double>(std::abs(expected[k][n]) * scales[k]));
        acts[k] = acts[k] || std::abs(expected[k][n]) > 1e-3L;
      }
      for (std::size_t k = 0; k < count; ++k) {
        const double error = static_cast<double>(
            std::abs(static_cast<long double>(duals[n].derivatives[k]) - expected[k][n]) *
            scales[k]);
        INFO("pose " << pose << ", number " << n << ", parameter " << k << ", difference "
                     << expected[k][n] << ", dual " << duals[n].derivatives[k]);
        CHECK(error <= 1e-8 * size + 1e-15 * std::max(1.0, std::abs(value_of(plains[n]))));
        if (size > 1e-12) worst = std::max(worst, error / size);
      }
    }
  }
  CHECK(worst < 1e-8);
  CHECK(compared > poses / 3);
  CHECK(with_flange > 0);
  CHECK(std::all_of(acts.begin(), acts.end(), [](bool acted) { return acted; }));
}

TEST_CASE("wheelset_forces: a wheelset at rest has finite derivatives", "[wheelset][autodiff]") {
  std::mt19937 generator(7);
  Values<double> x = random_state(generator);
  for (int k = velocity_x; k <= angular_z; ++k) x[static_cast<std::size_t>(k)] = 0;
  const auto at_rest = forces(variables(x));
  for (int i = 0; i < 3; ++i) {
    for (const double by : at_rest.force_track(i).derivatives) CHECK(std::isfinite(by));
    for (const double by : at_rest.moment_track(i).derivatives) CHECK(std::isfinite(by));
  }
  // Creep forces resist motion, at rest too.
  CHECK(at_rest.force_track.x().derivatives[velocity_x] < 0);
  CHECK(at_rest.force_track.y().derivatives[velocity_y] < 0);
}

TEST_CASE(
    "find_contact_by_minimum_distance: other equations for the same contact, the same derivatives",
    "[wheelset][autodiff]") {
  using Convex = ConvexModification<PiecewiseProfile<Number>>;
  std::mt19937 generator(7);
  int flanges = 0;
  for (int pose = 0; pose < 8; ++pose) {
    Values<double> x = random_state(generator);
    const Values<Number> q = variables(x);
    const Wheelset wheelset(Convex(s1002<Number>()), q[nominal_radius], q[profile_spacing]);
    const TangentTrack track(uic50<Number>(), {.gauge = q[gauge], .inclination = q[inclination]});
    const auto at = WheelsetPosition<Number>::of(q[lateral_shift], q[height], q[roll], q[yaw]);
    WarmMinimumDistanceSearch<Number> by_distance(wheelset);
    WarmStripSearch<Number> by_strips(wheelset);
    for (const Side side : sides) {
      const auto placement = place_wheel(wheelset, track, side, at);
      const auto& wheel = wheelset.wheel(side);
      const auto one = by_strips(wheel, track.rail(side), placement);
      const auto other = by_distance(wheel, track.rail(side), placement);
      REQUIRE(one.patches.size() == other.patches.size());
      for (std::size_t i = 0; i < one.patches.size(); ++i) {
        const Patch<Number>&a = one.patches[i], &b = other.patches[i];
        flanges += a.wheel_lateral < Number(-0.03);
        const auto same = [&](const Number& c, const Number& d) {
          CHECK(c.value == Approx(d.value).epsilon(1e-9).margin(1e-12));
          double size = 0;
          for (const double by : d.derivatives) size = std::max(size, std::abs(by));
          for (std::size_t k = 0; k < count; ++k) {
            CHECK(std::abs(c.derivatives[k] - d.derivatives[k]) <= 1e-8 * size);
          }
        };
        same(a.wheel_lateral, b.wheel_lateral);
        same(a.rail_lateral, b.rail_lateral);
        same(a.wheel_angle, b.wheel_angle);
        same(a.penetration, b.penetration);
        same(a.rolling_radius, b.rolling_radius);
      }
    }
  }
  CHECK(flanges > 0);
}

TEST_CASE("touching_position: height and roll have the derivatives of differences",
          "[wheelset][autodiff]") {
  using Two = Dual<double, 2>;
  const auto touch = [](auto shift, auto turn) {
    using T = decltype(shift);
    const Wheelset wheelset(s1002<T>(), T(0.43), T(1.5));
    const TangentTrack track(uic50<T>());
    return touching_position(wheelset, track, shift, turn);
  };
  const auto dual = touch(Two(0.003, 0), Two(0.005, 1));
  REQUIRE(dual.status == SolveStatus::converged);
  using L = long double;
  const L shift = static_cast<L>(0.003), turn = static_cast<L>(0.005), h = 1e-6L;
  const auto slope = [&](L dx, L dy, auto get) {
    const auto across = [&](L s) { return get(touch(shift + s * dx, turn + s * dy)); };
    return static_cast<double>((8 * (across(h) - across(-h)) - (across(2 * h) - across(-2 * h))) /
                               (12 * h));
  };
  const auto height_of = [](const auto& at) { return at.height; };
  const auto roll_of = [](const auto& at) { return at.roll; };
  CHECK(dual.height.derivatives[0] == Approx(slope(1, 0, height_of)).epsilon(1e-8));
  CHECK(dual.height.derivatives[1] == Approx(slope(0, 1, height_of)).epsilon(1e-8));
  CHECK(dual.roll.derivatives[0] == Approx(slope(1, 0, roll_of)).epsilon(1e-8));
  CHECK(dual.roll.derivatives[1] == Approx(slope(0, 1, roll_of)).epsilon(1e-8));
}
