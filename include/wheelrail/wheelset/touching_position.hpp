#pragma once
/// @file
/// A wheelset set down on its track: height and roll for which both wheels are at a given gap.
/// Rigid contact, and the start of a simulation. May include: all but dynamics and io.

#include <wheelrail/contact/find_contact.hpp>
#include <wheelrail/wheelset/wheelset.hpp>

namespace wheelrail {

/// How a wheelset is to be set down.
template <Real T>
struct TouchingOptions {
  T gap = T(0);  ///< distance left between each wheel and its rail [m]; negative: penetration
  /// |greatest penetration + gap| <= tolerance on both wheels [m]; 0 means 64 rounding units of the
  /// nominal radius.
  T tolerance = T(0);
  int maximum_iterations = 40;  ///< Newton steps
};

/// A wheelset set down. Invariant: status == converged implies residual <= the tolerance.
template <Real T>
struct TouchingPosition {
  WheelsetPosition<T> position;     ///< track frame
  T height = T(0);                  ///< of the axle's centre [m]
  T roll = T(0);                    ///< [rad]
  std::array<Patch<T>, 2> patches;  ///< nearest points, left and right; penetration = -gap
  T residual = T(0);                ///< the greater |penetration + gap| of both wheels [m]
  int iterations = 0;               ///< Newton steps
  SolveStatus status = SolveStatus::not_finite;  ///< converged: it stands there
};

namespace detail {

/// The deepest point of a wheel, penetrating or not. `wheel_lateral` is NaN where there is none or
/// the search failed.
template <Profile P, Profile R>
[[nodiscard]] Patch<typename P::Scalar> nearest_point(
    const Wheel<P>& wheel, const Rail<R>& rail,
    const WheelPlacement<typename P::Scalar>& placement) {
  using T = typename P::Scalar;
  // A threshold below any distance that can occur: all of the wheel is one zone. While the solution
  // is sought, the wheel may lie deep in the rail.
  const ValueOf<T> radius = value_of(wheel.nominal_radius());
  const auto found =
      find_contact(wheel, rail, placement,
                   SearchOptions<ValueOf<T>>{.penetration_threshold = -ValueOf<T>(10) * radius,
                                             .maximum_penetration = radius});
  Patch<T> deepest;
  deepest.wheel_lateral = T(0) / T(0);
  if (found.status != SearchStatus::complete) return deepest;
  bool any = false;
  for (const Patch<T>& patch : found.patches) {
    if (any && patch.penetration <= deepest.penetration) continue;
    deepest = patch;
    any = true;
  }
  return deepest;
}

}  // namespace detail

/// Solves for height and roll by Newton's method with the derivatives of the penetrations that the
/// contact normals give.
/// @param lateral_shift of the axle's centre, to the left [m]. @param yaw to the left [rad].
/// @param longitudinal x of the axle's centre [m]; the track is straight along x there.
/// @return status converged when both wheels are at the gap. Near a jump of the contact point, where
///   two points are equally near, the iteration may alternate and reach its limit.
/// @note Does not allocate.
template <Profile P, class Track>
[[nodiscard]] TouchingPosition<typename P::Scalar> touching_position(
    const Wheelset<P>& wheelset, const Track& track, const typename P::Scalar& lateral_shift,
    const typename P::Scalar& yaw = typename P::Scalar(0),
    const TouchingOptions<typename P::Scalar>& options = {},
    const typename P::Scalar& longitudinal = typename P::Scalar(0)) {
  using std::cos;
  using std::sin;
  using T = typename P::Scalar;
  const T radius = wheelset.wheel(Side::left).nominal_radius();
  const T tolerance =
      T(0) < options.tolerance ? options.tolerance : T(T(64) * epsilon<T>() * radius);
  const Vector3<T> roll_axis_track(cos(yaw), sin(yaw), T(0));
  TouchingPosition<T> result;
  result.height = radius;
  result.roll = T(0);
  int lifting_steps = ScalarTraits<T>::lifting_steps;
  while (true) {
    result.position = WheelsetPosition<T>::of(lateral_shift, result.height, result.roll, yaw);
    result.position.position_track.x() = result.position.arc_length = longitudinal;
    Vector2<T> error;
    Eigen::Matrix<T, 2, 2, Eigen::DontAlign> slope;
    for (const Side side : sides) {
      const auto row = static_cast<Eigen::Index>(index_of(side));
      const Vector3<T> wheel_track = wheelset.wheel_track(side, result.position);
      const RailFrame<T> frame = track.nearest_frame(side, wheel_track, longitudinal);
      const Patch<T> patch =
          detail::nearest_point(wheelset.wheel(side), track.rail(side),
                                place_wheel(wheelset, track, side, result.position));
      result.patches[index_of(side)] = patch;
      const Vector3<T> normal_track = frame.direction_track(patch.normal_rail);
      const Vector3<T> arm_track =
          frame.position_track(patch.position_rail) - result.position.position_track;
      error(row) = patch.penetration + options.gap + T(0) * patch.wheel_lateral;
      slope(row, 0) = -normal_track.z();
      slope(row, 1) = -normal_track.dot(cross(roll_axis_track, arm_track));
    }
    result.residual = detail::max(detail::magnitude(error(0)), detail::magnitude(error(1)));
    if (!is_finite(error(0)) || !is_finite(error(1))) {
      result.status = SolveStatus::not_finite;
      return result;
    }
    // A step more, of rounding, has the derivatives of the solution.
    if (result.residual <= tolerance && lifting_steps-- == 0) {
      result.status = SolveStatus::converged;
      return result;
    }
    if (result.iterations >= options.maximum_iterations) {
      result.status = SolveStatus::iteration_limit;
      return result;
    }
    ++result.iterations;
    const T determinant = slope(0, 0) * slope(1, 1) - slope(0, 1) * slope(1, 0);
    result.height -= (error(0) * slope(1, 1) - error(1) * slope(0, 1)) / determinant;
    result.roll -= (slope(0, 0) * error(1) - slope(1, 0) * error(0)) / determinant;
  }
}

}  // namespace wheelrail
