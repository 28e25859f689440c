#include <random>
#include <wheelrail/profile/convex_modification.hpp>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/surface/strip_tree.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

// Every node's promise, at `samples` random points of it: how far it holds at least [m].
template <Profile P>
double least_slack(const P& profile, const StripTree<double>& tree, int samples) {
  std::mt19937 random(1);
  double least = 1;
  for (const auto& node : tree.nodes()) {
    const double lower = tree.strips()[static_cast<std::size_t>(node.first)].lateral;
    const double upper = tree.strips()[static_cast<std::size_t>(node.last)].lateral;
    for (int i = 0; i < samples; ++i) {
      const double u = lower + (upper - lower) * (static_cast<double>(random()) / 4294967296.0);
      const double bound = node.point.value + node.point.slope * (u - node.centre) + node.rise;
      least = std::min(least, bound - profile.evaluate(u).value);
      CHECK(std::abs(u - node.centre) <= node.half_width * (1 + 1e-12));
      const auto point = profile.evaluate(u);
      const auto& shape = node.shape;
      const double slack = 1e-9 * shape.second;
      CHECK(point.second_derivative <= shape.greatest_second + slack);
      CHECK(point.second_derivative >= shape.least_second - slack);
      CHECK(std::abs(point.second_derivative) <= shape.second + slack);
      CHECK(std::abs(point.slope) <= shape.steepest * (1 + 1e-9));
      CHECK(std::abs(point.slope) >= shape.flattest - 1e-9);
    }
  }
  return least;
}

}  // namespace

TEST_CASE("StripTree: strips stand in order, at most the spacing apart, on both sides of a joint",
          "[surface]") {
  const auto profile = s1002<double>();
  const StripTree<double> tree(profile, 0.43, 0.5e-3);
  const auto& strips = tree.strips();
  CHECK(strips.front().lateral == profile.lower());
  CHECK(strips.back().lateral == profile.upper());
  int joints = 0;
  for (std::size_t i = 1; i < strips.size(); ++i) {
    const double gap = strips[i].lateral - strips[i - 1].lateral;
    CHECK(gap <= 0.5e-3 * (1 + 1e-12));
    if (strips[i].piece != strips[i - 1].piece) {
      ++joints;
      CHECK(gap == 0.0);
    } else {
      CHECK(gap > 0);
    }
  }
  CHECK(joints == profile.piece_count() - 1);
}

TEST_CASE("StripTree: preorder visits each leaf once and skips what it says", "[surface]") {
  const StripTree<double> tree(s1002<double>(), 0.43, 1e-3);
  const auto& nodes = tree.nodes();
  int reached = -1;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    CHECK(nodes[i].skip > static_cast<int>(i));
    if (nodes[i].skip != static_cast<int>(i) + 1) continue;
    CHECK(nodes[i].last == nodes[i].first + 1);
    CHECK((nodes[i].first == reached || nodes[i].first == reached + 1));
    reached = nodes[i].last;
  }
  CHECK(reached == static_cast<int>(tree.strips().size()) - 1);
  CHECK(nodes.front().skip == static_cast<int>(nodes.size()));
}

TEST_CASE("StripTree: no profile rises above its nodes' bounds", "[surface][random]") {
  const auto real = s1002<double>();
  const ConvexModification convex(real);
  for (const double spacing : {0.5e-3, 2e-3}) {
    CHECK(least_slack(real, StripTree<double>(real, 0.43, spacing), 50) > -1e-12);
    CHECK(least_slack(convex, StripTree<double>(convex, 0.43, spacing), 50) > -1e-12);
  }
}

TEST_CASE("StripTree: blocks cover every interval once, each in one piece", "[surface]") {
  const auto profile = s1002<double>();
  const StripTree<double> tree(profile, 0.43, 0.5e-3);
  CHECK(tree.is_proved());
  int reached = -1, blocks = 0;
  for (const auto& node : tree.nodes()) {
    if (!node.is_block) continue;
    ++blocks;
    CHECK((node.first == reached || node.first == reached + 1));
    reached = node.last;
    const auto& strips = tree.strips();
    CHECK(strips[static_cast<std::size_t>(node.first)].piece ==
          strips[static_cast<std::size_t>(node.last)].piece);
    CHECK(node.last - node.first <= StripTree<double>::block_strips);
  }
  CHECK(reached == static_cast<int>(tree.strips().size()) - 1);
  CHECK(blocks == tree.block_count());
  CHECK(blocks > profile.piece_count());
  double greatest = 0;
  for (int i = 0; i <= 20000; ++i) {
    const double u = profile.lower() + (profile.upper() - profile.lower()) * i / 20000;
    greatest = std::max(greatest, 0.43 + profile.evaluate(u).value);
  }
  CHECK(tree.greatest_radius() >= greatest);
  CHECK(tree.greatest_radius() < greatest + 1e-3);
}

TEST_CASE("StripTree: a spacing out of range is named", "[surface][bad-input]") {
  using Catch::Matchers::Contains;
  const auto with = [](double spacing) {
    return StripTree<double>(s1002<double>(), 0.43, spacing);
  };
  CHECK_THROWS_WITH(with(0), Contains("strip spacing is 0"));
  CHECK_THROWS_WITH(with(-1e-3), Contains("strip spacing is -0.001"));
  CHECK_THROWS_WITH(with(std::nan("")), Contains("strip spacing"));
  CHECK_THROWS_WITH(with(1e-9), Contains("strip spacing is 1e-09"));
}
