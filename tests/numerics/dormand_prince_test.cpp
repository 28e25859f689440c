#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>
#include <wheelrail/numerics/dormand_prince.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

template <class T>
using State1 = Eigen::Matrix<T, 1, 1>;
template <class T>
using State2 = Eigen::Matrix<T, 2, 1>;
using State4 = Eigen::Matrix<double, 4, 1>;

// y'' = -y as a system; y = (cos t, -sin t) from (1, 0).
template <class T>
State2<T> oscillator(const T&, const State2<T>& y) {
  return State2<T>(y(1), -y(0));
}

// y' = cos(t) y, y = exp(sin t) from 1: not autonomous, so that the nodes matter.
template <class T>
State1<T> swell(const T& t, const State1<T>& y) {
  return State1<T>(std::cos(t) * y(0));
}

// Steps of h, whatever the error.
template <class T>
DormandPrinceOptions<T> fixed_step(T h) {
  return {.absolute_tolerance = T(1e10), .maximum_step = h, .initial_step = h};
}

// Steps to t_end. @return the solver, which must have arrived exactly.
template <class State, class Function>
DormandPrince<State> arrive(Function&& f, typename State::Scalar t0, const State& y0,
                            typename State::Scalar t_end,
                            const DormandPrinceOptions<typename State::Scalar>& options) {
  DormandPrince<State> solver(options);
  REQUIRE(solver.start(f, t0, y0) == StepStatus::stepped);
  while (solver.time() < t_end) REQUIRE(solver.step(f, t_end) == StepStatus::stepped);
  CHECK(solver.time() == t_end);
  return solver;
}

template <class Function>
std::string message_of(Function&& f) {
  try {
    f();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "(nothing was thrown)";
}

}  // namespace

TEST_CASE("DormandPrince: at fixed steps the global error is of order 5",
          "[numerics][dormand_prince]") {
  using T = long double;
  std::vector<T> errors;
  for (const T h : {T(1) / 8, T(1) / 16, T(1) / 32, T(1) / 64}) {
    const auto solver = arrive<State1<T>>(swell<T>, 0, State1<T>(1), 4, fixed_step(h));
    CHECK(solver.steps() == static_cast<int>(T(4) / h));
    errors.push_back(std::fabs(solver.state()(0) - std::exp(std::sin(T(4)))));
  }
  for (std::size_t i = 1; i < errors.size(); ++i) {
    CAPTURE(i, errors[i]);
    CHECK(std::log2(errors[i - 1] / errors[i]) == Approx(5.0).margin(0.3));
  }
}

TEST_CASE("DormandPrince: quartic polynomials are integrated exactly and cubic ones unnoticed",
          "[numerics][dormand_prince]") {
  using T = long double;
  const auto quartic = [](T t, const State1<T>&) { return State1<T>(5 * t * t * t * t); };
  const auto solver = arrive<State1<T>>(quartic, 0, State1<T>(0), 2, fixed_step(T(0.5)));
  CHECK(std::fabs(solver.state()(0) - 32) < 64 * epsilon<T>());

  // The error estimate is exact for y' = t^3: both formulas are, so that nothing limits the step.
  const auto cubic = [](T t, const State1<T>&) { return State1<T>(4 * t * t * t); };
  const auto unnoticed = arrive<State1<T>>(
      cubic, 0, State1<T>(0), 2,
      {.relative_tolerance = 0, .absolute_tolerance = T(1e-15), .initial_step = 2});
  CHECK(unnoticed.steps() == 1);
  CHECK(std::fabs(unnoticed.state()(0) - 16) < 64 * epsilon<T>());
  // Of y' = t^4 it is h^5 / 5 times the fourth-order formula's defect: the step is limited.
  const auto noticed = arrive<State1<T>>(
      quartic, 0, State1<T>(0), 2,
      {.relative_tolerance = 0, .absolute_tolerance = T(1e-15), .initial_step = 2});
  CHECK(noticed.steps() > 100);
}

TEST_CASE("DormandPrince: the global error follows the tolerance", "[numerics][dormand_prince]") {
  double previous_error = 1.0;
  int previous_evaluations = 0;
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    CAPTURE(tolerance);
    const auto solver =
        arrive<State2<double>>(oscillator<double>, 0.0, {1.0, 0.0}, 20.0,
                               {.relative_tolerance = tolerance, .absolute_tolerance = tolerance});
    const double error =
        std::hypot(solver.state()(0) - std::cos(20.0), solver.state()(1) + std::sin(20.0));
    CHECK(error < 30.0 * tolerance);
    CHECK(error > 0.1 * tolerance);  // and no accuracy is bought that was not ordered
    CHECK(error < 0.1 * previous_error);
    CHECK(solver.evaluations() > 2 * previous_evaluations);
    CHECK(solver.evaluations() <= 2 + 6 * (solver.steps() + solver.rejected_steps()));
    previous_error = error;
    previous_evaluations = solver.evaluations();
  }
}

TEST_CASE("DormandPrince: Arenstorf's orbit closes", "[numerics][dormand_prince][reference]") {
  // Hairer, Norsett, Wanner, Solving ODEs I, II.0 (0.1): restricted three bodies, periodic.
  const double moon = 0.012277471, earth = 1.0 - moon;
  const double period = 17.0652165601579625588917206249;
  const State4 start(0.994, 0.0, 0.0, -2.00158510637908252240537862224);
  const auto f = [&](double, const State4& y) {
    const double to_earth = std::pow(std::hypot(y(0) + moon, y(1)), 3);
    const double to_moon = std::pow(std::hypot(y(0) - earth, y(1)), 3);
    return State4(
        y(2), y(3),
        y(0) + 2 * y(3) - earth * (y(0) + moon) / to_earth - moon * (y(0) - earth) / to_moon,
        y(1) - 2 * y(2) - earth * y(1) / to_earth - moon * y(1) / to_moon);
  };
  for (const double tolerance : {1e-7, 1e-10, 1e-13}) {
    CAPTURE(tolerance);
    const auto solver = arrive<State4>(
        f, 0.0, start, period, {.relative_tolerance = tolerance, .absolute_tolerance = tolerance});
    CHECK((solver.state() - start).head<2>().norm() < 1e3 * tolerance);
    CHECK(solver.steps() < 4000);
  }
}

TEST_CASE("DormandPrince: the dense output is of order 4 inside and exact at the ends",
          "[numerics][dormand_prince]") {
  using T = long double;
  std::vector<T> errors;
  for (const T h : {T(1) / 4, T(1) / 8, T(1) / 16, T(1) / 32}) {
    DormandPrince<State1<T>> solver(fixed_step(h));
    const State1<T> start(std::exp(std::sin(T(1))));
    REQUIRE(solver.start(swell<T>, 1, start) == StepStatus::stepped);
    CHECK(solver.interpolate(1)(0) == start(0));
    REQUIRE(solver.step(swell<T>, 10) == StepStatus::stepped);
    CHECK(solver.previous_time() == 1);
    CHECK(solver.last_step() == h);
    CHECK(solver.interpolate(1)(0) == start(0));
    CHECK(solver.interpolate(solver.time())(0) == solver.state()(0));
    T worst = 0;
    for (int i = 1; i < 10; ++i) {
      const T t = 1 + h * T(i) / 10;
      worst = std::max(worst, std::fabs(solver.interpolate(t)(0) - std::exp(std::sin(t))));
    }
    errors.push_back(worst);
    // The limits from inside are the ends with their derivatives: continuous at the joints.
    const T small = h * T(1e-6);
    const T slope_end = (solver.state()(0) - solver.interpolate(solver.time() - small)(0)) / small;
    const T slope_begin = (solver.interpolate(1 + small)(0) - start(0)) / small;
    CHECK(std::fabs(slope_begin - swell<T>(1, start)(0)) < T(1e-5));
    CHECK(std::fabs(slope_end - swell<T>(solver.time(), solver.state())(0)) < T(1e-5));
  }
  for (std::size_t i = 1; i < errors.size(); ++i) {  // locally h^5
    CAPTURE(i, errors[i]);
    CHECK(std::log2(errors[i - 1] / errors[i]) == Approx(5.0).margin(0.35));
  }
}

TEMPLATE_TEST_CASE("DormandPrince: every scalar reaches its own accuracy",
                   "[numerics][dormand_prince]", float, double, long double) {
  using T = TestType;
  const T tolerance = std::pow(epsilon<T>(), T(0.8));
  const auto solver =
      arrive<State2<T>>(oscillator<T>, 0, {T(1), T(0)}, 3,
                        {.relative_tolerance = tolerance, .absolute_tolerance = tolerance});
  CHECK(std::fabs(solver.state()(0) - std::cos(T(3))) < 10 * tolerance);
  CHECK(std::fabs(solver.state()(1) + std::sin(T(3))) < 10 * tolerance);
}

TEST_CASE("DormandPrince: a state of dynamic size takes the same steps",
          "[numerics][dormand_prince]") {
  const auto fixed =
      arrive<State2<double>>(oscillator<double>, 0.0, State2<double>(1.0, 0.0), 5.0, {});
  const auto f = [](double, const Eigen::VectorXd& y) -> Eigen::VectorXd {
    return State2<double>(y(1), -y(0));
  };
  const Eigen::VectorXd start = State2<double>(1.0, 0.0);
  const auto dynamic = arrive<Eigen::VectorXd>(f, 0.0, start, 5.0, {});
  CHECK(dynamic.state()(0) == Approx(fixed.state()(0)).epsilon(1e-14));
  CHECK(dynamic.steps() == fixed.steps());
  CHECK(dynamic.evaluations() == fixed.evaluations());
}

TEST_CASE("DormandPrince: no step is longer than maximum_step or passes t_end",
          "[numerics][dormand_prince]") {
  const auto still = [](double, const State1<double>&) { return State1<double>(0.0); };
  DormandPrince<State1<double>> solver({.maximum_step = 0.3});
  REQUIRE(solver.start(still, 0.0, State1<double>(1.0)) == StepStatus::stepped);
  for (const double t_end : {1.0, 1.0 + 1e-12, 2.0}) {
    while (solver.time() < t_end) {
      const double before = solver.time();
      REQUIRE(solver.step(still, t_end) == StepStatus::stepped);
      CHECK(solver.last_step() <= 0.3);
      CHECK(before < solver.time());
      CHECK(solver.previous_time() == before);
    }
    CHECK(solver.time() == t_end);
  }
  const int steps = solver.steps();
  CHECK(solver.step(still, 1.5) == StepStatus::stepped);  // t_end has passed: nothing happens
  CHECK(solver.steps() == steps);
  CHECK(solver.time() == 2.0);
}

TEST_CASE("DormandPrince: the last step lands on t_end where t + (t_end - t) does not",
          "[numerics][dormand_prince]") {
  const auto still = [](double, const State1<double>&) { return State1<double>(0.0); };
  int missed = 0;
  for (int i = 1; i < 200; ++i) {
    const double t0 = -0.1 * i, t_end = 1.0 / i;
    missed += t0 + (t_end - t0) != t_end;
    arrive<State1<double>>(still, t0, State1<double>(0.0), t_end, {.initial_step = 100.0});
  }
  CHECK(missed > 10);
}

TEST_CASE("DormandPrince: the first step is neither wasteful nor rejected",
          "[numerics][dormand_prince]") {
  for (const double rate : {1e-3, 1.0, 1e6}) {
    CAPTURE(rate);
    const auto f = [&](double, const State2<double>& y) {
      return State2<double>(rate * y(1), -rate * y(0));
    };
    DormandPrince<State2<double>> solver;
    REQUIRE(solver.start(f, 0.0, {1.0, 0.0}) == StepStatus::stepped);
    REQUIRE(solver.step(f, 20.0 / rate) == StepStatus::stepped);
    CHECK(solver.rejected_steps() == 0);
    CHECK(rate * solver.last_step() > 0.02);
    CHECK(rate * solver.last_step() < 1.0);
  }
}

TEST_CASE("DormandPrince: a jump of the right-hand side is survived",
          "[numerics][dormand_prince]") {
  const auto ramp = [](double t, const State1<double>&) {
    return State1<double>(t < 1.0 / 3.0 ? 0.0 : 1.0);
  };
  const auto solver = arrive<State1<double>>(ramp, 0.0, State1<double>(0.0), 1.0, {});
  // The estimate sees about a tenth of the error that a jump leaves.
  CHECK(solver.state()(0) == Approx(2.0 / 3.0).margin(3e-4));
  CHECK(solver.rejected_steps() > 0);
  CHECK(solver.steps() + solver.rejected_steps() < 60);

  // Dry friction holds y at zero, where f keeps changing its sign.
  const auto friction = [](double, const State1<double>& y) {
    return State1<double>(y(0) > 0.0 ? -1.0 : 1.0);
  };
  const auto held = arrive<State1<double>>(friction, 0.0, State1<double>(0.1), 0.2, {});
  CHECK(std::fabs(held.state()(0)) < 1e-4);
}

TEST_CASE("DormandPrince: a ball that bounces on a stiff spring comes back to its height",
          "[numerics][dormand_prince][reference]") {
  // Free fall from height 1, then half a swing on the spring and a little more under the weight:
  // contact time (2 / w)(pi - atan(v w / g)).
  const double gravity = 9.81, frequency = 1e3;
  const auto f = [&](double, const State2<double>& y) {
    const double spring = y(0) < 0.0 ? -frequency * frequency * y(0) : 0.0;
    return State2<double>(y(1), spring - gravity);
  };
  const double fall = std::sqrt(2.0 / gravity), speed = gravity * fall;
  const double contact =
      2.0 / frequency * (3.14159265358979323846 - std::atan(speed * frequency / gravity));
  const double period = 2.0 * fall + contact;
  const auto solver = arrive<State2<double>>(
      f, 0.0, {1.0, 0.0}, 5.0 * period, {.relative_tolerance = 1e-9, .absolute_tolerance = 1e-9});
  CHECK(solver.state()(0) == Approx(1.0).margin(1e-6));
  CHECK(solver.state()(1) == Approx(0.0).margin(1e-5));
  CHECK(solver.rejected_steps() >= 5);
}

TEST_CASE("DormandPrince: a trial state outside the domain of f shortens the step",
          "[numerics][dormand_prince]") {
  // y' = -sqrt(y): y = (1 - t/2)^2; NaN for y < 0, where the long first trial leads.
  const auto f = [](double, const State1<double>& y) {
    return State1<double>(-100.0 * std::sqrt(y(0)));
  };
  const auto solver =
      arrive<State1<double>>(f, 0.0, State1<double>(1.0), 0.019, {.initial_step = 0.019});
  CHECK(solver.rejected_steps() > 0);
  CHECK(solver.state()(0) == Approx(0.0025).margin(1e-4));
}

TEST_CASE("DormandPrince: failures have a status and keep the last good state",
          "[numerics][dormand_prince][bad-input]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto run = [](auto&& f, double y0, const DormandPrinceOptions<double>& options) {
    DormandPrince<State1<double>> solver(options);
    StepStatus status = solver.start(f, 0.0, State1<double>(y0));
    while (status == StepStatus::stepped && solver.time() < 2.0) status = solver.step(f, 2.0);
    CHECK(std::isfinite(solver.time()));
    return std::pair(status, solver);
  };
  const auto growth = [](double, const State1<double>& y) { return y; };

  SECTION("f ends at t = 1") {
    const auto [status, solver] =
        run([&](double t, const State1<double>&) { return State1<double>(t < 1.0 ? 1.0 : nan); },
            0.0, {});
    CHECK(status == StepStatus::not_finite);
    CHECK(solver.time() == Approx(1.0).margin(1e-13));
    CHECK(solver.time() < 1.0);
    CHECK(solver.state()(0) == Approx(solver.time()));
    CHECK(solver.interpolate(solver.time())(0) == solver.state()(0));
  }
  SECTION("y' = y^2 is infinite at t = 1") {
    const auto [status, solver] =
        run([](double, const State1<double>& y) { return State1<double>(y(0) * y(0)); }, 1.0,
            {.relative_tolerance = 1e-9});
    CHECK(status == StepStatus::step_too_small);
    CHECK(solver.time() == Approx(1.0).margin(1e-6));
  }
  SECTION("trial states that overflow are never shown to f") {
    const auto [status, solver] = run(
        [](double, const State1<double>& y) {
          REQUIRE(std::isfinite(y(0)));
          return State1<double>(1e308);
        },
        1.7e308, {});
    CHECK(status == StepStatus::not_finite);
    CHECK(solver.rejected_steps() > 0);
  }
  SECTION("not finite from the start") {
    CHECK(run(growth, nan, {}).first == StepStatus::not_finite);
    CHECK(run([&](double, const State1<double>&) { return State1<double>(nan); }, 0.0, {}).first ==
          StepStatus::not_finite);
    DormandPrince<State1<double>> solver;
    CHECK(solver.start(growth, nan, State1<double>(1.0)) == StepStatus::not_finite);
    CHECK(solver.step(growth, 1.0) == StepStatus::not_finite);
    CHECK(solver.start(growth, 0.0, State1<double>(1.0)) == StepStatus::stepped);
    CHECK(solver.step(growth, nan) == StepStatus::not_finite);
    CHECK(solver.step(growth, 1.0) == StepStatus::stepped);
  }
  SECTION("too many steps") {
    const auto [status, solver] = run(growth, 1.0, {.maximum_step = 0.01, .maximum_steps = 20});
    CHECK(status == StepStatus::step_limit);
    CHECK(solver.steps() + solver.rejected_steps() == 20);
    CHECK(solver.state()(0) == Approx(std::exp(solver.time())).margin(1e-5));
  }
  SECTION("a maximum step below the resolution of time") {
    DormandPrince<State1<double>> solver({.maximum_step = 1e-9});
    REQUIRE(solver.start(growth, 1e9, State1<double>(1.0)) == StepStatus::stepped);
    CHECK(solver.step(growth, 2e9) == StepStatus::step_too_small);
  }
}

TEST_CASE("DormandPrince: options out of range are named",
          "[numerics][dormand_prince][bad-input]") {
  using Solver = DormandPrince<State1<double>>;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using Catch::Matchers::ContainsSubstring;
  CHECK_THAT(message_of([] { Solver({.relative_tolerance = -1e-3}); }),
             ContainsSubstring("relative_tolerance is -0.001"));
  CHECK_THAT(message_of([] { Solver({.absolute_tolerance = 0.0}); }),
             ContainsSubstring("absolute_tolerance is 0"));
  CHECK_THAT(message_of([&] { Solver({.maximum_step = nan}); }), ContainsSubstring("maximum_step"));
  CHECK_THAT(message_of([] { Solver({.initial_step = -1.0}); }),
             ContainsSubstring("initial_step is -1"));
  CHECK_THAT(message_of([] { Solver({.maximum_steps = 0}); }),
             ContainsSubstring("maximum_steps is 0"));
}
