#include <wheelrail/profile/convex_modification.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/track/tangent_track.hpp>
#include <wheelrail/wheelset/touching_position.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

const TangentTrack<RailHead<double>>& paper_track() {
  static const TangentTrack<RailHead<double>> track(uic50<double>());
  return track;
}

}  // namespace

// Rigid contact of the paper's set-up (S1002 on UIC50 1:20, gauge 1435, spacing 1500, radius 430),
// computed by an independent program from point lists. Chords of 0.4 mm on the R13 corner, where
// the gauge is measured, put its rails 1.5 um nearer to each other.
TEST_CASE("touching_position: the central contact of the paper's set-up", "[wheelset][reference]") {
  const Wheelset real(s1002<double>(), 0.43, 1.5);
  const Wheelset convex(ConvexModification(s1002<double>()), 0.43, 1.5);
  const auto on_real = touching_position(real, paper_track(), 0.0);
  const auto on_convex = touching_position(convex, paper_track(), 0.0);
  REQUIRE(on_real.status == SolveStatus::converged);
  REQUIRE(on_convex.status == SolveStatus::converged);
  CHECK(on_real.patches[0].wheel_lateral * 1e3 == Approx(12.157).margin(2e-3));
  CHECK(on_convex.patches[0].wheel_lateral * 1e3 == Approx(12.204).margin(2e-3));
  CHECK(on_real.roll == 0.0);
}

TEST_CASE("touching_position: the rolling radii give the paper's conicity at 2 mm",
          "[wheelset][reference]") {
  const auto conicity_of = [](const auto& wheelset) {
    // Quasi-linear over an amplitude of 2 mm: describing function of (r_left - r_right) / 2.
    const int n = 64;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      const double phase = (i + 0.5) * pi<double>() / n;
      const double shift = 0.002 * std::cos(phase);
      const auto at = touching_position(wheelset, paper_track(), shift);
      REQUIRE(at.status == SolveStatus::converged);
      sum += (at.patches[0].rolling_radius - at.patches[1].rolling_radius) / 2 * std::cos(phase);
    }
    return 2 * sum / n / 0.002;
  };
  CHECK(conicity_of(Wheelset(s1002<double>(), 0.43, 1.5)) == Approx(0.01005).epsilon(0.02));
  CHECK(conicity_of(Wheelset(ConvexModification(s1002<double>()), 0.43, 1.5)) ==
        Approx(0.00877).epsilon(0.02));
}

TEST_CASE("touching_position: both wheels are at the gap that was asked for", "[wheelset]") {
  const Wheelset wheelset(s1002<double>(), 0.43, 1.5);
  for (const double gap : {1e-6, -1e-9, -50e-6}) {
    for (const double yaw : {0.0, 0.02}) {
      for (const double shift : {-0.004, 0.0, 0.003, 0.0055}) {
        CAPTURE(gap, yaw, shift);
        const auto at = touching_position(wheelset, paper_track(), shift, yaw, {.gap = gap});
        REQUIRE(at.status == SolveStatus::converged);
        for (const Side side : sides) {
          const auto placement = place_wheel(wheelset, paper_track(), side, at.position);
          const auto found =
              find_contact(wheelset.wheel(side), paper_track().rail(side), placement);
          const bool touches = gap < 0;
          REQUIRE(found.patches.empty() != touches);
          if (!touches) continue;
          double deepest = 0;
          for (const auto& patch : found.patches) deepest = std::max(deepest, patch.penetration);
          CHECK(deepest == Approx(-gap).margin(1e-12));
        }
      }
    }
  }
}

TEST_CASE("touching_position: a mirrored shift gives the mirrored position to the last bit",
          "[wheelset][symmetry]") {
  const Wheelset wheelset(s1002<double>(), 0.43, 1.5);
  const auto at = touching_position(wheelset, paper_track(), 0.0031, 0.01);
  const auto mirrored = touching_position(wheelset, paper_track(), -0.0031, -0.01);
  CHECK(at.height == mirrored.height);
  CHECK(at.roll == -mirrored.roll);
  CHECK(at.patches[0].wheel_lateral == mirrored.patches[1].wheel_lateral);
}

TEST_CASE("touching_position: NaN gives a status, not a position", "[wheelset][bad-input]") {
  const Wheelset wheelset(s1002<double>(), 0.43, 1.5);
  CHECK(touching_position(wheelset, paper_track(), std::nan("")).status == SolveStatus::not_finite);
  CHECK(touching_position(wheelset, paper_track(), 10.0).status != SolveStatus::converged);
}
