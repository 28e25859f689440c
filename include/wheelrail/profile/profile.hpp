#pragma once
/// @file
/// What a profile is: a curve value(lateral) whose outward direction is +value, made of smooth
/// pieces. For a wheel the value is F, added to the nominal radius; for a rail it is the height.
/// Paper §2.2 and equation (14). May include: core, numerics.

#include <concepts>
#include <wheelrail/core/scalar.hpp>
#include <wheelrail/core/vector.hpp>

namespace wheelrail {

/// A point of a profile, all from one evaluation.
template <Real T>
struct ProfilePoint {
  T value = T(0);              ///< [m], outward: wheel radius above nominal, or rail height
  T slope = T(0);              ///< d value / d lateral [-]
  T second_derivative = T(0);  ///< d2 value / d lateral2 [1/m]; negative where the body is convex
};

/// A profile over [lower(), upper()], lateral coordinate [m] towards the field side. Piece i spans
/// [joint(i), joint(i+1)], joint(0) == lower(), joint(piece_count()) == upper(); inside a piece the
/// value is C2. At a joint, evaluate(i, .) gives piece i's own limit and evaluate(.) the limit from
/// the field side. Evaluation outside [lower(), upper()] is not defined.
template <class P>
concept Profile = Real<typename P::Scalar> &&
    requires(const P profile, const typename P::Scalar lateral, const int piece) {
  { profile.lower() } -> std::convertible_to<typename P::Scalar>;
  { profile.upper() } -> std::convertible_to<typename P::Scalar>;
  { profile.piece_count() } -> std::convertible_to<int>;
  { profile.joint(piece) } -> std::convertible_to<typename P::Scalar>;
  { profile.evaluate(lateral) } -> std::same_as<ProfilePoint<typename P::Scalar>>;
  { profile.evaluate(piece, lateral) } -> std::same_as<ProfilePoint<typename P::Scalar>>;
};

/// What the derivatives of a profile keep within over an interval.
template <Real T>
struct DerivativeBounds {
  T least_second = T(0);     ///< <= d2 value / d lateral2 [1/m]
  T greatest_second = T(0);  ///< >= d2 value / d lateral2 [1/m]
  T greatest_third = T(0);   ///< >= |d3 value / d lateral3| [1/m2]
};

/// What the curvature of a profile keeps within over an interval, positive where convex.
template <Real T>
struct CurvatureBounds {
  T least = T(0);     ///< [1/m]
  T greatest = T(0);  ///< [1/m]
};

/// A profile that bounds its derivatives and its curvature over an interval inside one piece, from
/// lower to upper [m]. Bounds hold but for rounding and become tight as the
/// interval becomes short. What is proved about a profile rests on them.
template <class P>
concept HasDerivativeBounds = Profile<P> &&
    requires(const P profile, const int piece, const typename P::Scalar x) {
  { profile.derivative_bounds(piece, x, x) } -> std::same_as<DerivativeBounds<typename P::Scalar>>;
  { profile.curvature_bounds(piece, x, x) } -> std::same_as<CurvatureBounds<typename P::Scalar>>;
};

/// The nearest point of a profile to a point of its plane.
template <Real T>
struct ClosestPoint {
  T lateral = T(0);      ///< of the profile's point [m]
  T penetration = T(0);  ///< depth of the given point under the surface [m], negative above it
  Vector2<T> normal_rail{T(0), T(1)};  ///< outward unit normal there: (lateral, up)
  T curvature = T(0);                  ///< of the profile there [1/m], positive where convex
};

/// A profile that knows its nearest point in closed form. Where the foot of the perpendicular would
/// lie beyond an end, the profile goes on along its end tangent, and `lateral` lies outside
/// [lower(), upper()].
template <class P>
concept HasClosestPoint = Profile<P> && requires(const P profile, const typename P::Scalar x) {
  { profile.closest_point(x, x) } -> std::same_as<ClosestPoint<typename P::Scalar>>;
};

/// The curvature [1/m] of a profile at @p point, positive where the body is convex: (17), (26).
template <Real T>
[[nodiscard]] T curvature(const ProfilePoint<T>& point) {
  using std::sqrt;
  const T squared_length = T(1) + point.slope * point.slope;
  return -point.second_derivative / (squared_length * sqrt(squared_length));
}

/// The piece that holds @p lateral; a joint belongs to the piece on its field side.
/// @note Among few pieces, as standards have them, a linear search beats a binary one.
template <class P>
[[nodiscard]] int piece_of(const P& profile, const typename P::Scalar& lateral) {
  constexpr int few = 16;
  int piece = 0, last = profile.piece_count() - 1;
  while (few < last - piece) {
    const int middle = piece + (last - piece + 1) / 2;
    if (lateral < profile.joint(middle)) {
      last = middle - 1;
    } else {
      piece = middle;
    }
  }
  while (piece < last && !(lateral < profile.joint(piece + 1))) ++piece;
  return piece;
}

}  // namespace wheelrail
