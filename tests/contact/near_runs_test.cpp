#include <cmath>
#include <random>
#include <wheelrail/contact/detail/near_runs.hpp>
#include <wheelrail/profile/s1002.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

TEST_CASE("near_part: what is left off a node's end stays above the line", "[contact][random]") {
  const auto profile = s1002<double>();
  const Wheel wheel(profile, 0.43);
  const auto& tree = wheel.strips();
  std::mt19937 random(13);
  const auto between = [&random](double lower, double upper) {
    return lower + (upper - lower) * (static_cast<double>(random()) / 4294967296.0);
  };
  int left_off = 0, whole = 0;
  for (const auto& node : tree.nodes()) {
    if (node.last - node.first < node.run_length) continue;
    const int piece = tree.strips()[static_cast<std::size_t>(node.first)].piece;
    for (int i = 0; i < 20; ++i) {
      const double angle = between(-1.3, 1.3);
      detail::LineAbove<double> line{std::sin(angle), std::cos(angle), 0};
      // As high as the profile somewhere in the node.
      const double depth_at = between(-1, 1) * node.half_width;
      line.height = -(line.depth_at_centre(node) + line.lean(node) * depth_at);
      const auto part = detail::near_part(tree, node, line, 0.0);
      REQUIRE((node.first <= part.first && part.first <= part.last && part.last <= node.last));
      REQUIRE((part.first == node.first || part.last == node.last));
      whole += part.first == node.first && part.last == node.last;
      for (int strip = node.first; strip < node.last; ++strip) {
        if (part.first <= strip && strip < part.last) continue;
        ++left_off;
        const auto at = [&](int index) {
          return tree.strips()[static_cast<std::size_t>(index)].lateral;
        };
        for (int k = 0; k <= 8; ++k) {
          const double u = at(strip) + (at(strip + 1) - at(strip)) * k / 8;
          const double radius = 0.43 + profile.evaluate(piece, u).value;
          const double depth = line.height - u * line.along_axle + radius * line.across_axle;
          CAPTURE(node.first, node.last, part.first, part.last, u);
          REQUIRE(depth < 1e-15);
        }
      }
    }
  }
  CHECK(left_off > 1000);
  CHECK(whole > 100);
}
