#pragma once
// A bogie of five bodies and a vehicle of eleven (§6.2, §6.3 of the paper): wheelsets, axlebox bodies
// on revolute joints, frames on the primary and a carbody on the secondary suspension.

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
};

namespace detail {

class VehicleBuilder {
 public:
  using Vector = wheelrail::Vector3<double>;

  explicit VehicleBuilder(const VehicleData& data) : data_(data) {}

  [[nodiscard]] Vehicle build(VehicleKind kind) {
    vehicle_.wheel_radius = data_.positive("wheel radius");
    if (kind == VehicleKind::bogie) {
      add_bogie("", 0, 0);
      return std::move(vehicle_);
    }
    const double half = data_.positive("bogie spacing") / 2;
    const double carried = data_.positive("carbody mass") / 2;
    const int front = add_bogie("front ", half, carried);
    const int rear = add_bogie("rear ", -half, carried);
    const double height = data_.positive("carbody centre of mass height");
    const int carbody = add_body("carbody", "carbody mass", "carbody", Vector(0, 0, height));
    add_secondary(front, carbody, half);
    add_secondary(rear, carbody, -half);
    return std::move(vehicle_);
  }

 private:
  static constexpr double gravity = 9.81;  // [m/s2], as MultibodyModel's

  int add_body(const std::string& name, const std::string& mass, const std::string& inertia,
               const Vector& position) {
    vehicle_.model.bodies.emplace_back(
        data_.positive(mass),
        Vector(data_.positive(inertia + " Ixx"), data_.positive(inertia + " Iyy"),
               data_.positive(inertia + " Izz")));
    vehicle_.names.push_back(name);
    vehicle_.positions.push_back(position);
    return static_cast<int>(vehicle_.names.size()) - 1;
  }

  // A spring-damper with the coefficients `name` kx .. cz and a vertical preload on b.
  void add_suspension(const std::string& name, const std::string& per, int a, const Vector& point_a,
                      int b, const Vector& point_b, double preload) {
    wheelrail::SpringDamper<double> element;
    element.a = a;
    element.point_a = point_a;
    element.b = b;
    element.point_b = point_b;
    element.preload_a = Vector(0, 0, preload);
    const char* axes[] = {"x", "y", "z"};
    for (std::size_t i = 0; i < 3; ++i) {
      using wheelrail::Characteristic;
      const auto coefficient = [&](const char* letter) {
        const std::string quantity = name + " " + letter + axes[i] + " " + per;
        return Characteristic<double>::linear(data_[quantity], quantity);
      };
      element.spring[i] = coefficient("k");
      element.damper[i] = coefficient("c");
    }
    vehicle_.model.spring_dampers.push_back(element);
  }

  // A frame with two wheelsets and their axleboxes; returns the frame's index.
  int add_bogie(const std::string& name, double x, double carried_mass) {
    const double half_base = data_.positive("bogie wheelbase") / 2;
    const double radius = vehicle_.wheel_radius;
    const double height = data_.positive("bogie frame centre of mass height");
    const double load =
        (data_.positive("bogie frame mass") + carried_mass) * gravity / 4;  // per axlebox
    std::vector<int> boxes;
    for (const double offset : {half_base, -half_base}) {
      const std::string which = name + (offset > 0 ? "leading" : "trailing");
      const Vector centre(x + offset, 0, radius);
      const int wheelset = add_body(which + " wheelset", "wheelset mass", "wheelset", centre);
      const int box = add_body(which + " axlebox", "axlebox body mass (both boxes of one wheelset)",
                               "axlebox body", centre);
      vehicle_.wheelsets.push_back(wheelset);
      boxes.push_back(box);
      vehicle_.model.joints.emplace_back(wheelset, Vector::Zero(), Vector::UnitY(), box,
                                         Vector::Zero(), Vector::UnitY());
    }
    const int frame =
        add_body(name + "bogie frame", "bogie frame mass", "bogie frame", Vector(x, 0, height));
    const double half_width = data_.positive("primary lateral semi-distance");
    for (std::size_t i = 0; i < 2; ++i) {
      for (const double side : {1.0, -1.0}) {
        // In the frame's axes, acting at the axle's height: no moment turns the axlebox.
        add_suspension("primary", "per box", frame,
                       Vector(i == 0 ? half_base : -half_base, side * half_width, radius - height),
                       boxes[i], Vector(0, side * half_width, 0), -load);
      }
    }
    return frame;
  }

  void add_secondary(int frame, int carbody, double x) {
    const double half_width = data_.positive("secondary lateral semi-distance");
    const double height = data_.positive("secondary height above rail");
    const double load = data_.positive("carbody mass") * gravity / 4;
    const auto at = [&](int body) { return vehicle_.positions[static_cast<std::size_t>(body)]; };
    for (const double side : {1.0, -1.0}) {
      add_suspension("secondary", "per side", frame,
                     Vector(0, side * half_width, height - at(frame).z()), carbody,
                     Vector(x, side * half_width, height - at(carbody).z()), load);
    }
  }

  const VehicleData& data_;
  Vehicle vehicle_;
};

}  // namespace detail

// Throws std::invalid_argument where the data lack a quantity or have one out of its range.
[[nodiscard]] inline Vehicle build_vehicle(const VehicleData& data, VehicleKind kind) {
  return detail::VehicleBuilder(data).build(kind);
}

}  // namespace examples
