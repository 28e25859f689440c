#include <cmath>
#include <wheelrail/contact/detail/first_guesses.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

detail::LocusStrip<double> strip(double lateral, double penetration, double slope, double rate) {
  detail::LocusStrip<double> result;
  result.wheel_lateral = lateral;
  result.penetration = penetration;
  result.slope = slope;
  result.slope_rate = rate;
  result.exists = true;
  return result;
}

}  // namespace

TEST_CASE("extremum_guess: exact for two parabolas that meet in slope", "[contact]") {
  // p'' is -10 up to 4 mm and -2 from there on.
  const auto behind =
      detail::extremum_guess(strip(0, 0, 0.045, -10), strip(0.01, 9.4e-5, -0.007, -2), 0.0);
  CHECK(behind == Approx(0.0065).epsilon(1e-10));
  // The left one as high above it: p' is 0.03 at first, -0.01 at 4 mm, -0.022 at 10 mm.
  const auto before =
      detail::extremum_guess(strip(0, 0, 0.03, -10), strip(0.01, -5.6e-5, -0.022, -2), 0.0);
  CHECK(before == Approx(0.003).epsilon(1e-10));
}

TEST_CASE("extremum_guess: exact for a cubic, its maximum and its minimum", "[contact]") {
  // p = 0.01 u - u^2 - 30 u^3 over 10 mm: p' = 0 at (sqrt(1 + 0.9) - 1) / 90.
  const auto at = [](double u) {
    return strip(u, 0.01 * u - u * u - 30 * u * u * u, 0.01 - 2 * u - 90 * u * u, -2 - 180 * u);
  };
  const double exact = (std::sqrt(1.9) - 1) / 90;
  CHECK(detail::extremum_guess(at(0), at(0.01), 0.0) == Approx(exact).margin(1e-14));
  CHECK(detail::extremum_guess(at(0.003), at(0.005), 0.0) == Approx(exact).margin(1e-14));
  const double minimum = -(std::sqrt(1.9) + 1) / 90;
  CHECK(detail::extremum_guess(at(-0.03), at(-0.02), 0.0) == Approx(minimum).margin(1e-14));
}

TEST_CASE("extremum_guess: a minimum behind a joint", "[contact]") {
  // p'' is 10 up to 4 mm and 2 from there on.
  const auto from = strip(0, 0, -0.045, 10), to = strip(0.01, -9.4e-5, 0.007, 2);
  CHECK(detail::extremum_guess(from, to, 0.0) == Approx(0.0065).epsilon(1e-10));
}

TEST_CASE("extremum_guess: the secant where the curve behind a joint has none", "[contact]") {
  // As two parabolas, but for 15 um less of a rise: c2^2 < 3 c1 c3 on the right.
  const auto left = strip(0, 0, 0.045, -10), right = strip(0.01, 7.9e-5, -0.007, -2);
  REQUIRE(std::isnan(detail::PenetrationCurve<double>(left, right, 0.0).extremum()));
  CHECK(detail::extremum_guess(left, right, 0.0) == Approx(0.01 * 0.045 / 0.052).epsilon(1e-12));
}

TEST_CASE("boundary_guess: near where two parabolas pass the threshold", "[contact]") {
  // From the top at 3 mm, 44 um lower at 7 mm; p'' is -10 up to 4 mm and -2 from there on.
  const auto top = strip(0.003, 1e-4, 0, -10), outside = strip(0.01, -1e-6, -0.022, -2);
  CHECK(detail::boundary_guess(top, outside, true, 1e-4 - 4.4e-5) == Approx(0.007).margin(2e-6));
  const auto mirrored = strip(-0.01, -1e-6, 0.022, -2), its_top = strip(-0.003, 1e-4, 0, -10);
  CHECK(detail::boundary_guess(mirrored, its_top, false, 1e-4 - 4.4e-5) ==
        Approx(-0.007).margin(2e-6));
}
