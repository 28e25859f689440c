#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <type_traits>
#include <wheelrail/core/dual.hpp>
#include <wheelrail/core/vector.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

using Number = Dual<double, 2>;
using Twice = Dual<Dual<double, 1>, 1>;
using L = long double;

// A function of two numbers in any scalar, with its domain.
struct Function {
  const char* name;
  Number (*dual)(const Number&, const Number&);
  L (*plain)(L, L);
  double lower, upper;
};

#define BOTH(expression)                           \
  [](const Number& x, const Number& y) -> Number { \
    static_cast<void>(y);                          \
    return expression;                             \
  },                                               \
      [](L x, L y) -> L {                          \
        using namespace std;                       \
        static_cast<void>(y);                      \
        return expression;                         \
      }

const std::array<Function, 18> functions{{
    {"x + y", BOTH(x + y), -2, 2},
    {"x - y", BOTH(x - y), -2, 2},
    {"-x", BOTH(-x), -2, 2},
    {"x y", BOTH(x* y), -2, 2},
    {"x / y", BOTH(x / y), 0.5, 2},
    {"abs", BOTH(abs(x)), -2, 2},
    {"sqrt", BOTH(sqrt(x)), 0.1, 2},
    {"exp", BOTH(exp(x)), -2, 2},
    {"log", BOTH(log(x)), 0.1, 2},
    {"sin", BOTH(sin(x)), -2, 2},
    {"cos", BOTH(cos(x)), -2, 2},
    {"tan", BOTH(tan(x)), -1, 1},
    {"asin", BOTH(asin(x)), -0.9, 0.9},
    {"acos", BOTH(acos(x)), -0.9, 0.9},
    {"atan", BOTH(atan(x)), -2, 2},
    {"atan2", BOTH(atan2(x, y)), -2, 2},
    {"pow", BOTH(pow(x, y)), 0.1, 2},
    {"of itself", BOTH(x* x* x / (x + y)), 0.5, 2},
}};
#undef BOTH

}  // namespace

TEST_CASE("Dual: every function has the derivatives of its differences", "[core][random]") {
  STATIC_REQUIRE(Real<Number>);
  STATIC_REQUIRE(std::is_same_v<ValueOf<Number>, double>);
  STATIC_REQUIRE(std::is_same_v<ValueOf<Twice>, double>);
  STATIC_REQUIRE(ScalarTraits<Number>::lifting_steps == 1);
  STATIC_REQUIRE(ScalarTraits<Twice>::lifting_steps == 2);
  std::mt19937 generator(7);
  for (const Function& f : functions) {
    for (int i = 0; i < 50; ++i) {
      std::uniform_real_distribution<double> between(f.lower, f.upper);
      const double x = between(generator), y = between(generator);
      const Number result = f.dual(Number(x, 0), Number(y, 1));
      const L h = 1e-5L, at_x = static_cast<L>(x), at_y = static_cast<L>(y);
      const auto slope = [&](L dx, L dy) {
        const auto across = [&](L s) { return f.plain(at_x + s * dx, at_y + s * dy); };
        return (8 * (across(h) - across(-h)) - (across(2 * h) - across(-2 * h))) / (12 * h);
      };
      INFO(f.name << " at " << x << ", " << y);
      CHECK(result.value == Approx(static_cast<double>(f.plain(at_x, at_y))).epsilon(1e-14));
      CHECK(result.derivatives[0] ==
            Approx(static_cast<double>(slope(1, 0))).epsilon(1e-9).margin(1e-12));
      CHECK(result.derivatives[1] ==
            Approx(static_cast<double>(slope(0, 1))).epsilon(1e-9).margin(1e-12));
    }
  }
}

TEST_CASE("Dual: compound assignments, also with itself", "[core]") {
  Number x(3.0, 0);
  x *= x;
  CHECK(x.derivatives[0] == 6);
  x -= Number(1.0);
  x += Number(2.0, 1);
  x /= Number(2.0);
  CHECK(x.value == 5);
  CHECK(x.derivatives == std::array<double, 2>{3, 0.5});
}

TEST_CASE("Dual: comparisons are those of the values, NaN included", "[core]") {
  CHECK(Number(1.0, 0) == Number(1.0, 1));
  CHECK(Number(1.0) < Number(2.0));
  const Number nan(std::numeric_limits<double>::quiet_NaN());
  CHECK(!(nan < Number(1.0)));
  CHECK(!(nan == nan));
  CHECK(!is_finite(nan));
  CHECK(is_finite(Number(1.0, 0)));
  CHECK(value_of(detail::max(Number(1.0), Number(2.0, 1))) == 2);
}

TEST_CASE("Dual: of duals has second derivatives", "[core]") {
  // x^3 at 2: 8, 12, 12.
  const Twice x{Dual<double, 1>(2.0, 0), 0};
  const Twice cube = x * x * x;
  CHECK(value_of(cube) == 8);
  CHECK(cube.derivatives[0].value == 12);
  CHECK(cube.derivatives[0].derivatives[0] == 12);
  CHECK(sqrt(x).derivatives[0].derivatives[0] == Approx(-0.25 * std::pow(2.0, -1.5)));
}

TEST_CASE("Dual: Eigen takes it as a scalar", "[core]") {
  const Vector3<Number> a(Number(1.0, 0), Number(2.0), Number(3.0));
  const Vector3<Number> b = a * Number(2.0) + cross(a, Vector3<Number>(Vector3<Number>::UnitY()));
  CHECK(value_of(Number(b.x())) == -1);
  CHECK(b.x().derivatives[0] == 2);
  CHECK(value_of(epsilon<Number>()) == std::numeric_limits<double>::epsilon());
}
