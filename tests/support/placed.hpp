#pragma once
// Placements of a wheel for tests.

#include <cmath>
#include <wheelrail/contact/placement.hpp>

namespace wheelrail_test {

// A left wheel by the position of its profile's origin and its angles in the rail frame [m], [rad].
[[nodiscard]] inline wheelrail::WheelPlacement<double> placed(double lateral, double up, double yaw,
                                                              double roll) {
  wheelrail::WheelPlacement<double> placement;
  placement.position_rail = {0, lateral, up};
  placement.sin_yaw = std::sin(yaw);
  placement.cos_yaw = std::cos(yaw);
  placement.tan_yaw = std::tan(yaw);
  placement.sin_roll = std::sin(roll);
  placement.cos_roll = std::cos(roll);
  return placement;
}

}  // namespace wheelrail_test
