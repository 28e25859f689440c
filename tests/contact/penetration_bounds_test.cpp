#include <cmath>
#include <cstdio>
#include <random>
#include <wheelrail/contact/detail/penetration_bounds.hpp>
#include <wheelrail/contact/locus.hpp>
#include <wheelrail/contact/rail_foot.hpp>
#include <wheelrail/contact/search_memory.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>

#include "support/catch.hpp"
#include "support/placed.hpp"

using namespace wheelrail;
using wheelrail_test::placed;

namespace {

// A strip by the public equations alone.
detail::LocusStrip<double> strip_at(const Wheel<PiecewiseProfile<double>>& wheel,
                                    const Rail<RailHead<double>>& rail,
                                    const WheelPlacement<double>& placement, int piece, double u) {
  const auto locus = locus_point(wheel, placement, u, wheel.profile().evaluate(piece, u));
  const auto foot = rail_foot(rail.profile(), locus.lateral, locus.up);
  detail::LocusStrip<double> strip;
  strip.wheel_lateral = u;
  strip.rail_lateral = foot.lateral;
  strip.penetration = foot.penetration;
  strip.slope = -(foot.normal_rail.x() * locus.lateral_rate + foot.normal_rail.y() * locus.up_rate);
  strip.normal_rail = foot.normal_rail;
  strip.exists = locus.exists && rail.profile().lower() < foot.lateral &&
                 foot.lateral < rail.profile().upper();
  return strip;
}

}  // namespace

TEST_CASE("moving: no strip leaves its bounds while the wheel moves", "[contact][random]") {
  const auto profile = s1002<double>();
  const Wheel wheel(profile, 0.43);
  const Rail rail(uic50<double>());
  std::mt19937 random(11);
  const auto between = [&random](double lower, double upper) {
    return lower + (upper - lower) * (static_cast<double>(random()) / 4294967296.0);
  };
  int bounded = 0;
  double penetration_share = 0, slope_share = 0, foot_share = 0, normal_share = 0;
  for (int i = 0; i < 20000; ++i) {
    SearchMemory<double> memory(wheel, between(1e-5, 2e-4));
    const auto& motion = memory.motion();
    const double lateral = between(-0.008, 0.008), up = between(0.4290, 0.4305);
    const double yaw = between(-0.03, 0.03), roll = between(-0.01, 0.01);
    const auto before = placed(lateral, up, yaw, roll);
    // The farthest that the memory covers, in a random direction.
    const double direction[] = {between(-1, 1), between(-1, 1), 2 * between(-1, 1),
                                2 * between(-1, 1)};
    double scale = 4 * motion.distance;
    const auto after = [&] {
      return placed(lateral + scale * direction[0], up + scale * direction[1],
                    yaw + scale * direction[2], roll + scale * direction[3]);
    };
    memory.restart(rail, before, 0);
    while (!memory.covers(rail, after(), 0)) scale *= 0.98;

    const double u = between(-0.036, 0.04), half_width = between(1e-4, 2e-3);
    const int piece = piece_of(profile, u);
    const double lower = std::max(u - half_width, profile.joint(piece));
    const double upper = std::min(u + half_width, profile.joint(piece + 1));
    const auto shape = shape_bounds(profile, piece, lower, upper);
    const detail::PenetrationBounds<RailHead<double>> bounds(rail, wheel.strips().greatest_radius(),
                                                             before, 0.0, motion);
    const auto strip = strip_at(wheel, rail, before, piece, u);
    const auto moving = bounds.moving(strip, shape, motion);
    if (!moving.exists) continue;
    ++bounded;
    const auto moved = strip_at(wheel, rail, after(), piece, u);
    CAPTURE(i, u, lateral, up, yaw, roll, scale);
    const auto share = [](double least, double value, double greatest) {
      return std::abs(2 * value - least - greatest) / (greatest - least);
    };
    const double penetration =
        share(moving.least_penetration(), moved.penetration, moving.greatest_penetration());
    const double slope = share(moving.least_slope(), moved.slope, moving.greatest_slope());
    const double foot = share(moving.least_foot(), moved.rail_lateral, moving.greatest_foot());
    REQUIRE(penetration <= 1);
    REQUIRE(slope <= 1);
    REQUIRE(foot <= 1);
    const double normal =
        (moved.normal_rail - moving.normal_rail).norm() / (moving.normal_change + 1e-15);
    REQUIRE(normal <= 1);
    normal_share = std::max(normal_share, normal);
    penetration_share = std::max(penetration_share, penetration);
    slope_share = std::max(slope_share, slope);
    foot_share = std::max(foot_share, foot);
  }
  CHECK(bounded > 10000);
  // And the bounds are not idle.
  CHECK(penetration_share > 0.8);
  CHECK(slope_share > 0.3);
  CHECK(foot_share > 0.5);
  CHECK(normal_share > 0.5);
}

TEST_CASE("judge: what is simple has one extremum at most, what is excluded does not penetrate",
          "[contact][random]") {
  const auto profile = s1002<double>();
  const Wheel wheel(profile, 0.43);
  const Rail rail(uic50<double>());
  std::mt19937 random(12);
  const auto between = [&random](double lower, double upper) {
    return lower + (upper - lower) * (static_cast<double>(random()) / 4294967296.0);
  };
  int excluded = 0, simple = 0, one_sign = 0, open = 0, open_with_more = 0, far_yawed = 0;
  for (int i = 0; i < 9000; ++i) {
    const double lateral = between(-0.008, 0.008), up = between(0.4290, 0.4305);
    const double greatest_yaw = i < 6000 ? 0.03 : 0.2;
    const double yaw = between(-greatest_yaw, greatest_yaw);
    const auto placement = placed(lateral, up, yaw, between(-0.08, 0.08));
    const detail::PenetrationBounds<RailHead<double>> bounds(rail, wheel.strips().greatest_radius(),
                                                             placement, 0.0);
    const double u = i < 6000 ? between(-0.036, 0.04) : between(-0.05, -0.03);
    const double half_width = between(1e-4, 6e-3);
    const int piece = piece_of(profile, u);
    const double lower = std::max(u - half_width, profile.joint(piece));
    const double upper = std::min(u + half_width, profile.joint(piece + 1));
    const auto left = strip_at(wheel, rail, placement, piece, lower);
    const auto right = strip_at(wheel, rail, placement, piece, upper);
    if (!left.exists || !right.exists) continue;
    const auto shape = shape_bounds(profile, piece, lower, upper);
    const auto judgement = bounds.judge(left, right, shape);
    // Where the bounds of the wheel angle's cosine are not those of one near to 1.
    far_yawed += judgement.verdict != detail::Verdict::open &&
                 0.02 < detail::square(std::tan(yaw) * shape.steepest);
    int changes = 0;
    double deepest = -1, before = left.slope;
    for (int k = 0; k <= 60; ++k) {
      const auto strip = strip_at(wheel, rail, placement, piece, lower + (upper - lower) * k / 60);
      REQUIRE(strip.exists);
      deepest = std::max(deepest, strip.penetration);
      changes += before * strip.slope < 0;
      before = strip.slope;
    }
    CAPTURE(i, lateral, up, lower, upper);
    if (judgement.verdict == detail::Verdict::excluded) {
      ++excluded;
      REQUIRE(deepest < 0);
    } else if (judgement.verdict == detail::Verdict::simple) {
      ++simple;
      one_sign += i < 6000 && 0 < left.slope * right.slope;
      REQUIRE(changes <= 1);
      REQUIRE((changes == 1) == (left.slope * right.slope < 0));
    } else {
      ++open;
      open_with_more += 1 < changes;
    }
  }
  std::printf("judged: excluded %d, simple %d (slopes of one sign %d), open %d (more extrema %d)\n",
              excluded, simple, one_sign, open, open_with_more);
  CHECK(excluded > 500);
  CHECK(simple > 1000);
  CHECK(one_sign > 1860);  // 1,830 without bounds of the slope from both sides
  CHECK(open_with_more > 3);
  CAPTURE(far_yawed);
  CHECK(far_yawed > 20);
}
