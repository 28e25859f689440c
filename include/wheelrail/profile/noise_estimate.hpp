#pragma once
/// @file
/// How noisy measured points are, from these alone. For construction, not for the hot path: it
/// allocates. May include: core, std.

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>
#include <wheelrail/core/scalar.hpp>
#include <wheelrail/core/vector.hpp>

namespace wheelrail {

/// The level of the noise across a measured profile [m], one standard deviation: from what four
/// neighbouring points are off a parabola over the chordal arc length, across it, without those
/// that are off by more than 2.5 times the level: corners and spikes. For normally distributed
/// noise, of whose root mean square over n points it is off by some noise / sqrt(2 n); 0 for fewer
/// than eight points.
/// @param laterals, values of the points [m]. @pre as many of both, neighbours apart from each
/// other
template <Real T>
[[nodiscard]] T estimated_noise(const std::vector<T>& laterals, const std::vector<T>& values) {
  using std::sqrt;
  if (laterals.size() < 8 || values.size() != laterals.size()) return T(0);
  std::vector<T> residuals;
  for (std::size_t first = 0; first + 3 < laterals.size(); ++first) {
    std::array<T, 4> arc{T(0)};
    for (std::size_t i = 1; i < 4; ++i) {
      const T along = laterals[first + i] - laterals[first + i - 1];
      const T up = values[first + i] - values[first + i - 1];
      arc[i] = arc[i - 1] + sqrt(T(along * along + up * up));
    }
    // Across the chord, the third divided difference, of which a parabola has none.
    const T chord_along = laterals[first + 3] - laterals[first];
    const T chord_up = values[first + 3] - values[first];
    T difference = T(0), squares = T(0);
    for (std::size_t i = 0; i < 4; ++i) {
      T weight = T(1);
      for (std::size_t j = 0; j < 4; ++j) {
        if (j != i) weight *= arc[3] / (arc[i] - arc[j]);
      }
      difference += weight * ((values[first + i] - values[first]) * chord_along -
                              (laterals[first + i] - laterals[first]) * chord_up);
      squares += weight * weight;
    }
    const T chord2 = chord_along * chord_along + chord_up * chord_up;
    const T residual = detail::magnitude(T(difference / sqrt(T(squares * chord2))));
    if (is_finite(residual)) residuals.push_back(residual);
  }
  if (residuals.empty()) return T(0);
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  // 2.5 standard deviations of the normal distribution, whose median deviation is 0.6745 of one.
  const T greatest = *middle * (T(5) / T(2) / constant<T>(0.6744897501960817L));
  T sum = T(0), count = T(0);
  for (const T& residual : residuals) {
    if (greatest < residual) continue;
    sum += residual * residual;
    count += T(1);
  }
  // The variance of what lies within.
  return sqrt(T(sum / (count * constant<T>(0.9112564L))));
}

}  // namespace wheelrail
