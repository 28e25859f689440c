#pragma once
/// @file
/// The minimum distance method, (28)-(31) of the paper: on each convex part of the wheel profile
/// the four surface parameters of a pair of points with common normals are solved for by Newton's
/// method. It needs convex bodies; on a concave fillet it need not converge, and then says so.
/// May include: core, numerics, profile, surface.

#include <array>
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
  MinimumDistanceForm form = MinimumDistanceForm::wheel_normal;  ///< of the equations
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
  /// Strips per part that are looked at for the start, each halving the interval that holds the
  /// nearest one; from far off Newton's method can be lost. Of 1 to 20 tried on the convex S1002
  /// (40,000 poses on UIC50 and 60E1), 5 and more never led to another answer; 6 is one to spare.
  /// On a profile that is not convex the halving ends at any one of several nearest strips.
  int starting_strips = 6;
};

/// The convex parts of a wheel profile, between its concave corners. At most 4.
template <Real T>
using ConvexParts = FixedList<LateralInterval<T>, 4>;

/// Splits @p profile where its slope jumps up by more than @p slope_jump: at the corners that
/// ConvexModification leaves. The jumps of the standard's rounded coefficients are below 1e-5.
/// @throws std::invalid_argument where there are more corners than 3.
template <Profile P>
[[nodiscard]] ConvexParts<ValueOf<typename P::Scalar>> convex_parts(
    const P& profile,
    const ValueOf<typename P::Scalar>& slope_jump = constant<ValueOf<typename P::Scalar>>(1e-3L)) {
  using T = typename P::Scalar;
  using V = ValueOf<T>;
  ConvexParts<V> parts;
  V lower = value_of(T(profile.lower()));
  const auto add = [&](const V& upper) {
    detail::require(parts.push_back({lower, upper}),
                    "convex parts: the profile has more than 3 concave corners");
    lower = upper;
  };
  for (const auto& joint : inspect_joints(profile)) {
    if (value_of(joint.slope_jump) < -slope_jump) add(value_of(joint.lateral));
  }
  add(value_of(T(profile.upper())));
  return parts;
}

/// The parameters of a pair of points: the unknowns of (30), (31).
template <Real T>
struct PointPair {
  T arc_length = T(0);     ///< s_r, x of the rail frame [m]
  T rail_lateral = T(0);   ///< u_r [m]
  T wheel_angle = T(0);    ///< s_w [rad]
  T wheel_lateral = T(0);  ///< u_w [m]
};

/// What the method remembers of one wheel on its rail: the pair of points of each convex part. The
/// caller owns it, one for each wheel, used by one search at a time; whatever it holds, a search
/// gives the answers of a cold one, to rounding.
template <Real T>
struct MinimumDistanceMemory {
  /// One convex part.
  struct Remembered {
    PointPair<T> points;    ///< arc_length from that of the wheel profile's origin [m]
    bool is_known = false;  ///< a search has converged to them
  };
  std::array<Remembered, ConvexParts<T>::capacity()> parts{};  ///< in the order of ConvexParts
};

/// The outcome on one convex part.
template <Real T>
struct PartDistance {
  PointPair<T> points;                                     ///< where the search ended
  ProximityCase proximity = ProximityCase::not_converged;  ///< which case it is
  T distance = T(0);                                       ///< n_r.d [m]: negative in penetration
  T residual = T(0);    ///< the larger of |d.t| / nominal radius and |n.t| [-]
  int iterations = 0;   ///< Newton systems solved
  int evaluations = 0;  ///< iterations, and the strips that were looked at for the start
};

namespace detail {

/// options.maximum_step or what stands for it.
template <Real T>
[[nodiscard]] T longest_step(const MinimumDistanceOptions<T>& options, const T& wheel_radius) {
  return T(0) < options.maximum_step ? options.maximum_step : T(wheel_radius / T(40));
}

/// Whether the search ended on a pair of points with common normals.
[[nodiscard]] constexpr bool is_pair(ProximityCase proximity) {
  return proximity == ProximityCase::apart || proximity == ProximityCase::touching ||
         proximity == ProximityCase::penetrating;
}

/// The greatest length among the changes of the four parameters [m].
template <Real T>
[[nodiscard]] T longest_component(const Vector4<T>& step, const T& wheel_radius) {
  if (!is_finite(T(step(0) + step(1) + step(2) + step(3)))) return T(0) / T(0);
  return max(max(magnitude(T(step(0))), magnitude(T(step(1)))),
             max(T(magnitude(T(step(2))) * wheel_radius), magnitude(T(step(3)))));
}

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
  using Pair = typename MinimumDistanceEquations<P, R>::Pair;
  const T step_tolerance = T(0) < options.step_tolerance
                               ? options.step_tolerance
                               : T(pow(epsilon<T>(), T(T(2) / T(3))) * wheel_radius);
  const T longest = longest_step(options, wheel_radius);
  const T touching = T(0) < options.touching_tolerance ? options.touching_tolerance
                                                       : T(T(64) * epsilon<T>() * wheel_radius);
  // Such a step is rounding itself: after it there is nothing to evaluate.
  const T rounding = T(8) * epsilon<T>() * wheel_radius;
  Vector x(start.arc_length, start.rail_lateral, start.wheel_angle, start.wheel_lateral);
  Pair at = equations.pair(x);
  PartDistance<T> result;
  int iterations_at_an_end = 0;
  bool converged = false;
  while (result.iterations < options.maximum_iterations) {
    ++result.iterations;
    const Vector step = equations.newton_step(at);
    const T length = longest_component(step, wheel_radius);
    if (!is_finite(length)) break;
    const bool full_step = length <= longest;
    T fraction = full_step ? T(1) : T(longest / length);
    const auto advanced = [&] {
      Vector next = x + fraction * step;
      next(3) = clamp(T(next(3)), part.lower, part.upper);
      return next;
    };
    Vector next = advanced();
    bool at_an_end = next(3) == part.lower || next(3) == part.upper;
    if (length <= rounding && !at_an_end) {
      x = next;
      converged = true;
      break;
    }
    Pair at_next = equations.pair(next);
    bool descends = at_next.norm < at.norm;
    for (int halving = 1; !descends && halving < 12; ++halving) {
      fraction /= T(2);
      next = advanced();
      at_next = equations.pair(next);
      descends = at_next.norm < at.norm;
    }
    // A step within the tolerance is at rounding already and need not descend.
    if (!descends && !(full_step && length <= step_tolerance)) break;
    at_an_end = next(3) == part.lower || next(3) == part.upper;
    iterations_at_an_end = at_an_end ? iterations_at_an_end + 1 : 0;
    x = next;
    at = at_next;
    if (full_step && length <= step_tolerance && !at_an_end) {
      converged = true;
      break;
    }
    if (iterations_at_an_end >= 5) {
      result.proximity = ProximityCase::no_common_normal;
      break;
    }
  }
  if (converged) {
    result.proximity =
        magnitude(at.penetration) <= touching
            ? ProximityCase::touching
            : (T(0) < at.penetration ? ProximityCase::penetrating : ProximityCase::apart);
  }
  result.points = {x(0), x(1), x(2), x(3)};
  result.distance = -at.penetration;
  result.residual = at.norm;
  result.evaluations = result.iterations;
  return result;
}

/// The nearest strip of @p part, about: where Newton's method starts. Seen along the rail a convex
/// part of the wheel and the rail are convex curves, the one over the other, and the strips deeper
/// than any level form one interval: the sign of the penetration's rate says on which side of a
/// strip the nearest one lies.
template <Profile P, Profile R>
[[nodiscard]] PointPair<typename P::Scalar> nearest_strip(
    const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<typename P::Scalar>& placement,
    const LateralInterval<typename P::Scalar>& part, int strips) {
  using std::asin;
  using T = typename P::Scalar;
  T lower = part.lower, upper = part.upper;
  T u = (lower + upper) / T(2);
  PointPair<T> nearest{placement.position_rail.x(), T(0), T(0), u};
  T sine = T(0);
  for (int i = 0; i < strips; ++i) {
    const ProfilePoint<T> point = wheel.profile().evaluate(u);
    const LocusPoint<T> locus = locus_point(wheel, placement, u, point);
    T rate = point.slope;  // where the locus ends, towards the deepest strip of the wheel
    if (locus.exists) {
      const ClosestPoint<T> foot = rail_foot(rail.profile(), locus.lateral, locus.up);
      rate = -(foot.normal_rail.x() * locus.lateral_rate + foot.normal_rail.y() * locus.up_rate);
      nearest = {placement.position_rail.x() + locus.along_rail, foot.lateral, T(0), u};
      sine = locus.angle.sine;
    }
    (T(0) < rate ? lower : upper) = u;
    u = (lower + upper) / T(2);
  }
  nearest.wheel_angle = asin(sine);
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
  return equations
      .pair(Vector4<typename P::Scalar>(points.arc_length, points.rail_lateral, points.wheel_angle,
                                        points.wheel_lateral))
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

/// The same, started from the nearest strip of the part, found by options.starting_strips halvings.
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

/// The same with a warm start from @p remembered, which is what a part's last search left there.
/// @return what a cold start gives, to rounding; evaluations: of both where one follows the other.
///
/// On convex bodies that overlap by less than their radii of curvature there is but one pair of
/// points with common normals that face each other, so that it does not matter where the iteration
/// came from. The warm start is given up, and a cold one made, where it does not converge, ends on an
/// end of the part, or ends farther than options.maximum_step from where it began: then the wheel
/// has moved by too much, or the pair is another one.
template <Profile P, Profile R>
[[nodiscard]] PartDistance<typename P::Scalar> minimum_distance(
    const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<typename P::Scalar>& placement,
    const LateralInterval<typename P::Scalar>& part,
    typename MinimumDistanceMemory<typename P::Scalar>::Remembered& remembered,
    const MinimumDistanceOptions<typename P::Scalar>& options = {}) {
  using T = typename P::Scalar;
  const T& radius = wheel.nominal_radius();
  const T longest = detail::longest_step(options, radius);
  const T& along = placement.position_rail.x();
  PartDistance<T> found;
  int given_up = 0;
  bool is_regular = false;
  PointPair<T> start = remembered.points;
  start.arc_length += along;
  if (remembered.is_known && part.lower < start.wheel_lateral && start.wheel_lateral < part.upper) {
    found = minimum_distance(wheel, rail, placement, part, start, options);
    const PointPair<T>& end = found.points;
    const Vector4<T> moved(end.arc_length - start.arc_length, end.rail_lateral - start.rail_lateral,
                           end.wheel_angle - start.wheel_angle,
                           end.wheel_lateral - start.wheel_lateral);
    is_regular =
        detail::is_pair(found.proximity) && detail::longest_component(moved, radius) <= longest;
    given_up = found.evaluations;
  }
  if (!is_regular) {
    found = minimum_distance(wheel, rail, placement, part, options);
    found.evaluations += given_up;
    is_regular = detail::is_pair(found.proximity);
  }
  remembered.is_known = is_regular;
  remembered.points = found.points;
  remembered.points.arc_length -= along;
  return found;
}

namespace detail {

/// The pair that was found on values, with the derivatives of T: one Newton step for each order.
template <Profile P, Profile R>
[[nodiscard]] PartDistance<typename P::Scalar> lifted_pair(
    const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<typename P::Scalar>& placement,
    const PartDistance<ValueOf<typename P::Scalar>>& found) {
  using T = typename P::Scalar;
  if constexpr (!has_derivatives<T>) {
    return found;
  } else {
    const MinimumDistanceEquations<P, R> equations(wheel, rail, placement,
                                                   MinimumDistanceForm::wheel_normal);
    Vector4<T> x(T(found.points.arc_length), T(found.points.rail_lateral),
                 T(found.points.wheel_angle), T(found.points.wheel_lateral));
    for (int order = 0; order < ScalarTraits<T>::lifting_steps; ++order) {
      const Vector4<T> step = equations.newton_step(equations.pair(x));
      for (Eigen::Index i = 0; i < 4; ++i) x(i) += step(i) - T(value_of(T(step(i))));
    }
    const auto at = equations.pair(x);
    return {{x(0), x(1), x(2), x(3)}, found.proximity,  -at.penetration, at.norm,
            found.iterations,         found.evaluations};
  }
}

/// The patches of the parts; distance_on(k) is the outcome on part k, of the values.
template <Profile P, Profile R, class DistanceOn>
[[nodiscard]] ContactResult<typename P::Scalar> patches_of_parts(
    const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<typename P::Scalar>& placement,
    const ConvexParts<ValueOf<typename P::Scalar>>& parts, DistanceOn&& distance_on) {
  using T = typename P::Scalar;
  ContactResult<T> result;
  if (!is_finite_placement(placement)) {
    result.status = SearchStatus::not_finite;
    return result;
  }
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const PartDistance<ValueOf<T>> on_values = distance_on(k);
    result.evaluations += on_values.evaluations;
    if (on_values.proximity == ProximityCase::not_converged) {
      result.status = SearchStatus::not_converged;
    }
    if (on_values.proximity != ProximityCase::penetrating) continue;
    const PartDistance<T> found = lifted_pair(wheel, rail, placement, on_values);
    const int piece = piece_of(wheel.profile(), found.points.wheel_lateral);
    const ProfilePoint<T> on_wheel = wheel.profile().evaluate(piece, found.points.wheel_lateral);
    const T rail_lateral = found.points.rail_lateral;
    const ProfilePoint<T> on_rail = rail.profile().evaluate(
        clamp(rail_lateral, rail.profile().lower(), rail.profile().upper()));
    const Vector3<T> normal_rail = Rail<R>::normal_rail(on_rail);
    const Patch<T> patch = patch_at(wheel, placement, piece, found.points.wheel_lateral, on_wheel,
                                    WheelAngle<T>::of(found.points.wheel_angle),
                                    {rail_lateral,
                                     T(-found.distance),
                                     {normal_rail.y(), normal_rail.z()},
                                     Rail<R>::lateral_curvature(on_rail)});
    if (!result.patches.push_back(patch)) result.status = SearchStatus::too_many_patches;
  }
  return result;
}

}  // namespace detail

/// The patches by the minimum distance method: at most one on each of @p parts.
/// @return patches of the parts that penetrate, with zone_lower and zone_upper NaN; status
///   not_converged when a part's iteration failed; evaluations: starting strips and Newton systems.
/// @pre @p parts as `convex_parts` gives them for a convex or convexly modified profile. On a
///   concave one the method may find a point that is not the deepest, or none.
/// @note Does not allocate.
template <Profile P, Profile R>
[[nodiscard]] ContactResult<typename P::Scalar> find_contact_by_minimum_distance(
    const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<typename P::Scalar>& placement,
    const ConvexParts<ValueOf<typename P::Scalar>>& parts,
    const MinimumDistanceOptions<ValueOf<typename P::Scalar>>& options = {}) {
  const auto on_values = placement.values();
  return detail::patches_of_parts(wheel, rail, placement, parts, [&](std::size_t k) {
    return minimum_distance(wheel.values(), rail.values(), on_values, parts[k], options);
  });
}

/// The same with a warm start, for a wheel that moves by small steps: see `minimum_distance`.
/// @param memory of this wheel on this rail; any other costs time, not the answer.
/// @note Does not allocate.
template <Profile P, Profile R>
[[nodiscard]] ContactResult<typename P::Scalar> find_contact_by_minimum_distance(
    const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<typename P::Scalar>& placement,
    const ConvexParts<ValueOf<typename P::Scalar>>& parts,
    MinimumDistanceMemory<ValueOf<typename P::Scalar>>& memory,
    const MinimumDistanceOptions<ValueOf<typename P::Scalar>>& options = {}) {
  const auto on_values = placement.values();
  return detail::patches_of_parts(wheel, rail, placement, parts, [&](std::size_t k) {
    return minimum_distance(wheel.values(), rail.values(), on_values, parts[k], memory.parts[k],
                            options);
  });
}

}  // namespace wheelrail
