#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>
#include <wheelrail/numerics/integrate.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"

using namespace wheelrail;

namespace {

using State = Eigen::Vector2d;

State oscillator(double, const State& y) {
  return State(y(1), -y(0));
}

const auto ignore = [](double, const State&) { return true; };

}  // namespace

TEST_CASE("integrate: reports stand at products of the interval and at both ends, once",
          "[numerics][integrate]") {
  struct Case {
    double t0, t_end, interval;
    std::size_t reports;
  };
  // In double 3 * 0.1 > 0.3 and 3 * 0.3 < 0.9; 1.05 ends between two reports.
  for (const Case& c : {Case{0.0, 1.0, 0.1, 11}, Case{0.0, 0.3, 0.1, 4}, Case{0.0, 0.9, 0.3, 4},
                        Case{0.0, 1.05, 0.1, 12}, Case{-2.0, 3.0, 1e-3, 5001},
                        Case{0.0, 1.0, 0.0, 2}, Case{0.0, 1.0, 5.0, 2}, Case{1.0, 1.0, 0.1, 1}}) {
    CAPTURE(c.t0, c.t_end, c.interval);
    std::vector<double> times;
    double worst = 0.0;
    const auto result = integrate(
        oscillator, c.t0, State(std::cos(c.t0), -std::sin(c.t0)), c.t_end, c.interval,
        {.relative_tolerance = 1e-9, .absolute_tolerance = 1e-9}, [&](double t, const State& y) {
          times.push_back(t);
          worst = std::max(worst, std::fabs(y(0) - std::cos(t)));
          return true;
        });
    CHECK(result.status == IntegrationStatus::finished);
    CHECK(result.time == c.t_end);
    REQUIRE(times.size() == c.reports);
    CHECK(times.front() == c.t0);
    CHECK(times.back() == c.t_end);
    for (std::size_t k = 1; k + 1 < times.size(); ++k) {
      CHECK(times[k] == c.t0 + static_cast<double>(k) * c.interval);
    }
    CHECK(worst < 1e-7);
  }
}

TEST_CASE("integrate: reports do not change the steps", "[numerics][integrate]") {
  const auto sparse = integrate(oscillator, 0, State(1, 0), 10, 0, {}, ignore);
  const auto dense = integrate(oscillator, 0, State(1, 0), 10, 1e-3, {}, ignore);
  CHECK(sparse.state == dense.state);
  CHECK(sparse.steps == dense.steps);
  CHECK(sparse.evaluations == dense.evaluations);
  CHECK(sparse.steps < 60);
}

TEST_CASE("integrate: the observer stops it where it stands", "[numerics][integrate]") {
  for (const double last : {0.0, 0.5, 2.0}) {
    CAPTURE(last);
    const auto result = integrate(oscillator, 0, State(1, 0), 2, 0.25, {},
                                  [&](double t, const State&) { return t < last; });
    CHECK(result.status == IntegrationStatus::stopped_by_observer);
    CHECK(result.time == last);
    CHECK(result.state(0) == Approx(std::cos(last)).margin(1e-4));
  }
}

TEST_CASE("integrate: failures of a step are passed on with the last good state",
          "[numerics][integrate][bad-input]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto ends = [&](double t, const State& y) { return t < 1.0 ? y : State(nan, nan); };
  double last = -1.0;
  const auto result = integrate(ends, 0, State(1, 0), 2, 0.1, {}, [&](double t, const State&) {
    last = t;
    return true;
  });
  CHECK(result.status == IntegrationStatus::not_finite);
  CHECK(result.time == Approx(1.0));
  CHECK(result.state(0) == Approx(std::exp(result.time)).margin(1e-4));
  CHECK(last == Approx(0.9));
  CHECK(integrate(oscillator, 0, State(nan, 0), 2, 0.1, {}, ignore).status ==
        IntegrationStatus::not_finite);
  CHECK(integrate(oscillator, 0, State(1, 0), 2, 0.1, {.maximum_step = 0.1, .maximum_steps = 5},
                  ignore)
            .status == IntegrationStatus::step_limit);
  const auto explodes = [](double, const State& y) { return State(y(0) * y(0), 0); };
  CHECK(integrate(explodes, 0, State(1, 0), 2, 0.1, {.relative_tolerance = 1e-9}, ignore).status ==
        IntegrationStatus::step_too_small);
}

TEST_CASE("integrate: bad times are refused before anything runs",
          "[numerics][integrate][bad-input]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto run = [](double t0, double t_end, double interval) {
    return integrate(oscillator, t0, State(1, 0), t_end, interval, {}, ignore);
  };
  CHECK_NOTHROW(run(0, 1, 0.5));
  CHECK_THROWS_AS(run(nan, 1, 0.5), std::invalid_argument);
  CHECK_THROWS_AS(run(0, -1, 0.5), std::invalid_argument);
  CHECK_THROWS_AS(run(0, nan, 0.5), std::invalid_argument);
  CHECK_THROWS_AS(run(0, 1, -0.5), std::invalid_argument);
  CHECK_THROWS_AS(run(0, 1, 1e-18), std::invalid_argument);  // more reports than instants
}

TEST_CASE("integrate: mirrored and reordered problems take the same steps bit for bit",
          "[numerics][integrate][symmetry]") {
  // A pendulum with a spring that acts in compression only: not odd, so that a mirror shows.
  const auto f = [](double, const State& y) {
    return State(y(1), -std::sin(y(0)) - (y(0) < -0.2 ? 50 * (y(0) + 0.2) : 0.0));
  };
  const auto mirrored = [&](double t, const State& y) { return State(-f(t, State(-y))); };
  const auto reordered = [&](double t, const State& y) {
    return State(f(t, State(y.reverse())).reverse());
  };
  const auto plain = integrate(f, 0, State(1, 0.1), 20, 0, {}, ignore);
  const auto image = integrate(mirrored, 0, State(-1, -0.1), 20, 0, {}, ignore);
  const auto swapped = integrate(reordered, 0, State(0.1, 1), 20, 0, {}, ignore);
  REQUIRE(plain.status == IntegrationStatus::finished);
  CHECK(plain.rejected_steps > 0);
  CHECK(image.state == -plain.state);
  CHECK(swapped.state == plain.state.reverse());
  CHECK(image.evaluations == plain.evaluations);
}

TEST_CASE(
    "integrate: once its arguments are checked, nothing is allocated for a state of fixed size",
    "[numerics][integrate][no-alloc]") {
  using wheelrail_test::allocations_of;
  const auto run_until = [](double t_end) {
    return integrate(oscillator, 0, State(1, 0), t_end, 0.01, {}, ignore).time == t_end;
  };
  const long for_the_checks = allocations_of([&] { CHECK(run_until(0.0)); });
  CHECK(allocations_of([&] { CHECK(run_until(100.0)); }) == for_the_checks);

  DormandPrince<State> solver;
  StepStatus status{};
  CHECK(allocations_of([&] {
          status = solver.start(oscillator, 0, State(1, 0));
          while (status == StepStatus::stepped && solver.time() < 10) {
            status = solver.step(oscillator, 10);
          }
        }) == 0);
  CHECK(status == StepStatus::stepped);
  CHECK(solver.time() == 10);
  CHECK(allocations_of([] { ::operator delete(::operator new(8)); }) == 1);  // the counter counts
}
