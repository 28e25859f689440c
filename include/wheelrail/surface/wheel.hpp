#pragma once
/// @file
/// The wheel, a surface of revolution of its profile: points, tangents, normal and curvatures,
/// equations (5)-(9), (19)-(27) of the paper. May include: core, numerics, profile.
///
/// Wheel frame: origin at the profile's origin on the axle; y along the axle towards the field
/// side, z up, x = y x z: forwards on the left wheel, backwards on the right one (the paper's
/// Rz(pi)). It does not spin with the wheel. The wheel angle turns right-handed about y, from
/// straight below.

#include <type_traits>
#include <utility>
#include <wheelrail/core/require.hpp>
#include <wheelrail/core/vector.hpp>
#include <wheelrail/profile/value_profile.hpp>
#include <wheelrail/surface/strip_tree.hpp>

namespace wheelrail {

/// A wheel angle [rad] by its sine and cosine.
template <Real T>
struct WheelAngle {
  T sine = T(0);    ///< [-]
  T cosine = T(1);  ///< [-]

  /// That of @p angle [rad].
  [[nodiscard]] static WheelAngle of(const T& angle) {
    using std::cos;
    using std::sin;
    return {sin(angle), cos(angle)};
  }
};

/// A wheel: its profile turned about the axle. Valid for good once constructed.
/// @note Queries do not allocate. Differentiable wherever the profile is.
template <Profile P>
class Wheel {
 public:
  using Scalar = typename P::Scalar;  ///< the numbers of its coordinates
  using T = Scalar;                   ///< the same, short
  using ProfileType = P;              ///< of its profile
  /// The wheel without the derivatives of its scalar.
  using Values = Wheel<ValueProfile<P>>;

  /// @param nominal_radius [m], the radius at the tread circle (lateral = 0, F = 0).
  /// @param strip_spacing neighbouring strips of a contact search are at most this far apart [m].
  /// @throws std::invalid_argument unless nominal_radius and strip_spacing are finite and > 0 and
  ///   every joint of the profile has a positive radius.
  Wheel(P profile, const T& nominal_radius, const T& strip_spacing = constant<T>(0.5e-3L))
      : profile_(std::move(profile)),
        nominal_radius_(nominal_radius),
        search_(search_of(profile_, nominal_radius, strip_spacing)) {
    detail::require_positive("wheel: nominal radius", nominal_radius_, "[m]");
    for (int i = 0; i <= profile_.piece_count(); ++i) {
      const T lateral = profile_.joint(i);
      const T radius = nominal_radius_ + profile_.evaluate(lateral).value;
      detail::require(is_finite(radius) && T(0) < radius,
                      "wheel: radius at lateral " + detail::to_text(lateral) + " m", radius,
                      "finite and > 0 [m]: nominal radius " + detail::to_text(nominal_radius_) +
                          " m plus the profile's value");
    }
  }

  [[nodiscard]] const P& profile() const { return profile_; }  ///< turned about the axle
  [[nodiscard]] const T& nominal_radius() const { return nominal_radius_; }  ///< R0 [m]
  /// The wheel that a search in T searches with: of the values, or this one where T has no others.
  [[nodiscard]] const Values& values() const {
    if constexpr (has_derivatives<T>) {
      return search_;
    } else {
      return *this;
    }
  }
  /// Of the values of its profile, for the contact search.
  [[nodiscard]] const StripTree<ValueOf<T>>& strips() const {
    if constexpr (has_derivatives<T>) {
      return search_.strips();
    } else {
      return search_;
    }
  }

  /// The rolling radius [m] at @p point of the profile.
  [[nodiscard]] T radius(const ProfilePoint<T>& point) const {
    return nominal_radius_ + point.value;
  }

  /// (7), (8): the surface point [m], wheel frame.
  [[nodiscard]] Vector3<T> position_wheel(const T& lateral, const ProfilePoint<T>& point,
                                          const WheelAngle<T>& angle) const {
    const T r = radius(point);
    return Vector3<T>(-r * angle.sine, lateral, -r * angle.cosine);
  }

  /// (20): unit tangent along the strip, wheel frame.
  [[nodiscard]] static Vector3<T> longitudinal_tangent_wheel(const WheelAngle<T>& angle) {
    return Vector3<T>(angle.cosine, T(0), -angle.sine);
  }

  /// (22): unit tangent along the profile towards the field side, wheel frame.
  [[nodiscard]] static Vector3<T> lateral_tangent_wheel(const ProfilePoint<T>& point,
                                                        const WheelAngle<T>& angle) {
    using std::sqrt;
    const T cosine = T(1) / sqrt(T(T(1) + point.slope * point.slope));
    const T sine = -point.slope * cosine;
    return Vector3<T>(sine * angle.sine, cosine, sine * angle.cosine);
  }

  /// (25): unit normal out of the wheel, wheel frame.
  [[nodiscard]] static Vector3<T> normal_wheel(const ProfilePoint<T>& point,
                                               const WheelAngle<T>& angle) {
    using std::sqrt;
    const T cosine = T(1) / sqrt(T(T(1) + point.slope * point.slope));
    const T sine = -point.slope * cosine;
    return Vector3<T>(-cosine * angle.sine, sine, -cosine * angle.cosine);
  }

  /// (26): curvature of the profile [1/m], positive where the wheel is convex.
  [[nodiscard]] static T lateral_curvature(const ProfilePoint<T>& point) {
    return curvature(point);
  }

  /// (27): curvature in the rolling direction [1/m].
  [[nodiscard]] T longitudinal_curvature(const ProfilePoint<T>& point) const {
    using std::sqrt;
    return T(1) / (radius(point) * sqrt(T(T(1) + point.slope * point.slope)));
  }

 private:
  using Search = std::conditional_t<has_derivatives<T>, Values, StripTree<ValueOf<T>>>;

  [[nodiscard]] static Search search_of(const P& profile, const T& nominal_radius,
                                        const T& strip_spacing) {
    return Search(value_profile(profile), value_of(nominal_radius), value_of(strip_spacing));
  }

  P profile_;
  T nominal_radius_;
  Search search_;
};

}  // namespace wheelrail
