#pragma once
/// @file
/// Complete elliptic integrals by the arithmetic-geometric mean, all from one iteration, in the
/// forms B, C, D of Jahnke and Emde that keep their digits for round ellipses. The force layer
/// needs them for Hertz's contact. May include: core.

#include <wheelrail/core/scalar.hpp>

namespace wheelrail {

/// The complete elliptic integrals of the modulus e, e^2 = 1 - g^2, all [-]. They hold together by
/// first = b + d and second = b + g^2 d.
template <Real T>
struct CompleteElliptic {
  T first = T(0);   ///< K
  T second = T(0);  ///< E
  T b = T(0);       ///< B = (E - g^2 K) / e^2; pi/4 for g = 1
  T c = T(0);       ///< C = (D - B) / e^2; pi/16 for g = 1
  T d = T(0);       ///< D = (K - E) / e^2; pi/4 for g = 1
};

/// Gauss's iteration a' = (a + g)/2, g' = sqrt(a g) from a = 1 (Abramowitz and Stegun 17.6): with
/// c_n the half differences and c_0 = e, K - E = K sum 2^(n-1) c_n^2. The sum is carried without
/// the powers of e that its terms share, so that nothing cancels and nothing is divided by e.
/// @param complementary_modulus g [-] > 0, the minor over the major axis of an ellipse; 1 is a
///   circle. A little more than 1 gives the analytic continuation: Newton steps may pass 1.
/// @return first, second, c and d to a few rounding units, b to ln(4/g) of them. NaN in, NaN out.
/// @note No allocation. Differentiable; by hand: dK/dln g = -B, dE/dln g = g^2 D,
///   dD/dln g = C - D.
template <Real T>
[[nodiscard]] CompleteElliptic<T> complete_elliptic(const T& complementary_modulus) {
  using std::sqrt;
  constexpr int maximum_iterations = 16;  // g = 1e-300 takes 11 in double
  const T e_squared = (T(1) - complementary_modulus) * (T(1) + complementary_modulus);
  T a = T(1);
  T g = complementary_modulus;
  T term = T(1);  // c_n^2 / e^4, but 1 for n = 0
  T power = T(1);
  T sum = T(0);  // of 2^n c_n^2 / e^4 over n >= 1
  for (int n = 1; n <= maximum_iterations; ++n) {
    const T half_difference = (a - g) / T(2);
    const T product = a * g;
    a = (a + g) / T(2);
    // c_n = c_(n-1)^2 / (4 a_n); for n = 1 the numerator is e^2, which squared is left out.
    term = detail::square(T((n == 1 ? T(1) : T(e_squared * term)) / (T(4) * a)));
    power = T(2) * power;
    sum = sum + power * term;
    // The next means differ by the square of this difference: below the rounding unit.
    if (half_difference * half_difference <= epsilon<T>() * a * a) break;
    g = sqrt(product);
  }
  CompleteElliptic<T> result;
  result.first = pi<T>() / (T(2) * a);
  result.c = result.first * sum;
  result.d = (result.first + e_squared * result.c) / T(2);
  result.b = result.first - result.d;
  result.second = result.b + complementary_modulus * complementary_modulus * result.d;
  return result;
}

}  // namespace wheelrail
