#pragma once
// What the bogie's and the vehicle's programs have in common: options, the run, the files.

#include <cstdio>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "profiles.hpp"
#include "vehicle_output.hpp"

namespace examples {

[[nodiscard]] inline std::vector<Option> vehicle_options(const std::string& duration) {
  return {
      {"--wheel", "NAME", "s1002", "wheel profile: s1002 or s1002-convex"},
      {"--rail", "NAME", "uic50", "rail profile: uic50 (an assumed 50E4 head) or 60e1"},
      {"--method", "NAME", "strip", "contact search: strip or minimum-distance"},
      {"--vehicle", "FILE", "", "CSV of quantity,value,unit (default: the light metro trailer)"},
      {"--speed", "M/S", "18.3", "forward speed at the start [m/s]"},
      {"--duration", "S", duration, "of the run [s], 0.0001 to 100"},
      {"--lateral-shift", "M", "0.002", "of all bodies at the start, to the left [m]"},
      {"--output", "DIR", "", "where the tables go; made if need be; nothing is written without"},
      {"--friction", "MU", "0.25", "friction coefficient [-]"},
      {"--restitution", "CE", "0.75", "ratio of opening to closing normal force, c_e [-]"},
      {"--gauge", "M", "1.435", "track gauge, 14 mm below the rails' highest points [m]"},
      {"--inclination", "SLOPE", "0.05", "rail inclination towards the track's middle [-]"},
      {"--tolerance", "TOL", "1e-5",
       "relative and absolute tolerance of the integrator [-], 1e-13 to 0.01"},
      {"--maximum-step", "S", "0.001", "longest step of the integrator [s]"}};
}

[[nodiscard]] inline std::string vehicle_file(const Arguments& given) {
  return given.given("--vehicle") ? given.text("--vehicle")
                                  : std::string(WHEELRAIL_VEHICLES_DIR) + "/metro_trailer.csv";
}

[[nodiscard]] inline VehicleCase vehicle_case(const Arguments& given) {
  VehicleCase run;
  run.speed = given.positive("--speed");
  run.duration = given.within("--duration", 1e-4, 100);
  run.lateral_shift = given.within("--lateral-shift", -0.006, 0.006);
  run.integrator.relative_tolerance = run.integrator.absolute_tolerance =
      given.within("--tolerance", 1e-13, 1e-2);
  run.integrator.maximum_step = given.positive("--maximum-step");
  return run;
}

// Runs, writes and prints. Returns the exit code.
template <class Track>
[[nodiscard]] int run_and_write(const Arguments& given, const char* program, const Vehicle& vehicle,
                                const Track& track, const VehicleCase& run) {
  wheelrail::ContactForceOptions<double> force;
  force.friction_coefficient = given.number("--friction");
  force.normal.restitution_force_ratio = given.number("--restitution");
  const wheelrail::ContactForceModel<double> model(force);
  const std::string method = given.choice("--method", method_names);
  return with_wheel_profile(given.choice("--wheel", wheel_names), [&](const auto& profile) {
    const wheelrail::Wheelset wheelset(profile, vehicle.wheel_radius, 1.5);
    require_fit(wheelset, track);
    std::filesystem::path output;
    if (given.given("--output")) output = prepare_directory(given.text("--output"));
    const VehicleHistory history = with_search(method, profile, [&](const auto& search) {
      return run_vehicle(vehicle, wheelset, track, model, search, run);
    });
    const std::string text = "wheel: " + given.text("--wheel") + "\nrail: " + given.text("--rail") +
                             "\nmethod: " + method + "\n" + summary(history);
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
