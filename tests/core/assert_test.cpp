// The assertion of a Release build, whatever the build: the headers that were included before saw
// the other one.
#ifndef NDEBUG
#define NDEBUG
#endif
#include <wheelrail/core/assert.hpp>

#include "support/catch.hpp"

TEST_CASE("WHEELRAIL_ASSERT: evaluates nothing under NDEBUG", "[core]") {
  int evaluations = 0;
  const auto fails = [&evaluations] {
    ++evaluations;
    return false;
  };
  WHEELRAIL_ASSERT(fails());
  CHECK(evaluations == 0);
  CHECK_FALSE(fails());
  CHECK(evaluations == 1);
}

TEST_CASE("WHEELRAIL_ASSERT: one statement, also between if and else", "[core]") {
  int branch = 0;
  for (const bool condition : {true, false}) {
    if (condition)
      WHEELRAIL_ASSERT(condition);
    else
      branch = 2;
  }
  CHECK(branch == 2);
}
