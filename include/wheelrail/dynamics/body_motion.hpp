#pragma once
/// @file
/// Where a body is and how it moves, computed once per evaluation for all joints and force elements
/// that hold on to it. May include: core, dynamics, Eigen, std.

#include <string>
#include <wheelrail/core/require.hpp>
#include <wheelrail/dynamics/rigid_body.hpp>

namespace wheelrail {

/// The index that stands for the ground, which rests in the world with the world's axes.
inline constexpr int ground_body = -1;

/// The default is the ground.
template <Real T>
struct BodyMotion {
  Vector3<T> position_world = Vector3<T>::Zero();          ///< of the centre of mass [m]
  Matrix3<T> body_to_world = Matrix3<T>::Identity();       ///< A: v_world = A v_body [-]
  Vector3<T> velocity_world = Vector3<T>::Zero();          ///< of the centre of mass [m/s]
  Vector3<T> angular_velocity_world = Vector3<T>::Zero();  ///< [rad/s]
};

/// That of a body in the state @p state.
template <Real T>
[[nodiscard]] BodyMotion<T> body_motion(const RigidBodyState<T>& state) {
  const Matrix3<T> body_to_world = rotation_matrix(state.orientation);
  return {state.position_world, body_to_world, state.velocity_world,
          body_to_world * state.angular_velocity_body};
}

namespace detail {

/// @throws std::invalid_argument unless @p a and @p b are two of @p count bodies, or one of them
/// and the ground.
inline void require_two_bodies(const std::string& name, int a, int b, std::size_t count) {
  const auto exists = [count](int i) {
    return i == ground_body || (0 <= i && static_cast<std::size_t>(i) < count);
  };
  const std::string rule = std::string(", but must be ")
                               .append(std::to_string(ground_body))
                               .append(" (ground) or less than the number of bodies, ")
                               .append(std::to_string(count));
  const auto is = [&name](const char* field, int i) {
    return std::string(name).append(field).append(std::to_string(i));
  };
  require(exists(a), is(".a is ", a).append(rule));
  require(exists(b), is(".b is ", b).append(rule));
  require(a != b, is(".a and .b are both ", a).append(", but must differ"));
}

/// @throws std::invalid_argument unless all three components of @p v are finite.
template <Real T>
void require_finite_vector(const std::string& name, const Vector3<T>& v) {
  require_finite(name + ".x", v.x());
  require_finite(name + ".y", v.y());
  require_finite(name + ".z", v.z());
}

}  // namespace detail
}  // namespace wheelrail
