#pragma once
/// @file
/// The minimum distance method, (28)-(31) of the paper: on each convex part of the wheel profile
/// the four surface parameters of a pair of points with common normals are solved for by Newton's
/// method. It needs convex bodies; on a concave fillet it need not converge, and then says so.
/// May include: core, numerics, profile, surface.

#include <Eigen/LU>
#include <wheelrail/contact/detail/minimum_distance_equations.hpp>
#include <wheelrail/contact/patch.hpp>
#include <wheelrail/profile/inspection.hpp>

namespace wheelrail {

/// The three cases of the paper's Fig. 5, and failure.
enum class ProximityCase {
  apart,             ///< n_r.d > 0
  touching,          ///< |n_r.d| <= touching_tolerance
  penetrating,       ///< n_r.d < 0
  no_common_normal,  ///< the search left the part of the profile: its end is nearest
  not_converged      ///< iteration cap, singular Jacobian or no descent
};

/// The form of the equations and when Newton's method stops, in m; 0 stands for a length that
/// follows from the wheel.
template <Real T>
struct MinimumDistanceOptions {
  MinimumDistanceForm form = MinimumDistanceForm::wheel_normal;
  /// Converged when a full Newton step changes no length by more than this [m] (angles: times the
  /// wheel's radius); 0 means epsilon^(2/3) of the nominal radius, after which the quadratically
  /// convergent iterate is exact to rounding.
  T step_tolerance = T(0);
  /// A longer Newton step is cut to this length [m] (angles: times the wheel's radius); 0 means
  /// nominal radius / 40, 11 mm for a wheel of 0.43 m. A CHOICE: a safeguard for starts from afar,
  /// since a linearisation says nothing beyond a rail's corner radius (13 mm). From the nearest
  /// strip no result on the convex S1002 depends on it (tried from 3 mm to 1 m).
  T maximum_step = T(0);
  /// |n_r.d| <= touching_tolerance is case (b) of Fig. 5 [m]; 0 means 64 rounding units of the
  /// nominal radius, as far as rounding lets the sign of n_r.d be told.
  T touching_tolerance = T(0);
  int maximum_iterations = 50;  ///< iterations <= maximum_iterations on each part
  /// Strips per part from whose nearest one the iteration starts; one that is not near by can lead
  /// to another pair of points with common normals.
  int starting_strips = 24;
};

/// The convex parts of a wheel profile, between its concave corners. At most 4.
template <Real T>
using ConvexParts = FixedList<LateralInterval<T>, 4>;

/// Splits @p profile where its slope jumps up by more than @p slope_jump: at the corners that
/// ConvexModification leaves. The jumps of the standard's rounded coefficients are below 1e-5.
/// @throws std::invalid_argument where there are more corners than 3.
template <Profile P>
[[nodiscard]] ConvexParts<typename P::Scalar> convex_parts(
    const P& profile, const typename P::Scalar& slope_jump = constant<typename P::Scalar>(1e-3L)) {
  using T = typename P::Scalar;
  ConvexParts<T> parts;
  T lower = profile.lower();
  const auto add = [&](const T& upper) {
    detail::require(parts.push_back({lower, upper}),
                    "convex parts: the profile has more than 3 concave corners");
    lower = upper;
  };
  for (const auto& joint : inspect_joints(profile)) {
    if (joint.slope_jump < -slope_jump) add(joint.lateral);
  }
  add(profile.upper());
  return parts;
}

/// The parameters of a pair of points: the unknowns of (30), (31).
template <Real T>
struct PointPair {
  T arc_length{};     ///< s_r, x of the rail frame [m]
  T rail_lateral{};   ///< u_r [m]
  T wheel_angle{};    ///< s_w [rad]
  T wheel_lateral{};  ///< u_w [m]
};

/// The outcome on one convex part.
template <Real T>
struct PartDistance {
  PointPair<T> points;
  ProximityCase proximity = ProximityCase::not_converged;
  T distance{};         ///< n_r.d [m]: negative in penetration
  T residual{};         ///< the larger of |d.t| / nominal radius and |n.t| [-]
  int iterations = 0;   ///< Newton systems solved
  int evaluations = 0;  ///< iterations, and the strips among which the start was looked for
};

namespace detail {

/// Newton's method with step halving on one part.
template <Profile P, Profile R>
[[nodiscard]] PartDistance<typename P::Scalar> solve_part(
    const MinimumDistanceEquations<P, R>& equations,
    const LateralInterval<typename P::Scalar>& part, const PointPair<typename P::Scalar>& start,
    const MinimumDistanceOptions<typename P::Scalar>& options,
    const typename P::Scalar& wheel_radius) {
  using std::pow;
  using T = typename P::Scalar;
  using Vector = typename MinimumDistanceEquations<P, R>::Vector;
  const T step_tolerance = T(0) < options.step_tolerance
                               ? options.step_tolerance
                               : T(pow(epsilon<T>(), T(T(2) / T(3))) * wheel_radius);
  const T longest = T(0) < options.maximum_step ? options.maximum_step : T(wheel_radius / T(40));
  const T touching = T(0) < options.touching_tolerance ? options.touching_tolerance
                                                       : T(T(64) * epsilon<T>() * wheel_radius);
  const Vector scale(T(1), T(1), wheel_radius, T(1));
  Vector x(start.arc_length, start.rail_lateral, start.wheel_angle, start.wheel_lateral);
  auto at = equations(x);
  PartDistance<T> result;
  int iterations_at_an_end = 0;
  while (result.iterations < options.maximum_iterations) {
    ++result.iterations;
    const Vector step = -at.jacobian.partialPivLu().solve(at.residual);
    if (!is_finite(T(step.sum()))) break;
    const T length = step.cwiseProduct(scale).template lpNorm<Eigen::Infinity>();
    T fraction = length <= longest ? T(1) : T(longest / length);
    const bool full_step = length <= longest;
    Vector next;
    bool descends = false;
    auto at_next = at;
    for (int halving = 0; halving < 12; ++halving, fraction /= T(2)) {
      next = x + fraction * step;
      next(3) = clamp(T(next(3)), part.lower, part.upper);
      at_next = equations(next);
      descends = equations.norm(at_next.residual) < equations.norm(at.residual);
      if (descends) break;
    }
    // A step within the tolerance is at rounding already and need not descend.
    if (!descends && !(full_step && length <= step_tolerance)) break;
    const bool at_an_end = next(3) == part.lower || next(3) == part.upper;
    iterations_at_an_end = at_an_end ? iterations_at_an_end + 1 : 0;
    x = next;
    at = at_next;
    if (full_step && length <= step_tolerance && !at_an_end) {
      const T distance = at.rail_normal_rail.dot(at.distance_rail);
      result.proximity =
          magnitude(distance) <= touching
              ? ProximityCase::touching
              : (T(0) < distance ? ProximityCase::apart : ProximityCase::penetrating);
      break;
    }
    if (iterations_at_an_end >= 5) {
      result.proximity = ProximityCase::no_common_normal;
      break;
    }
  }
  result.points = {x(0), x(1), x(2), x(3)};
  result.distance = at.rail_normal_rail.dot(at.distance_rail);
  result.residual = equations.norm(at.residual);
  result.evaluations = result.iterations;
  return result;
}

/// The nearest of some strips of @p part: where Newton's method starts.
template <Profile P, Profile R>
[[nodiscard]] PointPair<typename P::Scalar> nearest_strip(
    const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<typename P::Scalar>& placement,
    const LateralInterval<typename P::Scalar>& part, int strips) {
  using std::asin;
  using T = typename P::Scalar;
  PointPair<T> nearest{T(0), T(0), T(0), (part.lower + part.upper) / T(2)};
  T deepest = T(0);
  bool found = false;
  for (int i = 0; i < strips; ++i) {
    const T u = part.lower + (part.upper - part.lower) * (T(2 * i + 1) / T(2 * strips));
    const LocusPoint<T> locus = locus_point(wheel, placement, u, wheel.profile().evaluate(u));
    if (!locus.exists) continue;
    const ClosestPoint<T> foot = rail_foot(rail.profile(), locus.lateral, locus.up);
    if (!is_finite(foot.penetration) || (found && foot.penetration <= deepest)) continue;
    found = true;
    deepest = foot.penetration;
    nearest = {placement.position_rail.x() + locus.along_rail, foot.lateral, asin(locus.angle.sine),
               u};
  }
  return nearest;
}

}  // namespace detail

/// The residuals of the method at a pair of points that need not solve it: (30) or (31).
/// @param points parameters of the two points; a lateral one beyond a profile's end counts as that
///   end.
/// @return wheel_normal: d.t_w,u and d.t_w,s [m], then n_r.t_w,u and n_r.t_w,s [-]; rail_normal:
///   d.t_r,u and d.t_r,s [m], then n_w.t_r,u and n_w.t_r,s [-]. d runs from the rail's point to the
///   wheel's (29), t and n are unit vectors; the residuals do not depend on the frame.
/// @note Does not allocate.
template <Profile P, Profile R>
[[nodiscard]] Vector4<typename P::Scalar> minimum_distance_residual(
    const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<typename P::Scalar>& placement,
    const PointPair<typename P::Scalar>& points,
    MinimumDistanceForm form = MinimumDistanceForm::wheel_normal) {
  const detail::MinimumDistanceEquations<P, R> equations(wheel, rail, placement, form);
  return equations(Vector4<typename P::Scalar>(points.arc_length, points.rail_lateral,
                                               points.wheel_angle, points.wheel_lateral))
      .residual;
}

/// The pair of points with common normals on one convex part of the wheel.
/// @param start where Newton's method starts.
/// @note Does not allocate.
template <Profile P, Profile R>
[[nodiscard]] PartDistance<typename P::Scalar> minimum_distance(
    const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<typename P::Scalar>& placement,
    const LateralInterval<typename P::Scalar>& part, const PointPair<typename P::Scalar>& start,
    const MinimumDistanceOptions<typename P::Scalar>& options = {}) {
  const detail::MinimumDistanceEquations<P, R> equations(wheel, rail, placement, options.form);
  return detail::solve_part(equations, part, start, options, wheel.nominal_radius());
}

/// The same, started from the nearest of options.starting_strips strips of the part.
template <Profile P, Profile R>
[[nodiscard]] PartDistance<typename P::Scalar> minimum_distance(
    const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<typename P::Scalar>& placement,
    const LateralInterval<typename P::Scalar>& part,
    const MinimumDistanceOptions<typename P::Scalar>& options = {}) {
  PartDistance<typename P::Scalar> found = minimum_distance(
      wheel, rail, placement, part,
      detail::nearest_strip(wheel, rail, placement, part, options.starting_strips), options);
  found.evaluations += options.starting_strips;
  return found;
}

/// The patches by the minimum distance method: at most one on each of @p parts.
/// @return patches of the parts that penetrate, with zone_lower and zone_upper NaN; status
///   not_converged when a part's iteration failed; evaluations: starting strips and Newton systems.
/// @pre @p parts as `convex_parts` gives them for a convex or convexly modified profile. On a
///   concave one the method may find a point that is not the deepest, or none.
/// @note Does not allocate.
template <Profile P, Profile R>
[[nodiscard]] ContactResult<typename P::Scalar> find_contact_by_minimum_distance(
    const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<typename P::Scalar>& placement,
    const ConvexParts<typename P::Scalar>& parts,
    const MinimumDistanceOptions<typename P::Scalar>& options = {}) {
  using T = typename P::Scalar;
  ContactResult<T> result;
  if (!detail::is_finite_placement(placement)) {
    result.status = SearchStatus::not_finite;
    return result;
  }
  for (const LateralInterval<T>& part : parts) {
    const PartDistance<T> found = minimum_distance(wheel, rail, placement, part, options);
    result.evaluations += found.evaluations;
    if (found.proximity == ProximityCase::not_converged) {
      result.status = SearchStatus::not_converged;
    }
    if (found.proximity != ProximityCase::penetrating) continue;
    const ProfilePoint<T> on_wheel = wheel.profile().evaluate(found.points.wheel_lateral);
    const T rail_lateral = found.points.rail_lateral;
    const Patch<T> patch =
        detail::patch_at(wheel, rail, placement, found.points.wheel_lateral, on_wheel,
                         WheelAngle<T>::of(found.points.wheel_angle), rail_lateral,
                         Rail<R>::normal_rail(rail.profile().evaluate(detail::clamp(
                             rail_lateral, rail.profile().lower(), rail.profile().upper()))),
                         T(-found.distance));
    if (!result.patches.push_back(patch)) result.status = SearchStatus::too_many_patches;
  }
  return result;
}

}  // namespace wheelrail
