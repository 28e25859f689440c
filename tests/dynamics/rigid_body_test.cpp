#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <wheelrail/dynamics/rigid_body.hpp>
#include <wheelrail/dynamics/rigid_body_vector.hpp>
#include <wheelrail/numerics/integrate.hpp>

#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;

namespace {

using V3 = Vector3<double>;
using V4 = Vector4<double>;
using V13 = Vector13<double>;
using State = RigidBodyState<double>;
using Load = Wrench<double>;

class Random {
 public:
  double operator()() { return uniform_(engine_); }
  V3 vector() { return V3((*this)(), (*this)(), (*this)()); }
  State state() {
    return {vector(), V4((*this)(), (*this)(), (*this)(), (*this)()), vector(), vector()};
  }

 private:
  std::mt19937_64 engine_{20240612};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

// The reflection in the x-z plane: of positions and forces, of angular velocities and moments, of
// orientations.
V3 mirror(const V3& v) {
  return V3(v.x(), -v.y(), v.z());
}
V3 mirror_axial(const V3& w) {
  return V3(-w.x(), w.y(), -w.z());
}
V4 mirror(const V4& p) {
  return V4(p(0), -p(1), p(2), -p(3));
}
State mirror(const State& s) {
  return {mirror(s.position_world), mirror(s.orientation), mirror(s.velocity_world),
          mirror_axial(s.angular_velocity_body)};
}
Load mirror(const Load& w) {
  return {mirror(w.force_world), mirror_axial(w.moment_world)};
}

// Integrates a body under load(t, state) and hands every report to the observer.
template <class LoadOf, class Observe>
State simulate(const RigidBody<double>& body, const State& start, double t_end, double interval,
               double tolerance, LoadOf&& load, Observe&& observe) {
  const auto f = [&](double t, const V13& y) {
    const State state = unpack_rigid_body(y);
    return pack(derivative(body, state, load(t, state)));
  };
  const auto result = integrate(f, 0, pack(start), t_end, interval,
                                {.relative_tolerance = tolerance, .absolute_tolerance = tolerance},
                                [&](double t, const V13& y) {
                                  observe(t, unpack_rigid_body(y));
                                  return true;
                                });
  REQUIRE(result.status == IntegrationStatus::finished);
  return unpack_rigid_body(result.state);
}

struct Jacobi {
  double sn, cn, dn;
};

// Abramowitz and Stegun 16.4, by arithmetic-geometric means; 0 <= modulus < 1.
Jacobi jacobi(double u, double modulus) {
  double a[12], c[12];
  a[0] = 1.0;
  c[0] = modulus;
  double b = std::sqrt(1.0 - modulus * modulus);
  int n = 0;
  for (; n < 11 && std::fabs(c[n]) > 1e-17; ++n) {
    a[n + 1] = (a[n] + b) / 2;
    c[n + 1] = (a[n] - b) / 2;
    b = std::sqrt(a[n] * b);
  }
  double phase = std::ldexp(a[n] * u, n);
  for (; n > 0; --n) phase = (phase + std::asin(c[n] / a[n] * std::sin(phase))) / 2;
  const double sn = std::sin(phase);
  return {sn, std::cos(phase), std::sqrt(1.0 - modulus * modulus * sn * sn)};
}

std::string message_of(double mass, const V3& moments_body) {
  try {
    RigidBody<double>(mass, moments_body);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "(nothing was thrown)";
}

}  // namespace

TEST_CASE("RigidBody: what no body can have is refused by name",
          "[dynamics][rigid_body][bad-input]") {
  using Catch::Matchers::ContainsSubstring;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(message_of(0.0, V3(1, 1, 1)), ContainsSubstring("mass is 0"));
  CHECK_THAT(message_of(nan, V3(1, 1, 1)), ContainsSubstring("mass is"));
  CHECK_THAT(message_of(1.0, V3(1, -2, 1)), ContainsSubstring("moments_body.y is -2"));
  CHECK_THAT(message_of(1.0, V3(1, 1, nan)), ContainsSubstring("moments_body.z is"));
  CHECK_THAT(message_of(1.0, V3(1, 2.5, 1)),
             ContainsSubstring("moments_body.y is 2.5") &&
                 ContainsSubstring("sum of the other two, 2 kg m2"));
  CHECK_THAT(message_of(1.0, V3(5, 2, 1)), ContainsSubstring("moments_body.x is 5"));
  CHECK_NOTHROW(RigidBody<double>(1.0, V3(0.1, 0.2, 0.1 + 0.2)));  // a flat plate
  CHECK_NOTHROW(RigidBody<double>(1.0, V3(0.8, 0.1, 0.7)));        // 0.1 + 0.7 < 0.8
  CHECK_NOTHROW(RigidBody<float>(1.0F, Vector3<float>(0.7F, 0.3F, 0.4F)));
}

TEST_CASE("derivative: Newton's and Euler's equations hold in the world frame",
          "[dynamics][rigid_body][random]") {
  // Independently of the body-frame form: dL/dt = M with L = A I A^T w, by central differences
  // along the motion.
  Random random;
  const RigidBody<double> body(3.0, V3(1.0, 1.7, 2.2));
  for (int i = 0; i < 200; ++i) {
    const State state = random.state();
    const Load load{random.vector(), random.vector()};
    const V13 y = pack(state), rate = pack(derivative(body, state, load));
    const double h = 1e-5;
    const State after = unpack_rigid_body(V13(y + h * rate));
    const State before = unpack_rigid_body(V13(y - h * rate));
    const V3 torque =
        (angular_momentum_world(body, after) - angular_momentum_world(body, before)) / (2 * h);
    CHECK((torque - load.moment_world).norm() < 1e-7);
    CHECK((rate.segment<3>(7) - load.force_world / 3.0).norm() < 1e-15);
    CHECK(rate.head<3>() == state.velocity_world);
    // Power: the kinetic energy changes by F v + M w.
    const double power = (kinetic_energy(body, after) - kinetic_energy(body, before)) / (2 * h);
    const V3 angular_velocity_world =
        rotation_matrix(state.orientation) * state.angular_velocity_body;
    CHECK(power == Approx(load.force_world.dot(state.velocity_world) +
                          load.moment_world.dot(angular_velocity_world))
                       .margin(1e-8));
    // A point of the body moves with the velocity that its position's change says.
    const V3 point_body = random.vector();
    const V3 velocity =
        (point_position_world(after, point_body) - point_position_world(before, point_body)) /
        (2 * h);
    CHECK((velocity - point_velocity_world(state, point_body)).norm() < 1e-7);
  }
}

TEST_CASE("wrench_at_point: a force at a point does the power of that point",
          "[dynamics][rigid_body][random]") {
  Random random;
  for (int i = 0; i < 100; ++i) {
    const State state = random.state();
    const V3 force = random.vector(), point_body = random.vector();
    Load load = wrench_at_point(state, force, point_position_world(state, point_body));
    const V3 angular_velocity_world =
        rotation_matrix(state.orientation) * state.angular_velocity_body;
    CHECK(load.force_world.dot(state.velocity_world) +
              load.moment_world.dot(angular_velocity_world) ==
          Approx(force.dot(point_velocity_world(state, point_body))).margin(1e-14));
    load += wrench_at_point(state, V3(-force), point_position_world(state, point_body));
    CHECK(load.force_world == V3(0, 0, 0));
    CHECK(load.moment_world == V3(0, 0, 0));
  }
}

TEST_CASE("rigid body: a free asymmetric top follows Jacobi's elliptic functions",
          "[dynamics][rigid_body][reference]") {
  // Landau and Lifshitz, Mechanics, section 37: I1 < I2 < I3 and L^2 > 2 E I2.
  const double i1 = 1.0, i2 = 1.6, i3 = 2.3;
  const RigidBody<double> body(5.0, V3(i1, i2, i3));
  State start;
  start.orientation = unit_euler_parameters(V4(0.5, -0.3, 0.7, 0.2));
  start.velocity_world = V3(1.0, -2.0, 0.5);
  start.angular_velocity_body = V3(1.1, 0.0, 1.4);
  const double twice_energy = i1 * 1.1 * 1.1 + i3 * 1.4 * 1.4;
  const double momentum2 = i1 * i1 * 1.1 * 1.1 + i3 * i3 * 1.4 * 1.4;
  REQUIRE(momentum2 > twice_energy * i2);
  const double slow = twice_energy * i3 - momentum2, fast = momentum2 - twice_energy * i1;
  const double rate = std::sqrt((i3 - i2) * fast / (i1 * i2 * i3));
  const double modulus = std::sqrt((i2 - i1) * slow / ((i3 - i2) * fast));
  REQUIRE(modulus > 0.3);
  const V3 momentum_world = angular_momentum_world(body, start);
  const double energy = kinetic_energy(body, start);

  int reports = 0;
  double least_spin = 2.0;
  simulate(
      body, start, 40.0, 0.25, 1e-12, [](double, const State&) { return Load{}; },
      [&](double t, const State& state) {
        const Jacobi at = jacobi(rate * t, modulus);
        const V3 expected(std::sqrt(slow / (i1 * (i3 - i1))) * at.cn,
                          std::sqrt(slow / (i2 * (i3 - i2))) * at.sn,
                          std::sqrt(fast / (i3 * (i3 - i1))) * at.dn);
        CHECK((state.angular_velocity_body - expected).norm() < 1e-9);
        CHECK((angular_momentum_world(body, state) - momentum_world).norm() < 1e-9);
        CHECK(kinetic_energy(body, state) == Approx(energy).epsilon(1e-10));
        CHECK(state.orientation.norm() == Approx(1.0).epsilon(1e-9));
        CHECK((state.position_world - t * start.velocity_world).norm() < 1e-10);
        least_spin = std::min(least_spin, state.angular_velocity_body.x());
        ++reports;
      });
  CHECK(reports == 161);
  CHECK(least_spin < -1.0);  // it went round
}

TEST_CASE("rigid body: a heavy symmetric top precesses steadily, orientation included",
          "[dynamics][rigid_body][reference]") {
  // I1 n^2 cos(tilt) - I3 s n + m g l = 0 for the precession n and the spin s of omega along the
  // axis (Goldstein, Classical Mechanics, 5.7). The pivot is the origin of the body, the weight a
  // moment about it.
  const double i1 = 0.8, i3 = 0.5, weight_moment = 2.5, tilt = 0.6, precession = 0.9;
  const double spin =
      (i1 * precession * precession * std::cos(tilt) + weight_moment) / (i3 * precession);
  const double own_rate = spin - precession * std::cos(tilt);
  const RigidBody<double> body(1.0, V3(i1, i1, i3));
  const V4 tilted = euler_parameters_from_axis_angle(V3(0, 1, 0), tilt);
  State start;
  start.orientation = tilted;
  start.angular_velocity_body = V3(-precession * std::sin(tilt), 0.0, spin);
  const auto weight = [&](double, const State& state) {
    const V3 axis_world = rotation_matrix(state.orientation) * V3(0, 0, 1);
    return Load{V3::Zero(), cross(axis_world, V3(0, 0, -weight_moment))};
  };
  simulate(body, start, 20.0, 0.5, 1e-11, weight, [&](double t, const State& state) {
    const V4 expected = euler_product(
        euler_parameters_from_axis_angle(V3(0, 0, 1), precession * t),
        euler_product(tilted, euler_parameters_from_axis_angle(V3(0, 0, 1), own_rate * t)));
    CHECK((rotation_matrix(state.orientation) - rotation_matrix(expected)).norm() < 1e-7);
    CHECK(state.angular_velocity_body.z() == Approx(spin).epsilon(1e-12));
  });
}

TEST_CASE("rigid body: a projectile flies a parabola and keeps its spin",
          "[dynamics][rigid_body][reference]") {
  const RigidBody<double> body(7.0, V3(1, 1, 1));
  State start;
  start.velocity_world = V3(3, -1, 10);
  start.angular_velocity_body = V3(0.1, 0.2, 0.3);
  const State end = simulate(
      body, start, 2.0, 0.0, 1e-9, [](double, const State&) { return Load{V3(0, 0, -7.0 * 9.81)}; },
      [](double, const State&) {});
  CHECK((end.position_world - V3(6, -2, 20 - 2 * 9.81)).norm() < 1e-12);
  CHECK((end.velocity_world - V3(3, -1, 10 - 2 * 9.81)).norm() < 1e-12);
  CHECK(end.angular_velocity_body == start.angular_velocity_body);
}

TEST_CASE("rigid body: reflected states and wrenches give reflected rates bit for bit",
          "[dynamics][rigid_body][symmetry][random]") {
  Random random;
  const RigidBody<double> body(1568.0, V3(656.0, 168.0, 655.9));
  for (int i = 0; i < 1000; ++i) {
    const State state = random.state();
    const Load load{random.vector(), random.vector()};
    const RigidBodyRate<double> rate = derivative(body, state, load);
    const RigidBodyRate<double> image = derivative(body, mirror(state), mirror(load));
    CHECK(image.velocity_world == mirror(rate.velocity_world));
    CHECK(image.orientation_rate == mirror(rate.orientation_rate));
    CHECK(image.acceleration_world == mirror(rate.acceleration_world));
    CHECK(image.angular_acceleration_body == mirror_axial(rate.angular_acceleration_body));
    const V3 point = random.vector(), force = random.vector();
    CHECK(point_velocity_world(mirror(state), mirror(point)) ==
          mirror(point_velocity_world(state, point)));
    CHECK(wrench_at_point(mirror(state), mirror(force), mirror(point)).moment_world ==
          mirror_axial(wrench_at_point(state, force, point).moment_world));
    CHECK(angular_momentum_world(body, mirror(state)) ==
          mirror_axial(angular_momentum_world(body, state)));
    CHECK(kinetic_energy(body, mirror(state)) == kinetic_energy(body, state));
  }
  // And so through the integrator.
  const State start = random.state();
  const auto spring = [](double, const State& s) {
    return wrench_at_point(s, V3(-4 * point_position_world(s, V3(0.3, 0.0, 0.2))),
                           point_position_world(s, V3(0.3, 0.0, 0.2)));
  };
  const RigidBody<double> light(2.0, V3(0.3, 0.4, 0.5));
  const auto nothing = [](double, const State&) {};
  const State end = simulate(light, start, 10.0, 0.0, 1e-6, spring, nothing);
  const State image = simulate(light, mirror(start), 10.0, 0.0, 1e-6, spring, nothing);
  CHECK(pack(image) == pack(mirror(end)));
}

TEST_CASE("pack: bodies lie one behind the other and come back bit for bit",
          "[dynamics][rigid_body]") {
  Random random;
  Eigen::VectorXd system(3 * RigidBodyLayout::size);
  State states[3];
  for (Eigen::Index i = 0; i < 3; ++i) {
    states[i] = random.state();
    system.segment<RigidBodyLayout::size>(RigidBodyLayout::offset(i)) = pack(states[i]);
  }
  for (Eigen::Index i = 0; i < 3; ++i) {
    const State back = unpack_rigid_body(system, i);
    CHECK(back.position_world == states[i].position_world);
    CHECK(back.orientation == states[i].orientation);
    CHECK(back.velocity_world == states[i].velocity_world);
    CHECK(back.angular_velocity_body == states[i].angular_velocity_body);
  }
  CHECK(system(13) == states[1].position_world.x());
  CHECK(system(13 + RigidBodyLayout::orientation) == states[1].orientation(0));
  CHECK(system(38) == states[2].angular_velocity_body.z());
}

TEST_CASE("rigid body: mass_diagonal and generalized_force are M and g of M a = g",
          "[dynamics][rigid_body]") {
  const RigidBody<double> body(2.0, V3(1.0, 1.5, 2.0));
  Vector6<double> expected;
  expected << 2, 2, 2, 1, 1.5, 2;
  CHECK(mass_diagonal(body) == expected);
  State state;
  state.angular_velocity_body = V3(2, 3, 5);
  // M - w x (I w) with I w = (2, 4.5, 10): w x I w = (7.5, -10, 3).
  expected << 1, 2, 3, 10 - 7.5, 20 + 10, 30 - 3;
  CHECK(generalized_force(body, state, Load{V3(1, 2, 3), V3(10, 20, 30)}) == expected);
}

TEMPLATE_TEST_CASE("rigid body: any scalar turns the same way, one that converts to nothing too",
                   "[dynamics][rigid_body]", float, long double, wheelrail_test::StrictScalar) {
  using T = TestType;
  const auto value = [](const T& x) {
    if constexpr (std::is_floating_point_v<T>) {
      return static_cast<double>(x);
    } else {
      return x.as_double();
    }
  };
  const auto spin = []<class S>(const S&) {
    const RigidBody<S> body(S(2), Vector3<S>(S(1), S(1.5), S(2)));
    RigidBodyState<S> start;
    start.orientation = euler_parameters_from_rotation_matrix(
        rotation_matrix(euler_parameters_from_axis_angle(Vector3<S>(S(1), S(2), S(-1)), S(0.25))));
    start.angular_velocity_body = Vector3<S>(S(1), S(0.25), S(0.5));
    const auto f = [&](const S&, const Vector13<S>& y) {
      const RigidBodyState<S> state = unpack_rigid_body(y);
      const Vector3<S> arm = point_position_world(state, Vector3<S>(S(0), S(0.5), S(0)));
      return pack(derivative(body, state, wrench_at_point(state, Vector3<S>(-arm), arm)));
    };
    const auto result = integrate(f, S(0), pack(start), S(2), S(0.5), {},
                                  [](const S&, const Vector13<S>&) { return true; });
    CHECK(result.status == IntegrationStatus::finished);
    return result.state;
  };
  const V13 expected = spin(0.0);
  const Vector13<T> found = spin(T(0));
  for (Eigen::Index i = 0; i < 13; ++i) {
    CHECK(value(found(i)) == Approx(expected(i)).margin(1e-4 * (sizeof(T) == 4) + 1e-12));
  }
}
