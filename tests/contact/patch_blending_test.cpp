#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <unsupported/Eigen/AutoDiff>
#include <vector>
#include <wheelrail/contact/patch_blending.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/track/tangent_track.hpp>
#include <wheelrail/wheelset/wheelset_forces.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;

namespace {

constexpr std::size_t capacity = ContactResult<double>::maximum_patches;
template <class T>
using Patches = FixedList<Patch<T>, capacity>;
using Random = std::mt19937_64;

// Maxima and the minima between them, as a list of patches.
template <class T = double>
Patches<T> list_of(const std::vector<double>& maxima, const std::vector<double>& minima) {
  Patches<T> patches;
  for (std::size_t i = 0; i < maxima.size(); ++i) {
    Patch<T> patch;
    // Eigen's dual numbers have no value of their own.
    for (T* of : {&patch.wheel_lateral, &patch.rail_lateral, &patch.wheel_angle,
                  &patch.longitudinal, &patch.zone_lower, &patch.zone_upper, &patch.contact_angle,
                  &patch.rolling_radius, &patch.wheel_longitudinal_curvature,
                  &patch.wheel_lateral_curvature, &patch.rail_lateral_curvature}) {
      *of = T(0);
    }
    patch.penetration = T(maxima[i]);
    if (i < minima.size()) patch.penetration_to_next = T(minima[i]);
    REQUIRE(patches.push_back(patch));
  }
  return patches;
}

double uniform(Random& random, double lower, double upper) {
  return std::uniform_real_distribution<double>(lower, upper)(random);
}

// Maxima of 10 to 200 um; between them minima down to 0, or none.
struct Zones {
  std::vector<double> maxima, minima;

  Zones(Random& random, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) maxima.push_back(uniform(random, 10e-6, 200e-6));
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const double part = uniform(random, -0.3, 1.0);
      minima.push_back(std::max(0.0, part) * std::min(maxima[i], maxima[i + 1]));
    }
  }
};

}  // namespace

TEST_CASE("blended_shares: one maximum and those of other zones keep their force to the last bit",
          "[contact]") {
  for (const double share : blended_shares(list_of({}, {}))) CHECK(share == 1);
  for (const double share : blended_shares(list_of({1e-4}, {}))) CHECK(share == 1);
  for (const double share : blended_shares(list_of({1e-4, 3e-6, 2e-4}, {0, 0}))) CHECK(share == 1);
  // A search with a negative threshold finds what does not touch.
  for (const double share : blended_shares(list_of({-1e-6, 3e-6}, {-2e-6}))) CHECK(share == 1);
}

TEST_CASE("blended_shares: two maxima share as the formula says, and never lose force by sinking",
          "[contact][reference]") {
  const double a = 8e-6, b = 1e-6, m_left = 7e-6, m_right = 2e-6;  // amounts [m^1.5]
  const auto depth = [](double amount) { return std::pow(amount, 2.0 / 3.0); };
  const auto shares = blended_shares(list_of({depth(a), depth(3e-6)}, {depth(b)}));
  const double m = m_left + m_right;
  CHECK(shares[0] == Approx(1 - b / a * m_right / m).epsilon(1e-14));
  CHECK(shares[1] == Approx(1 - b / 3e-6 * m_left / m).epsilon(1e-14));
  for (const double higher : {0.0, 1e-6, 20e-6}) {
    double last = 0;
    for (double sunk = 1e-7; sunk < 1e-3; sunk *= 1.01) {
      const double one = sunk, other = sunk + higher, between = std::max(0.0, sunk - 3e-5);
      const auto parts = blended_shares(list_of({one, other}, {between}));
      const double force = parts[0] * std::pow(one, 1.5) + parts[1] * std::pow(other, 1.5);
      REQUIRE(last < force);
      last = force;
    }
  }
}

TEST_CASE("blended_shares: in [0, 1], mirrored with the list, of the sum of maxima less minima",
          "[contact][random]") {
  Random random(20240811);
  int joined = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto count = static_cast<std::size_t>(1 + i % 8);
    Zones zones(random, count);
    const auto shares = blended_shares(list_of(zones.maxima, zones.minima));
    double force = 0, all = 0, less = 0;
    for (std::size_t k = 0; k < count; ++k) {
      REQUIRE((0 <= shares[k] && shares[k] <= 1));
      const double amount = std::pow(zones.maxima[k], 1.5);
      force += shares[k] * amount;
      all += amount;
      if (k + 1 < count) less += std::pow(zones.minima[k], 1.5);
    }
    REQUIRE(force == Approx(all - less).epsilon(1e-12));
    joined += force < 0.9 * all;
    std::reverse(zones.maxima.begin(), zones.maxima.end());
    std::reverse(zones.minima.begin(), zones.minima.end());
    const auto mirrored = blended_shares(list_of(zones.maxima, zones.minima));
    for (std::size_t k = 0; k < count; ++k) {
      REQUIRE(std::abs(mirrored[count - 1 - k] - shares[k]) < 1e-13);
    }
  }
  CHECK(joined > 5000);
}

TEST_CASE("blended_shares: a maximum that vanishes has no share and changes no other",
          "[contact][random]") {
  Random random(7);
  int changed = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto count = static_cast<std::size_t>(1 + i % 7);
    const Zones zones(random, count);
    const auto before = blended_shares(list_of(zones.maxima, zones.minima));
    // Beside maximum k, between it and what bounds it on that side, by ever less above its minimum.
    const auto k = static_cast<std::size_t>(random() % count);
    const bool to_the_left = random() % 2 == 0;
    const double bound =
        to_the_left ? (k > 0 ? zones.minima[k - 1] : 0.0) : (k + 1 < count ? zones.minima[k] : 0.0);
    const double depth = bound + uniform(random, 0.1, 0.9) * (zones.maxima[k] - bound);
    double last = 0;
    for (const double above : {1e-11, 1e-13}) {
      Zones with = zones;
      const auto at = static_cast<std::ptrdiff_t>(k);
      with.maxima.insert(with.maxima.begin() + at + (to_the_left ? 0 : 1), depth + above);
      with.minima.insert(with.minima.begin() + at, depth);
      const auto shares = blended_shares(list_of(with.maxima, with.minima));
      double difference = 0;
      for (std::size_t j = 0; j < count; ++j) {
        const std::size_t now = j + (j > k || (to_the_left && j == k) ? 1 : 0);
        difference = std::max(difference, std::abs(shares[now] - before[j]));
      }
      difference = std::max(difference, shares[k + (to_the_left ? 0 : 1)]);
      if (above > 1e-12) {
        REQUIRE(difference < 0.05);
        changed += difference > 1e-7;
      } else {
        REQUIRE(difference < 0.02 * last);
      }
      last = difference;
    }
  }
  CHECK(changed > 3000);
}

namespace {

// A penetration over a lateral coordinate with up to six waves that come and go: its extrema.
class Landscape {
 public:
  explicit Landscape(Random& random) {
    for (Wave& wave : waves_) {
      wave = {uniform(random, -1, 1), uniform(random, -0.8, 0.8), uniform(random, 0.15, 0.6),
              uniform(random, 0.2, 1.0), uniform(random, 0, 6)};
    }
  }

  [[nodiscard]] Patches<double> at(double time) const {
    // p' has no extremum between zeros of p''; so all zeros of p' are found.
    std::vector<double> parts{-4};
    constexpr int cells = 160;
    double lower = -4, bend = value(2, lower, time);
    for (int i = 1; i <= cells; ++i) {
      const double upper = -4 + 8.0 * i / cells, next = value(2, upper, time);
      if (bend * next < 0) parts.push_back(zero(2, lower, upper, time));
      lower = upper;
      bend = next;
    }
    parts.push_back(4);
    Patches<double> patches;
    double least = 0;
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
      const double before = value(1, parts[i], time), after = value(1, parts[i + 1], time);
      if (!(before * after < 0)) continue;
      const double lateral = zero(1, parts[i], parts[i + 1], time);
      const double depth = value(0, lateral, time);
      if (before < 0) {
        least = depth;
      } else if (depth > 0) {
        if (!patches.empty())
          patches[patches.size() - 1].penetration_to_next = std::max(0.0, least);
        Patch<double> patch;
        patch.wheel_lateral = lateral;
        patch.penetration = depth;
        REQUIRE(patches.push_back(patch));
      }
    }
    return patches;
  }

 private:
  struct Wave {
    double middle, speed, width, height, phase;
  };

  // The penetration or its first or second derivative.
  [[nodiscard]] double value(int order, double lateral, double time) const {
    double sum = order == 0 ? -0.25 : 0.0;
    for (const Wave& wave : waves_) {
      const double x = (lateral - wave.middle - wave.speed * time) / wave.width;
      const double height = wave.height * (1 + 0.5 * std::sin(wave.phase + 2 * time));
      const double bell = height * std::exp(-x * x);
      if (order == 0) sum += bell;
      if (order == 1) sum += -2 * x / wave.width * bell;
      if (order == 2) sum += (4 * x * x - 2) / (wave.width * wave.width) * bell;
    }
    return sum;
  }

  // By regula falsi, which Illinois' halving makes quick.
  [[nodiscard]] double zero(int order, double lower, double upper, double time) const {
    double at_lower = value(order, lower, time), at_upper = value(order, upper, time);
    double middle = lower;
    for (int i = 0; i < 60 && std::abs(upper - lower) > 1e-15; ++i) {
      middle = (lower * at_upper - upper * at_lower) / (at_upper - at_lower);
      const double at_middle = value(order, middle, time);
      if (std::abs(at_middle) < 1e-15) break;
      if (at_middle * at_upper < 0) {
        lower = upper;
        at_lower = at_upper;
      } else {
        at_lower /= 2;
      }
      upper = middle;
      at_upper = at_middle;
    }
    return middle;
  }

  std::array<Wave, 6> waves_;
};

// The greatest change from step to step, and that of the difference quotient, of some numbers.
template <std::size_t N>
struct Roughness {
  std::array<double, N> of_value{}, of_quotient{}, greatest{};
};
template <std::size_t N, class Evaluate>
Roughness<N> roughness(double from, double to, int steps, Evaluate&& evaluate) {
  Roughness<N> result;
  std::array<double, N> last{}, change{};
  for (int i = 0; i <= steps; ++i) {
    const std::array<double, N> now = evaluate(from + (to - from) * i / steps);
    for (std::size_t k = 0; k < N; ++k) {
      const double by = now[k] - last[k];
      result.greatest[k] = std::max(result.greatest[k], std::abs(now[k]));
      if (i > 0) result.of_value[k] = std::max(result.of_value[k], std::abs(by));
      if (i > 1) {
        result.of_quotient[k] =
            std::max(result.of_quotient[k], std::abs(by - change[k]) * steps / std::abs(to - from));
      }
      change[k] = by;
    }
    last = now;
  }
  return result;
}

}  // namespace

TEST_CASE("blended_shares: forces and moments of waves that come, join and go are C1",
          "[contact][random]") {
  Random random(11);
  int jumps = 0;
  std::size_t most = 0;
  for (int i = 0; i < 3; ++i) {
    CAPTURE(i);
    const Landscape landscape(random);
    const auto sums = [&](double time, bool blended) {
      const auto patches = landscape.at(time);
      most = std::max(most, patches.size());
      const auto shares = blended_shares(patches);
      std::array<double, 2> sum{};
      double zone_deepest = 0, zone_lateral = 0;
      for (std::size_t k = 0; k < patches.size(); ++k) {
        const auto& patch = patches[k];
        const double amount = std::pow(patch.penetration, 1.5);
        if (blended) {
          sum[0] += shares[k] * amount;
          sum[1] += shares[k] * amount * patch.wheel_lateral;
        } else {  // (62)
          if (zone_deepest < amount) {
            zone_deepest = amount;
            zone_lateral = patch.wheel_lateral;
          }
          if (patch.penetration_to_next > 0) continue;
          sum[0] += zone_deepest;
          sum[1] += zone_deepest * zone_lateral;
          zone_deepest = 0;
        }
      }
      return sum;
    };
    const auto by_zones = [&](double time) { return sums(time, false); };
    const auto blended = [&](double time) { return sums(time, true); };
    const auto jumping = roughness<2>(0, 3, 500, by_zones);
    const auto still = roughness<2>(0, 3, 2000, by_zones);
    const auto coarse = roughness<2>(0, 3, 500, blended);
    const auto fine = roughness<2>(0, 3, 8000, blended);
    for (std::size_t k = 0; k < 2; ++k) {
      CAPTURE(k, coarse.of_quotient[k], fine.of_quotient[k]);
      jumps += still.of_value[k] > 0.8 * jumping.of_value[k];
      CHECK(fine.of_value[k] < 0.08 * coarse.of_value[k]);
      // Of d^1.5 a quarter is left; of a kink, nearly all.
      CHECK(fine.of_quotient[k] < 0.4 * coarse.of_quotient[k]);
    }
  }
  CHECK(jumps >= 5);
  CHECK(most >= 5);
}

TEST_CASE("blended_shares: exact derivatives, any scalar, no allocation",
          "[contact][autodiff][no-alloc]") {
  using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, 5, 1>>;
  const std::vector<double> maxima{80e-6, 50e-6, 60e-6}, minima{30e-6, 20e-6};
  auto dual = list_of<Dual>(maxima, minima);
  for (int i = 0; i < 3; ++i) dual[static_cast<std::size_t>(i)].penetration.derivatives()(i) = 1;
  for (int i = 0; i < 2; ++i) {
    dual[static_cast<std::size_t>(i)].penetration_to_next.derivatives()(3 + i) = 1;
  }
  const auto exact = blended_shares(dual);
  const double step = 1e-10;
  for (std::size_t i = 0; i < 5; ++i) {
    const auto moved = [&](double by) {
      auto a = maxima, b = minima;
      (i < 3 ? a[i] : b[i - 3]) += by;
      return blended_shares(list_of(a, b));
    };
    const auto after = moved(step), before = moved(-step);
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(exact[k].derivatives()(static_cast<Eigen::Index>(i)) ==
            Approx((after[k] - before[k]) / (2 * step)).epsilon(1e-5).margin(1e-2));
    }
  }
  // Where nothing touches, and where a maximum has vanished, there are no infinite derivatives.
  const auto none = blended_shares(list_of<Dual>({0.0, 1e-6}, {0.0}));
  const auto vanished = blended_shares(list_of<Dual>({3e-6, 1e-6, 1e-6}, {1e-6, 1e-6}));
  for (const auto& shares : {none, vanished}) {
    for (std::size_t k = 0; k < 3; ++k) CHECK(shares[k].derivatives().allFinite());
  }

  using wheelrail_test::StrictScalar;
  const auto list = list_of(maxima, minima);
  const auto strict = blended_shares(list_of<StrictScalar>(maxima, minima));
  std::array<double, capacity> shares{};
  CHECK(wheelrail_test::allocations_of([&] { shares = blended_shares(list); }) == 0);
  for (std::size_t k = 0; k < 3; ++k) CHECK(strict[k].as_double() == shares[k]);
}

TEST_CASE("mean_curvature: exact on an arc, continuous where arcs meet, the curvature where short",
          "[contact][reference]") {
  const auto rail = uic50<double>();
  // The standard's crown of 300 mm meets arcs of 80 mm at 10.0 mm.
  CHECK(mean_curvature(rail, 0.001, 3e-3) == Approx(1 / 0.3).epsilon(1e-10));
  CHECK(mean_curvature(rail, -0.016, 3e-3) == Approx(1 / 0.08).epsilon(1e-10));
  const auto wheel = s1002<double>();
  double last = 0, change = 0, jump = 0, plain = curvature(wheel.evaluate(-0.045));
  for (double u = -0.045; u < 0.04; u += 1e-5) {
    const double mean = mean_curvature(wheel, u, 2e-3);
    if (last != 0) change = std::max(change, std::abs(mean - last));
    jump = std::max(jump, std::abs(curvature(wheel.evaluate(u)) - plain));
    plain = curvature(wheel.evaluate(u));
    last = mean;
  }
  CHECK(jump > 40);
  CHECK(change < 2);
  for (const double u : {-0.03, -0.02, 0.01}) {
    const double exact = curvature(wheel.evaluate(u));
    CHECK(mean_curvature(wheel, u, 1e-5) == Approx(exact).epsilon(1e-3).margin(1e-3));
  }
  CHECK(std::isfinite(mean_curvature(rail, rail.upper(), 3e-3)));
}

namespace {

// S1002 and the UIC50 head.
const auto& arcs() {
  static const Wheelset wheelset(s1002<double>(), 0.43, 1.5);
  return wheelset;
}
const auto& rail_arcs() {
  static const TangentTrack track(uic50<double>());
  return track;
}

// A profile's mean over 1 mm to either side, which has a continuous second derivative, and so has
// what stands here for it: polynomials of degree 5 that share three derivatives where they meet.
PiecewiseProfile<double> smooth(const PiecewiseProfile<double>& profile, double lower,
                                double upper) {
  constexpr double reach = 1e-3, width = 1e-3;
  const auto mean = [&](double u) {
    constexpr int steps = 64;
    double value = 0;
    for (int i = 0; i < steps; ++i) {
      value += profile.evaluate(u + reach * (2 * (i + 0.5) / steps - 1)).value / steps;
    }
    const auto before = profile.evaluate(u - reach), after = profile.evaluate(u + reach);
    return ProfilePoint<double>{value, (after.value - before.value) / (2 * reach),
                                (after.slope - before.slope) / (2 * reach)};
  };
  std::vector<ProfilePiece<double>> pieces;
  const int count = static_cast<int>((upper - lower) / width);
  for (int i = 0; i < count; ++i) {
    const double left = lower + width * i, right = lower + width * (i + 1);
    const auto a = mean(left), b = mean(right);
    const double slope = width * a.slope, bend = width * width / 2 * a.second_derivative;
    // What is left at the right end of value, slope and half the second derivative, over 0..1.
    const double x = b.value - a.value - slope - bend, y = width * b.slope - slope - 2 * bend;
    const double z = width * width / 2 * b.second_derivative - bend;
    const std::array<double, 6> coefficients{
        a.value, slope, bend, 10 * x - 4 * y + z, -15 * x + 7 * y - 2 * z, 6 * x - 3 * y + z};
    pieces.push_back(ProfilePiece<double>::polynomial(left, right, left, width, coefficients));
  }
  return PiecewiseProfile<double>(pieces);
}

// Rolling at 10 m/s with a little lateral velocity.
const WheelsetMotion<double> motion{{10, 0.01, 0}, {0, 10 / 0.43, 0}};

// The wrench while one of shift [m], height [m], roll and yaw [rad] is swept.
using Pose = std::array<double, 4>;
template <class Set, class Track, class Search>
auto wrench_over(const Set& wheelset, const Track& track, const ContactForceModel<double>& model,
                 Search& search, Pose pose, std::size_t swept) {
  return [&, pose, swept](double value) mutable {
    pose[swept] = value;
    const auto at = WheelsetPosition<double>::of(pose[0], pose[1], pose[2], pose[3]);
    const auto forces = wheelset_forces(wheelset, track, at, motion, model, search);
    for (const auto& wheel : forces.wheels) REQUIRE(wheel.status == SearchStatus::complete);
    const auto& f = forces.force_track;
    const auto& m = forces.moment_track;
    return std::array<double, 6>{f.x(), f.y(), f.z(), m.x(), m.y(), m.z()};
  };
}

struct Sweep {
  const char* name;
  Pose pose;
  std::size_t swept;
  double from, to;
};
// The left wheel goes from its tread, over a joint of the rail, to its flange; sinks into three zones;
// and turns.
const Sweep sweeps[] = {{"lateral shift", {0, 0.4297, 0, 0}, 0, 0.0045, 0.0058},
                        {"height", {0.0052, 0, 0, 0}, 1, 0.42985, 0.42967},
                        {"yaw", {0.00525, 0.42971, 0, 0}, 3, 0.009, 0.0125}};
const Sweep smooth_sweeps[] = {{"lateral shift", {0, 0.42975, 0, 0}, 0, 0.0045, 0.0067},
                               {"height", {0.0057, 0, 0, 0}, 1, 0.42995, 0.42965},
                               {"yaw", {0.0057, 0.4297, 0, 0}, 3, 0.01, 0.017}};

}  // namespace

TEST_CASE("find_contact, blended: the zones of the search without, and their maxima",
          "[contact][random]") {
  Random random(99);
  WarmStripSearch<double> warm(arcs(), {.blending_length = 3e-3});
  int single = 0, several = 0, levels = 0;
  for (int i = 0; i < 1500; ++i) {
    // In the flange's fillet and beside it; neighbouring poses for the warm search.
    const auto at = WheelsetPosition<double>::of(
        uniform(random, 0.0, 0.0062), uniform(random, 0.42955, 0.42985),
        uniform(random, -1e-4, 1e-4), uniform(random, -0.02, 0.02));
    for (const Side side : sides) {
      const auto& wheel = arcs().wheel(side);
      const auto& rail = rail_arcs().rail(side);
      const auto placement = place_wheel(arcs(), rail_arcs(), side, at);
      const auto plain = find_contact(wheel, rail, placement);
      const auto blended = find_contact(wheel, rail, placement, {.blending_length = 3e-3});
      REQUIRE(blended.status == plain.status);
      REQUIRE(blended.is_proved == plain.is_proved);
      const auto again = warm(wheel, rail, placement).patches;
      const auto& patches = blended.patches;
      REQUIRE(again.size() == patches.size());
      std::size_t first = 0;
      for (const auto& zone : plain.patches) {
        REQUIRE((zone.share == 1 && zone.penetration_to_next == 0));
        std::size_t deepest = first, last = first;
        for (;; ++last) {
          REQUIRE(last < patches.size());
          if (patches[deepest].penetration < patches[last].penetration) deepest = last;
          if (patches[last].penetration_to_next == 0) break;
          REQUIRE(patches[last].penetration_to_next < patches[last].penetration);
          REQUIRE(patches[last].zone_upper == patches[last + 1].zone_lower);
        }
        // The same patch to the last bit but for its curvatures.
        const auto& patch = patches[deepest];
        REQUIRE(patch.wheel_lateral == zone.wheel_lateral);
        REQUIRE(patch.rail_lateral == zone.rail_lateral);
        REQUIRE(patch.penetration == zone.penetration);
        REQUIRE(patch.position_rail == zone.position_rail);
        REQUIRE(patch.normal_rail == zone.normal_rail);
        REQUIRE(patches[first].zone_lower == zone.zone_lower);
        REQUIRE(patches[last].zone_upper == zone.zone_upper);
        REQUIRE((patches[first].zone_is_cut || patches[last].zone_is_cut) == zone.zone_is_cut);
        REQUIRE((first == last) == (patch.share == 1));
        ++(first == last ? single : several);
        first = last + 1;
      }
      REQUIRE(first == patches.size());
      for (std::size_t k = 0; k < patches.size(); ++k) {
        REQUIRE(again[k].penetration == patches[k].penetration);
        REQUIRE(again[k].penetration_to_next == patches[k].penetration_to_next);
        REQUIRE(again[k].wheel_lateral == patches[k].wheel_lateral);
        REQUIRE(again[k].share == patches[k].share);
        REQUIRE(again[k].zone_upper == patches[k].zone_upper);
      }
      // Maxima less minima above a level are the pieces of the zones there: those of a search with
      // that threshold.
      if (patches.size() < 2) continue;
      for (const double part : {0.1, 0.4, 0.7}) {
        const double level = part * patches[0].penetration;
        int pieces = 0;
        for (const auto& patch : patches) {
          pieces += level < patch.penetration;
          pieces -= level < patch.penetration_to_next;
        }
        const auto above = find_contact(wheel, rail, placement, {.penetration_threshold = level});
        REQUIRE(static_cast<int>(above.patches.size()) == pieces);
        levels += pieces > static_cast<int>(plain.patches.size());
      }
    }
  }
  CHECK(single > 1000);
  CHECK(several > 300);
  CHECK(levels > 100);
}

TEST_CASE("find_contact, blended: a mirrored pose has the mirrored wrench, bit for bit",
          "[contact][symmetry]") {
  const ContactForceModel<double> model(without_kinks<double>());
  const StripSearch<double> search{{.blending_length = 3e-3}};
  const WheelsetMotion<double> mirrored_motion{{10, -0.01, 0}, {0, 10 / 0.43, 0}};
  const auto one = wheelset_forces(arcs(), rail_arcs(),
                                   WheelsetPosition<double>::of(0.0053, 0.4297, -5e-5, 0.004),
                                   motion, model, search);
  const auto other = wheelset_forces(arcs(), rail_arcs(),
                                     WheelsetPosition<double>::of(-0.0053, 0.4297, 5e-5, -0.004),
                                     mirrored_motion, model, search);
  REQUIRE(one.wheel(Side::left).patches.size() >= 2);
  CHECK(one.wheel(Side::left).patches[0].patch.share < 1);
  CHECK(one.force_track.x() == other.force_track.x());
  CHECK(one.force_track.y() == -other.force_track.y());
  CHECK(one.force_track.z() == other.force_track.z());
  CHECK(one.moment_track.x() == -other.moment_track.x());
  CHECK(one.moment_track.y() == other.moment_track.y());
  CHECK(one.moment_track.z() == -other.moment_track.z());
}

TEST_CASE("find_contact, blended: the wrench on S1002 and UIC50 does not jump, without it does",
          "[contact]") {
  const ContactForceModel<double> plain_model, model(without_kinks<double>());
  for (const Sweep& sweep : sweeps) {
    CAPTURE(sweep.name);
    WarmStripSearch<double> plain(arcs(), {.zone_ends = false});
    WarmStripSearch<double> blended(arcs(), {.zone_ends = false, .blending_length = 3e-3});
    const auto over = [&](int steps, const auto& which, auto& search) {
      return roughness<6>(sweep.from, sweep.to, steps,
                          wrench_over(arcs(), rail_arcs(), which, search, sweep.pose, sweep.swept));
    };
    const auto jumping = over(500, plain_model, plain), still = over(2000, plain_model, plain);
    const auto coarse = over(500, model, blended), fine = over(2000, model, blended);
    for (std::size_t k = 0; k < 6; ++k) {
      CAPTURE(k, jumping.of_value[k], still.of_value[k], coarse.of_value[k], fine.of_value[k]);
      CHECK(still.of_value[k] > 0.7 * jumping.of_value[k]);
      CHECK(fine.of_value[k] < 0.3 * coarse.of_value[k]);
    }
  }
}

TEST_CASE("find_contact, blended: the wrench of C2 profiles is once differentiable", "[contact]") {
  const Wheelset wheelset(smooth(s1002<double>(), -0.06, 0.05), 0.43, 1.5);
  // A head of one polynomial, 200 mm in radius at the top.
  const std::array<double, 9> head{0, 0, -0.036 * 0.036 / (2 * 0.2), 0, 0, 0, 0, 0, -0.0115};
  const TangentTrack track(
      PiecewiseProfile<double>({ProfilePiece<double>::polynomial(-0.036, 0.036, 0, 0.036, head)}));
  const ContactForceModel<double> model(without_kinks<double>());
  for (const Sweep& sweep : smooth_sweeps) {
    CAPTURE(sweep.name);
    WarmStripSearch<double> plain(wheelset, {.zone_ends = false});
    WarmStripSearch<double> blended(wheelset, {.zone_ends = false, .blending_length = 3e-3});
    const auto over = [&](int steps, auto& search) {
      return roughness<6>(sweep.from, sweep.to, steps,
                          wrench_over(wheelset, track, model, search, sweep.pose, sweep.swept));
    };
    const auto jumping = over(125, plain), still = over(500, plain);
    const auto coarse = over(125, blended), fine = over(2000, blended);
    int jumps = 0;
    for (std::size_t k = 0; k < 6; ++k) {
      CAPTURE(k, jumping.of_quotient[k], still.of_quotient[k], coarse.of_quotient[k],
              fine.of_quotient[k]);
      jumps += still.of_quotient[k] > 3 * jumping.of_quotient[k];
      // The search rounds places to sqrt(epsilon) radii, 6 nm, over which curvatures change by some
      // 1e-7 of themselves.
      const double rounding = 4e-7 * fine.greatest[k] * 2000 / std::abs(sweep.to - sweep.from);
      CHECK(fine.of_quotient[k] < 0.4 * coarse.of_quotient[k] + rounding);
    }
    CHECK(jumps >= 4);
  }
}
