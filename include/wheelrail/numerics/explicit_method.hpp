#pragma once
/// @file
/// How large a step of an explicit integration method may be: its stability function R and, for
/// given eigenvalues lambda of a linear system, the largest h up to which |R(h lambda)| <= 1. E.
/// Hairer, G. Wanner, Solving Ordinary Differential Equations II, 2nd ed. (1996), IV.2.
/// May include: core, std.

#include <array>
#include <cmath>
#include <complex>
#include <concepts>
#include <limits>
#include <span>
#include <wheelrail/core/scalar.hpp>
#include <wheelrail/core/solve_status.hpp>

namespace wheelrail {

/// Explicit one-step methods. Of y' = lambda y one step makes R(h lambda) y.
enum class ExplicitMethod {
  euler,          ///< R(z) = 1 + z
  runge_kutta_4,  ///< the classical one, R(z) = 1 + z + z^2/2 + z^3/6 + z^4/24
  dormand_prince  ///< 5(4), the solution of order 5: ... + z^5/120 + z^6/600
};

namespace detail {

// The coefficients of R(z) from its constant on; zeros above its degree.
template <std::floating_point T>
[[nodiscard]] constexpr std::array<T, 7> stability_coefficients(ExplicitMethod method) {
  if (method == ExplicitMethod::euler) return {T(1), T(1)};
  std::array<T, 7> c{T(1), T(1), T(1) / T(2), T(1) / T(6), T(1) / T(24)};
  if (method == ExplicitMethod::dormand_prince) {
    c[5] = T(1) / T(120);
    c[6] = T(1) / T(600);
  }
  return c;
}

template <std::floating_point T, std::size_t N>
[[nodiscard]] constexpr T polynomial_at(const std::array<T, N>& coefficients, const T& x) {
  T sum = T(0);
  for (std::size_t i = N; 0 < i; --i) sum = sum * x + coefficients[i - 1];
  return sum;
}

// (|R(x d)|^2 - 1) / x, |d| = 1, as a polynomial of x.
template <std::floating_point T>
[[nodiscard]] std::array<T, 12> stability_excess(ExplicitMethod method,
                                                 const std::complex<T>& direction) {
  const std::array<T, 7> c = stability_coefficients<T>(method);
  // Re d^k, by Re d^(k+1) = 2 Re d Re d^k - Re d^(k-1).
  std::array<T, 7> cosine{T(1), direction.real()};
  for (std::size_t k = 2; k < 7; ++k) {
    cosine[k] = T(2) * direction.real() * cosine[k - 1] - cosine[k - 2];
  }
  std::array<T, 12> excess{};
  std::array<T, 12> sizes{};
  for (std::size_t i = 0; i < 7; ++i) {
    for (std::size_t k = 0; k < 7; ++k) {
      if (i + k == 0) continue;
      const T term = c[i] * c[k] * cosine[i < k ? k - i : i - k];
      excess[i + k - 1] += term;
      sizes[i + k - 1] += magnitude(term);
    }
  }
  // On the imaginary axis low powers vanish; what rounding leaves of them would count as growth.
  for (std::size_t i = 0; i < excess.size(); ++i) {
    if (magnitude(excess[i]) <= T(8) * epsilon<T>() * sizes[i]) excess[i] = T(0);
  }
  return excess;
}

// The least x in [0, end] above which the polynomial is positive; end if there is none. Between two
// neighbouring roots of its derivative a polynomial is monotone; so the roots of all derivatives
// are found from the highest on, and no excursion above zero is too short to be seen.
template <std::floating_point T, std::size_t N>
[[nodiscard]] T first_rise_above_zero(const std::array<T, N>& polynomial, const T& end) {
  if (T(0) < polynomial[0]) return T(0);
  constexpr int bisections = std::numeric_limits<T>::digits + 4;
  std::array<std::array<T, N>, N> derivatives{polynomial};
  for (std::size_t order = 1; order < N; ++order) {
    for (std::size_t i = 0; i + 1 < N; ++i) {
      derivatives[order][i] = T(static_cast<int>(i + 1)) * derivatives[order - 1][i + 1];
    }
  }
  const auto root = [](const auto& p, T lower, T upper) {
    const bool below = polynomial_at(p, lower) <= T(0);
    for (int k = 0; k < bisections; ++k) {
      const T middle = (lower + upper) / T(2);
      ((polynomial_at(p, middle) <= T(0)) == below ? lower : upper) = middle;
    }
    return lower;
  };
  std::array<T, N + 1> corners{T(0), end};  // the derivative at hand is monotone between these
  std::size_t count = 2;
  for (std::size_t order = N - 1; 0 < order; --order) {
    const auto& p = derivatives[order];
    std::array<T, N + 1> next{T(0)};
    std::size_t next_count = 1;
    for (std::size_t i = 0; i + 1 < count; ++i) {
      if ((polynomial_at(p, corners[i]) <= T(0)) == (polynomial_at(p, corners[i + 1]) <= T(0))) {
        continue;
      }
      next[next_count++] = root(p, corners[i], corners[i + 1]);
    }
    next[next_count++] = end;
    corners = next;
    count = next_count;
  }
  for (std::size_t i = 0; i + 1 < count; ++i) {
    if (polynomial_at(polynomial, corners[i + 1]) <= T(0)) continue;
    if (T(0) <= polynomial_at(polynomial, corners[i])) return corners[i];
    return root(polynomial, corners[i], corners[i + 1]);
  }
  return end;
}

}  // namespace detail

/// R(z) of @p method [-].
/// @param z step times eigenvalue [-].
template <std::floating_point T>
[[nodiscard]] std::complex<T> stability_function(ExplicitMethod method, const std::complex<T>& z) {
  const auto coefficients = detail::stability_coefficients<T>(method);
  std::complex<T> sum = T(0);
  for (std::size_t i = coefficients.size(); 0 < i; --i) sum = sum * z + coefficients[i - 1];
  return sum;
}

/// The largest h for which |R(h' eigenvalue)| <= 1 for all h' in [0, h]: where the ray first leaves
/// the region of stability, even if it enters it again.
/// @param eigenvalue [1/s].
/// @return [s], to rounding; infinite for the eigenvalue 0; 0 where Re eigenvalue > 0, and for
///   Euler's method on the imaginary axis. NaN in gives NaN. @note No allocation.
template <std::floating_point T>
[[nodiscard]] T largest_stable_step(ExplicitMethod method, const std::complex<T>& eigenvalue) {
  const T size = std::abs(eigenvalue);
  if (!is_finite(size)) return std::numeric_limits<T>::quiet_NaN();
  if (size == T(0)) return std::numeric_limits<T>::infinity();
  // All these regions lie within |z| < 5.
  return detail::first_rise_above_zero(
             detail::stability_excess(method, std::complex<T>(eigenvalue / size)), T(5)) /
         size;
}

/// What rounding makes of eigenvalues that are zero or imaginary. The defaults are the orders to
/// which eigenvalues of double and triple multiplicity are found.
template <std::floating_point T>
struct StableStepOptions {
  /// |lambda| <= still_tolerance max |lambda| counts as zero; >= 0 [-]; 6.1e-6 in double.
  T still_tolerance = std::cbrt(epsilon<T>());
  /// |Re lambda| <= growth_tolerance |lambda| counts as imaginary; >= 0 [-]; 1.5e-8 in double.
  T growth_tolerance = std::sqrt(epsilon<T>());
};

/// A linear system's largest stable step. Invariant: decaying + growing + still is the number of
/// eigenvalues, where status == converged; else the step is NaN.
template <std::floating_point T>
struct StableStep {
  T step = std::numeric_limits<T>::quiet_NaN();  ///< [s]; infinite where nothing limits it
  std::complex<T> eigenvalue{};                  ///< the one that limits it [1/s]
  int decaying = 0;  ///< eigenvalues that the step is for: Re lambda <= 0
  int growing = 0;   ///< those that are left out, for their motions grow without any method's help
  int still = 0;     ///< those that count as zero, which sets no limit
  SolveStatus status = SolveStatus::not_finite;  ///< converged: the step can be used
};

/// The largest step for which no motion that decays, or keeps its amplitude, grows numerically.
/// @param eigenvalues [1/s]; of conjugate pairs one or both.
/// @note No allocation.
template <std::floating_point T>
[[nodiscard]] StableStep<T> largest_stable_step(ExplicitMethod method,
                                                std::span<const std::complex<T>> eigenvalues,
                                                const StableStepOptions<T>& options = {}) {
  StableStep<T> result;
  T greatest = T(0);
  for (const auto& value : eigenvalues) {
    const T size = std::abs(value);
    if (!is_finite(size)) return result;
    greatest = detail::max(greatest, size);
  }
  result.status = SolveStatus::converged;
  result.step = std::numeric_limits<T>::infinity();
  for (std::complex<T> value : eigenvalues) {
    const T size = std::abs(value);
    if (size <= options.still_tolerance * greatest) {
      ++result.still;
      continue;
    }
    if (std::abs(value.real()) <= options.growth_tolerance * size) value.real(T(0));
    if (T(0) < value.real()) {
      ++result.growing;
      continue;
    }
    ++result.decaying;
    const T step = largest_stable_step(method, value);
    if (result.step <= step) continue;
    result.step = step;
    result.eigenvalue = value;
  }
  return result;
}

}  // namespace wheelrail
