// The paper's study (§6): a wheelset, a bogie and a vehicle in a curve, each in three scenarios,
// repeated for their times. Writes the tables, the data of Figs. 3, 7 and 12 to 19 and a report.
// Drawn by plots/fig*.gp; `sh examples/study.sh` does it all.

#include <cstdio>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "support/curve.hpp"
#include "support/parallel.hpp"
#include "support/progress.hpp"
#include "support/study_figures.hpp"
#include "support/study_report.hpp"

namespace {

using namespace wheelrail;
using examples::scenarios;
using examples::StudyRun;
using std::filesystem::path;

class Study {
 public:
  explicit Study(const examples::Arguments& given)
      : data_(std::string(WHEELRAIL_VEHICLES_DIR) + "/metro_trailer.csv"),
        bogie_(examples::build_vehicle(data_, examples::VehicleKind::bogie)),
        vehicle_(examples::build_vehicle(data_, examples::VehicleKind::vehicle)) {
    cases_.wheelset.duration = given.within("--wheelset-duration", 1e-4, 100);
    cases_.bogie.duration = given.within("--bogie-duration", 1e-4, 100);
    cases_.vehicle.start = examples::vehicle_start;
    cases_.vehicle.report_interval = examples::curve_report_interval;
    cases_.vehicle.duration = given.within("--vehicle-duration", 1e-4, 41);
    examples::require_length(curve_, vehicle_, cases_.vehicle);
    cases_.repetitions = given.whole("--repetitions", 1, 100);
    cases_.threads = given.whole("--threads", 1, 256);
    output_ = examples::prepare_directory(given.text("--output"));
  }

  [[nodiscard]] int run() {
    simulate();
    cases_.kinematic_wavelengths = {kinematic(convex_wheelset_), kinematic(convex_wheelset_),
                                    kinematic(real_wheelset_)};
    using examples::write_file;
    write_file(output_ / "fig03_profiles.csv",
               examples::profiles_table(real_, convex_, nominal_radius()));
    for (const auto& [name, shift] : {std::pair{"tread", 0.0}, std::pair{"fillet", 0.006}}) {
      const auto map = examples::residual_map(real_wheelset_, track_, shift);
      write_file(output_ / (std::string("fig07_") + name + "_residual.dat"), map.residual);
      write_file(output_ / (std::string("fig07_") + name + "_outlines.dat"), map.outlines);
    }
    write_file(output_ / "fig12_fig14_wheelset.csv", comparison_table(cases_.wheelset_runs));
    write_contact_points("fig13", cases_.wheelset_runs);
    write_file(output_ / "fig15_fig16_bogie.csv", comparison_table(cases_.bogie_runs));
    write_contact_points("fig17", cases_.bogie_runs);
    for (const auto& [name, history] : {std::pair{"fig18_convex", &cases_.convex_vehicle},
                                        std::pair{"fig19_real", &cases_.real_vehicle}}) {
      write_file(output_ / (std::string(name) + "_patches.csv"),
                 examples::outer_wheel_table(*history));
      write_file(output_ / (std::string(name) + "_ellipses.dat"),
                 examples::ellipses_table(*history));
    }
    const std::string text = examples::study_report(cases_);
    write_file(output_ / "report.md", text);
    std::fputs(text.c_str(), stdout);
    return exit_code();
  }

 private:
  [[nodiscard]] double nominal_radius() const { return vehicle_.wheel_radius; }

  template <class WheelProfile>
  [[nodiscard]] double kinematic(const Wheelset<WheelProfile>& wheelset) const {
    return examples::kinematic_wavelength(wheelset, track_, cases_.wheelset.lateral_shift);
  }

  void write_contact_points(const std::string& figure, const examples::StudyRuns& runs) const {
    examples::write_file(output_ / (figure + "_convex.csv"),
                         contact_points_table(runs[1], convex_, nominal_radius()));
    examples::write_file(output_ / (figure + "_real.csv"),
                         contact_points_table(runs[2], real_, nominal_radius()));
  }

  // Calls body(wheelset, search) with what scenario `s` has.
  template <class Body>
  void with_scenario(std::size_t s, Body&& body) const {
    if (s == 0) body(convex_wheelset_, WarmMinimumDistanceSearch<double>(convex_wheelset_));
    if (s == 1)
      body(convex_wheelset_, WarmStripSearch<double>(convex_wheelset_, {.zone_ends = false}));
    if (s == 2) body(real_wheelset_, WarmStripSearch<double>(real_wheelset_, {.zone_ends = false}));
  }

  // Adds what repetition `r` of one scenario gave; its tables are written by the first one.
  template <class History, class Tables>
  void take(StudyRun& run, int r, History history, const Tables& write_tables) {
    if (r == 0) write_tables(history);
    StudyRun result = examples::study_run(history);
    const std::lock_guard lock(mutex_);
    run.seconds.push_back(history.seconds);
    if (run.samples.empty()) {
      result.seconds = run.seconds;
      run = std::move(result);
    } else {
      run.repeats = run.repeats && run.fingerprint == result.fingerprint;
    }
  }

  void write_tables(const std::string& name, const std::string& time_series,
                    const std::string& patches) const {
    examples::write_file(output_ / (name + ".csv"), time_series);
    examples::write_file(output_ / (name + "_patches.csv"), patches);
  }

  void run_wheelset_case(std::size_t s, int r, const std::function<void(double)>& progress) {
    with_scenario(s, [&](const auto& wheelset, const auto& search) {
      take(cases_.wheelset_runs[s], r,
           run_wheelset(wheelset, track_, model_, search, cases_.wheelset, progress),
           [&](const examples::WheelsetHistory& history) {
             write_tables(std::string("wheelset_") + scenarios[s].name,
                          time_series_csv(history, cases_.wheelset), patches_csv(history));
             cases_.wavelengths[s] = hunting_wavelength(history);
           });
    });
  }

  template <class Track>
  void run_vehicle_case(const char* name, const examples::Vehicle& vehicle, const Track& track,
                        const examples::VehicleCase& run, examples::StudyRuns& runs, std::size_t s,
                        int r, const std::function<void(double)>& progress) {
    with_scenario(s, [&](const auto& wheelset, const auto& search) {
      take(runs[s], r, run_vehicle(vehicle, wheelset, track, model_, search, run, progress),
           [&](examples::VehicleHistory& history) {
             write_tables(std::string(name) + "_" + scenarios[s].name,
                          time_series_csv(history, vehicle), patches_csv(history));
             if (&runs != &cases_.vehicle_runs) return;
             if (s == 1) cases_.convex_vehicle = history;
             if (s == 2) cases_.real_vehicle = history;
           });
    });
  }

  // All runs in a fixed order, those that are compared next to each other.
  void simulate() {
    std::vector<double> weights;
    std::vector<std::string> names;
    std::vector<std::function<void(const std::function<void(double)>&)>> runs;
    const auto add = [&](double weight, const std::string& name, auto run) {
      weights.push_back(weight);
      names.push_back(name);
      runs.push_back(run);
    };
    for (int r = 0; r < cases_.repetitions; ++r) {
      for (std::size_t s = 0; s < scenarios.size(); ++s) {
        const std::string suffix = std::string(": ") + scenarios[s].title + ", run " +
                                   std::to_string(r + 1) + " of " +
                                   std::to_string(cases_.repetitions);
        // As wheelsets are searched over time; the minimum distance method takes longer.
        const double method = s == 0 ? 1.4 : 1.0;
        add(method * cases_.wheelset.duration, "wheelset" + suffix,
            [this, s, r](const auto& progress) { run_wheelset_case(s, r, progress); });
        add(2 * method * cases_.bogie.duration, "bogie" + suffix,
            [this, s, r](const auto& progress) {
              run_vehicle_case("bogie", bogie_, track_, cases_.bogie, cases_.bogie_runs, s, r,
                               progress);
            });
        add(4 * method * cases_.vehicle.duration, "vehicle" + suffix,
            [this, s, r](const auto& progress) {
              run_vehicle_case("vehicle", vehicle_, curve_, cases_.vehicle, cases_.vehicle_runs, s,
                               r, progress);
            });
      }
    }
    const double durations[] = {cases_.wheelset.duration, cases_.bogie.duration,
                                cases_.vehicle.duration};
    examples::Progress progress(weights);
    std::vector<std::function<void()>> jobs;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      jobs.push_back([&, i] {
        runs[i]([&](double t) { progress.report(i, t / durations[i % 3], names[i]); });
        progress.report(i, 1, names[i]);
      });
    }
    examples::run_jobs(jobs, cases_.threads);
  }

  // 3 when a run failed, or was not the same again.
  [[nodiscard]] int exit_code() const {
    int code = 0;
    for (const examples::StudyCase& c : examples::study_cases(cases_)) {
      for (std::size_t s = 0; s < scenarios.size(); ++s) {
        const StudyRun& run = (*c.runs)[s];
        if (run.failures == 0 && run.status == IntegrationStatus::finished && run.repeats) continue;
        std::fprintf(stderr, "three_case_study: %s, %s: %s, %ld failed searches%s\n", c.title,
                     scenarios[s].title, name_of(run.status), run.failures,
                     run.repeats ? "" : ", and not the same when repeated");
        code = 3;
      }
    }
    return code;
  }

  path output_;
  examples::VehicleData data_;
  examples::Vehicle bogie_, vehicle_;
  examples::RealWheel real_ = s1002<double>();
  examples::ConvexWheel convex_{real_};
  TangentTrack<examples::RailHead> track_{uic50<double>()};
  NodalTrack<examples::RailHead> curve_ = examples::curved_track(uic50<double>(), {}, {});
  Wheelset<examples::RealWheel> real_wheelset_{real_, nominal_radius(), vehicle_.profile_spacing};
  Wheelset<examples::ConvexWheel> convex_wheelset_{convex_, nominal_radius(),
                                                   vehicle_.profile_spacing};
  ContactForceModel<double> model_;
  examples::StudyCases cases_;
  std::mutex mutex_;
};

}  // namespace

int main(int argc, char** argv) {
  examples::Arguments arguments(
      "Runs the paper's three cases - a wheelset and a bogie on a tangent track, a vehicle in a\n"
      "curve - in its three scenarios (convex profile with the minimum distance method, convex\n"
      "with strips, S1002 with strips) and writes the tables, the data of Figs. 3, 7 and 12 to 19\n"
      "and report.md. examples/study.sh draws the figures. Times are processor times of a run's\n"
      "thread; results are the same for any number of threads.\n"
      "Exit code 0; 2 on bad input, 3 when a run failed.",
      {{"--output", "DIR", "build/study", "where everything goes; made if need be"},
       {"--wheelset-duration", "S", "10", "of the first case's runs [s], 0.0001 to 100"},
       {"--bogie-duration", "S", "10", "of the second case's runs [s], 0.0001 to 100"},
       {"--vehicle-duration", "S", "41", "of the third case's runs [s], 0.0001 to 41"},
       {"--repetitions", "N", "3", "of each run, for the median of its times, 1 to 100"},
       {"--threads", "N", "1", "runs at a time, 1 to 256"}});
  return examples::run(argc, argv, arguments,
                       [](const examples::Arguments& given) { return Study(given).run(); });
}
