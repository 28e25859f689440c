#include <array>
#include <cmath>
#include <limits>
#include <vector>
#include <wheelrail/dynamics/linearize.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

using V3 = Vector3<double>;
using System = MultibodySystem<double>;
using Coordinates = std::vector<BodyDisplacement>;
using enum Displacement;

const Coordinates all_six{{0, x}, {0, y}, {0, z}, {0, roll}, {0, pitch}, {0, yaw}};

Eigen::VectorXd at_rest(const System& system) {
  Eigen::VectorXd state = Eigen::VectorXd::Zero(system.state_size());
  for (std::size_t i = 0; i < system.body_count(); ++i) {
    state(RigidBodyLayout::offset(static_cast<Eigen::Index>(i)) + RigidBodyLayout::orientation) = 1;
  }
  return state;
}

Linearization<double> linearized(const System& system, const Coordinates& coordinates,
                                 const LinearizationOptions<double>& options = {}) {
  const std::vector<Wrench<double>> none(system.body_count());
  return linearize(
      system, at_rest(system), coordinates, [&](const Eigen::VectorXd&) { return none; }, options);
}

std::vector<Eigenmode<double>> modes_of(const Linearization<double>& system) {
  const auto found = eigenmodes(system);
  REQUIRE(found.status == SolveStatus::converged);
  return found.modes;
}

double hertz(double square_of_angular_frequency) {
  return std::sqrt(square_of_angular_frequency) / (2 * pi<double>());
}

constexpr double mass = 500, half_length = 0.9, half_width = 0.4, height = 0.3;
constexpr double kx = 3e4, ky = 1e4, kz = 2e4;
const V3 moments(100, 120, 150);

// A mass on four springs at its corners, which carry its weight `height` below its centre.
MultibodyModel<double> table() {
  MultibodyModel<double> model;
  model.bodies.emplace_back(mass, moments);
  for (const double along : {half_length, -half_length}) {
    for (const double across : {half_width, -half_width}) {
      SpringDamper<double> s;
      s.b = 0;
      s.point_a = s.point_b = V3(along, across, -height);
      s.preload_a.z() = mass * 9.81 / 4;
      const std::array stiffness{kx, ky, kz};
      for (std::size_t i = 0; i < 3; ++i) {
        s.spring[i] = Characteristic<double>::linear(stiffness[i]);
      }
      model.spring_dampers.push_back(s);
    }
  }
  return model;
}

// A mass in z on the ground or on the body before it.
MultibodyModel<double> chain(const std::vector<double>& masses, double stiffness, double damping,
                             double series_stiffness = 0) {
  MultibodyModel<double> model;
  model.gravity_world.setZero();
  for (std::size_t i = 0; i < masses.size(); ++i) {
    model.bodies.emplace_back(masses[i], V3(1, 1, 1));
    SpringDamper<double> s;
    s.a = static_cast<int>(i) - 1;
    s.b = static_cast<int>(i);
    s.spring[2] = Characteristic<double>::linear(stiffness);
    s.damper[2] = Characteristic<double>::linear(damping);
    s.series_stiffness_a.z() = series_stiffness;
    model.spring_dampers.push_back(s);
  }
  return model;
}

}  // namespace

TEST_CASE("linearize: a mass on four springs has the stiffness of its springs and its weight",
          "[dynamics][linearize][reference]") {
  const auto system = linearized(System(table()), all_six);
  CHECK(system.residual < 1e-12);
  CHECK(system.coordinate_count == 6);
  CHECK(system.elongation_count == 0);
  REQUIRE(system.state_matrix.rows() == 12);
  REQUIRE(system.state_matrix.cols() == 12);
  // Springs `height` below the centre couple y with roll and x with pitch; the weight on them tilts
  // the mass further.
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(6, 6);
  const double weight = mass * 9.81;
  k.diagonal() << 4 * kx, 4 * ky, 4 * kz,
      4 * kz * half_width * half_width + 4 * ky * height * height - weight * height,
      4 * kz * half_length * half_length + 4 * kx * height * height - weight * height,
      4 * kx * half_width * half_width + 4 * ky * half_length * half_length;
  k(1, 3) = k(3, 1) = 4 * ky * height;
  k(0, 4) = k(4, 0) = -4 * kx * height;
  Eigen::VectorXd m(6);
  m << mass, mass, mass, moments;
  const Eigen::MatrixXd expected = -(m.cwiseInverse().asDiagonal() * k);
  const Eigen::MatrixXd found = system.acceleration_by_displacement();
  // Rounding: accelerations of 10 m/s2 over 6e-6 m.
  CHECK((found - expected).cwiseAbs().maxCoeff() < 1e-7);
  CHECK(system.acceleration_by_velocity().cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("eigenmodes: a mass on four springs bounces, pitches and rolls as its closed form",
          "[dynamics][linearize][reference]") {
  const System system(table());
  const double weight = mass * 9.81;
  const auto one = [&](Displacement direction) {
    const auto modes = modes_of(linearized(system, {{0, direction}}));
    REQUIRE(modes.size() == 1);
    CHECK(std::abs(modes[0].damping_ratio) < 1e-8);
    CHECK(modes[0].shape(0) == 1.0);
    return modes[0].frequency;
  };
  CHECK(one(z) == Approx(hertz(4 * kz / mass)).epsilon(1e-8));
  CHECK(one(roll) == Approx(hertz((4 * kz * half_width * half_width + 4 * ky * height * height -
                                   weight * height) /
                                  moments.x()))
                         .epsilon(1e-8));
  CHECK(one(pitch) == Approx(hertz((4 * kz * half_length * half_length + 4 * kx * height * height -
                                    weight * height) /
                                   moments.y()))
                          .epsilon(1e-8));
  CHECK(one(yaw) ==
        Approx(hertz((4 * kx * half_width * half_width + 4 * ky * half_length * half_length) /
                     moments.z()))
            .epsilon(1e-8));
}

TEST_CASE("eigenmodes: a damped oscillator has its frequency and its damping ratio",
          "[dynamics][linearize][reference]") {
  const double m = 2, k = 800, natural = 20;
  for (const double ratio : {0.05, 0.4, 0.9}) {
    const System system(chain({m}, k, 2 * ratio * natural * m));
    const auto modes = modes_of(linearized(system, {{0, z}}));
    REQUIRE(modes.size() == 1);
    CHECK(modes[0].frequency == Approx(natural / (2 * pi<double>())).epsilon(1e-8));
    CHECK(modes[0].damping_ratio == Approx(ratio).epsilon(1e-8));
    CHECK(modes[0].eigenvalue.imag() ==
          Approx(natural * std::sqrt(1 - ratio * ratio)).epsilon(1e-8));
    const auto free = modes_of(undamped(linearized(system, {{0, z}})));
    CHECK(free[0].frequency == Approx(natural / (2 * pi<double>())).epsilon(1e-8));
    CHECK(std::abs(free[0].damping_ratio) < 1e-12);
  }
  // Beyond critical damping it creeps: two real eigenvalues whose product is the natural one's
  // square.
  const System slow(chain({m}, k, 2 * 1.25 * natural * m));
  const auto creeping = modes_of(linearized(slow, {{0, z}}));
  REQUIRE(creeping.size() == 2);
  CHECK(creeping[0].eigenvalue.real() == Approx(-natural / 2));
  CHECK(creeping[1].eigenvalue.real() == Approx(-natural * 2));
  for (const auto& mode : creeping) CHECK(mode.damping_ratio == 1.0);
}

TEST_CASE("eigenmodes: two equal masses on equal springs have the golden ratio",
          "[dynamics][linearize][reference]") {
  const double m = 3, k = 1200, golden = (1 + std::sqrt(5.0)) / 2;
  const auto modes = modes_of(linearized(System(chain({m, m}, k, 0)), {{0, z}, {1, z}}));
  REQUIRE(modes.size() == 2);
  CHECK(modes[0].frequency == Approx(std::sqrt(k / m) / golden / (2 * pi<double>())).epsilon(1e-8));
  CHECK(modes[1].frequency == Approx(std::sqrt(k / m) * golden / (2 * pi<double>())).epsilon(1e-8));
  CHECK(std::abs(modes[0].shape(0) - 1 / golden) < 1e-8);
  CHECK(modes[0].shape(1) == 1.0);
  CHECK(modes[1].shape(0) == 1.0);
  CHECK(std::abs(modes[1].shape(1) + 1 / golden) < 1e-8);
}

TEST_CASE("eigenmodes: a series spring's elongation is a third state of the oscillator",
          "[dynamics][linearize][reference]") {
  const double m = 2, k = 800, c = 60, series = 1500;
  const System system(chain({m}, k, c, series));
  const auto linear = linearized(system, {{0, z}});
  CHECK(linear.elongation_count == 1);
  Eigen::Matrix3d expected;
  expected << 0, 1, 0, -k / m, 0, -series / m, 0, 1, -series / c;
  CHECK((linear.state_matrix - expected).cwiseAbs().maxCoeff() < 1e-7);
  const auto modes = modes_of(linear);
  REQUIRE(modes.size() == 2);
  for (const auto& mode : modes) {
    // m s^2 + k + series s / (s + series / c) = 0
    const auto s = mode.eigenvalue;
    CHECK(std::abs(m * s * s + k + series * s / (s + series / c)) < 1e-6 * k);
  }
  // Without the damper nothing is left of its series spring.
  const auto free = undamped(linear);
  CHECK(free.elongation_count == 0);
  CHECK(modes_of(free)[0].frequency == Approx(hertz(k / m)).epsilon(1e-8));
}

TEST_CASE("eigenmodes: a pendulum on a joint swings; the joint adds Baumgarte's eigenvalues",
          "[dynamics][linearize][reference]") {
  const double length = 0.8, m = 4, inertia = 0.3;
  MultibodyModel<double> model;
  model.bodies.emplace_back(m, V3(0.3, inertia, 0.3));
  model.joints.emplace_back(ground_body, V3(0, 0, length), V3(0, 1, 0), 0, V3(0, 0, length),
                            V3(0, 1, 0));
  model.baumgarte_alpha = 3;
  model.baumgarte_beta = 50;
  const auto modes = modes_of(linearized(System(model), all_six));
  int swings = 0, constraints = 0;
  for (const auto& mode : modes) {
    if (mode.frequency == Approx(50 / (2 * pi<double>())).epsilon(1e-6)) {
      CHECK(mode.damping_ratio == Approx(3.0 / 50).epsilon(1e-5));
      ++constraints;
    } else {
      CHECK(mode.frequency ==
            Approx(hertz(m * 9.81 * length / (inertia + m * length * length))).epsilon(1e-7));
      CHECK(std::abs(mode.damping_ratio) < 1e-7);
      CHECK(std::abs(mode.shape(4) / mode.shape(0) + 1 / length) < 1e-6);
      ++swings;
    }
  }
  CHECK(swings == 1);
  CHECK(constraints == 5);
}

TEST_CASE("linearize: external wrenches take part, and a body left out is held",
          "[dynamics][linearize]") {
  const double m = 3, k = 1200, ground = 500, brake = 7;
  const System system(chain({m, m}, k, 0));
  const auto wrenches = [&](const Eigen::VectorXd& state) {
    std::vector<Wrench<double>> loads(2);
    const Eigen::Index top = RigidBodyLayout::offset(1);
    loads[1].force_world.z() =
        -ground * state(top + 2) - brake * state(top + RigidBodyLayout::velocity_world + 2);
    return loads;
  };
  const auto linear = linearize(system, at_rest(system), Coordinates{{1, z}}, wrenches);
  REQUIRE(linear.coordinate_count == 1);
  CHECK(linear.acceleration_by_displacement()(0, 0) == Approx(-(k + ground) / m).epsilon(1e-8));
  CHECK(linear.acceleration_by_velocity()(0, 0) == Approx(-brake / m).epsilon(1e-8));
}

TEST_CASE("linearize: nothing sensible, nothing finite, nothing at all",
          "[dynamics][linearize][bad-input]") {
  using Catch::Matchers::ContainsSubstring;
  const System system(table());
  CHECK_THROWS_WITH(linearized(system, {{0, z}, {1, z}}),
                    ContainsSubstring("coordinates[1].body is 1"));
  CHECK_THROWS_WITH(linearized(system, {{0, z}, {0, x}, {0, z}}),
                    ContainsSubstring("coordinates[2] is coordinates[0] again"));
  CHECK_THROWS_WITH(linearized(system, all_six, {.displacement = 0}),
                    ContainsSubstring("displacement is 0"));
  CHECK_THROWS_WITH(linearized(system, all_six, {.velocity = -1}),
                    ContainsSubstring("velocity is -1"));

  const std::vector<Wrench<double>> none(1);
  const auto about = [&](const Eigen::VectorXd& state, const Coordinates& coordinates) {
    return linearize(system, state, coordinates, [&](const Eigen::VectorXd&) { return none; });
  };
  Eigen::VectorXd turning = at_rest(system);
  turning(RigidBodyLayout::angular_velocity_body + 1) = 40;
  CHECK_THROWS_WITH(about(turning, {{0, z}, {0, yaw}}),
                    ContainsSubstring("coordinates[1] is a rotation"));
  CHECK(about(turning, {{0, z}}).state_matrix.rows() == 2);

  Eigen::VectorXd broken = at_rest(system);
  broken(3) = std::numeric_limits<double>::quiet_NaN();
  const auto lost = about(broken, all_six);
  CHECK_FALSE(is_finite(lost.residual));
  CHECK(eigenmodes(lost).status == SolveStatus::not_finite);
  CHECK(eigenmodes(lost).modes.empty());

  const auto empty = linearized(system, {});
  CHECK(empty.state_matrix.size() == 0);
  CHECK(eigenmodes(empty).modes.empty());
}
