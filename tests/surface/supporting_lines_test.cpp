#include <cmath>
#include <random>
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
  const T middle = (profile.lower() + profile.upper()) / 2;
  const T inside = profile.evaluate(middle).value - (profile.upper() - profile.lower()) / 2;
  const SupportingLine<T>* last = nullptr;
  int different = 0;
  for (int i = 0; i < SupportingLines<T>::count; ++i) {
    // In the middle of the directions of which each has a line.
    const T sine = T(2 * i + 1 - SupportingLines<T>::count) / SupportingLines<T>::count;
    const T cosine = std::sqrt(1 - sine * sine);
    const auto& line = lines.near(middle + sine / 10, inside + cosine / 10);
    if (&line != last) ++different;
    last = &line;
    T highest = -1;
    for (const auto& point : points) highest = std::max(highest, T(line.normal.dot(point)));
    CAPTURE(i);
    CHECK(std::abs(line.normal.norm() - 1) < 8 * epsilon<T>());
    // Rounding of arcs of 0.3 m.
    CHECK(highest <= line.height + 2 * epsilon<T>() * T(0.3));
    CHECK(line.height - highest < T(2e-6));
  }
  CHECK(different == SupportingLines<T>::count);
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

TEST_CASE("SupportingLines: near a point above the rail its height is nearly told",
          "[surface][random]") {
  const auto profile = uic50<double>();
  const SupportingLines<double> lines(profile);
  std::mt19937 random(3);
  const auto between = [&](double lower, double upper) {
    return lower + (upper - lower) * (static_cast<double>(random()) / 4294967296.0);
  };
  for (int i = 0; i < 5000; ++i) {
    const double u = between(profile.lower(), profile.upper());
    const auto point = profile.evaluate(u);
    const auto normal = Rail<RailHead<double>>::normal_rail(point);
    const double height = between(0, 5e-3);
    const double lateral = u + height * normal.y(), up = point.value + height * normal.z();
    const auto& line = lines.near(lateral, up);
    const double above = line.normal.x() * lateral + line.normal.y() * up - line.height;
    // It can tell no more than the distance, and at most a twentieth less.
    CHECK(above <= height + 1e-12);
    CHECK(above >= 0.95 * height - 2e-6);
  }
}

TEST_CASE("SupportingLines: over the flat part, each touches the profile where it is asked for",
          "[surface]") {
  const auto profile = uic50<double>();
  const SupportingLines<double> lines(profile);
  const SupportingLines<StrictScalar> strict(uic50<StrictScalar>());
  int flat = 0;
  for (int i = 0; i <= 2000; ++i) {
    const double u = profile.lower() + (profile.upper() - profile.lower()) * i / 2000;
    const auto point = profile.evaluate(u);
    CHECK(lines.is_flat_at(u) == (std::abs(point.slope) < 0.5));
    if (!lines.is_flat_at(u)) continue;
    ++flat;
    const auto& line = lines.over(u);
    CHECK(std::abs(line.normal.norm() - 1) < 1e-14);
    // At most half of one of its places away, 0.055 mm, on a radius of 13 mm at least.
    const double above = line.height - line.normal.x() * u - line.normal.y() * point.value;
    CHECK(above > -1e-15);
    CHECK(above < 0.055e-3 * 0.055e-3 / (2 * 0.013) * 1.5);
    for (int k = 0; k <= 50; ++k) {
      const double other = profile.lower() + (profile.upper() - profile.lower()) * k / 50;
      CHECK(line.normal.x() * other + line.normal.y() * profile.evaluate(other).value <=
            line.height + 1e-15);
    }
    if (i % 100 != 0) continue;
    const auto& same = strict.over(StrictScalar(u));
    CHECK(same.height.as_double() == line.height);
    CHECK(same.normal.x().as_double() == line.normal.x());
  }
  CHECK(flat > 1200);
  CHECK_FALSE(lines.is_flat_at(-0.034));
  CHECK_FALSE(lines.is_flat_at(0.2));
}

TEST_CASE("SupportingLines: points below the profile's ends, and any scalar", "[surface]") {
  const auto profile = uic50<double>();
  const SupportingLines<double> lines(profile);
  CHECK(lines.near(-1, -1).normal.x() < -0.99);
  CHECK(lines.near(1, -1).normal.x() > 0.99);
  const SupportingLines<StrictScalar> strict(uic50<StrictScalar>());
  for (const double lateral : {-0.05, -0.03, 0.0, 0.01, 0.034, 0.2}) {
    const auto& line = lines.near(lateral, 1e-3);
    const auto& same = strict.near(StrictScalar(lateral), StrictScalar(1e-3));
    CHECK(same.height.as_double() == line.height);
    CHECK(same.normal.x().as_double() == line.normal.x());
  }
}

TEST_CASE("Rail: a convex one has supporting lines", "[surface]") {
  const Rail<RailHead<double>> rail(uic50<double>());
  CHECK(rail.is_convex());
  CHECK(std::abs(rail.supporting_lines().near(0.0, 0.01).height) < 1e-6);
}
