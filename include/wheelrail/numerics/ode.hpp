#pragma once
/// @file
/// Ordinary differential equations y' = f(t, y): what a state and a right-hand side are, what an
/// integrator may be asked for, and how a step of it can end (§5).
/// May include: core, Eigen, std.

#include <Eigen/Core>
#include <concepts>
#include <string>
#include <wheelrail/core/require.hpp>
#include <wheelrail/core/scalar.hpp>

namespace wheelrail {

/// A column of Eigen, of fixed or dynamic size.
template <class State>
concept StateVector = std::derived_from<State, Eigen::PlainObjectBase<State>> &&
                      Real<typename State::Scalar> && State::ColsAtCompileTime == 1;

/// y' = f(t, y). Its derivatives may jump, and it may refuse a trial state by returning a NaN.
template <class Function, class State>
concept RightHandSide = StateVector<State> &&
    requires(Function& f, const typename State::Scalar& t, const State& y) {
  { f(t, y) } -> std::convertible_to<State>;
};

/// How DormandPrince chooses its steps; the defaults are the tolerances of the paper's Table 2.
template <Real T>
struct DormandPrinceOptions {
  /// A step is accepted when, for each component i, the estimate e_i of its error has
  /// |e_i| <= absolute_tolerance + relative_tolerance max(|y_i before|, |y_i after|); >= 0 [-].
  T relative_tolerance = constant<T>(1e-5L);
  /// See above; > 0 [unit of each component].
  T absolute_tolerance = constant<T>(1e-5L);
  /// step <= maximum_step [unit of t]; 0 means no limit.
  T maximum_step = T(0);
  /// The first trial step [unit of t]; 0 means to choose it from f.
  T initial_step = T(0);
  /// accepted + rejected steps <= maximum_steps, counted from `start`.
  int maximum_steps = 10'000'000;
};

namespace detail {

/// @return @p options. @throws std::invalid_argument naming the option that is out of its range.
template <Real T>
[[nodiscard]] const DormandPrinceOptions<T>& require_valid(const DormandPrinceOptions<T>& options) {
  require_not_negative("relative_tolerance", options.relative_tolerance, "[-]");
  require_positive("absolute_tolerance", options.absolute_tolerance, "[unit of y]");
  require_not_negative("maximum_step", options.maximum_step, "[unit of t]");
  require_not_negative("initial_step", options.initial_step, "[unit of t]");
  require(0 < options.maximum_steps,
          "maximum_steps is " + std::to_string(options.maximum_steps) + ", but must be > 0");
  return options;
}

}  // namespace detail

/// How a step ended.
enum class StepStatus {
  stepped,         ///< the step was taken (or the start succeeded)
  step_too_small,  ///< the tolerance asks for a step below 16 rounding units of the time
  not_finite,      ///< f is not finite at the start, or at all steps down to the smallest
  step_limit       ///< the cap on steps was reached first
};

/// The status in words, for messages and tables.
[[nodiscard]] constexpr const char* name_of(StepStatus status) {
  switch (status) {
    case StepStatus::stepped:
      return "stepped";
    case StepStatus::step_too_small:
      return "step_too_small";
    case StepStatus::not_finite:
      return "not_finite";
    case StepStatus::step_limit:
      return "step_limit";
  }
  return "unknown";
}

}  // namespace wheelrail
