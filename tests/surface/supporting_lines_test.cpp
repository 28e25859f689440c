#include <random>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/surface/rail.hpp>
#include <wheelrail/surface/supporting_lines.hpp>

#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::StrictScalar;

TEST_CASE("SupportingLines: the whole profile lies under each of them and touches it",
          "[surface]") {
  for (const auto& profile : {uic50<double>(), rail_60e1<double>()}) {
    const SupportingLines<double> lines(profile);
    for (int angle = -89; angle <= 89; ++angle) {
      const double a = angle * pi<double>() / 180;
      const auto& line = lines.near(0.1 * std::sin(a), 0.1 * std::cos(a) - 0.03);
      CHECK(std::abs(line.normal.norm() - 1) < 1e-14);
      double highest = -1;
      for (int i = 0; i <= 5000; ++i) {
        const double u = profile.lower() + (profile.upper() - profile.lower()) * i / 5000;
        const auto point = profile.evaluate(u);
        highest = std::max(highest, line.normal.x() * u + line.normal.y() * point.value);
      }
      CHECK(highest <= line.height + 1e-15);
      CHECK(line.height - highest < 1e-6);
    }
  }
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
