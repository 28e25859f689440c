#pragma once
// What is written of a bogie's or vehicle's run: tables as CSV and a summary as `key: value` lines.

#include <algorithm>
#include <cmath>
#include <string>

#include "output.hpp"
#include "vehicle_run.hpp"

namespace examples {

// One row for each instant: every wheelset's position, every wheel's patches and forces.
[[nodiscard]] inline std::string time_series_csv(const VehicleHistory& history,
                                                 const Vehicle& vehicle) {
  std::string text = "time,arc_length";
  const std::size_t count = vehicle.wheelsets.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::string prefix = ",wheelset" + std::to_string(i + 1) + "_";
    text += prefix + "lateral_shift" + prefix + "yaw";
    for (const wheelrail::Side side : wheelrail::sides) {
      const std::string wheel = prefix + name_of(side) + "_";
      text += wheel + "patches" + wheel + "normal_force" + wheel + "force_y" + wheel + "force_z";
    }
  }
  text += "\n";
  for (const VehicleRecord& r : history.records) {
    text += format("%.6g,%.10g", r.time, r.arc_length);
    for (std::size_t i = 0; i < count; ++i) {
      const WheelsetTrace& w = r.wheelsets[i];
      text += format(",%.10g,%.10g", plain(w.lateral_shift), plain(w.yaw));
      for (const WheelRecord& wheel : w.wheels) {
        text += format(",%d,%.8g,%.8g,%.8g", wheel.patch_count, wheel.normal_force,
                       plain(wheel.force_y), plain(wheel.force_z));
      }
    }
    text += "\n";
  }
  return text;
}

// One row for each patch of the leading wheelset, at most four a wheel.
[[nodiscard]] inline std::string patches_csv(const VehicleHistory& history) {
  std::string text =
      "time,side,patch,wheel_lateral,rail_lateral,penetration,normal_force,semi_axis_a,"
      "semi_axis_b\n";
  for (const VehicleRecord& r : history.records) {
    for (const wheelrail::Side side : wheelrail::sides) {
      const WheelRecord& wheel = r.wheelsets[0].wheels[index_of(side)];
      for (int k = 0; k < std::min(wheel.patch_count, 4); ++k) {
        const auto& p = wheel.patches[static_cast<std::size_t>(k)];
        text += format("%.6g,%s,%d,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", r.time, name_of(side), k,
                       p.wheel_lateral, p.rail_lateral, p.penetration, p.normal_force,
                       p.semi_axis_a, p.semi_axis_b);
      }
    }
  }
  return text;
}

// Patches further inside than this are on the steep part of the fillet or on the flange [m].
inline constexpr double flange_begin = -0.02;

// When the leading wheelset's right wheel first and last touches inside flange_begin, and how many
// patches it has in between, in shares of the time.
struct CurveContact {
  double begin = std::nan(""), end = std::nan("");
  std::array<double, 5> share{};  // with 0, 1, 2, 3, 4 and more patches
};

[[nodiscard]] inline CurveContact curve_contact(const VehicleHistory& history) {
  CurveContact contact;
  const auto on_flange = [](const VehicleRecord& r) {
    const WheelRecord& wheel = r.wheelsets[0].wheels[index_of(wheelrail::Side::right)];
    for (int k = 0; k < std::min(wheel.patch_count, 4); ++k) {
      if (wheel.patches[static_cast<std::size_t>(k)].wheel_lateral < flange_begin) return true;
    }
    return false;
  };
  for (const VehicleRecord& r : history.records) {
    if (!on_flange(r)) continue;
    if (std::isnan(contact.begin)) contact.begin = r.time;
    contact.end = r.time;
  }
  double total = 0;
  for (const VehicleRecord& r : history.records) {
    if (!(contact.begin <= r.time && r.time <= contact.end)) continue;
    total += 1;
    contact.share[static_cast<std::size_t>(std::clamp(
        r.wheelsets[0].wheels[index_of(wheelrail::Side::right)].patch_count, 0, 4))] += 1;
  }
  for (double& share : contact.share) share = total > 0 ? share / total : 0;
  return contact;
}

// "5.19 to 36.44", or "none".
[[nodiscard]] inline std::string flange_contact_text(const CurveContact& contact) {
  return std::isnan(contact.begin) ? "none" : format("%.4g to %.4g", contact.begin, contact.end);
}

[[nodiscard]] inline std::string summary(const VehicleHistory& history) {
  std::string text = format("status: %s\n", name_of(history.status));
  if (history.derailment) text += "derailment: " + *history.derailment + "\n";
  if (history.failed_search) text += "failed_search: " + *history.failed_search + "\n";
  double greatest = 0;
  for (const auto& r : history.records) {
    greatest = std::max(greatest, std::abs(r.wheelsets[0].lateral_shift));
  }
  const CurveContact contact = curve_contact(history);
  text += format("simulated_s: %.9g\n", history.end_time);
  text += format("greatest_lateral_shift_m: %.6g\n", greatest);
  text += "flange_contact_s: " + flange_contact_text(contact) + "\n";
  text += format("flange_patches_share: 1: %.4f, 2: %.4f, 3: %.4f\n", contact.share[1],
                 contact.share[2], contact.share[3]);
  text += format("constraint_violation: %.3g\n", history.constraint_violation);
  text += format("constraint_violation_rate: %.3g\n", history.constraint_violation_rate);
  text += format("steps: %d\nrejected_steps: %d\ncontact_searches: %ld\n", history.steps,
                 history.rejected_steps, history.searches);
  text += format("evaluations_per_search: %.4g\nfailed_searches: %ld\n",
                 static_cast<double>(history.evaluations) / static_cast<double>(history.searches),
                 history.failures);
  text += format("seconds: %.4g\nreal_time_factor: %.4g\n", history.seconds,
                 history.end_time / history.seconds);
  return text;
}

}  // namespace examples
