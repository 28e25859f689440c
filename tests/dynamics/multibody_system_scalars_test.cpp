// The other scalars, in a program of its own: each is a good part of the time that compiling takes.

#include <type_traits>
#include <vector>
#include <wheelrail/dynamics/multibody_system.hpp>

#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;

TEMPLATE_TEST_CASE("MultibodySystem: any scalar moves the same way", "[dynamics][multibody_system]",
                   float, long double, wheelrail_test::StrictScalar) {
  const auto value = [](const auto& x) {
    if constexpr (std::is_floating_point_v<std::decay_t<decltype(x)>>) {
      return static_cast<double>(x);
    } else {
      return x.as_double();
    }
  };
  const auto rate = []<class T>(T) {
    using V = Vector3<T>;
    MultibodyModel<T> model;
    model.gravity_world.z() = T(-9.75);
    for (int i = 0; i < 2; ++i) model.bodies.emplace_back(T(2), V(T(1), T(1.5), T(2)));
    const V y_axis(T(0), T(1), T(0)), point(T(0), T(0.25), T(0.5));
    model.joints.emplace_back(0, point, y_axis, 1, V(-point), y_axis);
    SpringDamper<T> spring;
    spring.b = 0;
    spring.spring[2] = Characteristic<T>::linear(T(8));
    spring.damper[2] = Characteristic<T>::linear(T(2));
    spring.series_stiffness_a.z() = T(4);
    model.spring_dampers.push_back(spring);
    model.torsion_springs.push_back({0, 1, T(3), T(1)});
    const MultibodySystem<T> system(model);
    Eigen::Matrix<T, 27, 1> y = Eigen::Matrix<T, 27, 1>::Constant(T(0.5));
    y(3) = T(1);
    const std::vector<Wrench<T>> none(2);
    y = system.rate(y, none);
    y(26) = y(26) + system.kinetic_energy(y) + system.potential_energy(y);
    return y;
  };
  const auto expected = rate(0.0);
  const auto found = rate(TestType(0));
  for (Eigen::Index i = 0; i < 26; ++i) {
    CHECK(value(found(i)) == Approx(expected(i)).epsilon(sizeof(TestType) == 4 ? 1e-4 : 1e-12));
  }
}
