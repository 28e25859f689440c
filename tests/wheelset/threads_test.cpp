// Searches and forces of several threads on shared objects. Compiled with the thread sanitizer, which
// ends the program with an error where two threads touch the same memory, one of them writing.

#include <array>
#include <cmath>
#include <cstddef>
#include <thread>
#include <vector>
#include <wheelrail/wheelrail.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

constexpr std::size_t threads = 4;
constexpr int steps = 60;

// Step i of a wheelset that hunts, its left flange on the rail at times.
WheelsetPosition<double> position(int i) {
  return WheelsetPosition<double>::of(0.0065 * std::sin(0.1 * i), 0.4296, 0.0,
                                      0.004 * std::cos(0.1 * i));
}

// All that many threads may use at once.
template <class Track>
struct Shared {
  Wheelset<PiecewiseProfile<double>> wheelset{s1002<double>(), 0.43, 1.5};
  Track track;
  ContactForceModel<double> model{};

  // The forces of all steps, with a search of its own.
  template <class Search>
  [[nodiscard]] std::vector<double> run(Search&& search) const {
    const WheelsetMotion<double> motion{{10, 0, 0}, {0, 10 / 0.43, 0}};
    std::vector<double> all;
    for (int i = 0; i < steps; ++i) {
      auto at = position(i);
      at.position_track.x() = at.arc_length = 30 + 0.01 * i;
      const auto forces = wheelset_forces(wheelset, track, at, motion, model, search);
      for (int k = 0; k < 3; ++k) all.push_back(forces.force_track(k));
      for (int k = 0; k < 3; ++k) all.push_back(forces.moment_track(k));
    }
    return all;
  }
};

// Runs the same in each of several threads at once.
template <class Result, class Run>
std::array<Result, threads> in_threads(Run&& run) {
  std::array<Result, threads> results;
  std::vector<std::thread> others;
  for (std::size_t i = 0; i < threads; ++i) {
    others.emplace_back([&, i] { results[i] = run(); });
  }
  for (auto& other : others) other.join();
  return results;
}

template <class Track>
void check(const Shared<Track>& shared) {
  const auto alone = shared.run(StripSearch<double>{});
  REQUIRE(alone[2] > 1e4);  // upwards [N]
  for (const auto& result :
       in_threads<std::vector<double>>([&] { return shared.run(StripSearch<double>{}); })) {
    CHECK(result == alone);
  }
  for (const auto& result : in_threads<std::vector<double>>(
           [&] { return shared.run(WarmStripSearch<double>(shared.wheelset)); })) {
    CHECK(result == alone);
  }
}

}  // namespace

TEST_CASE("wheelset_forces: threads that share a wheelset, a track and a model do not race",
          "[wheelset][threads]") {
  check(Shared<TangentTrack<RailHead<double>>>{.track = TangentTrack(uic50<double>())});
}

TEST_CASE("wheelset_forces: threads on a curved track do not race", "[wheelset][threads]") {
  const CentreLine<double> line({{.kind = SegmentKind::tangent, .length = 100}});
  check(Shared<NodalTrack<RailHead<double>>>{
      .track = NodalTrack<RailHead<double>>(uic50<double>(), line)});
}

TEST_CASE("find_contacts: its own threads do not race", "[contact][threads]") {
  const Wheel wheel(s1002<double>(), 0.43);
  const TangentTrack track(uic50<double>());
  const Wheelset wheelset(s1002<double>(), 0.43, 1.5);
  PlacementBatch<double> batch;
  for (int i = 0; i < 200; ++i) {
    batch.push_back(place_wheel(wheelset, track, Side::left, position(i)));
  }
  const Rail<RailHead<double>>& rail = track.rail(Side::left);
  const auto alone = find_contacts(wheel, rail, batch);
  const auto together = find_contacts(wheel, rail, batch, {}, 4);
  REQUIRE(alone.size() == 200);
  int patches = 0;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    REQUIRE(alone[i].patches.size() == together[i].patches.size());
    for (std::size_t k = 0; k < alone[i].patches.size(); ++k) {
      CHECK(alone[i].patches[k].penetration == together[i].patches[k].penetration);
      ++patches;
    }
  }
  CHECK(patches > 100);
}
