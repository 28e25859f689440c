// A single wheelset on a tangent track (§6.1 of the paper): runs it, writes its tables and prints a
// summary.

#include <cstdio>

#include "support/run_options.hpp"
#include "support/wheelset_output.hpp"

namespace {

using wheelrail::Side;

template <class WheelProfile>
int simulate(const examples::Arguments& given, const WheelProfile& profile) {
  const wheelrail::Wheelset wheelset(profile, given.positive("--nominal-radius"),
                                     given.positive("--profile-spacing"));
  const wheelrail::TangentTrack track(
      examples::rail_profile(given.choice("--rail", examples::rail_names)),
      examples::track_dimensions(given));
  wheelrail::require_fit(wheelset, track);
  const auto model = examples::force_model(given);
  examples::WheelsetCase run;
  examples::set_run(run, given);
  run.lateral_shift = given.number("--lateral-shift");
  run.yaw = given.within("--yaw", -0.1, 0.1);
  run.mass = given.positive("--mass");
  run.roll_inertia = given.positive("--roll-inertia");
  run.spin_inertia = given.positive("--spin-inertia");
  // The moments about x and z are both the roll inertia: what is left of the triangle inequality.
  if (run.spin_inertia > 2 * run.roll_inertia) {
    throw std::invalid_argument(
        "--spin-inertia is " + given.text("--spin-inertia") +
        ", but must be at most twice --roll-inertia, which is " + given.text("--roll-inertia") +
        ": no body has a moment of inertia greater than the sum of its other two");
  }
  const std::string method = given.choice("--method", examples::method_names);
  std::filesystem::path output;
  const auto history = examples::with_warm_search(method, wheelset, [&](const auto& search) {
    // Throws where the start is impossible: before a directory is made.
    static_cast<void>(examples::WheelsetOnTrack(wheelset, track, model, search, run).start(run));
    if (given.given("--output")) output = examples::prepare_directory(given.text("--output"));
    return run_wheelset(wheelset, track, model, search, run);
  });
  const std::string summary = examples::run_summary(given) + examples::summary(history);
  if (!output.empty()) {
    examples::write_file(output / "time_series.csv", time_series_csv(history, run));
    examples::write_file(output / "patches.csv", patches_csv(history));
    examples::write_file(output / "summary.txt", summary);
  }
  std::fputs(summary.c_str(), stdout);
  if (history.failures > 0) {
    std::fprintf(
        stderr, "wheelset_on_tangent_track: %ld of %ld contact searches did not converge%s\n",
        history.failures, history.searches,
        method == "minimum-distance" ? ": the minimum distance method needs a convex wheel" : "");
  }
  if (history.status != wheelrail::IntegrationStatus::finished) {
    std::fprintf(stderr, "wheelset_on_tangent_track: the run stopped at %.6g s: %s\n",
                 history.end_time, name_of(history.status));
  }
  // Not timed: what the minimum distance method missed on a wheel that is not convex.
  std::size_t incomplete = 0;
  if (method == "minimum-distance" && !wheelrail::concave_intervals(profile).empty()) {
    for (const auto& record : history.records) {
      const wheelrail::WheelsetPosition<double> at{record.state.position_world, record.axle_track};
      bool same = true;
      for (const Side side : wheelrail::sides) {
        const auto placement = place_wheel(wheelset, track, side, at);
        const auto all = find_contact(wheelset.wheel(side), track.rail(side), placement);
        same = same && examples::same_patches(record.forces.wheel(side).patches, all.patches);
      }
      incomplete += same ? 0U : 1U;
    }
  }
  if (incomplete > 0) {
    std::fprintf(stderr,
                 "wheelset_on_tangent_track: at %zu of %zu instants the minimum distance method "
                 "missed a patch: it needs a convex wheel\n",
                 incomplete, history.records.size());
  }
  const bool good = history.failures == 0 && incomplete == 0 &&
                    history.status == wheelrail::IntegrationStatus::finished;
  return good ? 0 : 3;
}

}  // namespace

int main(int argc, char** argv) {
  examples::Arguments arguments(
      "Runs a single wheelset on a tangent track (the paper's first case), started off centre and\n"
      "just above the rails, and prints a summary. With --output also writes time_series.csv and\n"
      "patches.csv (every 1 ms; SI units, track frame: x forward, y left, z up) and summary.txt.\n"
      "real_time_factor is simulated over elapsed time.\n"
      "Exit code 0; 2 on bad input, 3 when searches or the integration failed.",
      examples::run_options(
          "10", "10",
          {{"--lateral-shift", "M", "0.002",
            "at the start, to the left [m]; no flange may stand on a rail head"},
           {"--yaw", "RAD", "0", "at the start, to the left [rad], -0.1 to 0.1"},
           {"--mass", "KG", "1000", "of the wheelset [kg]"},
           {"--roll-inertia", "KG_M2", "600", "about the longitudinal and vertical axis [kg m2]"},
           {"--spin-inertia", "KG_M2", "80",
            "about the axle [kg m2], at most twice --roll-inertia"},
           {"--nominal-radius", "M", "0.43", "wheel radius at the tread circle [m]"},
           {"--profile-spacing", "M", "1.5", "distance of the wheels' tread circles [m]"}}));
  return examples::run(argc, argv, arguments, [](const examples::Arguments& given) {
    return examples::with_wheel_profile(
        given.choice("--wheel", examples::wheel_names),
        [&](const auto& profile) { return simulate(given, profile); });
  });
}
