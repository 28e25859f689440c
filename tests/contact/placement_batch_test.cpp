// Many placements, each component in an array of its own.

#include <limits>
#include <wheelrail/contact/placement_batch.hpp>

#include "support/catch.hpp"
#include "support/placed.hpp"

using namespace wheelrail;
using wheelrail_test::placed;

namespace {

bool is_same(const WheelPlacement<double>& a, const WheelPlacement<double>& b) {
  return a.side == b.side && a.position_rail == b.position_rail && a.sin_yaw == b.sin_yaw &&
         a.cos_yaw == b.cos_yaw && a.tan_yaw == b.tan_yaw && a.sin_roll == b.sin_roll &&
         a.cos_roll == b.cos_roll && a.inclination == b.inclination;
}

}  // namespace

TEST_CASE("PlacementBatch: gives back what was put there, in its order", "[contact]") {
  PlacementBatch<double> batch;
  CHECK(batch.empty());
  std::vector<WheelPlacement<double>> placements;
  for (int i = 0; i < 37; ++i) {
    placements.push_back(placed(0.001 * i, 0.4 + 0.01 * i, 0.002 * i, -0.003 * i));
    placements.back().side = i % 3 == 0 ? Side::right : Side::left;
    placements.back().position_rail.x() = 0.1 * i;
    placements.back().inclination = 0.05 + 0.001 * i;
    batch.push_back(placements.back());
  }
  REQUIRE(batch.size() == 37);
  for (std::size_t i = 0; i < batch.size(); ++i) {
    CHECK(is_same(batch.at(i), placements[i]));
    CHECK(batch.lateral_rail()[i] == placements[i].position_rail.y());
    CHECK(batch.up_rail()[i] == placements[i].position_rail.z());
    CHECK(batch.sin_yaw()[i] == placements[i].sin_yaw);
    CHECK(batch.cos_yaw()[i] == placements[i].cos_yaw);
    CHECK(batch.tan_yaw()[i] == placements[i].tan_yaw);
    CHECK(batch.sin_roll()[i] == placements[i].sin_roll);
    CHECK(batch.cos_roll()[i] == placements[i].cos_roll);
  }
  CHECK_FALSE(is_same(batch.at(0), placements[1]));
  batch.clear();
  CHECK(batch.empty());
  batch.push_back(placements[5]);
  REQUIRE(batch.size() == 1);
  CHECK(is_same(batch.at(0), placements[5]));
}
