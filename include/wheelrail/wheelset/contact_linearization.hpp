#pragma once
/// @file
/// A wheelset on its contacts for small changes of its motion: the slopes of the rails' wrench in
/// closed form, from forces that are known already, and what they say of the largest stable step of
/// an explicit integrator. May include: all but dynamics and io.

#include <Eigen/Eigenvalues>
#include <wheelrail/force/contact_force_jacobian.hpp>
#include <wheelrail/numerics/explicit_method.hpp>
#include <wheelrail/wheelset/wheelset_forces.hpp>

namespace wheelrail {

/// Slopes of the wrench on a wheelset, in the track frame. Rows: force, moment about the axle's
/// centre. Columns: the same of the motion, translation [m] or [m/s], then rotation [rad] or
/// [rad/s].
template <Real T>
struct WrenchJacobian {
  using Matrix = Eigen::Matrix<T, 6, 6, Eigen::DontAlign>;  ///< rows and columns as above

  Matrix by_velocity = Matrix::Zero();      ///< [N s/m] and its like: all of it, at this position
  Matrix by_displacement = Matrix::Zero();  ///< [N/m] and its like: of the penetrations only
};

/// The slopes of wheelset_forces. By the velocities they are complete, but for what a model
/// without_kinks() rounds off near the kink of (86). By the displacements they
/// are those of the penetrations, while contact points and normals stay where they are on the
/// wheel: the stiff part, some 3 f_n / (2 d). Left out are the slopes that make slow motions:
/// gravitational stiffness, some f_n over a radius, and how lateral shift and yaw change creepages.
/// @param forces wheelset_forces of @p at, @p motion and @p model.
/// @note No allocation.
template <Real T>
[[nodiscard]] WrenchJacobian<T> wrench_jacobian(const WheelsetForces<T>& forces,
                                                const WheelsetPosition<T>& at,
                                                const WheelsetMotion<T>& motion,
                                                const ContactForceModel<T>& model) {
  using Rows = Eigen::Matrix<T, 3, 6, Eigen::DontAlign>;
  WrenchJacobian<T> result;
  ContactKinematics<T> contact;
  contact.speed = motion.speed();
  for (const Side side : sides) {
    for (const PatchForce<T>& patch : forces.wheel(side).patches) {
      const Vector3<T> arm_track = patch.position_track - at.position_track;
      // The velocities of the wheel's material point along the contact frame's axes, by the motion;
      // transposed, the wrenches of forces along them.
      Rows velocities;
      velocities << patch.longitudinal_track.transpose(),
          cross(arm_track, patch.longitudinal_track).transpose(), patch.lateral_track.transpose(),
          cross(arm_track, patch.lateral_track).transpose(), patch.normal_track.transpose(),
          cross(arm_track, patch.normal_track).transpose();
      // x of the rail frame, forwards: known in the contact frame by its components there.
      const Vector3<T>& normal_rail = patch.patch.normal_rail;
      const Vector3<T>& longitudinal_rail = patch.patch.longitudinal_rail;
      const Vector3<T> forward_track =
          longitudinal_rail.x() * patch.longitudinal_track +
          cross(normal_rail, longitudinal_rail).x() * patch.lateral_track +
          outboard_sign<T>(side) * normal_rail.x() * patch.normal_track;

      contact.penetration = patch.patch.penetration;
      contact.normal_velocity = -patch.penetration_velocity;
      contact.spin_velocity = dot(motion.angular_velocity_track, patch.normal_track);
      contact.forward_speed = dot(motion.velocity_track, forward_track);
      const T& share = patch.patch.share;
      const ContactForceJacobian<T> slopes =
          contact_force_jacobian(model, contact, share == T(1) ? patch.contact : model(contact));
      Rows by_velocity = slopes.by_velocity * velocities;
      by_velocity.template rightCols<3>() +=
          slopes.by_spin_velocity * patch.normal_track.transpose();
      by_velocity.template leftCols<3>() += slopes.by_forward_speed * forward_track.transpose();
      if (T(0) < contact.speed) {
        by_velocity.template leftCols<3>() +=
            slopes.by_speed * (motion.velocity_track / contact.speed).transpose();
      }
      result.by_velocity += share * (velocities.transpose() * by_velocity);
      result.by_displacement -=
          share * (velocities.transpose() * slopes.by_penetration * velocities.row(2));
    }
  }
  return result;
}

/// Mass and principal moments of inertia of a wheelset, turning about its axle.
template <Real T>
struct WheelsetInertia {
  T mass = T(0);          ///< [kg], > 0
  T roll_inertia = T(0);  ///< about the axle's normals through its centre [kg m2], > 0
  T spin_inertia = T(0);  ///< about the axle [kg m2], > 0
};

/// An estimate of the largest stable step of an explicit integrator for a wheelset that is held by
/// its contacts only, at the state of the @p slopes; without a contact search or differences.
///
/// Creep damps the wheelset at the rates c11 G a b / (v m) and its like, which grow without limit
/// as the speed falls, and the contacts make it vibrate at sqrt(3 f_n / (2 d m)). The slow motions
/// that the linearization leaves out, hunting above all, limit no step. Suspensions do if they are
/// stiffer than the contacts, in series with lighter bodies: then linearize the whole system.
/// @param axle_track as in WheelsetPosition. Gyroscopic moments are left out; their rate is below
///   that of the rolling.
/// @return see StableStep; infinite without a contact. The step can shrink while the motion goes
///   on: with the speed, and as sliding wheels grip.
/// @pre the inertias are > 0. @note No allocation.
template <std::floating_point T>
[[nodiscard]] StableStep<T> contact_stable_step(ExplicitMethod method,
                                                const WrenchJacobian<T>& slopes,
                                                const Vector3<T>& axle_track,
                                                const WheelsetInertia<T>& inertia,
                                                const StableStepOptions<T>& options = {}) {
  using Matrix = Eigen::Matrix<T, 12, 12>;
  Eigen::Matrix<T, 6, 6> inverse_mass = Eigen::Matrix<T, 6, 6>::Zero();
  inverse_mass.template topLeftCorner<3, 3>().diagonal().setConstant(T(1) / inertia.mass);
  inverse_mass.template bottomRightCorner<3, 3>() =
      (T(1) / inertia.spin_inertia - T(1) / inertia.roll_inertia) * axle_track *
      axle_track.transpose();
  inverse_mass.template bottomRightCorner<3, 3>().diagonal().array() += T(1) / inertia.roll_inertia;
  Matrix state_matrix = Matrix::Zero();
  state_matrix.template topRightCorner<6, 6>().setIdentity();
  state_matrix.template bottomLeftCorner<6, 6>() = inverse_mass * slopes.by_displacement;
  state_matrix.template bottomRightCorner<6, 6>() = inverse_mass * slopes.by_velocity;
  StableStep<T> result;
  if (!state_matrix.allFinite()) return result;
  const Eigen::EigenSolver<Matrix> solver(state_matrix, false);
  if (solver.info() != Eigen::Success) {
    result.status = SolveStatus::iteration_limit;
    return result;
  }
  return largest_stable_step(
      method, std::span<const std::complex<T>>(solver.eigenvalues().data(), 12), options);
}

}  // namespace wheelrail
