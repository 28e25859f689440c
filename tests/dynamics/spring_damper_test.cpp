#include <cmath>
#include <limits>
#include <random>
#include <vector>
#include <wheelrail/dynamics/rigid_body_vector.hpp>
#include <wheelrail/dynamics/spring_damper.hpp>
#include <wheelrail/numerics/integrate.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;

namespace {

using V3 = Vector3<double>;
using State = RigidBodyState<double>;
using C = Characteristic<double>;
using Point = CharacteristicPoint<double>;

class Random {
 public:
  double operator()() { return uniform_(engine_); }
  V3 vector() { return V3((*this)(), (*this)(), (*this)()); }
  State state() {
    return {vector(), Vector4<double>((*this)(), (*this)(), (*this)(), (*this)()), vector(),
            vector()};
  }

 private:
  std::mt19937_64 engine_{20240704};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

State after(const State& s, double h) {
  return unpack_rigid_body(Vector13<double>(
      pack(s) + h * pack(derivative(s, Vector6<double>(Vector6<double>::Zero())))));
}

SpringDamper<double> with_everything() {
  SpringDamper<double> e;
  e.a = 0;
  e.b = 1;
  e.point_a = V3(0.3, -0.2, 0.5);
  e.point_b = V3(-0.4, 0.1, -0.3);
  e.spring = {C::linear(3.0), C::table(std::vector<Point>{{-1, -2}, {0.1, 0}, {0.4, 3}}),
              C::linear(5.0)};
  e.damper = {C::linear(1.5), C::odd_table(std::vector<Point>{{0.3, 1}, {1, 2}}), C::linear(0.5)};
  e.preload_a = V3(0.2, -0.1, 4);
  return e;
}

// The rate of the elongation of a Maxwell element of damping c and stiffness k along z, b moving
// at the velocity v against the ground.
double elongation_rate(double c, double k, double v, double elongation) {
  SpringDamper<double> e;
  e.b = 0;
  e.damper[2] = C::linear(c);
  e.series_stiffness_a.z() = k;
  BodyMotion<double> b;
  b.velocity_world.z() = v;
  return action(e, BodyMotion<double>{}, b, V3(0, 0, elongation)).elongation_rate_a.z();
}

using Vector1 = Eigen::Matrix<double, 1, 1>;

}  // namespace

TEST_CASE("SpringDamper: preload less spring less damper along each axis of a",
          "[dynamics][spring_damper]") {
  SpringDamper<double> e;
  e.b = 0;
  e.point_a = V3(1, 2, 3);
  e.spring = {C::linear(10.0), C::linear(20.0), C::linear(30.0)};
  e.damper = {C::linear(1.0), C::linear(2.0), C::linear(3.0)};
  e.preload_a = V3(100, 200, 300);
  BodyMotion<double> b;
  b.position_world = V3(1.5, 2.25, 2);
  b.velocity_world = V3(-1, 2, 4);
  const auto act = action(e, BodyMotion<double>{}, b, V3(0, 0, 0));
  CHECK(act.force_b_world == V3(100 - 5 + 1, 200 - 5 - 4, 300 + 30 - 12));
  CHECK(act.point_world == b.position_world);
  CHECK(act.elongation_rate_a == V3(0, 0, 0));
  CHECK(dissipated_power(e, BodyMotion<double>{}, b, V3(0, 0, 0)) == Approx(1 + 8 + 48));

  // The axes are those of a: a quarter turn about z makes its x axis the world's y.
  State a;
  a.orientation = euler_parameters_from_axis_angle(V3(0, 0, 1), pi<double>() / 2);
  SpringDamper<double> turned;
  turned.a = 0;
  turned.b = 1;
  turned.spring[0] = C::linear(10.0);
  BodyMotion<double> moved;
  moved.position_world = V3(0.3, 0.5, 0.7);
  const auto force = action(turned, body_motion(a), moved, V3(0, 0, 0)).force_b_world;
  CHECK((force - V3(0, -5, 0)).norm() < 1e-14);
}

TEST_CASE("SpringDamper: a rigid motion of both bodies is felt by neither",
          "[dynamics][spring_damper][random]") {
  Random random;
  const auto e = with_everything();
  for (int i = 0; i < 100; ++i) {
    const State a = random.state();
    State b = a;
    const V3 displacement = random.vector();
    const V3 centre = e.point_a + displacement - e.point_b;  // of b, seen from a
    b.position_world = point_position_world(a, centre);
    b.velocity_world = point_velocity_world(a, centre);
    const auto motion = relative_motion(e, body_motion(a), body_motion(b));
    CHECK((motion.displacement_a - displacement).norm() < 1e-14);
    CHECK(motion.velocity_a.norm() < 1e-13);
  }
}

TEST_CASE("SpringDamper: its power is the loss of its energy and of its dampers",
          "[dynamics][spring_damper][random]") {
  Random random;
  auto e = with_everything();
  int tabulated = 0;
  for (int i = 0; i < 300; ++i) {
    e.series_stiffness_a = i % 2 == 0 ? V3(0, 0, 0) : V3(2, 0, 7);
    const State a = random.state(), b = random.state();
    const V3 x = i % 2 == 0 ? V3(0, 0, 0) : V3(random.vector().cwiseProduct(V3(1, 0, 1)));
    const auto ma = body_motion(a), mb = body_motion(b);
    const auto act = action(e, ma, mb, x);
    const V3& f = act.force_b_world;
    const V3 arm_b = act.point_world - b.position_world, arm_a = act.point_world - a.position_world;
    const double power = f.dot(mb.velocity_world + cross(mb.angular_velocity_world, arm_b)) -
                         f.dot(ma.velocity_world + cross(ma.angular_velocity_world, arm_a));
    const double h = 1e-6;
    const auto energy = [&](double t) {
      return stored_energy(e, body_motion(after(a, t)), body_motion(after(b, t)),
                           V3(x + t * act.elongation_rate_a));
    };
    const double loss = dissipated_power(e, ma, mb, x);
    CHECK(loss >= 0);
    CHECK((energy(h) - energy(-h)) / (2 * h) + loss == Approx(-power).margin(3e-7));
    const double d = relative_motion(e, ma, mb).displacement_a.y();
    tabulated += d < 0.1 || 0.4 < d;
    // The two act along one line: no momentum comes from nowhere.
    CHECK((cross(arm_b, f) + cross(V3(b.position_world - a.position_world), f) - cross(arm_a, f))
              .norm() < 1e-12);
  }
  CHECK(tabulated > 100);
}

TEST_CASE("SpringDamper: a Maxwell element relaxes after a step of velocity",
          "[dynamics][spring_damper][reference]") {
  // c and k of the vertical dampers of a passenger coach: f = c v (1 - exp(-k t / c)).
  const double c = 20e3, k = 6e6, v = 0.3;
  double worst = 0;
  const auto rate = [&](double, const Vector1& x) {
    return Vector1(elongation_rate(c, k, v, x(0)));
  };
  const auto result = integrate(rate, 0.0, Vector1(0.0), 0.02, 0.001,
                                {.relative_tolerance = 1e-10, .absolute_tolerance = 1e-13},
                                [&](double t, const Vector1& x) {
                                  const double force = c * v * (1 - std::exp(-k * t / c));
                                  worst = std::fmax(worst, std::fabs(k * x(0) - force));
                                  return true;
                                });
  CHECK(result.status == IntegrationStatus::finished);
  CHECK(worst < 1e-4);  // of 6000 N
}

TEST_CASE("SpringDamper: a Maxwell element under a sine has its complex stiffness",
          "[dynamics][spring_damper][reference]") {
  // f'/k + f/c = V cos(w t): f = V c (cos wt + w tau sin wt) / (1 + w^2 tau^2), tau = c/k, after
  // the transient.
  const double c = 20e3, k = 1e6, v = 0.2, w = 40.0, tau = c / k;
  double worst = 0;
  const auto rate = [&](double t, const Vector1& x) {
    return Vector1(elongation_rate(c, k, v * std::cos(w * t), x(0)));
  };
  const auto result = integrate(
      rate, 0.0, Vector1(0.0), 2.0, 0.01,
      {.relative_tolerance = 1e-10, .absolute_tolerance = 1e-13}, [&](double t, const Vector1& x) {
        const double phase = w * t;
        const double force =
            v * c * (std::cos(phase) + w * tau * std::sin(phase)) / (1 + w * w * tau * tau);
        if (t > 1.0) worst = std::fmax(worst, std::fabs(k * x(0) - force));
        return true;
      });
  CHECK(result.status == IntegrationStatus::finished);
  CHECK(worst < 1e-3);  // of 3100 N
}

TEST_CASE("SpringDamper: a tabulated damper in series moves with the force in its spring",
          "[dynamics][spring_damper]") {
  SpringDamper<double> e;
  e.b = 0;
  e.damper[0] = C::odd_table(std::vector<Point>{{0.1, 1000}, {1, 1900}});  // blows off at 0.1 m/s
  e.series_stiffness_a.x() = 1e6;
  BodyMotion<double> b;
  b.velocity_world.x() = 0.7;
  const auto act = action(e, BodyMotion<double>{}, b, V3(1.4e-3, 0, 0));
  CHECK(act.force_b_world.x() == Approx(-1400));
  CHECK(act.elongation_rate_a.x() == Approx(0.7 - 0.5));
  CHECK(dissipated_power(e, BodyMotion<double>{}, b, V3(1.4e-3, 0, 0)) == Approx(1400 * 0.5));
  CHECK(stored_energy(e, BodyMotion<double>{}, b, V3(1.4e-3, 0, 0)) == Approx(0.98));
}

TEST_CASE("SpringDamper: bad values are named, queries allocate nothing",
          "[dynamics][spring_damper][bad-input][no-alloc]") {
  using Catch::Matchers::ContainsSubstring;
  const auto good = with_everything();
  const auto message = [&](auto&& spoil) {
    auto e = good;
    spoil(e);
    try {
      detail::require_valid(e, "secondary", 2);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("(nothing was thrown)");
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(message([](auto&) {}), ContainsSubstring("nothing was thrown"));
  CHECK_THAT(message([](auto& e) { e.b = 2; }), ContainsSubstring("secondary.b is 2"));
  CHECK_THAT(message([](auto& e) { e.b = 0; }), ContainsSubstring("must differ"));
  CHECK_THAT(message([&](auto& e) { e.point_a.x() = nan; }),
             ContainsSubstring("secondary.point_a.x"));
  CHECK_THAT(message([&](auto& e) { e.point_b.y() = nan; }),
             ContainsSubstring("secondary.point_b.y"));
  CHECK_THAT(message([&](auto& e) { e.preload_a.z() = nan; }),
             ContainsSubstring("secondary.preload_a.z"));
  CHECK_THAT(message([](auto& e) { e.series_stiffness_a.y() = -1; }),
             ContainsSubstring("secondary.series_stiffness_a.y is -1"));
  CHECK_THAT(message([](auto& e) {
               e.damper[0] = C();
               e.series_stiffness_a.x() = 5;
             }),
             ContainsSubstring("series_stiffness_a.x is 5") &&
                 ContainsSubstring("does not strictly increase"));
  const BodyMotion<double> ground;
  CHECK(wheelrail_test::allocations_of([&] {
          CHECK(action(good, ground, ground, V3(0, 0, 0)).force_b_world.norm() > 0);
        }) == 0);
}

TEST_CASE("SpringDamper: any scalar", "[dynamics][spring_damper]") {
  using S = wheelrail_test::StrictScalar;
  SpringDamper<S> e;
  e.b = 0;
  e.spring[2] = Characteristic<S>::linear(S(4));
  e.damper[2] = Characteristic<S>::linear(S(2));
  e.series_stiffness_a.z() = S(8);
  BodyMotion<S> b;
  b.position_world.z() = S(0.5);
  b.velocity_world.z() = S(3);
  const Vector3<S> x(S(0), S(0), S(0.25));
  const auto act = action(e, BodyMotion<S>{}, b, x);
  CHECK(act.force_b_world.z().as_double() == -4);
  CHECK(act.elongation_rate_a.z().as_double() == 2);
  CHECK(stored_energy(e, BodyMotion<S>{}, b, x).as_double() == 0.75);
}
