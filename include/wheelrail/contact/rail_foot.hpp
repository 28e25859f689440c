#pragma once
/// @file
/// The 1-D rail solve (61): the foot on the rail profile of the perpendicular from a point of its
/// cross-section plane. Closed form where the profile has one, bracketed Newton otherwise.
/// May include: core, numerics, profile, surface.

#include <wheelrail/numerics/lifted_root.hpp>
#include <wheelrail/surface/rail.hpp>

namespace wheelrail {

namespace detail {

// The foot on the straight line that continues a profile along its tangent at an end.
template <Real T>
[[nodiscard]] ClosestPoint<T> foot_on_tangent(const T& end, const ProfilePoint<T>& point,
                                              const T& lateral, const T& up) {
  using std::sqrt;
  const T cosine = T(1) / sqrt(T(T(1) + point.slope * point.slope));
  const T sine = point.slope * cosine;
  const T dy = lateral - end;
  const T dz = up - point.value;
  return {end + (dy * cosine + dz * sine) * cosine, dy * sine - dz * cosine,
          Vector2<T>(-sine, cosine), T(0)};
}

}  // namespace detail

/// The foot by Newton's method: (u - lateral) + (f(u) - up) f'(u) = 0, started at @p lateral.
/// @return as HasClosestPoint promises; `penetration` is NaN when the iteration did not converge.
/// @pre The profile is convex, or the point is nearer to it than its smallest radius of curvature;
///   otherwise one of several feet is found.
/// @note Does not allocate; at most 60 evaluations.
template <Profile P>
[[nodiscard]] ClosestPoint<typename P::Scalar> rail_foot_newton(const P& profile,
                                                                const typename P::Scalar& lateral,
                                                                const typename P::Scalar& up) {
  using std::sqrt;
  using T = typename P::Scalar;
  const auto equation = [&](const T& u, const ProfilePoint<T>& point) {
    return u - lateral + (point.value - up) * point.slope;
  };
  const ProfilePoint<T> lowest = profile.evaluate(profile.lower());
  const ProfilePoint<T> highest = profile.evaluate(profile.piece_count() - 1, profile.upper());
  const T at_lower = equation(profile.lower(), lowest);
  const T at_upper = equation(profile.upper(), highest);
  if (T(0) < at_lower) return detail::foot_on_tangent(profile.lower(), lowest, lateral, up);
  if (at_upper < T(0)) return detail::foot_on_tangent(profile.upper(), highest, lateral, up);
  // The equation rises by 1 at least outside a convex profile: its residual bounds the step.
  const T tolerance = T(8) * epsilon<T>() * (profile.upper() - profile.lower());
  const auto residual = [&](const T& u) {
    const ProfilePoint<T> point = profile.evaluate(u);
    return ValueAndSlope<T>{equation(u, point), T(1) + point.slope * point.slope +
                                                    (point.value - up) * point.second_derivative};
  };
  const auto root = bracketed_newton<T>(
      residual, profile.lower(), profile.upper(), at_lower, at_upper, lateral,
      {.step_tolerance = tolerance, .residual_tolerance = tolerance, .maximum_iterations = 60});
  const T foot_lateral = lifted_root<T>(value_of(root.position), residual);
  const ProfilePoint<T> point = profile.evaluate(foot_lateral);
  const T cosine = T(1) / sqrt(T(T(1) + point.slope * point.slope));
  const Vector2<T> normal_rail(-point.slope * cosine, cosine);
  ClosestPoint<T> foot{
      foot_lateral,
      (foot_lateral - lateral) * normal_rail.x() + (point.value - up) * normal_rail.y(),
      normal_rail, curvature(point)};
  if (root.status != SolveStatus::converged) foot.penetration = T(0) / T(0);
  return foot;
}

/// The foot of (@p lateral, @p up) [m], rail frame, on @p profile: closed form where there is one.
template <Profile P>
[[nodiscard]] ClosestPoint<typename P::Scalar> rail_foot(const P& profile,
                                                         const typename P::Scalar& lateral,
                                                         const typename P::Scalar& up) {
  if constexpr (HasClosestPoint<P>) {
    return profile.closest_point(lateral, up);
  } else {
    return rail_foot_newton(profile, lateral, up);
  }
}

}  // namespace wheelrail
