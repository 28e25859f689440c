#include <cmath>
#include <string>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/track/tangent_track.hpp>
#include <wheelrail/wheelset/kinematics.hpp>
#include <wheelrail/wheelset/touching_position.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;

namespace {

using Profile1 = PiecewiseProfile<double>;
using Piece = ProfilePiece<double>;
using HeadTrack = TangentTrack<RailHead<double>>;

const HeadTrack& track_60e1() {
  static const HeadTrack track(rail_60e1<double>(), {1.435, 0.025});
  return track;
}
const Wheelset<Profile1>& wheelset_1002() {
  static const Wheelset<Profile1> wheelset(s1002<double>(), 0.46, 1.5);
  return wheelset;
}

// A cone whose radius falls with `slope` to the field side.
Profile1 cone(double slope) {
  return Profile1({Piece::line(-0.07, 0.06, 0.0, 0.0, -slope)});
}

// Two cones of angle `angle` on two fixed circles, exactly: the lines that touch the circles, moved
// towards their centres by the radius, pass through these, so that the wheelset is a V that slides
// in two points 2 c apart, z_c high. Its apex is at y = c sin(2 roll) / sin(2 angle) and at z = z_c
// + c (cos(2 angle) - cos(2 roll)) / sin(2 angle); the axle's centre lies `above` the apex.
struct ConesOnCircles {
  double angle, c, z_c, above;

  double lateral_shift(double roll) const {
    return c * std::sin(2 * roll) / std::sin(2 * angle) - above * std::sin(roll);
  }
  double height(double roll) const {
    return z_c + c * (std::cos(2 * angle) - std::cos(2 * roll)) / std::sin(2 * angle) +
           above * std::cos(roll);
  }
  double height_slope(double roll) const {
    return (2 * c * std::sin(2 * roll) / std::sin(2 * angle) - above * std::sin(roll)) /
           (2 * c * std::cos(2 * roll) / std::sin(2 * angle) - above * std::cos(roll));
  }
  // d2 height / d lateral_shift2 at the centre.
  double height_bend() const {
    const double k = 2 * c / std::sin(2 * angle);
    return (2 * k - above) / ((k - above) * (k - above));
  }
};

// The rails' crowns, arcs of 300 mm, stand upright: their centres are the circles'.
struct ConeCase {
  double slope = 0.025, radius = 0.46;
  Wheelset<Profile1> wheelset{cone(slope), radius, 1.5};
  HeadTrack track{rail_60e1<double>(), {1.435, 0.0}};
  ConesOnCircles exact = [this] {
    const auto frame = track.nearest_frame(Side::left, Vector3<double>::Zero());
    const double angle = std::atan(slope);
    // The apex of the V: the lines meet at y = 0, and lie a circle's radius lower.
    const double apex_below = radius + slope * 0.75 + 0.3 / std::cos(angle);
    return ConesOnCircles{angle, frame.origin_track.y(), frame.origin_track.z() - 0.3, apex_below};
  }();
};

}  // namespace

TEST_CASE("wheelset_kinematics: cones on rails of constant radius give the closed form",
          "[wheelset]") {
  const ConeCase c;
  const double axle_load = 1e5;
  for (const double roll : {0.0, 1e-4, -2.3e-4}) {
    const double shift = c.exact.lateral_shift(roll);
    CAPTURE(roll, shift);
    const auto at = wheelset_kinematics(c.wheelset, c.track, shift);
    REQUIRE(at.status == TouchStatus::touching);
    CHECK(at.roll == Approx(roll).margin(1e-13));
    CHECK(at.height == Approx(c.exact.height(roll)).epsilon(1e-14));
    CHECK(at.height_slope == Approx(c.exact.height_slope(roll)).margin(1e-13));
    CHECK(at.lateral_force(axle_load) ==
          Approx(-axle_load * c.exact.height_slope(roll)).margin(1e-8));
    // The contact planes turn with the wheelset.
    for (const Side side : sides) {
      const double angle = at.wheel(side).contact().contact_angle;
      CHECK(angle == Approx(c.exact.angle + outboard_sign<double>(side) * roll).margin(1e-12));
    }
  }
}

TEST_CASE("gravitational_stiffness: cones on rails of constant radius give the closed form",
          "[wheelset]") {
  const ConeCase c;
  const double axle_load = 1e5, step = 1e-5;
  const auto left = wheelset_kinematics(c.wheelset, c.track, step);
  const auto right = wheelset_kinematics(c.wheelset, c.track, -step);
  const double stiffness = gravitational_stiffness(right, left, axle_load);
  CHECK(stiffness == Approx(axle_load * c.exact.height_bend()).epsilon(1e-6));
  // Nearly 2 axle_load slope / c: to first order in the slope.
  CHECK(stiffness == Approx(2 * axle_load * c.slope / c.exact.c).epsilon(0.05));
  // Without roll nothing rises on one side that does not fall on the other.
  const KinematicsOptions<double> no_roll{.with_roll = false};
  const auto a = wheelset_kinematics(c.wheelset, c.track, -1e-3, 0.0, no_roll);
  const auto b = wheelset_kinematics(c.wheelset, c.track, 1e-3, 0.0, no_roll);
  CHECK(gravitational_stiffness(a, b, axle_load) == Approx(0.0).margin(1e-8));
}

TEST_CASE("wheelset_kinematics: a cone's conicity is its slope, with roll a little more",
          "[wheelset]") {
  const ConeCase c;
  const double step = 1e-6;
  const auto difference_rate = [&](bool with_roll) {
    const KinematicsOptions<double> options{.with_roll = with_roll};
    const auto left = wheelset_kinematics(c.wheelset, c.track, step, 0.0, options);
    const auto right = wheelset_kinematics(c.wheelset, c.track, -step, 0.0, options);
    return (left.rolling_radius_difference() - right.rolling_radius_difference()) / (2 * step);
  };
  CHECK(difference_rate(false) == Approx(2 * c.slope).epsilon(1e-8));
  // slope (l + R slope) / (l - r0 slope) to first order in the slope (Wickens), l half the distance
  // of the contact points, R the rail's radius, r0 the wheel's there: 2.6 % more than the slope.
  const double l = c.exact.c - 0.3 * std::sin(c.exact.angle);
  const double r0 = c.radius - c.slope * (l - 0.75);
  CHECK(difference_rate(true) / 2 ==
        Approx(c.slope * (l + 0.3 * c.slope) / (l - r0 * c.slope)).epsilon(1e-3));
  CHECK(difference_rate(true) / 2 > 1.025 * c.slope);
}

TEST_CASE("wheelset_kinematics: the height's slope is the derivative of the height", "[wheelset]") {
  const double step = 1e-6;
  int steep = 0;
  for (const bool with_roll : {true, false}) {
    for (const double yaw : {0.0, 0.01}) {
      for (const double shift : {-0.0071, -0.0034, 0.0, 0.0025, 0.0056}) {
        const KinematicsOptions<double> options{.with_roll = with_roll};
        const auto at = [&](double y) {
          return wheelset_kinematics(wheelset_1002(), track_60e1(), y, yaw, options);
        };
        CAPTURE(with_roll, yaw, shift);
        const auto below = at(shift - step), here = at(shift), above = at(shift + step);
        REQUIRE(here.status == TouchStatus::touching);
        CHECK(here.height_slope ==
              Approx((above.height - below.height) / (2 * step)).epsilon(1e-5).margin(1e-6));
        CHECK(here.roll_slope ==
              Approx((above.roll - below.roll) / (2 * step)).epsilon(1e-5).margin(1e-6));
        steep += std::abs(here.height_slope) > 0.5 ? 1 : 0;
      }
    }
  }
  CHECK(steep >= 2);
}

TEST_CASE("wheelset_kinematics: the lateral force is that of frictionless normal forces",
          "[wheelset]") {
  const double axle_load = 2e5;
  for (const double shift : {-0.0071, 0.002, 0.0045}) {
    const auto at = wheelset_kinematics(wheelset_1002(), track_60e1(), shift);
    REQUIRE(at.status == TouchStatus::touching);
    // Two normal forces that carry the load and leave no roll moment about the axle's centre.
    double n_y[2], n_z[2], moment[2];
    const auto position = WheelsetPosition<double>::of(shift, at.height, at.roll, 0.0);
    for (const Side side : sides) {
      const auto wheel_track = wheelset_1002().wheel_track(side, position);
      const auto frame = track_60e1().nearest_frame(side, wheel_track);
      const auto& patch = at.wheel(side).contact();
      const Vector3<double> n_track = frame.direction_track(patch.normal_rail);
      const Vector3<double> arm_track =
          frame.position_track(patch.position_rail) - position.position_track;
      n_y[index_of(side)] = n_track.y();
      n_z[index_of(side)] = n_track.z();
      moment[index_of(side)] = cross(arm_track, n_track).x();
    }
    const double determinant = n_z[0] * moment[1] - n_z[1] * moment[0];
    const double left = axle_load * moment[1] / determinant;
    const double right = -axle_load * moment[0] / determinant;
    CHECK(at.lateral_force(axle_load) == Approx(left * n_y[0] + right * n_y[1]).epsilon(1e-9));
  }
}

// S1002 on UIC60 1:40 with roll, as computed by CONTACT: rows of the table of
// track/rigid_contact_test, where the source and the profile are described. [mm], the wheelset
// moves to the right.
TEST_CASE("wheelset_kinematics: rigid contact points are those of CONTACT from a cold start",
          "[wheelset][reference]") {
  struct Row {
    double shift, roll, drop, left_wheel, right_wheel;
  };
  constexpr Row table[] = {
      {0, 0, 0.182129352, -3.25329964, 3.25329964},
      {3, -0.000183678413, 0.0904655814, -10.4503521, -13.1044069},
      {5, -0.000369570193, -0.0317187904, -13.1614134, -28.6147139},
      {6.5, -0.00425216842, -2.9761858, -17.1552472, -40.1210686},
      {10, -0.0113497322, -8.36137632, -22.4953786, -44.36198},
  };
  const HeadTrack track(RailHead<double>({0.3, 0.08, 0.013, 0.072, 14.259720e-3, 0.05, 0.035}),
                        {1.435, 0.025});
  for (const Row& row : table) {
    CAPTURE(row.shift);
    const auto at = wheelset_kinematics(wheelset_1002(), track, -row.shift * 1e-3);
    REQUIRE(at.status == TouchStatus::touching);
    CHECK(std::abs(at.roll - row.roll) < 1e-6);
    CHECK(std::abs((0.46 - at.height) * 1e3 - row.drop) < 1e-3);
    CHECK(std::abs(at.wheels[0].contact().wheel_lateral * 1e3 + row.left_wheel) < 2.5e-3);
    CHECK(std::abs(at.wheels[1].contact().wheel_lateral * 1e3 - row.right_wheel) < 2.5e-3);
  }
}

TEST_CASE("wheelset_kinematics: with roll and yaw it is touching_position", "[wheelset]") {
  for (const double yaw : {0.0, 0.003, 0.02}) {
    for (const double shift : {-0.0062, 0.0, 0.0012, 0.008}) {
      CAPTURE(yaw, shift);
      const auto at = wheelset_kinematics(wheelset_1002(), track_60e1(), shift, yaw);
      const auto other = touching_position(wheelset_1002(), track_60e1(), shift, yaw);
      REQUIRE(at.status == TouchStatus::touching);
      REQUIRE(other.status == SolveStatus::converged);
      CHECK(at.height == Approx(other.height).epsilon(1e-12));
      CHECK(at.roll == Approx(other.roll).margin(1e-12));
      for (const Side side : sides) {
        CHECK(at.wheel(side).contact().wheel_lateral ==
              Approx(other.patches[index_of(side)].wheel_lateral).margin(1e-7));
      }
    }
  }
}

TEST_CASE("wheelset_kinematics: a mirrored shift gives the mirrored contact",
          "[wheelset][symmetry]") {
  const auto at = wheelset_kinematics(wheelset_1002(), track_60e1(), 0.0041, 0.006);
  const auto mirrored = wheelset_kinematics(wheelset_1002(), track_60e1(), -0.0041, -0.006);
  CHECK(at.roll == Approx(-mirrored.roll).epsilon(1e-12));
  CHECK(at.height == Approx(mirrored.height).epsilon(1e-14));
  CHECK(at.rolling_radius_difference() == Approx(-mirrored.rolling_radius_difference()));
  CHECK(at.height_slope == Approx(-mirrored.height_slope).epsilon(1e-9));
}

TEST_CASE("wheelset_kinematics: different wheels, radii and rails are each set down on their own",
          "[wheelset][symmetry]") {
  const KinematicsOptions<double> no_roll{.with_roll = false};
  const Wheel<Profile1> worn(s1002<double>(), 0.459), conical(cone(0.025), 0.46);
  const auto rail = rail_60e1<double>(), other_rail = uic50<double>();
  const Wheelset<Profile1> mixed(worn, conical, 1.5), swapped(conical, worn, 1.5);
  const HeadTrack mixed_track(rail, other_rail, {1.435, 0.025});
  const HeadTrack swapped_track(other_rail, rail, {1.435, 0.025});
  for (const double shift : {-0.003, 0.0012}) {
    const auto a = wheelset_kinematics(mixed, mixed_track, shift, 0.0);
    const auto b = wheelset_kinematics(swapped, swapped_track, -shift, 0.0);
    REQUIRE(a.status == TouchStatus::touching);
    CHECK(a.rolling_radius_difference() == Approx(-b.rolling_radius_difference()));
    CHECK(a.roll == Approx(-b.roll));
    // The smaller left wheel lets the axle lean: 1 mm over 1.5 m.
    CHECK(a.roll < -5e-4);
    // Without roll each side is that of a wheelset with two such wheels.
    const auto c = wheelset_kinematics(mixed, mixed_track, shift, 0.0, no_roll);
    const auto left = wheelset_kinematics(Wheelset<Profile1>(worn, worn, 1.5),
                                          HeadTrack(rail, {1.435, 0.025}), shift, 0.0, no_roll);
    const auto right =
        wheelset_kinematics(Wheelset<Profile1>(conical, conical, 1.5),
                            HeadTrack(other_rail, {1.435, 0.025}), shift, 0.0, no_roll);
    CHECK(c.wheels[0].contact().rolling_radius == left.wheels[0].contact().rolling_radius);
    CHECK(c.wheels[1].contact().rolling_radius == right.wheels[1].contact().rolling_radius);
    CHECK(c.roll == 0.0);
  }
}

TEST_CASE("wheelset_kinematics: all places within the closeness are listed, nearest first",
          "[wheelset]") {
  // 0.226 mm and 4.992 mm: two of the jumps of S1002 on 60E1 1:40. Off them the second place is a
  // little above the rail.
  int two = 0;
  for (const double shift : {0.00021, 0.00495, 0.00499, 0.00503}) {
    const KinematicsOptions<double> options{.closeness = 1e-5};
    const auto at = wheelset_kinematics(wheelset_1002(), track_60e1(), shift, 0.0, options);
    REQUIRE(at.status == TouchStatus::touching);
    for (const auto& wheel : at.wheels) {
      CHECK(std::abs(wheel.contact().penetration) < 64 * 2.3e-16 * 0.46);
      for (std::size_t i = 1; i < wheel.patches.size(); ++i) {
        CHECK(wheel.patches[i].penetration <= wheel.patches[i - 1].penetration);
        CHECK(wheel.patches[i].penetration > -1e-5);
        ++two;
      }
    }
    const auto alone =
        wheelset_kinematics(wheelset_1002(), track_60e1(), shift, 0.0, {.closeness = 1e-9});
    CHECK(alone.wheels[0].patches.size() == 1);
    CHECK(alone.height == Approx(at.height).epsilon(1e-14));
  }
  CHECK(two >= 2);
}

TEST_CASE("wheelset_kinematics: what cannot be set down has a status", "[wheelset][bad-input]") {
  const auto status_at = [](double shift, double yaw = 0.0) {
    return wheelset_kinematics(wheelset_1002(), track_60e1(), shift, yaw).status;
  };
  CHECK(status_at(std::nan("")) == TouchStatus::not_finite);
  CHECK(status_at(0.0, std::nan("")) == TouchStatus::not_finite);
  CHECK(status_at(10.0) != TouchStatus::touching);
  CHECK(status_at(-10.0) != TouchStatus::touching);
  // A tread that ends over the middle of the head, and rises to its end.
  const Profile1 stub({Piece::line(-0.07, 0.001, 0.0, 0.0, 0.3)});
  const Wheelset<Profile1> short_wheels(stub, 0.46, 1.5);
  const auto at = wheelset_kinematics(short_wheels, track_60e1(), 0.0);
  CHECK(at.status == TouchStatus::profile_end);
  CHECK(wheelset_kinematics(wheelset_1002(), track_60e1(), 0.003, 0.0, {.maximum_iterations = 2})
            .status == TouchStatus::not_converged);
  for (const auto status :
       {TouchStatus::touching, TouchStatus::no_contact, TouchStatus::profile_end,
        TouchStatus::not_converged, TouchStatus::not_finite, TouchStatus::bad_options}) {
    CHECK(std::string(name_of(status)) != "unknown");
  }
}

TEST_CASE("wheelset_kinematics: an option that breaks its rule has a status",
          "[wheelset][bad-input]") {
  const double nan = std::nan("");
  for (const KinematicsOptions<double>& options : {KinematicsOptions<double>{.closeness = 0.0},
                                                   {.closeness = nan},
                                                   {.closeness = -1e-6},
                                                   {.closeness = 1 / 0.0},
                                                   {.tolerance = -1e-9},
                                                   {.tolerance = nan},
                                                   {.maximum_iterations = 0},
                                                   {.maximum_iterations = -1}}) {
    const auto at = wheelset_kinematics(wheelset_1002(), track_60e1(), 0.003, 0.0, options);
    CHECK(at.status == TouchStatus::bad_options);
    CHECK(at.wheels[0].status == TouchStatus::bad_options);
    CHECK(at.wheels[1].status == TouchStatus::bad_options);
    CHECK(at.lateral_shift == 0.003);
  }
}

TEST_CASE("wheelset_kinematics: a scalar that converts to nothing, to the last bit",
          "[wheelset][autodiff]") {
  using S = wheelrail_test::StrictScalar;
  const Wheelset<PiecewiseProfile<S>> wheelset(s1002<S>(), S(0.46), S(1.5));
  const TangentTrack<RailHead<S>> track(rail_60e1<S>(), {S(1.435), S(0.025)});
  const auto at = wheelset_kinematics(wheelset, track, S(0.0031));
  const auto expected = wheelset_kinematics(wheelset_1002(), track_60e1(), 0.0031);
  REQUIRE(at.status == TouchStatus::touching);
  CHECK(at.roll.as_double() == expected.roll);
  CHECK(at.height.as_double() == expected.height);
  CHECK(gravitational_stiffness(at, wheelset_kinematics(wheelset, track, S(0.003)), S(1e5))
            .as_double() > 0);
}

TEST_CASE("wheelset_kinematics: in single precision it touches to its rounding", "[wheelset]") {
  const Wheelset<PiecewiseProfile<float>> wheelset(s1002<float>(), 0.46F, 1.5F);
  const TangentTrack<RailHead<float>> track(rail_60e1<float>(), {1.435F, 0.05F});
  const HeadTrack precise(rail_60e1<double>(), {1.435, 0.05});
  const auto at = wheelset_kinematics(wheelset, track, 0.002F);
  REQUIRE(at.status == TouchStatus::touching);
  CHECK(static_cast<double>(at.height) ==
        Approx(wheelset_kinematics(wheelset_1002(), precise, 0.002).height).margin(5e-6));
}

TEST_CASE("wheelset_kinematics: does not allocate", "[wheelset][no-alloc]") {
  const auto& wheelset = wheelset_1002();
  const auto& track = track_60e1();
  const auto before = wheelrail_test::allocations_so_far();
  const auto at = wheelset_kinematics(wheelset, track, 0.003);
  CHECK(wheelrail_test::allocations_so_far() == before);
  CHECK(at.status == TouchStatus::touching);
}
