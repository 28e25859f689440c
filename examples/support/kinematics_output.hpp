#pragma once
// What is written of rigid contact kinematics: tables as CSV, the data of the picture, a summary.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>
#include <wheelrail/wheelrail.hpp>

#include "kinematics_profiles.hpp"
#include "output.hpp"

namespace examples {

using Kinematics = wheelrail::WheelsetKinematics<double>;
using AnyWheelset = wheelrail::Wheelset<AnyWheel>;

// A shift that was asked for and what came of it.
struct ShiftRow {
  double lateral_shift_mm = 0;
  Kinematics kinematics;
};

struct ConicityRow {
  double amplitude_mm = 0;
  wheelrail::EquivalentConicity<double> conicity;
};

[[nodiscard]] inline std::string rolling_radius_csv(const std::vector<ShiftRow>& rows) {
  std::string text = "lateral_shift_mm,rolling_radius_difference_mm\n";
  for (const ShiftRow& row : rows) {
    text.append(format("%.10g,", plain(row.lateral_shift_mm)));
    if (row.kinematics.status == wheelrail::TouchStatus::touching) {
      text.append(format("%.9g", plain(1e3 * row.kinematics.rolling_radius_difference())));
    }
    text.append("\n");
  }
  return text;
}

// One row for each contact of each wheel; one with its status for a wheel without.
[[nodiscard]] inline std::string contact_points_csv(const std::vector<ShiftRow>& rows) {
  std::string text =
      "lateral_shift_mm,side,contact,wheel_lateral_mm,rail_lateral_mm,rolling_radius_mm,"
      "contact_angle_rad,gap_um,roll_rad,axle_height_mm,status\n";
  for (const ShiftRow& row : rows) {
    const bool is_set = row.kinematics.status == wheelrail::TouchStatus::touching;
    for (const wheelrail::Side side : wheelrail::sides) {
      const auto& wheel = row.kinematics.wheel(side);
      const std::string begin = format("%.10g,%s,", plain(row.lateral_shift_mm), name_of(side));
      if (!is_set) {
        const bool is_other = wheel.status == wheelrail::TouchStatus::touching;
        text.append(begin).append(",,,,,,,,").append(is_other ? "other_wheel_" : "");
        text.append(name_of(is_other ? row.kinematics.status : wheel.status)).append("\n");
        continue;
      }
      for (std::size_t k = 0; k < wheel.patches.size(); ++k) {
        const auto& patch = wheel.patches[k];
        text.append(begin).append(format("%zu", k));
        append_fields(text, 9,
                      {1e3 * patch.wheel_lateral, 1e3 * patch.rail_lateral,
                       1e3 * patch.rolling_radius, patch.contact_angle});
        text.append(format(",%.3f", plain(std::round(-1e9 * patch.penetration) / 1e3)));
        append_fields(text, 9, {row.kinematics.roll, 1e3 * wheel.height});
        text.append(",").append(name_of(wheel.status)).append("\n");
      }
    }
  }
  return text;
}

[[nodiscard]] inline std::string conicity_csv(const std::vector<ConicityRow>& rows) {
  std::string text = "amplitude_mm,conicity\n";
  for (const ConicityRow& row : rows) {
    text.append(format("%.10g,", row.amplitude_mm));
    if (row.conicity.status == wheelrail::ConicityStatus::found) {
      text.append(format("%.9g", plain(row.conicity.conicity)));
    }
    text.append("\n");
  }
  return text;
}

// Blocks for gnuplot, for each side: wheel, rail, and the lines between contact points; y and z of
// the track [mm], the wheelset in the middle and lifted so that wheel and rail lie apart.
[[nodiscard]] inline std::string picture_data(const AnyWheelset& wheelset, const LaidTrack& track,
                                              const std::vector<ShiftRow>& rows) {
  using wheelrail::Vector3;
  constexpr double lift = 0.030;  // [m]
  // Of the wheels as they stand nearest to the middle.
  const ShiftRow* middle = nullptr;
  for (const ShiftRow& row : rows) {
    if (row.kinematics.status == wheelrail::TouchStatus::touching &&
        (middle == nullptr ||
         std::abs(row.lateral_shift_mm) < std::abs(middle->lateral_shift_mm))) {
      middle = &row;
    }
  }
  std::string text = "# y [mm], z [mm], lateral shift [mm]\n";
  const std::size_t stride = (rows.size() + 39) / 40;
  for (const wheelrail::Side side : wheelrail::sides) {
    const double sign = wheelrail::outboard_sign<double>(side);
    const auto& wheel = wheelset.wheel(side);
    const double height =
        middle == nullptr ? wheel.nominal_radius() : middle->kinematics.wheel(side).height;
    const auto at_wheel = [&](double lateral, double shift) {
      return format(
          "%.6g %.6g %.6g\n", 1e3 * sign * (wheelset.profile_spacing() / 2 + lateral),
          1e3 * (height + lift - wheel.nominal_radius() - wheel.profile().evaluate(lateral).value),
          shift);
    };
    const auto frame = track.nearest_frame(side, Vector3<double>(0, 0, 0));
    const auto at_rail = [&](double lateral, double shift) {
      const Vector3<double> point = frame.position_track(
          Vector3<double>(0, lateral, track.rail(side).profile().evaluate(lateral).value));
      return format("%.6g %.6g %.6g\n", 1e3 * point.y(), 1e3 * point.z(), shift);
    };
    constexpr int steps = 400;
    const auto outline = [&](const auto& profile, const auto& at) {
      for (int i = 0; i <= steps; ++i) {
        const double lateral =
            i == steps ? profile.upper()
                       : profile.lower() + (profile.upper() - profile.lower()) * i / steps;
        text.append(at(lateral, 0.0));
      }
      text.append("\n\n");
    };
    outline(wheel.profile(), at_wheel);
    outline(track.rail(side).profile(), at_rail);
    bool is_empty = true;
    for (std::size_t i = rows.size() / 2 % stride; i < rows.size(); i += stride) {
      if (rows[i].kinematics.status != wheelrail::TouchStatus::touching) continue;
      const double shift = plain(rows[i].lateral_shift_mm);
      for (const auto& patch : rows[i].kinematics.wheel(side).patches) {
        const auto& rail = track.rail(side).profile();
        const double rail_lateral = std::clamp(patch.rail_lateral, rail.lower(), rail.upper());
        text.append(at_wheel(patch.wheel_lateral, shift)).append(at_rail(rail_lateral, shift));
        text.append("\n");
        is_empty = false;
      }
    }
    if (is_empty) text.append("nan nan nan\n\n");
    text.append("\n");
  }
  return text;
}

// Runs of neighbouring rows with the same words, e.g. "6.6 to 7 mm: out_of_range", one a line.
template <class Rows, class Where, class What>
void append_runs(std::string& text, const Rows& rows, const Where& where, const What& what) {
  for (std::size_t first = 0; first < rows.size();) {
    std::size_t last = first;
    while (last + 1 < rows.size() && what(rows[last + 1]) == what(rows[first])) ++last;
    const std::string words = what(rows[first]);
    if (!words.empty()) {
      text.append(format("  %g to %g mm: ", plain(where(rows[first])), plain(where(rows[last]))))
          .append(words)
          .append("\n");
    }
    first = last + 1;
  }
}

[[nodiscard]] inline std::string kinematics_summary(const std::vector<ShiftRow>& shifts,
                                                    const wheelrail::KinematicsTable<double>& table,
                                                    const std::vector<ConicityRow>& conicities) {
  using wheelrail::ConicityStatus, wheelrail::TouchStatus;
  std::string text =
      format("lateral shifts: %zu, from %g to %g mm, positive to the left\n", shifts.size(),
             plain(shifts.front().lateral_shift_mm), plain(shifts.back().lateral_shift_mm));
  append_runs(
      text, shifts, [](const ShiftRow& row) { return row.lateral_shift_mm; },
      [](const ShiftRow& row) {
        if (row.kinematics.status == TouchStatus::touching) return std::string("touching");
        std::string words = "no value";
        for (const wheelrail::Side side : wheelrail::sides) {
          words.append(", ").append(name_of(side)).append(" wheel ");
          words.append(name_of(row.kinematics.wheel(side).status));
        }
        return words;
      });
  text.append(format("jumps of a contact point: %zu\n", table.jumps.size()));
  constexpr std::size_t listed = 20;
  for (std::size_t i = 0; i < table.jumps.size() && i < listed; ++i) {
    const auto& jump = table.jumps[i];
    text.append(format("  %.4f mm: %s wheel, from %.3f to %.3f mm on the wheel\n",
                       plain(1e3 * jump.lateral_shift), name_of(jump.side),
                       1e3 * jump.wheel_lateral_before, 1e3 * jump.wheel_lateral_after));
  }
  if (table.jumps.size() > listed) {
    text.append(format("  and %zu more\n", table.jumps.size() - listed));
  }
  text.append("rolling radius difference, left less right:\n");
  for (const double at : {-6.0, -4.0, -2.0, 0.0, 2.0, 4.0, 6.0}) {
    for (const ShiftRow& row : shifts) {
      if (std::abs(row.lateral_shift_mm - at) > 1e-6) continue;
      text.append(format("  %g mm: ", at));
      text.append(row.kinematics.status == TouchStatus::touching
                      ? format("%.4f mm\n", plain(1e3 * row.kinematics.rolling_radius_difference()))
                      : std::string("no value\n"));
    }
  }
  std::size_t missing = 0;
  text.append("equivalent conicity [-]:\n");
  for (std::size_t i = 0; i < conicities.size(); ++i) {
    const auto& row = conicities[i];
    const bool is_found = row.conicity.status == ConicityStatus::found;
    if (!is_found) ++missing;
    if (i % 10 != 0) continue;
    text.append(format("  amplitude %g mm: ", row.amplitude_mm));
    text.append(is_found ? format("%.4f", plain(row.conicity.conicity))
                         : std::string("none, ").append(name_of(row.conicity.status)));
    text.append("\n");
  }
  if (missing == 0) return text;
  text.append(format("no conicity at %zu of %zu amplitudes (empty in conicity.csv):\n", missing,
                     conicities.size()));
  append_runs(
      text, conicities, [](const ConicityRow& row) { return row.amplitude_mm; },
      [](const ConicityRow& row) {
        return row.conicity.status == ConicityStatus::found
                   ? std::string()
                   : std::string(name_of(row.conicity.status));
      });
  return text;
}

}  // namespace examples
