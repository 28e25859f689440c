#pragma once
/// @file
/// The derivatives of a root, by the implicit-function theorem. May include: core.

#include <wheelrail/core/scalar_value.hpp>
#include <wheelrail/numerics/bracketed_root.hpp>

namespace wheelrail {

/// A root of f with its derivatives: x' = -(df/dp) / (df/dx), from Newton's step in T without what it
/// would do to the value.
/// @param root of the values: f vanishes there but for rounding.
/// @param f callable: T -> ValueAndSlope<T>; the slope is df/dx. Not called where T carries no
///   derivatives.
/// @return the root; its value is @p root, unchanged. Derivatives that are not finite where df/dx
///   vanishes: the root has none there.
/// @note No allocation by this. A wrong df/dx makes wrong derivatives: it does not iterate them away.
template <Real T, class Function>
[[nodiscard]] T lifted_root(const ValueOf<T>& root, Function&& f) {
  T x(root);
  for (int step = 0; step < ScalarTraits<T>::lifting_steps; ++step) {
    const ValueAndSlope<T> at = f(x);
    x = x - T(at.value - T(value_of(at.value))) / at.slope;
  }
  return x;
}

}  // namespace wheelrail
