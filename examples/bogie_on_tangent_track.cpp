// A bogie of five bodies on a tangent track (§6.2 of the paper).

#include "support/vehicle_main.hpp"

int main(int argc, char** argv) {
  const examples::Arguments arguments(
      "Runs a bogie of two wheelsets, two axlebox bodies and a frame on a tangent track (the "
      "paper's\n"
      "second case), started off centre and just above the rails, and prints a summary. With\n"
      "--output also writes time_series.csv, patches.csv (leading wheelset) and summary.txt; SI\n"
      "units, track frame: x forward, y left, z up.\n"
      "Exit code 0; 2 on bad input, 3 when searches or the integration failed.",
      examples::vehicle_options("10"));
  return examples::run(argc, argv, arguments, [](const examples::Arguments& given) {
    const auto vehicle =
        examples::build_vehicle(examples::vehicle_data(given), examples::VehicleKind::bogie);
    const wheelrail::TangentTrack track(
        examples::rail_profile(given.choice("--rail", examples::rail_names)),
        examples::track_dimensions(given));
    return run_and_write(given, "bogie_on_tangent_track", vehicle, track,
                         examples::vehicle_case(given));
  });
}
