// The other scalars, in a program of its own: each is a good part of the time that compiling takes.

#include <type_traits>
#include <vector>
#include <wheelrail/dynamics/linearize.hpp>

#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;

TEMPLATE_TEST_CASE("linearize: other scalars", "[dynamics][linearize]", float,
                   wheelrail_test::StrictScalar) {
  using T = TestType;
  MultibodyModel<T> model;
  model.gravity_world.setZero();
  model.bodies.emplace_back(T(2), Vector3<T>(T(1), T(1), T(1)));
  SpringDamper<T> spring;
  spring.b = 0;
  spring.spring[2] = Characteristic<T>::linear(T(200));
  spring.damper[2] = Characteristic<T>::linear(T(4));
  model.spring_dampers.push_back(spring);
  const MultibodySystem<T> system(model);
  const std::vector<Wrench<T>> none(1);
  const std::vector<BodyDisplacement> vertical{{0, Displacement::z}};
  const auto linear = linearize(system, pack(RigidBodyState<T>{}), vertical,
                                [&](const Vector13<T>&) { return none; });
  const auto close = [](const T& found, double expected) {
    const T off = found - T(expected);
    return off < T(1e-3) && T(-1e-3) < off;
  };
  CHECK(close(linear.acceleration_by_displacement()(0, 0), -100));
  CHECK(close(linear.acceleration_by_velocity()(0, 0), -2));
  if constexpr (std::is_floating_point_v<T>) {
    const auto found = eigenmodes(linear);
    REQUIRE(found.modes.size() == 1);
    CHECK(close(found.modes[0].frequency, 10 / (2 * pi<double>())));
    CHECK(close(found.modes[0].damping_ratio, 0.1));
  }
}
