#pragma once
/// @file
/// What a simulator calls: both wheels' patches, their forces, and the wrench on the wheelset for a
/// position and a motion; equations (65), (66), (71)-(74). May include: all but dynamics and io.

#include <wheelrail/force/contact_force.hpp>
#include <wheelrail/wheelset/search_method.hpp>
#include <wheelrail/wheelset/wheelset.hpp>

namespace wheelrail {

/// A patch with its forces. The contact frame is right-handed on both sides: longitudinal_track
/// points forward, lateral_track to the left, normal_track from the rail into the wheel.
template <Real T>
struct PatchForce {
  Patch<T> patch;  ///< as the search found it
  /// Components in the contact frame, on the wheel: the forces times patch.share; the ellipse and
  /// the stiffness are those of the whole force.
  ContactForce<T> contact;
  Vector3<T> position_track = Vector3<T>::Zero();       ///< the wheel's contact point Q [m]
  Vector3<T> longitudinal_track = Vector3<T>::UnitX();  ///< x of the contact frame [-]
  Vector3<T> lateral_track = Vector3<T>::UnitY();       ///< y of the contact frame [-]
  Vector3<T> normal_track = Vector3<T>::UnitZ();        ///< z of the contact frame [-]
  Vector3<T> force_track = Vector3<T>::Zero();          ///< total force on the wheel [N]
  T penetration_velocity = T(0);                        ///< (65) with its erratum mended [m/s]
};

/// One wheel of a wheelset.
template <Real T>
struct WheelForces {
  /// In the order of ContactResult.
  FixedList<PatchForce<T>, ContactResult<T>::maximum_patches> patches;
  Vector3<T> force_track = Vector3<T>::Zero();   ///< sum over the patches [N]
  Vector3<T> moment_track = Vector3<T>::Zero();  ///< about the axle's centre [N m]
  T arc_length = T(0);                           ///< of the rail frame under the wheel [m]
  SearchStatus status = SearchStatus::complete;  ///< of the search: what patches can be relied on
  int evaluations = 0;  ///< of the search, as ContactResult counts them [-]
};

/// Both wheels and the wrench of the rails on the wheelset.
template <Real T>
struct WheelsetForces {
  std::array<WheelForces<T>, 2> wheels;          ///< ordered as `sides`
  Vector3<T> force_track = Vector3<T>::Zero();   ///< on the wheelset [N]
  Vector3<T> moment_track = Vector3<T>::Zero();  ///< on the wheelset, about the axle's centre [N m]

  /// That of one side.
  [[nodiscard]] const WheelForces<T>& wheel(Side side) const { return wheels[index_of(side)]; }
};

namespace detail {

/// The forces of one patch. @p arm_track from the axle's centre to the contact point [m].
template <Real T>
[[nodiscard]] PatchForce<T> patch_force(const Patch<T>& patch, const RailFrame<T>& frame,
                                        const WheelsetPosition<T>& at,
                                        const WheelsetMotion<T>& motion,
                                        const ContactForceModel<T>& model) {
  const Vector3<T> position_track = frame.position_track(patch.position_rail);
  const Vector3<T> normal_track = frame.direction_track(patch.normal_rail);
  // The rail frame's x points backwards on the right.
  const Vector3<T> longitudinal_track =
      outboard_sign<T>(frame.side) * frame.direction_track(patch.longitudinal_rail);
  const Vector3<T> lateral_track = cross(normal_track, longitudinal_track);

  const Vector3<T> arm_track = position_track - at.position_track;
  const Vector3<T> velocity_track =  // (66); the rail is at rest
      motion.velocity_track + cross(motion.angular_velocity_track, arm_track);
  ContactKinematics<T> contact;
  contact.penetration = patch.penetration;
  contact.curvatures =
      hertz_curvatures(patch.wheel_longitudinal_curvature, T(0), patch.wheel_lateral_curvature,
                       patch.rail_lateral_curvature);
  contact.longitudinal_velocity = dot(velocity_track, longitudinal_track);
  contact.lateral_velocity = dot(velocity_track, lateral_track);
  contact.normal_velocity = dot(velocity_track, normal_track);
  contact.spin_velocity = dot(motion.angular_velocity_track, normal_track);
  contact.forward_speed = outboard_sign<T>(frame.side) *
                          dot(motion.velocity_track, Vector3<T>(frame.axes_track.col(0)));
  contact.speed = motion.speed();
  ContactForce<T> force = model(contact);
  force.normal *= patch.share;
  force.creep.longitudinal *= patch.share;
  force.creep.lateral *= patch.share;
  return {.patch = patch,
          .contact = force,
          .position_track = position_track,
          .longitudinal_track = longitudinal_track,
          .lateral_track = lateral_track,
          .normal_track = normal_track,
          .force_track = force.normal * normal_track +
                         force.creep.longitudinal * longitudinal_track +
                         force.creep.lateral * lateral_track,
          .penetration_velocity = -contact.normal_velocity};
}

/// One wheel's part of wheelset_forces().
template <Profile P, class Track, class Search>
[[nodiscard]] WheelForces<typename P::Scalar> wheel_forces(
    const Wheelset<P>& wheelset, const Track& track, Side side,
    const WheelsetPosition<typename P::Scalar>& at,
    const WheelsetMotion<typename P::Scalar>& motion,
    const ContactForceModel<typename P::Scalar>& model, Search& search) {
  using T = typename P::Scalar;
  const Vector3<T> wheel_track = wheelset.wheel_track(side, at);
  const RailFrame<T> frame = track.nearest_frame(side, wheel_track, at.arc_length);
  const ContactResult<T> found =
      search(wheelset.wheel(side), track.rail(side),
             place_wheel(frame, wheel_track, Vector3<T>(outboard_sign<T>(side) * at.axle_track)));
  WheelForces<T> wheel;
  wheel.status = found.status;
  wheel.arc_length = frame.arc_length;
  wheel.evaluations = found.evaluations;
  for (const Patch<T>& patch : found.patches) {
    // As many as the search can return.
    static_cast<void>(
        wheel.patches.push_back_made([&] { return patch_force(patch, frame, at, motion, model); }));
  }
  for (const PatchForce<T>& force : wheel.patches) {
    wheel.force_track += force.force_track;
    wheel.moment_track +=
        cross(Vector3<T>(force.position_track - at.position_track), force.force_track);
  }
  return wheel;
}

}  // namespace detail

/// The forces of the track on a wheelset.
/// @param track anything with `rail(side)` and `nearest_frame(side, point_track, guess)`.
/// @param at where the wheelset is, @param motion how it moves, both in the track frame.
/// @param search StripSearch or, from step to step, WarmStripSearch for any profile;
///   MinimumDistanceSearch or WarmMinimumDistanceSearch for convex ones. With `{.blending_length =
///   0.003}` the first two give a wrench that does not jump, for solvers that rely on its
///   derivatives: see contact/patch_blending.hpp. A model without_kinks() belongs to it.
/// @return patches, forces and the wrench about the axle's centre. The creep moment about a
///   contact's normal is neglected (80).
/// @note Does not allocate. A mirrored input gives the mirrored result to the last bit.
template <Profile P, class Track, class Search = StripSearch<typename P::Scalar>>
[[nodiscard]] WheelsetForces<typename P::Scalar> wheelset_forces(
    const Wheelset<P>& wheelset, const Track& track, const WheelsetPosition<typename P::Scalar>& at,
    const WheelsetMotion<typename P::Scalar>& motion,
    const ContactForceModel<typename P::Scalar>& model, Search&& search = {}) {
  using T = typename P::Scalar;
  // Each wheel's result is made in its place: large lists are neither cleared nor copied.
  const auto of = [&](Side side) {
    return detail::wheel_forces(wheelset, track, side, at, motion, model, search);
  };
  WheelsetForces<T> result{.wheels = {of(Side::left), of(Side::right)}};
  for (const WheelForces<T>& wheel : result.wheels) {
    result.force_track += wheel.force_track;
    result.moment_track += wheel.moment_track;
  }
  return result;
}

}  // namespace wheelrail
