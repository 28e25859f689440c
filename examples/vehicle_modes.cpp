// The natural frequencies and damping ratios of a vehicle's carbody.

#include "support/vehicle_modes.hpp"

#include <cmath>
#include <cstdio>
#include <string>

#include "support/arguments.hpp"
#include "support/output.hpp"

namespace {

using namespace examples;

// The change in percent, to two decimals and never -0.
double percent(double value, double reference) {
  return plain(std::round(1e4 * (value / reference - 1)) / 100);
}

std::string damped_frequency(const ModeValues& mode) {
  return mode.damping_ratio < 1 ? format("%.4f", mode.natural_frequency) : "overdamped";
}

// "-" where an overdamped mode has no second motion left to make a ratio of.
std::string damping_ratio(const ModeValues& mode) {
  return std::isnan(mode.damping_ratio) ? "-" : format("%.4f", plain(mode.damping_ratio));
}

std::string modes_table(const CarbodyModes& modes, const ModesByHand& by_hand) {
  std::string text =
      "| mode       | undamped [Hz] | by hand [Hz] | rigid frames [Hz] | damped [Hz] "
      "| by hand [Hz] | damping ratio | by hand | rotation centre [m] |\n"
      "|------------|--------------:|-------------:|------------------:|------------:"
      "|-------------:|--------------:|--------:|--------------------:|\n";
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const ModeValues &mode = modes[i], &hand = by_hand.with_frames[i];
    const std::string centre =
        mode.rotation_centre == 0 ? "" : format("%.3f", mode.rotation_centre);
    text += format("| %-10s | %13.4f | %12.4f | %17.4f | %11s | %12s | %13s | %7s | %19s |\n",
                   carbody_mode_names[i], mode.undamped_frequency, hand.undamped_frequency,
                   by_hand.rigid[i].undamped_frequency, damped_frequency(mode).c_str(),
                   damped_frequency(hand).c_str(), damping_ratio(mode).c_str(),
                   damping_ratio(hand).c_str(), centre.c_str());
  }
  return text;
}

std::string changes_table(const CarbodyModes& before, const CarbodyModes& after) {
  std::string text =
      "| mode       | undamped [Hz] | change [%] | damped [Hz] | change [%] | damping ratio | "
      "change [%] |\n"
      "|------------|--------------:|-----------:|------------:|-----------:|--------------:|"
      "-----------:|\n";
  for (std::size_t i = 0; i < before.size(); ++i) {
    const bool both_oscillate = before[i].damping_ratio < 1 && after[i].damping_ratio < 1;
    const auto change = [&](double value, double reference) {
      return both_oscillate ? format("%.2f", percent(value, reference)) : std::string("-");
    };
    text += format("| %-10s | %13.4f | %10.2f | %11s | %10s | %13s | %10s |\n",
                   carbody_mode_names[i], after[i].undamped_frequency,
                   percent(after[i].undamped_frequency, before[i].undamped_frequency),
                   damped_frequency(after[i]).c_str(),
                   change(after[i].natural_frequency, before[i].natural_frequency).c_str(),
                   damping_ratio(after[i]).c_str(),
                   change(after[i].damping_ratio, before[i].damping_ratio).c_str());
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<Option> options{
      {"--vehicle", "FILE", "", "CSV of quantity,value,unit (default: Manchester vehicle 1)"}};
  const Arguments arguments(
      "Prints the carbody's modes on its suspension, with the wheelsets held: undamped and damped\n"
      "natural frequencies, |eigenvalue| / (2 pi) [Hz], damping ratios [-], and in the sways the\n"
      "height above the rail about which the carbody turns [m]. Beside them the same \"by hand\":\n"
      "eigenvalues of small systems of two to five coordinates, made on paper and solved in\n"
      "numbers; with rigid frames, of one or two. A mode whose oscillation the dampers have ended\n"
      "is overdamped, with a ratio >= 1. If the data have unconfirmed values, also what they\n"
      "change. Exit code 0; 2 on bad input and where springs do not hold the vehicle.",
      options);
  return run(argc, argv, arguments, [](const Arguments& given) {
    const std::string file = given.given("--vehicle")
                                 ? given.text("--vehicle")
                                 : std::string(WHEELRAIL_VEHICLES_DIR) + "/manchester_vehicle1.csv";
    const VehicleData data(file);
    const Vehicle vehicle = build_vehicle(data, VehicleKind::vehicle);
    const CarbodyModes modes = carbody_modes(vehicle);
    double mass = 0;
    for (const auto& body : vehicle.model.bodies) mass += body.mass();
    std::string text = format("mass: %.9g kg\n\n", mass) + modes_table(modes, modes_by_hand(data));
    if (!data.left_out().empty()) {
      text += "\nWith the values that are unconfirmed and were left out so far:\n\n";
      for (const std::string& name : data.left_out()) text += "- " + name + "\n";
      const VehicleData all(file, Unconfirmed::used);
      text += "\n" + changes_table(modes, carbody_modes(build_vehicle(all, VehicleKind::vehicle)));
    }
    std::fputs(text.c_str(), stdout);
    return 0;
  });
}
