#include "vehicle.hpp"

#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace examples {

namespace {

class VehicleBuilder {
 public:
  using Vector = wheelrail::Vector3<double>;

  explicit VehicleBuilder(const VehicleData& data) : data_(data) {}

  [[nodiscard]] Vehicle build(VehicleKind kind) {
    vehicle_.wheel_radius = data_.positive("wheel radius");
    if (data_.has("wheel flange back to back")) {
      vehicle_.profile_spacing = data_.positive("wheel flange back to back") +
                                 2 * data_.positive("tread circle to flange back");
    }
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
    return add_body(name, data_.positive(mass),
                    Vector(data_.positive(inertia + " Ixx"), data_.positive(inertia + " Iyy"),
                           data_.positive(inertia + " Izz")),
                    position);
  }

  int add_body(const std::string& name, double mass, const Vector& moments,
               const Vector& position) {
    vehicle_.model.bodies.emplace_back(mass, moments);
    vehicle_.names.push_back(name);
    vehicle_.positions.push_back(position);
    return static_cast<int>(vehicle_.names.size()) - 1;
  }

  // A wheelset and its axlebox body, of masses and inertias of their own or, where the data give the
  // boxes' share of the wheelset, with the sums that the data have for the wheelset. All of its Iyy
  // spins; that of the boxes comes on top, but the suspension has no moment to turn them by.
  std::array<int, 2> add_wheelset(const std::string& name, const Vector& centre) {
    const std::string share_name = "axlebox body share of the wheelset";
    if (!data_.has(share_name)) {
      const int wheelset = add_body(name + " wheelset", "wheelset mass", "wheelset", centre);
      return {wheelset,
              add_body(name + " axlebox", "axlebox body mass (both boxes of one wheelset)",
                       "axlebox body", centre)};
    }
    const double share = data_.positive(share_name);
    if (!(share < 1)) {
      throw std::invalid_argument("'" + share_name + "' is " + std::to_string(share) +
                                  ", but must be < 1");
    }
    const double mass = data_.positive("wheelset mass");
    const Vector moments(data_.positive("wheelset Ixx"), data_.positive("wheelset Iyy"),
                         data_.positive("wheelset Izz"));
    const Vector rest((1 - share) * moments.x(), moments.y(), (1 - share) * moments.z());
    const int wheelset = add_body(name + " wheelset", (1 - share) * mass, rest, centre);
    return {wheelset, add_body(name + " axlebox", share * mass, share * moments, centre)};
  }

  // A spring-damper with the coefficients `name` kx .. cz and a vertical preload on b. Springs in
  // series are in series with the dampers alone, beside the suspension's springs.
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
      const std::string series = name + " damper series k" + axes[i] + " " + per;
      if (data_.has(series)) {
        element.series_stiffness_a(static_cast<Eigen::Index>(i)) = data_.positive(series);
      }
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
      const auto [wheelset, box] = add_wheelset(which, centre);
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
    for (const char* name :
         {"anti-roll bar stiffness per bogie", "secondary bending stiffness per side"}) {
      if (!data_.has(name)) continue;
      const double sides = std::string_view(name).ends_with("side") ? 2 : 1;
      vehicle_.model.torsion_springs.push_back({frame, carbody, sides * data_.positive(name)});
    }
    using wheelrail::Characteristic;
    const std::string force = "lateral bump stop force", rod = "traction rod";
    if (const auto table = data_.table(force); !table.empty()) {
      auto stop = between(frame, carbody, x, data_.positive("lateral bump stop height above rail"));
      stop.spring[1] = Characteristic<double>::odd_table(table, force);
      vehicle_.model.spring_dampers.push_back(stop);
    }
    if (data_.has(rod + " stiffness")) {
      auto element = between(frame, carbody, x, data_.positive(rod + " height above rail"));
      element.spring[0] =
          Characteristic<double>::linear(data_[rod + " stiffness"], rod + " stiffness");
      element.damper[0] = Characteristic<double>::linear(data_[rod + " damping"], rod + " damping");
      vehicle_.model.spring_dampers.push_back(element);
    }
  }

  // An element without springs yet, in the middle plane at that height above the rails.
  [[nodiscard]] wheelrail::SpringDamper<double> between(int a, int b, double x,
                                                        double height) const {
    wheelrail::SpringDamper<double> element;
    const Vector place(x, 0, height);
    element.a = a;
    element.point_a = place - vehicle_.positions[static_cast<std::size_t>(a)];
    element.b = b;
    element.point_b = place - vehicle_.positions[static_cast<std::size_t>(b)];
    return element;
  }

  const VehicleData& data_;
  Vehicle vehicle_;
};

}  // namespace

Vehicle build_vehicle(const VehicleData& data, VehicleKind kind) {
  return VehicleBuilder(data).build(kind);
}

}  // namespace examples
