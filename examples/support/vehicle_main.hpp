#pragma once
// What the bogie's and the vehicle's programs have in common: options, the run, the files.

#include <cstdio>
#include <string>
#include <vector>

#include "run_options.hpp"
#include "vehicle_output.hpp"

namespace examples {

// With `layout`, the options of a track.
[[nodiscard]] inline std::vector<Option> vehicle_options(const std::string& duration,
                                                         const std::vector<Option>& layout = {}) {
  std::vector<Option> own{
      {"--vehicle", "FILE", "", "CSV of quantity,value,unit (default: the light metro trailer)"},
      {"--unconfirmed", "NAME", "no", "yes: also with values that the data mark as unconfirmed"},
      {"--lateral-shift", "M", "0.002", "of all bodies at the start, to the left [m]"}};
  own.insert(own.end(), layout.begin(), layout.end());
  return run_options("18.3", duration, own);
}

[[nodiscard]] inline std::string vehicle_file(const Arguments& given) {
  return given.given("--vehicle") ? given.text("--vehicle")
                                  : std::string(WHEELRAIL_VEHICLES_DIR) + "/metro_trailer.csv";
}

[[nodiscard]] inline VehicleData vehicle_data(const Arguments& given) {
  const bool all = given.choice("--unconfirmed", {"no", "yes"}) == "yes";
  return VehicleData(vehicle_file(given), all ? Unconfirmed::used : Unconfirmed::left_out);
}

// Which vehicle a run has, as the head of its summary.
[[nodiscard]] inline std::string vehicle_summary(const Arguments& given) {
  const std::size_t count = vehicle_data(given).left_out().size();
  std::string text = "vehicle: " + vehicle_file(given) + "\n";
  if (count > 0) {
    text += "left_out: " + std::to_string(count) +
            (count == 1 ? " unconfirmed quantity\n" : " unconfirmed quantities\n");
  }
  return text;
}

[[nodiscard]] inline VehicleCase vehicle_case(const Arguments& given) {
  VehicleCase run;
  set_run(run, given);
  run.lateral_shift = given.within("--lateral-shift", -0.006, 0.006);
  return run;
}

// Runs, writes and prints. Returns the exit code.
template <class Track>
[[nodiscard]] int run_and_write(const Arguments& given, const char* program, const Vehicle& vehicle,
                                const Track& track, const VehicleCase& run) {
  const auto model = force_model(given);
  const std::string method = given.choice("--method", method_names);
  const std::string head = vehicle_summary(given) + run_summary(given);
  return with_wheel_profile(given.choice("--wheel", wheel_names), [&](const auto& profile) {
    const wheelrail::Wheelset wheelset(profile, vehicle.wheel_radius, vehicle.profile_spacing);
    require_fit(wheelset, track);
    std::filesystem::path output;
    if (given.given("--output")) output = prepare_directory(given.text("--output"));
    const VehicleHistory history = with_warm_search(method, wheelset, [&](const auto& search) {
      return run_vehicle(vehicle, wheelset, track, model, search, run);
    });
    const std::string text = head + summary(history);
    if (!output.empty()) {
      write_file(output / "time_series.csv", time_series_csv(history, vehicle));
      write_file(output / "patches.csv", patches_csv(history));
      write_file(output / "summary.txt", text);
    }
    std::fputs(text.c_str(), stdout);
    if (history.derailment) {
      std::fprintf(stderr, "%s: %s\n", program, history.derailment->c_str());
    } else if (history.status != wheelrail::IntegrationStatus::finished) {
      std::fprintf(stderr, "%s: the run stopped at %.6g s: %s\n", program, history.end_time,
                   name_of(history.status));
      if (history.failed_search) {
        std::fprintf(stderr, "%s: %s\n", program, history.failed_search->c_str());
      }
    }
    if (history.failures > 0) {
      std::fprintf(stderr, "%s: %ld of %ld contact searches failed\n", program, history.failures,
                   history.searches);
    }
    const bool good =
        history.failures == 0 && history.status == wheelrail::IntegrationStatus::finished;
    return good ? 0 : 3;
  });
}

}  // namespace examples
