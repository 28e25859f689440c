#pragma once
/// @file
/// A profile without its derivatives: what a search in dual numbers searches with. May include:
/// core, numerics, profile.

#include <type_traits>
#include <utility>
#include <wheelrail/core/scalar_value.hpp>
#include <wheelrail/profile/profile.hpp>

namespace wheelrail {

/// A profile in dual numbers, seen as one in their values: evaluated in T, without the derivatives.
/// For profiles that cannot be cast, as those of this library can.
template <Profile P>
class ProfileValues {
 public:
  using Scalar = ValueOf<typename P::Scalar>;  ///< without derivatives
  using V = Scalar;                            ///< the same, short
  using T = typename P::Scalar;                ///< in which it is evaluated

  explicit ProfileValues(P profile) : profile_(std::move(profile)) {}  ///< the profile to be seen

  /// @name Of the concept Profile
  /// @{

  /// As Profile says it: lengths in m, pieces and joints from 0.
  [[nodiscard]] V lower() const { return value_of(T(profile_.lower())); }
  [[nodiscard]] V upper() const { return value_of(T(profile_.upper())); }
  [[nodiscard]] int piece_count() const { return profile_.piece_count(); }
  [[nodiscard]] V joint(int i) const { return value_of(T(profile_.joint(i))); }
  [[nodiscard]] ProfilePoint<V> evaluate(const V& lateral) const {
    return values(profile_.evaluate(T(lateral)));
  }
  [[nodiscard]] ProfilePoint<V> evaluate(int piece, const V& lateral) const {
    return values(profile_.evaluate(piece, T(lateral)));
  }
  [[nodiscard]] DerivativeBounds<V> derivative_bounds(
      int piece, const V& lower, const V& upper) const requires HasDerivativeBounds<P> {
    const DerivativeBounds<T> in = profile_.derivative_bounds(piece, T(lower), T(upper));
    return {value_of(in.least_second), value_of(in.greatest_second), value_of(in.greatest_third)};
  }
  [[nodiscard]] CurvatureBounds<V> curvature_bounds(
      int piece, const V& lower, const V& upper) const requires HasDerivativeBounds<P> {
    const CurvatureBounds<T> in = profile_.curvature_bounds(piece, T(lower), T(upper));
    return {value_of(in.least), value_of(in.greatest)};
  }
  [[nodiscard]] ClosestPoint<V> closest_point(const V& lateral,
                                              const V& up) const requires HasClosestPoint<P> {
    const ClosestPoint<T> in = profile_.closest_point(T(lateral), T(up));
    return {value_of(in.lateral), value_of(in.penetration),
            Vector2<V>(value_of(T(in.normal_rail.x())), value_of(T(in.normal_rail.y()))),
            value_of(in.curvature)};
  }
  /// @}

 private:
  [[nodiscard]] static ProfilePoint<V> values(const ProfilePoint<T>& in) {
    return {value_of(in.value), value_of(in.slope), value_of(in.second_derivative)};
  }

  P profile_;
};

/// A profile that makes the same profile in another scalar: cast<U>().
template <class P, class U>
concept CastsTo = Profile<P> && requires(const P profile) {
  { profile.template cast<U>() } -> Profile;
};

/// @p profile without the derivatives of its scalar; itself where there are none.
template <Profile P>
[[nodiscard]] auto value_profile(const P& profile) {
  using V = ValueOf<typename P::Scalar>;
  if constexpr (std::is_same_v<V, typename P::Scalar>) {
    return profile;
  } else if constexpr (CastsTo<P, V>) {
    return profile.template cast<V>();
  } else {
    return ProfileValues<P>(profile);
  }
}

/// The type of value_profile(profile).
template <Profile P>
using ValueProfile = decltype(value_profile(std::declval<const P&>()));

}  // namespace wheelrail
