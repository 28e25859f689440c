#include <cmath>
#include <set>
#include <vector>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/spline_profile.hpp>
#include <wheelrail/surface/rail.hpp>
#include <wheelrail/surface/supporting_lines.hpp>

#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::StrictScalar;

namespace {

// All lines of a profile: the whole of it lies under each, but for rounding, and touches it.
template <Profile P>
void check_all_lines(const P& profile) {
  using T = typename P::Scalar;
  const SupportingLines<T> lines(profile);
  std::vector<Vector2<T>> points;
  for (int i = 0; i <= 2000; ++i) {
    const T u = profile.lower() + (profile.upper() - profile.lower()) * (T(i) / 2000);
    points.emplace_back(u, profile.evaluate(u).value);
  }
  std::set<const SupportingLine<T>*> seen;
  T greatest_normal = 0;
  for (int i = -100; i <= 2100; ++i) {
    const T lateral = profile.lower() + (profile.upper() - profile.lower()) * (T(i) / 2000);
    const auto& line = lines.over(lateral);
    greatest_normal = std::max(greatest_normal, std::abs(line.normal.x()));
    if (!seen.insert(&line).second) continue;
    T highest = -1;
    for (const auto& point : points) highest = std::max(highest, T(line.normal.dot(point)));
    CAPTURE(i);
    CHECK(std::abs(line.normal.norm() - 1) < 8 * epsilon<T>());
    // Rounding of arcs of 0.3 m.
    CHECK(highest <= line.height + 2 * epsilon<T>() * T(0.3));
    CHECK(line.height - highest < T(2e-6));
  }
  CHECK(seen.size() == static_cast<std::size_t>(SupportingLines<T>::count));
  CHECK(greatest_normal > T(0.94));  // of a slope of 3
}

// Through points of a head, as far as its corners are no steeper than 8.
template <class T>
SplineProfile<T> spline_of(const RailHead<T>& head) {
  std::vector<T> laterals, values;
  const T end = head.dimensions().width / 2 - T(9e-5);
  for (int i = 0; i <= 400; ++i) {
    const T angle = (T(i) / 200 - 1) * pi<T>() / 2;
    laterals.push_back(end * std::sin(angle));
    values.push_back(head.evaluate(laterals.back()).value);
  }
  return SplineProfile<T>(laterals, values, {.noise = 0});
}

}  // namespace

TEST_CASE("SupportingLines: the whole profile lies under each of them and touches it",
          "[surface]") {
  check_all_lines(uic50<double>());
  check_all_lines(rail_60e1<double>());
  check_all_lines(uic50<float>());
  check_all_lines(spline_of(uic50<double>()));
}

TEST_CASE("SupportingLines: each touches the profile where it is asked for, up to the steepest",
          "[surface]") {
  const auto profile = uic50<double>();
  const SupportingLines<double> lines(profile);
  const SupportingLines<StrictScalar> strict(uic50<StrictScalar>());
  int steep = 0;
  for (int i = 0; i <= 2000; ++i) {
    const double u = profile.lower() + (profile.upper() - profile.lower()) * i / 2000;
    const auto point = profile.evaluate(u);
    const auto& line = lines.over(u);
    const double above = line.height - line.normal.x() * u - line.normal.y() * point.value;
    CAPTURE(u, point.slope);
    CHECK(above > -1e-15);
    if (std::abs(point.slope) < SupportingLines<double>::steepest) {
      // At most half of one of its places away, 0.07 mm, on a radius of 13 mm at least; along the
      // profile that is up to sqrt(10) as far.
      CHECK(above < 0.07e-3 * 0.07e-3 / (2 * 0.013) * 10 * 1.5);
    } else {
      ++steep;
      CHECK(&line == &lines.over(u < 0 ? -1.0 : 1.0));
    }
    if (i % 100 != 0) continue;
    const auto& same = strict.over(StrictScalar(u));
    CHECK(same.height.as_double() == line.height);
    CHECK(same.normal.x().as_double() == line.normal.x());
  }
  CHECK(steep > 20);
}

TEST_CASE("SupportingLines: over_each is over in each lane", "[surface]") {
  const auto profile = uic50<double>();
  const SupportingLines<double> lines(profile);
  detail::Lanes<double> lateral;
  for (int block = 0; block < 100; ++block) {
    for (int lane = 0; lane < detail::lane_count; ++lane) {
      lateral[lane] = -0.04 + 0.08 * (block * detail::lane_count + lane) / 1600;
    }
    lines.over_each(lateral, [&](int lane, const SupportingLine<double>& line) {
      CAPTURE(lateral[lane]);
      CHECK(&line == &lines.over(lateral[lane]));
    });
  }
}

TEST_CASE("Rail: a convex one has supporting lines", "[surface]") {
  const Rail<RailHead<double>> rail(uic50<double>());
  CHECK(rail.is_convex());
  CHECK(std::abs(rail.supporting_lines().over(0.0).height) < 1e-6);
}
