#pragma once
/// @file
/// The contact locus: for each strip of the wheel, the one point whose normal lies in the rail's
/// cross-section plane (52). Its wheel angle is closed form, s_w = arcsin(tan(yaw) F'(u)) (57);
/// seen along the rail the locus is the wheel's outline.
/// May include: core, numerics, profile, surface.
///
/// A point where wheel and rail touch with a common normal lies on the locus, so that the greatest
/// penetration along it is the greatest over the whole surface. In between, its penetration is that
/// of the outline, which differs from a strip's own by the order of yaw squared.

#include <wheelrail/contact/placement.hpp>

namespace wheelrail {

/// The locus at one strip.
template <Real T>
struct LocusPoint {
  ProfilePoint<T> profile;  ///< of the wheel
  WheelAngle<T> angle;      ///< (57)
  T inverse_cosine = T(1);  ///< of the angle [-]
  T along_rail = T(0);      ///< x of the rail frame, from the wheel profile's origin: (59) [m]
  T lateral = T(0);         ///< y of the rail frame [m]
  T up = T(0);              ///< z of the rail frame [m]
  T lateral_rate = T(0);    ///< d lateral / d wheel_lateral [-]
  T up_rate = T(0);         ///< d up / d wheel_lateral [-]
  bool exists = false;  ///< false where |tan(yaw) F'| >= 1: no normal of the strip is in the plane
};

/// The locus point of one strip of @p wheel.
/// @param wheel_lateral where the strip is [m]. @param point of the wheel's profile there.
/// @note One square root; no trigonometry, no allocation.
template <Profile P>
[[nodiscard]] LocusPoint<typename P::Scalar> locus_point(
    const Wheel<P>& wheel, const WheelPlacement<typename P::Scalar>& placement,
    const typename P::Scalar& wheel_lateral, const ProfilePoint<typename P::Scalar>& point) {
  using std::sqrt;
  using T = typename P::Scalar;
  LocusPoint<T> locus;
  locus.profile = point;
  const T& tan_yaw = placement.tan_yaw;
  const T radius = wheel.radius(point);
  const T sine = tan_yaw * point.slope;
  const T cosine_squared = T(1) - sine * sine;
  if (!(T(0) < cosine_squared)) return locus;
  const T cosine = sqrt(cosine_squared);
  locus.exists = true;
  locus.angle = {sine, cosine};
  locus.inverse_cosine = T(1) / cosine;
  // (59) in the right-handed rail frame: the same sign on both sides.
  locus.along_rail = -(wheel_lateral + radius * point.slope) * placement.sin_yaw;
  // The section plane before the roll: x sin(yaw) is folded into y.
  const T fold = placement.sin_yaw * tan_yaw;
  const T y = wheel_lateral * placement.cos_yaw - radius * point.slope * fold;
  const T z = -radius * cosine;
  // d(R F')/du = F'^2 + R F''; d cos(s_w)/du = -tan^2(yaw) F' F'' / cos(s_w)
  const T y_rate =
      placement.cos_yaw - (point.slope * point.slope + radius * point.second_derivative) * fold;
  const T z_rate = -point.slope * cosine +
                   radius * tan_yaw * sine * point.second_derivative * locus.inverse_cosine;
  locus.lateral = placement.position_rail.y() + placement.cos_roll * y - placement.sin_roll * z;
  locus.up = placement.position_rail.z() + placement.sin_roll * y + placement.cos_roll * z;
  locus.lateral_rate = placement.cos_roll * y_rate - placement.sin_roll * z_rate;
  locus.up_rate = placement.sin_roll * y_rate + placement.cos_roll * z_rate;
  return locus;
}

}  // namespace wheelrail
