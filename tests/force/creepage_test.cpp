#include <cmath>
#include <limits>
#include <wheelrail/force/creepage.hpp>

#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::StrictScalar;

TEST_CASE("creepage: (71)-(73) at speed", "[force][reference]") {
  const auto xi = creepage(0.02, -0.05, 3.0, 20.0, 20.0);
  CHECK(xi.longitudinal == Approx(1e-3).epsilon(1e-6));
  CHECK(xi.lateral == Approx(-2.5e-3).epsilon(1e-6));
  CHECK(xi.spin == Approx(0.15).epsilon(1e-6));
  // The divisor is sqrt(v^2 + minimum^2): 3-4-5.
  const auto guarded = creepage(1.0, 2.0, 5.0, 4.0, 4.0, {.minimum_speed = 3.0});
  CHECK(guarded.longitudinal == Approx(0.2).epsilon(1e-15));
  CHECK(guarded.lateral == Approx(0.4).epsilon(1e-15));
  CHECK(guarded.spin == Approx(1.0 * 4 / 5).epsilon(1e-15));
}

TEST_CASE("creepage: rolling backwards turns the spin's sign and nothing else",
          "[force][symmetry]") {
  const auto forwards = creepage(0.02, -0.05, 3.0, 20.0, 20.0);
  const auto backwards = creepage(0.02, -0.05, 3.0, -20.0, 20.0);
  CHECK(backwards.longitudinal == forwards.longitudinal);
  CHECK(backwards.lateral == forwards.lateral);
  CHECK(backwards.spin == -forwards.spin);
  CHECK(forwards.spin > 0);
  CHECK(creepage(0.02, -0.05, 3.0, 20.0, -20.0).longitudinal == forwards.longitudinal);
}

TEST_CASE("creepage: finite and smooth through standstill", "[force]") {
  const auto still = creepage(1e-3, -2e-3, 0.5, 0.0, 0.0);
  CHECK(still.longitudinal == Approx(0.1).epsilon(1e-14));
  CHECK(still.lateral == Approx(-0.2).epsilon(1e-14));
  CHECK(still.spin == 0);
  // The spin is odd in the forward speed with one slope through zero.
  const double before = creepage(0.0, 0.0, 0.5, -1e-6, 1e-6).spin;
  const double after = creepage(0.0, 0.0, 0.5, 1e-6, 1e-6).spin;
  CHECK(before == -after);
  CHECK(after == Approx(0.5 / 0.01 * 1e-6 / 0.01).epsilon(1e-7));
}

TEST_CASE("creepage: bad options are named, NaN goes through", "[force][bad-input]") {
  CHECK_NOTHROW(validate(CreepageOptions<double>{}));
  CHECK_THROWS_WITH(validate(CreepageOptions<double>{.minimum_speed = 0}),
                    "creepage: minimum speed is 0, but must be finite and > 0 [m/s]");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(creepage(nan, 0.0, 0.0, 1.0, 1.0).longitudinal));
  CHECK(std::isnan(creepage(0.1, 0.0, 0.0, 1.0, nan).longitudinal));
}

TEST_CASE("creepage: any scalar", "[force]") {
  const auto xi = creepage(0.02, -0.05, 3.0, -0.02, 0.021);
  const auto strict = creepage(StrictScalar(0.02), StrictScalar(-0.05), StrictScalar(3.0),
                               StrictScalar(-0.02), StrictScalar(0.021));
  CHECK(strict.longitudinal.as_double() == xi.longitudinal);
  CHECK(strict.lateral.as_double() == xi.lateral);
  CHECK(strict.spin.as_double() == xi.spin);
  CHECK(static_cast<double>(creepage(0.02F, -0.05F, 3.0F, -0.02F, 0.021F).spin) ==
        Approx(xi.spin).epsilon(1e-6));
  CHECK(static_cast<double>(creepage(0.02L, -0.05L, 3.0L, -0.02L, 0.021L).spin) ==
        Approx(xi.spin).epsilon(1e-15));
}
