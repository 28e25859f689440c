#pragma once
/// @file
/// The slopes of one contact's forces by its velocities and its penetration, in closed form: the
/// damping and stiffness that an implicit integrator puts in its Jacobian. May include: core,
/// numerics, force.

#include <wheelrail/force/contact_force.hpp>
#include <wheelrail/force/creep_jacobian.hpp>

namespace wheelrail {

/// Slopes of the forces on the wheel, in the contact frame. Rows: longitudinal, lateral and normal
/// force.
template <Real T>
struct ContactForceJacobian {
  /// Columns: by ContactKinematics' longitudinal, lateral and normal velocity [N s/m].
  Matrix3<T> by_velocity = Matrix3<T>::Zero();
  Vector3<T> by_spin_velocity = Vector3<T>::Zero();  ///< [N s]
  Vector3<T> by_penetration = Vector3<T>::Zero();    ///< [N/m]
  Vector3<T> by_speed = Vector3<T>::Zero();          ///< through the creepages' divisor [N s/m]
  Vector3<T> by_forward_speed = Vector3<T>::Zero();  ///< as rolling turns round [N s/m]
};

/// The derivatives of ContactForceModel by all but the curvatures: creepage (71)-(73), the normal
/// force (63) with (64), the ellipse that grows with it (75), (76), and Polach's forces.
/// @param contact of which penetration, normal and spin velocity, forward speed and speed are used.
/// @param force model(contact).
/// @return all zero unless penetration > 0; see creep_jacobian for kinks. NaN in gives NaN.
/// @note No allocation.
template <Real T>
[[nodiscard]] ContactForceJacobian<T> contact_force_jacobian(const ContactForceModel<T>& model,
                                                             const ContactKinematics<T>& contact,
                                                             const ContactForce<T>& force) {
  using std::sqrt;
  ContactForceJacobian<T> result;
  if (contact.penetration <= T(0)) return result;
  const HertzEllipse<T>& ellipse = force.ellipse;
  const ContactForceOptions<T>& options = model.options();
  const CreepJacobian<T> creep = creep_jacobian(
      force.creepage, PolachContact<T>{ellipse, model.kalker().at(ellipse.a, ellipse.b),
                                       model.materials().shear_modulus(),
                                       options.friction_coefficient, force.normal});

  // (63): f_n = K d^1.5 (c_e + (1 - c_e) r^2 (3 - 2 r)), r of (64).
  const T& ratio = options.normal.restitution_force_ratio;
  const T& tolerance = options.normal.velocity_tolerance;
  const T r =
      detail::clamp(T((tolerance - contact.normal_velocity) / (T(2) * tolerance)), T(0), T(1));
  const T by_closing = force.stiffness * contact.penetration * sqrt(contact.penetration) *
                       (T(1) - ratio) * T(3) * r * (T(1) - r) / tolerance;
  const Vector3<T> by_normal_force(creep.by_normal_force.x(), creep.by_normal_force.y(), T(1));
  result.by_penetration = by_normal_force * T(T(3) * force.normal / (T(2) * contact.penetration));
  result.by_velocity.col(2) = by_normal_force * T(-by_closing);

  const T floor = detail::square(options.creepage.minimum_speed);
  const T inverse_speed = T(1) / sqrt(T(contact.speed * contact.speed + floor));
  const T& forward = contact.forward_speed;
  const T forward_inverse = T(1) / sqrt(T(forward * forward + floor));
  const T forward_cubed = forward_inverse * forward_inverse * forward_inverse;
  const T speed_factor = -contact.speed * inverse_speed * inverse_speed;
  for (Eigen::Index i = 0; i < 2; ++i) {
    const T by_x = creep.by_creepage(i, 0);
    const T by_y = creep.by_creepage(i, 1);
    const T by_spin = creep.by_creepage(i, 2);
    result.by_velocity(i, 0) = by_x * inverse_speed;
    result.by_velocity(i, 1) = by_y * inverse_speed;
    result.by_spin_velocity(i) = by_spin * inverse_speed * forward * forward_inverse;
    result.by_speed(i) =
        speed_factor * (by_x * force.creepage.longitudinal + by_y * force.creepage.lateral +
                        by_spin * force.creepage.spin);
    result.by_forward_speed(i) =
        by_spin * inverse_speed * contact.spin_velocity * floor * forward_cubed;
  }
  return result;
}

}  // namespace wheelrail
