#pragma once
/// @file
/// One call from the first to the last instant of y' = f(t, y), with results at equal intervals as
/// in the paper's Table 2, by the adaptive pair of numerics/dormand_prince.hpp.
/// May include: core, numerics, std.

#include <concepts>
#include <wheelrail/core/require.hpp>
#include <wheelrail/numerics/dormand_prince.hpp>

namespace wheelrail {

/// How an integration ended.
enum class IntegrationStatus {
  finished,             ///< the end was reached and reported
  stopped_by_observer,  ///< the observer returned false
  step_too_small,       ///< as in StepStatus
  not_finite,           ///< as in StepStatus
  step_limit            ///< as in StepStatus
};

/// The status in words, for messages and tables.
[[nodiscard]] constexpr const char* name_of(IntegrationStatus status) {
  switch (status) {
    case IntegrationStatus::finished:
      return "finished";
    case IntegrationStatus::stopped_by_observer:
      return "stopped_by_observer";
    case IntegrationStatus::step_too_small:
      return "step_too_small";
    case IntegrationStatus::not_finite:
      return "not_finite";
    case IntegrationStatus::step_limit:
      return "step_limit";
  }
  return "unknown";
}

/// Invariant: status == finished implies time == t_end. `state` belongs to `time`: the last one
/// reported when the observer stopped, otherwise the last one that was reached.
template <StateVector State>
struct IntegrationResult {
  IntegrationStatus status = IntegrationStatus::not_finite;  ///< why it ended
  typename State::Scalar time{};                             ///< that was reached
  State state;                                               ///< at that time
  int steps = 0;                                             ///< accepted
  int rejected_steps = 0;                                    ///< tried in vain
  int evaluations = 0;                                       ///< of f
};

/// What looks at the results: (t, y) -> bool, false to stop.
template <class Function, class State>
concept Observer = StateVector<State> &&
    requires(Function& observer, const typename State::Scalar& t, const State& y) {
  { observer(t, y) } -> std::convertible_to<bool>;
};

/// Integrates y' = f(t, y) from (@p t0, @p y0) to @p t_end.
/// @param f the right-hand side, as in DormandPrince.
/// @param t_end >= t0 [unit of t].
/// @param report_interval between reports [unit of t], at least 16 rounding units of the greatest
///   |t|; 0 reports the two ends only.
/// @param observer called at t0, at t0 + k report_interval (a product, not a sum: reports do not
///   drift) and at t_end, each once and in this order; between steps by dense output of order 4.
/// @throws std::invalid_argument naming what is out of range, before anything is computed.
/// @note For states of fixed size nothing is allocated once the arguments are checked.
template <StateVector State, RightHandSide<State> Function, Observer<State> Observe>
[[nodiscard]] IntegrationResult<State> integrate(
    Function&& f, const typename State::Scalar& t0, const State& y0,
    const typename State::Scalar& t_end, const typename State::Scalar& report_interval,
    const DormandPrinceOptions<typename State::Scalar>& options, Observe&& observer) {
  using T = typename State::Scalar;
  const T resolution =
      T(16) * epsilon<T>() * detail::max(detail::magnitude(t0), detail::magnitude(t_end));
  detail::require_finite("t0", t0);
  detail::require(is_finite(t_end) && !(t_end < t0), "t_end", t_end, "finite and >= t0");
  detail::require_not_negative("report_interval", report_interval, "[unit of t]");
  detail::require(report_interval == T(0) || resolution <= report_interval, "report_interval",
                  report_interval, "0 or at least 16 rounding units of t0 and t_end");

  DormandPrince<State> solver(options);
  const auto result = [&](IntegrationStatus status, const T& t, const State& y) {
    return IntegrationResult<State>{
        status, t, y, solver.steps(), solver.rejected_steps(), solver.evaluations()};
  };
  if (solver.start(f, t0, y0) != StepStatus::stepped) {
    return result(IntegrationStatus::not_finite, t0, y0);
  }
  if (!observer(t0, y0)) return result(IntegrationStatus::stopped_by_observer, t0, y0);

  // Counted in T, exactly: there are fewer reports than T has whole numbers.
  T count = T(1);
  T report = t0 + report_interval;
  const auto is_due = [&] {
    return T(0) < report_interval && report <= solver.time() && report < t_end - resolution;
  };
  while (solver.time() < t_end) {  // at most options.maximum_steps times
    switch (solver.step(f, t_end)) {
      case StepStatus::stepped:
        break;
      case StepStatus::step_too_small:
        return result(IntegrationStatus::step_too_small, solver.time(), solver.state());
      case StepStatus::not_finite:
        return result(IntegrationStatus::not_finite, solver.time(), solver.state());
      case StepStatus::step_limit:
        return result(IntegrationStatus::step_limit, solver.time(), solver.state());
    }
    for (; is_due(); count += T(1), report = t0 + count * report_interval) {
      const State y = solver.interpolate(report);
      if (!observer(report, y)) return result(IntegrationStatus::stopped_by_observer, report, y);
    }
  }
  if (t0 < t_end && !observer(t_end, solver.state())) {
    return result(IntegrationStatus::stopped_by_observer, t_end, solver.state());
  }
  return result(IntegrationStatus::finished, t_end, solver.state());
}

}  // namespace wheelrail
