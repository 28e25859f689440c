#pragma once
// The paper's first case, a wheelset on a tangent track: its data, its start, and its run with the
// integrator that comes with wheelrail, against which other simulators are compared. C++17.

#include <Eigen/Core>
#include <vector>

namespace examples {

// The wheelset as a rigid body, and its start in the track frame. The body's frame is that of its
// principal axes, y along the axle to the left.
struct WheelsetBody {
  double mass;              // [kg]
  Eigen::Vector3d inertia;  // principal moments about the centre of mass, the axle's middle [kg m2]
  double gravity;           // downwards [m/s2]
  Eigen::Vector3d centre_track;            // [m]
  Eigen::Matrix3d axes_track;              // its columns are the body's axes
  Eigen::Vector3d velocity_track;          // [m/s]
  Eigen::Vector3d angular_velocity_track;  // [rad/s]
};

[[nodiscard]] WheelsetBody wheelset_at_start();

// The lateral shift [m] at `interval` 0, 1, 2, ... `count` [s]. `tolerance` is the integrator's,
// relative and absolute. Throws std::runtime_error where the run does not come to its end.
[[nodiscard]] std::vector<double> embedded_lateral_shifts(double interval, int count,
                                                          double tolerance);

}  // namespace examples
