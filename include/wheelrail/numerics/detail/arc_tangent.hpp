#pragma once
// Arc tangents for any scalar. Eigen's AutoDiffScalar has no atan, and an atan2 that allocates: so the
// angles of values are lifted to derivatives. May include: core, numerics.

#include <wheelrail/numerics/lifted_root.hpp>

namespace wheelrail::detail {

// The angle of (x, y) from the x axis [rad].
template <Real T>
[[nodiscard]] T arc_tangent(const T& y, const T& x) {
  using std::atan2;
  if constexpr (has_derivatives<T>) {
    using std::cos;
    using std::sin;
    return lifted_root<T>(ValueOf<T>(atan2(value_of(y), value_of(x))), [&](const T& angle) {
      const T c = cos(angle), s = sin(angle);
      return ValueAndSlope<T>{T(y * c - x * s), T(-(y * s + x * c))};
    });
  } else {
    return atan2(y, x);
  }
}

// Of one number: it costs less than half of the other.
template <Real T>
[[nodiscard]] T arc_tangent(const T& x) {
  using std::atan;
  if constexpr (has_derivatives<T>) {
    return arc_tangent(x, T(1));
  } else {
    return atan(x);
  }
}

}  // namespace wheelrail::detail
