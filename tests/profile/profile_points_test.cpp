#include <algorithm>
#include <limits>
#include <random>
#include <vector>
#include <wheelrail/profile/profile_points.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>

#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using Catch::Matchers::ContainsSubstring;
using wheelrail_test::StrictScalar;

namespace {

using Points = ProfilePoints<double>;
using Findings = std::vector<PointFinding<double>>;

// A profile at equal lateral steps of 0.5 mm or so, clear of its steep ends.
template <Profile P>
Points sampled(const P& profile, double lower, double upper, int steps) {
  Points points;
  for (int i = 0; i <= steps; ++i) {
    const double u = lower + (upper - lower) * i / steps;
    points.lateral.push_back(u);
    points.value.push_back(profile.evaluate(u).value);
  }
  return points;
}

Points wheel_points() {
  return sampled(s1002<double>(), -0.0695, 0.06, 259);
}
Points rail_points() {
  return sampled(rail_60e1<double>(), -0.0358, 0.0358, 143);
}

void insert(Points& points, std::size_t before, double lateral, double value) {
  const auto at = static_cast<std::ptrdiff_t>(before);
  points.lateral.insert(points.lateral.begin() + at, lateral);
  points.value.insert(points.value.begin() + at, value);
}

bool is_function(const Points& points) {
  return points.size() >= 4 && points.value.size() == points.size() &&
         std::adjacent_find(points.lateral.begin(), points.lateral.end(), std::greater_equal<>()) ==
             points.lateral.end();
}

bool same(const Points& a, const Points& b) {
  return a.lateral == b.lateral && a.value == b.value;
}

}  // namespace

TEST_CASE("diagnose_points: nothing on clean profiles, which the repair leaves alone",
          "[profile]") {
  const auto clean = GENERATE(wheel_points(), rail_points());
  CHECK(diagnose_points(clean).empty());
  const auto repair = repair_points(clean);
  CHECK(repair.repaired.empty());
  CHECK(same(repair.points, clean));
}

TEST_CASE("repair_points: duplicates go, the first of them stays", "[profile]") {
  auto points = wheel_points();
  insert(points, 101, points.lateral[100] + 5e-8, points.value[100]);
  insert(points, 101, points.lateral[100], points.value[100]);
  const auto findings = diagnose_points(points);
  REQUIRE(findings.size() == 2);
  CHECK(findings[0].defect == PointDefect::duplicate);
  CHECK(findings[0].index == 101);
  CHECK(findings[0].measure == 0);
  CHECK(findings[1].index == 102);
  CHECK(findings[1].measure == Approx(5e-8));
  CHECK(same(repair_points(points).points, wheel_points()));
}

TEST_CASE("repair_points: single spikes go wherever they stand, also on the steep flange",
          "[profile]") {
  const auto clean = wheel_points();
  for (std::size_t i = 1; i + 1 < clean.size(); ++i) {
    auto points = clean;
    points.value[i] += i % 2 == 0 ? 3e-3 : -3e-3;
    CAPTURE(i);
    const auto repair = repair_points(points);
    REQUIRE(repair.repaired.size() == 1);
    CHECK(repair.repaired[0].defect == PointDefect::spike);
    CHECK(repair.repaired[0].index == i);
    CHECK(repair.repaired[0].measure > 2e-4);
    CHECK(repair.points.size() == clean.size() - 1);
    CHECK(is_function(repair.points));
  }
}

TEST_CASE("diagnose_points: a corner and noise below the spike height are no spikes", "[profile]") {
  Points corner;
  for (int i = 0; i < 40; ++i) {
    corner.lateral.push_back(1e-3 * i);
    corner.value.push_back(i < 20 ? 0 : -1e-3 * (i - 20));
  }
  CHECK(diagnose_points(corner).empty());
  auto points = wheel_points();
  std::mt19937 random(20240501);
  std::normal_distribution<double> noise(0, 1e-5);
  for (double& value : points.value) value += noise(random);
  CHECK(diagnose_points(points).empty());
}

TEST_CASE("repair_points: reversed points are turned round", "[profile]") {
  auto points = rail_points();
  points.value[30] += 1e-9;  // not symmetric
  const auto straight = points;
  std::reverse(points.lateral.begin(), points.lateral.end());
  std::reverse(points.value.begin(), points.value.end());
  const auto repair = repair_points(points);
  REQUIRE(repair.repaired.size() == 1);
  CHECK(repair.repaired[0].defect == PointDefect::reversed);
  CHECK(repair.repaired[0].measure == Approx(-0.0716));
  CHECK(same(repair.points, straight));
}

TEST_CASE("repair_points: overhanging ends and walls are cut", "[profile]") {
  const auto clean = wheel_points();
  auto points = clean;
  // The flange back goes inwards under the first point; the field face goes down and back.
  for (int i = 1; i <= 5; ++i) {
    insert(points, 0, clean.lateral[0] + 1e-4 * i, clean.value[0] - 1e-3 * i);
  }
  const double last = clean.lateral.back(), edge = clean.value.back();
  for (int i = 1; i <= 3; ++i) {
    points.lateral.push_back(last);  // upright: lateral stands
    points.value.push_back(edge - 1e-3 * i);
  }
  points.lateral.push_back(last - 2e-4);
  points.value.push_back(edge - 4e-3);
  const auto repair = repair_points(points);
  REQUIRE(repair.repaired.size() == 9);
  for (const auto& finding : repair.repaired) CHECK(finding.defect == PointDefect::overhang);
  CHECK(repair.repaired[0].index == 0);
  CHECK(repair.repaired[0].measure == Approx(5e-4));
  CHECK(repair.repaired.back().index == points.size() - 1);
  CHECK(repair.repaired.back().measure == Approx(2e-4));
  CHECK(same(repair.points, clean));

  // A face that leans by 0.5 degrees is no overhang, but too steep for a function.
  auto steep = clean;
  for (int i = 1; i <= 3; ++i) {
    steep.lateral.push_back(last + 8e-6 * i);
    steep.value.push_back(edge - 1e-3 * i);
  }
  CHECK(same(repair_points(steep).points, clean));
  CHECK(repair_points(steep).repaired.back().measure == Approx(24e-6));
  CHECK(same(repair_points(steep, {.end_slope = 200}).points, steep));
}

TEST_CASE("repair_points: a contour that goes under the other half is no overhang", "[profile]") {
  auto points = rail_points();
  // A rail with its foot: the contour begins on the field half and comes back under the head.
  for (int i = 0; i <= 50; ++i) insert(points, 0, -0.0358 + 1e-3 * i, -0.1);
  const auto findings = diagnose_points(points, {.gap_ratio = 1000});
  REQUIRE(findings.size() > 40);
  for (const auto& finding : findings) CHECK(finding.defect != PointDefect::overhang);
  CHECK_THROWS_WITH(repair_points(points), ContainsSubstring("(unordered)"));
}

TEST_CASE("repair_points: the points of a zig-zag go, the fewest that will do", "[profile]") {
  const auto clean = wheel_points();
  auto points = clean;
  // One point 0.8 mm ahead on the tread: the one to go, though the step back comes after it.
  points.lateral[200] += 8e-4;
  const auto repair = repair_points(points);
  REQUIRE(repair.repaired.size() == 1);
  CHECK(repair.repaired[0].defect == PointDefect::zig_zag);
  CHECK(repair.repaired[0].index == 200);
  CHECK(repair.repaired[0].measure == Approx(3e-4).epsilon(1e-6));
  CHECK(repair.points.size() == clean.size() - 1);
  CHECK(is_function(repair.points));
}

TEST_CASE("repair_points: refuses what it cannot mend, with index, value and rule",
          "[profile][bad-input]") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto clean = wheel_points();
  {
    auto points = clean;
    points.value[7] = nan;
    points.lateral[9] = -infinity;
    const auto findings = diagnose_points(points);
    REQUIRE(findings.size() == 2);
    CHECK(findings[0].defect == PointDefect::not_finite);
    CHECK(findings[1].index == 9);
    CHECK_THROWS_WITH(repair_points(points),
                      "profile points: point 7 at (-0.066, nan) m: a coordinate is nan, but must "
                      "be finite");
  }
  {
    auto points = clean;
    points.lateral.insert(points.lateral.end(), clean.lateral.begin(), clean.lateral.end());
    points.value.insert(points.value.end(), clean.value.begin(), clean.value.end());
    const auto findings = diagnose_points(points);
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].defect == PointDefect::several_sections);
    CHECK(findings[0].index == clean.size());
    CHECK(findings[0].measure == Approx(0.1295));
    CHECK_THROWS_WITH(repair_points(points), ContainsSubstring("point 260 at (-0.0695, ") &&
                                                 ContainsSubstring("there are several sections"));
  }
  {
    auto points = clean;  // ten points come 20 points too early
    std::rotate(points.lateral.begin() + 150, points.lateral.begin() + 170,
                points.lateral.begin() + 180);
    std::rotate(points.value.begin() + 150, points.value.begin() + 170, points.value.begin() + 180);
    const auto findings = diagnose_points(points);
    REQUIRE(findings.size() == 10);
    for (const auto& finding : findings) CHECK(finding.defect == PointDefect::unordered);
    CHECK(findings[0].index == 150);
    CHECK(findings[0].measure == Approx(10e-3));
    CHECK_THROWS_WITH(repair_points(points),
                      ContainsSubstring("point 150 at (0.0155, ") &&
                          ContainsSubstring("lateral is out of order by 0.01 m, but must be by at "
                                            "most 0.0005 m (unordered)"));
  }
  {
    auto points = clean;
    points.lateral.erase(points.lateral.begin() + 100, points.lateral.begin() + 130);
    points.value.erase(points.value.begin() + 100, points.value.begin() + 130);
    const auto findings = diagnose_points(points);
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].defect == PointDefect::gap);
    CHECK(findings[0].index == 100);
    CHECK(findings[0].measure == Approx(15.5e-3).epsilon(0.01));
    CHECK_THROWS_WITH(repair_points(points), ContainsSubstring("point 100 at ") &&
                                                 ContainsSubstring("20 times the median distance"));
    CHECK(same(repair_points(points, {.gap_ratio = 40}).points, points));
    CHECK(same(repair_points(points, {.gap_length = 16e-3}).points, points));
  }
  {
    CHECK_THROWS_WITH(repair_points(Points{}),
                      "profile points: there are 0 points left, but there must be at least 4");
    CHECK_THROWS_WITH(repair_points(Points{{0, 1e-3, 2e-3}, {0, 0, 0}}),
                      ContainsSubstring("there are 3 points left"));
    CHECK_THROWS_WITH(repair_points(Points{{0, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0}}),
                      ContainsSubstring("there are 1 points left"));
    CHECK_THROWS_WITH(diagnose_points(Points{{0, 1}, {0}}),
                      "profile points: there are 1 values, but must be as many as laterals, 2");
  }
  {
    auto points = clean;
    for (std::size_t i = 2; i + 2 < points.size(); i += 5) points.value[i] += 2e-3;
    CHECK_THROWS_WITH(repair_points(points),
                      ContainsSubstring("of 260 points are spikes or "
                                        "zig-zags, but their share must be"));
    CHECK(is_function(repair_points(points, {.dropped_share = 0.3}).points));
  }
  CHECK_THROWS_AS(repair_points(clean, {.minimum_step = 0}), std::invalid_argument);
  CHECK_THROWS_AS(repair_points(clean, {.spike_height = nan}), std::invalid_argument);
}

TEST_CASE("repair_points: a function or a refusal, whatever random dirt it was given",
          "[profile][random]") {
  std::mt19937 random(7);
  const auto pick = [&random](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  std::uniform_real_distribution<double> dirt(-1e-3, 1e-3);
  int repaired = 0, refused = 0;
  for (int trial = 0; trial < 500; ++trial) {
    auto points = trial % 2 == 0 ? wheel_points() : rail_points();
    for (std::size_t change = 1 + pick(6); change > 0; --change) {
      const std::size_t i = pick(points.size());
      switch (pick(5)) {
        case 0:
          points.value[i] += 4 * dirt(random);
          break;
        case 1:
          points.lateral[i] += dirt(random);
          break;
        case 2:
          insert(points, i, points.lateral[i], points.value[i]);
          break;
        case 3:
          insert(points, 0, points.lateral[0] + 0.1 * std::abs(dirt(random)),
                 points.value[0] - 1e-3);
          break;
        default:
          std::swap(points.lateral[i], points.lateral[pick(points.size())]);
          break;
      }
    }
    try {
      const auto repair = repair_points(points);
      REQUIRE(is_function(repair.points));
      std::size_t gone = 0;
      for (const auto& finding : repair.repaired) {
        REQUIRE(finding.index < points.size());
        gone += finding.defect != PointDefect::reversed;
      }
      REQUIRE(repair.points.size() + gone == points.size());
      ++repaired;
    } catch (const std::invalid_argument&) {
      ++refused;
    }
  }
  CHECK(repaired > 300);
  CHECK(refused > 40);
}

TEST_CASE("repair_points: long inputs in bad order end soon", "[profile]") {
  Points saw;
  for (int i = 0; i < 200000; ++i) {
    saw.lateral.push_back(1e-6 * ((i * 7919) % 200000));
    saw.value.push_back(0);
  }
  CHECK_FALSE(diagnose_points(saw).empty());
  CHECK_THROWS_AS(repair_points(saw), std::invalid_argument);
}

TEST_CASE("repair_points: float, long double, and a scalar that converts to nothing", "[profile]") {
  auto points = wheel_points();
  points.value[50] += 2e-3;
  points.lateral[200] += 8e-4;
  insert(points, 30, points.lateral[30], points.value[30]);
  const auto expected = repair_points(points);
  REQUIRE(expected.repaired.size() == 3);
  const auto as = [&points](auto zero) {
    using T = decltype(zero);
    ProfilePoints<T> other;
    for (const double x : points.lateral) other.lateral.push_back(T(x));
    for (const double x : points.value) other.value.push_back(T(x));
    return other;
  };
  const auto strict = repair_points(as(StrictScalar(0)));
  REQUIRE(strict.points.size() == expected.points.size());
  for (std::size_t i = 0; i < expected.points.size(); ++i) {
    REQUIRE(strict.points.lateral[i].as_double() == expected.points.lateral[i]);
  }
  REQUIRE(strict.repaired.size() == 3);
  CHECK(strict.repaired[1].measure.as_double() == expected.repaired[1].measure);
  CHECK(repair_points(as(0.0F)).points.size() == expected.points.size());
  CHECK(repair_points(as(0.0L)).points.size() == expected.points.size());
}

TEST_CASE("to_string: each defect has its own words", "[profile]") {
  CHECK(std::string(to_string(PointDefect::zig_zag)) == "zig-zag");
  CHECK(std::string(to_string(PointDefect::several_sections)) == "several sections");
  CHECK_FALSE(is_repairable(PointDefect::gap));
  CHECK(is_repairable(PointDefect::overhang));
}
