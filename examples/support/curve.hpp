#pragma once
// The curve of the third case (§6.3 of the paper): left, R 300 m. The paper does not state its
// transitions and cant; these are plausible ones with which the flange contact begins at about 5.2 s
// and ends at about 37 s at 18.3 m/s. Nothing else is fitted.

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <wheelrail/track/nodal_track.hpp>

#include "output.hpp"
#include "profiles.hpp"
#include "vehicle_run.hpp"

namespace examples {

struct CurveLayout {
  double approach = 102;   // tangent before the curve [m]
  double transition = 60;  // clothoids, along which the cant rises and falls [m]
  double arc = 462;        // [m]
  double radius = 300;     // to the left [m]
  double cant = 0.12;      // of the right rail over the left; 0.17 m would balance 18.3 m/s [m]
  double departure = 140;  // tangent behind the curve [m]
};

[[nodiscard]] wheelrail::NodalTrack<RailHead> curved_track(
    const RailHead& rail, const CurveLayout& layout,
    const wheelrail::TrackDimensions<double>& dimensions);

// Where the vehicle's middle starts, so that its rear wheelset is on the track [m].
inline constexpr double vehicle_start = 10;

// The vehicle's report interval: 9 cm at 18.3 m/s. Each report evaluates all forces once more.
inline constexpr double curve_report_interval = 5e-3;  // [s]

// Throws unless the vehicle starts on the track, on a straight and level stretch from its first metre
// on, and the track is longer than the run.
template <class Track>
void require_length(const Track& track, const Vehicle& vehicle, const VehicleCase& run) {
  double front = 0;
  for (const auto& position : vehicle.positions) {
    front = std::max(front, position.x());
    const double at = run.start + position.x();
    if (at < 0) {
      throw std::invalid_argument(
          format("the vehicle starts %g m before the track: its middle must start at %g m or "
                 "further along",
                 -at, -position.x()));
    }
    const auto point = track.centre_line().evaluate(at);
    const wheelrail::Vector3<double> straight_on(at, 0, 0);
    if (!((point.position_track - straight_on).norm() < 1e-9) ||
        !(std::abs(point.sin_cant) < 1e-9)) {
      throw std::invalid_argument(
          format("the vehicle must start on straight and level track, but %g m along it, where one "
                 "of its bodies starts, the curve or its cant has begun",
                 at));
    }
  }
  const double needed = run.start + front + run.speed * run.duration + 1;
  if (track.length() < needed) {
    throw std::invalid_argument("the track is " + std::to_string(track.length()) +
                                " m long, but the run needs " + std::to_string(needed) + " m");
  }
}

}  // namespace examples
