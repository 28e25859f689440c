#pragma once
/// @file
/// Ordinary differential equations y' = f(t, y) by the explicit pair of Dormand and Prince of
/// orders 5 and 4 with adaptive steps and dense output: the integrator of the paper's Table 2.
/// J. R. Dormand, P. J. Prince, A family of embedded Runge-Kutta formulae, J. Comput. Appl. Math. 6
/// (1980) 19-26; step control, first step and dense output as in E. Hairer, S. P. Norsett,
/// G. Wanner, Solving Ordinary Differential Equations I, 2nd ed. (1993), II.4 and II.6 (dopri5),
/// but in the maximum norm, which knows neither the number nor the order of the components.
/// May include: core, numerics, Eigen, std.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <utility>
#include <wheelrail/core/assert.hpp>
#include <wheelrail/core/scalar.hpp>
#include <wheelrail/numerics/detail/dormand_prince_stages.hpp>
#include <wheelrail/numerics/ode.hpp>

namespace wheelrail {

/// The integrator, one accepted step at a time, forward in time.
/// Invariant: `interpolate` covers [previous_time(), time()], whatever the last status was.
/// @note No allocation for states of fixed size. Neither the signs of the components nor their
///   order change a step: mirrored problems give mirrored results, bit for bit.
template <StateVector State>
class DormandPrince {
 public:
  using T = typename State::Scalar;  ///< the scalar of the state

  /// @throws std::invalid_argument naming the option that is out of its range.
  explicit DormandPrince(const DormandPrinceOptions<T>& options = {})
      : options_(detail::require_valid(options)) {
    // A solver that has not started can be copied too.
    for (State* column : {&state_, &trial_}) column->setZero();
    for (State& column : stages_) column.setZero();
    for (State& column : dense_) column.setZero();
  }

  /// Begins at (@p t0, @p y0), forgetting everything before; also after a jump of the state.
  /// @return stepped, or not_finite where t0, y0 or f(t0, y0) is not.
  template <RightHandSide<State> Function>
  StepStatus start(Function&& f, const T& t0, const State& y0) {
    time_ = previous_time_ = t0;
    state_ = y0;
    last_step_ = T(0);
    next_step_ = options_.initial_step;
    steps_ = rejected_steps_ = evaluations_ = 0;
    started_ = is_finite(t0) && evaluate(f, 0, t0, y0);
    return started_ ? StepStatus::stepped : StepStatus::not_finite;
  }

  /// One accepted step, at most to @p t_end: the last one ends there exactly. Nothing happens when
  /// t_end <= time(). After another status than stepped, time and state are the last good ones.
  /// @param f the same right-hand side as in `start`, continuous or not.
  template <RightHandSide<State> Function>
  StepStatus step(Function&& f, const T& t_end) {
    if (!started_ || !is_finite(t_end)) return StepStatus::not_finite;
    if (!(time_ < t_end)) return StepStatus::stepped;
    using detail::magnitude, detail::max, detail::min;
    const T remaining = t_end - time_;
    const T longest =
        T(0) < options_.maximum_step ? min(options_.maximum_step, remaining) : remaining;
    const T shortest = T(16) * epsilon<T>() * max(magnitude(time_), magnitude(t_end));
    if (next_step_ == T(0)) next_step_ = first_step(f, longest);
    for (bool rejected = false; steps_ + rejected_steps_ < options_.maximum_steps;) {
      T h = min(max(next_step_, shortest), longest);
      const bool lands = remaining <= h;
      if (!lands && h < shortest) return StepStatus::step_too_small;
      if (!lands && remaining < T(2) * h) h = remaining / T(2);  // leaves no sliver at the end
      const T time_new = lands ? t_end : T(time_ + h);
      const std::optional<T> error = attempt(f, h, time_new);
      const T factor = step_factor(error);
      if (error && *error <= T(1)) {
        accept(h, time_new);
        next_step_ = h * (rejected ? min(factor, T(1)) : factor);
        return StepStatus::stepped;
      }
      ++rejected_steps_;
      rejected = true;
      next_step_ = h * factor;
      if (next_step_ < shortest) {
        return error ? StepStatus::step_too_small : StepStatus::not_finite;
      }
    }
    return StepStatus::step_limit;
  }

  /// y(@p t) by the dense output of order 4, continuous with its derivative from step to step.
  /// @pre previous_time() <= t <= time(); the state itself at both ends.
  [[nodiscard]] State interpolate(const T& t) const {
    if (t == time_ || last_step_ == T(0)) return state_;
    const T s = (t - previous_time_) / last_step_;
    const T r = T(1) - s;
    return dense_[0] + s * (dense_[1] + r * (dense_[2] + s * (dense_[3] + r * dense_[4])));
  }

  [[nodiscard]] T time() const { return time_; }               ///< that was reached
  [[nodiscard]] const State& state() const { return state_; }  ///< at time()
  /// Where the last accepted step began, and its length [unit of t]; time() and 0 before the first.
  [[nodiscard]] T previous_time() const { return previous_time_; }
  [[nodiscard]] T last_step() const { return last_step_; }  ///< see previous_time()
  /// Counted since `start`: accepted steps, rejected ones, evaluations of f.
  [[nodiscard]] int steps() const { return steps_; }
  [[nodiscard]] int rejected_steps() const { return rejected_steps_; }  ///< see steps()
  [[nodiscard]] int evaluations() const { return evaluations_; }        ///< see steps()

 private:
  /// The sum tells, without a branch for each component, unless finite ones overflow in it.
  static bool all_finite(const State& y) { return is_finite(T(y.sum())) || (y - y).sum() == T(0); }

  /// The greatest |v_i| over the tolerance of a step from @p a to @p b.
  T norm(const State& v, const State& a, const State& b) const {
    using detail::magnitude, detail::max;
    T greatest = T(0);
    for (Eigen::Index i = 0; i < v.size(); ++i) {
      const T size = max(magnitude(a(i)), magnitude(b(i)));
      const T tolerance = options_.absolute_tolerance + options_.relative_tolerance * size;
      greatest = max(greatest, T(magnitude(v(i)) / tolerance));
    }
    return greatest;
  }

  /// The classical controller: safety 0.9, factors within 0.2 and 5; 0.2 without an estimate.
  static T step_factor(const std::optional<T>& error) {
    using std::pow;
    const T fifth = constant<T>(0.2L);
    if (!error || *error == T(0)) return error ? T(5) : fifth;
    return detail::clamp(T(constant<T>(0.9L) / pow(*error, fifth)), fifth, T(5));
  }

  /// stages_[index] = f(t, y). @return whether y and it are finite; f sees no other y.
  template <class Function>
  bool evaluate(Function& f, std::size_t index, const T& t, const State& y) {
    if (!all_finite(y)) return false;
    ++evaluations_;
    stages_[index] = f(t, y);
    WHEELRAIL_ASSERT(stages_[index].size() == y.size());
    return all_finite(stages_[index]);
  }

  /// hinit of dopri5, made independent of the unit of t: with tau the time in which f changes by
  /// its own size, the step h of tau (h / tau)^5 |f| = 1% of the tolerance.
  template <class Function>
  T first_step(Function& f, const T& longest) {
    using std::pow;
    const T nothing = constant<T>(1e-5L), percent = constant<T>(0.01L);
    const T size = norm(state_, state_, state_);
    const T rate = norm(stages_[0], state_, state_);
    const T guess = size <= nothing || rate * longest <= nothing
                        ? T(constant<T>(1e-6L) * longest)
                        : detail::min(T(percent * size / rate), longest);
    trial_ = state_ + guess * stages_[0];
    if (!evaluate(f, 1, T(time_ + guess), trial_)) return guess;
    trial_ = stages_[1] - stages_[0];
    const T change = norm(trial_, state_, state_);
    const T limit = detail::min(T(T(100) * guess), longest);
    if (change == T(0)) return limit;
    const T greatest = detail::max(rate, change);
    const T tau = guess * (greatest / change);
    return detail::min(limit, T(tau * pow(T(percent / (greatest * tau)), constant<T>(0.2L))));
  }

  /// The other six stages, and the new state in trial_.
  /// @return the error over its tolerance, <= 1 to be accepted; none where a stage is not finite.
  template <class Function>
  std::optional<T> attempt(Function& f, const T& h, const T& time_new) {
    for (std::size_t i = 1; i < stages_.size(); ++i) {
      trial_ = detail::dormand_prince_point(state_, h, stages_, i);
      const T t = i < 5 ? T(time_ + detail::dormand_prince_node<T>(i) * h) : time_new;
      if (!evaluate(f, i, t, trial_)) return std::nullopt;
    }
    // Finite stages leave a finite sum: its coefficients add up to less than one.
    return norm(h * detail::dormand_prince_error(stages_), state_, trial_);
  }

  /// Takes trial_; prepares the dense output (contd5 of dopri5) and the first stage of the next
  /// step.
  void accept(const T& h, const T& time_new) {
    dense_[0] = state_;
    dense_[1] = trial_ - state_;
    dense_[2] = h * stages_[0] - dense_[1];
    dense_[3] = dense_[1] - h * stages_[6] - dense_[2];
    dense_[4] = h * detail::dormand_prince_dense(stages_);
    state_ = trial_;
    std::swap(stages_[0], stages_[6]);
    previous_time_ = time_;
    time_ = time_new;
    last_step_ = h;
    ++steps_;
  }

  DormandPrinceOptions<T> options_;
  T time_ = T(0), previous_time_ = T(0), last_step_ = T(0), next_step_ = T(0);
  State state_, trial_;
  detail::DormandPrinceStages<State> stages_;
  std::array<State, 5> dense_;
  int steps_ = 0, rejected_steps_ = 0, evaluations_ = 0;
  bool started_ = false;
};

}  // namespace wheelrail
