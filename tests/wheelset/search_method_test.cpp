#include <wheelrail/profile/convex_modification.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/track/tangent_track.hpp>
#include <wheelrail/wheelset/search_method.hpp>
#include <wheelrail/wheelset/wheelset.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

TEST_CASE("StripSearch, WarmStripSearch, MinimumDistanceSearch: the functions that they stand for",
          "[wheelset]") {
  const ConvexModification profile(s1002<double>());
  const Wheelset wheelset(profile, 0.43, 1.5);
  const TangentTrack track(uic50<double>());
  const auto at = WheelsetPosition<double>::of(0.001, 0.4297, 0.0, 0.005);
  const auto placement = place_wheel(wheelset, track, Side::left, at);
  const auto& wheel = wheelset.wheel(Side::left);
  const auto& rail = track.rail(Side::left);

  const StripSearch<double> strips{{.penetration_threshold = 20e-6}};
  const auto by_strips = strips(wheel, rail, placement);
  REQUIRE(by_strips.patches.size() == 1);
  const auto all = find_contact(wheel, rail, placement);
  CHECK(by_strips.patches[0].penetration == all.patches[0].penetration);
  CHECK(by_strips.patches[0].zone_lower > all.patches[0].zone_lower);

  const MinimumDistanceSearch<double> minimum_distance{convex_parts(profile), {}};
  const auto by_distance = minimum_distance(wheel, rail, placement);
  REQUIRE(by_distance.patches.size() == 1);
  CHECK(by_distance.patches[0].penetration ==
        Approx(by_strips.patches[0].penetration).margin(1e-14));

  // A wheelset on both rails, moving: each side has a memory of its own, and so has each copy.
  WarmStripSearch<double> warm(wheelset);
  int fewer = 0;
  for (int i = 0; i < 40; ++i) {
    const auto position = WheelsetPosition<double>::of(1e-5 * i, 0.4297, 0.0, 0.005);
    WarmStripSearch<double> copy = warm;
    for (const Side side : sides) {
      const auto where = place_wheel(wheelset, track, side, position);
      const auto cold = find_contact(wheelset.wheel(side), track.rail(side), where);
      for (auto* search : {&copy, &warm}) {
        const auto found = (*search)(wheelset.wheel(side), track.rail(side), where);
        REQUIRE(found.patches.size() == cold.patches.size());
        CHECK(found.patches[0].penetration == cold.patches[0].penetration);
        fewer += found.evaluations < cold.evaluations;
      }
    }
  }
  CHECK(fewer > 100);
}

TEST_CASE("WarmMinimumDistanceSearch: the patches of MinimumDistanceSearch, each side on its own",
          "[wheelset]") {
  const ConvexModification profile(s1002<double>());
  const Wheelset wheelset(profile, 0.43, 1.5);
  const TangentTrack track(uic50<double>());
  const MinimumDistanceSearch<double> cold{convex_parts(profile), {}};
  WarmMinimumDistanceSearch<double> warm(wheelset);
  int fewer = 0;
  for (int i = 0; i < 40; ++i) {
    const auto position = WheelsetPosition<double>::of(1e-5 * i, 0.4297, 0.0, 0.005);
    WarmMinimumDistanceSearch<double> copy = warm;
    for (const Side side : sides) {
      const auto where = place_wheel(wheelset, track, side, position);
      const auto& wheel = wheelset.wheel(side);
      const auto expected = cold(wheel, track.rail(side), where);
      REQUIRE(expected.patches.size() == 1);
      for (auto* search : {&copy, &warm}) {
        const auto found = (*search)(wheel, track.rail(side), where);
        REQUIRE(found.patches.size() == 1);
        CHECK(found.status == SearchStatus::complete);
        CHECK(std::abs(found.patches[0].penetration - expected.patches[0].penetration) < 1e-14);
        CHECK(std::abs(found.patches[0].wheel_lateral - expected.patches[0].wheel_lateral) < 1e-10);
        fewer += 2 * found.evaluations < expected.evaluations;
      }
    }
  }
  CHECK(fewer == 4 * 39);
}
