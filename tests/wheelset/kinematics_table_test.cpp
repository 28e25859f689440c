#include <algorithm>
#include <cmath>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/track/tangent_track.hpp>
#include <wheelrail/wheelset/kinematics_table.hpp>

#include "support/catch.hpp"
#include "wheelset/point_profiles.hpp"

using namespace wheelrail;
using Catch::Matchers::ContainsSubstring;

namespace {

using HeadTrack = TangentTrack<RailHead<double>>;

const HeadTrack& track_60e1() {
  static const HeadTrack track(rail_60e1<double>(), {1.435, 0.025});
  return track;
}
const Wheelset<PiecewiseProfile<double>>& wheelset_1002() {
  static const Wheelset<PiecewiseProfile<double>> wheelset(s1002<double>(), 0.46, 1.5);
  return wheelset;
}

}  // namespace

TEST_CASE("kinematics_table: holds the range's shifts, in order, each as it is alone",
          "[wheelset]") {
  const KinematicsRange<double> range{.lower = -0.007, .upper = 0.008};
  const auto table = kinematics_table(wheelset_1002(), track_60e1(), range);
  REQUIRE(table.shifts.size() >= 31);
  CHECK(table.shifts.front().lateral_shift == range.lower);
  CHECK(table.shifts.back().lateral_shift == range.upper);
  for (std::size_t i = 0; i < table.shifts.size(); ++i) {
    const auto& at = table.shifts[i];
    CAPTURE(at.lateral_shift);
    REQUIRE(at.status == TouchStatus::touching);
    const auto alone = wheelset_kinematics(wheelset_1002(), track_60e1(), at.lateral_shift);
    CHECK(at.height == Approx(alone.height).epsilon(1e-13));
    CHECK(at.roll == Approx(alone.roll).margin(1e-12));
    if (i == 0) continue;
    const double step = at.lateral_shift - table.shifts[i - 1].lateral_shift;
    CHECK(step > 0);
    CHECK(step < range.step * (1 + 1e-9));
  }
}

TEST_CASE("kinematics_table: between two shifts a contact point moves little, or jumps",
          "[wheelset]") {
  const KinematicsRange<double> range{.jump_width = 1e-9};
  const auto table = kinematics_table(wheelset_1002(), track_60e1(), range);
  std::size_t jumps = 0;
  for (std::size_t i = 1; i < table.shifts.size(); ++i) {
    for (const Side side : sides) {
      const double before = table.shifts[i - 1].wheel(side).contact().wheel_lateral;
      const double after = table.shifts[i].wheel(side).contact().wheel_lateral;
      if (std::abs(after - before) <= range.contact_step) continue;
      REQUIRE(jumps < table.jumps.size());
      const auto& jump = table.jumps[jumps++];
      CHECK(jump.before == i - 1);
      CHECK(jump.side == side);
      CHECK(jump.wheel_lateral_before == before);
      CHECK(jump.wheel_lateral_after == after);
      CHECK(table.shifts[i].lateral_shift - table.shifts[i - 1].lateral_shift <= range.jump_width);
    }
  }
  CHECK(jumps == table.jumps.size());
  // Three on each side: on the tread, into the flange's fillet and up the flange.
  REQUIRE(jumps == 6);
  int pairs = 0, conformal = 0;
  for (const auto& jump : table.jumps) {
    CAPTURE(jump.lateral_shift);
    // Two places touch there, but for what is left of the interval.
    const auto at = wheelset_kinematics(wheelset_1002(), track_60e1(), jump.lateral_shift, 0.0,
                                        {.closeness = 2e-8});
    REQUIRE(at.status == TouchStatus::touching);
    const auto& patches = at.wheel(jump.side).patches;
    const double least = std::min(jump.wheel_lateral_before, jump.wheel_lateral_after);
    const double greatest = std::max(jump.wheel_lateral_before, jump.wheel_lateral_after);
    if (patches.size() == 2) {
      ++pairs;
      CHECK(std::min(patches[0].wheel_lateral, patches[1].wheel_lateral) ==
            Approx(least).margin(1e-6));
      CHECK(std::max(patches[0].wheel_lateral, patches[1].wheel_lateral) ==
            Approx(greatest).margin(1e-6));
    } else {
      // The fillet's 13 mm on the rail's corner of 13 mm: all between the two is as close.
      ++conformal;
      CHECK(patches[0].zone_lower < least + 1e-6);
      CHECK(patches[0].zone_upper > greatest - 1e-6);
    }
  }
  CHECK(pairs == 4);
  CHECK(conformal == 2);
}

TEST_CASE("kinematics_table: equal sides jump at mirrored shifts", "[wheelset][symmetry]") {
  for (const bool with_roll : {true, false}) {
    const auto table =
        kinematics_table(wheelset_1002(), track_60e1(), {}, {.with_roll = with_roll});
    const std::size_t n = table.jumps.size();
    REQUIRE(n >= 4);
    for (std::size_t i = 0; i < n; ++i) {
      const auto& jump = table.jumps[i];
      const auto& mirrored = table.jumps[n - 1 - i];
      CHECK(jump.lateral_shift == Approx(-mirrored.lateral_shift).margin(2e-7));
      CHECK(jump.side != mirrored.side);
    }
  }
}

TEST_CASE("kinematics_table: profiles of 1000 points", "[wheelset]") {
  const wheelrail_test::PointProfile wheel = wheelrail_test::through(en15302::wheel_b);
  const Wheelset<wheelrail_test::PointProfile> wheelset(wheel, 0.46, 1.5);
  const auto table = kinematics_table(wheelset, wheelrail_test::en15302_track());
  for (const auto& at : table.shifts) CHECK(at.status == TouchStatus::touching);
  // What is added to the 41 shifts follows the moves of the contact points, not the points.
  CHECK(table.shifts.size() < 400);
}

TEST_CASE("kinematics_table: steps of rounded decimal numbers are as many as there should be",
          "[wheelset]") {
  for (const double lower : {-0.007, -0.0055, 0.0011}) {
    for (const int steps : {2, 6, 14, 60}) {
      for (const double step : {1e-4, 3e-5, 7e-5, 1e-4 / 3}) {
        CAPTURE(lower, steps, step);
        // Nothing is put in between.
        const auto table = kinematics_table(
            wheelset_1002(), track_60e1(),
            {.lower = lower, .upper = lower + steps * step, .step = step, .contact_step = 1.0});
        CHECK(static_cast<int>(table.shifts.size()) == steps + 1);
      }
    }
  }
}

TEST_CASE("kinematics_table: shifts that cannot be have their status", "[wheelset][bad-input]") {
  const auto table =
      kinematics_table(wheelset_1002(), track_60e1(), {.lower = -0.2, .upper = 0.2, .step = 0.1});
  REQUIRE(table.shifts.size() == 5);
  CHECK(table.shifts[2].status == TouchStatus::touching);
  CHECK(table.shifts[0].status != TouchStatus::touching);
  CHECK(table.shifts[4].status != TouchStatus::touching);
}

TEST_CASE("kinematics_table: bad ranges are named", "[wheelset][bad-input]") {
  const auto table = [](const KinematicsRange<double>& range) {
    return kinematics_table(wheelset_1002(), track_60e1(), range);
  };
  CHECK_THROWS_WITH(table({.lower = 0.01}), ContainsSubstring("greatest lateral shift is 0.01"));
  CHECK_THROWS_WITH(table({.lower = std::nan("")}),
                    ContainsSubstring("least lateral shift is nan"));
  CHECK_THROWS_WITH(table({.step = 0.0}),
                    ContainsSubstring("kinematics: step is 0") && ContainsSubstring("> 0"));
  CHECK_THROWS_WITH(table({.step = 1e-9}), ContainsSubstring("1e-5 of the range"));
  CHECK_THROWS_WITH(table({.contact_step = -1.0}), ContainsSubstring("contact step is -1"));
  CHECK_THROWS_WITH(table({.jump_width = 0.0}), ContainsSubstring("jump width is 0"));
  const auto with = [](const KinematicsOptions<double>& options) {
    return kinematics_table(wheelset_1002(), track_60e1(), {}, options);
  };
  CHECK_THROWS_WITH(with({.closeness = std::nan("")}), ContainsSubstring("closeness is nan"));
  CHECK_THROWS_WITH(with({.tolerance = -1.0}), ContainsSubstring("tolerance is -1"));
  CHECK_THROWS_WITH(with({.maximum_iterations = 0}), ContainsSubstring("there are 0 iterations"));
}
