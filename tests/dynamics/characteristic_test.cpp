#include <array>
#include <limits>
#include <vector>
#include <wheelrail/dynamics/characteristic.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;

namespace {

using Point = CharacteristicPoint<double>;
using Table = std::vector<Point>;
using C = Characteristic<double>;

const Table staircase{{-0.2, -50}, {0.1, -20}, {0.3, -20}, {0.4, 60}};

}  // namespace

TEST_CASE("Characteristic: a line", "[dynamics][characteristic]") {
  const C spring = C::linear(200.0);
  CHECK(spring.force(-0.5) == -100);
  CHECK(spring.slope(3.0) == 200);
  CHECK(spring.energy(0.1) == Approx(1.0));
  CHECK(spring.energy(-0.1) == Approx(1.0));
  CHECK(spring.argument(50.0) == 0.25);
  CHECK(spring.is_strictly_increasing());
  CHECK(C().force(1.0) == 0);
  CHECK_FALSE(C().is_strictly_increasing());
}

TEST_CASE("Characteristic: a table goes through its rows and straight on beyond them",
          "[dynamics][characteristic]") {
  const C table = C::table(staircase);
  for (const Point& p : staircase) CHECK(table.force(p.x) == Approx(p.force));
  CHECK(table.force(-0.05) == Approx(-35));
  CHECK(table.force(0.2) == -20);
  CHECK(table.force(0.375) == Approx(40));
  CHECK(table.force(-1.2) == Approx(-150));
  CHECK(table.force(0.5) == Approx(140));
  CHECK(table.slope(-1.2) == Approx(100));
  CHECK(table.slope(0.2) == 0);
  CHECK(table.slope(0.4) == Approx(800));
  CHECK_FALSE(table.is_strictly_increasing());
}

TEST_CASE("Characteristic: the energy is zero at zero and the integral of the force",
          "[dynamics][characteristic]") {
  const C table = C::table(staircase);
  CHECK(std::fabs(table.energy(0.0)) < 1e-15);
  // -30 at 0, -20 at 0.1: trapezoids.
  CHECK(table.energy(0.1) == Approx(-2.5));
  CHECK(table.energy(0.3) == Approx(-6.5));
  CHECK(table.energy(0.4) == Approx(-4.5));
  CHECK(table.energy(-0.2) == Approx(8.0));
  for (double x = -0.35; x < 0.6; x += 0.0123) {  // meets no row
    const double h = 1e-5;
    CHECK((table.energy(x + h) - table.energy(x - h)) / (2 * h) ==
          Approx(table.force(x)).margin(1e-6));
  }
}

TEST_CASE("Characteristic: argument inverts the force", "[dynamics][characteristic]") {
  const C table = C::table(Table{{-1, -30}, {0.5, -2}, {0.75, 1}, {3, 100}});
  REQUIRE(table.is_strictly_increasing());
  int rows_met = 0;
  for (double x = -2; x <= 4; x += 0.125) {
    CHECK(table.argument(table.force(x)) == Approx(x).margin(1e-14));
    rows_met += x == -1 || x == 0.5 || x == 0.75 || x == 3;
  }
  CHECK(rows_met == 4);
}

TEST_CASE("Characteristic: an odd table is odd bit for bit, with a dead zone",
          "[dynamics][characteristic][symmetry]") {
  const Table side{{0.025, 0}, {0.03, 600}, {0.035, 1760}, {0.065, 230000}};
  const C stop = C::odd_table(side);
  CHECK(stop.force(0.02) == 0);
  CHECK(stop.force(-0.025) == 0);
  CHECK(stop.energy(0.02) == 0);
  CHECK(stop.energy(-0.03) == Approx(1.5));
  CHECK(stop.force(0.0325) == Approx(1180));
  int loaded = 0;
  for (double x = 0.0001; x < 0.1; x += 0.000777) {
    CHECK(stop.force(-x) == -stop.force(x));
    CHECK(stop.energy(-x) == stop.energy(x));
    loaded += 0 < stop.force(x);
  }
  CHECK(loaded > 50);
  const C through_zero = C::odd_table(Table{{0, 0}, {1, 2}, {2, 10}});
  CHECK(through_zero.force(-1.5) == -6);
  CHECK(through_zero.force(0.5) == 1);
}

TEST_CASE("Characteristic: what is no table is refused with row and values",
          "[dynamics][characteristic][bad-input]") {
  using Catch::Matchers::ContainsSubstring;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(C::linear(-3.0, "primary kz"), ContainsSubstring("primary kz is -3"));
  CHECK_THROWS_WITH(C::table(Table{{1, 1}}, "stop"), ContainsSubstring("stop has 1 rows"));
  CHECK_THROWS_WITH(C::table(Table{{0, 0}, {1, 5}, {1, 7}}, "stop"),
                    ContainsSubstring("stop[2].x is 1") && ContainsSubstring("> stop[1].x, 1"));
  CHECK_THROWS_WITH(
      C::table(Table{{0, 0}, {1, 5}, {2, 4}}, "stop"),
      ContainsSubstring("stop[2].force is 4") && ContainsSubstring(">= stop[1].force, 5"));
  CHECK_THROWS_WITH(C::table(Table{{0, 0}, {1, nan}}), ContainsSubstring("points[1].force is"));
  CHECK_THROWS_WITH(C::table(Table{{nan, 0}, {1, 1}}), ContainsSubstring("points[0].x is"));
  CHECK_THROWS_WITH(C::odd_table(Table{{-1, 0}, {1, 1}}), ContainsSubstring("points[0].x is -1"));
  CHECK_THROWS_WITH(C::odd_table(Table{{1, -1}, {2, 1}}),
                    ContainsSubstring("points[0].force is -1"));
  CHECK_THROWS_WITH(C::odd_table(Table{{0, 1}, {2, 1}}), ContainsSubstring("points[0].force is 1"));
  CHECK_THROWS_WITH(C::odd_table(Table{{0, 0}, {2, 1}, {1, 2}}),
                    ContainsSubstring("points[2].x is 1"));
}

TEST_CASE("Characteristic: queries allocate nothing, NaN comes back",
          "[dynamics][characteristic][no-alloc]") {
  const C table = C::table(staircase);
  CHECK(wheelrail_test::allocations_of(
            [&] { CHECK(table.force(0.35) + table.slope(0.35) + table.energy(0.35) > 0); }) == 0);
  CHECK_FALSE(is_finite(table.force(std::numeric_limits<double>::quiet_NaN())));
}

TEST_CASE("Characteristic: any scalar", "[dynamics][characteristic]") {
  using S = wheelrail_test::StrictScalar;
  const std::array<CharacteristicPoint<S>, 2> rows{{{S(1), S(2)}, {S(2), S(6)}}};
  const auto c = Characteristic<S>::odd_table(rows);
  CHECK(c.force(S(-1.5)).as_double() == -4);
  CHECK(c.energy(S(1)).as_double() == 1);
  CHECK(c.argument(S(4)).as_double() == 1.5);
}
