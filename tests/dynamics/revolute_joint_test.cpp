#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <random>
#include <wheelrail/core/dual.hpp>
#include <wheelrail/dynamics/revolute_joint.hpp>
#include <wheelrail/dynamics/rigid_body_vector.hpp>

#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;

namespace {

using T = long double;
using V3 = Vector3<T>;
using State = RigidBodyState<T>;
using Equations = JointEquations<T>;

class Random {
 public:
  T operator()() { return static_cast<T>(uniform_(engine_)); }
  V3 vector() { return V3((*this)(), (*this)(), (*this)()); }
  State state() {
    return {vector(), Vector4<T>((*this)(), (*this)(), (*this)(), (*this)()), vector(), vector()};
  }

 private:
  std::mt19937_64 engine_{20240702};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

// The motion h later, to the order h^2 in position and h in velocity.
State moved(const State& s, const Vector6<T>& acceleration, T h) {
  const auto rate = derivative(s, acceleration);
  const Vector13<T> half = pack(s) + h / 2 * pack(rate);
  const auto middle = derivative(unpack_rigid_body(half), acceleration);
  return unpack_rigid_body(Vector13<T>(pack(s) + h * pack(middle)));
}

}  // namespace

TEST_CASE("RevoluteJoint: Jacobians and gamma are the derivatives of the residual",
          "[dynamics][revolute_joint][random]") {
  Random random;
  for (int i = 0; i < 100; ++i) {
    const RevoluteJoint<T> joint(0, random.vector(), random.vector(), 1, random.vector(),
                                 random.vector());
    const State a = random.state(), b = random.state();
    Vector6<T> acceleration_a, acceleration_b, velocity_a, velocity_b;
    acceleration_a << random.vector(), random.vector();
    acceleration_b << random.vector(), random.vector();
    velocity_a << a.velocity_world, a.angular_velocity_body;
    velocity_b << b.velocity_world, b.angular_velocity_body;
    const auto at = [&](T h) {
      return joint.equations(body_motion(moved(a, acceleration_a, h)),
                             body_motion(moved(b, acceleration_b, h)));
    };
    const T h = 1e-6L;
    const Equations now = at(0), before = at(-h), after = at(h);
    const Vector5<T> rate = (after.residual - before.residual) / (2 * h);
    CHECK((rate - now.residual_rate).norm() < 1e-9L);
    CHECK(
        (now.jacobians[0] * velocity_a + now.jacobians[1] * velocity_b - now.residual_rate).norm() <
        1e-17L);
    const Vector5<T> second = (after.residual_rate - before.residual_rate) / (2 * h);
    const Vector5<T> by_equations =
        now.jacobians[0] * acceleration_a + now.jacobians[1] * acceleration_b - now.gamma;
    CHECK((second - by_equations).norm() < 1e-9L);
    CHECK(second.norm() > 1e-2L);
  }
}

TEST_CASE("RevoluteJoint: nothing but rotation about the axis keeps the constraints",
          "[dynamics][revolute_joint][random]") {
  Random random;
  for (int i = 0; i < 100; ++i) {
    const V3 point_a = random.vector(), point_b = random.vector();
    const V3 axis_a = random.vector();
    const State a = random.state();
    State b = a;  // turned about the axis, with coinciding points
    const Vector4<T> turn = euler_parameters_from_axis_angle(axis_a, 3 * random());
    b.orientation = euler_product(a.orientation, turn);
    b.position_world += point_position_world(a, point_a) - point_position_world(b, point_b);
    const RevoluteJoint<T> joint(0, point_a, axis_a, 1, point_b, V3(5 * axis_a));
    CHECK(joint.axis_a().norm() == Approx(1.0));
    const auto e = joint.equations(body_motion(a), body_motion(b));
    CHECK(e.residual.norm() < 1e-17L);
    // The five rows are independent.
    const Eigen::Matrix<T, 5, 5> gram = e.jacobians[1] * e.jacobians[1].transpose();
    CHECK(gram.determinant() > 0.1L);
    // The axis as a body's angular velocity about the joint is free.
    Vector6<T> spin;
    spin << rotation_matrix(b.orientation) * cross(point_b, axis_a), axis_a;
    CHECK((e.jacobians[1] * spin).norm() < 1e-17L);
    b.orientation = euler_product(b.orientation, euler_parameters_from_axis_angle(
                                                     V3(cross(axis_a, random.vector())), T(0.01L)));
    CHECK(joint.equations(body_motion(a), body_motion(b)).residual.tail<2>().norm() ==
          Approx(std::sin(0.01)));
  }
}

TEST_CASE("RevoluteJoint: a joint in both centres of mass is centred, but in dual numbers",
          "[dynamics][revolute_joint][autodiff]") {
  const auto is_centred = []<class R>(R, double height_a, double height_b) {
    const Vector3<R> y = Vector3<R>::UnitY();
    return RevoluteJoint<R>(0, Vector3<R>(R(0), R(0), R(height_a)), y, 1,
                            Vector3<R>(R(0), R(0), R(height_b)), y)
        .is_centred();
  };
  CHECK(is_centred(T(0), 0, 0));
  CHECK_FALSE(is_centred(T(0), 1e-300, 0));
  CHECK_FALSE(is_centred(T(0), 0, -1e-300));
  CHECK_FALSE(is_centred(Dual<double, 1>(0), 0, 0));  // a point at zero may have derivatives
}

TEST_CASE("RevoluteJoint: what is no joint is refused by name",
          "[dynamics][revolute_joint][bad-input]") {
  using Catch::Matchers::ContainsSubstring;
  using D3 = Vector3<double>;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const D3 zero = D3::Zero(), y = D3::UnitY();
  CHECK_THROWS_WITH(RevoluteJoint<double>(0, zero, zero, 1, zero, y),
                    ContainsSubstring("the length of axis_a is 0"));
  CHECK_THROWS_WITH(RevoluteJoint<double>(0, zero, y, 1, zero, D3(nan, 0, 0)),
                    ContainsSubstring("axis_b"));
  CHECK_THROWS_WITH(RevoluteJoint<double>(0, D3(0, 0, nan), y, 1, zero, y),
                    ContainsSubstring("point_a.z is"));
}

TEST_CASE("RevoluteJoint: any scalar", "[dynamics][revolute_joint]") {
  using S = wheelrail_test::StrictScalar;
  const auto residual = []<class R>(R) {
    const Vector3<R> axis(R(0.25), R(1), R(0.5)), point(R(1), R(2), R(3));
    const RevoluteJoint<R> joint(0, point, axis, ground_body, point, Vector3<R>::UnitY());
    RigidBodyState<R> state;
    state.orientation = Vector4<R>(R(1), R(0.5), R(0.25), R(0));
    state.angular_velocity_body = axis;
    const auto e = joint.equations(body_motion(state), BodyMotion<R>{});
    return Vector5<R>(e.residual + e.gamma + e.residual_rate);
  };
  const auto expected = residual(0.0);
  const auto found = residual(S(0));
  for (Eigen::Index i = 0; i < 5; ++i) {
    CHECK(found(i).as_double() == Approx(expected(i)).epsilon(1e-14));
  }
}
