#pragma once
/// @file
/// Roots of one unknown in a bracket: Newton's method kept inside an interval that always holds a
/// sign change, and Chandrupatla's method where there is no derivative. Neither leaves the bracket,
/// so neither diverges; both halve the interval where their fast step disappoints.
/// May include: core.

#include <utility>
#include <wheelrail/core/scalar.hpp>
#include <wheelrail/core/solve_status.hpp>

namespace wheelrail {

/// A function value with its derivative.
template <Real T>
struct ValueAndSlope {
  T value = T(0);  ///< f(x)
  T slope = T(0);  ///< df/dx
};

/// When an iteration for a root x of f stops: converged as soon as one of the tolerances is met.
template <Real T>
struct RootOptions {
  /// Stop when the bracket or the last step is at most this wide [unit of x]; 0 means two rounding
  /// units of x, which a multiple root or a jump at x = 0 never meets.
  T step_tolerance = T(0);
  /// Stop when |f(x)| <= this [unit of f].
  T residual_tolerance = T(0);
  /// Evaluations of f at most, the bracket's ends not counted.
  int maximum_iterations = 100;
  /// Of bracketed_newton: f is evaluated at multiples of about this only [unit of x], until a step of
  /// Newton's leads back to where it came from: that step's end is the root. So the root does not
  /// depend on the start, but by what rounding may decide between two neighbouring multiples. Where
  /// the slope is of no use, as at a jump of f, the bracket between two multiples is halved down to
  /// the tolerance; a jump within half of this beside a root of either branch is within as much. 0:
  /// anywhere.
  T grid = T(0);
};

/// Invariant: status == converged implies that `position` lies in the bracket that was given.
/// `residual` is f at the last point that was evaluated, which the last step may have left.
template <Real T>
struct RootResult {
  T position = T(0);   ///< the root [unit of x]
  T residual = T(0);   ///< f, see above [unit of f]
  int iterations = 0;  ///< evaluations of f, those at the bracket's ends not counted
  SolveStatus status = SolveStatus::not_finite;  ///< converged: it is a root
};

namespace detail {

template <Real T>
[[nodiscard]] T root_step_tolerance(const T& x, const RootOptions<T>& options) {
  return max(options.step_tolerance, T(T(2) * epsilon<T>() * magnitude(x)));
}

/// x rounded to a multiple of about `grid`, by what a sum with a large number cannot hold.
template <Real T>
[[nodiscard]] T rounded_to(const T& x, const T& grid) {
  const T large = grid / epsilon<T>();
  return T(x + large) - large;
}

}  // namespace detail

/// A root of f in [lower, upper] by Newton's method, bisecting whenever a step would leave the
/// bracket or would not halve it fast enough.
/// @param f callable: T -> ValueAndSlope<T>; of opposite signs at the two ends. Several roots,
///   or jumps over zero: one of them is found. A slope that is zero, not finite or of the wrong
///   sign costs iterations only; one too large by a factor k may end up to k tolerances from the
///   root.
/// @param start the first iterate; clamped into the bracket.
/// @param value_lower, value_upper f at the ends.
/// @return the root, to the step tolerance; quadratic convergence near a simple root.
/// @note No allocation.
template <Real T, class Function>
[[nodiscard]] RootResult<T> bracketed_newton(Function&& f, T lower, T upper, T value_lower,
                                             T value_upper, T start,
                                             const RootOptions<T>& options = {}) {
  RootResult<T> result;
  if (!is_finite(value_lower, value_upper, start)) return result;
  if (value_lower == T(0)) return {lower, T(0), 0, SolveStatus::converged};
  if (value_upper == T(0)) return {upper, T(0), 0, SolveStatus::converged};
  if ((value_lower < T(0)) == (value_upper < T(0))) {
    result.status = SolveStatus::no_bracket;
    return result;
  }
  const bool rising = value_lower < T(0);
  const bool on_grid = T(0) < options.grid;
  T x = detail::clamp(on_grid ? detail::rounded_to(start, options.grid) : start, lower, upper);
  bool is_multiple = on_grid && detail::rounded_to(x, options.grid) == x;
  T step_before_last = upper - lower;  // their sizes
  T last_step = step_before_last;
  while (result.iterations < options.maximum_iterations) {
    const ValueAndSlope<T> at = f(x);
    ++result.iterations;
    result.position = x;
    result.residual = at.value;
    if (!is_finite(at.value)) return result;
    if (detail::magnitude(at.value) <= options.residual_tolerance) {
      result.status = SolveStatus::converged;
      return result;
    }
    ((at.value < T(0)) == rising ? lower : upper) = x;
    // A Newton step that does not at least halve the step before the last one is not converging,
    // unless the grid makes it so.
    const T newton = x - at.value / at.slope;
    const T newton_step = detail::magnitude(T(newton - x));
    const bool usable =
        lower < newton && newton < upper &&
        (T(2) * newton_step <= step_before_last || (is_multiple && newton_step <= options.grid));
    const T next = usable ? newton : T(lower + (upper - lower) / T(2));
    step_before_last = last_step;
    last_step = detail::magnitude(T(next - x));
    T next_x = next;
    bool is_back = last_step <= detail::root_step_tolerance(x, options);
    if (on_grid) {
      // Where the bracket has no multiple near the next iterate, there is no grid.
      const T multiple = detail::rounded_to(next, options.grid);
      is_back = is_back || (usable && multiple == x);
      is_multiple = lower < multiple && multiple < upper;
      if (is_multiple) next_x = multiple;
    }
    if (is_back) {
      result.position = next;
      result.status = SolveStatus::converged;
      return result;
    }
    x = next_x;
  }
  result.status = SolveStatus::iteration_limit;
  return result;
}

/// A root of f in [lower, upper] without derivatives: T. R. Chandrupatla, A new hybrid
/// quadratic/bisection algorithm for finding the zero of a nonlinear function without using
/// derivatives, Advances in Engineering Software 28 (1997) 145-149.
/// @param f callable: T -> T, continuous, of opposite signs at the two ends.
/// @param value_lower, value_upper f at the ends.
/// @return the root, to the step tolerance; superlinear, never slower than about bisection.
/// @note No allocation.
template <Real T, class Function>
[[nodiscard]] RootResult<T> bracketed_root(Function&& f, T lower, T upper, T value_lower,
                                           T value_upper, const RootOptions<T>& options = {}) {
  RootResult<T> result;
  if (!is_finite(value_lower) || !is_finite(value_upper)) return result;
  if ((value_lower < T(0)) == (value_upper < T(0)) && !(value_lower == T(0)) &&
      !(value_upper == T(0))) {
    result.status = SolveStatus::no_bracket;
    return result;
  }
  // a is the newest point, b the end that keeps the root bracketed, c the point before a.
  T a = upper, fa = value_upper;
  T b = lower, fb = value_lower;
  T fraction = constant<T>(0.5L);
  while (true) {
    const bool a_is_best = detail::magnitude(fa) < detail::magnitude(fb);
    result.position = a_is_best ? a : b;
    result.residual = a_is_best ? fa : fb;
    const T tolerance = detail::root_step_tolerance(result.position, options);
    const T width = detail::magnitude(T(b - a));
    if (detail::magnitude(result.residual) <= options.residual_tolerance || width <= tolerance) {
      result.status = SolveStatus::converged;
      return result;
    }
    if (result.iterations >= options.maximum_iterations) {
      result.status = SolveStatus::iteration_limit;
      return result;
    }
    const T margin = tolerance / (T(2) * width);
    const T x = a + detail::clamp(fraction, margin, T(T(1) - margin)) * (b - a);
    const T fx = f(x);
    ++result.iterations;
    if (!is_finite(fx)) {
      result.status = SolveStatus::not_finite;
      return result;
    }
    T c = a, fc = fa;
    if ((fx < T(0)) != (fa < T(0))) {
      c = b;
      fc = fb;
      b = a;
      fb = fa;
    }
    a = x;
    fa = fx;
    // Inverse quadratic interpolation is trusted only where it is monotone between a and b.
    const T xi = (a - b) / (c - b);
    const T phi = (fa - fb) / (fc - fb);
    const bool monotone = phi * phi < xi && detail::square(T(T(1) - phi)) < T(1) - xi;
    fraction = monotone ? T(fa / (fb - fa) * fc / (fb - fc) +
                            (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb))
                        : constant<T>(0.5L);
  }
}

}  // namespace wheelrail
