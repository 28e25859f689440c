#pragma once
// The options that every run on a track has, and what they make.

#include <string>
#include <vector>

#include "arguments.hpp"
#include "profiles.hpp"

namespace examples {

// All options of a program: those of every run, with `own` between what is run and how.
[[nodiscard]] inline std::vector<Option> run_options(const std::string& speed,
                                                     const std::string& duration,
                                                     const std::vector<Option>& own) {
  std::vector<Option> all{
      {"--wheel", "NAME", "s1002", "wheel profile: s1002 or s1002-convex"},
      {"--rail", "NAME", "uic50", "rail profile: uic50 (an assumed 50E4 head) or 60e1"},
      {"--method", "NAME", "strip", "contact search: strip or minimum-distance"},
      {"--speed", "M/S", speed, "forward speed at the start [m/s]"},
      {"--duration", "S", duration, "of the run [s], 0.0001 to 100"},
      {"--output", "DIR", "", "where the tables go; made if need be; nothing is written without"}};
  all.insert(all.end(), own.begin(), own.end());
  const std::vector<Option> how{
      {"--friction", "MU", "0.25", "friction coefficient [-]"},
      {"--restitution", "CE", "0.75", "ratio of opening to closing normal force, c_e [-]"},
      {"--gauge", "M", "1.435", "track gauge, 14 mm below the rails' highest points [m]"},
      {"--inclination", "SLOPE", "0.05", "rail inclination towards the track's middle [-]"},
      {"--tolerance", "TOL", "1e-5",
       "relative and absolute tolerance of the integrator [-], 1e-13 to 0.01"},
      {"--maximum-step", "S", "0.001", "longest step of the integrator [s]"}};
  all.insert(all.end(), how.begin(), how.end());
  return all;
}

[[nodiscard]] inline wheelrail::ContactForceModel<double> force_model(const Arguments& given) {
  wheelrail::ContactForceOptions<double> options;
  options.friction_coefficient = given.number("--friction");
  options.normal.restitution_force_ratio = given.number("--restitution");
  return wheelrail::ContactForceModel<double>(options);
}

[[nodiscard]] inline wheelrail::TrackDimensions<double> track_dimensions(const Arguments& given) {
  return {.gauge = given.positive("--gauge"), .inclination = given.number("--inclination")};
}

// Speed, duration and integrator of a WheelsetCase or VehicleCase.
template <class Case>
void set_run(Case& run, const Arguments& given) {
  run.speed = given.positive("--speed");
  run.duration = given.within("--duration", 1e-4, 100);
  run.integrator.relative_tolerance = run.integrator.absolute_tolerance =
      given.within("--tolerance", 1e-13, 1e-2);
  run.integrator.maximum_step = given.positive("--maximum-step");
}

// What a run used, as the head of its summary.
[[nodiscard]] inline std::string run_summary(const Arguments& given) {
  return "wheel: " + given.text("--wheel") + "\nrail: " + given.text("--rail") +
         "\nmethod: " + given.text("--method") + "\n";
}

}  // namespace examples
