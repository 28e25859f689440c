#include <limits>
#include <stdexcept>
#include <wheelrail/dynamics/body_motion.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

TEST_CASE("body_motion: a point moves as rigid_body.hpp says", "[dynamics][body_motion]") {
  RigidBodyState<double> state;
  state.position_world = {1, 2, 3};
  state.orientation = {0.5, -0.3, 0.7, 0.2};
  state.velocity_world = {4, 5, 6};
  state.angular_velocity_body = {-1, 2, 0.5};
  const BodyMotion<double> m = body_motion(state);
  const Vector3<double> point_body(0.3, -0.4, 0.5);
  const Vector3<double> arm_world = m.body_to_world * point_body;
  CHECK(m.position_world + arm_world == point_position_world(state, point_body));
  const Vector3<double> velocity = m.velocity_world + cross(m.angular_velocity_world, arm_world);
  CHECK((velocity - point_velocity_world(state, point_body)).norm() < 1e-14);
}

TEST_CASE("BodyMotion: the default is the ground at rest", "[dynamics][body_motion]") {
  const BodyMotion<double> ground;
  const BodyMotion<double> still = body_motion(RigidBodyState<double>{});
  CHECK(ground.position_world == still.position_world);
  CHECK(ground.body_to_world == still.body_to_world);
  CHECK(ground.velocity_world == still.velocity_world);
  CHECK(ground.angular_velocity_world == still.angular_velocity_world);
}

TEST_CASE("require_two_bodies, require_finite_vector: what is wrong is named",
          "[dynamics][body_motion][bad-input]") {
  using Catch::Matchers::ContainsSubstring;
  CHECK_NOTHROW(detail::require_two_bodies("joint", ground_body, 1, 2));
  CHECK_THROWS_WITH(detail::require_two_bodies("joint", 0, 2, 2),
                    ContainsSubstring("joint.b is 2") && ContainsSubstring("number of bodies, 2"));
  CHECK_THROWS_WITH(detail::require_two_bodies("joint", -2, 0, 2),
                    ContainsSubstring("joint.a is -2"));
  CHECK_THROWS_WITH(detail::require_two_bodies("joint", 1, 1, 2), ContainsSubstring("both 1"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(detail::require_finite_vector("point", Vector3<double>(0, nan, 0)),
                    ContainsSubstring("point.y is"));
}
