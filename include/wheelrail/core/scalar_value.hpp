#pragma once
/// @file
/// Scalars that carry derivatives, dual numbers: the plain scalar that is their value, and
/// conversions between the two. May include: core, std.
///
/// Searches and solves run on values. What they find is lifted to derivatives afterwards by the
/// implicit-function theorem: a Newton step in the dual scalar at a root of the values has the
/// root's derivatives, exactly.

#include <type_traits>
#include <utility>
#include <wheelrail/core/scalar.hpp>

namespace wheelrail {

/// What a scalar's value is. Here for scalars without derivatives, for Eigen::AutoDiffScalar and for
/// ceres::Jet, told by their members, and for those of each other; specialise it for another dual
/// number, with the same three members.
template <class T>
struct ScalarTraits {
  using Value = T;  ///< the scalar without derivatives
  /// Newton steps in T, from a root of the values, after which all of T's derivatives are those of
  /// the root.
  static constexpr int lifting_steps = 0;
  [[nodiscard]] static constexpr const T& value(const T& x) { return x; }  ///< @p x itself
};

/// Of Eigen::AutoDiffScalar, or what has its members.
template <class T>
requires requires(const T& x) {
  x.value(), x.derivatives();
}  // Eigen::AutoDiffScalar
struct ScalarTraits<T> {
  /// Of the value and each derivative.
  using Inner = std::remove_cvref_t<decltype(std::declval<const T&>().value())>;
  using Value = typename ScalarTraits<Inner>::Value;  ///< the scalar without derivatives
  static constexpr int lifting_steps = 1 + ScalarTraits<Inner>::lifting_steps;  ///< one more
  /// Without the derivatives.
  [[nodiscard]] static const Value& value(const T& x) {
    return ScalarTraits<Inner>::value(x.value());
  }
};

/// Of ceres::Jet, or what has its members.
template <class T>
requires requires(const T& x) {
  x.a, x.v;
}  // ceres::Jet
struct ScalarTraits<T> {
  /// Of the value and each derivative.
  using Inner = std::remove_cvref_t<decltype(std::declval<const T&>().a)>;
  using Value = typename ScalarTraits<Inner>::Value;  ///< the scalar without derivatives
  static constexpr int lifting_steps = 1 + ScalarTraits<Inner>::lifting_steps;  ///< one more
  /// Without the derivatives.
  [[nodiscard]] static const Value& value(const T& x) { return ScalarTraits<Inner>::value(x.a); }
};

/// The scalar without derivatives of a T; T itself where it carries none.
template <class T>
using ValueOf = typename ScalarTraits<T>::Value;

/// Whether a T carries derivatives.
template <class T>
inline constexpr bool has_derivatives = !std::is_same_v<T, ValueOf<T>>;

/// @p x without its derivatives.
template <Real T>
[[nodiscard]] constexpr ValueOf<T> value_of(const T& x) {
  return ScalarTraits<T>::value(x);
}

/// @p x as another scalar: without derivatives, or with those of a constant; between plain scalars
/// with what rounding that takes.
template <Real U, Real T>
[[nodiscard]] constexpr U scalar_cast(const T& x) {
  if constexpr (std::is_same_v<U, T>) {
    return x;
  } else if constexpr (has_derivatives<T>) {
    return scalar_cast<U>(value_of(x));
  } else if constexpr (has_derivatives<U> && !std::is_same_v<T, ValueOf<U>>) {
    return U(scalar_cast<ValueOf<U>>(x));
  } else if constexpr (std::is_floating_point_v<U>) {
    return static_cast<U>(x);
  } else {
    return U(x);
  }
}

}  // namespace wheelrail
