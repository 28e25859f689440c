#include <algorithm>
#include <cmath>
#include <wheelrail/wheelset/lookup_axis.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

TEST_CASE("LookupAxis: every place is in its interval, bounds and nodes too", "[wheelset]") {
  const auto axis = detail::LookupAxis<double>::of({-0.008, 0.008, 0.25e-3}, "shift", "[m]");
  REQUIRE(axis.intervals() == 64);
  for (int i = 0; i < axis.nodes(); ++i) {
    const auto place = axis.place(axis.node(i));
    CHECK(place.index == std::min(i, 63));
    CHECK(place.fraction == (i == 64 ? 1.0 : 0.0));
  }
  CHECK(detail::LookupAxis<double>::of({0.0, 1.0, 0.3}, "shift", "[m]").intervals() == 4);
  CHECK(axis.place(std::nextafter(0.008, 1.0)).index == -1);
  CHECK(axis.place(std::nextafter(-0.008, -1.0)).index == -1);
}
