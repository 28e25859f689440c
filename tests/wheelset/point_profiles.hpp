#pragma once
// Profiles through points at equal steps, and what the tests of rigid contact share.

#include <vector>
#include <wheelrail/profile/spline_profile.hpp>
#include <wheelrail/track/tangent_track.hpp>
#include <wheelrail/wheelset/wheelset.hpp>

#include "wheelset/en15302_profiles.hpp"

namespace wheelrail_test {

using PointProfile = wheelrail::SplineProfile<double>;

// A profile of the standard, through its points.
[[nodiscard]] inline PointProfile through(const en15302::Points& points) {
  std::vector<double> nodes, values;
  for (const double value : points.values) {
    nodes.push_back((points.first + static_cast<double>(nodes.size()) * points.step) * 1e-3);
    values.push_back(value * 1e-3);
  }
  return PointProfile(nodes, values, {.noise = 0});
}

// The standard's track: rail A as it is laid, its first point 717.5 mm from the middle. That is
// 14 mm below the profile's origin, while TangentTrack measures the gauge 14 mm below the highest
// point, which is 0.49 mm higher: the same track has a gauge of 1435.2 mm there.
[[nodiscard]] inline const wheelrail::TangentTrack<PointProfile>& en15302_track() {
  static const wheelrail::TangentTrack<PointProfile> track = [] {
    const PointProfile rail = through(en15302::rail_a);
    const double origin = 0.7175 - en15302::rail_a.first * 1e-3;
    const auto seat = wheelrail::detail::RailSeat<double>::of(rail, 1.435, 0.0);
    return wheelrail::TangentTrack<PointProfile>(
        rail, {.gauge = 1.435 + 2 * (origin - seat.half_distance), .inclination = 0.0});
  }();
  return track;
}

}  // namespace wheelrail_test
