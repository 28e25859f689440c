#include <Eigen/Geometry>
#include <random>
#include <wheelrail/contact/placement.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

RailFrame<double> frame_of(Side side, double lean) {
  const double s = outboard_sign<double>(side);
  RailFrame<double> frame;
  frame.side = side;
  frame.origin_track = Vector3<double>(0.0, s * 0.75, -0.01);
  frame.axes_track << s, 0, 0, 0, s * std::cos(lean), -s * std::sin(lean), 0, std::sin(lean),
      std::cos(lean);
  frame.inclination = lean;
  return frame;
}

// Rz(yaw) Rx(roll) e_y, to the field side.
Vector3<double> axle_of(Side side, double yaw, double roll) {
  const Vector3<double> left(-std::sin(yaw) * std::cos(roll), std::cos(yaw) * std::cos(roll),
                             std::sin(roll));
  return outboard_sign<double>(side) * left;
}

}  // namespace

TEST_CASE("place_wheel: the wheel's axes are Rx(roll) Rz(yaw) in the rail frame",
          "[contact][random]") {
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const Side side = i % 2 == 0 ? Side::left : Side::right;
    const auto frame = frame_of(side, 0.05 * uniform(generator));
    const Vector3<double> axle_track =
        axle_of(side, 0.2 * uniform(generator), 0.1 * uniform(generator));
    const Vector3<double> wheel_track(uniform(generator), uniform(generator), uniform(generator));
    const auto placement = place_wheel(frame, wheel_track, axle_track);
    const Eigen::Matrix3d axes = (Eigen::AngleAxisd(placement.roll(), Eigen::Vector3d::UnitX()) *
                                  Eigen::AngleAxisd(placement.yaw(), Eigen::Vector3d::UnitZ()))
                                     .toRotationMatrix();
    for (int k = 0; k < 3; ++k) {
      const Vector3<double> unit = Vector3<double>::Unit(k);
      CHECK((placement.direction_rail(unit) - axes.col(k)).norm() < 1e-15);
    }
    // The wheel's y axis is the axle, its z axis has no part along the rail (49).
    const Vector3<double> y_rail = placement.direction_rail(Vector3<double>::UnitY());
    CHECK((frame.direction_track(y_rail) - axle_track).norm() < 1e-15);
    CHECK(placement.direction_rail(Vector3<double>::UnitZ()).x() == 0.0);
    CHECK((frame.position_track(placement.position_rail) - wheel_track).norm() < 1e-15);
    CHECK(std::abs(placement.sin_yaw * placement.sin_yaw + placement.cos_yaw * placement.cos_yaw -
                   1) < 1e-15);
    CHECK(placement.inclination == frame.inclination);
    CHECK(placement.side == side);
  }
}

TEST_CASE("place_wheel: yaw is to the left and roll rises outwards, on both sides", "[contact]") {
  for (const Side side : sides) {
    const auto frame = frame_of(side, 0.0);
    const auto placement =
        place_wheel(frame, Vector3<double>(0, 0, 0.43), axle_of(side, 0.02, 0.0));
    CHECK(std::abs(placement.yaw() - 0.02) < 1e-15);
    CHECK(std::abs(placement.roll()) < 1e-15);
    // A wheelset that leans to the right lifts its left wheel.
    const auto leaning = place_wheel(frame, Vector3<double>(0, 0, 0.43), axle_of(side, 0.0, 0.003));
    CHECK(std::abs(leaning.roll() - outboard_sign<double>(side) * 0.003) < 1e-15);
    // A rail leaning inwards by 1/20: the axle falls outwards in its frame.
    const auto inclined = place_wheel(frame_of(side, std::atan(0.05)), Vector3<double>(0, 0, 0.43),
                                      axle_of(side, 0.0, 0.0));
    CHECK(std::abs(inclined.roll() + std::atan(0.05)) < 1e-15);
    CHECK(inclined.yaw() == 0.0);
  }
}

TEST_CASE("place_wheel: the mirrored wheelset has the mirrored placement, bit for bit",
          "[contact][symmetry]") {
  std::mt19937_64 generator(6);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 100; ++i) {
    const double lean = 0.05 * uniform(generator), yaw = 0.03 * uniform(generator),
                 roll = 0.01 * uniform(generator);
    const Vector3<double> wheel_track(uniform(generator), 0.75 + 0.01 * uniform(generator), 0.43);
    const auto left =
        place_wheel(frame_of(Side::left, lean), wheel_track, axle_of(Side::left, yaw, roll));
    const auto right =
        place_wheel(frame_of(Side::right, lean),
                    Vector3<double>(wheel_track.x(), -wheel_track.y(), wheel_track.z()),
                    axle_of(Side::right, -yaw, -roll));
    CHECK(left.position_rail.x() == -right.position_rail.x());
    CHECK(left.position_rail.y() == right.position_rail.y());
    CHECK(left.position_rail.z() == right.position_rail.z());
    CHECK(left.sin_yaw == -right.sin_yaw);
    CHECK(left.cos_yaw == right.cos_yaw);
    CHECK(left.sin_roll == right.sin_roll);
    CHECK(left.cos_roll == right.cos_roll);
  }
}

TEST_CASE("place_wheel: an axle along the rail gives NaN", "[contact][bad-input]") {
  const auto placement = place_wheel(frame_of(Side::left, 0.0), Vector3<double>(0, 0.75, 0.43),
                                     Vector3<double>(1, 0, 0));
  CHECK(std::isnan(placement.sin_roll));
  CHECK(std::isnan(placement.cos_roll));
}
