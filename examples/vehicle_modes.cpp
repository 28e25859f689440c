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

std::string modes_table(const CarbodyModes& modes, const ClosedForms& forms) {
  std::string text =
      "| mode       | undamped [Hz] | closed form [Hz] | rigid frames [Hz] | damped [Hz] "
      "| closed form [Hz] | damping ratio | closed form | rotation centre [m] |\n"
      "|------------|--------------:|-----------------:|------------------:|------------:"
      "|-----------------:|--------------:|------------:|--------------------:|\n";
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const ModeValues &mode = modes[i], &form = forms.with_frames[i];
    const std::string centre =
        mode.rotation_centre == 0 ? "" : format("%.3f", mode.rotation_centre);
    text += format(
        "| %-10s | %13.4f | %16.4f | %17.4f | %11.4f | %16.4f | %13.4f | %11.4f "
        "| %19s |\n",
        carbody_mode_names[i], mode.undamped_frequency, form.undamped_frequency,
        forms.rigid[i].undamped_frequency, mode.natural_frequency, form.natural_frequency,
        plain(mode.damping_ratio), plain(form.damping_ratio), centre.c_str());
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
    text +=
        format("| %-10s | %13.4f | %10.2f | %11.4f | %10.2f | %13.4f | %10.2f |\n",
               carbody_mode_names[i], after[i].undamped_frequency,
               percent(after[i].undamped_frequency, before[i].undamped_frequency),
               after[i].natural_frequency,
               percent(after[i].natural_frequency, before[i].natural_frequency),
               after[i].damping_ratio, percent(after[i].damping_ratio, before[i].damping_ratio));
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
      "height above the rail about which the carbody turns [m]. Beside them stand closed forms:\n"
      "equations of two to five coordinates, made on paper; with rigid frames, of one or two. If\n"
      "the data have unconfirmed values, also what these change. Exit code 0; 2 on bad input.",
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
    std::string text = format("mass: %.9g kg\n\n", mass) + modes_table(modes, closed_forms(data));
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
