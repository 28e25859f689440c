#include <wheelrail/contact/search_memory.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

TEST_CASE("SearchMemory: one entry for each slot, forgotten on another rail", "[contact]") {
  const Wheel wheel(s1002<double>(), 0.43);
  const Rail uic(uic50<double>()), other(rail_60e1<double>()), again(uic50<double>());
  SearchMemory<double> memory(wheel);
  auto& parts = memory.parts(uic);
  REQUIRE(parts.size() == static_cast<std::size_t>(wheel.strips().slot_count()));
  for (const auto& part : parts) {
    CHECK(part.tangent.normal_rail.y() == 0);
    CHECK_FALSE(part.is_open);
  }
  parts[3] = {{Vector2<double>(0, 1), 0.001}, true};
  CHECK(memory.parts(uic)[3].tangent.height == 0.001);
  CHECK(memory.parts(again)[3].is_open);
  CHECK(memory.parts(other)[3].tangent.normal_rail.y() == 0);
  CHECK_FALSE(memory.parts(uic)[3].is_open);
}
