#include <complex>
#include <limits>
#include <string>
#include <wheelrail/core/scalar.hpp>

#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::StrictScalar;

TEST_CASE("Real: floating-point types and a scalar that converts to nothing are scalars",
          "[core]") {
  STATIC_REQUIRE(Real<float>);
  STATIC_REQUIRE(Real<double>);
  STATIC_REQUIRE(Real<long double>);
  STATIC_REQUIRE(Real<StrictScalar>);
  STATIC_REQUIRE_FALSE(std::is_convertible_v<StrictScalar, double>);
  STATIC_REQUIRE_FALSE(std::is_convertible_v<double, StrictScalar>);
}

TEST_CASE("Real: integers, complex numbers and strings are none", "[core]") {
  STATIC_REQUIRE_FALSE(Real<int>);
  STATIC_REQUIRE_FALSE(Real<unsigned long>);
  STATIC_REQUIRE_FALSE(Real<bool>);
  STATIC_REQUIRE_FALSE(Real<std::complex<double>>);
  STATIC_REQUIRE_FALSE(Real<std::string>);
}

TEMPLATE_TEST_CASE("epsilon: the rounding unit of the type", "[core]", float, double, long double) {
  STATIC_REQUIRE(epsilon<TestType>() == std::numeric_limits<TestType>::epsilon());
}

TEST_CASE("constant: a literal keeps all the digits of the type", "[core]") {
  STATIC_REQUIRE(constant<double>(0.1L) == 0.1);
  STATIC_REQUIRE(constant<long double>(0.1L) == 0.1L);
  STATIC_REQUIRE(constant<float>(0.1L) == 0.1F);
  STATIC_REQUIRE(constant<StrictScalar>(0.1L).as_double() == 0.1);
}

TEST_CASE("pi: cosine and sine know it", "[core]") {
  CHECK(std::abs(std::sin(pi<double>())) < 1.3e-16);
  CHECK(std::cos(pi<double>()) == -1.0);
  CHECK(pi<float>() == Approx(3.14159265F).epsilon(1e-7));
  CHECK(std::abs(std::sin(pi<long double>())) <= 1.3e-16L);
}

TEMPLATE_TEST_CASE("is_finite: false for NaN and both infinities only", "[core]", float, double,
                   long double) {
  using limits = std::numeric_limits<TestType>;
  CHECK(is_finite(TestType(0)));
  CHECK(is_finite(limits::max()));
  CHECK(is_finite(limits::lowest()));
  CHECK(is_finite(limits::denorm_min()));
  CHECK_FALSE(is_finite(limits::quiet_NaN()));
  CHECK_FALSE(is_finite(limits::infinity()));
  CHECK_FALSE(is_finite(-limits::infinity()));
  CHECK(is_finite(limits::max(), limits::max(), limits::lowest()));
  CHECK_FALSE(is_finite(TestType(1), limits::quiet_NaN(), TestType(1)));
  CHECK_FALSE(is_finite(TestType(1), limits::infinity(), -limits::infinity()));
}

TEST_CASE("min, max, clamp, magnitude, square: as their names say", "[core]") {
  STATIC_REQUIRE(detail::min(1.0, 2.0) == 1.0);
  STATIC_REQUIRE(detail::min(2.0, 1.0) == 1.0);
  STATIC_REQUIRE(detail::max(1.0, 2.0) == 2.0);
  STATIC_REQUIRE(detail::max(2.0, 1.0) == 2.0);
  STATIC_REQUIRE(detail::clamp(-3.0, -1.0, 2.0) == -1.0);
  STATIC_REQUIRE(detail::clamp(3.0, -1.0, 2.0) == 2.0);
  STATIC_REQUIRE(detail::clamp(0.5, -1.0, 2.0) == 0.5);
  STATIC_REQUIRE(detail::magnitude(-3.0) == 3.0);
  STATIC_REQUIRE(detail::magnitude(3.0) == 3.0);
  STATIC_REQUIRE(detail::square(-3.0) == 9.0);
}
