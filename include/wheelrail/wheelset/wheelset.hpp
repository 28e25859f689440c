#pragma once
/// @file
/// A wheelset: two wheels on one axle, where it is and how it moves; equations (5), (6), (35),
/// (66). May include: core, numerics, profile, surface, contact, force, track.

#include <array>
#include <wheelrail/contact/find_contact.hpp>
#include <wheelrail/core/side.hpp>

namespace wheelrail {

/// The axle's direction, to the left, for given angles: Rz(yaw) Rx(roll) e_y, track frame.
/// @param roll [rad], positive where the left wheel rises.
/// @param yaw [rad], positive to the left.
template <Real T>
[[nodiscard]] Vector3<T> axle_direction(const T& roll, const T& yaw) {
  using std::cos;
  using std::sin;
  const T in_plane = cos(roll);
  return Vector3<T>(-sin(yaw) * in_plane, cos(yaw) * in_plane, sin(roll));
}

/// Where a wheelset is, as far as contact is concerned: its spin about the axle does not matter.
template <Real T>
struct WheelsetPosition {
  Vector3<T> position_track = Vector3<T>::Zero();  ///< the axle's centre [m]
  Vector3<T> axle_track = Vector3<T>::UnitY();     ///< unit vector along the axle to the left
  /// Where along a curved track the rails are looked for first [m]: that of the time before. The
  /// result does not depend on it. A tangent track needs none.
  T arc_length = T(0);

  /// From lateral shift (to the left) and height of the axle's centre [m], roll and yaw [rad].
  [[nodiscard]] static WheelsetPosition of(const T& lateral_shift, const T& height, const T& roll,
                                           const T& yaw) {
    return {Vector3<T>(T(0), lateral_shift, height), axle_direction(roll, yaw), T(0)};
  }
};

/// How a wheelset moves.
template <Real T>
struct WheelsetMotion {
  Vector3<T> velocity_track = Vector3<T>::Zero();          ///< of the axle's centre [m/s]
  Vector3<T> angular_velocity_track = Vector3<T>::Zero();  ///< [rad/s]; rolling forwards is +y

  /// Of the axle's centre [m/s]. At rest it has no derivative and is a constant in dual numbers; the
  /// creep forces do not depend on it there.
  [[nodiscard]] T speed() const {
    using std::sqrt;
    const T squared = dot(velocity_track, velocity_track);
    return squared == T(0) ? T(0) : T(sqrt(squared));
  }
};

/// Two wheels, `profile_spacing` apart. Valid for good once constructed.
/// @note Queries do not allocate.
template <Profile P>
class Wheelset {
 public:
  using Scalar = typename P::Scalar;  ///< the numbers of its coordinates
  using T = Scalar;                   ///< the same, short

  /// Equal wheels.
  /// @param profile_spacing distance of the two profiles' origins along the axle [m] (H of (6)).
  /// @throws std::invalid_argument as Wheel does, and unless profile_spacing is finite and > 0.
  Wheelset(const P& profile, const T& nominal_radius, const T& profile_spacing)
      : Wheelset(Wheel<P>(profile, nominal_radius), Wheel<P>(profile, nominal_radius),
                 profile_spacing) {}

  /// Wheels of their own on the left and on the right.
  Wheelset(Wheel<P> left, Wheel<P> right, const T& profile_spacing)
      : wheels_{std::move(left), std::move(right)}, profile_spacing_(profile_spacing) {
    detail::require_positive("wheelset: profile spacing", profile_spacing_, "[m]");
  }

  /// That of one side.
  [[nodiscard]] const Wheel<P>& wheel(Side side) const { return wheels_[index_of(side)]; }
  [[nodiscard]] const T& profile_spacing() const { return profile_spacing_; }  ///< H of (6) [m]

  /// (35): the wheel profile's origin [m], track frame.
  [[nodiscard]] Vector3<T> wheel_track(Side side, const WheelsetPosition<T>& at) const {
    return at.position_track + (outboard_sign<T>(side) * profile_spacing_ / T(2)) * at.axle_track;
  }

 private:
  std::array<Wheel<P>, 2> wheels_;
  T profile_spacing_;
};

/// The placement of one wheel of a wheelset over its rail.
/// @param track anything with `nearest_frame(side, point_track, guess)`, as TangentTrack has.
template <Profile P, class Track>
[[nodiscard]] WheelPlacement<typename P::Scalar> place_wheel(
    const Wheelset<P>& wheelset, const Track& track, Side side,
    const WheelsetPosition<typename P::Scalar>& at) {
  using T = typename P::Scalar;
  const Vector3<T> wheel_track = wheelset.wheel_track(side, at);
  return place_wheel(track.nearest_frame(side, wheel_track, at.arc_length), wheel_track,
                     Vector3<T>(outboard_sign<T>(side) * at.axle_track));
}

}  // namespace wheelrail
