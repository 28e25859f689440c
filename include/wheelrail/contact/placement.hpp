#pragma once
/// @file
/// How a wheel lies over its rail: equations (34)-(51) of the paper, with sines and cosines in
/// place of angles. May include: core, numerics, profile, surface.

#include <wheelrail/numerics/detail/arc_tangent.hpp>
#include <wheelrail/surface/rail.hpp>
#include <wheelrail/surface/wheel.hpp>

namespace wheelrail {

/// The pose of a wheel in its rail's frame. The wheel frame's axes are Rx(roll) Rz(yaw) (46)-(51);
/// seen in the track, yaw is positive to the left on both sides, roll where the axle rises towards
/// the field side.
/// Invariant: sine^2 + cosine^2 = 1 for both angles to rounding, cos_yaw > 0, as `place_wheel`
/// makes them; NaN where that was not possible.
template <Real T>
struct WheelPlacement {
  Side side = Side::left;                         ///< of the rail and the wheel
  Vector3<T> position_rail = Vector3<T>::Zero();  ///< of the wheel profile's origin [m]
  T sin_yaw = T(0);                               ///< of yaw() [-]
  T cos_yaw = T(1);                               ///< of yaw() [-]
  T tan_yaw = T(0);                               ///< sin_yaw / cos_yaw [-]
  T sin_roll = T(0);                              ///< of roll() [-]
  T cos_roll = T(1);                              ///< of roll() [-]
  T inclination = T(0);                           ///< of the rail, as in RailFrame [rad]

  /// A direction in the wheel frame, in the rail frame.
  [[nodiscard]] Vector3<T> direction_rail(const Vector3<T>& direction_wheel) const {
    const auto& d = direction_wheel;
    const T y = sin_yaw * d.x() + cos_yaw * d.y();
    return Vector3<T>(cos_yaw * d.x() - sin_yaw * d.y(), cos_roll * y - sin_roll * d.z(),
                      sin_roll * y + cos_roll * d.z());
  }

  /// The placement without the derivatives of its scalar.
  [[nodiscard]] WheelPlacement<ValueOf<T>> values() const {
    if constexpr (has_derivatives<T>) {
      const Vector3<T>& p = position_rail;
      return {side,
              Vector3<ValueOf<T>>(value_of(T(p.x())), value_of(T(p.y())), value_of(T(p.z()))),
              value_of(sin_yaw),
              value_of(cos_yaw),
              value_of(tan_yaw),
              value_of(sin_roll),
              value_of(cos_roll),
              value_of(inclination)};
    } else {
      return *this;
    }
  }

  /// (50) [rad], right-handed about the rail's upward axis after undoing the roll.
  [[nodiscard]] T yaw() const { return detail::arc_tangent(sin_yaw, cos_yaw); }

  /// (47) [rad], right-handed about the rail frame's x axis.
  [[nodiscard]] T roll() const { return detail::arc_tangent(sin_roll, cos_roll); }
};

/// The placement of a wheel over a rail.
/// @param frame the rail frame at the wheel: (36) asks that the wheel's centre lie in its plane
///   x = 0; on a straight rail any frame will do.
/// @param wheel_track the wheel profile's origin [m], track frame (35).
/// @param axle_track unit vector along the axle to the field side of this wheel, track frame.
/// @note Does not allocate. An axle along the rail gives NaN, which a search reports.
template <Real T>
[[nodiscard]] WheelPlacement<T> place_wheel(const RailFrame<T>& frame,
                                            const Vector3<T>& wheel_track,
                                            const Vector3<T>& axle_track) {
  using std::sqrt;
  const Vector3<T> axle_rail = frame.direction_rail(axle_track);
  const T in_section = sqrt(T(axle_rail.y() * axle_rail.y() + axle_rail.z() * axle_rail.z()));
  WheelPlacement<T> placement;
  placement.side = frame.side;
  placement.position_rail = frame.direction_rail(wheel_track - frame.origin_track);
  placement.sin_yaw = -axle_rail.x();
  placement.cos_yaw = in_section;
  placement.tan_yaw = placement.sin_yaw / in_section;
  placement.sin_roll = axle_rail.z() / in_section;
  placement.cos_roll = axle_rail.y() / in_section;
  placement.inclination = frame.inclination;
  return placement;
}

}  // namespace wheelrail
