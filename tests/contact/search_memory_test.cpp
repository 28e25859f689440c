#include <cmath>
#include <random>
#include <wheelrail/contact/search_memory.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>

#include "support/catch.hpp"
#include "support/placed.hpp"

using namespace wheelrail;
using Catch::Matchers::ContainsSubstring;
using wheelrail_test::placed;

TEST_CASE("SearchMemory: holds for one rail, one threshold and a wheel that moves little",
          "[contact]") {
  const Wheel wheel(s1002<double>(), 0.43);
  const Rail uic(uic50<double>()), other(rail_60e1<double>()), again(uic50<double>());
  SearchMemory<double> memory(wheel);
  const auto here = placed(0, 0.43, 0.01, 0);
  CHECK_FALSE(memory.covers(uic, here, 0));
  memory.restart(uic, here, 0);
  memory.add({});
  CHECK(memory.covers(uic, here, 0));
  CHECK(memory.covers(again, here, 0));
  CHECK_FALSE(memory.covers(other, here, 0));
  CHECK_FALSE(memory.covers(uic, here, 1e-6));
  auto along = here;
  along.position_rail.x() = 3;
  CHECK(memory.covers(uic, along, 0));
  CHECK_FALSE(memory.covers(uic, placed(1.01 * memory.motion().distance, 0.43, 0.01, 0), 0));
  CHECK_FALSE(memory.covers(uic, placed(0, 0.43 - 1.01 * memory.motion().distance, 0.01, 0), 0));
  CHECK(memory.parts().size() == 1);
  CHECK(memory.is_for(wheel));
  CHECK_FALSE(memory.is_for(Wheel(s1002<double>(), 0.43, 1e-3)));
  memory.restart(uic, here, 0);
  CHECK(memory.parts().empty());
}

TEST_CASE("SearchMemory: no point of the wheel moves farther than the skin unnoticed",
          "[contact][random]") {
  const auto profile = s1002<double>();
  const Wheel wheel(profile, 0.43);
  const Rail rail(uic50<double>());
  std::mt19937 random(3);
  const auto between = [&random](double lower, double upper) {
    return lower + (upper - lower) * (static_cast<double>(random()) / 4294967296.0);
  };
  int covered = 0, noticed = 0;
  double farthest = 0;
  for (int i = 0; i < 2000; ++i) {
    SearchMemory<double> memory(wheel, 1e-4);
    const double yaw = between(-0.05, 0.05), roll = between(-0.02, 0.02);
    const auto one = placed(0, 0.43, yaw, roll);
    const auto other = placed(between(-1e-4, 1e-4), 0.43 + between(-1e-4, 1e-4),
                              yaw + between(-1e-4, 1e-4), roll + between(-1e-4, 1e-4));
    memory.restart(rail, one, 0);
    // Circles of the wheel, seen along the rail: their points, turned about the axle so that both
    // circles begin at their lowest point.
    double moved = 0;
    for (int k = 0; k <= 8; ++k) {
      const double u = profile.lower() + (profile.upper() - profile.lower()) * k / 8;
      const double radius = 0.43 + profile.evaluate(u).value;
      for (int angle = 0; angle < 24; ++angle) {
        const double turn = angle * 0.2617993877991494;
        const Vector3<double> point(-radius * std::sin(turn), u, -radius * std::cos(turn));
        const Vector3<double> step = (other.position_rail + other.direction_rail(point)) -
                                     (one.position_rail + one.direction_rail(point));
        moved = std::max(moved, std::hypot(step.y(), step.z()));
      }
    }
    const bool covers = memory.covers(rail, other, 0);
    covered += covers;
    noticed += !covers;
    if (covers) farthest = std::max(farthest, moved);
  }
  CHECK(covered > 100);
  CHECK(noticed > 100);
  CHECK(farthest <= 1e-4);
  CHECK(farthest > 0.5e-4);
}

TEST_CASE("SearchMemory: a skin out of range is named", "[contact][bad-input]") {
  const Wheel wheel(s1002<double>(), 0.43);
  CHECK_THROWS_WITH(SearchMemory<double>(wheel, 0.0),
                    ContainsSubstring("search memory: skin is 0"));
  CHECK_THROWS_WITH(SearchMemory<double>(wheel, std::nan("")),
                    ContainsSubstring("search memory: skin"));
  CHECK_THROWS_WITH(SearchMemory<double>(wheel, 0.01),
                    ContainsSubstring("search memory: skin is 0.01"));
}

TEST_CASE("SearchMemory: allows for less motion where the wheel moves less", "[contact]") {
  const Wheel wheel(s1002<double>(), 0.43);
  const Rail rail(uic50<double>());
  SearchMemory<double> memory(wheel, 1e-4);
  double lateral = 0;
  const auto search = [&](double step) {
    lateral += step;
    const auto here = placed(lateral, 0.43, 0, 0);
    if (!memory.covers(rail, here, 0)) memory.restart(rail, here, 0);
    memory.begin_search(here);
  };
  for (int i = 0; i < 12000; ++i) search(3e-8);
  CHECK(memory.motion().distance == 1e-4 / 32);
  for (int i = 0; i < 100; ++i) search(2e-5);
  CHECK(memory.motion().distance == 1e-4);
}

TEST_CASE("SearchMemory: an extremum is expected where it moves on to", "[contact]") {
  const Wheel wheel(s1002<double>(), 0.43);
  SearchMemory<double> memory(wheel, 1e-4);
  detail::RememberedPart<double> part;
  part.extremum = 0.01;
  memory.begin_search(placed(0, 0.43, 0, 0));
  CHECK(memory.extremum_near(part) == 0.01);
  memory.begin_search(placed(2e-5, 0.43, 0, 0));
  CHECK(memory.extremum_near(part) == 0.01);
  memory.found_extremum(part, 0.01 - 6e-5);
  memory.begin_search(placed(3e-5, 0.43, 0, 0));
  CHECK(memory.extremum_near(part) == Approx(0.01 - 9e-5).epsilon(1e-12));
  memory.found_extremum(part, 0.01 - 8e-5);  // of where it is found, nothing is believed
  memory.begin_search(placed(3e-5, 0.42, 0, 0));
  CHECK(memory.extremum_near(part) == Approx(0.01 - 8e-5).epsilon(1e-12));
  memory.found_extremum(part, 0.02);  // no motion to the side: no rate
  memory.begin_search(placed(4e-5, 0.42, 0, 0));
  CHECK(memory.extremum_near(part) == Approx(0.02 - 2e-5).epsilon(1e-12));
}
