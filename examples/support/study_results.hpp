#pragma once
// What the study keeps of its nine runs, and the tables of Figs. 12 to 19 made from it.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "vehicle_output.hpp"
#include "wheelset_output.hpp"

namespace examples {

// §6: the columns of Table 3, in its order.
struct Scenario {
  const char* name;
  const char* title;
};
inline constexpr std::array<Scenario, 3> scenarios{
    {{"convex_minimum_distance", "convex, minimum distance"},
     {"convex_strips", "convex, strips"},
     {"real_strips", "S1002, strips"}}};

// The leading wheelset at one instant; of its left wheel the deepest patch (NaN: no contact).
struct StudySample {
  double time, lateral_shift, left_normal_force, left_wheel_lateral, left_rail_lateral;
};

// One run of one case in one scenario, and the processor times of all its repetitions.
struct StudyRun {
  std::vector<StudySample> samples;
  wheelrail::IntegrationStatus status = wheelrail::IntegrationStatus::not_finite;
  double end_time = 0;
  int steps = 0;
  long searches = 0, evaluations = 0, failures = 0;
  double constraint_violation = 0;  // greatest |Phi| [m, -]
  std::vector<double> seconds;
  std::uint64_t fingerprint = 0;  // of all that was recorded and counted
  bool repeats = true;            // every repetition has the same

  [[nodiscard]] double median_seconds() const {
    std::vector<double> sorted = seconds;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t middle = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
  }
};

[[nodiscard]] inline StudySample sample_of(const WheelsetRecord& record) {
  const auto& wheel = record.forces.wheel(Side::left);
  const auto* patch = main_patch(wheel);
  const double none = std::nan("");
  return {record.time, record.lateral_shift(), normal_force_of(wheel),
          patch != nullptr ? patch->patch.wheel_lateral : none,
          patch != nullptr ? patch->patch.rail_lateral : none};
}

[[nodiscard]] inline StudySample sample_of(const VehicleRecord& record) {
  const WheelsetTrace& leading = record.wheelsets[0];
  const WheelRecord& wheel = leading.wheels[index_of(Side::left)];
  const WheelRecord::PatchRecord* deepest = nullptr;
  for (int k = 0; k < std::min(wheel.patch_count, 4); ++k) {
    const auto& patch = wheel.patches[static_cast<std::size_t>(k)];
    if (deepest == nullptr || deepest->penetration < patch.penetration) deepest = &patch;
  }
  const double none = std::nan("");
  return {record.time, leading.lateral_shift, wheel.normal_force,
          deepest != nullptr ? deepest->wheel_lateral : none,
          deepest != nullptr ? deepest->rail_lateral : none};
}

// The bits of a sequence of numbers, mixed (FNV-1a).
class Fingerprint {
 public:
  void add(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    for (int shift = 0; shift < 64; shift += 8) {
      value_ = (value_ ^ (bits >> shift & 0xff)) * 0x100000001b3ULL;
    }
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

inline void add(Fingerprint& to, const WheelsetRecord& record) {
  for (const double x : pack(record.state)) to.add(x);
  for (const auto& wheel : record.forces.wheels) {
    for (const double x : wheel.force_track) to.add(x);
    for (const auto& patch : wheel.patches) {
      to.add(patch.patch.wheel_lateral);
      to.add(patch.patch.penetration);
      to.add(patch.contact.normal);
    }
  }
}

inline void add(Fingerprint& to, const VehicleRecord& record) {
  to.add(record.arc_length);
  for (const WheelsetTrace& wheelset : record.wheelsets) {
    to.add(wheelset.lateral_shift);
    to.add(wheelset.yaw);
    for (const WheelRecord& wheel : wheelset.wheels) {
      to.add(wheel.patch_count);
      to.add(wheel.force_y);
      to.add(wheel.force_z);
      for (const auto& patch : wheel.patches) {
        to.add(patch.wheel_lateral);
        to.add(patch.penetration);
        to.add(patch.normal_force);
      }
    }
  }
}

// `history` as a run without times.
template <class History>
[[nodiscard]] StudyRun study_run(const History& history) {
  StudyRun run;
  Fingerprint fingerprint;
  run.samples.reserve(history.records.size());
  for (const auto& record : history.records) {
    run.samples.push_back(sample_of(record));
    fingerprint.add(record.time);
    add(fingerprint, record);
  }
  run.status = history.status;
  run.end_time = history.end_time;
  run.steps = history.steps;
  run.searches = history.searches;
  run.evaluations = history.evaluations;
  run.failures = history.failures;
  if constexpr (requires { history.constraint_violation; }) {
    run.constraint_violation = history.constraint_violation;
  }
  for (const double count : {static_cast<double>(run.steps), static_cast<double>(run.searches),
                             static_cast<double>(run.evaluations)}) {
    fingerprint.add(count);
  }
  run.fingerprint = fingerprint.value();
  return run;
}

using StudyRuns = std::array<StudyRun, scenarios.size()>;

// Greatest distance of two runs' lateral shifts at equal times [m].
[[nodiscard]] inline double greatest_difference(const StudyRun& a, const StudyRun& b) {
  double greatest = 0;
  for (std::size_t i = 0; i < std::min(a.samples.size(), b.samples.size()); ++i) {
    greatest =
        std::max(greatest, std::abs(a.samples[i].lateral_shift - b.samples[i].lateral_shift));
  }
  return greatest;
}

// Greatest |lateral shift| from `begin` to `end` [s], in [m].
[[nodiscard]] inline double greatest_shift(const StudyRun& run, double begin, double end) {
  double greatest = 0;
  for (const StudySample& s : run.samples) {
    if (begin <= s.time && s.time <= end) greatest = std::max(greatest, std::abs(s.lateral_shift));
  }
  return greatest;
}

// The range of a member of the samples after the first second (in runs of up to 2 s: of all).
[[nodiscard]] inline Range range_of(const StudyRun& run, double StudySample::*member) {
  Range range;
  for (const StudySample& s : run.samples) {
    if ((run.end_time > 2 && s.time < 1) || std::isnan(s.*member)) continue;
    range.least = std::isnan(range.least) ? s.*member : std::min(range.least, s.*member);
    range.greatest = std::isnan(range.greatest) ? s.*member : std::max(range.greatest, s.*member);
  }
  return range;
}

// Figs. 12, 14, 15, 16: lateral position and normal force in all scenarios over time.
[[nodiscard]] inline std::string comparison_table(const StudyRuns& runs) {
  constexpr double mm = 1e-3;
  std::string text = "time";
  for (const Scenario& s : scenarios) {
    text += std::string(",") + s.name + "_lateral_shift_mm," + s.name + "_left_normal_force_kN";
  }
  text += "\n";
  std::size_t rows = runs[0].samples.size();
  for (const StudyRun& run : runs) rows = std::min(rows, run.samples.size());
  for (std::size_t i = 0; i < rows; ++i) {
    text += format("%.6g", runs[0].samples[i].time);
    for (const StudyRun& run : runs) {
      append_fields(text, 15, {run.samples[i].lateral_shift / mm});
      append_fields(text, 12, {1e-3 * run.samples[i].left_normal_force});
    }
    text += "\n";
  }
  return text;
}

// Figs. 13, 17: the left wheel's contact point every 0.05 s, on the wheel, its profile (from the
// axle, downwards negative as in the paper) and the rail.
template <class WheelProfile>
[[nodiscard]] std::string contact_points_table(const StudyRun& run, const WheelProfile& profile,
                                               double nominal_radius) {
  constexpr double mm = 1e-3;
  std::string text = "time,wheel_lateral_mm,profile_mm,rail_lateral_mm\n";
  double next = 0;
  for (const StudySample& s : run.samples) {
    if (s.time < next - 1e-9) continue;
    next += 0.05;
    if (std::isnan(s.left_wheel_lateral)) continue;
    const double value = -(nominal_radius + profile.evaluate(s.left_wheel_lateral).value);
    text += format("%.6g", s.time);
    append_fields(text, 9, {s.left_wheel_lateral / mm, value / mm, s.left_rail_lateral / mm});
    text += "\n";
  }
  return text;
}

// Figs. 18, 19 (a): each patch of the leading wheelset's right wheel, the outer wheel in the curve,
// every 0.02 s.
[[nodiscard]] inline std::string outer_wheel_table(const VehicleHistory& history) {
  constexpr double mm = 1e-3;
  std::string text = "time,patches,patch,wheel_lateral_mm,normal_force_kN\n";
  double next = 0;
  for (const VehicleRecord& r : history.records) {
    if (r.time < next - 1e-9) continue;
    next += 0.02;
    const WheelRecord& wheel = r.wheelsets[0].wheels[index_of(Side::right)];
    for (int k = 0; k < std::min(wheel.patch_count, 4); ++k) {
      const auto& p = wheel.patches[static_cast<std::size_t>(k)];
      text += format("%.6g,%d,%d", r.time, wheel.patch_count, k);
      append_fields(text, 9, {p.wheel_lateral / mm, 1e-3 * p.normal_force});
      text += "\n";
    }
  }
  return text;
}

// Figs. 18, 19 (b) to (e): the instants of the paper [s].
inline constexpr std::array<double, 4> patch_instants{1.0, 6.0, 20.0, 36.4};

// Figs. 18, 19 (b) to (e): outlines of the contact ellipses, one data block of gnuplot for each
// instant: the lateral semi-axis is laid along the lateral coordinate around the patch's place. A
// block without patches has one row of nan.
[[nodiscard]] inline std::string ellipses_table(const VehicleHistory& history) {
  constexpr double mm = 1e-3;
  std::string text =
      "# wheel_lateral_mm longitudinal_mm normal_force_kN; a blank line after each patch, two "
      "after each instant\n";
  for (const double instant : patch_instants) {
    text += format("# t = %g s\n", instant);
    const auto at =
        std::find_if(history.records.begin(), history.records.end(),
                     [&](const VehicleRecord& r) { return std::abs(r.time - instant) < 1e-6; });
    int count = 0;
    if (at != history.records.end()) {
      const WheelRecord& wheel = at->wheelsets[0].wheels[index_of(Side::right)];
      for (; count < std::min(wheel.patch_count, 4); ++count) {
        const auto& p = wheel.patches[static_cast<std::size_t>(count)];
        for (int i = 0; i <= 72; ++i) {
          const double angle = 2 * std::acos(-1.0) * i / 72;
          text +=
              format("%.6f %.6f %.4f\n", (p.wheel_lateral + p.semi_axis_b * std::cos(angle)) / mm,
                     plain(p.semi_axis_a * std::sin(angle) / mm), 1e-3 * p.normal_force);
        }
        text += "\n";
      }
    }
    text += count == 0 ? "nan nan nan\n\n\n" : "\n";
  }
  return text;
}

}  // namespace examples
