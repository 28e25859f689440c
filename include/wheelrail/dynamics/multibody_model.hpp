#pragma once
/// @file
/// What a system of bodies is made of: plain data, checked when a MultibodySystem takes it.
/// May include: core, dynamics, Eigen, std.

#include <string>
#include <vector>
#include <wheelrail/dynamics/revolute_joint.hpp>
#include <wheelrail/dynamics/rigid_body.hpp>
#include <wheelrail/dynamics/spring_damper.hpp>
#include <wheelrail/dynamics/torsion_spring.hpp>

namespace wheelrail {

/// Joints, spring-dampers and torsion springs name their bodies by index; `ground_body` is the
/// ground.
template <Real T>
struct MultibodyModel {
  std::vector<RigidBody<T>> bodies;               ///< named by their index
  std::vector<RevoluteJoint<T>> joints;           ///< hinges between two bodies
  std::vector<SpringDamper<T>> spring_dampers;    ///< between two bodies
  std::vector<TorsionSpring<T>> torsion_springs;  ///< between two bodies, about one axis
  /// [m/s2]
  Vector3<T> gravity_world = Vector3<T>(T(0), T(0), constant<T>(-9.81L));
  /// Baumgarte's alpha and beta in (91), where the paper has 5 for both: a violated constraint
  /// obeys Phi'' + 2 alpha Phi' + beta^2 Phi = 0; >= 0 [1/s].
  T baumgarte_alpha = T(5);
  T baumgarte_beta = T(5);  ///< see baumgarte_alpha [1/s]
};

namespace detail {

/// @return @p model. @throws std::invalid_argument naming what is out of its range.
template <Real T>
[[nodiscard]] MultibodyModel<T> require_valid(MultibodyModel<T> model, std::size_t maximum_bodies) {
  const std::size_t count = model.bodies.size();
  require(0 < count && count <= maximum_bodies, std::string("the number of bodies is ")
                                                    .append(std::to_string(count))
                                                    .append(", but must be from 1 to ")
                                                    .append(std::to_string(maximum_bodies))
                                                    .append(", the system's MaximumBodies"));
  const auto named = [](const char* list, std::size_t i) {
    return std::string(list).append("[").append(std::to_string(i)).append("]");
  };
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const auto [a, b] = model.joints[i].bodies();
    require_two_bodies(named("joints", i), a, b, count);
  }
  for (std::size_t i = 0; i < model.spring_dampers.size(); ++i) {
    require_valid(model.spring_dampers[i], named("spring_dampers", i), count);
  }
  for (std::size_t i = 0; i < model.torsion_springs.size(); ++i) {
    require_valid(model.torsion_springs[i], named("torsion_springs", i), count);
  }
  require_finite_vector("gravity_world", model.gravity_world);
  require_not_negative("baumgarte_alpha", model.baumgarte_alpha, "[1/s]");
  require_not_negative("baumgarte_beta", model.baumgarte_beta, "[1/s]");
  return model;
}

}  // namespace detail
}  // namespace wheelrail
