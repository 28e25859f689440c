// Many placements at once against one after the other.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>
#include <wheelrail/contact/find_contact_batch.hpp>
#include <wheelrail/profile/convex_modification.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/profile/spline_profile.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/placed.hpp"

using namespace wheelrail;

namespace {

using Real_ = PiecewiseProfile<double>;

// Of a product and a sum that one compiler fuses and the other does not.
template <class T>
T penetration_rounding() {
  return T(16) * epsilon<T>() * T(0.43);
}

// One wheel and rail, and placements with the deepest point as deep as was drawn.
struct Pair {
  Wheel<Real_> wheel{s1002<double>(), 0.43};
  Rail<RailHead<double>> rail{uic50<double>()};

  [[nodiscard]] std::vector<WheelPlacement<double>> placements(std::size_t count) const {
    std::mt19937 random(7);
    const auto between = [&](double lower, double upper) {
      return lower + (upper - lower) * (static_cast<double>(random()) / 4294967296.0);
    };
    std::vector<WheelPlacement<double>> result;
    for (std::size_t i = 0; result.size() < count && i < 2 * count; ++i) {
      const double yaw = between(-0.05, 0.05), turn = between(-0.02, 0.02);
      // Every fourth stands where the contact changes from tread to flange.
      const double change = 0.0256 - 0.43 * turn + between(-0.001, 0.001);
      const double shift = i % 4 == 0 ? change : between(0.008, 0.032);
      const double roll = turn - 0.05;  // against the rail's inclination
      const double drawn = std::exp(between(std::log(5e-8), std::log(1e-3)));
      const double depth = i % 20 == 19 ? -drawn : drawn;
      WheelPlacement<double> placement = wheelrail_test::placed(shift, 0.43, yaw, roll);
      placement.side = i % 2 == 0 ? Side::left : Side::right;
      placement.position_rail.x() = 0.01;
      placement.inclination = 0.05;
      double error = 1;
      for (int step = 0; step < 30 && 1e-12 < std::abs(error); ++step) {
        double deepest = -0.02;
        const SearchOptions<double> from_afar{.penetration_threshold = -0.02, .zone_ends = false};
        for (const auto& patch : find_contact(wheel, rail, placement, from_afar).patches) {
          deepest = std::max(deepest, patch.penetration);
        }
        error = deepest - depth;
        placement.position_rail.z() += error;
      }
      if (std::abs(error) < 1e-9) result.push_back(placement);
    }
    return result;
  }
};

template <class T>
PlacementBatch<T> batch_of(const std::vector<WheelPlacement<T>>& placements) {
  PlacementBatch<T> batch;
  for (const auto& placement : placements) batch.push_back(placement);
  return batch;
}

// Of two results: whether they say the same, and how far apart their numbers are.
template <class T>
struct Difference {
  long placements = 0, others = 0, patches = 0, zones = 0;
  T penetration = 0, wheel_lateral = 0, end = 0, curvature = 0, rest = 0;

  void add(const ContactResult<T>& a, const ContactResult<T>& b, const SearchOptions<T>& options) {
    ++placements;
    if (a.status != b.status || a.is_proved != b.is_proved ||
        a.patches.size() != b.patches.size()) {
      ++others;
      return;
    }
    const auto widen = [this](T& so_far, const T& one, const T& other) {
      if (std::isnan(one) || std::isnan(other)) ++others;
      so_far = std::max(so_far, std::abs(one - other));
    };
    for (std::size_t k = 0; k < a.patches.size(); ++k) {
      const Patch<T>&p = a.patches[k], &q = b.patches[k];
      ++patches;
      if (p.zone_is_cut != q.zone_is_cut || p.wheel_piece != q.wheel_piece) ++others;
      widen(penetration, p.penetration, q.penetration);
      widen(wheel_lateral, p.wheel_lateral, q.wheel_lateral);
      if (options.zone_ends) {
        ++zones;
        widen(end, p.zone_lower, q.zone_lower);
        widen(end, p.zone_upper, q.zone_upper);
      } else if (!std::isnan(q.zone_lower) || !std::isnan(q.zone_upper)) {
        ++others;
      }
      widen(rest, p.rail_lateral, q.rail_lateral);
      widen(rest, p.wheel_angle, q.wheel_angle);
      widen(rest, p.longitudinal, q.longitudinal);
      widen(rest, p.contact_angle, q.contact_angle);
      widen(rest, p.rolling_radius, q.rolling_radius);
      widen(curvature, p.wheel_longitudinal_curvature, q.wheel_longitudinal_curvature);
      widen(curvature, p.wheel_lateral_curvature, q.wheel_lateral_curvature);
      widen(curvature, p.rail_lateral_curvature, q.rail_lateral_curvature);
      for (int i = 0; i < 3; ++i) {
        widen(rest, p.position_rail[i], q.position_rail[i]);
        widen(rest, p.normal_rail[i], q.normal_rail[i]);
        widen(rest, p.longitudinal_rail[i], q.longitudinal_rail[i]);
      }
    }
  }
};

template <class W, class R, class T>
Difference<T> difference(const W& wheel, const R& rail,
                         const std::vector<WheelPlacement<T>>& placements,
                         const SearchOptions<T>& options = {}) {
  const auto results = find_contacts(wheel, rail, batch_of(placements), options);
  Difference<T> found;
  for (std::size_t i = 0; i < placements.size(); ++i) {
    found.add(find_contact(wheel, rail, placements[i], options), results[i], options);
  }
  std::printf(
      "placements %ld, patches %ld, unlike %ld; penetration %.2g m, place %.2g m, end %.2g m, "
      "others %.2g\n",
      found.placements, found.patches, found.others, static_cast<double>(found.penetration),
      static_cast<double>(found.wheel_lateral), static_cast<double>(found.end),
      static_cast<double>(found.rest));
  return found;
}

// Equal to the last bit; not a number equals itself.
template <class T>
bool is_same(const ContactResult<T>& a, const ContactResult<T>& b) {
  const auto same = [](const T& x, const T& y) { return x == y || (x != x && y != y); };
  bool all = a.status == b.status && a.is_proved == b.is_proved && a.evaluations == b.evaluations &&
             a.patches.size() == b.patches.size();
  for (std::size_t k = 0; all && k < a.patches.size(); ++k) {
    const Patch<T>&p = a.patches[k], &q = b.patches[k];
    all = p.wheel_lateral == q.wheel_lateral && p.rail_lateral == q.rail_lateral &&
          p.penetration == q.penetration && same(p.zone_lower, q.zone_lower) &&
          same(p.zone_upper, q.zone_upper) && p.zone_is_cut == q.zone_is_cut &&
          p.position_rail == q.position_rail && p.normal_rail == q.normal_rail &&
          p.longitudinal_rail == q.longitudinal_rail && p.wheel_angle == q.wheel_angle &&
          p.contact_angle == q.contact_angle && p.wheel_piece == q.wheel_piece &&
          p.longitudinal == q.longitudinal && p.rolling_radius == q.rolling_radius &&
          p.wheel_longitudinal_curvature == q.wheel_longitudinal_curvature &&
          p.wheel_lateral_curvature == q.wheel_lateral_curvature &&
          p.rail_lateral_curvature == q.rail_lateral_curvature;
  }
  return all;
}

template <class T>
long difference_count(const std::vector<ContactResult<T>>& a,
                      const std::vector<ContactResult<T>>& b) {
  long count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += is_same(a[i], b[i]) ? 0 : 1;
  return count;
}

}  // namespace

TEST_CASE("find_contacts: what find_contact finds at each of many random placements",
          "[contact][random]") {
  const Pair pair;
  const auto placements = pair.placements(4001);
  REQUIRE(placements.size() == 4001);
  SECTION("of the real wheel") {
    const auto found = difference(pair.wheel, pair.rail, placements);
    CHECK(found.others == 0);
    CHECK(found.patches > 3850);
    CHECK(found.penetration <= penetration_rounding<double>());
    CHECK(found.wheel_lateral < 1e-12);
    CHECK(found.rest < 1e-11);
    CHECK(found.curvature < 1e-9);
    CHECK(found.end < 1e-10);
  }
  SECTION("without the zones' ends") {
    const SearchOptions<double> options{.zone_ends = false};
    const auto found = difference(pair.wheel, pair.rail, placements, options);
    CHECK(found.others == 0);
    CHECK(found.zones == 0);
    CHECK(found.patches > 3850);
    CHECK(found.penetration <= penetration_rounding<double>());
  }
  SECTION("below another threshold") {
    const SearchOptions<double> options{.penetration_threshold = -2e-4};
    const auto found = difference(pair.wheel, pair.rail, placements, options);
    CHECK(found.others == 0);
    CHECK(found.patches > 4080);
    CHECK(found.penetration <= penetration_rounding<double>());
  }
  SECTION("with another limit of depth, and few evaluations") {
    const SearchOptions<double> options{.maximum_penetration = 1e-4, .maximum_evaluations = 10};
    const auto found = difference(pair.wheel, pair.rail, placements, options);
    CHECK(found.others == 0);
    CHECK(found.penetration <= penetration_rounding<double>());
    const auto results = find_contacts(pair.wheel, pair.rail, batch_of(placements), options);
    CHECK(std::any_of(results.begin(), results.end(),
                      [](const auto& result) { return result.status == SearchStatus::too_deep; }));
  }
  SECTION("of the convex wheel, whose profile has no lanes of its own") {
    const Wheel<ConvexModification<Real_>> convex{ConvexModification<Real_>(s1002<double>()), 0.43};
    const auto found = difference(convex, pair.rail, placements);
    CHECK(found.others == 0);
    CHECK(found.patches > 2900);
    CHECK(found.penetration <= penetration_rounding<double>());
  }
  SECTION("of a wheel and on a rail from points") {
    std::vector<double> wheel_laterals, wheel_values, rail_laterals, rail_values;
    for (int i = 0; i <= 240; ++i) {
      wheel_laterals.push_back(-0.062 + i * 5e-4);
      wheel_values.push_back(pair.wheel.profile().evaluate(wheel_laterals.back()).value);
      rail_laterals.push_back(0.0349 * std::sin((i - 120) * pi<double>() / 240));
      rail_values.push_back(pair.rail.profile().evaluate(rail_laterals.back()).value);
    }
    using Spline = SplineProfile<double>;
    const Wheel<Spline> from_points(Spline(wheel_laterals, wheel_values, {.noise = 0}), 0.43);
    const Rail<Spline> rail(Spline(rail_laterals, rail_values, {.noise = 0}));
    REQUIRE(rail.is_proved_convex());
    const std::vector<WheelPlacement<double>> few(placements.begin(), placements.begin() + 1000);
    const auto found = difference(from_points, rail, few);
    CHECK(found.others == 0);
    CHECK(found.patches > 900);
    CHECK(found.penetration <= penetration_rounding<double>());
    CHECK(found.wheel_lateral < 1e-12);
  }
  SECTION("on a rail without a closed form") {
    const Rail<Real_> swept(s1002<double>());  // concave, too
    const std::vector<WheelPlacement<double>> few(placements.begin(), placements.begin() + 20);
    CHECK(difference(pair.wheel, swept, few).others == 0);
  }
}

TEST_CASE("find_contacts: what find_contact finds, in single precision", "[contact][random]") {
  const Wheel<PiecewiseProfile<float>> wheel{s1002<float>(), 0.43F};
  const Rail<RailHead<float>> rail{uic50<float>()};
  std::vector<WheelPlacement<float>> placements;
  for (const auto& exact : Pair().placements(1000)) {
    WheelPlacement<float> placement;
    placement.position_rail = exact.position_rail.cast<float>();
    placement.sin_yaw = static_cast<float>(exact.sin_yaw);
    placement.cos_yaw = static_cast<float>(exact.cos_yaw);
    placement.tan_yaw = static_cast<float>(exact.tan_yaw);
    placement.sin_roll = static_cast<float>(exact.sin_roll);
    placement.cos_roll = static_cast<float>(exact.cos_roll);
    placements.push_back(placement);
  }
  const auto found = difference(wheel, rail, placements);
  // Zones as shallow as a rounding of the penetration may be there or not.
  CHECK(found.others * 100 <= found.placements);
  CHECK(found.patches > 900);
  CHECK(found.penetration <= penetration_rounding<float>());
}

TEST_CASE("find_contacts: neither order nor size nor threads change a bit", "[contact][random]") {
  const Pair pair;
  const auto placements = pair.placements(1500);
  REQUIRE(placements.size() == 1500);
  const auto expected = find_contacts(pair.wheel, pair.rail, batch_of(placements));
  std::vector<std::size_t> order(placements.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (const unsigned seed : {1U, 2U}) {
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    PlacementBatch<double> shuffled;
    for (const std::size_t i : order) shuffled.push_back(placements[i]);
    for (const int threads : {1, 2, 3, 50}) {
      const auto found = find_contacts(pair.wheel, pair.rail, shuffled, {}, threads);
      std::vector<ContactResult<double>> sorted(found.size());
      for (std::size_t i = 0; i < order.size(); ++i) sorted[order[i]] = found[i];
      CHECK(difference_count(expected, sorted) == 0);
    }
  }
  for (const std::size_t size : {1U, 2U, 7U, 8U, 9U, 15U, 16U, 17U, 31U, 63U, 64U, 65U, 257U}) {
    const std::vector<WheelPlacement<double>> few(
        placements.begin(), placements.begin() + static_cast<std::ptrdiff_t>(size));
    const auto found = find_contacts(pair.wheel, pair.rail, batch_of(few));
    REQUIRE(found.size() == size);
    CHECK(difference_count(found, expected) == 0);
  }
}

TEST_CASE("nearly_sorted: each index once, keys out of order by less than a class",
          "[contact][random]") {
  std::vector<double> keys;
  std::vector<std::size_t> indices;
  std::mt19937 random(5);
  for (std::size_t i = 0; i < 1000; ++i) {
    keys.push_back(static_cast<double>(random()) / 4294967296.0);
    if (i % 3 != 0) indices.push_back(i);
  }
  keys[1] = 1e300;
  keys[2] = -1e300;
  const double least = 0.25, greatest = 0.75;
  auto sorted = detail::nearly_sorted(indices, keys, least, greatest);
  REQUIRE(sorted.size() == indices.size());
  const double width = (greatest - least) / static_cast<double>(indices.size());
  const auto key = [&](std::size_t i) { return std::clamp(keys[sorted[i]], least, greatest); };
  for (std::size_t i = 1; i < sorted.size(); ++i) CHECK(key(i - 1) < key(i) + 1.001 * width);
  std::sort(sorted.begin(), sorted.end());
  CHECK(sorted == indices);
  CHECK(detail::nearly_sorted<double>({}, keys, least, greatest).empty());
}

TEST_CASE("find_contacts: a placement that is not finite spoils its own result only",
          "[contact][bad-input]") {
  const Pair pair;
  auto placements = pair.placements(100);
  const auto expected = find_contacts(pair.wheel, pair.rail, batch_of(placements));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  placements[3].position_rail.y() = nan;
  placements[40].sin_yaw = infinity;
  placements[41].cos_roll = nan;
  placements[60].tan_yaw = nan;
  placements[99].position_rail.x() = -infinity;
  const auto found = find_contacts(pair.wheel, pair.rail, batch_of(placements), {}, 2);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (i == 3 || i == 40 || i == 41 || i == 60 || i == 99) {
      CHECK(found[i].status == SearchStatus::not_finite);
      CHECK(found[i].patches.empty());
      CHECK_FALSE(found[i].is_proved);
    } else {
      CHECK(is_same(found[i], expected[i]));
    }
  }
  const SearchOptions<double> bad{.penetration_threshold = nan};
  for (const auto& result : find_contacts(pair.wheel, pair.rail, batch_of(placements), bad)) {
    CHECK(result.status == SearchStatus::not_finite);
  }
}

TEST_CASE("find_contacts: with blending, what find_contact finds", "[contact]") {
  const Pair pair;
  auto placements = pair.placements(200);
  placements[7].sin_yaw = std::numeric_limits<double>::quiet_NaN();
  const SearchOptions<double> options{.blending_length = 3e-3};
  const auto found = find_contacts(pair.wheel, pair.rail, batch_of(placements), options, 2);
  int blended = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto single = find_contact(pair.wheel, pair.rail, placements[i], options);
    REQUIRE(is_same(found[i], single));
    for (std::size_t k = 0; k < single.patches.size(); ++k) {
      CHECK(found[i].patches[k].share == single.patches[k].share);
      blended += single.patches[k].share < 1;
    }
  }
  CHECK(blended > 0);
}

TEST_CASE("find_contacts: no placements, and calls that cannot be", "[contact][bad-input]") {
  const Pair pair;
  const PlacementBatch<double> none;
  CHECK(find_contacts(pair.wheel, pair.rail, none).empty());
  CHECK(find_contacts(pair.wheel, pair.rail, none, {}, 4).empty());
  const auto batch = batch_of(pair.placements(10));
  CHECK_THROWS_AS(find_contacts(pair.wheel, pair.rail, batch, {}, 0), std::invalid_argument);
}

TEST_CASE(
    "find_contacts: results that are used again hold nothing of before, and no allocation "
    "goes with the placements",
    "[contact][no-alloc]") {
  const Pair pair;
  const auto placements = pair.placements(1200);
  const auto batch = batch_of(placements);
  const auto few =
      batch_of(std::vector<WheelPlacement<double>>(placements.begin(), placements.begin() + 300));
  std::vector<ContactResult<double>> results(1200), of_few(300);
  const auto search = [&](const auto& of, auto& into) {
    return wheelrail_test::allocations_of(
        [&] { into = find_contacts(pair.wheel, pair.rail, of, {}, 1, std::move(into)); });
  };
  const long first = search(batch, results), less = search(few, of_few);
  CHECK(first <= less + 4);
  CHECK(less < 40);
  std::reverse(results.begin(), results.end());
  CHECK(search(batch, results) <= first);
  CHECK(difference_count(results, find_contacts(pair.wheel, pair.rail, batch)) == 0);
}
