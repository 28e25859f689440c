#include <array>
#include <limits>
#include <random>
#include <wheelrail/numerics/bracketed_root.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::StrictScalar;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// A function with its bracket and its only root there, all in closed form.
struct Problem {
  const char* name;
  double (*value)(double);
  double (*slope)(double);
  double lower, upper, root;
};
const std::array problems{
    Problem{"line", [](double x) { return 3 * x - 1; }, [](double) { return 3.0; }, 0, 1, 1.0 / 3},
    Problem{"falling parabola", [](double x) { return 2 - x * x; }, [](double x) { return -2 * x; },
            0, 2, std::sqrt(2.0)},
    Problem{"cosine", [](double x) { return std::cos(x); }, [](double x) { return -std::sin(x); },
            0.1, 3, std::acos(-1.0) / 2},
    Problem{"steep: exponential", [](double x) { return std::exp(50 * x) - 2; },
            [](double x) { return 50 * std::exp(50 * x); }, -1, 1, std::log(2.0) / 50},
    Problem{"steep: arc tangent, where bare Newton diverges",
            [](double x) { return std::atan(1e4 * (x - 0.3)); },
            [](double x) { return 1e4 / (1 + 1e8 * (x - 0.3) * (x - 0.3)); }, -1, 1, 0.3},
    Problem{"infinite slope: cube root", [](double x) { return std::cbrt(x - 0.7); },
            [](double x) { return 1 / (3 * std::cbrt(x - 0.7) * std::cbrt(x - 0.7)); }, 0, 1, 0.7},
    Problem{"flat, then steep", [](double x) { return std::pow(x, 20) - 1e-3; },
            [](double x) { return 20 * std::pow(x, 19); }, 0, 1, std::pow(10.0, -0.15)},
};

RootResult<double> newton(const Problem& p, double start, const RootOptions<double>& options = {}) {
  return bracketed_newton<double>(
      [&p](double x) {
        return ValueAndSlope<double>{p.value(x), p.slope(x)};
      },
      p.lower, p.upper, p.value(p.lower), p.value(p.upper), start, options);
}
RootResult<double> chandrupatla(const Problem& p, const RootOptions<double>& options = {}) {
  return bracketed_root<double>(p.value, p.lower, p.upper, p.value(p.lower), p.value(p.upper),
                                options);
}

}  // namespace

TEST_CASE("bracketed_newton: simple roots to rounding, from anywhere in the bracket",
          "[numerics]") {
  for (const Problem& problem : problems) {
    for (const double part : {0.0, 0.03, 0.5, 0.98, 1.0}) {
      CAPTURE(problem.name, part);
      const auto result = newton(problem, problem.lower + part * (problem.upper - problem.lower));
      CHECK(result.status == SolveStatus::converged);
      CHECK(result.position == Approx(problem.root).epsilon(4e-16).margin(4e-16));
      CHECK(result.iterations < 70);
    }
  }
}

TEST_CASE("bracketed_newton: converges quadratically near a simple root", "[numerics]") {
  // From 1.5, Newton's errors for sqrt(2) are 8.6e-2, 2.5e-3, 2.1e-6, 1.6e-12, 9e-25.
  const auto result = newton(problems[1], 1.5);
  CHECK(result.status == SolveStatus::converged);
  CHECK(result.iterations <= 5);
}

TEST_CASE("bracketed_root: simple roots to rounding without derivatives", "[numerics]") {
  for (const Problem& problem : problems) {
    CAPTURE(problem.name);
    const auto result = chandrupatla(problem);
    CHECK(result.status == SolveStatus::converged);
    CHECK(result.position == Approx(problem.root).epsilon(6e-16).margin(6e-16));
    CHECK(result.residual == problem.value(result.position));
    CHECK(result.iterations < 60);
  }
}

TEST_CASE("bracketed_root: superlinear on a smooth function", "[numerics]") {
  CHECK(chandrupatla(problems[1]).iterations <= 12);
  CHECK(chandrupatla(problems[2]).iterations <= 12);
}

TEST_CASE("bracketed_newton, bracketed_root: a triple root to the tolerance asked for",
          "[numerics]") {
  const auto value = [](double x) { return (x - 0.3) * (x - 0.3) * (x - 0.3); };
  const auto value_and_slope = [&](double x) {
    return ValueAndSlope<double>{value(x), 3 * (x - 0.3) * (x - 0.3)};
  };
  const RootOptions<double> options{.step_tolerance = 1e-9};
  const auto by_newton =
      bracketed_newton<double>(value_and_slope, -1, 2, value(-1), value(2), 1.9, options);
  CHECK(by_newton.status == SolveStatus::converged);
  // Newton's steps are a third of the error at a triple root.
  CHECK(std::abs(by_newton.position - 0.3) < 2e-9);
  const auto by_values = bracketed_root<double>(value, -1, 2, value(-1), value(2), options);
  CHECK(by_values.status == SolveStatus::converged);
  CHECK(std::abs(by_values.position - 0.3) <= 1e-9);
}

TEST_CASE("bracketed_newton: a useless slope costs iterations only", "[numerics]") {
  const auto value = [](double x) { return x * x - 2; };
  for (const double slope :
       {0.0, not_a_number, std::numeric_limits<double>::infinity(), -3.0, 1e-3, 1e300, 0.5}) {
    CAPTURE(slope);
    const auto result = bracketed_newton<double>(
        [&](double x) {
          return ValueAndSlope<double>{value(x), slope};
        },
        0, 2, value(0), value(2), 1.9);
    CHECK(result.status == SolveStatus::converged);
    CHECK(result.position == Approx(std::sqrt(2.0)).epsilon(1e-15));
    CHECK(result.iterations <= 100);
  }
}

TEST_CASE("bracketed_newton, bracketed_root: a root at an end of the bracket needs no evaluation",
          "[numerics]") {
  const auto value = [](double) -> double { throw std::logic_error("evaluated"); };
  const auto slope = [](double) -> ValueAndSlope<double> { throw std::logic_error("evaluated"); };
  const std::array<std::array<double, 3>, 3> cases{{{0, 1, -1}, {-1, 0, 2}, {0, 0, -1}}};
  for (const auto& [value_lower, value_upper, expected] : cases) {
    const auto by_newton = bracketed_newton<double>(slope, -1, 2, value_lower, value_upper, 0.5);
    const auto by_values = bracketed_root<double>(value, -1, 2, value_lower, value_upper);
    for (const auto& result : {by_newton, by_values}) {
      CHECK(result.status == SolveStatus::converged);
      CHECK(result.position == expected);
      CHECK(result.residual == 0);
      CHECK(result.iterations == 0);
    }
  }
}

TEST_CASE("bracketed_newton, bracketed_root: equal signs at the ends are no bracket",
          "[numerics][bad-input]") {
  for (const double sign : {-1.0, 1.0}) {
    const auto value = [sign](double x) { return sign * (x * x + 1); };
    const auto slope = [sign, value](double x) {
      return ValueAndSlope<double>{value(x), 2 * sign * x};
    };
    CHECK(bracketed_newton<double>(slope, -1, 2, value(-1), value(2), 0).status ==
          SolveStatus::no_bracket);
    CHECK(bracketed_root<double>(value, -1, 2, value(-1), value(2)).status ==
          SolveStatus::no_bracket);
  }
}

TEST_CASE("bracketed_newton, bracketed_root: NaN in or NaN on the way gives not_finite",
          "[numerics][bad-input]") {
  const auto value = [](double x) { return x - 0.25; };
  const auto slope = [](double x) { return ValueAndSlope<double>{x - 0.25, 1}; };
  const auto bad_value = [](double) { return not_a_number; };
  const auto bad_slope = [](double) { return ValueAndSlope<double>{not_a_number, 1}; };
  const auto not_finite = SolveStatus::not_finite;
  CHECK(bracketed_newton<double>(slope, 0, 1, not_a_number, 1, 0.5).status == not_finite);
  CHECK(bracketed_newton<double>(slope, 0, 1, -1, not_a_number, 0.5).status == not_finite);
  CHECK(bracketed_newton<double>(slope, 0, 1, -1, 1, not_a_number).status == not_finite);
  CHECK(bracketed_newton<double>(bad_slope, 0, 1, -1, 1, 0.5).status == not_finite);
  CHECK(bracketed_root<double>(value, 0, 1, not_a_number, 1).status == not_finite);
  CHECK(bracketed_root<double>(value, 0, 1, -1, not_a_number).status == not_finite);
  CHECK(bracketed_root<double>(bad_value, 0, 1, -1, 1).status == not_finite);
}

TEST_CASE("bracketed_newton, bracketed_root: NaN at an end of the bracket never converges",
          "[numerics][bad-input]") {
  const auto value = [](double x) { return x - 0.25; };
  const auto slope = [](double x) { return ValueAndSlope<double>{x - 0.25, 0}; };
  CHECK(bracketed_newton<double>(slope, not_a_number, 1, -1, 1, 0.5).status !=
        SolveStatus::converged);
  CHECK(bracketed_newton<double>(slope, 0, not_a_number, -1, 1, 0.1).status !=
        SolveStatus::converged);
  CHECK(bracketed_root<double>(value, not_a_number, 1, -1, 1).status != SolveStatus::converged);
  CHECK(bracketed_root<double>(value, 0, not_a_number, -1, 1).status != SolveStatus::converged);
}

TEST_CASE("bracketed_newton, bracketed_root: stop at the cap and say so", "[numerics]") {
  for (const int cap : {0, 1, 3}) {
    const RootOptions<double> options{.maximum_iterations = cap};
    const auto by_newton = newton(problems[4], 0.9, options);
    const auto by_values = chandrupatla(problems[4], options);
    for (const auto& result : {by_newton, by_values}) {
      CHECK(result.status == SolveStatus::iteration_limit);
      CHECK(result.iterations == cap);
    }
  }
}

TEST_CASE("bracketed_newton, bracketed_root: iterations are the evaluations", "[numerics]") {
  for (const Problem& problem : problems) {
    CAPTURE(problem.name);
    int evaluations = 0;
    const auto by_newton = bracketed_newton<double>(
        [&](double x) {
          ++evaluations;
          return ValueAndSlope<double>{problem.value(x), problem.slope(x)};
        },
        problem.lower, problem.upper, problem.value(problem.lower), problem.value(problem.upper),
        problem.lower);
    CHECK(evaluations > 0);
    CHECK(by_newton.iterations == evaluations);
    evaluations = 0;
    const auto by_values = bracketed_root<double>(
        [&](double x) {
          ++evaluations;
          return problem.value(x);
        },
        problem.lower, problem.upper, problem.value(problem.lower), problem.value(problem.upper));
    CHECK(evaluations > 0);
    CHECK(by_values.iterations == evaluations);
  }
}

TEST_CASE("bracketed_newton, bracketed_root: the tolerances end the iteration", "[numerics]") {
  int saved_by_newton = 0;
  int saved_by_values = 0;
  for (const Problem& problem : problems) {
    CAPTURE(problem.name);
    const RootOptions<double> by_residual{.residual_tolerance = 1e-4};
    const RootOptions<double> by_step{.step_tolerance = 1e-4};
    const double start = 0.5 * (problem.lower + problem.upper);
    for (const auto& result :
         {newton(problem, start, by_residual), chandrupatla(problem, by_residual)}) {
      CHECK(result.status == SolveStatus::converged);
      CHECK(std::abs(result.residual) <= 1e-4);
      CHECK(std::abs(problem.value(result.position)) <= 1e-4);
    }
    for (const auto& result : {newton(problem, start, by_step), chandrupatla(problem, by_step)}) {
      CHECK(result.status == SolveStatus::converged);
      CHECK(std::abs(result.position - problem.root) <= 1e-4);
    }
    saved_by_values += chandrupatla(problem).iterations - chandrupatla(problem, by_step).iterations;
    saved_by_newton +=
        newton(problem, start).iterations - newton(problem, start, by_step).iterations;
  }
  CHECK(saved_by_newton > 10);
  CHECK(saved_by_values > 10);
}

TEST_CASE("bracketed_newton, bracketed_root: never leave the bracket, always end in a root",
          "[numerics][random]") {
  std::mt19937 random(20240611);
  std::uniform_real_distribution<double> coefficient(-1.0, 1.0);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  int brackets = 0;
  int wavy = 0;
  for (int i = 0; i < 2000; ++i) {
    std::array<double, 6> c{};
    for (double& each : c) each = coefficient(random);
    const double pace = 1 + 9 * part(random);
    const double lie = coefficient(random);  // the slope is wrong by up to a factor of 2
    const auto value = [&](double x) {
      return c[0] + x * (c[1] + x * (c[2] + x * c[3])) + c[4] * std::sin(pace * x);
    };
    const double lower = -2 * part(random);
    const double upper = 2 * part(random);
    const double start = lower + (upper - lower) * part(random);
    if (!(value(lower) * value(upper) < 0)) continue;
    ++brackets;
    wavy += std::abs(c[4]) * pace > 2 ? 1 : 0;
    bool inside = true;
    const auto watched = [&](double x) {
      inside = inside && lower <= x && x <= upper;
      return value(x);
    };
    const auto watched_slope = [&](double x) {
      const double slope = c[1] + x * (2 * c[2] + x * 3 * c[3]) + c[4] * pace * std::cos(pace * x);
      return ValueAndSlope<double>{watched(x), slope * std::exp2(lie)};
    };
    const auto by_newton =
        bracketed_newton<double>(watched_slope, lower, upper, value(lower), value(upper), start);
    const auto by_values =
        bracketed_root<double>(watched, lower, upper, value(lower), value(upper));
    CAPTURE(i, lower, upper);
    CHECK(inside);
    for (const auto& result : {by_newton, by_values}) {
      CHECK(result.status == SolveStatus::converged);
      CHECK(lower <= result.position);
      CHECK(result.position <= upper);
      CHECK(std::abs(value(result.position)) < 1e-13);
      CHECK(result.iterations <= 100);
    }
  }
  CHECK(brackets > 700);
  CHECK(wavy > 200);
}

TEMPLATE_TEST_CASE("bracketed_newton, bracketed_root: as exact as the scalar is", "[numerics]",
                   float, double, long double) {
  using T = TestType;
  const auto value = [](T x) { return x * x * x - T(2); };
  const auto slope = [&](T x) { return ValueAndSlope<T>{value(x), T(3) * x * x}; };
  const T root = std::cbrt(T(2));
  const auto by_newton = bracketed_newton<T>(slope, T(0), T(3), value(T(0)), value(T(3)), T(2.9L));
  const auto by_values = bracketed_root<T>(value, T(0), T(3), value(T(0)), value(T(3)));
  for (const auto& result : {by_newton, by_values}) {
    CHECK(result.status == SolveStatus::converged);
    CHECK(std::abs(result.position - root) <= T(4) * epsilon<T>() * root);
  }
}

TEST_CASE(
    "bracketed_newton, bracketed_root: bit for bit the same for a scalar that converts to "
    "nothing",
    "[numerics]") {
  const auto value = [](const auto& x) {
    using std::sin;
    using T = std::decay_t<decltype(x)>;
    return T(sin(x) - x * x);
  };
  const auto slope = [&](const auto& x) {
    using std::cos;
    using T = std::decay_t<decltype(x)>;
    return ValueAndSlope<T>{value(x), cos(x) - T(2) * x};
  };
  const auto solve = [&]<class T>(T lower, T upper) {
    return std::array{bracketed_newton<T>(slope, lower, upper, value(lower), value(upper), upper),
                      bracketed_root<T>(value, lower, upper, value(lower), value(upper))};
  };
  const auto expected = solve(0.5, 1.5);
  const auto strict = solve(StrictScalar(0.5), StrictScalar(1.5));
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(expected[i].status == SolveStatus::converged);
    CHECK(strict[i].status == expected[i].status);
    CHECK(strict[i].iterations == expected[i].iterations);
    CHECK(strict[i].position.as_double() == expected[i].position);
    CHECK(strict[i].residual.as_double() == expected[i].residual);
  }
}

TEST_CASE("bracketed_newton, bracketed_root: no allocation", "[numerics][no-alloc]") {
  double sum = 0;
  CHECK(wheelrail_test::allocations_of([&] {
          for (const Problem& problem : problems) {
            sum += newton(problem, problem.lower).position + chandrupatla(problem).position;
          }
        }) == 0);
  CHECK(sum > 1);
}

TEST_CASE("bracketed_newton: on a grid the root does not depend on the start", "[numerics]") {
  const auto function = [](double x) {
    return ValueAndSlope<double>{std::exp(x) - 2 + x, std::exp(x) + 1};
  };
  const double exact = 0.44285440100238858;
  const RootOptions<double> options{.grid = 1e-8};
  double first = 0;
  int most = 0;
  for (int i = 0; i <= 1000; ++i) {
    const double start = -1 + 3.0 * i / 1000;
    const auto root = bracketed_newton<double>(function, -1.0, 2.0, std::exp(-1.0) - 3,
                                               std::exp(2.0), start, options);
    REQUIRE(root.status == SolveStatus::converged);
    if (i == 0) first = root.position;
    CHECK(root.position == first);
    CHECK(std::abs(root.position - exact) < 4e-16);
    most = std::max(most, root.iterations);
  }
  CHECK(most < 10);
}

TEST_CASE("bracketed_newton: on a grid a jump is halved down to the tolerance, from any start",
          "[numerics]") {
  const RootOptions<double> options{.step_tolerance = 1e-16, .grid = 1e-8};
  for (const double jump : {0.0, 0.3, -0.7 + 0x1p-30}) {
    const auto function = [jump](double x) {
      return ValueAndSlope<double>{(x < jump ? -0.05 : 0.05) + 0.01 * (x - jump), 0.01};
    };
    double first = 0;
    for (int i = 0; i <= 100; ++i) {
      const double start = -0.4 + 0.8 * i / 100;
      const auto root = bracketed_newton<double>(function, -0.9, 1.0, function(-0.9).value,
                                                 function(1.0).value, start, options);
      CAPTURE(jump, start);
      REQUIRE(root.status == SolveStatus::converged);
      CHECK(std::abs(root.position - jump) <= 1e-16 + 4e-16 * std::abs(jump));
      if (i == 0) first = root.position;
      CHECK(root.position == first);
    }
  }
}

TEST_CASE("bracketed_newton: on a grid a jump beside a branch's root is within half of it",
          "[numerics]") {
  const RootOptions<double> options{.step_tolerance = 1e-16, .grid = 1e-8};
  double worst = 0;
  for (int k = 0; k < 40; ++k) {
    const double jump = 0.3 + 1.3e-10 * k;
    for (int i = -60; i <= 60; ++i) {
      // The left branch would pass zero only beyond the jump.
      const double beyond = jump + 2.5e-10 * i;
      const auto function = [=](double x) {
        return ValueAndSlope<double>{x < jump ? x - beyond : 0.05, 1};
      };
      const auto root = bracketed_newton<double>(function, -0.9, 1.0, function(-0.9).value,
                                                 function(1.0).value, 0.2, options);
      CAPTURE(jump, beyond);
      REQUIRE(root.status == SolveStatus::converged);
      const double exact = std::min(jump, beyond);
      worst = std::max(worst, std::abs(root.position - exact));
    }
  }
  INFO(worst);
  CHECK(worst > 1e-10);
  CHECK(worst < 0.51e-8);
}
