// What a search of many placements does in lanes against the same done one by one.

#include <array>
#include <cmath>
#include <random>
#include <wheelrail/contact/detail/first_guess_lanes.hpp>
#include <wheelrail/contact/detail/judge_lanes.hpp>
#include <wheelrail/contact/detail/locus_strips.hpp>
#include <wheelrail/contact/detail/near_run_lanes.hpp>
#include <wheelrail/contact/find_contact_batch.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>

#include "support/catch.hpp"
#include "support/placed.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using detail::lane_count;
using detail::Lanes;

namespace {

using WheelProfile = PiecewiseProfile<double>;

struct Random {
  std::mt19937 bits{29};
  double between(double lower, double upper) {
    return lower + (upper - lower) * (static_cast<double>(bits()) / 4294967296.0);
  }
  int below(int end) { return static_cast<int>(between(0, end)); }
};

// A part of the wheel between two of its strips, the wheel a little in the rail or above it.
struct PartItem {
  WheelPlacement<double> placement;
  int first = 0, last = 0;
  detail::LocusStrip<double> left, right;
};

struct Pair {
  Wheel<WheelProfile> wheel{s1002<double>(), 0.43};
  Rail<RailHead<double>> rail{uic50<double>()};

  [[nodiscard]] PartItem part(Random& random) const {
    const auto& strips = wheel.strips().strips();
    const int end = static_cast<int>(strips.size());
    const auto piece = [&](int strip) { return strips[static_cast<std::size_t>(strip)].piece; };
    PartItem item;
    // Every tenth at a yaw beyond the bounds of the steeper parts.
    const double yaw =
        random.below(10) == 0 ? random.between(-0.5, 0.5) : random.between(-0.05, 0.05);
    item.placement =
        wheelrail_test::placed(random.between(-0.01, 0.03), 0.43, yaw, random.between(-0.07, 0.03));
    do {
      item.first = random.below(end - 1);
      item.last = item.first + 1 + random.below(random.below(2) == 0 ? 3 : 16);
    } while (end <= item.last || piece(item.first) != piece(item.last));
    detail::LocusStrips<WheelProfile, RailHead<double>> at(wheel, rail, item.placement);
    // So that the part is near the rail.
    const auto middle = at.of_wheel(item.first + (item.last - item.first) / 2);
    const double rise = middle.exists ? middle.penetration : 0.0;
    item.placement.position_rail.z() +=
        rise + random.between(-1, 1) * std::exp(random.between(-16.0, -8.0));
    item.left = at.of_wheel(item.first);
    item.right = at.of_wheel(item.last);
    return item;
  }
};

// The same place, but for what fused products and sums round in another way [m].
bool is_near(double one, double other) {
  return std::abs(one - other) <= 1e-9 || (std::isnan(one) && std::isnan(other));
}

}  // namespace

TEST_CASE("PenetrationBoundsLanes: the verdicts of PenetrationBounds", "[contact][random]") {
  const Pair pair;
  Random random;
  const double radius = pair.wheel.strips().greatest_radius(), threshold = -1e-6;
  const detail::PenetrationBoundsLanes<RailHead<double>> bounds(pair.rail, radius, threshold);
  std::array<int, 3> verdicts{};
  int unlike = 0;
  for (int block = 0; block < 2000; ++block) {
    std::array<PartItem, lane_count> parts;
    PlacementBatch<double> placements;
    detail::PlacementLanes<double> at;
    detail::LocusStripLanes<double> left, right;
    detail::ShapeBoundsLanes<double> shape;
    for (int lane = 0; lane < lane_count; ++lane) {
      PartItem& part = parts[static_cast<std::size_t>(lane)];
      part = pair.part(random);
      placements.push_back(part.placement);
      at.set(lane, {placements, static_cast<std::size_t>(lane)});
      left.set(lane, part.left);
      right.set(lane, part.right);
      shape.set(lane, pair.wheel.strips().shape_between(part.first, part.last));
    }
    const auto found = bounds.judge(at, left, right, shape);
    for (int lane = 0; lane < lane_count; ++lane) {
      const PartItem& part = parts[static_cast<std::size_t>(lane)];
      const detail::PenetrationBounds<RailHead<double>> one(pair.rail, radius, part.placement,
                                                            threshold);
      const auto expected =
          one.judge(part.left, part.right, pair.wheel.strips().shape_between(part.first, part.last))
              .verdict;
      ++verdicts[static_cast<std::size_t>(expected)];
      unlike += expected != found.verdict(lane);
    }
  }
  CAPTURE(verdicts[0], verdicts[1], verdicts[2], unlike);
  CHECK(unlike == 0);
  CHECK(verdicts[0] > 3000);
  CHECK(verdicts[1] > 3000);
  CHECK(verdicts[2] > 1000);
}

TEST_CASE("extremum_guess, boundary_guess: in lanes what they are for each", "[contact][random]") {
  Random random;
  int joints = 0, inside = 0;
  for (int block = 0; block < 1000; ++block) {
    detail::LocusStripLanes<double> left, right;
    std::array<detail::LocusStrip<double>, lane_count> lefts, rights;
    Lanes<double> left_is_inside;
    for (int lane = 0; lane < lane_count; ++lane) {
      const auto i = static_cast<std::size_t>(lane);
      const double turn = block % 2 == 0 ? 1 : -1;  // maxima, and minima
      const auto strip = [&](double lateral, double penetration, double slope) {
        detail::LocusStrip<double> result;
        result.wheel_lateral = lateral;
        result.penetration = penetration;
        result.slope = turn * slope;
        result.slope_rate = -turn * std::exp(random.between(-1, 5));
        result.exists = true;
        return result;
      };
      const bool is_first = random.below(2) == 0;
      const double lateral = random.between(-0.02, 0.02), deep = random.between(1e-7, 1e-4);
      const double high = -random.between(1e-7, 1e-4);
      lefts[i] = strip(lateral, is_first ? deep : high, random.between(1e-4, 0.05));
      rights[i] = strip(lateral + random.between(5e-4, 4e-3), is_first ? high : deep,
                        -random.between(1e-4, 0.05));
      left.set(lane, lefts[i]);
      right.set(lane, rights[i]);
      left_is_inside[lane] = is_first ? 1 : 0;
      inside += is_first;
    }
    const Lanes<double> extremum = detail::extremum_guess<double>(left, right, 0.0);
    const Lanes<double> boundary = detail::boundary_guess<double>(left, right, left_is_inside, 0.0);
    for (int lane = 0; lane < lane_count; ++lane) {
      const auto i = static_cast<std::size_t>(lane);
      CAPTURE(block, lane);
      REQUIRE(is_near(extremum[lane], detail::extremum_guess(lefts[i], rights[i], 0.0)));
      REQUIRE(is_near(boundary[lane],
                      detail::boundary_guess(lefts[i], rights[i], 0 < left_is_inside[lane], 0.0)));
      joints += detail::PenetrationCurve<double>(lefts[i], rights[i], 0.0).joint != 1.0;
    }
  }
  CHECK(joints > 1000);
  CHECK(joints < 15000);
  CHECK(inside > 7000);
}

TEST_CASE("near_parts: what near_part leaves off a node's ends, in lanes", "[contact][random]") {
  const Wheel wheel(s1002<double>(), 0.43);
  const auto& tree = wheel.strips();
  Random random;
  int left_off_first = 0, left_off_last = 0, all = 0;
  for (const auto& node : tree.nodes()) {
    if (detail::finest_node < node.run_length) continue;
    Lanes<double> along, across, height;
    for (int lane = 0; lane < lane_count; ++lane) {
      const double angle = random.between(-1.3, 1.3);
      detail::LineAbove<double> line{std::sin(angle), std::cos(angle), 0};
      // As high as the profile somewhere in the node.
      line.height = -(line.depth_at_centre(node) +
                      line.lean(node) * random.between(-1.2, 1.2) * node.half_width);
      along[lane] = line.along_axle;
      across[lane] = line.across_axle;
      height[lane] = line.height;
    }
    const double limit = 1e-9;
    const auto parts =
        detail::near_parts<double>(tree, node, along, across, height, detail::all_lanes(limit));
    for (int lane = 0; lane < lane_count; ++lane) {
      const auto i = static_cast<std::size_t>(lane);
      const detail::LineAbove<double> line{along[lane], across[lane], height[lane]};
      const auto expected = detail::near_part(tree, node, line, limit);
      CAPTURE(node.first, node.last, lane);
      REQUIRE(node.first + parts.left_off_first[i] == expected.first);
      REQUIRE(node.last - parts.left_off_last[i] == expected.last);
      left_off_first += node.first < expected.first;
      left_off_last += expected.last < node.last;
      all += expected.first == expected.last;
    }
  }
  CHECK(left_off_first > 300);
  CHECK(left_off_last > 300);
  CHECK(all > 100);
}

TEST_CASE("find_contacts: with a scalar that converts to nothing", "[contact][scalars]") {
  using wheelrail_test::StrictScalar;
  const Pair pair;
  const Wheel<PiecewiseProfile<StrictScalar>> wheel{s1002<StrictScalar>(), StrictScalar(0.43)};
  const Rail<RailHead<StrictScalar>> rail{uic50<StrictScalar>()};
  PlacementBatch<double> placements;
  PlacementBatch<StrictScalar> strict;
  for (int i = 0; i < 40; ++i) {
    const double lateral = 1e-3 + 2.5e-4 * i, height = 0.42995 + 2e-6 * i;
    placements.push_back(wheelrail_test::placed(lateral, height, 5e-3, 1e-3));
    const auto at = placements.at(static_cast<std::size_t>(i));
    WheelPlacement<StrictScalar> placement;
    placement.position_rail = {StrictScalar(0.0), StrictScalar(at.position_rail.y()),
                               StrictScalar(at.position_rail.z())};
    placement.sin_yaw = StrictScalar(at.sin_yaw);
    placement.cos_yaw = StrictScalar(at.cos_yaw);
    placement.tan_yaw = StrictScalar(at.tan_yaw);
    placement.sin_roll = StrictScalar(at.sin_roll);
    placement.cos_roll = StrictScalar(at.cos_roll);
    strict.push_back(placement);
  }
  const auto expected = find_contacts(pair.wheel, pair.rail, placements);
  const auto found = find_contacts(wheel, rail, strict);
  std::size_t patches = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    REQUIRE(found[i].patches.size() == expected[i].patches.size());
    CHECK(found[i].evaluations == expected[i].evaluations);
    for (std::size_t k = 0; k < expected[i].patches.size(); ++k, ++patches) {
      CHECK(std::abs(found[i].patches[k].penetration.as_double() -
                     expected[i].patches[k].penetration) < 1e-15);
    }
  }
  CHECK(patches > 10);
}

TEST_CASE("bracketed_newton_lanes: each lane takes the steps of bracketed_newton",
          "[contact][random]") {
  // Products and sums are kept apart, so that no compiler fuses them in one of the two only.
  enum class Kind { line, cube, jump, noise };
  Random random;
  int converged = 0, unfinished = 0;
  for (int i = 0; i < 4000; ++i) {
    Lanes<double> root, steepness, lower, upper, start, rising;
    std::array<Kind, lane_count> kinds;
    const double grid = std::pow(10.0, random.between(-9, -2));
    for (int lane = 0; lane < lane_count; ++lane) {
      kinds[static_cast<std::size_t>(lane)] = static_cast<Kind>(random.below(4));
      root[lane] = random.below(4) == 0 ? 0.0 : random.between(-0.05, 0.05);
      steepness[lane] = (random.below(2) == 0 ? -1 : 1) * random.between(0.1, 5);
      lower[lane] = root[lane] - random.between(1e-9, 5e-3);
      upper[lane] = root[lane] + random.between(1e-9, 5e-3);
      start[lane] = random.between(lower[lane], upper[lane]);
      rising[lane] = 0 < steepness[lane] ? 1 : 0;
    }
    const auto value = [&](int lane, double x) -> ValueAndSlope<double> {
      const double distance = x - root[lane], k = steepness[lane];
      switch (kinds[static_cast<std::size_t>(lane)]) {
        case Kind::cube:
          return {k * distance * distance * distance, 3 * k * distance * distance};
        case Kind::jump:
          return {distance < 0 ? -k : k, 3 * k};
        case Kind::noise:
          return {k * distance, std::sin(1e10 * x) < 0 ? -2 * k : 4 * k};
        default:
          return {k * distance, k};
      }
    };
    const RootOptions<double> options{.step_tolerance = std::pow(10.0, random.between(-16, -6)),
                                      .residual_tolerance = 1e-15,
                                      .maximum_iterations = 16,
                                      .grid = grid};
    const auto found = detail::bracketed_newton_lanes<double>(
        [&](const Lanes<double>& x, Lanes<double>& f, Lanes<double>& slope) {
          for (int lane = 0; lane < lane_count; ++lane) {
            const auto at = value(lane, x[lane]);
            f[lane] = at.value;
            slope[lane] = at.slope;
          }
        },
        lower, upper, rising, start, options);
    for (int lane = 0; lane < lane_count; ++lane) {
      const auto alone = bracketed_newton<double>(
          [&](double x) { return value(lane, x); }, lower[lane], upper[lane],
          value(lane, lower[lane]).value, value(lane, upper[lane]).value, start[lane], options);
      CAPTURE(i, lane, grid, root[lane], steepness[lane], start[lane]);
      const bool is_converged = alone.status == SolveStatus::converged;
      CHECK((found.is_converged[lane] != 0) == is_converged);
      CHECK(found.iterations[lane] == alone.iterations);
      if (is_converged) CHECK(found.position[lane] == alone.position);
      ++(is_converged ? converged : unfinished);
    }
  }
  CHECK(converged > 8000);
  CHECK(unfinished > 1000);
}

TEST_CASE("any: whether one lane's flag is set", "[contact]") {
  Lanes<double> flags = Lanes<double>::Zero();
  Lanes<float> short_flags = Lanes<float>::Zero();
  CHECK_FALSE(detail::any<double>(flags));
  CHECK_FALSE(detail::any<float>(short_flags));
  for (int lane = 0; lane < lane_count; ++lane) {
    flags.setZero();
    short_flags.setZero();
    flags[lane] = 1;
    short_flags[lane] = 1;
    CHECK(detail::any<double>(flags));
    CHECK(detail::any<float>(short_flags));
  }
}
