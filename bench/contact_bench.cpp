// The contact searches on the same poses: a wheelset's left wheel over the gauge clearance, set down
// with some tens of micrometres of penetration. The results are compared before anything is timed.
//
//   cmake -B build/bench -DWHEELRAIL_BUILD_BENCHMARKS=ON -DWHEELRAIL_BUILD_TESTS=OFF
//   cmake --build build/bench --target contact_bench && build/bench/bench/contact_bench

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>
#include <wheelrail/wheelrail.hpp>

namespace {

using namespace wheelrail;
using RealWheel = PiecewiseProfile<double>;
using ConvexWheel = ConvexModification<RealWheel>;

struct Setting {
  Wheelset<RealWheel> real{s1002<double>(), 0.43, 1.5};
  Wheelset<ConvexWheel> convex{ConvexWheel(s1002<double>()), 0.43, 1.5};
  TangentTrack<RailHead<double>> track{uic50<double>()};
  MinimumDistanceSearch<double> minimum_distance{convex_parts(convex.wheel(Side::left).profile()),
                                                 {}};
  std::vector<WheelPlacement<double>> poses;

  Setting() {
    std::mt19937 random(2020);
    const auto between = [&random](double lower, double upper) {
      return lower + (upper - lower) * (static_cast<double>(random()) / 4294967296.0);
    };
    while (poses.size() < 256) {
      const double shift = between(-0.006, 0.006), yaw = between(-0.01, 0.01);
      const auto down = touching_position(real, track, shift, yaw, {.gap = -between(5e-6, 80e-6)});
      if (down.status != SolveStatus::converged) continue;
      poses.push_back(place_wheel(real, track, Side::left, down.position));
    }
    check();
  }

  // Both methods must agree on the convex wheel, and each pose must touch the real one.
  void check() const {
    const auto& rail = track.rail(Side::left);
    for (const auto& pose : poses) {
      const auto by_strips = find_contact(convex.wheel(Side::left), rail, pose);
      const auto by_distance = minimum_distance(convex.wheel(Side::left), rail, pose);
      const auto on_real = find_contact(real.wheel(Side::left), rail, pose);
      bool good = by_strips.patches.size() == by_distance.patches.size() &&
                  by_strips.status == SearchStatus::complete &&
                  by_distance.status == SearchStatus::complete && !on_real.patches.empty();
      for (std::size_t k = 0; good && k < by_strips.patches.size(); ++k) {
        good =
            std::abs(by_strips.patches[k].penetration - by_distance.patches[k].penetration) < 1e-12;
      }
      if (good) continue;
      std::fprintf(stderr, "contact_bench: the methods disagree, nothing is timed\n");
      std::exit(1);
    }
  }
};

const Setting& setting() {
  static const Setting value;
  return value;
}

template <class Search>
void run(benchmark::State& state, const Search& search) {
  long evaluations = 0, failures = 0, searches = 0;
  for (auto _ : state) {
    for (const auto& pose : setting().poses) {
      const auto found = search(pose);
      benchmark::DoNotOptimize(found.patches.begin());
      evaluations += found.evaluations;
      failures += found.status != SearchStatus::complete;
    }
    searches += static_cast<long>(setting().poses.size());
  }
  state.SetItemsProcessed(searches);
  state.counters["evaluations"] = static_cast<double>(evaluations) / static_cast<double>(searches);
  state.counters["failures"] = static_cast<double>(failures);
}

void minimum_distance_convex(benchmark::State& state) {
  const Setting& s = setting();
  run(state, [&](const auto& pose) {
    return s.minimum_distance(s.convex.wheel(Side::left), s.track.rail(Side::left), pose);
  });
}

void strips_convex(benchmark::State& state) {
  const Setting& s = setting();
  run(state, [&](const auto& pose) {
    return find_contact(s.convex.wheel(Side::left), s.track.rail(Side::left), pose);
  });
}

void strips_real(benchmark::State& state) {
  const Setting& s = setting();
  run(state, [&](const auto& pose) {
    return find_contact(s.real.wheel(Side::left), s.track.rail(Side::left), pose);
  });
}

void contact_force(benchmark::State& state) {
  const Setting& s = setting();
  const ContactForceModel<double> model;
  std::vector<ContactKinematics<double>> contacts;
  for (const auto& pose : s.poses) {
    const auto found = find_contact(s.real.wheel(Side::left), s.track.rail(Side::left), pose);
    const auto& patch = found.patches[0];
    contacts.push_back({.penetration = patch.penetration,
                        .curvatures = hertz_curvatures(patch.wheel_longitudinal_curvature, 0.0,
                                                       patch.wheel_lateral_curvature,
                                                       patch.rail_lateral_curvature),
                        .longitudinal_velocity = 0.01,
                        .lateral_velocity = 0.005,
                        .spin_velocity = 0.2,
                        .forward_speed = 10,
                        .speed = 10});
  }
  for (auto _ : state) {
    for (const auto& contact : contacts) benchmark::DoNotOptimize(model(contact));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<long>(contacts.size()));
}

BENCHMARK(minimum_distance_convex);
BENCHMARK(strips_convex);
BENCHMARK(strips_real);
BENCHMARK(contact_force);

}  // namespace

BENCHMARK_MAIN();
