#pragma once
// What the study needs no simulation for: Fig. 3, the profiles, Fig. 7, the residual of the minimum
// distance equations on the tread and in the fillet, and the kinematic wavelength.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "output.hpp"
#include "profiles.hpp"

namespace examples {

// Fig. 3: profile, slope, second derivative and curvature of the real and the convex wheel.
[[nodiscard]] inline std::string profiles_table(const RealWheel& real, const ConvexWheel& convex,
                                                double nominal_radius) {
  constexpr double mm = 1e-3;
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

[[nodiscard]] inline ResidualMap residual_map(const wheelrail::Wheelset<RealWheel>& wheelset,
                                              const wheelrail::TangentTrack<RailHead>& track,
                                              double lateral_shift) {
  constexpr double mm = 1e-3;
  const auto set_down = touching_position(wheelset, track, lateral_shift);
  const auto& contact = set_down.patches[index_of(wheelrail::Side::left)];
  const auto placement = place_wheel(wheelset, track, wheelrail::Side::left, set_down.position);
  const auto& wheel = wheelset.wheel(wheelrail::Side::left);
  const auto& rail = track.rail(wheelrail::Side::left);
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

// The wavelength [m] of a wheelset that rolls without sliding, at an amplitude [m] in which both
// wheels keep to one patch: y'' = -dr(y) / (e R0) along the track, dr the rolling radius difference of
// rigid contact and e the distance of the contact points. A quarter of it is the integral of
// dy / sqrt(2 (V(A) - V(y))) to the amplitude A, V that of dr / (e R0); with y = A sin(angle).
template <class WheelProfile>
[[nodiscard]] double kinematic_wavelength(const wheelrail::Wheelset<WheelProfile>& wheelset,
                                          const wheelrail::TangentTrack<RailHead>& track,
                                          double amplitude) {
  using wheelrail::Side;
  const auto at = [&](double shift) { return touching_position(wheelset, track, shift).patches; };
  const auto radius = [](const auto& patches, Side side) {
    return patches[index_of(side)].rolling_radius;
  };
  const auto centred = at(0);
  const double distance =
      wheelset.profile_spacing() + centred[0].wheel_lateral + centred[1].wheel_lateral;
  const double scale = distance * wheelset.wheel(Side::left).nominal_radius();
  constexpr int steps = 200;
  // V at amplitude * sin(angle), by the trapezoidal rule.
  std::vector<double> shifts, potential;
  double before = 0;
  for (int i = 0; i <= steps; ++i) {
    const double shift = amplitude * std::sin(std::acos(-1.0) / 2 * i / steps);
    const auto patches = at(shift);
    const double pull = (radius(patches, Side::left) - radius(patches, Side::right)) / scale;
    potential.push_back(i == 0 ? 0
                               : potential.back() + (pull + before) / 2 * (shift - shifts.back()));
    shifts.push_back(shift);
    before = pull;
  }
  double quarter = 0;
  for (std::size_t i = 1; i < shifts.size(); ++i) {
    const double fall = potential.back() - (potential[i] + potential[i - 1]) / 2;
    quarter += (shifts[i] - shifts[i - 1]) / std::sqrt(2 * fall);
  }
  return 4 * quarter;
}

}  // namespace examples
