#include <random>
#include <wheelrail/contact/locus.hpp>
#include <wheelrail/profile/s1002.hpp>

#include "support/catch.hpp"
#include "support/numeric_difference.hpp"

using namespace wheelrail;

namespace {

WheelPlacement<double> placement_of(Side side, double yaw, double roll) {
  WheelPlacement<double> placement;
  placement.side = side;
  placement.position_rail = Vector3<double>(0.2, 0.003, 0.43);
  placement.sin_yaw = std::sin(yaw);
  placement.cos_yaw = std::cos(yaw);
  placement.tan_yaw = placement.sin_yaw / placement.cos_yaw;
  placement.sin_roll = std::sin(roll);
  placement.cos_roll = std::cos(roll);
  return placement;
}

PiecewiseProfile<double> cone(double slope) {
  return PiecewiseProfile<double>({ProfilePiece<double>::line(-0.05, 0.05, 0.0, 0.0, slope)});
}

// One lateral position in each section of the S1002 but the steep back, H to A [m].
constexpr double laterals[] = {-0.055, -0.045, -0.039, -0.037, -0.03, -0.01, 0.0, 0.02, 0.05};

}  // namespace

TEST_CASE("locus_point: the wheel's normal lies in the rail's section", "[contact][random]") {
  const Wheel wheel(s1002<double>(), 0.43);
  std::mt19937_64 generator(8);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 100; ++i) {
    const auto placement = placement_of(i % 2 == 0 ? Side::left : Side::right,
                                        0.05 * uniform(generator), 0.06 * uniform(generator));
    for (const double u : laterals) {
      const auto at = wheel.profile().evaluate(u);
      const auto locus = locus_point(wheel, placement, u, at);
      REQUIRE(locus.exists);
      const auto normal_rail = placement.direction_rail(wheel.normal_wheel(at, locus.angle));
      CHECK(std::abs(normal_rail.x()) < 1e-15);
      // The locus' coordinates are those of its point on the wheel's surface.
      const Vector3<double> point_rail =
          placement.position_rail +
          placement.direction_rail(wheel.position_wheel(u, at, locus.angle));
      CHECK(std::abs(point_rail.x() - placement.position_rail.x() - locus.along_rail) < 1e-15);
      CHECK(std::abs(point_rail.y() - locus.lateral) < 1e-15);
      CHECK(std::abs(point_rail.z() - locus.up) < 1e-15);
    }
  }
}

TEST_CASE("locus_point: angle and offset are the paper's (57), (59) on both sides",
          "[contact][reference]") {
  const Wheel wheel(s1002<double>(), 0.43);
  for (const double yaw : {-0.03, 0.0, 0.02}) {
    for (const Side side : sides) {
      for (const double u : laterals) {
        const auto at = wheel.profile().evaluate(u);
        const auto locus = locus_point(wheel, placement_of(side, yaw, 0.01), u, at);
        // The paper's ordinate f_w is minus the radius; x is forwards on both sides, and the rail
        // frame's x backwards on the right one.
        const double f = -(0.43 + at.value), slope = -at.slope;
        CHECK(std::abs(std::asin(locus.angle.sine) - std::asin(-std::tan(yaw) * slope)) < 1e-15);
        const double paper =
            side == Side::left ? -(f * slope + u) * std::sin(yaw) : (u + f * slope) * std::sin(yaw);
        CHECK(std::abs(outboard_sign<double>(side) * locus.along_rail - paper) < 1e-15);
      }
    }
  }
}

TEST_CASE("locus_point: a yawed cylinder and a yawed cone have their closed forms",
          "[contact][reference]") {
  for (const double yaw : {-0.03, 0.02}) {
    const auto placement = placement_of(Side::left, yaw, 0.0);
    for (const double u : {-0.04, 0.0, 0.03}) {
      const Wheel cylinder(cone(0.0), 0.46);
      const auto on_cylinder = locus_point(cylinder, placement, u, cylinder.profile().evaluate(u));
      CHECK(on_cylinder.angle.sine == 0.0);
      CHECK(std::abs(on_cylinder.along_rail + u * std::sin(yaw)) < 1e-16);
      const double k = -0.05;
      const Wheel wheel(cone(k), 0.46);
      const auto on_cone = locus_point(wheel, placement, u, wheel.profile().evaluate(u));
      CHECK(std::abs(on_cone.angle.sine - k * std::tan(yaw)) < 1e-16);
      const double offset = (u * (1 + k * k) + k * 0.46) * std::sin(yaw);
      CHECK(std::abs(on_cone.along_rail + offset) < 1e-16);
    }
  }
}

TEST_CASE("locus_point: the rates are those of differences", "[contact][reference]") {
  const Wheel wheel(s1002<double>(), 0.43);
  for (const double yaw : {-0.03, 0.0, 0.05}) {
    const auto placement = placement_of(Side::left, yaw, -0.05);
    for (const double u : laterals) {
      CAPTURE(yaw, u);
      const auto at = [&](double x) {
        return locus_point(wheel, placement, x, wheel.profile().evaluate(x));
      };
      const double y =
          wheelrail_test::central_difference([&](double x) { return at(x).lateral; }, u, 2e-5);
      const double z =
          wheelrail_test::central_difference([&](double x) { return at(x).up; }, u, 2e-5);
      CHECK(std::abs(at(u).lateral_rate - y) < 5e-8);
      CHECK(std::abs(at(u).up_rate - z) < 5e-8);
    }
  }
}

TEST_CASE("locus_point: there is none where the slope outruns the yaw", "[contact]") {
  const Wheel wheel(cone(2.0), 0.46);
  const auto at = wheel.profile().evaluate(0.01);
  CHECK(locus_point(wheel, placement_of(Side::left, std::atan(0.499), 0), 0.01, at).exists);
  CHECK(!locus_point(wheel, placement_of(Side::left, std::atan(0.501), 0), 0.01, at).exists);
  CHECK(!locus_point(wheel, placement_of(Side::right, std::atan(-0.501), 0), 0.01, at).exists);
  auto bad = placement_of(Side::left, 0.0, 0.0);
  bad.sin_yaw = bad.tan_yaw = std::nan("");
  CHECK(!locus_point(wheel, bad, 0.01, at).exists);
}

TEST_CASE("locus_point: no neighbour on the wheel lies further out, seen along the rail",
          "[contact][reference]") {
  const Wheel wheel(s1002<double>(), 0.43);
  const auto placement = placement_of(Side::left, 0.03, -0.05);
  for (const double u : laterals) {
    CAPTURE(u);
    const auto at = wheel.profile().evaluate(u);
    const auto locus = locus_point(wheel, placement, u, at);
    const Vector3<double> out = placement.direction_rail(wheel.normal_wheel(at, locus.angle));
    const double angle = std::asin(locus.angle.sine);
    // A concave profile lies outside its tangent by F'' du^2 / 2 at most: that is allowed for.
    double furthest = -1.0;
    for (int i = -40; i <= 40; ++i) {
      for (int k = -40; k <= 40; ++k) {
        const double du = 2.5e-6 * k;
        const auto near = wheel.profile().evaluate(u + du);
        const Vector3<double> p =
            placement.position_rail + placement.direction_rail(wheel.position_wheel(
                                          u + du, near, WheelAngle<double>::of(angle + 5e-4 * i)));
        const double beyond = out.y() * (p.y() - locus.lateral) + out.z() * (p.z() - locus.up);
        const double bulge = std::max(0.0, 0.6 * at.second_derivative * du * du);
        furthest = std::max(furthest, beyond - bulge);
      }
    }
    // Of the same strip, the locus point itself is the furthest.
    CHECK(furthest < 1e-13);
  }
}
