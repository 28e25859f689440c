#include <string>
#include <wheelrail/core/solve_status.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

TEST_CASE("name_of: every status has a name of its own", "[core]") {
  CHECK(name_of(SolveStatus::converged) == std::string("converged"));
  CHECK(name_of(SolveStatus::iteration_limit) == std::string("iteration_limit"));
  CHECK(name_of(SolveStatus::no_bracket) == std::string("no_bracket"));
  CHECK(name_of(SolveStatus::not_finite) == std::string("not_finite"));
}

TEST_CASE("name_of: a value outside the enumeration is unknown", "[core][bad-input]") {
  CHECK(name_of(static_cast<SolveStatus>(99)) == std::string("unknown"));
}
