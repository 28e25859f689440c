#include <wheelrail/dynamics/rigid_body_vector.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

TEST_CASE("pack, unpack_rigid_body: a round trip for each body of a column", "[dynamics]") {
  RigidBodyState<double> first, second;
  first.position_world = {1, 2, 3};
  first.orientation = {0.5, -0.5, 0.5, 0.5};
  first.velocity_world = {4, 5, 6};
  first.angular_velocity_body = {7, 8, 9};
  second.position_world = {-1, -2, -3};
  Eigen::VectorXd column(26);
  column.segment<13>(RigidBodyLayout::offset(0)) = pack(first);
  column.segment<13>(RigidBodyLayout::offset(1)) = pack(second);
  CHECK(column(RigidBodyLayout::velocity_world + 1) == 5);
  const auto again = unpack_rigid_body(column, 0);
  CHECK(again.position_world == first.position_world);
  CHECK(again.orientation == first.orientation);
  CHECK(again.velocity_world == first.velocity_world);
  CHECK(again.angular_velocity_body == first.angular_velocity_body);
  CHECK(unpack_rigid_body(column, 1).position_world == second.position_world);
}

TEST_CASE("pack: the rates stand where the state's fields do", "[dynamics]") {
  RigidBodyRate<double> rate;
  rate.velocity_world = {1, 0, 0};
  rate.orientation_rate = {0, 2, 0, 0};
  rate.acceleration_world = {0, 0, 3};
  rate.angular_acceleration_body = {0, 4, 0};
  const auto packed = pack(rate);
  CHECK(packed(RigidBodyLayout::position_world) == 1);
  CHECK(packed(RigidBodyLayout::orientation + 1) == 2);
  CHECK(packed(RigidBodyLayout::velocity_world + 2) == 3);
  CHECK(packed(RigidBodyLayout::angular_velocity_body + 1) == 4);
}
