#pragma once
// A bogie of five bodies and a vehicle of eleven (§6.2, §6.3 of the paper): wheelsets, axlebox bodies
// on revolute joints, frames on the primary and a carbody on the secondary suspension. Where the
// data have them: an anti-roll bar, the bending of the secondary springs, a lateral bump stop and a
// traction rod for each bogie, and springs in series with the dampers.

#include <algorithm>
#include <string>
#include <vector>
#include <wheelrail/dynamics/multibody_system.hpp>

#include "vehicle_data.hpp"

namespace examples {

enum class VehicleKind { bogie, vehicle };

// The model and where its bodies stand on a straight, level track, the vehicle's middle at x = 0.
struct Vehicle {
  wheelrail::MultibodyModel<double> model;
  std::vector<std::string> names;                     // of the bodies
  std::vector<wheelrail::Vector3<double>> positions;  // of their centres of mass [m]
  std::vector<int> wheelsets;                         // their indices, from the leading one
  double wheel_radius = 0;                            // [m]
  double profile_spacing = 1.5;                       // between the wheels' tread circles [m]
};

// Throws std::invalid_argument where the data lack a quantity or have one out of its range.
[[nodiscard]] Vehicle build_vehicle(const VehicleData& data, VehicleKind kind);

// How far the rearmost body's centre of mass is behind the vehicle's middle [m].
[[nodiscard]] inline double overhang(const Vehicle& vehicle) {
  double rear = 0;
  for (const auto& position : vehicle.positions) rear = std::max(rear, -position.x());
  return rear;
}

}  // namespace examples
