#include <limits>
#include <stdexcept>
#include <wheelrail/core/require.hpp>

#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::StrictScalar;

namespace {
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
}  // namespace

TEST_CASE("require: silent where the rule holds", "[core]") {
  CHECK_NOTHROW(detail::require(true, "a length", 1.0, "> 0 [m]"));
  CHECK_NOTHROW(detail::require(true, "no message"));
  CHECK_NOTHROW(detail::require_finite("a length", -1.0));
  CHECK_NOTHROW(detail::require_positive("a length", 1e-300, "[m]"));
  CHECK_NOTHROW(detail::require_not_negative("a length", 0.0, "[m]"));
  CHECK_NOTHROW(detail::require_not_negative("a length", -0.0, "[m]"));
}

TEST_CASE("require: the message has the name, the value and the broken rule", "[core][bad-input]") {
  CHECK_THROWS_AS(detail::require(false, "x"), std::invalid_argument);
  CHECK_THROWS_WITH(detail::require(false, "a list: there are no pieces"),
                    "a list: there are no pieces");
  CHECK_THROWS_AS(detail::require(false, "a length", 1.0, "> 2 [m]"), std::invalid_argument);
  CHECK_THROWS_WITH(detail::require(false, "a length", 0.125, "> 2 [m]"),
                    "a length is 0.125, but must be > 2 [m]");
  CHECK_THROWS_WITH(detail::require(false, "a length", -1234567.5F, "> 2 [m]"),
                    "a length is -1234567.5, but must be > 2 [m]");
}

TEST_CASE("throw_or_abort: throws what it is told to, with the message", "[core][bad-input]") {
  CHECK_THROWS_AS(detail::throw_or_abort("x"), std::invalid_argument);
  CHECK_THROWS_AS(detail::throw_or_abort<std::runtime_error>("x"), std::runtime_error);
  CHECK_THROWS_WITH(detail::throw_or_abort<std::runtime_error>("a 100% loss"), "a 100% loss");
}

TEST_CASE("require_finite: refuses NaN and both infinities", "[core][bad-input]") {
  CHECK_THROWS_WITH(detail::require_finite("x", not_a_number), "x is nan, but must be finite");
  CHECK_THROWS_WITH(detail::require_finite("x", infinity), "x is inf, but must be finite");
  CHECK_THROWS_WITH(detail::require_finite("x", -infinity), "x is -inf, but must be finite");
}

TEST_CASE("require_positive: refuses zero, less, and what is not finite", "[core][bad-input]") {
  CHECK_THROWS_WITH(detail::require_positive("x", 0.0, "[m]"),
                    "x is 0, but must be finite and > 0 [m]");
  CHECK_THROWS_AS(detail::require_positive("x", -1.0, "[m]"), std::invalid_argument);
  CHECK_THROWS_AS(detail::require_positive("x", not_a_number, "[m]"), std::invalid_argument);
  CHECK_THROWS_AS(detail::require_positive("x", infinity, "[m]"), std::invalid_argument);
}

TEST_CASE("require_not_negative: refuses less than zero and what is not finite",
          "[core][bad-input]") {
  CHECK_THROWS_WITH(detail::require_not_negative("x", -0.5, "[s]"),
                    "x is -0.5, but must be finite and >= 0 [s]");
  CHECK_THROWS_AS(detail::require_not_negative("x", not_a_number, "[s]"), std::invalid_argument);
  CHECK_THROWS_AS(detail::require_not_negative("x", infinity, "[s]"), std::invalid_argument);
}

TEST_CASE("require: a scalar without text is refused without its value", "[core][bad-input]") {
  CHECK_NOTHROW(detail::require_positive("x", StrictScalar(1.0), "[m]"));
  CHECK_THROWS_WITH(detail::require_positive("x", StrictScalar(-1.0), "[m]"),
                    "x is (a value without text), but must be finite and > 0 [m]");
}

TEST_CASE("joined: the parts in their order", "[core]") {
  CHECK(detail::joined({}).empty());
  CHECK(detail::joined({"segment ", std::to_string(7), "", " ends"}) == "segment 7 ends");
}
