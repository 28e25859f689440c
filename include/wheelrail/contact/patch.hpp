#pragma once
/// @file
/// What a contact search returns: patches and how the search went, the same for every method.
/// May include: core, numerics, profile, surface.

#include <wheelrail/contact/locus.hpp>
#include <wheelrail/contact/rail_foot.hpp>
#include <wheelrail/core/fixed_list.hpp>

namespace wheelrail {

/// One contact patch: the deepest point of one zone in which wheel and rail overlap.
/// Invariant: zone_lower <= wheel_lateral <= zone_upper where the zone is known; normal_rail and
/// longitudinal_rail are orthogonal unit vectors to rounding.
template <Real T>
struct Patch {
  T wheel_lateral = T(0);  ///< u_w, from the tread circle to the field side [m]
  T rail_lateral = T(0);   ///< u_r, from the rail profile's origin to the field side [m]
  /// s_w (57), right-handed about the axle's direction to the field side, 0 straight below [rad]
  T wheel_angle = T(0);
  T longitudinal = T(0);  ///< forwards along the rail from the wheel profile's origin (59) [m]
  T penetration = T(0);   ///< virtual penetration, (33), positive in contact [m]
  T zone_lower =
      T(0);  ///< wheel_lateral where the zone begins (62) [m]; NaN: not known by the method
  T zone_upper = T(0);  ///< wheel_lateral where the zone ends [m]
  /// The zone ends where the wheel's or the rail's profile ends, not where the bodies part.
  bool zone_is_cut = false;
  int wheel_piece = 0;  ///< of the wheel's profile; at a joint, the one whose limit was taken
  /// The least penetration between this patch and the next one of the same zone, at zone_upper [m]; 0
  /// where the zone ends there. Only a search with SearchOptions::blending_length has such patches.
  T penetration_to_next = T(0);
  /// The part of the patch's force that counts, in [0, 1] [-]: see patch_blending.hpp
  T share = T(1);
  /// Slope of the contact plane against the track plane, rising to the field side: positive on the
  /// flange, on both sides [rad]
  T contact_angle = T(0);
  T rolling_radius = T(0);                        ///< nominal radius + F [m]
  T wheel_longitudinal_curvature = T(0);          ///< (27) [1/m]
  T wheel_lateral_curvature = T(0);               ///< (26) [1/m]
  T rail_lateral_curvature = T(0);                ///< (17) [1/m]
  Vector3<T> position_rail = Vector3<T>::Zero();  ///< the wheel's contact point Q [m], rail frame
  Vector3<T> normal_rail = Vector3<T>::UnitZ();   ///< unit normal from rail to wheel, rail frame
  Vector3<T> longitudinal_rail =
      Vector3<T>::UnitX();  ///< unit tangent t_w,s (20) along x, rail frame
};

/// How a search ended.
enum class SearchStatus {
  complete,          ///< every strip, or every part of the profile, was dealt with
  not_converged,     ///< an iteration failed: a patch may be missing
  too_deep,          ///< a patch is deeper than the search is meant for: it means little
  too_many_patches,  ///< more zones than a ContactResult holds: the first ones are returned
  not_finite         ///< the placement holds a NaN or an infinity: nothing was searched
};

/// The status in words, for messages and tables.
[[nodiscard]] constexpr const char* name_of(SearchStatus status) {
  switch (status) {
    case SearchStatus::complete:
      return "complete";
    case SearchStatus::not_converged:
      return "not_converged";
    case SearchStatus::too_deep:
      return "too_deep";
    case SearchStatus::too_many_patches:
      return "too_many_patches";
    case SearchStatus::not_finite:
      return "not_finite";
  }
  return "unknown";
}

/// All patches of one wheel on its rail. No contact is an empty list with status complete.
/// Invariant: patches are in the order of wheel_lateral, from the flange to the field side.
template <Real T>
struct ContactResult {
  static constexpr std::size_t maximum_patches = 8;  ///< most patches that are reported
  FixedList<Patch<T>, maximum_patches> patches;      ///< one for each zone
  SearchStatus status = SearchStatus::complete;      ///< what can be relied on
  /// Strips of the wheel whose feet on the rail were looked for, and Newton systems solved [-]
  int evaluations = 0;
  /// No zone deeper than the depth tolerance that the search was given is missing: see
  /// find_contact.hpp for what is proved, and from what.
  bool is_proved = false;
};

namespace detail {

template <Real T>
[[nodiscard]] bool is_finite_placement(const WheelPlacement<T>& p) {
  return is_finite(p.position_rail.x(), p.position_rail.y(), p.position_rail.z(), p.sin_yaw,
                   p.cos_yaw, p.tan_yaw, p.sin_roll, p.cos_roll) &&
         T(0) < p.cos_yaw;
}

/// The patch at a pair of contact points, its zone not yet known.
/// @param on_rail the rail's. @pre its normal points upwards, as any profile's does.
template <Profile P>
[[nodiscard]] Patch<typename P::Scalar> patch_at(
    const Wheel<P>& wheel, const WheelPlacement<typename P::Scalar>& placement, int piece,
    const typename P::Scalar& wheel_lateral, const ProfilePoint<typename P::Scalar>& wheel_point,
    const WheelAngle<typename P::Scalar>& angle, const ClosestPoint<typename P::Scalar>& on_rail) {
  using std::asin;
  using T = typename P::Scalar;
  const T &normal_lateral = on_rail.normal_rail.x(), &normal_up = on_rail.normal_rail.y();
  const Vector3<T> arm_rail =
      placement.direction_rail(wheel.position_wheel(wheel_lateral, wheel_point, angle));
  Patch<T> patch;
  patch.wheel_lateral = wheel_lateral;
  patch.wheel_piece = piece;
  patch.rail_lateral = on_rail.lateral;
  patch.wheel_angle = asin(angle.sine);
  patch.longitudinal = outboard_sign<T>(placement.side) * arm_rail.x();
  patch.penetration = on_rail.penetration;
  patch.zone_lower = patch.zone_upper = T(0) / T(0);
  patch.contact_angle = arc_tangent(T(-normal_lateral / normal_up)) + placement.inclination;
  patch.rolling_radius = wheel.radius(wheel_point);
  patch.wheel_longitudinal_curvature = wheel.longitudinal_curvature(wheel_point);
  patch.wheel_lateral_curvature = wheel.lateral_curvature(wheel_point);
  patch.rail_lateral_curvature = on_rail.curvature;
  patch.position_rail = placement.position_rail + arm_rail;
  patch.normal_rail = Vector3<T>(T(0), normal_lateral, normal_up);
  patch.longitudinal_rail = placement.direction_rail(wheel.longitudinal_tangent_wheel(angle));
  return patch;
}

template <Profile P, Profile R>
[[nodiscard]] Patch<typename P::Scalar> patch_on_strip_of(
    const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<typename P::Scalar>& placement,
    int piece, const typename P::Scalar& wheel_lateral) {
  using T = typename P::Scalar;
  const ProfilePoint<T> point = wheel.profile().evaluate(piece, wheel_lateral);
  const LocusPoint<T> locus = locus_point(wheel, placement, wheel_lateral, point);
  const ClosestPoint<T> foot = rail_foot(rail.profile(), locus.lateral, locus.up);
  return patch_at(wheel, placement, piece, wheel_lateral, point, locus.angle, foot);
}

// Flat but in dual numbers, as in LocusStrips.
template <Profile P, Profile R>
[[nodiscard, gnu::flatten]] Patch<typename P::Scalar> flat_patch_on_strip(
    const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<typename P::Scalar>& placement,
    int piece, const typename P::Scalar& wheel_lateral) {
  return patch_on_strip_of(wheel, rail, placement, piece, wheel_lateral);
}

/// The patch at a strip's locus point, its zone not yet known.
template <Profile P, Profile R>
[[nodiscard]] Patch<typename P::Scalar> patch_on_strip(
    const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<typename P::Scalar>& placement,
    int piece, const typename P::Scalar& wheel_lateral) {
  if constexpr (has_derivatives<typename P::Scalar>) {
    return patch_on_strip_of(wheel, rail, placement, piece, wheel_lateral);
  } else {
    return flat_patch_on_strip(wheel, rail, placement, piece, wheel_lateral);
  }
}

}  // namespace detail
}  // namespace wheelrail
