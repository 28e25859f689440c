#pragma once
/// @file
/// A dual number: a value with its derivatives by N variables. Any other will do as a scalar too
/// (Eigen::AutoDiffScalar, ceres::Jet); this one compiles in a quarter of their time. May include:
/// core, std.

#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <wheelrail/core/scalar_value.hpp>

namespace wheelrail {

/// A value and its derivatives, for V a plain scalar or a dual number again: then there are second
/// derivatives. Comparisons are those of the values.
/// @note Does not allocate. What has no derivative has one that is not finite: sqrt at 0. |x| at 0 has
///   that of x.
template <class V, std::size_t N>
struct Dual {
  V value{};                       ///< in the unit of what it stands for
  std::array<V, N> derivatives{};  ///< by each variable

  constexpr Dual() = default;
  /// A constant.
  constexpr explicit Dual(const V& constant) : value(constant) {}
  /// A constant.
  constexpr explicit Dual(double constant) requires(!std::is_same_v<V, double>)
      : value(V(constant)) {}
  /// The variable number @p index, at @p at. @pre index < N
  constexpr Dual(const V& at, std::size_t index) : value(at) { derivatives[index] = V(1); }

  /// @name Arithmetic and functions
  /// @{

  /// Of the values, with the chain rule for the derivatives.
  constexpr Dual& operator+=(const Dual& b) {
    value += b.value;
    for (std::size_t i = 0; i < N; ++i) derivatives[i] += b.derivatives[i];
    return *this;
  }
  constexpr Dual& operator-=(const Dual& b) {
    value -= b.value;
    for (std::size_t i = 0; i < N; ++i) derivatives[i] -= b.derivatives[i];
    return *this;
  }
  constexpr Dual& operator*=(const Dual& b) { return *this = *this * b; }
  constexpr Dual& operator/=(const Dual& b) { return *this = *this / b; }

  friend constexpr Dual operator-(const Dual& a) { return scaled(a, V(-a.value), V(-1)); }
  friend constexpr Dual operator+(Dual a, const Dual& b) { return a += b; }
  friend constexpr Dual operator-(Dual a, const Dual& b) { return a -= b; }
  friend constexpr Dual operator*(const Dual& a, const Dual& b) {
    return combined(a, b.value, b, a.value, V(a.value * b.value));
  }
  friend constexpr Dual operator/(const Dual& a, const Dual& b) {
    const V quotient = a.value / b.value;
    const V inverse = V(1) / b.value;
    return combined(a, inverse, b, V(-quotient * inverse), quotient);
  }

  friend constexpr bool operator==(const Dual& a, const Dual& b) { return a.value == b.value; }
  friend constexpr auto operator<=>(const Dual& a, const Dual& b) { return a.value <=> b.value; }

  friend Dual abs(const Dual& a) { return a.value < V(0) ? -a : a; }
  friend Dual sqrt(const Dual& a) {
    using std::sqrt;
    const V root = sqrt(a.value);
    return scaled(a, root, V(V(1) / (root + root)));
  }
  friend Dual exp(const Dual& a) {
    using std::exp;
    const V power = exp(a.value);
    return scaled(a, power, power);
  }
  friend Dual log(const Dual& a) {
    using std::log;
    return scaled(a, V(log(a.value)), V(V(1) / a.value));
  }
  friend Dual sin(const Dual& a) {
    using std::cos;
    using std::sin;
    return scaled(a, V(sin(a.value)), V(cos(a.value)));
  }
  friend Dual cos(const Dual& a) {
    using std::cos;
    using std::sin;
    return scaled(a, V(cos(a.value)), V(-sin(a.value)));
  }
  friend Dual tan(const Dual& a) {
    using std::tan;
    const V tangent = tan(a.value);
    return scaled(a, tangent, V(V(1) + tangent * tangent));
  }
  friend Dual asin(const Dual& a) {
    using std::asin;
    using std::sqrt;
    return scaled(a, V(asin(a.value)), V(V(1) / V(sqrt(V(V(1) - a.value * a.value)))));
  }
  friend Dual acos(const Dual& a) {
    using std::acos;
    using std::sqrt;
    return scaled(a, V(acos(a.value)), V(V(-1) / V(sqrt(V(V(1) - a.value * a.value)))));
  }
  friend Dual atan(const Dual& a) {
    using std::atan;
    return scaled(a, V(atan(a.value)), V(V(1) / (V(1) + a.value * a.value)));
  }
  friend Dual atan2(const Dual& y, const Dual& x) {
    using std::atan2;
    const V inverse = V(1) / (x.value * x.value + y.value * y.value);
    return combined(y, V(x.value * inverse), x, V(-y.value * inverse), V(atan2(y.value, x.value)));
  }
  /// @}

  /// @pre the value is > 0, or the exponent a whole number
  friend Dual pow(const Dual& a, const Dual& exponent) {
    using std::log;
    using std::pow;
    const V power = pow(a.value, exponent.value);
    const V by_base = exponent.value * V(pow(a.value, V(exponent.value - V(1))));
    const V by_exponent = V(0) < a.value ? V(power * V(log(a.value))) : V(0);
    return combined(a, by_base, exponent, by_exponent, power);
  }

 private:
  // A function's value, its derivatives those of a times by_a.
  [[nodiscard]] static constexpr Dual scaled(const Dual& a, const V& value, const V& by_a) {
    Dual result(value);
    for (std::size_t i = 0; i < N; ++i) result.derivatives[i] = by_a * a.derivatives[i];
    return result;
  }
  [[nodiscard]] static constexpr Dual combined(const Dual& a, const V& by_a, const Dual& b,
                                               const V& by_b, const V& value) {
    Dual result(value);
    for (std::size_t i = 0; i < N; ++i) {
      result.derivatives[i] = by_a * a.derivatives[i] + by_b * b.derivatives[i];
    }
    return result;
  }
};

/// The traits of Dual.
template <class V, std::size_t N>
struct ScalarTraits<Dual<V, N>> {
  using Value = ValueOf<V>;                                                 ///< that of V
  static constexpr int lifting_steps = 1 + ScalarTraits<V>::lifting_steps;  ///< one more than for V
  /// Without the derivatives.
  [[nodiscard]] static constexpr const Value& value(const Dual<V, N>& x) {
    return ScalarTraits<V>::value(x.value);
  }
};

}  // namespace wheelrail

/// @cond
/// What Eigen asks of a scalar.
template <class V, std::size_t N>
struct Eigen::NumTraits<wheelrail::Dual<V, N>> : Eigen::NumTraits<V> {
  using Real = wheelrail::Dual<V, N>;
  using NonInteger = wheelrail::Dual<V, N>;
  using Nested = wheelrail::Dual<V, N>;
  using Literal = wheelrail::Dual<V, N>;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 1,
    AddCost = static_cast<int>(N),
    MulCost = 2 * static_cast<int>(N)
  };
  static Real epsilon() { return Real(Eigen::NumTraits<V>::epsilon()); }
  static Real dummy_precision() { return Real(Eigen::NumTraits<V>::dummy_precision()); }
  static Real highest() { return Real(Eigen::NumTraits<V>::highest()); }
  static Real lowest() { return Real(Eigen::NumTraits<V>::lowest()); }
};
/// @endcond
