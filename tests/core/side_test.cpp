#include <string>
#include <wheelrail/core/side.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

TEST_CASE("outboard_sign: left is the track's +y, right its -y", "[core]") {
  STATIC_REQUIRE(outboard_sign<double>(Side::left) == 1.0);
  STATIC_REQUIRE(outboard_sign<double>(Side::right) == -1.0);
  STATIC_REQUIRE(outboard_sign<float>(Side::right) == -1.0F);
}

TEST_CASE("sides: each side stands at its own index", "[core]") {
  STATIC_REQUIRE(sides.size() == 2);
  for (const Side side : sides) CHECK(sides[index_of(side)] == side);
  CHECK(index_of(Side::left) == 0);
}

TEST_CASE("name_of: left and right", "[core]") {
  CHECK(name_of(Side::left) == std::string("left"));
  CHECK(name_of(Side::right) == std::string("right"));
}
