#include <Eigen/Geometry>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/wheelset/wheelset.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

TEST_CASE("axle_direction: Rz(yaw) Rx(roll) e_y", "[wheelset]") {
  const double roll = 0.3, yaw = -0.2;
  const Eigen::Vector3d expected =
      Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
      (Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()) * Eigen::Vector3d::UnitY());
  CHECK((axle_direction(roll, yaw) - expected).norm() < 1e-15);
  CHECK(axle_direction(0.01, 0.0).z() > 0);  // roll lifts the left wheel
  CHECK(axle_direction(0.0, 0.01).x() < 0);  // yaw to the left takes the left wheel back
}

TEST_CASE("Wheelset: the wheels' origins lie on the axle, profile_spacing apart", "[wheelset]") {
  const Wheelset wheelset(s1002<double>(), 0.43, 1.5);
  const auto at = WheelsetPosition<double>::of(0.002, 0.43, 0.01, 0.02);
  const auto left = wheelset.wheel_track(Side::left, at);
  const auto right = wheelset.wheel_track(Side::right, at);
  CHECK((left - right - 1.5 * at.axle_track).norm() < 1e-15);
  CHECK(((left + right) / 2 - at.position_track).norm() < 1e-15);
  CHECK(left.y() > right.y());
}

TEST_CASE("Wheelset: wheels of their own on either side", "[wheelset]") {
  const Wheelset wheelset(Wheel(s1002<double>(), 0.46), Wheel(s1002<double>(), 0.459), 1.5);
  CHECK(wheelset.wheel(Side::left).nominal_radius() == 0.46);
  CHECK(wheelset.wheel(Side::right).nominal_radius() == 0.459);
}

TEST_CASE("Wheelset: bad dimensions are named", "[wheelset][bad-input]") {
  using Catch::Matchers::ContainsSubstring;
  CHECK_THROWS_WITH(Wheelset(s1002<double>(), 0.43, -1.5), ContainsSubstring("profile spacing") &&
                                                               ContainsSubstring("-1.5") &&
                                                               ContainsSubstring("> 0"));
  CHECK_THROWS_WITH(Wheelset(s1002<double>(), -0.43, 1.5),
                    ContainsSubstring("nominal radius") && ContainsSubstring("-0.43"));
  CHECK_THROWS_WITH(Wheelset(s1002<double>(), 0.43, std::nan("")), ContainsSubstring("nan"));
}
