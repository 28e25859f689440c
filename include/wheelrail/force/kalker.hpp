#pragma once
/// @file
/// Kalker's creepage coefficients of elliptical contacts: J. J. Kalker, Three-Dimensional Elastic
/// Bodies in Rolling Contact (1990), table E.3 and the asymptotes of slender ellipses, made one
/// function of the axis ratio with a continuous derivative. May include: core.

#include <array>
#include <cstddef>
#include <wheelrail/core/require.hpp>
#include <wheelrail/core/scalar.hpp>

namespace wheelrail {

/// Of the linear theory, all [-]; a along the rolling, b across, G the shear modulus:
/// F_x = -G a b c11 xi_x, F_y = -G a b (c22 xi_y + sqrt(a b) c23 phi). c32 = -c23.
template <Real T>
struct KalkerCoefficients {
  T c11 = T(0);  ///< longitudinal force of longitudinal creepage
  T c22 = T(0);  ///< lateral force of lateral creepage
  T c23 = T(0);  ///< lateral force of spin
  T c33 = T(0);  ///< spin moment of spin; Polach's forces do without
};

namespace detail {

// Table E.3. Rows: a/b = 0.1, 0.2 .. 1, then b/a = 0.9, 0.8 .. 0.1. Columns: c11, c22, c23 and c33,
// each for the Poisson ratios 0, 0.25 and 0.5.
inline constexpr std::array<std::array<long double, 12>, 19> kalker_1990{{
    {2.51L, 3.31L, 4.85L, 2.51L, 2.52L, 2.53L, 0.334L, 0.473L, 0.731L, 6.42L, 8.28L, 11.7L},
    {2.59L, 3.37L, 4.81L, 2.59L, 2.63L, 2.66L, 0.483L, 0.603L, 0.809L, 3.46L, 4.27L, 5.66L},
    {2.68L, 3.44L, 4.8L, 2.68L, 2.75L, 2.81L, 0.607L, 0.715L, 0.889L, 2.49L, 2.96L, 3.72L},
    {2.78L, 3.53L, 4.82L, 2.78L, 2.88L, 2.98L, 0.72L, 0.823L, 0.977L, 2.02L, 2.32L, 2.77L},
    {2.88L, 3.62L, 4.83L, 2.88L, 3.01L, 3.14L, 0.827L, 0.929L, 1.07L, 1.74L, 1.93L, 2.22L},
    {2.98L, 3.72L, 4.91L, 2.98L, 3.14L, 3.31L, 0.93L, 1.03L, 1.18L, 1.56L, 1.68L, 1.86L},
    {3.09L, 3.81L, 4.97L, 3.09L, 3.28L, 3.48L, 1.03L, 1.14L, 1.29L, 1.43L, 1.5L, 1.6L},
    {3.19L, 3.91L, 5.05L, 3.19L, 3.41L, 3.65L, 1.13L, 1.25L, 1.4L, 1.34L, 1.37L, 1.42L},
    {3.29L, 4.01L, 5.12L, 3.29L, 3.54L, 3.82L, 1.23L, 1.36L, 1.51L, 1.27L, 1.27L, 1.27L},
    {3.4L, 4.12L, 5.2L, 3.4L, 3.67L, 3.98L, 1.33L, 1.47L, 1.63L, 1.21L, 1.19L, 1.16L},
    {3.51L, 4.22L, 5.3L, 3.51L, 3.81L, 4.16L, 1.44L, 1.59L, 1.77L, 1.16L, 1.11L, 1.06L},
    {3.65L, 4.36L, 5.42L, 3.65L, 3.99L, 4.39L, 1.58L, 1.75L, 1.94L, 1.1L, 1.04L, 0.954L},
    {3.82L, 4.54L, 5.58L, 3.82L, 4.21L, 4.67L, 1.76L, 1.95L, 2.18L, 1.05L, 0.965L, 0.852L},
    {4.06L, 4.78L, 5.8L, 4.06L, 4.5L, 5.04L, 2.01L, 2.23L, 2.5L, 1.01L, 0.892L, 0.751L},
    {4.37L, 5.1L, 6.11L, 4.37L, 4.9L, 5.56L, 2.35L, 2.62L, 2.96L, 0.958L, 0.819L, 0.65L},
    {4.84L, 5.57L, 6.57L, 4.84L, 5.48L, 6.31L, 2.88L, 3.24L, 3.7L, 0.912L, 0.747L, 0.549L},
    {5.57L, 6.34L, 7.34L, 5.57L, 6.4L, 7.51L, 3.79L, 4.32L, 5.01L, 0.868L, 0.674L, 0.446L},
    {6.96L, 7.78L, 8.82L, 6.96L, 8.14L, 9.79L, 5.72L, 6.63L, 7.89L, 0.828L, 0.601L, 0.341L},
    {10.7L, 11.7L, 12.9L, 10.7L, 12.8L, 16.0L, 12.2L, 14.6L, 18.0L, 0.795L, 0.526L, 0.228L},
}};

// A coefficient's asymptote and its derivative d ln(value) / d ln g.
template <Real T>
struct KalkerAsymptote {
  T value = T(0);
  T log_slope = T(0);
};

// c11, c22 and c23 for g = a/b -> 0: Kalker (1990), appendix E.
template <Real T>
[[nodiscard]] std::array<KalkerAsymptote<T>, 3> kalker_short_asymptotes(const T& nu, const T& g) {
  using std::log;
  using std::sqrt;
  const T quarter = pi<T>() * pi<T>() / T(4);
  const T bracket = T(1) + nu * (log(T(T(16) / g)) - T(5));
  return {KalkerAsymptote<T>{quarter / (T(1) - nu), T(0)}, KalkerAsymptote<T>{quarter, T(0)},
          KalkerAsymptote<T>{pi<T>() * sqrt(g) / (T(3) * (T(1) - nu)) * bracket,
                             T(1) / T(2) - nu / bracket}};
}

// c11, c22 and c23 for g = b/a -> 0: Kalker (1990), appendix E.
template <Real T>
[[nodiscard]] std::array<KalkerAsymptote<T>, 3> kalker_long_asymptotes(const T& nu, const T& g) {
  using std::log;
  using std::sqrt;
  const T two_pi = T(2) * pi<T>();
  const T logarithm = log(T(T(16) / (g * g)));
  const T k = T(3) - log(T(4));
  // c11 with n = 1 and c22 with n = 1 - nu are the same function of n and w.
  const auto straight = [&](const T& n, const T& w) {
    return KalkerAsymptote<T>{two_pi / (g * w) * (T(1) + n * k / w),
                              T(-1) + T(2) * n / w + T(2) * n * n * k / (w * (w + n * k))};
  };
  const T n = T(1) - nu;
  const T v = n * logarithm - T(2) + T(4) * nu;
  return {straight(T(1), T(logarithm - T(2) * nu)), straight(n, T(n * logarithm + T(2) * nu)),
          KalkerAsymptote<T>{two_pi / (T(3) * g * sqrt(g) * v), T(2) * n / v - T(3) / T(2)}};
}

// The table's abscissa x is a/b for a <= b and 2 - b/a for a > b: uniform nodes, smooth at a = b.
// Divided by these powers of x and 2 - x, to which they tend, c11, c22, c23 and c33 become flat.
template <Real T>
[[nodiscard]] std::array<T, 4> kalker_powers(const T& x) {
  using std::sqrt;
  const T y = T(2) - x;
  return {T(1) / y, T(1) / y, sqrt(T(x / y)) / y, T(1) / x};
}

}  // namespace detail

/// Kalker's coefficients at one Poisson ratio nu, in which table E.3 is interpolated by parabolas.
/// Over the axis ratio, cubics of continuous slope pass through the table's values with the powers
/// of a/b and b/a that these tend to taken out; left in, they cost 3 % between b/a = 0.1 and 0.2.
/// Beyond the table, where g = min(a/b, b/a) < 0.1, stand Kalker's asymptotes times
/// 1 + p (10 g) + q (10 g)^2, which meets the table in value and slope and tends to 1. c33 has no
/// asymptote there and keeps its last value. Valid for good once constructed.
template <Real T>
class KalkerTable {
 public:
  /// @param poisson_ratio [-]: MaterialPair::poisson_ratio.
  /// @throws std::invalid_argument unless it lies in [0, 0.5].
  explicit KalkerTable(const T& poisson_ratio) : poisson_ratio_(poisson_ratio) {
    detail::require(!(poisson_ratio < T(0)) && poisson_ratio <= constant<T>(0.5L),
                    "Kalker table: Poisson's ratio", poisson_ratio, "in [0, 0.5] [-]");
    for (std::size_t c = 0; c < 4; ++c) curves_[c] = curve(c);
    const T end = constant<T>(0.1L);
    short_blends_ = blends(0, detail::kalker_short_asymptotes(poisson_ratio_, end));
    long_blends_ = blends(last, detail::kalker_long_asymptotes(poisson_ratio_, end));
  }

  /// Poisson's ratio that the coefficients are for [-].
  [[nodiscard]] T poisson_ratio() const { return poisson_ratio_; }

  /// @param a, b the semi-axes along and across the rolling [m], > 0; only a/b counts. Both zero,
  ///   an ellipse without a force, is taken for a circle.
  /// @return c11, c22 and c23 with a continuous derivative; c33 has a kink where the table ends.
  /// @note No allocation. NaN in gives NaN.
  [[nodiscard]] KalkerCoefficients<T> at(const T& a, const T& b) const {
    if (a == T(0) && b == T(0)) return at(T(1), T(1));
    const bool is_short = a <= b;
    const T g = is_short ? T(a / b) : T(b / a);
    if (!is_finite(g)) return {g, g, g, g};
    const T t = T(10) * g;
    if (t < T(1)) {
      return is_short
                 ? beyond(0, detail::kalker_short_asymptotes(poisson_ratio_, g), short_blends_, t)
                 : beyond(last, detail::kalker_long_asymptotes(poisson_ratio_, g), long_blends_, t);
    }
    T u = is_short ? T(t - T(1)) : T(T(19) - t);
    std::size_t i = 0;  // the whole part of u, but within the table
    if constexpr (std::is_floating_point_v<T>) {
      const int whole = static_cast<int>(detail::min(u, T(static_cast<int>(last) - 1)));
      i = static_cast<std::size_t>(whole);
      u = u - T(whole);
    } else {  // by halving
      for (int stride = 16; 0 < stride; stride /= 2) {
        if (i + static_cast<std::size_t>(stride) < last && T(stride) <= u) {
          i += static_cast<std::size_t>(stride);
          u = u - T(stride);
        }
      }
    }
    const std::array<T, 4> powers = detail::kalker_powers(is_short ? g : T(T(2) - g));
    const auto value = [&](std::size_t c) { return T(powers[c] * curves_[c].at(i, u)); };
    return {value(0), value(1), value(2), value(3)};
  }

 private:
  static constexpr std::size_t last = detail::kalker_1990.size() - 1;

  // Values and slopes, per step of x, at the nodes.
  struct Curve {
    std::array<T, last + 1> value, slope;

    [[nodiscard]] T at(std::size_t i, const T& u) const {
      const T rise = value[i + 1] - value[i];
      const T bend = slope[i] + slope[i + 1] - T(2) * rise;
      return value[i] + u * (slope[i] + u * (rise - slope[i] - bend + u * bend));
    }
  };
  struct Blend {
    T linear = T(0), quadratic = T(0);
    [[nodiscard]] T at(const T& t) const { return T(1) + t * (linear + t * quadratic); }
  };

  [[nodiscard]] static T node(std::size_t i) { return T(static_cast<int>(i) + 1) / T(10); }

  // Column c of the table at this Poisson ratio, its power taken out; slopes by central and, at the
  // ends, one-sided differences, all of second order.
  [[nodiscard]] Curve curve(std::size_t c) const {
    const T z = T(4) * poisson_ratio_;
    Curve curve;
    for (std::size_t i = 0; i <= last; ++i) {
      const auto entry = [&](std::size_t k) {
        return constant<T>(detail::kalker_1990[i][3 * c + k]);
      };
      const T value = entry(0) * (T(1) - z) * (T(2) - z) / T(2) + entry(1) * z * (T(2) - z) +
                      entry(2) * z * (z - T(1)) / T(2);
      curve.value[i] = value / detail::kalker_powers(node(i))[c];
    }
    const auto& v = curve.value;
    for (std::size_t i = 1; i < last; ++i) curve.slope[i] = (v[i + 1] - v[i - 1]) / T(2);
    curve.slope[0] = (T(4) * v[1] - T(3) * v[0] - v[2]) / T(2);
    curve.slope[last] = (T(3) * v[last] - T(4) * v[last - 1] + v[last - 2]) / T(2);
    return curve;
  }

  // What makes asymptote * (1 + linear t + quadratic t^2), t = 10 g, meet the table at its end i in
  // value and slope: at t = 1, the ratio of the two and its derivative.
  [[nodiscard]] std::array<Blend, 3> blends(
      std::size_t i, const std::array<detail::KalkerAsymptote<T>, 3>& asymptotes) const {
    // With x = g or 2 - g: a step of x is 0.1, so slopes per step are slopes d / d ln g at g = 0.1.
    const T sign = i == 0 ? T(1) : T(-1);
    const T x = node(i);
    const T far_end = T(1) / (T(10) * (T(2) - x));
    const T near_end = T(1) / (T(10) * x);
    const std::array<T, 3> power_slopes{far_end, far_end, (T(3) * far_end + near_end) / T(2)};
    std::array<Blend, 3> result;
    for (std::size_t c = 0; c < 3; ++c) {
      const T ratio = detail::kalker_powers(x)[c] * curves_[c].value[i] / asymptotes[c].value;
      const T table_slope = sign * (curves_[c].slope[i] / curves_[c].value[i] + power_slopes[c]);
      const T slope = ratio * (table_slope - asymptotes[c].log_slope);
      result[c] = {T(2) * (ratio - T(1)) - slope, slope - (ratio - T(1))};
    }
    return result;
  }

  // Kalker's asymptotes beyond the table's end i, blended.
  [[nodiscard]] KalkerCoefficients<T> beyond(
      std::size_t i, const std::array<detail::KalkerAsymptote<T>, 3>& asymptotes,
      const std::array<Blend, 3>& blends, const T& t) const {
    const auto value = [&](std::size_t c) { return T(asymptotes[c].value * blends[c].at(t)); };
    return {value(0), value(1), value(2), detail::kalker_powers(node(i))[3] * curves_[3].value[i]};
  }

  T poisson_ratio_ = T(0);
  std::array<Curve, 4> curves_{};
  std::array<Blend, 3> short_blends_{};
  std::array<Blend, 3> long_blends_{};
};

}  // namespace wheelrail
