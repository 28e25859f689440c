#pragma once
/// @file
/// Rigid contact kinematics of a wheelset: where both wheels touch for a lateral shift and a yaw
/// angle, with the axle's roll or without it. Contact points, rolling radii, contact angles, and
/// the lateral force of the axle load. May include: all but dynamics and io.

#include <utility>
#include <wheelrail/contact/find_contact.hpp>
#include <wheelrail/numerics/bracketed_root.hpp>
#include <wheelrail/wheelset/wheelset.hpp>

namespace wheelrail {

/// How the wheels are set down.
template <Real T>
struct KinematicsOptions {
  /// true: both wheels touch, the roll is solved for. false: no roll, each wheel touches at a
  /// height of its own, as in EN 15302 and UIC 519.
  bool with_roll = true;
  /// All places where penetration > -closeness are listed [m], > 0. Places between which the gap
  /// does not exceed the closeness are one, listed where it is least. At least 4 tolerances are
  /// taken.
  T closeness = constant<T>(1e-6L);
  /// |penetration of the nearest point| <= tolerance [m], >= 0; 0 means 64 rounding units of the
  /// nominal radius. With roll, the two wheels' heights agree to 16 of them.
  T tolerance = T(0);
  int maximum_iterations = 60;  ///< of a wheel's height, and of the roll, >= 1
};

/// How setting a wheel or a wheelset down ended.
enum class TouchStatus {
  touching,       ///< the contact was found
  no_contact,     ///< the wheel does not lie over its rail
  profile_end,    ///< the nearest point is an end of the wheel's or the rail's profile: no contact
  not_converged,  ///< an iteration or a contact search reached its limit
  not_finite,     ///< a NaN or an infinity went in or came up
  bad_options     ///< an option breaks its rule: nothing was solved
};

/// The status in words, for messages and tables.
[[nodiscard]] constexpr const char* name_of(TouchStatus status) {
  switch (status) {
    case TouchStatus::touching:
      return "touching";
    case TouchStatus::no_contact:
      return "no_contact";
    case TouchStatus::profile_end:
      return "profile_end";
    case TouchStatus::not_converged:
      return "not_converged";
    case TouchStatus::not_finite:
      return "not_finite";
    case TouchStatus::bad_options:
      return "bad_options";
  }
  return "unknown";
}

/// One wheel that touches its rail. Invariant: status == touching implies that there is a patch,
/// that they are in the order of penetration, deepest first, and |patches[0].penetration| <= the
/// tolerance.
template <Real T>
struct WheelTouch {
  /// The contact and all that are close to it; `penetration` is minus the gap [m]. A patch's zone
  /// is where penetration > -closeness.
  FixedList<Patch<T>, ContactResult<T>::maximum_patches> patches;
  T height = T(0);           ///< of the axle's centre, at which this wheel touches [m]
  T height_by_shift = T(0);  ///< d height / d lateral_shift at constant roll [-]
  T height_by_roll = T(0);   ///< d height / d roll at constant lateral shift [m/rad]
  TouchStatus status = TouchStatus::not_finite;  ///< touching: all is there

  /// The contact. @pre status == touching
  [[nodiscard]] const Patch<T>& contact() const { return patches[0]; }
};

/// A wheelset on its rails. Unless status == touching, only lateral_shift, yaw and the status of
/// each wheel mean anything.
template <Real T>
struct WheelsetKinematics {
  T lateral_shift = T(0);               ///< of the axle's centre, to the left [m]
  T yaw = T(0);                         ///< to the left [rad]
  T roll = T(0);                        ///< [rad], positive where the left wheel rises
  T height = T(0);                      ///< of the axle's centre, the mean over both wheels [m]
  T height_slope = T(0);                ///< d height / d lateral_shift, roll following [-]
  T roll_slope = T(0);                  ///< d roll / d lateral_shift [rad/m]
  std::array<WheelTouch<T>, 2> wheels;  ///< ordered as `sides`
  TouchStatus status = TouchStatus::not_finite;  ///< touching: both wheels touch

  /// That of one side.
  [[nodiscard]] const WheelTouch<T>& wheel(Side side) const { return wheels[index_of(side)]; }

  /// Rolling radius of the left wheel less that of the right one [m]; as a rule it grows with a
  /// shift to the left. EN 15302 lists right less left over a shift to the right: -Delta r at
  /// -lateral_shift.
  /// @pre status == touching
  [[nodiscard]] T rolling_radius_difference() const {
    return wheels[0].contact().rolling_radius - wheels[1].contact().rolling_radius;
  }

  /// What the normal forces of the contacts push the wheelset to the left with [N], without
  /// friction, when they carry @p axle_load [N] that acts at the axle's centre: -axle_load
  /// height_slope, by virtual work. Without roll each wheel carries one half.
  [[nodiscard]] T lateral_force(const T& axle_load) const { return -axle_load * height_slope; }
};

/// Gravitational stiffness [N/m] between two shifts: minus the change of the lateral force of the
/// normal forces over the change of the shift, which is axle_load times the second difference of
/// the axle's height, the second derivative of the potential energy. Positive where it centres.
/// Over a jump of the contact point it holds for this interval only. Definition: Wickens,
/// Fundamentals of Rail Vehicle Dynamics (2003), there without yaw.
/// @param axle_load of both wheels together [N]. @pre both are touching, their shifts differ.
template <Real T>
[[nodiscard]] T gravitational_stiffness(const WheelsetKinematics<T>& one,
                                        const WheelsetKinematics<T>& other, const T& axle_load) {
  return (one.lateral_force(axle_load) - other.lateral_force(axle_load)) /
         (other.lateral_shift - one.lateral_shift);
}

namespace detail {

/// Sets the wheels of a wheelset down for one lateral shift and yaw.
template <Profile P, class Track>
class WheelsetSetter {
 public:
  using T = typename P::Scalar;

  WheelsetSetter(const Wheelset<P>& wheelset, const Track& track,
                 const KinematicsOptions<T>& options, const T& lateral_shift, const T& yaw)
      : wheelset_(wheelset),
        track_(track),
        with_roll_(options.with_roll),
        maximum_iterations_(options.maximum_iterations),
        lateral_shift_(lateral_shift),
        yaw_(yaw) {
    using std::cos;
    using std::sin;
    roll_axis_track_ = Vector3<T>(cos(yaw), sin(yaw), T(0));
    const T& radius = wheelset.wheel(Side::left).nominal_radius();
    tolerance_ = T(0) < options.tolerance ? options.tolerance : T(T(64) * epsilon<T>() * radius);
    closeness_ = max(options.closeness, T(T(4) * tolerance_));
  }

  /// @param start a roll [rad] and heights [m] to start from, with their derivatives.
  [[nodiscard]] WheelsetKinematics<T> run(const WheelsetKinematics<T>& start) const {
    WheelsetKinematics<T> at = start;
    at.lateral_shift = lateral_shift_;
    at.yaw = yaw_;
    const T motion = lateral_shift_ - start.lateral_shift;
    for (WheelTouch<T>& wheel : at.wheels) wheel.height += wheel.height_by_shift * motion;
    if (with_roll_) {
      solve_roll(at, T(start.roll + start.roll_slope * motion));
    } else {
      turn_to(at, T(0));
    }
    at.status =
        at.wheels[0].status == TouchStatus::touching ? at.wheels[1].status : at.wheels[0].status;
    const WheelTouch<T>& left = at.wheels[0];
    const WheelTouch<T>& right = at.wheels[1];
    const T heights_differ = magnitude(T(left.height - right.height));
    if (at.status == TouchStatus::touching && with_roll_ &&
        !(heights_differ <= T(16) * tolerance_)) {
      at.status = TouchStatus::not_converged;
    }
    at.height = (left.height + right.height) / T(2);
    at.roll_slope = T(0);
    if (with_roll_) {
      at.roll_slope = (right.height_by_shift - left.height_by_shift) /
                      (left.height_by_roll - right.height_by_roll);
    }
    at.height_slope = (left.height_by_shift + right.height_by_shift +
                       (left.height_by_roll + right.height_by_roll) * at.roll_slope) /
                      T(2);
    return at;
  }

  // One wheel at a given roll, from a height to start with. The height falls until something is
  // near; from there Newton's method, whose function, the greatest penetration, falls with the
  // height whichever point is the deepest.
  [[nodiscard]] WheelTouch<T> set_down(Side side, const T& roll, const T& start) const {
    const Wheel<P>& wheel = wheelset_.wheel(side);
    WheelTouch<T> touch;
    touch.height = start;
    T reach = T(10) * closeness_;
    for (int i = 0; i < maximum_iterations_; ++i) {
      auto at = WheelsetPosition<T>::of(lateral_shift_, touch.height, roll, yaw_);
      const Vector3<T> wheel_track = wheelset_.wheel_track(side, at);
      const RailFrame<T> frame = track_.nearest_frame(side, wheel_track, T(0));
      const auto placement =
          place_wheel(frame, wheel_track, Vector3<T>(outboard_sign<T>(side) * at.axle_track));
      const bool is_close = reach <= closeness_;
      const auto found = find_contact(
          wheel, track_.rail(side), placement,
          SearchOptions<ValueOf<T>>{.penetration_threshold = -value_of(reach),
                                    .maximum_penetration = value_of(wheel.nominal_radius()),
                                    .zone_ends = is_close});
      touch.status = found.status == SearchStatus::not_finite ? TouchStatus::not_finite
                                                              : TouchStatus::not_converged;
      if (found.status != SearchStatus::complete) return touch;
      if (found.patches.empty()) {
        touch.status = TouchStatus::no_contact;
        touch.height -= reach / T(2);
        reach *= T(4);
        if (wheel.nominal_radius() < reach) return touch;
        continue;
      }
      touch.patches = found.patches;
      sort(touch.patches);
      const Patch<T>& deepest = touch.patches[0];
      const Vector3<T> normal_track = frame.direction_track(deepest.normal_rail);
      const Vector3<T> arm_track = frame.position_track(deepest.position_rail) - at.position_track;
      touch.height_by_shift = -normal_track.y() / normal_track.z();
      touch.height_by_roll =
          -dot(normal_track, cross(roll_axis_track_, arm_track)) / normal_track.z();
      const T depth = magnitude(deepest.penetration);
      if (is_close && depth <= tolerance_) {
        touch.status = is_contact(wheel, placement, deepest) ? TouchStatus::touching
                                                             : TouchStatus::profile_end;
        return touch;
      }
      touch.height += deepest.penetration / normal_track.z();
      if (!is_finite(touch.height)) {
        touch.status = TouchStatus::not_finite;
        return touch;
      }
      // Newton's next error is of second order: near the end it is far below the closeness.
      reach = depth < T(10) * closeness_ ? closeness_ : max(closeness_, min(reach, depth));
    }
    return touch;
  }

 private:
  // The height at which a wheel touches falls with the roll on one side and rises on the other (but
  // on flanges steeper than a rolling axle allows, where there is no solution that is stable). At a
  // jump of the contact point both keep on, with a kink: a bracket is safe where Newton's method in
  // two unknowns may alternate.
  void solve_roll(WheelsetKinematics<T>& at, const T& start) const {
    const T reach = constant<T>(0.1L);
    const auto root = bracketed_newton<T>(
        [&](const T& roll) {
          turn_to(at, roll);
          const WheelTouch<T>& left = at.wheels[0];
          const WheelTouch<T>& right = at.wheels[1];
          const bool touches =
              left.status == TouchStatus::touching && right.status == TouchStatus::touching;
          return ValueAndSlope<T>{touches ? T(left.height - right.height) : T(T(0) / T(0)),
                                  T(left.height_by_roll - right.height_by_roll)};
        },
        // Of the values at the ends only the signs matter.
        T(start - reach), T(start + reach), reach, T(-reach), start,
        {.residual_tolerance = T(4) * tolerance_, .maximum_iterations = maximum_iterations_});
    if (root.status == SolveStatus::converged && root.position != at.roll) {
      turn_to(at, root.position);
    }
  }

  void turn_to(WheelsetKinematics<T>& at, const T& roll) const {
    for (const Side side : sides) {
      WheelTouch<T>& wheel = at.wheels[index_of(side)];
      const T height = wheel.height + wheel.height_by_roll * (roll - at.roll);
      wheel = set_down(side, roll, height);
    }
    at.roll = roll;
  }

  // Whether the normals face each other: not so where a profile ends. 1e-6 is an angle of 1.4 mrad.
  [[nodiscard]] static bool is_contact(const Wheel<P>& wheel, const WheelPlacement<T>& placement,
                                       const Patch<T>& patch) {
    if (!patch.zone_is_cut) return true;
    const auto angle = WheelAngle<T>::of(patch.wheel_angle);
    const auto point = wheel.profile().evaluate(patch.wheel_lateral);
    const Vector3<T> normal_rail = placement.direction_rail(wheel.normal_wheel(point, angle));
    return magnitude(T(T(1) + dot(normal_rail, patch.normal_rail))) < constant<T>(1e-6L);
  }

  static void sort(FixedList<Patch<T>, ContactResult<T>::maximum_patches>& patches) {
    for (std::size_t i = 1; i < patches.size(); ++i) {
      for (std::size_t k = i; k > 0 && patches[k - 1].penetration < patches[k].penetration; --k) {
        std::swap(patches[k - 1], patches[k]);
      }
    }
  }

  const Wheelset<P>& wheelset_;
  const Track& track_;
  bool with_roll_;
  int maximum_iterations_;
  T lateral_shift_;
  T yaw_;
  Vector3<T> roll_axis_track_;
  T tolerance_;
  T closeness_;
};

/// Whether each option keeps the rule in its comment.
template <Real T>
[[nodiscard]] bool are_valid(const KinematicsOptions<T>& options) {
  return is_finite(options.closeness) && T(0) < options.closeness && is_finite(options.tolerance) &&
         !(options.tolerance < T(0)) && 1 <= options.maximum_iterations;
}

/// What is known of a wheelset before anything is solved: level, on its nominal radii.
template <Profile P>
[[nodiscard]] WheelsetKinematics<typename P::Scalar> level_start(const Wheelset<P>& wheelset) {
  using T = typename P::Scalar;
  WheelsetKinematics<T> start;
  start.roll = start.roll_slope = start.lateral_shift = T(0);
  for (const Side side : sides) {
    WheelTouch<T>& wheel = start.wheels[index_of(side)];
    wheel.height = wheelset.wheel(side).nominal_radius();
    wheel.height_by_shift = T(0);
    wheel.height_by_roll = -outboard_sign<T>(side) * wheelset.profile_spacing() / T(2);
  }
  return start;
}

}  // namespace detail

/// Sets a wheelset down on its rails, which are rigid: the greatest penetration of each wheel is 0.
/// Wheels and rails may differ from left to right, nominal radii too.
/// @param track anything with `rail(side)` and `nearest_frame(side, point_track, guess)`, straight
///   along x at x = 0, where the axle's centre is.
/// @param lateral_shift of the axle's centre, to the left [m]. @param yaw to the left [rad].
/// @return status touching when both wheels touch. At a jump of the contact point two places touch,
///   and both are listed; there any of them may be the first.
/// @note Does not allocate. With equal sides a mirrored shift and yaw give the mirrored contact.
template <Profile P, class Track>
[[nodiscard]] WheelsetKinematics<typename P::Scalar> wheelset_kinematics(
    const Wheelset<P>& wheelset, const Track& track, const typename P::Scalar& lateral_shift,
    const typename P::Scalar& yaw = typename P::Scalar(0),
    const KinematicsOptions<typename P::Scalar>& options = {}) {
  auto start = detail::level_start(wheelset);
  if (!detail::are_valid(options)) {
    start.lateral_shift = lateral_shift;
    start.yaw = yaw;
    for (auto& wheel : start.wheels) wheel.status = TouchStatus::bad_options;
    start.status = TouchStatus::bad_options;
    return start;
  }
  return detail::WheelsetSetter<P, Track>(wheelset, track, options, lateral_shift, yaw).run(start);
}

}  // namespace wheelrail
