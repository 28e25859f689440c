#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>
#include <wheelrail/dynamics/static_equilibrium.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

using V3 = Vector3<double>;
using Load = Wrench<double>;
using System = MultibodySystem<double>;
using enum Displacement;

constexpr double stiffness = 2e4, half_length = 0.6, half_width = 0.4, mass = 500;

// A mass on four springs at its corners.
MultibodyModel<double> table() {
  MultibodyModel<double> model;
  model.bodies.emplace_back(mass, V3(100, 120, 150));
  for (const double x : {half_length, -half_length}) {
    for (const double y : {half_width, -half_width}) {
      SpringDamper<double> s;
      s.b = 0;
      s.point_a = s.point_b = V3(x, y, 0);
      s.spring.fill(Characteristic<double>::linear(stiffness));
      model.spring_dampers.push_back(s);
    }
  }
  return model;
}

Eigen::VectorXd at_origin(std::size_t bodies) {
  Eigen::VectorXd y(RigidBodyLayout::offset(static_cast<Eigen::Index>(bodies)));
  for (std::size_t i = 0; i < bodies; ++i) {
    y.segment<13>(RigidBodyLayout::offset(static_cast<Eigen::Index>(i))) =
        pack(RigidBodyState<double>{});
  }
  return y;
}

const std::vector<BodyDisplacement> all_six{{0, x},    {0, y},     {0, z},
                                            {0, roll}, {0, pitch}, {0, yaw}};

// A wheel's contact in the vertical: nothing above the rail, Hertz below.
struct Contact {
  double stiffness = 1e11;
  [[nodiscard]] double force(double depth) const {
    return depth < 0 ? 0.0 : stiffness * depth * std::sqrt(depth);
  }
};

}  // namespace

TEST_CASE("displaced: along the world's axes, about the body's", "[dynamics][static_equilibrium]") {
  Eigen::VectorXd state = at_origin(2);
  state.segment<4>(13 + 3) = euler_parameters_from_axis_angle(V3(0, 0, 1), pi<double>() / 2);
  const Eigen::VectorXd shifted = displaced(state, {1, Displacement::y}, 0.25);
  CHECK((shifted - state).norm() == 0.25);
  CHECK(shifted(14) == 0.25);
  const auto rolled = unpack_rigid_body(displaced(state, {1, roll}, pi<double>() / 2), 1);
  // The body's x axis is the world's y: its y axis, the world's -x, turns upwards.
  CHECK((rotation_matrix(rolled.orientation) * V3(0, 1, 0) - V3(0, 0, 1)).norm() < 1e-15);
}

TEST_CASE("static_equilibrium: a mass sinks by its weight over the stiffness",
          "[dynamics][static_equilibrium][reference]") {
  const System system(table());
  const std::vector<Load> none(1);
  const auto result = static_equilibrium(system, at_origin(1), all_six,
                                         [&](const Eigen::VectorXd&) { return none; });
  CHECK(result.status == SolveStatus::converged);
  CHECK(result.residual <= EquilibriumOptions<double>{}.tolerance);
  CHECK(result.state(2) == Approx(-mass * 9.81 / (4 * stiffness)).epsilon(1e-8));
  CHECK(result.iterations < 20);
}

TEST_CASE("static_equilibrium: a load off the middle tilts the mass",
          "[dynamics][static_equilibrium][reference]") {
  auto model = table();
  model.gravity_world = V3(0, 0, 0);
  const System system(model);
  // Small enough for the linear solution.
  const std::vector<Load> load{{V3(0, 0, -1.0), V3(-0.2, 0.3, 0)}};
  const auto result = static_equilibrium(system, at_origin(1), all_six,
                                         [&](const Eigen::VectorXd&) { return load; });
  REQUIRE(result.status == SolveStatus::converged);
  const auto state = unpack_rigid_body(result.state);
  const double rolled = -0.2 / (4 * stiffness * half_width * half_width);
  const double pitched = 0.3 / (4 * stiffness * half_length * half_length);
  CHECK(state.position_world.z() == Approx(-1.0 / (4 * stiffness)).epsilon(1e-4));
  CHECK(2 * state.orientation(1) == Approx(rolled).epsilon(1e-4));
  CHECK(2 * state.orientation(2) == Approx(pitched).epsilon(1e-4));
}

TEST_CASE("static_equilibrium: a wheel above its rail falls on it and carries its box",
          "[dynamics][static_equilibrium]") {
  // Wheelset and axlebox on a joint, a mass on a spring above; only the contact holds them up.
  MultibodyModel<double> model;
  model.bodies.emplace_back(1000.0, V3(600, 80, 600));
  model.bodies.emplace_back(160.0, V3(110, 5, 110));
  model.bodies.emplace_back(2000.0, V3(1200, 1100, 2200));
  model.joints.emplace_back(0, V3(0, 0, 0), V3(0, 1, 0), 1, V3(0, 0, 0), V3(0, 1, 0));
  SpringDamper<double> spring;
  spring.a = 1;
  spring.b = 2;
  spring.spring[2] = Characteristic<double>::linear(9e5);
  model.spring_dampers.push_back(spring);
  const System system(model);
  const double height = 1e-3;  // above the rail
  const Contact contact;
  const auto wrenches = [&](const Eigen::VectorXd& y) {
    std::vector<Load> loads(3);
    loads[0].force_world.z() = contact.force(-height - y(2));
    return loads;
  };
  const std::vector<BodyDisplacement> coordinates{{0, z}, {1, z}, {2, z}};
  const auto result = static_equilibrium(system, at_origin(3), coordinates, wrenches);
  CAPTURE(result.iterations, result.residual, name_of(result.status));
  REQUIRE(result.status == SolveStatus::converged);
  const double weight = 3160 * 9.81;
  CHECK(contact.force(-height - result.state(2)) == Approx(weight).epsilon(1e-7));
  CHECK(result.state(15) == Approx(result.state(2)).margin(1e-9));  // the joint stays closed
  CHECK(result.state(28) - result.state(15) == Approx(-2000 * 9.81 / 9e5).epsilon(1e-7));
}

TEST_CASE("static_equilibrium: nothing to rest on, nothing finite, nothing sensible",
          "[dynamics][static_equilibrium][bad-input]") {
  using Catch::Matchers::ContainsSubstring;
  auto model = table();
  model.spring_dampers.clear();
  const System falling(model), system(table());
  const std::vector<Load> none(1);
  const auto no_load = [&](const Eigen::VectorXd&) { return none; };
  const auto fell = static_equilibrium(falling, at_origin(1), all_six, no_load);
  CHECK(fell.status == SolveStatus::iteration_limit);
  CHECK(fell.iterations == EquilibriumOptions<double>{}.maximum_iterations);
  CHECK(fell.residual == Approx(9.81));

  Eigen::VectorXd broken = at_origin(1);
  broken(3) = std::numeric_limits<double>::quiet_NaN();
  CHECK(static_equilibrium(system, broken, all_six, no_load).status == SolveStatus::not_finite);

  const auto with = [&](const std::vector<BodyDisplacement>& coordinates,
                        const EquilibriumOptions<double>& options) {
    return static_equilibrium(system, at_origin(1), coordinates, no_load, options);
  };
  CHECK_THROWS_WITH(with({{0, z}, {1, z}}, {}), ContainsSubstring("coordinates[1].body is 1"));
  CHECK_THROWS_WITH(with(all_six, {.tolerance = 0}), ContainsSubstring("tolerance is 0"));
  CHECK_THROWS_WITH(with(all_six, {.difference = -1}), ContainsSubstring("difference is -1"));
  CHECK_THROWS_WITH(with(all_six, {.first_time = 0}), ContainsSubstring("first_time is 0"));
  CHECK_THROWS_WITH(with(all_six, {.maximum_iterations = 0}),
                    ContainsSubstring("maximum_iterations is 0"));
}

TEMPLATE_TEST_CASE("static_equilibrium: other scalars", "[dynamics][static_equilibrium]", float,
                   long double) {
  using T = TestType;
  MultibodyModel<T> model;
  model.bodies.emplace_back(T(2), Vector3<T>(T(1), T(1), T(1)));
  SpringDamper<T> spring;
  spring.b = 0;
  spring.spring[2] = Characteristic<T>::linear(T(100));
  model.spring_dampers.push_back(spring);
  const MultibodySystem<T> system(model);
  const std::vector<Wrench<T>> none(1);
  const std::vector<BodyDisplacement> vertical{{0, z}};
  const auto result = static_equilibrium(system, pack(RigidBodyState<T>{}), vertical,
                                         [&](const Vector13<T>&) { return none; });
  CHECK(result.status == SolveStatus::converged);
  CHECK(static_cast<double>(result.state(2)) == Approx(-0.1962).epsilon(1e-4));
}
