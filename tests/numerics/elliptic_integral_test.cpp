#include <array>
#include <cmath>
#include <limits>
#include <wheelrail/numerics/elliptic_integral.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/numeric_difference.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::StrictScalar;

namespace {

constexpr std::array modulus{0.01, 0.05, 0.2, 0.5, 0.7, 0.9, 0.99, 0.999999, 1.0, 1.1};

// The integrals' definitions, by the trapezoidal rule: of a smooth periodic function, it converges
// exponentially.
CompleteElliptic<long double> by_quadrature(long double g) {
  constexpr int steps = 4000;
  const long double half_pi = pi<long double>() / 2;
  CompleteElliptic<long double> sum;
  for (int i = 0; i <= steps; ++i) {
    const long double angle = half_pi * i / steps;
    const long double s = std::sin(angle) * std::sin(angle);
    const long double c = std::cos(angle) * std::cos(angle);
    const long double root = std::sqrt(c + g * g * s);
    const long double weight = (i == 0 || i == steps ? 0.5L : 1.0L) * half_pi / steps;
    sum.first += weight / root;
    sum.second += weight * root;
    sum.b += weight * c / root;
    sum.c += weight * s * c / (root * root * root);
    sum.d += weight * s / root;
  }
  return sum;
}

}  // namespace

TEST_CASE("complete_elliptic: agrees with the integrals' definitions", "[numerics][reference]") {
  // Of long double where it has more digits than double; the sum of 4000 terms rounds more than it.
  constexpr long double tolerance = 1000 * std::numeric_limits<long double>::epsilon();
  for (const double g : modulus) {
    CAPTURE(g);
    const auto expected = by_quadrature(static_cast<long double>(g));
    const auto found = complete_elliptic(static_cast<long double>(g));
    CHECK(std::abs(found.first / expected.first - 1) < tolerance);
    CHECK(std::abs(found.second / expected.second - 1) < tolerance);
    CHECK(std::abs(found.b / expected.b - 1) < tolerance);
    CHECK(std::abs(found.c / expected.c - 1) < tolerance);
    CHECK(std::abs(found.d / expected.d - 1) < tolerance);
  }
}

TEST_CASE("complete_elliptic: a circle gives pi/4 exactly, and no digits are lost near it",
          "[numerics][reference]") {
  const auto circle = complete_elliptic(1.0);
  CHECK(circle.b == pi<double>() / 4);
  CHECK(circle.c == pi<double>() / 16);
  CHECK(circle.d == pi<double>() / 4);
  for (const double gap : {1e-3, 1e-6, 1e-9, 1e-15}) {
    CAPTURE(gap);
    const double m = gap * (2 - gap);
    const auto near = complete_elliptic(1 - gap);
    // Abramowitz and Stegun 17.3.11 and 17.3.12, term by term.
    const double d = pi<double>() / 4 * (1 + m * (3.0 / 8 + m * (15.0 / 64 + m * 175.0 / 1024)));
    const double b = pi<double>() / 4 * (1 + m * (1.0 / 8 + m * (3.0 / 64 + m * 25.0 / 1024)));
    CHECK(near.d == Approx(d).epsilon(0.2 * m * m * m * m + 1e-15));
    CHECK(near.b == Approx(b).epsilon(0.2 * m * m * m * m + 1e-15));
  }
}

TEST_CASE("complete_elliptic: thin ellipses follow K = ln(4/g), E = 1", "[numerics][reference]") {
  for (const double g : {1e-8, 1e-30, 1e-150, 1e-300}) {
    CAPTURE(g);
    const auto thin = complete_elliptic(g);
    CHECK(thin.first == Approx(std::log(4 / g)).epsilon(1e-13));
    CHECK(thin.second == Approx(1).epsilon(1e-12));
    CHECK(thin.d == Approx(std::log(4 / g) - 1).epsilon(1e-12));
  }
}

TEST_CASE("complete_elliptic: the documented derivatives are its derivatives", "[numerics]") {
  for (const double g : {0.03, 0.4, 0.97, 1.0}) {
    CAPTURE(g);
    const auto slope = [&](auto member) {
      const auto f = [&](double x) { return complete_elliptic(std::exp(x)).*member; };
      return wheelrail_test::central_difference(f, std::log(g), 1e-3);
    };
    const auto at = complete_elliptic(g);
    CHECK(slope(&CompleteElliptic<double>::first) == Approx(-at.b).epsilon(1e-10));
    CHECK(slope(&CompleteElliptic<double>::second) == Approx(g * g * at.d).epsilon(1e-10));
    CHECK(slope(&CompleteElliptic<double>::d) == Approx(at.c - at.d).epsilon(1e-10));
  }
}

TEST_CASE("complete_elliptic: any scalar, no allocation, NaN in gives NaN",
          "[numerics][no-alloc][bad-input]") {
  for (const double g : modulus) {
    CAPTURE(g);
    const auto found = complete_elliptic(g);
    const auto in_float = complete_elliptic(static_cast<float>(g));
    CHECK(static_cast<double>(in_float.d) == Approx(found.d).epsilon(2e-6));
    CHECK(complete_elliptic(StrictScalar(g)).b.as_double() == found.b);
  }
  CHECK(wheelrail_test::allocations_of([] { CHECK(complete_elliptic(0.5).first > 1); }) == 0);
  CHECK(std::isnan(complete_elliptic(std::numeric_limits<double>::quiet_NaN()).first));
}
