#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/track/tangent_track.hpp>
#include <wheelrail/wheelset/contact_lookup.hpp>
#include <wheelrail/wheelset/kinematics_table.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using Catch::Matchers::ContainsSubstring;

namespace {

using Profile1 = PiecewiseProfile<double>;
using Piece = ProfilePiece<double>;
using HeadTrack = TangentTrack<RailHead<double>>;
using Options = ContactLookupOptions<double>;
using Lookup = ContactLookup<double>;

const HeadTrack& track_60e1() {
  static const HeadTrack track(rail_60e1<double>(), {1.435, 0.025});
  return track;
}
const Wheelset<Profile1>& wheelset_1002() {
  static const Wheelset<Profile1> wheelset(s1002<double>(), 0.46, 1.5);
  return wheelset;
}
const Lookup& left_lookup() {
  static const Lookup lookup(wheelset_1002(), track_60e1(), Side::left);
  return lookup;
}

// The deepest patch, and how many there are, by the online search.
struct Online {
  Patch<double> deepest;
  std::size_t patches = 0;
};
template <class Wheels, class Track>
Online search(const Wheels& wheelset, const Track& track, Side side, double shift, double height,
              double roll, double yaw, double threshold = 0.0) {
  const auto at = WheelsetPosition<double>::of(shift, height, roll, yaw);
  const auto found =
      find_contact(wheelset.wheel(side), track.rail(side), place_wheel(wheelset, track, side, at),
                   SearchOptions<double>{.penetration_threshold = threshold});
  REQUIRE(found.status == SearchStatus::complete);
  Online online{{}, found.patches.size()};
  online.deepest.penetration = -1.0;
  for (const auto& patch : found.patches) {
    if (online.deepest.penetration < patch.penetration) online.deepest = patch;
  }
  return online;
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(engine_);
  }

 private:
  std::mt19937 engine_;
};

// Profiles without a joint: what is interpolated is smooth.
struct SmoothCase {
  static Profile1 polynomial(double lower, double upper, const std::vector<double>& coefficients) {
    return Profile1({Piece::polynomial(lower, upper, 0.0, 1.0, coefficients)});
  }
  Wheelset<Profile1> wheelset{polynomial(-0.034, 0.04, {0.0, -0.1, -1.5, -12.0}), 0.46, 1.5};
  TangentTrack<Profile1> track{polynomial(-0.037, 0.037, {0.0, 0.0, -1.7, 0.0, -8000.0}),
                               {1.435, 0.025}};

  [[nodiscard]] LookupErrors<double> errors(double step, double greatest_yaw = 1e-6,
                                            int yaw_intervals = 1) const {
    const Lookup lookup(wheelset, track, Side::left,
                        {.lateral_shift = {-0.004, 0.004, step},
                         .roll = {-0.002, 0.002, step},
                         .greatest_yaw = greatest_yaw,
                         .yaw_intervals = yaw_intervals,
                         .greatest_penetration = 1e-7,
                         .poses = 500});
    CHECK(lookup.report().flagged.poses == 0);
    CHECK(lookup.report().plain.poses > 450);
    return lookup.report().plain;
  }
};

}  // namespace

TEST_CASE("ContactLookup: at the nodes it is the online search", "[wheelset]") {
  const auto& lookup = left_lookup();
  const double exact = 64 * 2.3e-16 * 0.46;
  for (const double shift : {-0.008, -0.0045, 0.001, 0.00275, 0.008}) {
    for (const double roll : {-0.002, 0.0, 0.00125, 0.002}) {
      for (const double yaw : {0.0, 0.01, -0.01, 0.02}) {
        CAPTURE(shift, roll, yaw);
        const double height = lookup.at(shift, 1.0, roll, yaw).touching_height;
        const auto at = lookup.at(shift, height, roll, yaw);
        REQUIRE(at.status == LookupStatus::not_touching);
        CHECK(at.penetration == 0.0);
        const auto online =
            search(wheelset_1002(), track_60e1(), Side::left, shift, height, roll, yaw, -1e-9);
        const auto& patch = online.deepest;
        CHECK(std::abs(patch.penetration) < 4 * exact);
        CHECK(at.contact.wheel_lateral == Approx(patch.wheel_lateral).margin(1e-8));
        CHECK(at.contact.rail_lateral == Approx(patch.rail_lateral).margin(1e-8));
        CHECK(at.contact.contact_angle == Approx(patch.contact_angle).margin(1e-6));
        CHECK(at.contact.rolling_radius == Approx(patch.rolling_radius).margin(1e-8));
        CHECK(at.contact.wheel_lateral_curvature ==
              Approx(patch.wheel_lateral_curvature).epsilon(1e-4));
        CHECK(at.contact.rail_lateral_curvature == Approx(patch.rail_lateral_curvature));
        CHECK(at.contact.wheel_longitudinal_curvature ==
              Approx(patch.wheel_longitudinal_curvature).epsilon(1e-6));
      }
    }
  }
}

TEST_CASE(
    "ContactLookup: on smooth profiles the height is of third order in the step, the "
    "geometry of second",
    "[wheelset]") {
  const SmoothCase smooth;
  const auto coarse = smooth.errors(1e-3), middle = smooth.errors(0.5e-3),
             fine = smooth.errors(0.25e-3);
  const auto order = [](const LookupError<double>& one, const LookupError<double>& other) {
    return std::log2(one.rms / other.rms);
  };
  for (const auto& [one, other] : {std::pair{coarse, middle}, std::pair{middle, fine}}) {
    CHECK(order(one.touching_height, other.touching_height) > 2.7);
    CHECK(order(one.wheel_lateral, other.wheel_lateral) == Approx(2.0).margin(0.25));
    CHECK(order(one.contact_angle, other.contact_angle) == Approx(2.0).margin(0.25));
    CHECK(order(one.rolling_radius, other.rolling_radius) == Approx(2.0).margin(0.25));
  }
  CHECK(coarse.wheel_lateral.rms > 1e-8);
  // Second order in yaw^2, where nothing else errs as much.
  const auto one = smooth.errors(0.1e-3, 0.08, 1), two = smooth.errors(0.1e-3, 0.08, 2);
  CHECK(order(one.touching_height, two.touching_height) == Approx(2.0).margin(0.3));
}

TEST_CASE("ContactLookup: below the touching height the contact moves as the curvatures say",
          "[wheelset]") {
  const SmoothCase smooth;
  const Lookup lookup(smooth.wheelset, smooth.track, Side::left,
                      {.lateral_shift = {-0.004, 0.004, 1e-3},
                       .roll = {-0.002, 0.002, 1e-3},
                       .greatest_penetration = 1e-3});
  // At nodes, so that nothing is interpolated: what is left is of higher order in the penetration.
  for (const double shift : {-0.002, 0.003}) {
    for (const double depth : {1e-4, 2e-4}) {
      CAPTURE(shift, depth);
      const double touching = lookup.at(shift, 1.0, 0.001, 0.0).touching_height;
      const auto before = lookup.at(shift, touching, 0.001, 0.0);
      const auto at = lookup.at(shift, touching - depth, 0.001, 0.0);
      const auto online =
          search(smooth.wheelset, smooth.track, Side::left, shift, touching - depth, 0.001, 0.0);
      REQUIRE(at.status == LookupStatus::found);
      const auto& patch = online.deepest;
      CHECK(std::abs(at.penetration - patch.penetration) < 0.02 * depth * depth);
      const double moved = patch.wheel_lateral - before.contact.wheel_lateral;
      const double turned = patch.contact_angle - before.contact.contact_angle;
      CHECK(std::abs(moved) > 1e-6);
      CHECK(at.contact.wheel_lateral - before.contact.wheel_lateral == Approx(moved).epsilon(0.02));
      CHECK(at.contact.contact_angle - before.contact.contact_angle ==
            Approx(turned).epsilon(0.05));
      CHECK(std::abs(at.contact.rail_lateral - patch.rail_lateral) < 0.02 * std::abs(moved));
      CHECK(std::abs(at.contact.rolling_radius - patch.rolling_radius) < 0.02 * std::abs(moved));
    }
  }
}

TEST_CASE("ContactLookup: all jumps lie in flagged cells", "[wheelset]") {
  const auto& lookup = left_lookup();
  const double least = lookup.options().contact_step;
  int jumps = 0, unflagged = 0;
  for (const bool with_roll : {true, false}) {
    for (const double yaw : {0.0, 0.004, 0.0123, -0.0187}) {
      const auto table = kinematics_table(
          wheelset_1002(), track_60e1(),
          {.lower = -0.0079, .upper = 0.0079, .step = 1e-4, .yaw = yaw}, {.with_roll = with_roll});
      for (const auto& jump : table.jumps) {
        if (jump.side != Side::left) continue;
        if (std::abs(jump.wheel_lateral_after - jump.wheel_lateral_before) <= least) continue;
        const auto& before = table.shifts[jump.before];
        const auto at =
            lookup.at(jump.lateral_shift, before.wheel(Side::left).height, before.roll, yaw);
        if (at.status == LookupStatus::outside) continue;
        CAPTURE(with_roll, yaw, jump.lateral_shift, jump.wheel_lateral_before);
        ++jumps;
        CHECK(at.may_jump);
      }
      for (const auto& state : table.shifts) {
        const auto at = lookup.at(state.lateral_shift, 1.0, state.roll, yaw);
        unflagged += at.status == LookupStatus::not_touching && !at.is_flagged() ? 1 : 0;
      }
    }
  }
  CHECK(jumps >= 8);
  CHECK(unflagged >= 300);
}

TEST_CASE("ContactLookup: what the report says of the error holds at other poses",
          "[wheelset][random]") {
  const auto& lookup = left_lookup();
  const auto& options = lookup.options();
  const auto& report = lookup.report();
  Random random(20240611);
  double squares[5] = {}, greatest[5] = {};
  int beyond[5] = {};
  int plain = 0, several = 0, misplaced = 0, flagged = 0;
  const LookupError<double>* reported[5] = {
      &report.plain.touching_height, &report.plain.penetration, &report.plain.wheel_lateral,
      &report.plain.contact_angle, &report.plain.rolling_radius};
  for (int n = 0; n < 2000; ++n) {
    const double shift = random(-0.008, 0.008), roll = random(-0.002, 0.002);
    const double yaw = random(-0.02, 0.02), penetration = random(0.0, 0.98e-4);
    // Set down by Newton's method over all of the wheel: the library's own way is not used.
    double touching = 0.46;
    const auto pressed = [&](double height) {
      return search(wheelset_1002(), track_60e1(), Side::left, shift, height, roll, yaw, -0.05);
    };
    for (int i = 0; i < 20; ++i) {
      const auto at = pressed(touching).deepest;
      if (std::abs(at.penetration) < 1e-13) break;
      touching += at.penetration / std::cos(at.contact_angle);
    }
    const double angle = pressed(touching).deepest.contact_angle;
    const double height = touching - penetration / std::cos(angle);
    const auto online = search(wheelset_1002(), track_60e1(), Side::left, shift, height, roll, yaw);
    const auto at = lookup.at(shift, height, roll, yaw);
    if (at.status != LookupStatus::found || online.patches == 0) continue;
    if (at.is_flagged()) {
      ++flagged;
      continue;
    }
    ++plain;
    several += online.patches > 1 ? 1 : 0;
    const double errors[5] = {at.touching_height - touching,
                              at.penetration - online.deepest.penetration,
                              at.contact.wheel_lateral - online.deepest.wheel_lateral,
                              at.contact.contact_angle - online.deepest.contact_angle,
                              at.contact.rolling_radius - online.deepest.rolling_radius};
    misplaced += std::abs(errors[2]) > options.contact_step ? 1 : 0;
    for (int k = 0; k < 5; ++k) {
      squares[k] += errors[k] * errors[k];
      greatest[k] = std::max(greatest[k], std::abs(errors[k]));
      beyond[k] += std::abs(errors[k]) > reported[k]->greatest ? 1 : 0;
    }
  }
  CHECK(plain > 1400);
  CHECK(flagged > 100);
  CHECK(misplaced <= 1);
  CHECK(several <= 5);
  for (int k = 0; k < 5; ++k) {
    CAPTURE(k, greatest[k], reported[k]->greatest);
    // With as many poses as the report has, one is beyond its greatest on average: 8 or more have a
    // probability of 1/256.
    CHECK(beyond[k] < 8);
    CHECK(greatest[k] < 2.0 * reported[k]->greatest);
    CHECK(greatest[k] > 0.3 * reported[k]->greatest);
    CHECK(std::sqrt(squares[k] / plain) == Approx(reported[k]->rms).epsilon(0.3));
  }
}

TEST_CASE("ContactLookup: the report counts every cell and pose once", "[wheelset]") {
  const auto& report = left_lookup().report();
  CHECK(report.cells == 64 * 16 * 4);
  CHECK(report.void_cells == 0);
  CHECK(report.plain.poses + report.flagged.poses + report.unmeasured + report.refused == 2000);
  CHECK(report.plain.poses > 1500);
  CHECK(report.flagged_cells >= std::max(report.jump_cells, report.several_cells));
  CHECK(report.flagged_cells <= report.jump_cells + report.several_cells);
  CHECK(report.flagged_cells < report.cells / 5);
  CHECK(report.plain.misplaced == 0);
  // Most poses with several patches are flagged, and a flag means something.
  CHECK(report.flagged.several > 10 * report.plain.several);
  CHECK(report.flagged.wheel_lateral.rms > 10 * report.plain.wheel_lateral.rms);
  CHECK(report.plain.penetration.greatest < 1e-6);
  CHECK(left_lookup().memory() > 65 * 17 * 5 * 10 * sizeof(double));
}

TEST_CASE("ContactLookup: the right wheel at the mirrored pose is the left one",
          "[wheelset][symmetry]") {
  const Options options{.poses = 1};
  const Lookup right(wheelset_1002(), track_60e1(), Side::right, options);
  for (const double shift : {-0.00612, 0.0013, 0.0049}) {
    for (const double yaw : {0.0, 0.0071}) {
      const auto a = left_lookup().at(shift, 0.4598, 0.00077, yaw);
      const auto b = right.at(-shift, 0.4598, -0.00077, -yaw);
      const auto c = right.at(-shift, 0.4598, -0.00077, yaw);
      CHECK(a.status == b.status);
      CHECK(a.touching_height == Approx(b.touching_height).epsilon(1e-12));
      CHECK(b.touching_height == c.touching_height);
      CHECK(a.is_flagged() == b.is_flagged());
    }
  }
}

TEST_CASE("ContactLookup: nothing is extrapolated", "[wheelset][bad-input]") {
  const auto& lookup = left_lookup();
  const auto status = [&](double shift, double height, double roll, double yaw) {
    const auto at = lookup.at(shift, height, roll, yaw);
    if (at.status != LookupStatus::found && at.status != LookupStatus::not_touching) {
      CHECK(std::isnan(at.penetration));
      CHECK(std::isnan(at.touching_height));
      CHECK(std::isnan(at.contact.wheel_lateral));
    }
    return at.status;
  };
  const double touching = lookup.at(0.0, 1.0, 0.0, 0.0).touching_height;
  CHECK(status(0.0, touching - 5e-5, 0.0, 0.0) == LookupStatus::found);
  CHECK(status(0.0, touching + 5e-5, 0.0, 0.0) == LookupStatus::not_touching);
  CHECK(status(0.0, touching - 1.1e-4, 0.0, 0.0) == LookupStatus::too_deep);
  for (const double sign : {1.0, -1.0}) {
    CHECK(status(sign * 0.008, 1.0, 0.0, 0.0) == LookupStatus::not_touching);
    CHECK(status(sign * 0.008000001, 1.0, 0.0, 0.0) == LookupStatus::outside);
    CHECK(status(0.0, 1.0, sign * 0.002, 0.0) == LookupStatus::not_touching);
    CHECK(status(0.0, 1.0, sign * 0.002000001, 0.0) == LookupStatus::outside);
    CHECK(status(0.0, 1.0, 0.0, sign * 0.02) == LookupStatus::not_touching);
    CHECK(status(0.0, 1.0, 0.0, sign * 0.02000001) == LookupStatus::outside);
  }
  const double nan = std::nan(""), infinite = HUGE_VAL;
  for (const double bad : {nan, infinite, -infinite}) {
    CHECK(status(bad, 0.46, 0.0, 0.0) == LookupStatus::not_finite);
    CHECK(status(0.0, bad, 0.0, 0.0) == LookupStatus::not_finite);
    CHECK(status(0.0, 0.46, bad, 0.0) == LookupStatus::not_finite);
    CHECK(status(0.0, 0.46, 0.0, bad) == LookupStatus::not_finite);
  }
  // A wheel that has left its rail.
  const Lookup wide(wheelset_1002(), track_60e1(), Side::left,
                    {.lateral_shift = {-0.4, 0.0, 0.1}, .roll = {0.0, 1e-3, 1e-3}, .poses = 20});
  CHECK(wide.at(-0.35, 0.46, 0.0, 0.0).status == LookupStatus::no_contact);
  CHECK(wide.report().void_cells > 0);
  for (const auto s :
       {LookupStatus::found, LookupStatus::not_touching, LookupStatus::outside,
        LookupStatus::too_deep, LookupStatus::no_contact, LookupStatus::not_finite}) {
    CHECK(std::string(name_of(s)) != "unknown");
  }
}

TEST_CASE("ContactLookup: an error names the option, its value and the rule",
          "[wheelset][bad-input]") {
  const auto make = [](const Options& options) {
    return Lookup(wheelset_1002(), track_60e1(), Side::left, options);
  };
  CHECK_THROWS_WITH(
      make({.lateral_shift = {0.001, 0.001, 1e-3}}),
      ContainsSubstring("greatest lateral shift is 0.001") && ContainsSubstring("greater than"));
  CHECK_THROWS_WITH(make({.lateral_shift = {std::nan(""), 0.001, 1e-3}}),
                    ContainsSubstring("least lateral shift") && ContainsSubstring("finite"));
  CHECK_THROWS_WITH(make({.lateral_shift = {-0.01, 0.01, 0.0}}),
                    ContainsSubstring("lateral shift step is 0") && ContainsSubstring("> 0 [m]"));
  CHECK_THROWS_WITH(
      make({.roll = {-0.01, 0.01, 1e-9}}),
      ContainsSubstring("roll step is 1e-09") && ContainsSubstring("1e-4 of the range"));
  CHECK_THROWS_WITH(make({.roll = {-0.01, 2.0, 0.1}}),
                    ContainsSubstring("roll") && ContainsSubstring("less than 1"));
  CHECK_THROWS_WITH(make({.greatest_yaw = -0.01}), ContainsSubstring("greatest yaw is -0.01"));
  CHECK_THROWS_WITH(make({.greatest_yaw = 1.5}),
                    ContainsSubstring("1.5") && ContainsSubstring("less than 1"));
  CHECK_THROWS_WITH(make({.yaw_intervals = 0}), ContainsSubstring("there are 0 yaw intervals"));
  CHECK_THROWS_WITH(make({.greatest_penetration = 0.0}),
                    ContainsSubstring("greatest penetration is 0"));
  CHECK_THROWS_WITH(make({.contact_step = -1.0}), ContainsSubstring("contact step is -1"));
  CHECK_THROWS_WITH(make({.poses = 0}), ContainsSubstring("there are 0 poses"));
  CHECK_THROWS_WITH(
      make(
          {.lateral_shift = {-0.01, 0.01, 1e-5}, .roll = {-0.01, 0.01, 1e-5}, .yaw_intervals = 10}),
      ContainsSubstring("nodes") && ContainsSubstring("at most 10000000"));
}

TEST_CASE("ContactLookup: a scalar that converts to nothing, to the last bit",
          "[wheelset][autodiff]") {
  using S = wheelrail_test::StrictScalar;
  const Wheelset<PiecewiseProfile<S>> wheelset(s1002<S>(), S(0.46), S(1.5));
  const TangentTrack<RailHead<S>> track(rail_60e1<S>(), {S(1.435), S(0.025)});
  const Options options{
      .lateral_shift = {0.004, 0.006, 0.5e-3}, .roll = {0.0, 1e-3, 0.5e-3}, .poses = 50};
  ContactLookupOptions<S> strict;
  strict.lateral_shift = {S(0.004), S(0.006), S(0.5e-3)};
  strict.roll = {S(0.0), S(1e-3), S(0.5e-3)};
  strict.poses = 50;
  const Lookup expected(wheelset_1002(), track_60e1(), Side::left, options);
  const ContactLookup<S> lookup(wheelset, track, Side::left, strict);
  CHECK(lookup.report().flagged.penetration.greatest.as_double() ==
        expected.report().flagged.penetration.greatest);
  CHECK(lookup.report().plain.poses == expected.report().plain.poses);
  const auto at = lookup.at(S(0.0043), S(0.4598), S(0.0004), S(0.003));
  const auto other = expected.at(0.0043, 0.4598, 0.0004, 0.003);
  CHECK(at.touching_height.as_double() == other.touching_height);
  CHECK(at.status == other.status);
}

TEST_CASE("ContactLookup: in single precision it is as good as the rounding lets it",
          "[wheelset]") {
  const Wheelset<PiecewiseProfile<float>> wheelset(s1002<float>(), 0.46F, 1.5F);
  const TangentTrack<RailHead<float>> track(rail_60e1<float>(), {1.435F, 0.025F});
  const ContactLookup<float> lookup(wheelset, track, Side::left);
  CHECK(lookup.report().plain.poses > 1400);
  CHECK(lookup.report().void_cells == 0);
  CHECK(lookup.report().plain.penetration.greatest < 2e-5F);
  const auto at = lookup.at(0.0011F, 1.0F, 0.0003F, 0.004F);
  CHECK(static_cast<double>(at.touching_height) ==
        Approx(left_lookup().at(0.0011, 1.0, 0.0003, 0.004).touching_height).margin(1e-5));
}

TEST_CASE("ContactLookup: a lookup does not allocate", "[wheelset][no-alloc]") {
  const auto& lookup = left_lookup();
  const auto before = wheelrail_test::allocations_so_far();
  const auto at = lookup.at(0.003, 0.4598, 0.0, 0.001);
  CHECK(wheelrail_test::allocations_so_far() == before);
  CHECK(at.status != LookupStatus::outside);
}

// Prints error, memory and time by the step: contact_lookup_test "[.measure]".
TEST_CASE("ContactLookup: error and cost by the step", "[.measure]") {
  for (const double factor : {4.0, 2.0, 1.0, 0.5}) {
    Options options;
    options.lateral_shift.step *= factor;
    options.roll.step *= factor;
    const Lookup lookup(wheelset_1002(), track_60e1(), Side::left, options);
    const auto& report = lookup.report();
    std::printf("step %.3g mm, %.3g mrad: %zu kB, flagged %.1f %%\n",
                options.lateral_shift.step * 1e3, options.roll.step * 1e3, lookup.memory() / 1000,
                100.0 * report.flagged_cells / report.cells);
    for (const auto* errors : {&report.plain, &report.flagged}) {
      std::printf("  %-7s %4d poses, %d misplaced, %d with several patches\n",
                  errors == &report.plain ? "plain" : "flagged", errors->poses, errors->misplaced,
                  errors->several);
      const auto print = [](const char* name, const LookupError<double>& error) {
        std::printf("    %-22s greatest %.2g, rms %.2g\n", name, error.greatest * 1e6,
                    error.rms * 1e6);
      };
      print("touching height [um]", errors->touching_height);
      print("penetration [um]", errors->penetration);
      print("wheel lateral [um]", errors->wheel_lateral);
      print("contact angle [urad]", errors->contact_angle);
      print("rolling radius [um]", errors->rolling_radius);
    }
    Random random(3);
    std::vector<std::array<double, 4>> poses(5000);
    for (auto& p : poses) {
      p = {random(-0.008, 0.008), 1.0, random(-0.002, 0.002), random(-0.02, 0.02)};
      p[1] = lookup.at(p[0], p[1], p[2], p[3]).touching_height - 5e-5;
    }
    using Clock = std::chrono::steady_clock;
    double sum = 0.0;
    const auto start = Clock::now();
    for (const auto& p : poses) sum += lookup.at(p[0], p[1], p[2], p[3]).contact.rolling_radius;
    const auto between = Clock::now();
    for (const auto& p : poses) {
      sum -= search(wheelset_1002(), track_60e1(), Side::left, p[0], p[1], p[2], p[3])
                 .deepest.rolling_radius;
    }
    const auto end = Clock::now();
    CHECK(std::isfinite(sum));
    std::printf("  one lookup: %.3f of an online search\n",
                std::chrono::duration<double>(between - start).count() /
                    std::chrono::duration<double>(end - between).count());
  }
}
