#pragma once
/// @file
/// One rigid body in space: its inertia, its state, the wrench on it, and the equations of Newton
/// and Euler (the body's share of M and g in (91)-(94)). World is the inertial frame; the body
/// frame has its origin at the centre of mass and its axes along the principal axes of inertia.
/// May include: core, dynamics, Eigen, std.
///
/// Kinetics is kept apart from kinematics, so that a system of bodies can put constraints between:
/// M (`mass_diagonal`) and g (`generalized_force`) in the accelerations (dv/dt in the world,
/// domega/dt in the body) first, `derivative` of the state after. Reflection in the x-z plane, see
/// euler_parameters.hpp, gives the reflected result bit for bit.

#include <wheelrail/core/require.hpp>
#include <wheelrail/core/vector.hpp>
#include <wheelrail/dynamics/euler_parameters.hpp>

namespace wheelrail {

/// A column of six: a translation's three in world axes, then a rotation's three in body axes.
template <Real T>
using Vector6 = Eigen::Matrix<T, 6, 1, Eigen::DontAlign>;

/// Mass and principal moments of inertia.
/// Invariant: both are positive, and no moment exceeds the sum of the other two.
template <Real T>
class RigidBody {
 public:
  /// @param mass [kg], > 0.
  /// @param moments_body principal moments of inertia about the centre of mass, along the body's x,
  ///   y and z axes [kg m2]: each > 0 and, up to rounding, at most the sum of the other two (a flat
  ///   body reaches it).
  /// @throws std::invalid_argument naming the value and the rule that it breaks.
  RigidBody(const T& mass, const Vector3<T>& moments_body)
      : mass_(mass), moments_body_(moments_body) {
    static constexpr const char* names[] = {"moments_body.x", "moments_body.y", "moments_body.z"};
    detail::require_positive("mass", mass, "[kg]");
    for (Eigen::Index i = 0; i < 3; ++i) {
      detail::require_positive(names[i], moments_body(i), "[kg m2]");
    }
    for (Eigen::Index i = 0; i < 3; ++i) {
      const T others = moments_body((i + 1) % 3) + moments_body((i + 2) % 3);
      detail::require(moments_body(i) <= others * (T(1) + T(4) * epsilon<T>()), names[i],
                      moments_body(i),
                      std::string("at most the sum of the other two, ")
                          .append(detail::to_text(others))
                          .append(" kg m2"));
    }
  }

  [[nodiscard]] const T& mass() const { return mass_; }  ///< [kg]
  /// Principal moments of inertia about the centre of mass, in body axes [kg m2].
  [[nodiscard]] const Vector3<T>& moments_body() const { return moments_body_; }

 private:
  T mass_;
  Vector3<T> moments_body_;
};

/// Where a body is and how it moves: SI units, world or body axes as the names say.
template <Real T>
struct RigidBodyState {
  Vector3<T> position_world = Vector3<T>::Zero();  ///< of the centre of mass [m]
  /// Euler parameters of the body in the world, scalar first, of any length but zero [-].
  Vector4<T> orientation = identity_euler_parameters<T>();
  Vector3<T> velocity_world = Vector3<T>::Zero();         ///< of the centre of mass [m/s]
  Vector3<T> angular_velocity_body = Vector3<T>::Zero();  ///< in body axes [rad/s]
};

/// d/dt of each field of RigidBodyState.
template <Real T>
struct RigidBodyRate {
  Vector3<T> velocity_world = Vector3<T>::Zero();             ///< [m/s]
  Vector4<T> orientation_rate = Vector4<T>::Zero();           ///< [1/s]
  Vector3<T> acceleration_world = Vector3<T>::Zero();         ///< [m/s2]
  Vector3<T> angular_acceleration_body = Vector3<T>::Zero();  ///< in body axes [rad/s2]
};

/// Force and moment about the centre of mass, both in world axes.
template <Real T>
struct Wrench {
  Vector3<T> force_world = Vector3<T>::Zero();   ///< [N]
  Vector3<T> moment_world = Vector3<T>::Zero();  ///< [N m]

  /// Adds force and moment. @pre both are about the same point
  Wrench& operator+=(const Wrench& other) {
    force_world += other.force_world;
    moment_world += other.moment_world;
    return *this;
  }
};

/// The position of a point of the body [m], in the world.
/// @param point_body from the centre of mass, in body axes [m].
template <Real T>
[[nodiscard]] Vector3<T> point_position_world(const RigidBodyState<T>& state,
                                              const Vector3<T>& point_body) {
  return state.position_world + rotation_matrix(state.orientation) * point_body;
}

/// The velocity of a point of the body [m/s], in the world.
/// @param point_body from the centre of mass, in body axes [m].
template <Real T>
[[nodiscard]] Vector3<T> point_velocity_world(const RigidBodyState<T>& state,
                                              const Vector3<T>& point_body) {
  return state.velocity_world +
         rotation_matrix(state.orientation) * cross(state.angular_velocity_body, point_body);
}

/// The wrench of a force that acts at a point.
/// @param force_world [N]. @param point_world where it acts, in the world [m].
template <Real T>
[[nodiscard]] Wrench<T> wrench_at_point(const RigidBodyState<T>& state,
                                        const Vector3<T>& force_world,
                                        const Vector3<T>& point_world) {
  return {force_world, cross(Vector3<T>(point_world - state.position_world), force_world)};
}

/// The diagonal of M: the mass three times [kg], then the principal moments [kg m2].
template <Real T>
[[nodiscard]] Vector6<T> mass_diagonal(const RigidBody<T>& body) {
  Vector6<T> diagonal;
  diagonal << body.mass(), body.mass(), body.mass(), body.moments_body();
  return diagonal;
}

/// g of M a = g without constraints: the force in world axes [N], then the moment less
/// omega x (I omega), in body axes [N m].
/// @param body_to_world A: v_world = A v_body [-]. @param spin_body omega, in body axes [rad/s].
template <Real T>
[[nodiscard]] Vector6<T> generalized_force(const RigidBody<T>& body,
                                           const Matrix3<T>& body_to_world,
                                           const Vector3<T>& spin_body, const Wrench<T>& wrench) {
  const Vector3<T>& inertia_body = body.moments_body();
  const Vector3<T> moment_body = body_to_world.transpose() * wrench.moment_world;
  const Vector3<T> gyroscopic_body(
      (inertia_body.y() - inertia_body.z()) * (spin_body.y() * spin_body.z()),
      (inertia_body.z() - inertia_body.x()) * (spin_body.z() * spin_body.x()),
      (inertia_body.x() - inertia_body.y()) * (spin_body.x() * spin_body.y()));
  Vector6<T> force;
  force.template head<3>() = wrench.force_world;
  force.template tail<3>() = moment_body + gyroscopic_body;
  return force;
}

/// The same from the body's state.
template <Real T>
[[nodiscard]] Vector6<T> generalized_force(const RigidBody<T>& body, const RigidBodyState<T>& state,
                                           const Wrench<T>& wrench) {
  return generalized_force(body, rotation_matrix(state.orientation), state.angular_velocity_body,
                           wrench);
}

/// Kinematics: the rate of the state with the accelerations @p acceleration, three of the centre of
/// mass in world axes [m/s2], then three angular in body axes [rad/s2].
template <Real T>
[[nodiscard]] RigidBodyRate<T> derivative(const RigidBodyState<T>& state,
                                          const Vector6<T>& acceleration) {
  return {state.velocity_world,
          euler_parameter_rate(state.orientation, state.angular_velocity_body),
          acceleration.template head<3>(), acceleration.template tail<3>()};
}

/// The rate of the state of a free body: m dv/dt = F, I domega/dt + omega x (I omega) = M.
template <Real T>
[[nodiscard]] RigidBodyRate<T> derivative(const RigidBody<T>& body, const RigidBodyState<T>& state,
                                          const Wrench<T>& wrench) {
  const Vector6<T> force = generalized_force(body, state, wrench);
  return derivative(state, Vector6<T>(force.cwiseQuotient(mass_diagonal(body))));
}

/// Of the translation and of the rotation together [J].
template <Real T>
[[nodiscard]] T kinetic_energy(const RigidBody<T>& body, const RigidBodyState<T>& state) {
  const Vector3<T>& spin_body = state.angular_velocity_body;
  return (body.mass() * state.velocity_world.squaredNorm() +
          spin_body.dot(body.moments_body().cwiseProduct(spin_body))) /
         T(2);
}

/// About the centre of mass, in world axes [kg m2/s].
template <Real T>
[[nodiscard]] Vector3<T> angular_momentum_world(const RigidBody<T>& body,
                                                const RigidBodyState<T>& state) {
  return rotation_matrix(state.orientation) *
         body.moments_body().cwiseProduct(state.angular_velocity_body);
}

}  // namespace wheelrail
