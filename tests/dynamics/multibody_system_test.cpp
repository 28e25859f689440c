#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>
#include <wheelrail/dynamics/multibody_system.hpp>
#include <wheelrail/numerics/elliptic_integral.hpp>
#include <wheelrail/numerics/integrate.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"

using namespace wheelrail;

namespace {

using V3 = Vector3<double>;
using V4 = Vector4<double>;
using State = RigidBodyState<double>;
using Load = Wrench<double>;
using System = MultibodySystem<double>;
using Model = MultibodyModel<double>;
using C = Characteristic<double>;

constexpr Eigen::Index velocity_rows = RigidBodyLayout::velocity_world;

class Random {
 public:
  double operator()() { return uniform_(engine_); }
  V3 vector() { return V3((*this)(), (*this)(), (*this)()); }
  V4 orientation() { return V4(1.0, 0.2 * (*this)(), 0.2 * (*this)(), 0.2 * (*this)()); }

 private:
  std::mt19937_64 engine_{20240705};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

Eigen::VectorXd packed(const std::vector<State>& states, Eigen::Index internal = 0) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(
      RigidBodyLayout::offset(static_cast<Eigen::Index>(states.size())) + internal);
  for (std::size_t i = 0; i < states.size(); ++i) {
    y.segment<13>(RigidBodyLayout::offset(static_cast<Eigen::Index>(i))) = pack(states[i]);
  }
  return y;
}

using Observe = std::function<void(double, const Eigen::VectorXd&)>;

// Integrates without external wrenches and hands every report to the observer. No template, so that
// the integrator is compiled once.
Eigen::VectorXd simulate(const System& system, const Eigen::VectorXd& start, double t_end,
                         double interval, double tolerance, const Observe& observe) {
  const std::vector<Load> none(system.body_count());
  const auto result =
      integrate([&](double, const Eigen::VectorXd& y) { return system.rate(y, none); }, 0.0, start,
                t_end, interval, {.relative_tolerance = tolerance, .absolute_tolerance = tolerance},
                [&](double t, const Eigen::VectorXd& y) {
                  observe(t, y);
                  return true;
                });
  REQUIRE(result.status == IntegrationStatus::finished);
  return result.state;
}

// (93), (94) as they stand: one dense system for all bodies and joints, multipliers of redundant rows zero.
// The forces come from the same model without joints.
Eigen::VectorXd dense_accelerations(const System& system, const Eigen::VectorXd& y,
                                    std::span<const Load> external) {
  Model free = system.model();
  const auto joints = std::exchange(free.joints, {});
  const Eigen::VectorXd free_rate = System(free).rate(y, external);
  const auto n = static_cast<Eigen::Index>(system.body_count());
  const auto m = static_cast<Eigen::Index>(joints.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(6 * n + 5 * m, 6 * n + 5 * m);
  Eigen::VectorXd rhs(6 * n + 5 * m);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto mass = mass_diagonal(free.bodies[static_cast<std::size_t>(i)]);
    matrix.block<6, 6>(6 * i, 6 * i) = mass.asDiagonal();
    rhs.segment<6>(6 * i) =
        mass.cwiseProduct(free_rate.segment<6>(RigidBodyLayout::offset(i) + velocity_rows));
  }
  for (Eigen::Index k = 0; k < m; ++k) {
    const auto& joint = joints[static_cast<std::size_t>(k)];
    const auto motion = [&](int body) {
      return body == ground_body ? BodyMotion<double>{} : body_motion(unpack_rigid_body(y, body));
    };
    const auto [a, b] = joint.bodies();
    const auto e = joint.equations(motion(a), motion(b));
    for (std::size_t side = 0; side < 2; ++side) {
      const int body = joint.bodies()[side];
      if (body == ground_body) continue;
      matrix.block<5, 6>(6 * n + 5 * k, 6 * body) = e.jacobians[side];
      matrix.block<6, 5>(6 * body, 6 * n + 5 * k) = e.jacobians[side].transpose();
    }
    rhs.segment<5>(6 * n + 5 * k) = e.gamma - 2 * 5.0 * e.residual_rate - 5.0 * 5.0 * e.residual;
  }
  Eigen::FullPivLU<Eigen::MatrixXd> solver;
  solver.setThreshold(1e-13);
  const Eigen::VectorXd solution = solver.compute(matrix).solve(rhs);
  return solution.head(6 * n);
}

// The greatest difference of the accelerations, over the greatest acceleration.
double difference_from_dense(const System& system, const Eigen::VectorXd& y,
                             std::span<const Load> external) {
  const Eigen::VectorXd expected = dense_accelerations(system, y, external);
  const Eigen::VectorXd rate = system.rate(y, external);
  double worst = 0;
  for (Eigen::Index i = 0; i < expected.size() / 6; ++i) {
    const Vector6<double> found = rate.segment<6>(RigidBodyLayout::offset(i) + velocity_rows);
    worst = std::fmax(worst, (found - expected.segment<6>(6 * i)).cwiseAbs().maxCoeff());
  }
  return worst / expected.cwiseAbs().maxCoeff();
}

SpringDamper<double> suspension(int a, const V3& point_a, int b, const V3& point_b,
                                const V3& stiffness, const V3& damping) {
  SpringDamper<double> e;
  e.a = a;
  e.b = b;
  e.point_a = point_a;
  e.point_b = point_b;
  for (Eigen::Index i = 0; i < 3; ++i) {
    e.spring[static_cast<std::size_t>(i)] = C::linear(stiffness(i));
    e.damper[static_cast<std::size_t>(i)] = C::linear(damping(i));
  }
  return e;
}

// A trailer of eleven bodies: car body 0; frames 1 and 2; wheelsets 3 to 6; axleboxes 7 to 10.
// The magnitudes are those of a light metro vehicle.
struct Trailer {
  Model model;
  std::vector<V3> positions;
};

// The axleboxes' joints lie in both bodies' centres of mass, or off them.
Trailer trailer(const V3& joint_a = V3::Zero(), const V3& joint_b = V3::Zero()) {
  Trailer t;
  const auto add = [&t](double mass, const V3& moments, const V3& position) {
    t.model.bodies.emplace_back(mass, moments);
    t.positions.push_back(position);
  };
  add(20e3, V3(32e3, 420e3, 420e3), V3(0, 0, 1.45));
  for (const double x : {5.55, -5.55}) add(2e3, V3(1200, 1100, 2200), V3(x, 0, 0.5));
  const double axles[] = {6.6, 4.5, -4.5, -6.6};
  for (const double x : axles) add(1e3, V3(600, 80, 600), V3(x, 0, 0.43));
  for (const double x : axles) add(160, V3(110, 5, 110), V3(x, 0, 0.43));
  const V3 y(0, 1, 0);
  for (int i = 0; i < 4; ++i) {
    t.model.joints.emplace_back(3 + i, joint_a, y, 7 + i, joint_b, y);
    const int frame = 1 + i / 2;
    const double x = i % 2 == 0 ? 1.05 : -1.05;
    for (const double side : {0.95, -0.95}) {
      auto primary = suspension(7 + i, V3(0, side, 0), frame, V3(x, side, -0.07), V3(6e6, 4e6, 9e5),
                                V3(6e3, 4e3, 6e3));
      primary.preload_a.z() = 30e3;
      t.model.spring_dampers.push_back(primary);
    }
  }
  for (int frame = 1; frame <= 2; ++frame) {
    for (const double side : {0.95, -0.95}) {
      auto secondary =
          suspension(frame, V3(0, side, 0.25), 0, V3(frame == 1 ? 5.55 : -5.55, side, -0.7),
                     V3(130e3, 130e3, 330e3), V3(8e3, 20e3, 15e3));
      secondary.preload_a.z() = 49e3;
      secondary.series_stiffness_a = V3(0, 6e6, 6e6);
      t.model.spring_dampers.push_back(secondary);
    }
    t.model.torsion_springs.push_back({.a = frame, .b = 0, .stiffness = 9e5, .damping = 1e3});
  }
  return t;
}

// Near its place, everything moves and nothing fits exactly.
Eigen::VectorXd disturbed(const Trailer& t, Random& random) {
  std::vector<State> states;
  for (const V3& position : t.positions) {
    states.push_back({V3(position + 0.01 * random.vector()), random.orientation(),
                      V3(V3(18, 0, 0) + random.vector()), random.vector()});
  }
  Eigen::VectorXd y = packed(states, 8);
  for (Eigen::Index i = 0; i < 8; ++i) y(y.size() - 1 - i) = 1e-3 * random();
  return y;
}

// A planar four-bar linkage in a plane of any orientation `turn`: ground, crank, coupler, rocker.
struct FourBar {
  static constexpr double ground = 2.0, crank = 0.6, coupler = 1.7, rocker = 1.5;
  V4 turn;
  Model model;
  Eigen::VectorXd start;

  // Crank's end and rocker's end in the plane, from the crank's angle: circles that meet above.
  static std::pair<Eigen::Vector2d, Eigen::Vector2d> closure(double angle) {
    const Eigen::Vector2d b = crank * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d to_ground = Eigen::Vector2d(ground, 0) - b;
    const double distance = to_ground.norm();
    const double along =
        (coupler * coupler - rocker * rocker + distance * distance) / (2 * distance);
    const double height = std::sqrt(coupler * coupler - along * along);
    const Eigen::Vector2d e = to_ground / distance;
    return {b, b + along * e + height * Eigen::Vector2d(-e.y(), e.x())};
  }
  [[nodiscard]] V3 in_world(const Eigen::Vector2d& v) const {
    return rotation_matrix(turn) * V3(v.x(), 0, v.y());
  }
  // A bar from one point to another: its x axis along it.
  [[nodiscard]] State bar(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
    State s;
    s.position_world = in_world((from + to) / 2);
    s.orientation =
        euler_product(turn, euler_parameters_from_axis_angle(
                                V3(0, -1, 0), std::atan2(to.y() - from.y(), to.x() - from.x())));
    return s;
  }
  explicit FourBar(const V4& turn_) : turn(turn_) {
    const V3 normal(0, 1, 0), world_normal = rotation_matrix(turn) * normal;
    const auto end = [](double length) { return V3(length / 2, 0, 0); };
    for (const double length : {crank, coupler, rocker}) {
      const double mass = 3 * length, inertia = mass * length * length / 12;
      model.bodies.emplace_back(mass, V3(0.01 * mass, inertia, inertia));
    }
    model.joints.emplace_back(ground_body, V3(0, 0, 0), world_normal, 0, V3(-end(crank)), normal);
    model.joints.emplace_back(0, end(crank), normal, 1, V3(-end(coupler)), normal);
    model.joints.emplace_back(1, end(coupler), normal, 2, end(rocker), normal);
    model.joints.emplace_back(2, V3(-end(rocker)), normal, ground_body,
                              in_world(Eigen::Vector2d(ground, 0)), world_normal);
    model.gravity_world = rotation_matrix(turn) * V3(0, 0, -9.81);
    const auto [b, c] = closure(1.3);
    start =
        packed({bar(Eigen::Vector2d::Zero(), b), bar(b, c), bar(Eigen::Vector2d(ground, 0), c)});
  }
};

}  // namespace

TEST_CASE("MultibodySystem: a pendulum swings with the period of the elliptic integral",
          "[dynamics][multibody_system][reference]") {
  const double mass = 3, inertia = 0.4, length = 0.8, amplitude = 2.0;
  Model model;
  model.bodies.emplace_back(mass, V3(0.3, inertia, 0.5));
  model.joints.emplace_back(ground_body, V3(1, 2, 3), V3(0, 2, 0), 0, V3(0, 0, length),
                            V3(0, 1, 0));
  const System system(model);
  State start;
  start.orientation = euler_parameters_from_axis_angle(V3(0, 1, 0), amplitude);
  start.position_world = V3(1, 2, 3) - rotation_matrix(start.orientation) * V3(0, 0, length);
  const double rate = std::sqrt(mass * 9.81 * length / (inertia + mass * length * length));
  const double period = 4 * complete_elliptic(std::cos(amplitude / 2)).first / rate;
  int quarters = 0;
  double worst = 0, drift = 0;
  simulate(system, packed({start}), 5 * period, period / 4, 1e-11,
           [&](double, const Eigen::VectorXd& y) {
             const State s = unpack_rigid_body(y);
             const double expected[] = {amplitude, 0, -amplitude, 0};
             const double angle = 2 * std::atan2(s.orientation(2), s.orientation(0));
             worst = std::fmax(worst, std::fabs(angle - expected[quarters++ % 4]));
             drift = std::fmax(drift, system.constraint_violation(y).residual);
           });
  CHECK(quarters == 21);
  CHECK(worst < 1e-9);
  CHECK(drift < 1e-11);
}

TEST_CASE("MultibodySystem: a hanging pendulum's joint bears its weight",
          "[dynamics][multibody_system]") {
  Model model;
  model.bodies.emplace_back(3.0, V3(1, 1, 1));
  model.joints.emplace_back(ground_body, V3(0, 0, 0), V3(0, 1, 0), 0, V3(0, 0, 0.5), V3(0, 1, 0));
  const System system(model);
  State hanging;
  hanging.position_world.z() = -0.5;
  const std::vector<Load> push{{V3(0, 7, 0), V3(0, 0, 2)}};
  const Load reaction = system.reaction_on_b(packed({hanging}), push, 0);
  CHECK((reaction.force_world - V3(0, -7, 3 * 9.81)).norm() < 1e-12);
  CHECK((reaction.moment_world - V3(0, 0, -2)).norm() < 1e-12);
  CHECK(system.rate(packed({hanging}), push).tail<6>().norm() < 1e-12);
  CHECK(system.potential_energy(packed({hanging})) == Approx(-3 * 9.81 * 0.5));
}

TEST_CASE("MultibodySystem: a four-bar linkage closes its loop as the circles meet",
          "[dynamics][multibody_system][reference]") {
  // 20 constraints of rank 17; the crank swings through most of a turn.
  const FourBar linkage(unit_euler_parameters(V4(0.8, 0.3, -0.4, 0.2)));
  const System system(linkage.model);
  Eigen::VectorXd y = linkage.start;
  const V3 axis_world = rotation_matrix(linkage.turn) * V3(0, 1, 0);
  CHECK(system.constraint_violation(y).residual < 1e-15);
  const double energy = system.potential_energy(y) + system.kinetic_energy(y);
  double worst = 0, drift = 0, worst_energy = 0, worst_dense = 0, worst_plane = 0;
  double least = 10, most = -10;
  const std::vector<Load> none(3);
  simulate(system, y, 10.0, 0.01, 1e-10, [&](double, const Eigen::VectorXd& at) {
    const State crank = unpack_rigid_body(at, 0), coupler = unpack_rigid_body(at, 1),
                rocker = unpack_rigid_body(at, 2);
    const V4 p = euler_product(euler_conjugate(linkage.turn), crank.orientation);
    const double angle = -2 * std::atan2(p(2), p(0));
    least = std::fmin(least, angle);
    most = std::fmax(most, angle);
    const auto [b, c] = FourBar::closure(angle);
    const Eigen::Vector2d d(FourBar::ground, 0);
    worst = std::fmax(worst, (crank.position_world - linkage.in_world(b / 2)).norm());
    worst = std::fmax(worst, (coupler.position_world - linkage.in_world((b + c) / 2)).norm());
    worst = std::fmax(worst, (rocker.position_world - linkage.in_world((c + d) / 2)).norm());
    worst_plane = std::fmax(worst_plane, std::fabs(axis_world.dot(coupler.position_world)));
    drift = std::fmax(drift, system.constraint_violation(at).residual);
    worst_energy = std::fmax(
        worst_energy, std::fabs(system.potential_energy(at) + system.kinetic_energy(at) - energy));
    worst_dense = std::fmax(worst_dense, difference_from_dense(system, at, none));
  });
  CHECK(most - least > 6.0);
  CHECK(worst < 1e-9);
  CHECK(worst_plane < 1e-13);
  CHECK(drift < 1e-9);
  CHECK(worst_energy < 1e-6);  // of 20 J
  CHECK(worst_dense < 1e-10);
}

TEST_CASE("MultibodySystem: a double pendulum out of its plane keeps its energy and its joints",
          "[dynamics][multibody_system]") {
  Model model;
  model.bodies.emplace_back(2.0, V3(0.1, 0.15, 0.08));
  model.bodies.emplace_back(1.0, V3(0.05, 0.06, 0.04));
  const V3 skew(0.3, 1, -0.2);
  model.joints.emplace_back(ground_body, V3(0, 0, 0), V3(0, 1, 0), 0, V3(0, 0, 0.5), V3(0, 1, 0));
  model.joints.emplace_back(0, V3(0, 0.1, -0.5), skew, 1, V3(0, 0, 0.4), skew);
  const System system(model);
  State one, two;
  one.orientation = euler_parameters_from_axis_angle(V3(0, 1, 0), 2.0);
  one.position_world = rotation_matrix(one.orientation) * V3(0, 0, -0.5);
  two.orientation = one.orientation;
  two.position_world = point_position_world(one, V3(0, 0.1, -0.5)) +
                       rotation_matrix(two.orientation) * V3(0, 0, -0.4);
  const Eigen::VectorXd start = packed({one, two});
  REQUIRE(system.constraint_violation(start).residual < 1e-15);
  const double energy = system.potential_energy(start);
  for (const double tolerance : {1e-5, 1e-10}) {
    double worst_energy = 0, drift = 0, drift_rate = 0, fastest = 0;
    simulate(system, start, 10.0, 0.01, tolerance, [&](double, const Eigen::VectorXd& y) {
      const double kinetic = system.kinetic_energy(y);
      fastest = std::fmax(fastest, kinetic);
      worst_energy =
          std::fmax(worst_energy, std::fabs(kinetic + system.potential_energy(y) - energy));
      drift = std::fmax(drift, system.constraint_violation(y).residual);
      drift_rate = std::fmax(drift_rate, system.constraint_violation(y).residual_rate);
    });
    CAPTURE(tolerance, worst_energy, drift, drift_rate);
    CHECK(fastest > 10.0);
    CHECK(worst_energy < 3e2 * tolerance);
    CHECK(drift < 3 * tolerance);
    CHECK(drift_rate < 1e2 * tolerance);
  }
}

TEST_CASE("MultibodySystem: a violated constraint decays as Baumgarte says",
          "[dynamics][multibody_system][reference]") {
  // Phi'' + 10 Phi' + 25 Phi = 0 from rest: Phi_0 (1 + 5 t) exp(-5 t), whatever the motion is.
  Model model;
  model.bodies.emplace_back(2.0, V3(0.1, 0.15, 0.08));
  model.joints.emplace_back(ground_body, V3(0, 0, 0), V3(0, 1, 0), 0, V3(0, 0, 0.5), V3(0, 1, 0));
  const System system(model);
  State start;
  start.position_world = V3(0.3, 0.02, -0.4);
  const double first = system.constraint_violation(packed({start})).residual;
  CHECK(first == Approx(0.3));
  double worst = 0;
  simulate(system, packed({start}), 2.0, 0.05, 1e-10, [&](double t, const Eigen::VectorXd& y) {
    const double expected = first * (1 + 5 * t) * std::exp(-5 * t);
    worst = std::fmax(worst, std::fabs(system.constraint_violation(y).residual - expected));
  });
  CHECK(worst < 1e-8);
}

TEST_CASE("MultibodySystem: a trailer by its structure as by one dense system",
          "[dynamics][multibody_system][random]") {
  Random random;
  for (const V3& off_centre : {V3(0, 0, 0), V3(0.01, -0.02, 0.03)}) {
    const Trailer t = trailer(off_centre, V3(-off_centre));
    const System system(t.model);
    CHECK(system.state_size() == 11 * 13 + 8);
    CHECK(t.model.joints[0].is_centred() == (off_centre == V3::Zero()));
    double worst = 0;
    for (int i = 0; i < 50; ++i) {
      const Eigen::VectorXd y = disturbed(t, random);
      std::vector<Load> external(11);
      for (Load& load : external) load = {V3(1e4 * random.vector()), V3(1e3 * random.vector())};
      worst = std::fmax(worst, difference_from_dense(system, y, external));
    }
    CAPTURE(worst);
    CHECK(worst < 1e-12);
  }
}

TEST_CASE("MultibodySystem: a joint in the centres of mass as by one dense system",
          "[dynamics][multibody_system][random]") {
  Random random;
  const V3 centre(0, 0, 0), axis_a(0.3, 1, -0.2), axis_b(0.1, 1, 0.4);
  double worst = 0;
  for (int i = 0; i < 60; ++i) {
    // Two bodies in either order, or one on the ground, on either side.
    Model model;
    model.bodies = {{5.0, V3(1, 1.5, 2)}, {0.5, V3(0.3, 0.4, 0.2)}};
    static constexpr int bodies[][2] = {{0, 1}, {1, 0}, {ground_body, 0}, {1, ground_body}};
    const auto& [a, b] = bodies[i % 4];
    model.joints.emplace_back(a, centre, axis_a, b, centre, axis_b);
    REQUIRE(model.joints[0].is_centred());
    const System system(model);
    std::vector<State> states;
    for (int k = 0; k < 2; ++k) {
      states.push_back({random.vector(), random.orientation(), random.vector(), random.vector()});
    }
    const std::vector<Load> external{{random.vector(), random.vector()},
                                     {random.vector(), random.vector()}};
    worst = std::fmax(worst, difference_from_dense(system, packed(states), external));
  }
  CAPTURE(worst);
  CHECK(worst < 1e-12);
}

TEST_CASE("MultibodySystem: springs, dampers, roll bars and joints move no centre of mass",
          "[dynamics][multibody_system][random]") {
  // Joints too, where their points coincide: momentum, and angular momentum about the origin.
  Random random;
  Trailer t = trailer();
  t.model.gravity_world = V3(0, 0, 0);
  const System system(t.model);
  const std::vector<Load> none(11);
  for (int i = 0; i < 50; ++i) {
    Eigen::VectorXd y = disturbed(t, random);
    for (Eigen::Index k = 3; k < 7; ++k) {
      y.segment<3>(RigidBodyLayout::offset(k + 4)) = y.segment<3>(RigidBodyLayout::offset(k));
    }
    const Eigen::VectorXd rate = system.rate(y, none);
    V3 force(0, 0, 0), moment(0, 0, 0);
    double forces = 0;
    for (int k = 0; k < 11; ++k) {
      const auto& body = t.model.bodies[static_cast<std::size_t>(k)];
      const State s = unpack_rigid_body(y, k);
      const V3 f = body.mass() *
                   rate.segment<3>(RigidBodyLayout::offset(k) + RigidBodyLayout::velocity_world);
      const V3 w_rate =
          rate.segment<3>(RigidBodyLayout::offset(k) + RigidBodyLayout::angular_velocity_body);
      const V3& w = s.angular_velocity_body;
      force += f;
      moment +=
          cross(s.position_world, f) +
          rotation_matrix(s.orientation) * (body.moments_body().cwiseProduct(w_rate) +
                                            cross(w, V3(body.moments_body().cwiseProduct(w))));
      forces += f.norm();
    }
    CHECK(forces > 1e4);
    CHECK(force.norm() < 1e-13 * forces);
    CHECK(moment.norm() < 1e-12 * forces);
  }
}

TEST_CASE("MultibodySystem: energy goes where the dampers take it",
          "[dynamics][multibody_system][random]") {
  Random random;
  Trailer t = trailer();
  t.model.joints.clear();
  const System system(t.model);
  const std::vector<Load> none(11);
  const double h = 1e-6;
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd y = disturbed(t, random);
    const Eigen::VectorXd rate = system.rate(y, none);
    const auto energy = [&](double time) {
      const Eigen::VectorXd at = y + time * rate;
      return system.kinetic_energy(at) + system.potential_energy(at);
    };
    const double loss = system.dissipated_power(y);
    CHECK(loss > 1e3);
    CHECK((energy(h) - energy(-h)) / (2 * h) == Approx(-loss).epsilon(1e-4));
  }
}

TEST_CASE("MultibodySystem: a running trailer keeps its joints closed",
          "[dynamics][multibody_system]") {
  // On springs to the ground instead of rails, its wheelsets spinning, at the paper's tolerances.
  Trailer t = trailer();
  std::vector<State> states;
  for (const V3& position : t.positions) states.push_back({.position_world = position});
  for (int i = 0; i < 4; ++i) {
    for (const double side : {0.75, -0.75}) {
      auto rail =
          suspension(ground_body, V3(t.positions[static_cast<std::size_t>(3 + i)] + V3(0, side, 0)),
                     7 + i, V3(0, side, 0), V3(1e6, 1e6, 1e8), V3(1e4, 1e4, 1e5));
      rail.preload_a.z() = 35e3;
      t.model.spring_dampers.push_back(rail);
    }
    states[static_cast<std::size_t>(3 + i)].angular_velocity_body.y() = 42.0;
  }
  states[0].position_world.y() += 0.05;
  const System system(t.model);
  double drift = 0, drift_rate = 0, late_drift = 0;
  simulate(system, packed(states, 8), 10.0, 0.01, 1e-5, [&](double time, const Eigen::VectorXd& y) {
    const auto v = system.constraint_violation(y);
    drift = std::fmax(drift, v.residual);
    drift_rate = std::fmax(drift_rate, v.residual_rate);
    if (time > 5) late_drift = std::fmax(late_drift, v.residual);
  });
  CAPTURE(drift, drift_rate, late_drift);
  CHECK(drift < 1e-6);
  CHECK(late_drift < 1e-9);
  CHECK(drift_rate < 1e-5);
}

TEST_CASE("MultibodySystem: a mass on four springs has its eigenfrequencies",
          "[dynamics][multibody_system][reference]") {
  const double mass = 500, stiffness = 2e4, half = 0.6;
  Model model;
  model.bodies.emplace_back(mass, V3(100, 120, 150));
  for (const double x : {half, -half}) {
    for (const double side : {0.4, -0.4}) {
      auto s = suspension(ground_body, V3(x, side, 0), 0, V3(x, side, 0), V3(3e4, 2e4, stiffness),
                          V3(0, 0, 0));
      s.preload_a.z() = mass * 9.81 / 4;
      model.spring_dampers.push_back(s);
    }
  }
  const System system(model);
  const double bounce = std::sqrt(4 * stiffness / mass);
  const double pitch = std::sqrt(4 * stiffness * half * half / 120);
  const double yaw = std::sqrt(4 * (2e4 * half * half + 3e4 * 0.4 * 0.4) / 150);
  State start;
  start.position_world.z() = 0.1;
  double worst = 0;
  simulate(system, packed({start}), 3.0, 0.01, 1e-11, [&](double t, const Eigen::VectorXd& y) {
    worst = std::fmax(worst, std::fabs(y(2) - 0.1 * std::cos(bounce * t)));
  });
  CHECK(worst < 1e-9);
  start.position_world.z() = 0;
  const double small = 1e-5;
  start.orientation = V4(1, 0, small / 2, small / 2);
  double worst_pitch = 0, worst_yaw = 0;
  simulate(system, packed({start}), 1.0, 0.01, 1e-13, [&](double t, const Eigen::VectorXd& y) {
    const V4 p = unpack_rigid_body(y).orientation;
    worst_pitch = std::fmax(worst_pitch, std::fabs(2 * p(2) - small * std::cos(pitch * t)));
    worst_yaw = std::fmax(worst_yaw, std::fabs(2 * p(3) - small * std::cos(yaw * t)));
  });
  CHECK(worst_pitch < 1e-6 * small);
  CHECK(worst_yaw < 1e-6 * small);
}

TEST_CASE("MultibodySystem: a chain of more joints than fit, NaN, and nothing allocated",
          "[dynamics][multibody_system][bad-input][no-alloc]") {
  using Catch::Matchers::ContainsSubstring;
  Model model;
  for (int i = 0; i < 3; ++i) {
    model.bodies.emplace_back(2.0, V3(1, 1, 1));
    model.joints.emplace_back(i - 1, V3(0, 0, 0), V3(0, 1, 0), i, V3(0, 0, 1), V3(0, 1, 0));
  }
  CHECK_NOTHROW(MultibodySystem<double, 3, 3>(model));
  CHECK_THROWS_WITH((MultibodySystem<double, 3, 1>(model)),
                    ContainsSubstring("joints[1]") && ContainsSubstring("1 joints"));
  Model crowded = model;
  crowded.bodies.push_back(model.bodies[0]);
  CHECK_THROWS_WITH((MultibodySystem<double, 3, 3>(crowded)),
                    ContainsSubstring("number of bodies is 4"));
  Model apart = model;  // all hinged to the ground: one group each
  apart.joints.clear();
  for (int i = 0; i < 3; ++i) {
    apart.joints.emplace_back(ground_body, V3(0, 0, 0), V3(0, 1, 0), i, V3(0, 0, 1), V3(0, 1, 0));
  }
  CHECK_NOTHROW(MultibodySystem<double, 3, 1>(apart));

  SpringDamper<double> series =
      suspension(0, V3(0, 0, 0), 2, V3(0, 0, 0), V3(1, 1, 1), V3(1, 1, 1));
  series.series_stiffness_a.x() = 3;
  model.spring_dampers.push_back(series);
  const MultibodySystem<double, 3, 3> system(model);
  using Y = Eigen::Matrix<double, 40, 1>;
  REQUIRE(system.state_size() == 40);
  Y y = Y::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    y(RigidBodyLayout::offset(i) + 2) = -1.0 - static_cast<double>(i);
    y(RigidBodyLayout::offset(i) + 3) = 1;
  }
  const std::vector<Load> none(3);
  double sum = 0;
  CHECK(wheelrail_test::allocations_of([&] {
          sum = system.rate(y, none).sum() + system.kinetic_energy(y) + system.potential_energy(y) +
                system.constraint_violation(y).residual + system.dissipated_power(y) +
                system.reaction_on_b(y, none, 1).force_world.z();
        }) == 0);
  CHECK(is_finite(sum));
  y(3) = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(is_finite(system.rate(y, none)(7)));
  CHECK_FALSE(is_finite(system.constraint_violation(y).residual));
  y(3) = 0;  // no orientation at all
  CHECK_FALSE(is_finite(system.rate(y, none)(7)));
}
