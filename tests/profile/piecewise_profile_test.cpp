#include <array>
#include <limits>
#include <random>
#include <vector>
#include <wheelrail/profile/convex_modification.hpp>
#include <wheelrail/profile/piecewise_profile.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/numeric_difference.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::central_difference;
using wheelrail_test::StrictScalar;
using Piece = ProfilePiece<double>;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Piece polynomial(const std::vector<double>& coefficients, double origin = 0, double scale = 1) {
  return Piece::polynomial(-1, 2, origin, scale, coefficients);
}

// Slope and second derivative of a piece against differences of its value and its slope.
void check_derivatives(const Piece& piece, double h, double tolerance) {
  for (int i = 1; i < 20; ++i) {
    const double x = piece.lower() + (piece.upper() - piece.lower()) * i / 20;
    CAPTURE(x);
    const auto value = [&](double u) { return piece.evaluate(u).value; };
    const auto slope = [&](double u) { return piece.evaluate(u).slope; };
    const auto point = piece.evaluate(x);
    CHECK(point.slope == Approx(central_difference(value, x, h)).epsilon(tolerance).margin(1e-10));
    CHECK(point.second_derivative ==
          Approx(central_difference(slope, x, h)).epsilon(tolerance).margin(1e-10));
  }
}

}  // namespace

TEST_CASE("ProfilePiece::polynomial: value and derivatives of each power", "[profile]") {
  for (int power = 0; power <= Piece::maximum_degree; ++power) {
    CAPTURE(power);
    std::vector<double> coefficients(static_cast<std::size_t>(power + 1), 0.0);
    coefficients.back() = 1;
    const auto piece = polynomial(coefficients);
    for (const double x : {-1.0, -0.3, 0.0, 0.7, 2.0}) {
      const auto point = piece.evaluate(x);
      const double first = power > 0 ? power * std::pow(x, power - 1) : 0;
      const double second = power > 1 ? power * (power - 1) * std::pow(x, power - 2) : 0;
      CHECK(point.value == Approx(std::pow(x, power)).epsilon(1e-15).margin(0));
      CHECK(point.slope == Approx(first).epsilon(1e-15).margin(0));
      CHECK(point.second_derivative == Approx(second).epsilon(1e-15).margin(0));
    }
  }
}

TEST_CASE("ProfilePiece::polynomial: the origin and the scale move and stretch", "[profile]") {
  // ((u - 0.5) / 0.25)^2 = 16 u^2 - 16 u + 4
  const auto piece = polynomial({0, 0, 1}, 0.5, 0.25);
  for (const double u : {-1.0, 0.5, 0.6, 2.0}) {
    const auto point = piece.evaluate(u);
    CHECK(point.value == Approx(16 * u * u - 16 * u + 4).margin(1e-15));
    CHECK(point.slope == Approx(32 * u - 16).margin(1e-15));
    CHECK(point.second_derivative == Approx(32));
  }
}

TEST_CASE("ProfilePiece::polynomial: derivatives agree with differences", "[profile]") {
  check_derivatives(polynomial({0.3, -0.2, 0.5, 0.1, -0.4, 0.2, 0.05, -0.03, 0.01}, 0.4, 1.5), 1e-3,
                    1e-9);
}

TEST_CASE("ProfilePiece::line: straight through its point", "[profile]") {
  const auto piece = Piece::line(-1, 2, 0.5, 3, -2);
  CHECK(piece.lower() == -1);
  CHECK(piece.upper() == 2);
  CHECK(piece.evaluate(0.5).value == 3);
  CHECK(piece.evaluate(2).value == 0);
  CHECK(piece.evaluate(-1).slope == -2);
  CHECK(piece.evaluate(1).second_derivative == 0);
}

TEST_CASE("ProfilePiece::arc: on its circle, square to its radius, of its curvature", "[profile]") {
  for (const bool convex : {true, false}) {
    const auto piece = Piece::arc(0.2, 2.9, 1, 5, 2, convex);
    for (int i = 0; i <= 20; ++i) {
      const double u = 0.2 + 2.7 * i / 20;
      CAPTURE(convex, u);
      const auto point = piece.evaluate(u);
      CHECK(std::hypot(u - 1, point.value - 5) == Approx(2).epsilon(1e-15));
      CHECK((point.value > 5) == convex);
      CHECK((u - 1) + point.slope * (point.value - 5) == Approx(0).margin(1e-14));
      CHECK(curvature(point) == Approx(convex ? 0.5 : -0.5).epsilon(1e-13));
    }
    check_derivatives(piece, 1e-4, 1e-7);
  }
}

TEST_CASE("PiecewiseProfile: pieces in order, at a joint the field side's", "[profile]") {
  const PiecewiseProfile<double> profile({Piece::line(-1, 0, 0, 1, 2), Piece::line(0, 3, 0, 10, 4),
                                          Piece::arc(3, 4, 3.5, 0, 1, true)});
  CHECK(profile.lower() == -1);
  CHECK(profile.upper() == 4);
  REQUIRE(profile.piece_count() == 3);
  const double joints[] = {-1, 0, 3, 4};
  for (int i = 0; i <= 3; ++i) CHECK(profile.joint(i) == joints[i]);
  CHECK(profile.evaluate(-0.5).value == 0);
  CHECK(profile.evaluate(0.0).value == 10);
  CHECK(profile.evaluate(0, 0.0).value == 1);
  CHECK(profile.evaluate(1, 0.0).value == 10);
  CHECK(profile.evaluate(1, 3.0).value == 22);
  CHECK(profile.evaluate(3.0).value == Approx(std::sqrt(0.75)));
  CHECK(profile.evaluate(4.0).slope == Approx(-0.5 / std::sqrt(0.75)));
}

TEST_CASE("ProfilePiece: a bad interval is refused with its numbers", "[profile][bad-input]") {
  CHECK_THROWS_AS(Piece::line(1, 1, 0, 0, 0), std::invalid_argument);
  CHECK_THROWS_WITH(Piece::line(1.5, 1.5, 0, 0, 0),
                    "profile piece: lower end is 1.5, but must be less than its upper end, 1.5 m");
  CHECK_THROWS_WITH(Piece::line(2, 1.5, 0, 0, 0),
                    "profile piece: lower end is 2, but must be less than its upper end, 1.5 m");
  CHECK_THROWS_WITH(Piece::line(not_a_number, 1, 0, 0, 0),
                    "profile piece: lower end is nan, but must be finite");
  CHECK_THROWS_WITH(Piece::line(0, infinity, 0, 0, 0),
                    "profile piece: upper end is inf, but must be finite");
}

TEST_CASE("ProfilePiece::polynomial: bad numbers are refused with name, value and rule",
          "[profile][bad-input]") {
  CHECK_THROWS_WITH(polynomial({1}, 0, 0),
                    "polynomial piece: scale is 0, but must be finite and > 0 [m]");
  CHECK_THROWS_WITH(polynomial({1}, 0, -2),
                    "polynomial piece: scale is -2, but must be finite and > 0 [m]");
  CHECK_THROWS_WITH(polynomial({1}, not_a_number, 1),
                    "polynomial piece: origin is nan, but must be finite");
  CHECK_THROWS_WITH(polynomial({}),
                    "polynomial piece: there are 0 coefficients, but there must be 1 to 9");
  CHECK_THROWS_WITH(polynomial(std::vector<double>(10, 1.0)),
                    "polynomial piece: there are 10 coefficients, but there must be 1 to 9");
  CHECK_NOTHROW(polynomial(std::vector<double>(9, 1.0)));
  CHECK_THROWS_WITH(polynomial({1, 2, infinity}),
                    "polynomial piece: coefficient 2 is inf, but must be finite");
}

TEST_CASE("ProfilePiece::arc: bad numbers are refused with name, value and rule",
          "[profile][bad-input]") {
  CHECK_THROWS_WITH(Piece::arc(0, 1, 0.5, 0, -1, true),
                    "arc piece: radius is -1, but must be finite and > 0 [m]");
  CHECK_THROWS_WITH(Piece::arc(0, 1, 0.5, not_a_number, 1, true),
                    "arc piece: centre value is nan, but must be finite");
  CHECK_THROWS_WITH(
      Piece::arc(-0.5, 1, 0.5, 0, 1, true),
      "arc piece: lower end is -0.5, but must be greater than the centre less the radius [m]");
  CHECK_THROWS_WITH(
      Piece::arc(0, 1.5, 0.5, 0, 1, true),
      "arc piece: upper end is 1.5, but must be less than the centre plus the radius [m]");
  CHECK_THROWS_AS(Piece::arc(0, 1, not_a_number, 0, 1, true), std::invalid_argument);
  CHECK_THROWS_AS(Piece::arc(0, 1, infinity, 0, 1, true), std::invalid_argument);
}

TEST_CASE("PiecewiseProfile: no pieces and gaps are refused with the index",
          "[profile][bad-input]") {
  CHECK_THROWS_WITH(PiecewiseProfile<double>({}), "piecewise profile: there are no pieces");
  const auto first = Piece::line(0, 1, 0, 0, 0);
  const auto second = Piece::line(1, 2, 0, 0, 0);
  CHECK_NOTHROW(PiecewiseProfile<double>({first, second}));
  CHECK_THROWS_AS(PiecewiseProfile<double>({first, first}), std::invalid_argument);
  CHECK_THROWS_WITH(PiecewiseProfile<double>({first, second, Piece::line(2.5, 3, 0, 0, 0)}),
                    "piecewise profile: lower end of piece 2 is 2.5, but must be the upper end of "
                    "piece 1, 2 m");
}

TEST_CASE("PiecewiseProfile: evaluation does not allocate", "[profile][no-alloc]") {
  const PiecewiseProfile<double> profile(
      {Piece::line(-1, 0, 0, 1, 2), Piece::arc(0, 1, 0.5, 0, 1, true),
       Piece::polynomial(1, 2, 1, 1, std::vector<double>{1, 2, 3})});
  double sum = 0;
  CHECK(wheelrail_test::allocations_of([&] {
          for (int i = 0; i < 100; ++i) sum += profile.evaluate(-1 + 0.03 * i).value;
        }) == 0);
  CHECK(sum != 0);
}

TEST_CASE("PiecewiseProfile: bit for bit the same for a scalar that converts to nothing",
          "[profile]") {
  const auto build = []<class T>(T) {
    const auto t = [](double x) { return T(x); };
    const std::array<T, 4> coefficients{t(1), t(-2), t(0.3), t(0.7)};
    return PiecewiseProfile<T>(
        {ProfilePiece<T>::line(t(-1), t(0), t(0), t(1), t(2)),
         ProfilePiece<T>::polynomial(t(0), t(1), t(0.3), t(0.7), coefficients),
         ProfilePiece<T>::arc(t(1), t(2), t(1.3), t(0), t(0.9), false)});
  };
  const auto profile = build(0.0);
  const auto strict = build(StrictScalar(0.0));
  for (int i = 0; i <= 60; ++i) {
    const double x = -1 + 0.05 * i;
    const auto expected = profile.evaluate(x < 2 ? x : 2);
    const auto point = strict.evaluate(StrictScalar(x < 2 ? x : 2));
    CHECK(point.value.as_double() == expected.value);
    CHECK(point.slope.as_double() == expected.slope);
    CHECK(point.second_derivative.as_double() == expected.second_derivative);
  }
}

namespace {

// Whether the bounds over random intervals hold at points of them, and how tight they are at best.
template <class P>
void check_bounds(const P& profile, double widest) {
  std::mt19937 random(3);
  const auto share = [&random] { return static_cast<double>(random()) / 4294967296.0; };
  int tight = 0, intervals = 0;
  for (int piece = 0; piece < profile.piece_count(); ++piece) {
    const double begin = profile.joint(piece), end = profile.joint(piece + 1);
    for (int i = 0; i < 200; ++i) {
      const double width = std::min(widest, end - begin) * share();
      const double lower = begin + (end - begin - width) * share();
      const double upper = std::min(end, lower + width);
      const auto bounds = profile.derivative_bounds(piece, lower, upper);
      const auto curvatures = profile.curvature_bounds(piece, lower, upper);
      double least = 1e300, greatest = -1e300, before = 0;
      for (int k = 0; k <= 20; ++k) {
        const double u = lower + (upper - lower) * k / 20;
        const auto point = profile.evaluate(piece, u);
        const double second = point.second_derivative;
        const double slack = 1e-9 * (1 + std::abs(second));
        REQUIRE(bounds.least_second - slack <= second);
        REQUIRE(second <= bounds.greatest_second + slack);
        REQUIRE(curvatures.least - slack <= curvature(point));
        REQUIRE(curvature(point) <= curvatures.greatest + slack);
        if (k > 0) {
          REQUIRE(std::abs(second - before) <=
                  bounds.greatest_third * (upper - lower) / 20 + slack);
        }
        least = std::min(least, second);
        greatest = std::max(greatest, second);
        before = second;
      }
      ++intervals;
      tight += bounds.greatest_second - bounds.least_second <= 1.5 * (greatest - least) + 1e-6;
    }
  }
  CHECK(2 * tight > intervals);
}

}  // namespace

TEST_CASE("derivative_bounds, curvature_bounds: hold over any interval and are tight",
          "[profile][random]") {
  STATIC_REQUIRE(HasDerivativeBounds<PiecewiseProfile<double>>);
  STATIC_REQUIRE(HasDerivativeBounds<RailHead<double>>);
  STATIC_REQUIRE(HasDerivativeBounds<ConvexModification<PiecewiseProfile<double>>>);
  check_bounds(s1002<double>(), 0.5e-3);
  check_bounds(uic50<double>(), 0.5e-3);
  check_bounds(ConvexModification(s1002<double>()), 0.5e-3);
  // By hand: x^4 over [1, 3] about 2: f'' = 12 (4 + 4 t + t^2), |t| <= 1; f''' = 24 (2 + t).
  const std::array<double, 5> fourth{0, 0, 0, 0, 1};
  const auto piece = ProfilePiece<double>::polynomial(0, 4, 0, 1, fourth);
  const auto bounds = piece.derivative_bounds(1, 3);
  CHECK(bounds.greatest_second == Approx(12 * 9));
  CHECK(bounds.least_second == Approx(12 * -1.0));
  CHECK(bounds.greatest_third == Approx(24 * 3));
}
