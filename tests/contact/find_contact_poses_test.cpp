// The contact search on very many random poses, against a dense scan that shares nothing with it.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>
#include <wheelrail/contact/find_contact.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/track/tangent_track.hpp>

#include "support/catch.hpp"
#include "support/dense_locus.hpp"

using namespace wheelrail;
using wheelrail_test::ArcRail;
using wheelrail_test::DenseLocus;
using wheelrail_test::LocusZone;
using wheelrail_test::RailStand;
using wheelrail_test::StripTable;
using wheelrail_test::WheelsetPose;

namespace {

constexpr double nominal_radius = 0.43;
constexpr double depth_tolerance = 1e-9;  // SearchOptions' default [m]
constexpr double rounding = 1e-12;        // of a depth [m]

// The pair that is searched, by both.
struct Pair {
  Wheel<PiecewiseProfile<double>> wheel{s1002<double>(), nominal_radius};
  TangentTrack<RailHead<double>> track{uic50<double>()};
  ArcRail arcs{uic50<double>().dimensions()};
  StripTable table{wheel.profile(), nominal_radius, 5e-5};
  RailStand stand;

  Pair() {
    const auto origin = track.nearest_frame(Side::left, Vector3<double>::Zero()).origin_track;
    stand = {origin.y(), origin.z(), std::atan(0.05)};
  }
  [[nodiscard]] const Rail<RailHead<double>>& rail() const { return track.rail(Side::left); }
  [[nodiscard]] DenseLocus<PiecewiseProfile<double>> dense() const {
    return {wheel.profile(), nominal_radius, table, arcs, stand};
  }
  [[nodiscard]] WheelPlacement<double> placement(const WheelsetPose& pose) const {
    const auto vector = [](const WheelsetPose::Point& p) {
      return Vector3<double>(p[0], p[1], p[2]);
    };
    const Vector3<double> wheel_track = vector(pose.wheel_origin(Side::left));
    return place_wheel(track.nearest_frame(Side::left, wheel_track), wheel_track,
                       vector(pose.axle_outwards(Side::left)));
  }
};

// Random numbers of one pose: nothing else has a part in them. (SplitMix64: Steele, Lea and Flood,
// Fast splittable pseudorandom number generators, OOPSLA 2014.)
class PoseRandom {
 public:
  explicit PoseRandom(std::uint64_t index) : state_(index * 0x632BE59BD9B4E019ULL + 20240607) {}
  [[nodiscard]] double between(double lower, double upper) {
    std::uint64_t x = state_ += 0x9E3779B97F4A7C15ULL;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
    x ^= x >> 31;
    return lower + (upper - lower) * (static_cast<double>(x >> 11) / 9007199254740992.0);
  }

 private:
  std::uint64_t state_;
};

// The pose of this index; its height is the one at which the dense scan's deepest point is as deep
// as was drawn. Every 20th is lifted by that instead; every 4th stands near the change from tread to
// flange, where the wheel's bottom is 5.6 mm from the middle. Nothing: there is no such height.
template <class Dense>
std::optional<WheelsetPose> random_pose(long index, Dense& dense) {
  PoseRandom random(static_cast<std::uint64_t>(index));
  WheelsetPose pose;
  pose.lateral_shift = random.between(-0.012, 0.012);
  pose.yaw = random.between(-0.05, 0.05);
  pose.roll = random.between(-0.02, 0.02);
  const double offset = random.between(-0.001, 0.001);
  if (index % 4 == 0) {
    pose.lateral_shift = std::clamp(0.0056 - nominal_radius * pose.roll + offset, -0.012, 0.012);
  }
  const double depth = std::exp(random.between(std::log(5e-8), std::log(1e-3)));
  pose.height = nominal_radius + 0.035 - pose.spacing / 2 * std::sin(pose.roll);  // clear
  dense.place(pose);
  const auto lifted = dense.set_deepest(index % 20 == 19 ? -depth : depth);
  if (!lifted) return std::nullopt;
  pose.height += *lifted;
  dense.place(pose);
  return pose;
}

// What the plain method would take: equally spaced strips, and in each run of strips that reach
// under the rail a golden section to 1 nm of wheel_lateral about the deepest.
struct PlainScan {
  int evaluations = 0;
  std::size_t runs = 0;
};

template <class Dense>
PlainScan plain_scan(const Dense& dense, double lower, double upper) {
  constexpr int strips = 201;
  constexpr double golden = 0.6180339887498949;
  const double spacing = (upper - lower) / (strips - 1);
  PlainScan scan;
  const auto depth = [&](double u) {
    ++scan.evaluations;
    return dense.depth(u);
  };
  const auto refine = [&](double left, double right) {
    double a = right - golden * (right - left), b = left + golden * (right - left);
    double at_a = depth(a), at_b = depth(b);
    while (right - left > 1e-9) {
      if (at_a < at_b) {
        left = a;
        a = b;
        at_a = at_b;
        at_b = depth(b = left + golden * (right - left));
      } else {
        right = b;
        b = a;
        at_b = at_a;
        at_a = depth(a = right - golden * (right - left));
      }
    }
  };
  double deepest = 0.0, deepest_lateral = 0.0;
  for (int i = 0; i <= strips; ++i) {
    const double u = std::min(upper, lower + spacing * i);
    const double here = i < strips ? depth(u) : 0.0;
    if (here > deepest) {
      deepest = here;
      deepest_lateral = u;
    }
    if (!(here > 0.0) && deepest > 0.0) {
      ++scan.runs;
      refine(std::max(lower, deepest_lateral - spacing),
             std::min(upper, deepest_lateral + spacing));
      deepest = 0.0;
    }
  }
  return scan;
}

// Strips that were looked at, of the poses that are drawn evenly.
struct Evaluations {
  long poses = 0, full = 0, brief = 0, plain = 0;  // brief: without the zones' ends
  long plain_wrong = 0;  // poses in which the plain method counts other zones

  void add(const Evaluations& other) {
    poses += other.poses;
    full += other.full;
    brief += other.brief;
    plain += other.plain;
    plain_wrong += other.plain_wrong;
  }
};

// Sums that do not depend on how the poses are split between threads.
struct Tally {
  long poses = 0, used = 0, without_height = 0, below_rail = 0;
  std::array<long, 5> patches{};  // poses with 0, 1, 2, 3, more
  long all_patches = 0, proved = 0;
  // Zones that need not be found: shallower than the tolerance, or apart by less than it.
  long shallow_missing = 0, merged = 0;
  long cut = 0;
  std::array<Evaluations, 2> evaluations;  // below 20 mrad of yaw, and above
  double worst_penetration = 0, worst_excess = 0, worst_end = 0;
  long mismatch_count = 0;
  std::vector<std::string> mismatches;  // the first ones

  void add(const Tally& other) {
    poses += other.poses;
    used += other.used;
    without_height += other.without_height;
    below_rail += other.below_rail;
    for (std::size_t i = 0; i < patches.size(); ++i) patches[i] += other.patches[i];
    all_patches += other.all_patches;
    proved += other.proved;
    shallow_missing += other.shallow_missing;
    merged += other.merged;
    cut += other.cut;
    for (std::size_t i = 0; i < evaluations.size(); ++i) evaluations[i].add(other.evaluations[i]);
    worst_penetration = std::max(worst_penetration, other.worst_penetration);
    worst_excess = std::max(worst_excess, other.worst_excess);
    worst_end = std::max(worst_end, other.worst_end);
    mismatch_count += other.mismatch_count;
    mismatches.insert(mismatches.end(), other.mismatches.begin(), other.mismatches.end());
  }
};

template <class... Numbers>
std::string text(const char* format, Numbers... numbers) {
  std::array<char, 400> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, numbers...);
  return buffer.data();
}

// One pose's patches against the zones of the dense scan.
class Comparison {
 public:
  using Dense = DenseLocus<PiecewiseProfile<double>>;

  Comparison(long index, const WheelsetPose& pose, Tally& tally)
      : index_(index), pose_(pose), tally_(tally) {}

  void run(const ContactResult<double>& found, Dense& dense) {
    const std::vector<LocusZone>& zones = dense.zones();
    if (found.status != SearchStatus::complete) fail(name_of(found.status), 0, 0);
    if (dense.reaches_below(0.035, 0.05)) {
      ++tally_.below_rail;
      return;
    }
    ++tally_.used;
    // Whose zone each patch lies in; a zone with two patches has too many.
    std::vector<const Patch<double>*> owner(zones.size(), nullptr);
    for (const Patch<double>& patch : found.patches) {
      const double depth = dense.depth_near(patch.penetration, patch.wheel_lateral);
      worst(tally_.worst_penetration, patch.penetration - depth);
      if (!(std::abs(patch.penetration - depth) <= rounding)) {
        fail("penetration", patch.wheel_lateral, patch.penetration - depth);
      }
      std::size_t k = 0;
      while (k < zones.size() && zones[k].outside_upper < patch.wheel_lateral) ++k;
      if (k == zones.size() || patch.wheel_lateral < zones[k].outside_lower) {
        fail("invented", patch.wheel_lateral, patch.penetration);
      } else if (owner[k] != nullptr) {
        fail("split", patch.wheel_lateral, patch.penetration);
      } else {
        owner[k] = &patch;
      }
    }
    for (std::size_t k = 0; k < zones.size(); ++k) {
      if (owner[k] == nullptr) owner[k] = owner_of_merged(found, zones, k);
      if (owner[k] != nullptr) {
        const double excess = zones[k].penetration - owner[k]->penetration;
        tally_.worst_excess = std::max(tally_.worst_excess, excess);
        if (!(excess <= rounding)) fail("not the deepest", zones[k].lateral, excess);
      } else if (zones[k].penetration > depth_tolerance) {
        fail("missed", zones[k].lateral, zones[k].penetration);
      } else {
        ++tally_.shallow_missing;
      }
    }
    for (std::size_t k = 0; k < zones.size(); ++k) {
      if (owner[k] == nullptr) continue;
      if (k == 0 || owner[k - 1] != owner[k]) {
        compare_end(dense, *owner[k], owner[k]->zone_lower, zones[k].outside_lower,
                    zones[k].inside_lower);
      }
      if (k + 1 == zones.size() || owner[k + 1] != owner[k]) {
        compare_end(dense, *owner[k], owner[k]->zone_upper, zones[k].inside_upper,
                    zones[k].outside_upper);
      }
    }
  }

  void fail(const char* what, double lateral, double by) {
    if (++tally_.mismatch_count > 10) return;
    tally_.mismatches.push_back(
        text("pose %ld: %s at %.9g m (%.3g m); lateral_shift %.17g, height %.17g, roll %.17g, yaw "
             "%.17g",
             index_, what, lateral, by, pose_.lateral_shift, pose_.height, pose_.roll, pose_.yaw));
  }

 private:
  static void worst(double& so_far, double error) { so_far = std::max(so_far, std::abs(error)); }

  // The patch whose zone takes in zone k with others, where less than the tolerance parts them.
  const Patch<double>* owner_of_merged(const ContactResult<double>& found,
                                       const std::vector<LocusZone>& zones, std::size_t k) {
    for (const Patch<double>& patch : found.patches) {
      if (zones[k].lateral < patch.zone_lower || patch.zone_upper < zones[k].lateral) continue;
      const double from = std::min(patch.wheel_lateral, zones[k].lateral);
      const double to = std::max(patch.wheel_lateral, zones[k].lateral);
      for (std::size_t i = 0; i + 1 < zones.size(); ++i) {
        const bool between = from <= zones[i].lateral && zones[i + 1].lateral <= to;
        if (between && zones[i].gap < -depth_tolerance) return nullptr;
      }
      ++tally_.merged;
      return &patch;
    }
    return nullptr;
  }

  void compare_end(const Dense& dense, const Patch<double>& patch, double end, double lower,
                   double upper) {
    if (patch.zone_is_cut) {
      ++tally_.cut;
      return;
    }
    const double depth = dense.depth_near(0.0, end);
    worst(tally_.worst_end, depth);
    if (!(std::abs(depth) <= rounding)) fail("end's depth", end, depth);
    if (!(lower - rounding <= end && end <= upper + rounding)) fail("end's place", end, depth);
  }

  long index_;
  const WheelsetPose& pose_;
  Tally& tally_;
};

// The poses from `first` on, up to `last`.
Tally compare(const Pair& pair, long first, long last) {
  Tally tally;
  auto dense = pair.dense();
  for (long index = first; index < last; ++index) {
    ++tally.poses;
    const auto pose = random_pose(index, dense);
    if (!pose) {
      ++tally.without_height;
      continue;
    }
    const auto placement = pair.placement(*pose);
    const auto found = find_contact(pair.wheel, pair.rail(), placement);
    const auto brief = find_contact(pair.wheel, pair.rail(), placement, {.zone_ends = false});
    Comparison comparison(index, *pose, tally);
    const long used = tally.used;
    comparison.run(found, dense);
    if (tally.used == used) continue;
    if (brief.patches.size() != found.patches.size()) comparison.fail("brief", 0, 0);
    const auto& profile = pair.wheel.profile();
    const PlainScan plain = plain_scan(dense, profile.lower(), profile.upper());
    ++tally.patches[std::min<std::size_t>(found.patches.size(), 4)];
    tally.all_patches += static_cast<long>(found.patches.size());
    tally.proved += found.is_proved;
    if (index % 4 != 0) {
      tally.evaluations[std::abs(pose->yaw) < 0.02 ? 0 : 1].add(
          {1, found.evaluations, brief.evaluations, plain.evaluations,
           plain.runs != found.patches.size() ? 1 : 0});
    }
  }
  return tally;
}

// Heights at which zones begin, join or part: poses of which random ones have few. Each is closed in
// on, and passed by distances down to the depth tolerance.
Tally compare_at_changes(const Pair& pair, long first, long last, std::array<long, 2>& changes) {
  Tally tally;
  auto dense = pair.dense();
  for (long index = first; index < last; ++index) {
    auto pose = random_pose(4 * index, dense);
    if (!pose) continue;
    const auto lifted = dense.set_deepest(1e-3);
    if (!lifted) continue;
    pose->height += *lifted;
    const auto zones_at = [&](double above) {
      WheelsetPose at = *pose;
      at.height += above;
      dense.place(at);
      return dense.zones().size();
    };
    PoseRandom random(static_cast<std::uint64_t>(index) + 2000000000);
    std::size_t before = zones_at(0.0);
    for (int step = 1; step <= 40 && 0 < before; ++step) {
      double low = 25e-6 * (step - 1), high = 25e-6 * step;
      const std::size_t after = zones_at(high);
      if (0 < after && after != before) {
        while (high - low > 1e-11) {
          const double middle = (low + high) / 2;
          (zones_at(middle) == before ? low : high) = middle;
        }
        ++changes[after < before ? 0 : 1];
        for (int i = 0; i < 6; ++i) {
          const double by = std::exp(random.between(std::log(1e-9), std::log(2e-5)));
          WheelsetPose at = *pose;
          at.height += low + (i % 2 == 0 ? by : -by);
          dense.place(at);
          const auto found = find_contact(pair.wheel, pair.rail(), pair.placement(at));
          ++tally.poses;
          Comparison(4 * index, at, tally).run(found, dense);
          ++tally.patches[std::min<std::size_t>(found.patches.size(), 4)];
          tally.proved += found.is_proved;
        }
      }
      before = after;
    }
  }
  return tally;
}

// The same with the poses dealt out to threads; the sums are the same for any number of them.
Tally compare_on_threads(const Pair& pair, long count) {
  const long threads = std::max(1L, static_cast<long>(std::thread::hardware_concurrency()));
  std::vector<Tally> tallies(static_cast<std::size_t>(threads));
  std::vector<std::thread> running;
  for (long t = 0; t < threads; ++t) {
    running.emplace_back([&, t] {
      tallies[static_cast<std::size_t>(t)] =
          compare(pair, count * t / threads, count * (t + 1) / threads);
    });
  }
  for (auto& thread : running) thread.join();
  Tally sum;
  for (const Tally& tally : tallies) sum.add(tally);
  return sum;
}

void report(const Tally& t) {
  std::printf(
      "poses: %ld of %ld (no height %ld, below the rail %ld); with 0 patches %ld, 1: %ld, 2: %ld, "
      "3: %ld, more: %ld\n",
      t.used, t.poses, t.without_height, t.below_rail, t.patches[0], t.patches[1], t.patches[2],
      t.patches[3], t.patches[4]);
  std::printf(
      "is_proved for %ld of %ld; zones below 1 nm missing %ld, merged across less than 1 nm %ld, "
      "ends cut %ld\n",
      t.proved, t.used, t.shallow_missing, t.merged, t.cut);
  std::printf(
      "worst: penetration %.2g m, deeper point %.2g m, depth at a zone's end %.2g m; mismatches "
      "%ld\n",
      t.worst_penetration, t.worst_excess, t.worst_end, t.mismatch_count);
  const auto print = [](const char* which, const Evaluations& e) {
    const auto per_pose = [&](long sum) {
      return static_cast<double>(sum) / static_cast<double>(e.poses);
    };
    std::printf(
        "strips per search, %s: %.2f, without zone ends %.2f; plain method %.2f (%.2f times), "
        "other zones in %ld of %ld poses\n",
        which, per_pose(e.full), per_pose(e.brief), per_pose(e.plain),
        static_cast<double>(e.plain) / static_cast<double>(e.brief), e.plain_wrong, e.poses);
  };
  print("yaw below 20 mrad", t.evaluations[0]);
  print("yaw above 20 mrad", t.evaluations[1]);
  Evaluations sum = t.evaluations[0];
  sum.add(t.evaluations[1]);
  print("all", sum);
}

void check(const Tally& t) {
  report(t);
  for (const std::string& mismatch : t.mismatches) UNSCOPED_INFO(mismatch);
  CHECK(t.mismatch_count == 0);
  CHECK(t.used == t.poses);
  CHECK(t.cut == 0);
  CHECK(1000 * (t.shallow_missing + t.merged) <= t.used);
  CHECK(10 * t.proved > 9 * t.used);
  CHECK(t.patches[0] == t.poses / 20);
  CHECK(10 * t.patches[1] > 8 * t.used);
  CHECK(100 * t.patches[2] > t.used);
  CHECK(2000 * t.patches[3] > t.used);
  // The plain method takes 201 strips and 30 more for each zone that it sees.
  Evaluations sum = t.evaluations[0];
  sum.add(t.evaluations[1]);
  CHECK(20 * t.evaluations[0].brief < t.evaluations[0].plain);
  CHECK(15 * sum.brief < sum.plain);
}

// Equal to the last bit.
bool is_same(const Patch<double>& a, const Patch<double>& b) {
  return a.wheel_lateral == b.wheel_lateral && a.rail_lateral == b.rail_lateral &&
         a.wheel_angle == b.wheel_angle && a.longitudinal == b.longitudinal &&
         a.penetration == b.penetration && a.zone_lower == b.zone_lower &&
         a.zone_upper == b.zone_upper && a.zone_is_cut == b.zone_is_cut &&
         a.contact_angle == b.contact_angle && a.rolling_radius == b.rolling_radius &&
         a.wheel_longitudinal_curvature == b.wheel_longitudinal_curvature &&
         a.wheel_lateral_curvature == b.wheel_lateral_curvature &&
         a.rail_lateral_curvature == b.rail_lateral_curvature &&
         a.position_rail == b.position_rail && a.normal_rail == b.normal_rail &&
         a.longitudinal_rail == b.longitudinal_rail;
}

long difference_count(const std::vector<ContactResult<double>>& a,
                      const std::vector<ContactResult<double>>& b) {
  long count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    bool same = a[i].status == b[i].status && a[i].is_proved == b[i].is_proved &&
                a[i].patches.size() == b[i].patches.size();
    for (std::size_t k = 0; same && k < a[i].patches.size(); ++k) {
      same = is_same(a[i].patches[k], b[i].patches[k]);
    }
    count += same ? 0 : 1;
  }
  return count;
}

// Strips per search of those whose pose is at most so far from the one before.
double strips_after(const std::vector<ContactResult<double>>& results,
                    const std::vector<double>& steps, double longest) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (longest < steps[i]) continue;
    sum += results[i].evaluations;
    ++count;
  }
  CHECK(count > 2000);
  return sum / count;
}

}  // namespace

TEST_CASE("find_contact: random poses, nothing missed and nothing invented", "[contact][random]") {
  check(compare_on_threads(Pair(), 3000));
}

TEST_CASE("find_contact: a million random poses, nothing missed and nothing invented",
          "[contact][random][.][slow]") {
  check(compare_on_threads(Pair(), 1000000));
}

TEST_CASE("find_contact: zones that just begin, join or part", "[contact][random]") {
  std::array<long, 2> changes{};  // beginnings, seen from above, and joints
  const Tally t = compare_at_changes(Pair(), 0, 200, changes);
  std::printf(
      "heights where a zone begins %ld, where two join %ld; poses near them with 1 patch %ld, 2: "
      "%ld, 3: %ld, more: %ld; is_proved for %ld; zones below 1 nm missing %ld, merged across less "
      "than 1 nm %ld; mismatches %ld\n",
      changes[0], changes[1], t.patches[1], t.patches[2], t.patches[3], t.patches[4], t.proved,
      t.shallow_missing, t.merged, t.mismatch_count);
  for (const std::string& mismatch : t.mismatches) UNSCOPED_INFO(mismatch);
  CHECK(t.mismatch_count == 0);
  CHECK(t.used == t.poses);
  CHECK(100 * (t.shallow_missing + t.merged) <= t.used);
  CHECK(changes[0] > 80);
  CHECK(changes[1] > 100);
  CHECK(t.patches[2] > 500);
  CHECK(t.patches[3] > 80);
  CHECK(t.patches[4] > 5);
}

TEST_CASE("find_contact: order, threads and warm starts change no bit of the results",
          "[contact][random]") {
  const Pair pair;
  auto dense = pair.dense();
  // Runs of twelve poses, some of which a memory covers, and jumps between them.
  std::vector<WheelPlacement<double>> placements;
  std::vector<double> steps;  // to each from the one before
  for (long run = 0; run < 500; ++run) {
    auto pose = random_pose(run, dense);
    REQUIRE(pose);
    PoseRandom random(static_cast<std::uint64_t>(run) + 1000000000);
    double step = 1;
    for (int i = 0; i < 12; ++i) {
      placements.push_back(pair.placement(*pose));
      steps.push_back(step);
      step = std::exp(random.between(std::log(1e-8), std::log(2e-4)));
      pose->lateral_shift += step * random.between(-1.0, 1.0);
      pose->height += step * random.between(-0.5, 0.5);
      pose->yaw += step * random.between(-1.0, 1.0);
      pose->roll += step * random.between(-0.5, 0.5);
    }
  }
  using Results = std::vector<ContactResult<double>>;
  const std::size_t count = placements.size();
  const auto cold = [&](std::size_t i) {
    return find_contact(pair.wheel, pair.rail(), placements[i]);
  };
  Results expected(count);
  for (std::size_t i = 0; i < count; ++i) expected[i] = cold(i);

  std::vector<std::size_t> forwards(count);
  std::iota(forwards.begin(), forwards.end(), std::size_t{0});
  const std::vector<std::size_t> backwards(forwards.rbegin(), forwards.rend());
  std::vector<std::size_t> shuffled = forwards;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(3));
  SearchMemory<double> memory(pair.wheel);  // one for all three, one order after the other
  double warm = 0, warm_at_all = 0;
  for (const auto& order : {forwards, backwards, shuffled}) {
    Results without(count), with(count);
    for (const std::size_t i : order) without[i] = cold(i);
    for (const std::size_t i : order) {
      with[i] = find_contact(pair.wheel, pair.rail(), placements[i], memory);
    }
    CHECK(difference_count(expected, without) == 0);
    CHECK(difference_count(expected, with) == 0);
    if (order == forwards) {
      warm = strips_after(with, steps, 1e-6);
      warm_at_all = strips_after(with, steps, 1);
    }
  }
  // The memory did something within its reach, and costs little beyond it.
  const double cold_at_all = strips_after(expected, steps, 1);
  const double of_cold = strips_after(expected, steps, 1e-6);
  std::printf("strips per search: cold %.2f, warm %.2f; after small steps %.2f, %.2f\n",
              cold_at_all, warm_at_all, of_cold, warm);
  CHECK(warm < 0.97 * of_cold);
  CHECK(warm_at_all < 1.2 * cold_at_all);

  Results threaded(count);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 3; ++t) {
    threads.emplace_back([&, t] {
      SearchMemory<double> own(pair.wheel);
      for (std::size_t i = t; i < count; i += 3) {
        threaded[i] = find_contact(pair.wheel, pair.rail(), placements[i], own);
      }
    });
  }
  for (auto& thread : threads) thread.join();
  CHECK(difference_count(expected, threaded) == 0);
}
