#include <algorithm>
#include <climits>
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
      const double bound = node.greatest_radius + node.slope * (u - node.centre);
      least = std::min(least, bound - 0.43 - profile.evaluate(u).value);
      CHECK(std::abs(u - node.centre) <= node.half_width * (1 + 1e-12));
    }
  }
  return least;
}

// What the tree promises between two strips of each piece, at random points there.
template <Profile P>
void check_shapes(const P& profile, const StripTree<double>& tree, int samples) {
  std::mt19937 random(2);
  const auto& strips = tree.strips();
  const auto strip = [&](int i) { return strips[static_cast<std::size_t>(i)]; };
  const int count = static_cast<int>(strips.size());
  int checked = 0;
  for (int first = 0; first + 1 < count; ++first) {
    for (const int last : {first + 1, first + 2, first + 9}) {
      if (count <= last || strip(first).piece != strip(last).piece) continue;
      const auto shape = tree.shape_between(first, last);
      const double slack = 1e-9 * shape.second;
      for (int i = 0; i < samples; ++i) {
        const double share = static_cast<double>(random()) / 4294967296.0;
        const double u =
            strip(first).lateral + (strip(last).lateral - strip(first).lateral) * share;
        const auto point = profile.evaluate(strip(first).piece, u);
        CHECK(point.second_derivative <= shape.greatest_second + slack);
        CHECK(point.second_derivative >= shape.least_second - slack);
        CHECK(std::abs(point.second_derivative) <= shape.second + slack);
        CHECK(std::abs(point.slope) <= shape.steepest * (1 + 1e-9));
        CHECK(std::abs(point.slope) >= shape.flattest - 1e-9);
        ++checked;
      }
    }
  }
  CHECK(checked > 100 * samples);
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

TEST_CASE("StripTree: its trees visit each leaf once and skip what they say", "[surface]") {
  const double spacing = GENERATE(1e-3, 1e-4);
  const StripTree<double> tree(s1002<double>(), 0.43, spacing);
  const auto& nodes = tree.nodes();
  int reached = -1;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    CHECK(nodes[i].skip > i);
    CHECK((nodes[i].last == nodes[i].first + 1) == (nodes[i].skip == i + 1));
    const bool is_run = tree.strips()[static_cast<std::size_t>(nodes[i].first)].piece ==
                        tree.strips()[static_cast<std::size_t>(nodes[i].last)].piece;
    CHECK(nodes[i].run_length == (is_run ? nodes[i].last - nodes[i].first : INT_MAX));
    if (nodes[i].skip != i + 1) continue;
    CHECK((nodes[i].first == reached || nodes[i].first == reached + 1));
    reached = nodes[i].last;
  }
  CHECK(reached == static_cast<int>(tree.strips().size()) - 1);
  // From tree to tree: none over more than 16 intervals, or a sixteenth of them.
  const int intervals = static_cast<int>(tree.strips().size()) - s1002<double>().piece_count();
  const int widest = std::max(16, intervals / 16);
  int trees = 0;
  std::size_t root = 0;
  for (; root < nodes.size(); root = nodes[root].skip, ++trees) {
    CHECK(nodes[root].last - nodes[root].first <= widest);
  }
  CHECK(root == nodes.size());
  CHECK(trees * widest >= intervals);
  CHECK(trees < 40);
}

TEST_CASE("StripTree: no profile rises above its nodes' bounds", "[surface][random]") {
  const auto real = s1002<double>();
  const ConvexModification convex(real);
  for (const double spacing : {0.5e-3, 2e-3}) {
    CHECK(least_slack(real, StripTree<double>(real, 0.43, spacing), 50) > -1e-12);
    CHECK(least_slack(convex, StripTree<double>(convex, 0.43, spacing), 50) > -1e-12);
  }
}

TEST_CASE("StripTree: the shape between two strips holds there", "[surface][random]") {
  const auto real = s1002<double>();
  const ConvexModification convex(real);
  check_shapes(real, StripTree<double>(real, 0.43, 0.5e-3), 10);
  check_shapes(convex, StripTree<double>(convex, 0.43, 0.5e-3), 10);
}

TEST_CASE("StripTree: no strip is larger than the greatest radius", "[surface]") {
  const auto profile = s1002<double>();
  const StripTree<double> tree(profile, 0.43, 0.5e-3);
  CHECK(tree.is_proved());
  double greatest = 0;
  for (int i = 0; i <= 20000; ++i) {
    const double u = profile.lower() + (profile.upper() - profile.lower()) * i / 20000;
    greatest = std::max(greatest, 0.43 + profile.evaluate(u).value);
  }
  CHECK(tree.greatest_radius() >= greatest);
  CHECK(tree.greatest_radius() < greatest + 1e-3);
}

TEST_CASE("StripTree: a spacing out of range is named", "[surface][bad-input]") {
  using Catch::Matchers::ContainsSubstring;
  const auto with = [](double spacing) {
    return StripTree<double>(s1002<double>(), 0.43, spacing);
  };
  CHECK_THROWS_WITH(with(0), ContainsSubstring("strip spacing is 0"));
  CHECK_THROWS_WITH(with(-1e-3), ContainsSubstring("strip spacing is -0.001"));
  CHECK_THROWS_WITH(with(std::nan("")), ContainsSubstring("strip spacing"));
  CHECK_THROWS_WITH(with(1e-9), ContainsSubstring("strip spacing is 1e-09"));
}
