#include <cmath>
#include <limits>
#include <wheelrail/force/normal_force.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/numeric_difference.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::StrictScalar;

namespace {

constexpr double stiffness = 9e10;

struct Impact {
  double greatest_penetration = 0;
  double duration = 0;
  double rebound_velocity = 0;
};

// A mass that strikes with this velocity, by the classical Runge-Kutta method until it leaves; the
// step is a fraction of the duration of the elastic impact.
Impact strike(double mass, double velocity, const NormalForceOptions<double>& options) {
  const auto acceleration = [&](double x, double v) {
    return -normal_force(stiffness, x, v, options) / mass;
  };
  const double scale = std::pow(5 * mass * velocity * velocity / (4 * stiffness), 0.4);
  const double h = scale / velocity / 20000;
  double x = 0, v = velocity;
  Impact impact;
  for (int i = 0; i < 200000; ++i) {
    const double v2 = v + h / 2 * acceleration(x, v);
    const double v3 = v + h / 2 * acceleration(x + h / 2 * v, v2);
    const double v4 = v + h * acceleration(x + h / 2 * v2, v3);
    const double next_x = x + h / 6 * (v + 2 * v2 + 2 * v3 + v4);
    const double next_v =
        v + h / 6 *
                (acceleration(x, v) + 2 * acceleration(x + h / 2 * v, v2) +
                 2 * acceleration(x + h / 2 * v2, v3) + acceleration(x + h * v3, v4));
    if (i > 0 && next_x <= 0) {
      impact.duration = (i + x / (x - next_x)) * h;
      impact.rebound_velocity = -v;
      return impact;
    }
    x = next_x;
    v = next_v;
    impact.greatest_penetration = std::max(impact.greatest_penetration, x);
  }
  FAIL("the mass stays in contact");
  return impact;
}

}  // namespace

TEST_CASE("normal_force: the three branches of (63)", "[force][reference]") {
  const double elastic = stiffness * std::pow(5e-5, 1.5);
  const auto at = [](double velocity) { return normal_force(stiffness, 5e-5, velocity); };
  CHECK(at(0.1) == Approx(elastic).epsilon(1e-14));
  CHECK(at(7.0) == Approx(elastic).epsilon(1e-14));
  CHECK(at(-0.1) == Approx(0.75 * elastic).epsilon(1e-14));
  CHECK(at(-7.0) == Approx(0.75 * elastic).epsilon(1e-14));
  CHECK(at(0.0) == Approx(0.875 * elastic).epsilon(1e-14));
  // (64): r = 1/4, 3 r^2 - 2 r^3 = 5/32.
  CHECK(at(-0.05) == Approx((0.75 + 0.25 * 5 / 32) * elastic).epsilon(1e-14));
}

TEST_CASE("normal_force: its derivative is continuous where the branches meet", "[force]") {
  const auto f = [](double velocity) { return normal_force(stiffness, 5e-5, velocity); };
  const double scale = normal_force(stiffness, 5e-5, 1.0);
  for (const double edge : {-0.1, 0.1}) {
    CAPTURE(edge);
    CHECK(std::abs(f(edge + 1e-9) - f(edge - 1e-9)) < 1e-12 * scale);
    for (const double side : {-1e-4, 1e-4}) {
      const double slope = wheelrail_test::central_difference(f, edge + side, 1e-5);
      CHECK(std::abs(slope) < 0.05 * scale);  // in the middle it is 1.875 of it
    }
  }
  CHECK(wheelrail_test::central_difference(f, 0.0, 1e-3) ==
        Approx(0.25 * 1.5 / 0.2 * scale).epsilon(1e-9));
  // Like d^1.5 at the touch: value and slope vanish.
  CHECK(normal_force(stiffness, 1e-16, 1.0) / 1e-16 < 1e-3 * stiffness);
}

TEST_CASE("normal_force: nothing without penetration", "[force][bad-input]") {
  CHECK(normal_force(stiffness, 0.0, 1.0) == 0);
  CHECK(normal_force(stiffness, -1e-3, 1.0) == 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(normal_force(stiffness, nan, 1.0)));
  CHECK(std::isnan(normal_force(nan, 1e-5, 1.0)));
  CHECK(std::isnan(normal_force(stiffness, 1e-5, nan)));
}

TEST_CASE("normal_force: an elastic impact has the closed form's depth and duration",
          "[force][reference]") {
  const double mass = 600, velocity = 0.4;
  const Impact impact = strike(mass, velocity, {.restitution_force_ratio = 1});
  // Energy: m v^2 / 2 = (2/5) K d^2.5. Duration: (4/5) sqrt(pi) Gamma(2/5) / Gamma(9/10) = 2.9433
  // of d / v.
  const double depth = std::pow(5 * mass * velocity * velocity / (4 * stiffness), 0.4);
  const double factor = 0.8 * std::sqrt(pi<double>()) * std::tgamma(0.4) / std::tgamma(0.9);
  CHECK(factor == Approx(2.94).epsilon(2e-3));
  CHECK(impact.greatest_penetration == Approx(depth).epsilon(1e-8));
  CHECK(impact.duration == Approx(factor * depth / velocity).epsilon(1e-7));
  CHECK(impact.rebound_velocity == Approx(velocity).epsilon(1e-7));
}

TEST_CASE("normal_force: a hard impact rebounds with the root of the force ratio",
          "[force][reference]") {
  const double velocity = 200;
  for (const double ratio : {0.25, 0.75, 0.95}) {
    CAPTURE(ratio);
    const Impact impact = strike(600, velocity, {.restitution_force_ratio = ratio});
    CHECK(impact.rebound_velocity / velocity == Approx(std::sqrt(ratio)).epsilon(1e-5));
  }
  // A soft one loses less.
  const Impact soft = strike(600, 0.02, {});
  CHECK(soft.rebound_velocity / 0.02 > 0.95);
}

TEST_CASE("validate(NormalForceOptions): bad options are named", "[force][bad-input]") {
  using Options = NormalForceOptions<double>;
  CHECK_NOTHROW(validate(Options{}));
  CHECK_NOTHROW(validate(Options{.restitution_force_ratio = 1}));
  CHECK_THROWS_WITH(validate(Options{.restitution_force_ratio = 1.5}),
                    "normal force: restitution force ratio is 1.5, but must be in [0, 1] [-]");
  CHECK_THROWS_WITH(validate(Options{.velocity_tolerance = 0}),
                    "normal force: velocity tolerance is 0, but must be finite and > 0 [m/s]");
  CHECK_THROWS_AS(validate(Options{.restitution_force_ratio = -0.1}), std::invalid_argument);
  CHECK_THROWS_AS(
      validate(Options{.restitution_force_ratio = std::numeric_limits<double>::quiet_NaN()}),
      std::invalid_argument);
}

TEST_CASE("normal_force: any scalar, no allocation", "[force][no-alloc]") {
  for (const double velocity : {-0.2, -0.03, 0.0, 0.08, 3.0}) {
    CAPTURE(velocity);
    const double expected = normal_force(stiffness, 6e-5, velocity);
    CHECK(normal_force(StrictScalar(stiffness), StrictScalar(6e-5), StrictScalar(velocity))
              .as_double() == expected);
    CHECK(static_cast<double>(normal_force(9e10F, 6e-5F, static_cast<float>(velocity))) ==
          Approx(expected).epsilon(1e-6));
    CHECK(static_cast<double>(
              normal_force<long double>(9e10L, 6e-5L, static_cast<long double>(velocity))) ==
          Approx(expected).epsilon(1e-14));
  }
  double sum = 0;
  CHECK(wheelrail_test::allocations_of([&] { sum += normal_force(stiffness, 1e-5, 0.0); }) == 0);
  CHECK(sum > 0);
}
