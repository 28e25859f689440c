// The paper's study: runs its cases in the three scenarios of §6 and writes the tables, the data of
// its figures and a report. Drawn by plots/*.gp; `sh examples/study.sh` does it all.

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "support/arguments.hpp"
#include "support/profiles.hpp"
#include "support/wheelset_output.hpp"

namespace {

using namespace wheelrail;
using examples::append_fields;
using examples::format;
using examples::plain;
using std::filesystem::path;

constexpr double nominal_radius = 0.43;
constexpr double profile_spacing = 1.5;
constexpr double mm = 1e-3;

// Fig. 3: profile, slope, second derivative and curvature of the real and the convex wheel.
std::string profiles_table(const examples::RealWheel& real, const examples::ConvexWheel& convex) {
  std::string text =
      "lateral_mm,real_profile_mm,convex_profile_mm,real_slope,convex_slope,"
      "real_second_derivative_per_mm,convex_second_derivative_per_mm,real_curvature_per_mm,"
      "convex_curvature_per_mm\n";
  for (int i = 0; i <= 2600; ++i) {
    const double u = std::max(-70 * mm + i * 0.05 * mm, real.lower());
    const auto r = real.evaluate(u);
    const auto c = convex.evaluate(u);
    // The paper's ordinate f_w = -(R0 + F), from the axle.
    text += format("%.9g", plain(u / mm));
    append_fields(text, 9,
                  {-(nominal_radius + r.value) / mm, -(nominal_radius + c.value) / mm, -r.slope,
                   -c.slope, -r.second_derivative * mm, -c.second_derivative * mm,
                   curvature(r) * mm, curvature(c) * mm});
    text += "\n";
  }
  return text;
}

// Fig. 7: the residual of the minimum distance equations over both lateral parameters, in the plane
// (no yaw), around the contact of a wheelset that was set down `lateral_shift` to the left.
struct ResidualMap {
  std::string residual;  // a gnuplot grid
  std::string outlines;  // wheel and rail in the rail's frame
};

ResidualMap residual_map(const Wheelset<examples::RealWheel>& wheelset,
                         const TangentTrack<examples::RailHead>& track, double lateral_shift) {
  const auto set_down = touching_position(wheelset, track, lateral_shift);
  const auto& contact = set_down.patches[index_of(Side::left)];
  const auto placement = place_wheel(wheelset, track, Side::left, set_down.position);
  const auto& wheel = wheelset.wheel(Side::left);
  const auto& rail = track.rail(Side::left);
  ResidualMap map;
  map.residual = "# wheel_lateral_mm rail_lateral_mm log10_residual; contact at " +
                 format("%.6f %.6f\n", contact.wheel_lateral / mm, contact.rail_lateral / mm);
  for (int i = -100; i <= 100; ++i) {
    for (int k = -100; k <= 100; ++k) {
      const double wheel_lateral = contact.wheel_lateral + i * 0.1 * mm;
      const double rail_lateral = contact.rail_lateral + k * 0.1 * mm;
      const bool on_rail =
          rail.profile().lower() <= rail_lateral && rail_lateral <= rail.profile().upper();
      const auto residual = minimum_distance_residual(
          wheel, rail, placement,
          {.rail_lateral = rail_lateral, .wheel_angle = 0, .wheel_lateral = wheel_lateral});
      const double norm = std::hypot(residual(0), residual(2));  // [m] and [-], as the paper
      map.residual += on_rail ? format("%.4f %.4f %.6f\n", wheel_lateral / mm, rail_lateral / mm,
                                       std::log10(std::max(norm, 1e-8)))
                              : format("%.4f %.4f NaN\n", wheel_lateral / mm, rail_lateral / mm);
    }
    map.residual += "\n";
  }
  map.outlines = "# y_mm z_mm of the rail, then of the wheel, then the contact point\n";
  for (int i = 0; i <= 700; ++i) {
    const double u =
        rail.profile().lower() + (rail.profile().upper() - rail.profile().lower()) * i / 700.0;
    map.outlines += format("%.5f %.5f\n", u / mm, rail.profile().evaluate(u).value / mm);
  }
  map.outlines += "\n\n";
  const auto& profile = wheel.profile();
  for (int i = 0; i <= 1300; ++i) {
    const double u = profile.lower() + (profile.upper() - profile.lower()) * i / 1300.0;
    const auto locus = locus_point(wheel, placement, u, profile.evaluate(u));
    map.outlines += format("%.5f %.5f\n", locus.lateral / mm, locus.up / mm);
  }
  map.outlines +=
      format("\n\n%.5f %.5f\n", contact.position_rail.y() / mm, contact.position_rail.z() / mm);
  return map;
}

struct Scenario {
  std::string name;
  std::string title;
  examples::WheelsetHistory history;
};

// Greatest distance of two runs' lateral shifts at equal times [m].
double greatest_difference(const examples::WheelsetHistory& a, const examples::WheelsetHistory& b) {
  double greatest = 0;
  for (std::size_t i = 0; i < std::min(a.records.size(), b.records.size()); ++i) {
    greatest =
        std::max(greatest, std::abs(a.records[i].lateral_shift() - b.records[i].lateral_shift()));
  }
  return greatest;
}

// The data of Figs. 12 and 14: all scenarios over time.
std::string comparison_table(const std::vector<Scenario>& scenarios) {
  std::string text = "time";
  for (const Scenario& s : scenarios) {
    text += "," + s.name + "_lateral_shift_mm," + s.name + "_left_normal_force_kN";
  }
  text += "\n";
  std::size_t rows = scenarios.front().history.records.size();
  for (const Scenario& s : scenarios) rows = std::min(rows, s.history.records.size());
  for (std::size_t i = 0; i < rows; ++i) {
    text += format("%.6g", scenarios.front().history.records[i].time);
    for (const Scenario& s : scenarios) {
      const auto& record = s.history.records[i];
      append_fields(text, 15, {record.lateral_shift() / mm});
      append_fields(text, 12, {1e-3 * examples::normal_force_of(record.forces.wheel(Side::left))});
    }
    text += "\n";
  }
  return text;
}

// Fig. 13: the left wheel's contact point every 0.05 s.
std::string contact_points_table(const examples::WheelsetHistory& history) {
  std::string text = "time,wheel_lateral_mm,profile_mm,rail_lateral_mm\n";
  for (std::size_t i = 0; i < history.records.size(); i += 50) {
    for (const auto& force : history.records[i].forces.wheel(Side::left).patches) {
      text += format("%.6g", history.records[i].time);
      append_fields(text, 9,
                    {force.patch.wheel_lateral / mm, -force.patch.rolling_radius / mm,
                     force.patch.rail_lateral / mm});
      text += "\n";
    }
  }
  return text;
}

std::string report(const std::vector<Scenario>& scenarios, const examples::WheelsetCase& run) {
  std::string text = "# The three-case study: wheelset on a tangent track\n\n";
  text += format(
      "S1002 wheels on UIC50 rails (an assumed 50E4 head), nominal radius 0.43 m, gauge 1.435 m, "
      "inclination 1/20; start %g mm off centre at %g m/s, %g s; wheelset %g kg, %g and %g kg m2 "
      "(assumed numbers of a light metro trailer); tolerances %g, steps of at most %g ms.\n\n",
      run.lateral_shift / mm, run.speed, run.duration, run.mass, run.roll_inertia, run.spin_inertia,
      run.integrator.relative_tolerance, run.integrator.maximum_step / mm);
  text +=
      "| scenario | hunting wavelength [m] | contact on the left rail [mm] | on the left wheel "
      "[mm] | steps | searches | evaluations per search | failed | time [s] | real-time factor | "
      "time ratio |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
  const double reference = scenarios.front().history.seconds;
  for (const Scenario& s : scenarios) {
    const auto& h = s.history;
    const auto rail =
        examples::range_of(h, Side::left, [](const auto& patch) { return patch.rail_lateral; });
    const auto wheel =
        examples::range_of(h, Side::left, [](const auto& patch) { return patch.wheel_lateral; });
    text += format(
        "| %s | %.3f | %.3f to %.3f | %.3f to %.3f | %d | %ld | %.1f | %ld | %.2f | %.1f "
        "| %.2f |\n",
        s.title.c_str(), hunting_wavelength(h), rail.least / mm, rail.greatest / mm,
        wheel.least / mm, wheel.greatest / mm, h.steps, h.searches,
        static_cast<double>(h.evaluations) / static_cast<double>(h.searches), h.failures, h.seconds,
        h.end_time / h.seconds, h.seconds / reference);
  }
  const double apart = greatest_difference(scenarios[0].history, scenarios[1].history);
  text += format(
      "\nConvex profile, strips against minimum distance: lateral shifts at most %.3g nm apart "
      "over the run (the paper: less than 10 nm almost at its end).%s\n\n",
      1e9 * apart,
      apart < 1e-12 ? " Both searches are exact to rounding, and rounding is what is left." : "");
  text +=
      "Kinematic wavelengths of this set-up at 2 mm, from rigid contact: 35.9 m (real) and 38.4 m "
      "(convex). The paper's time ratios (Table 3): 1.00, 2.39, 2.41. Evaluations: strips and "
      "Newton systems. The real-time factor is simulated over elapsed time; times are of one run "
      "and differ from run to run, ratios less so.\n\n"
      "![Fig. 12](fig12_lateral_position.png)\n![Fig. 13](fig13_contact_points.png)\n"
      "![Fig. 14](fig14_normal_force.png)\n![Fig. 3](fig03_profiles.png)\n"
      "![Fig. 7](fig07_residuals.png)\n";
  return text;
}

int study(const examples::Arguments& given) {
  examples::WheelsetCase run;
  run.duration = given.within("--duration", 1e-4, 100);
  const path output = examples::prepare_directory(given.text("--output"));
  const examples::RealWheel real = s1002<double>();
  const examples::ConvexWheel convex(real);
  const TangentTrack track(uic50<double>());
  const Wheelset real_wheelset(real, nominal_radius, profile_spacing);
  const Wheelset convex_wheelset(convex, nominal_radius, profile_spacing);
  const ContactForceModel<double> model;
  const StripSearch<double> strips;
  const MinimumDistanceSearch<double> minimum_distance{convex_parts(convex), {}};

  std::vector<Scenario> scenarios;
  int finished = 0;
  const auto add = [&](const char* name, const char* title, const auto& wheelset,
                       const auto& search) {
    int shown = -1;
    // On a terminal a line that counts on; in a log a line for every tenth.
    const bool terminal = isatty(STDERR_FILENO) != 0;
    const auto progress = [&](double t) {
      const int percent = static_cast<int>(100 * (finished + t / run.duration) / 3);
      if (percent == shown || (!terminal && percent / 10 == shown / 10 && shown >= 0)) return;
      shown = percent;
      std::fprintf(stderr, "%swheelset on a tangent track: %3d %% (%s)%s", terminal ? "\r" : "",
                   percent, title, terminal ? "          " : "\n");
      std::fflush(stderr);
    };
    auto history = run_wheelset(wheelset, track, model, search, run, progress);
    examples::write_file(output / (std::string("wheelset_") + name + ".csv"),
                         time_series_csv(history, run));
    examples::write_file(output / (std::string("wheelset_") + name + "_patches.csv"),
                         patches_csv(history));
    scenarios.push_back({name, title, std::move(history)});
    ++finished;
  };
  add("convex_minimum_distance", "convex, minimum distance", convex_wheelset, minimum_distance);
  add("convex_strips", "convex, strips", convex_wheelset, strips);
  add("real_strips", "real, strips", real_wheelset, strips);
  if (isatty(STDERR_FILENO) != 0) std::fprintf(stderr, "\n");

  examples::write_file(output / "fig03_profiles.csv", profiles_table(real, convex));
  const auto tread = residual_map(real_wheelset, track, 0.0);
  const auto fillet = residual_map(real_wheelset, track, 0.006);
  examples::write_file(output / "fig07_tread_residual.dat", tread.residual);
  examples::write_file(output / "fig07_tread_outlines.dat", tread.outlines);
  examples::write_file(output / "fig07_fillet_residual.dat", fillet.residual);
  examples::write_file(output / "fig07_fillet_outlines.dat", fillet.outlines);
  examples::write_file(output / "fig12_fig14_wheelset.csv", comparison_table(scenarios));
  examples::write_file(output / "fig13_convex.csv", contact_points_table(scenarios[1].history));
  examples::write_file(output / "fig13_real.csv", contact_points_table(scenarios[2].history));
  const std::string text = report(scenarios, run);
  examples::write_file(output / "report.md", text);
  std::fputs(text.c_str(), stdout);
  for (const Scenario& s : scenarios) {
    if (s.history.failures > 0 || s.history.status != IntegrationStatus::finished) {
      std::fprintf(stderr, "study: %s: %s, %ld failed searches\n", s.name.c_str(),
                   name_of(s.history.status), s.history.failures);
      return 3;
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  examples::Arguments arguments(
      "Runs the paper's wheelset case in its three scenarios (convex profile with the minimum\n"
      "distance method, convex with strips, real with strips) and writes the tables, the data of\n"
      "Figs. 3, 7, 12, 13 and 14 and report.md. examples/study.sh draws the figures.",
      {{"--output", "DIR", "build/study", "where everything goes; made if need be"},
       {"--duration", "S", "10", "of each run [s], 0.0001 to 100"}});
  return examples::run(argc, argv, arguments, study);
}
