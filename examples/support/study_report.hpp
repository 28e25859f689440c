#pragma once
// The study's report: Table 3 and what the runs show, as Markdown, with what the paper says beside it.

#include <string>
#include <vector>

#include "study_results.hpp"

namespace examples {

// All that the study ran and found.
struct StudyCases {
  WheelsetCase wheelset;
  VehicleCase bogie, vehicle;
  int repetitions = 1, threads = 1;
  StudyRuns wheelset_runs, bogie_runs, vehicle_runs;
  std::array<double, scenarios.size()> wavelengths{};            // of the wheelset's hunting [m]
  std::array<double, scenarios.size()> kinematic_wavelengths{};  // at its lateral shift [m]
  VehicleHistory convex_vehicle, real_vehicle;                   // searched by strips
};

// One row of Table 3.
struct StudyCase {
  const char* title;
  const StudyRuns* runs;
  std::array<double, scenarios.size()> paper_ratios;  // Table 3
};

[[nodiscard]] inline std::array<StudyCase, 3> study_cases(const StudyCases& of) {
  return {{{"wheelset, tangent track", &of.wheelset_runs, {1.00, 2.39, 2.41}},
           {"bogie, tangent track", &of.bogie_runs, {1.00, 2.37, 2.40}},
           {"vehicle, curve", &of.vehicle_runs, {1.00, 2.11, 2.21}}}};
}

namespace detail {

[[nodiscard]] inline std::string time_ratios(const StudyCases& of) {
  std::string text = "## Time ratios (Table 3)\n\n| case |";
  for (const Scenario& s : scenarios) text += std::string(" ") + s.title + " |";
  text += " the paper |\n|---|---|---|---|---|\n";
  for (const StudyCase& c : study_cases(of)) {
    text += std::string("| ") + c.title + " |";
    const double reference = (*c.runs)[0].median_seconds();
    for (const StudyRun& run : *c.runs) text += format(" %.2f |", run.median_seconds() / reference);
    text +=
        format(" %.2f, %.2f, %.2f |\n", c.paper_ratios[0], c.paper_ratios[1], c.paper_ratios[2]);
  }
  text += format(
      "\nRatios of the medians of %d runs in one process, %d at a time; times are processor times "
      "of "
      "a run's thread.\n\n",
      of.repetitions, of.threads);
  text +=
      "| case | scenario | time [s]: median (least to greatest) | real-time factor | steps | "
      "searches | evaluations per search | failed |\n|---|---|---|---|---|---|---|---|\n";
  bool repeats = true;
  for (const StudyCase& c : study_cases(of)) {
    for (std::size_t s = 0; s < scenarios.size(); ++s) {
      const StudyRun& run = (*c.runs)[s];
      const auto [least, greatest] = std::minmax_element(run.seconds.begin(), run.seconds.end());
      text += format("| %s | %s | %.2f (%.2f to %.2f) | %.1f | %d | %ld | %.1f | %ld |\n", c.title,
                     scenarios[s].title, run.median_seconds(), *least, *greatest,
                     run.end_time / run.median_seconds(), run.steps, run.searches,
                     static_cast<double>(run.evaluations) / static_cast<double>(run.searches),
                     run.failures);
      repeats = repeats && run.repeats;
    }
  }
  text +=
      "\nThe real-time factor is simulated time over processor time of one core. Evaluations: "
      "strips "
      "and Newton systems. Searches start from what was found before, those by strips without the "
      "zones' ends.";
  if (of.repetitions > 1) {
    text += repeats ? " Every repetition gave the same motion and forces to the last bit."
                    : " NOT every repetition gave the same motion and forces.";
  }
  return text + "\n\n";
}

// A number, or a dash where there is none.
[[nodiscard]] inline std::string number_text(const char* pattern, double value) {
  if (std::isnan(value)) return "-";
  char text[40];
  std::snprintf(text, sizeof text, pattern, value);
  return text;
}

// "10.638 to 10.642 mm"
[[nodiscard]] inline std::string range_text(const StudyRun& run, double StudySample::*member) {
  const Range range = range_of(run, member);
  return format("%.3f to %.3f mm", 1e3 * range.least, 1e3 * range.greatest);
}

[[nodiscard]] inline std::string agreement(const StudyRuns& runs, const char* paper) {
  const double apart = greatest_difference(runs[0], runs[1]);
  return format(
      "Convex profile, strips against minimum distance: lateral shifts at most %.3g nm "
      "apart over the run%s.%s\n\n",
      1e9 * apart, paper,
      apart < 1e-12 ? " Both are exact to rounding, and rounding is what is left." : "");
}

[[nodiscard]] inline std::string wheelset_section(const StudyCases& of) {
  std::string text = format(
      "## Wheelset on a tangent track\n\n%g m/s, %g s, %g kg, %g and %g kg m2 (assumed numbers of "
      "a light metro trailer).\n\n",
      of.wheelset.speed, of.wheelset.duration, of.wheelset.mass, of.wheelset.roll_inertia,
      of.wheelset.spin_inertia);
  text +=
      "| scenario | hunting wavelength [m] | of rolling without sliding at 2 mm [m] | contact on "
      "the left "
      "rail | on the left wheel |\n|---|---|---|---|---|\n";
  for (std::size_t s = 0; s < scenarios.size(); ++s) {
    const StudyRun& run = of.wheelset_runs[s];
    text += format("| %s | %s | %.2f | %s | %s |\n", scenarios[s].title,
                   number_text("%.3f", of.wavelengths[s]).c_str(), of.kinematic_wavelengths[s],
                   range_text(run, &StudySample::left_rail_lateral).c_str(),
                   range_text(run, &StudySample::left_wheel_lateral).c_str());
  }
  return text + "\n" +
         agreement(of.wheelset_runs, " (the paper: less than 10 nm almost at its end)") +
         "![Fig. 12](fig12_lateral_position.png)\n![Fig. 13](fig13_contact_points.png)\n"
         "![Fig. 14](fig14_normal_force.png)\n![Fig. 3](fig03_profiles.png)\n"
         "![Fig. 7](fig07_residuals.png)\n\n";
}

[[nodiscard]] inline std::string bogie_section(const StudyCases& of) {
  std::string text = format("## Bogie on a tangent track\n\n%g m/s, %g s; leading wheelset.\n\n",
                            of.bogie.speed, of.bogie.duration) +
                     agreement(of.bogie_runs, "");
  // Over the second half of a run, against its start: what is left of the oscillation.
  const auto left = [](const StudyRun& run, double start) {
    return greatest_shift(run, run.end_time / 2, run.end_time) / start;
  };
  text +=
      "| scenario | greatest shift in the second half, of that at the start: wheelset | bogie | "
      "contact on the left rail | on the left wheel | greatest constraint violation |\n"
      "|---|---|---|---|---|---|\n";
  for (std::size_t s = 0; s < scenarios.size(); ++s) {
    text += format("| %s | %.3g | %.3g | %s | %s | %.2g |\n", scenarios[s].title,
                   left(of.wheelset_runs[s], of.wheelset.lateral_shift),
                   left(of.bogie_runs[s], of.bogie.lateral_shift),
                   range_text(of.bogie_runs[s], &StudySample::left_rail_lateral).c_str(),
                   range_text(of.bogie_runs[s], &StudySample::left_wheel_lateral).c_str(),
                   of.bogie_runs[s].constraint_violation);
  }
  return text +
         "\nThe paper: the bogie's oscillation decays faster than the wheelset's; on the convex "
         "profile the contact stays almost fixed on the rail.\n\n"
         "![Fig. 15](fig15_bogie_lateral_position.png)\n![Fig. 16](fig16_bogie_normal_force.png)\n"
         "![Fig. 17](fig17_bogie_contact_points.png)\n\n";
}

// What the right wheel of the leading wheelset shows: when it has three patches or more, gaps of up
// to 0.1 s aside, and what it has at 20 s.
[[nodiscard]] inline std::string patches_seen(const VehicleHistory& history) {
  std::string text;
  double begin = std::nan(""), end = 0;
  const auto close = [&] {
    if (std::isnan(begin)) return;
    text += format("%s%.2f to %.2f s", text.empty() ? "three patches or more from " : " and from ",
                   begin, end);
    begin = std::nan("");
  };
  std::string later;
  for (const VehicleRecord& r : history.records) {
    const WheelRecord& wheel = r.wheelsets[0].wheels[index_of(Side::right)];
    if (end + 0.1 < r.time) close();
    if (wheel.patch_count > 2) {
      if (std::isnan(begin)) begin = r.time;
      end = r.time;
    }
    if (std::abs(r.time - 20) < 1e-6) {
      later = "; at 20 s";
      for (int k = 0; k < std::min(wheel.patch_count, 4); ++k) {
        const auto& p = wheel.patches[static_cast<std::size_t>(k)];
        later += format("%s u_w = %.1f mm (%.1f kN)", k == 0 ? "" : ",", 1e3 * p.wheel_lateral,
                        1e-3 * p.normal_force);
      }
    }
  }
  close();
  return (text.empty() ? "never three patches" : text) + later;
}

[[nodiscard]] inline std::string vehicle_section(const StudyCases& of) {
  std::string text = format(
      "## Vehicle in a left curve of 300 m\n\n%g m/s, %g s; right (outer) wheel of the leading "
      "wheelset. Flange contact: from the first to the last instant at which a patch lies further "
      "inside than u_w = %g mm. The paper does not state "
      "transitions and cant: ours are in examples/support/curve.hpp, chosen for the beginning and "
      "end of the flange contact; nothing else is fitted.\n\n",
      of.vehicle.speed, of.vehicle.duration, 1e3 * flange_begin);
  text +=
      "| profile | flange contact [s] | the paper [s] | share of it with 1 patch | 2 | 3 | 4 or "
      "more | greatest constraint violation |\n|---|---|---|---|---|---|---|---|\n";
  const auto row = [&](const char* profile, const char* paper, const VehicleHistory& history) {
    const CurveContact c = curve_contact(history);
    text += format("| %s | %s | %s | %.1f %% | %.1f %% | %.1f %% | %.1f %% | %.2g |\n", profile,
                   flange_contact_text(c).c_str(), paper, 100 * c.share[1], 100 * c.share[2],
                   100 * c.share[3], 100 * c.share[4], history.constraint_violation);
  };
  row("convex", "5.2 to 37.1", of.convex_vehicle);
  row("S1002", "5.2 to 36.5", of.real_vehicle);
  text += "\nS1002: " + patches_seen(of.real_vehicle) + ".\n";
  text +=
      "\nThe paper: convex, one patch on the tread and one on the flange throughout; S1002, one "
      "patch "
      "in the transition zone for most of the curve, more at its beginning and end, three at about "
      "36.4 s. Its vehicle's data are not public, ours are assumed round numbers of the same "
      "class, "
      "so that instants and shares may differ.\n\n";
  return text + agreement(of.vehicle_runs, "") +
         "![Fig. 18](fig18_vehicle_patches_convex.png)\n"
         "![Fig. 19](fig19_vehicle_patches_real.png)\n";
}

}  // namespace detail

[[nodiscard]] inline std::string study_report(const StudyCases& of) {
  const auto& integrator = of.wheelset.integrator;
  return "# The three-case study\n\n" +
         format(
             "S1002 wheels and their convex modification on UIC50 rails (an assumed 50E4 head), "
             "nominal radius 0.43 m, gauge 1.435 m, inclination 1/20; started %g mm off centre, "
             "the wheels just above the rails; tolerances %g, steps of at most %g ms.\n\n",
             1e3 * of.wheelset.lateral_shift, integrator.relative_tolerance,
             1e3 * integrator.maximum_step) +
         detail::time_ratios(of) + detail::wheelset_section(of) + detail::bogie_section(of) +
         detail::vehicle_section(of);
}

}  // namespace examples
