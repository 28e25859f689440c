#include <cmath>
#include <random>
#include <vector>
#include <wheelrail/profile/noise_estimate.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>

#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;

namespace {

struct Points {
  std::vector<double> laterals, values;
  double rms = 0;  // of the noise across the profile
};

// Points at a spacing along the arc, each off by normally distributed noise across and along it.
template <class P>
Points points_of(const P& profile, double lower, double upper, double spacing, double noise,
                 unsigned seed) {
  std::mt19937 engine(seed);
  const auto normal = [&engine] {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(engine()) / 4294967296.0;
    return sum;
  };
  Points points;
  for (double u = lower; u <= upper;) {
    const auto at = profile.evaluate(u);
    const double cosine = 1 / std::sqrt(1 + at.slope * at.slope), sine = at.slope * cosine;
    const double across = noise * normal(), along = noise * normal();
    points.laterals.push_back(u - across * sine + along * cosine);
    points.values.push_back(at.value + across * cosine + along * sine);
    points.rms += across * across;
    u += spacing * cosine;
  }
  points.rms = std::sqrt(points.rms / static_cast<double>(points.laterals.size()));
  return points;
}

}  // namespace

TEST_CASE("estimated_noise: that of sampled profiles, and nearly none without",
          "[profile][random]") {
  for (const double spacing : {1e-4, 5e-4}) {
    for (const double noise : {0.0, 1e-6, 1e-5}) {
      CAPTURE(spacing, noise);
      double wheels = 0, rails = 0;
      constexpr int count = 30;
      for (unsigned seed = 21; seed < 21 + count; ++seed) {
        const Points wheel = points_of(s1002<double>(), -0.062, 0.0595, spacing, noise, seed);
        const Points rail = points_of(rail_60e1<double>(), -0.0359, 0.0359, spacing, noise, seed);
        const double found = estimated_noise(wheel.laterals, wheel.values);
        // Four times what it is off by; the shape itself adds up to tens of nanometres.
        const double doubled = 2 * static_cast<double>(wheel.laterals.size());
        CHECK(std::abs(found - wheel.rms) < 4 * 1.5 / std::sqrt(doubled) * noise + 3e-8);
        wheels += found / count;
        rails += estimated_noise(rail.laterals, rail.values) / count;
      }
      // On the steep parts too, where the noise along the profile moves the values most.
      CHECK(std::abs(wheels - noise) < 0.03 * noise + 3e-8);
      CHECK(std::abs(rails - noise) < 0.03 * noise + 3e-8);
    }
  }
}

TEST_CASE("estimated_noise: spikes and corners count little", "[profile]") {
  Points points = points_of(s1002<double>(), -0.062, 0.0595, 2e-4, 1e-5, 5);
  const double before = estimated_noise(points.laterals, points.values);
  for (std::size_t i = 10; i < points.values.size(); i += 100) points.values[i] += 1e-3;
  CHECK(estimated_noise(points.laterals, points.values) == Approx(before).epsilon(0.1));
}

TEST_CASE("estimated_noise: none of a straight line or of few points; any scalar", "[profile]") {
  std::vector<double> laterals, values, sines;
  std::vector<wheelrail_test::StrictScalar> strict_laterals, strict_sines;
  for (int i = 0; i < 20; ++i) {
    laterals.push_back(1e-3 * i);
    values.push_back(0.3 * laterals.back());
    sines.push_back(1e-5 * std::sin(2.7 * i * i));
    strict_laterals.emplace_back(laterals.back());
    strict_sines.emplace_back(sines.back());
  }
  CHECK(estimated_noise(laterals, values) < 1e-17);
  const double expected = estimated_noise(laterals, sines);
  CHECK(expected > 1e-6);
  CHECK(estimated_noise(strict_laterals, strict_sines).as_double() == expected);
  laterals.resize(7);
  sines.resize(7);
  CHECK(estimated_noise(laterals, sines) == 0);
}
