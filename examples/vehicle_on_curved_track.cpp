// A vehicle of eleven bodies through a curve (§6.3 of the paper).

#include "support/curve.hpp"
#include "support/vehicle_main.hpp"

int main(int argc, char** argv) {
  const auto options = examples::vehicle_options(
      "41", {{"--approach", "M", "102", "tangent before the curve [m]"},
             {"--transition", "M", "60", "length of each clothoid, with the cant's ramp [m]"},
             {"--arc", "M", "462", "length of the arc [m]"},
             {"--radius", "M", "300", "of the curve, to the left [m]"},
             {"--cant", "M", "0.12", "of the right rail over the left in the arc [m]"},
             {"--departure", "M", "140", "tangent behind the curve [m]"}});
  const examples::Arguments arguments(
      "Runs a trailer vehicle of two bogies and a carbody through a left curve (the paper's third\n"
      "case), started off centre and just above the rails, and prints a summary. With --output "
      "also\n"
      "writes time_series.csv, patches.csv (leading wheelset) and summary.txt; SI units.\n"
      "Exit code 0; 2 on bad input, 3 when searches or the integration failed or a wheel left its\n"
      "rail: then what was computed is kept.",
      options);
  return examples::run(argc, argv, arguments, [](const examples::Arguments& given) {
    const auto vehicle =
        examples::build_vehicle(examples::vehicle_data(given), examples::VehicleKind::vehicle);
    const auto track =
        examples::curved_track(examples::rail_profile(given.choice("--rail", examples::rail_names)),
                               {.approach = given.positive("--approach"),
                                .transition = given.positive("--transition"),
                                .arc = given.positive("--arc"),
                                .radius = given.positive("--radius"),
                                .cant = given.within("--cant", 0, 0.25),
                                .departure = given.positive("--departure")},
                               examples::track_dimensions(given));
    auto run = examples::vehicle_case(given);
    run.start = std::max(examples::vehicle_start, examples::overhang(vehicle) + 1);
    run.report_interval = examples::curve_report_interval;
    examples::require_length(track, vehicle, run);
    return run_and_write(given, "vehicle_on_curved_track", vehicle, track, run);
  });
}
