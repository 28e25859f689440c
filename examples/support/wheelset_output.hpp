#pragma once
// What is written of a wheelset's run: tables as CSV and a summary as `key: value` lines.

#include <cmath>
#include <string>

#include "output.hpp"
#include "wheelset_run.hpp"

namespace examples {

// The deepest patch of a wheel; null when it does not touch.
[[nodiscard]] inline const wheelrail::PatchForce<double>* main_patch(
    const WheelsetRecord::Wheel& wheel) {
  const wheelrail::PatchForce<double>* deepest = nullptr;
  for (const auto& patch : wheel.patches) {
    if (deepest == nullptr || deepest->patch.penetration < patch.patch.penetration) {
      deepest = &patch;
    }
  }
  return deepest;
}

// The magnitude of all normal forces on a wheel [N].
[[nodiscard]] inline double normal_force_of(const WheelsetRecord::Wheel& wheel) {
  double sum = 0;
  for (const auto& patch : wheel.patches) sum += patch.contact.normal;
  return sum;
}

// One row for each instant; of each wheel the totals and the deepest patch (nan: no contact).
[[nodiscard]] inline std::string time_series_csv(const WheelsetHistory& history,
                                                 const WheelsetCase& run) {
  std::string text = "time,lateral_shift,yaw,roll,height,longitudinal,velocity_x,velocity_y,energy";
  for (const Side side : wheelrail::sides) {
    const std::string s = name_of(side);
    for (const char* column :
         {"patches", "normal_force", "force_x", "force_y", "force_z", "wheel_lateral",
          "rail_lateral", "penetration", "contact_angle", "rolling_radius"}) {
      text += "," + s + "_" + column;
    }
  }
  text += "\n";
  const wheelrail::RigidBody<double> body(run.mass,
                                          {run.roll_inertia, run.spin_inertia, run.roll_inertia});
  for (const WheelsetRecord& r : history.records) {
    const auto& position = r.state.position_world;
    const double energy = kinetic_energy(body, r.state) + run.mass * run.gravity * position.z();
    text += format("%.6g", r.time);
    append_fields(text, 12,
                  {r.lateral_shift(), r.yaw(), r.roll(), position.z(), position.x(),
                   r.state.velocity_world.x(), r.state.velocity_world.y(), energy});
    for (const auto& wheel : r.forces.wheels) {
      const auto* deepest = main_patch(wheel);
      const wheelrail::Patch<double> none{.wheel_lateral = std::nan(""),
                                          .rail_lateral = std::nan(""),
                                          .penetration = std::nan(""),
                                          .contact_angle = std::nan(""),
                                          .rolling_radius = std::nan("")};
      const auto& patch = deepest != nullptr ? deepest->patch : none;
      text += format(",%zu", wheel.patches.size());
      append_fields(text, 10,
                    {normal_force_of(wheel), wheel.force_track.x(), wheel.force_track.y(),
                     wheel.force_track.z(), patch.wheel_lateral, patch.rail_lateral,
                     patch.penetration, patch.contact_angle, patch.rolling_radius});
    }
    text += "\n";
  }
  return text;
}

// One row for each patch of each instant.
[[nodiscard]] inline std::string patches_csv(const WheelsetHistory& history) {
  std::string text =
      "time,side,patch,wheel_lateral,rail_lateral,longitudinal,penetration,lower,upper,"
      "contact_angle,rolling_radius,normal_force,longitudinal_force,lateral_force,"
      "longitudinal_creepage,lateral_creepage,spin_creepage,semi_axis_a,semi_axis_b,hertz_status\n";
  for (const WheelsetRecord& r : history.records) {
    for (const Side side : wheelrail::sides) {
      const auto& patches = r.forces.wheel(side).patches;
      for (std::size_t k = 0; k < patches.size(); ++k) {
        const auto& patch = patches[k].patch;
        const auto& contact = patches[k].contact;
        text += format("%.6g,%s,%zu", r.time, name_of(side), k);
        append_fields(
            text, 10,
            {patch.wheel_lateral, patch.rail_lateral, patch.longitudinal, patch.penetration,
             patch.zone_lower, patch.zone_upper, patch.contact_angle, patch.rolling_radius,
             contact.normal, contact.creep.longitudinal, contact.creep.lateral});
        append_fields(text, 8,
                      {contact.creepage.longitudinal, contact.creepage.lateral,
                       contact.creepage.spin, contact.ellipse.a, contact.ellipse.b});
        text += format(",%s\n", name_of(contact.hertz_status));
      }
    }
  }
  return text;
}

// The least and the greatest value of one wheel's contact position after the first second (in short
// runs: of all), for the deepest patch.
struct Range {
  double least = std::nan(""), greatest = std::nan("");
};
template <class Value>
[[nodiscard]] Range range_of(const WheelsetHistory& history, Side side, Value&& value) {
  Range range;
  for (const WheelsetRecord& r : history.records) {
    if (history.end_time > 2 && r.time < 1) continue;
    const auto* patch = main_patch(r.forces.wheel(side));
    if (patch == nullptr) continue;
    const double x = plain(value(patch->patch));
    range.least = std::isnan(range.least) ? x : std::min(range.least, x);
    range.greatest = std::isnan(range.greatest) ? x : std::max(range.greatest, x);
  }
  return range;
}

[[nodiscard]] inline std::string summary(const WheelsetHistory& history) {
  double greatest_shift = 0;
  for (const auto& r : history.records) {
    greatest_shift = std::max(greatest_shift, std::abs(r.lateral_shift()));
  }
  const Range rail =
      range_of(history, Side::left, [](const auto& patch) { return patch.rail_lateral; });
  const Range wheel =
      range_of(history, Side::left, [](const auto& patch) { return patch.wheel_lateral; });
  std::string text;
  text += format("status: %s\n", name_of(history.status));
  text += format("simulated_s: %.9g\n", history.end_time);
  text += format("hunting_wavelength_m: %.6g\n", hunting_wavelength(history));
  text += format("greatest_lateral_shift_m: %.6g\n", greatest_shift);
  text += format("left_rail_lateral_m: %.6g to %.6g\n", rail.least, rail.greatest);
  text += format("left_wheel_lateral_m: %.6g to %.6g\n", wheel.least, wheel.greatest);
  text += format("final_speed_m_s: %.9g\n", history.records.back().state.velocity_world.x());
  text += format("steps: %d\n", history.steps);
  text += format("rejected_steps: %d\n", history.rejected_steps);
  text += format("contact_searches: %ld\n", history.searches);
  text += format("evaluations_per_search: %.4g\n",
                 static_cast<double>(history.evaluations) / static_cast<double>(history.searches));
  text += format("failed_searches: %ld\n", history.failures);
  text += format("seconds: %.4g\n", history.seconds);
  text += format("real_time_factor: %.4g\n", history.end_time / history.seconds);
  return text;
}

}  // namespace examples
