#include <cmath>
#include <random>
#include <wheelrail/dynamics/rigid_body_vector.hpp>
#include <wheelrail/dynamics/torsion_spring.hpp>

#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;

namespace {

using V3 = Vector3<double>;
using State = RigidBodyState<double>;

class Random {
 public:
  double operator()() { return uniform_(engine_); }
  V3 vector() { return V3((*this)(), (*this)(), (*this)()); }
  State state() {
    return {vector(), Vector4<double>(1.0, 0.3 * (*this)(), 0.3 * (*this)(), 0.3 * (*this)()),
            vector(), vector()};
  }

 private:
  std::mt19937_64 engine_{20240703};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

State after(const State& s, double h) {
  return unpack_rigid_body(Vector13<double>(
      pack(s) + h * pack(derivative(s, Vector6<double>(Vector6<double>::Zero())))));
}

}  // namespace

TEST_CASE("TorsionSpring: turns b back about a's x axis, and pitch alone costs nothing",
          "[dynamics][torsion_spring]") {
  const TorsionSpring<double> bar{.a = 0, .b = 1, .stiffness = 940e3, .damping = 1e3};
  State b;
  b.orientation = euler_parameters_from_axis_angle(V3(1, 0, 0), 0.02);
  b.angular_velocity_body = V3(0.5, 0, 0);
  const BodyMotion<double> ground;
  CHECK((moment_b_world(bar, ground, body_motion(b)) - V3(-940e3 * 0.02 - 500, 0, 0)).norm() <
        1e-9);
  CHECK(stored_energy(bar, ground, body_motion(b)) == Approx(940e3 * 0.02 * 0.02 / 2));
  CHECK(dissipated_power(bar, ground, body_motion(b)) == Approx(250));
  // Seen from the other side, the sign of the angle changes.
  CHECK(relative_roll(body_motion(b), ground).angle == Approx(-0.02));
  State pitched;
  pitched.orientation = euler_parameters_from_axis_angle(V3(0, 1, 0), 0.4);
  CHECK(relative_roll(ground, body_motion(pitched)).angle == 0);
}

TEST_CASE("TorsionSpring: the rate is that of the angle, the power that of the energy",
          "[dynamics][torsion_spring][random]") {
  Random random;
  const TorsionSpring<double> spring{.a = 0, .b = 1, .stiffness = 3.0};
  const TorsionSpring<double> damper{.a = 0, .b = 1, .damping = 2.0};
  for (int i = 0; i < 200; ++i) {
    const State a = random.state(), b = random.state();
    const auto ma = body_motion(a), mb = body_motion(b);
    const double h = 1e-5;
    const auto at = [&](double t) {
      return std::pair{body_motion(after(a, t)), body_motion(after(b, t))};
    };
    const auto [a1, b1] = at(h);
    const auto [a0, b0] = at(-h);
    const auto roll = relative_roll(ma, mb);
    CHECK((relative_roll(a1, b1).angle - relative_roll(a0, b0).angle) / (2 * h) ==
          Approx(roll.rate).margin(1e-8));
    const V3 relative = mb.angular_velocity_world - ma.angular_velocity_world;
    CHECK((stored_energy(spring, a1, b1) - stored_energy(spring, a0, b0)) / (2 * h) ==
          Approx(-moment_b_world(spring, ma, mb).dot(relative)).margin(1e-8));
    CHECK(dissipated_power(damper, ma, mb) ==
          Approx(-moment_b_world(damper, ma, mb).dot(relative)).margin(1e-13));
  }
}

TEST_CASE("TorsionSpring: bad values are named", "[dynamics][torsion_spring][bad-input]") {
  using Catch::Matchers::ContainsSubstring;
  const auto check = [](const TorsionSpring<double>& t) { detail::require_valid(t, "bar", 2); };
  CHECK_NOTHROW(check({.a = 0, .b = 1, .stiffness = 1}));
  CHECK_THROWS_WITH(check({.a = 0, .b = 1, .stiffness = -1}),
                    ContainsSubstring("bar.stiffness is -1"));
  CHECK_THROWS_WITH(check({.a = 0, .b = 1, .damping = -2}), ContainsSubstring("bar.damping is -2"));
  CHECK_THROWS_WITH(check({.a = 0, .b = 2}), ContainsSubstring("bar.b is 2"));
}

TEST_CASE("TorsionSpring: any scalar", "[dynamics][torsion_spring]") {
  using S = wheelrail_test::StrictScalar;
  TorsionSpring<S> bar;
  bar.stiffness = S(2);
  RigidBodyState<S> b;
  b.orientation = euler_parameters_from_axis_angle(Vector3<S>(Vector3<S>::UnitX()), S(0.5));
  const auto moment = moment_b_world(bar, BodyMotion<S>{}, body_motion(b));
  CHECK(moment.x().as_double() == Approx(-1.0));
}
