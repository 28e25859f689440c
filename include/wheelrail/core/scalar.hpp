#pragma once
/// @file
/// The scalar that everything is templated on, and the few helpers that keep template bodies free
/// of `double`. Any type with field arithmetic, order and the elementary functions (found by
/// argument-dependent lookup) will do: float, double, long double, dual numbers.
/// May include: Eigen, std.

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <type_traits>

namespace wheelrail {

/// A real scalar: a field with an order, constructible from double, known to Eigen's NumTraits.
template <class T>
concept Real =
    !std::is_integral_v<T> && std::constructible_from<T, double> && requires(const T a, const T b) {
  T(a + b);
  T(a - b);
  T(a * b);
  T(a / b);
  T(-a);
  { a < b } -> std::convertible_to<bool>;
  { a == b } -> std::convertible_to<bool>;
  T(Eigen::NumTraits<T>::epsilon());
};

/// The relative rounding unit of @p T, the scale of every tolerance in the library.
template <Real T>
[[nodiscard]] constexpr T epsilon() {
  return T(Eigen::NumTraits<T>::epsilon());
}

/// A literal as a @p T. The literal is a long double so that long double loses nothing.
template <Real T>
[[nodiscard]] constexpr T constant(long double literal) {
  if constexpr (std::is_same_v<T, long double>) {
    return literal;
  } else {
    return T(static_cast<double>(literal));
  }
}

/// pi [-].
template <Real T>
[[nodiscard]] constexpr T pi() {
  return constant<T>(3.14159265358979323846264338327950288L);
}

/// True unless @p x, or one of @p others, is NaN or infinite. Needs no `<cmath>` classification of
/// @p T.
template <Real T, std::same_as<T>... More>
[[nodiscard]] constexpr bool is_finite(const T& x, const More&... others) {
  return ((x - x) + ... + (others - others)) == T(0);
}

namespace detail {

template <Real T>
[[nodiscard]] constexpr T min(const T& a, const T& b) {
  return b < a ? b : a;
}

template <Real T>
[[nodiscard]] constexpr T max(const T& a, const T& b) {
  return a < b ? b : a;
}

template <Real T>
[[nodiscard]] constexpr T clamp(const T& x, const T& lower, const T& upper) {
  return min(max(x, lower), upper);
}

template <Real T>
[[nodiscard]] constexpr T magnitude(const T& x) {
  if constexpr (std::is_floating_point_v<T>) {  // one instruction, for minus zero too
    if (!std::is_constant_evaluated()) return std::fabs(x);
  }
  return x < T(0) ? T(-x) : x;
}

template <Real T>
[[nodiscard]] constexpr T square(const T& x) {
  return x * x;
}

}  // namespace detail
}  // namespace wheelrail
