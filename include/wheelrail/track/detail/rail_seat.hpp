#pragma once
/// @file
/// How rails of one profile sit on the track: inclined inwards, set apart to gauge, their highest
/// points level with the track plane. May include: core, numerics, profile, surface.

#include <wheelrail/track/detail/inclined_profile.hpp>

namespace wheelrail::detail {

/// Place of a rail profile's origin in the track's section, the same on both sides.
template <Real T>
struct RailSeat {
  T half_distance =
      T(0);         ///< of the profile's origin from the track's middle, to the field side [m]
  T height = T(0);  ///< of the profile's origin over the track plane [m]
  T head_distance = T(0);  ///< between the highest points of the two heads [m]
  T clearance = T(0);      ///< between the profiles where they come nearest [m], at their joints
  T sine = T(0), cosine = T(0);  ///< of the inclination

  /// @throws std::invalid_argument unless the gauge is > 0 and the heads do not overlap, the slope
  ///   of inclination is in (-0.5, 0.5), and the profile reaches 14 mm below its highest point.
  template <Profile R>
  [[nodiscard]] static RailSeat of(const R& profile, const T& gauge, const T& slope) {
    using std::sqrt;
    require_positive("track: gauge", gauge, "[m]");
    require(is_finite(slope) && magnitude(slope) < constant<T>(0.5L), "track: inclination", slope,
            "between -0.5 and 0.5 [-]");
    RailSeat seat;
    seat.cosine = T(1) / sqrt(T(T(1) + slope * slope));
    seat.sine = slope * seat.cosine;
    const InclinedProfile<R> inclined{profile, seat.sine, seat.cosine};
    const T top = inclined.highest();
    const T gauge_point = inclined.gauge_point(top, gauge_depth<T>());
    const auto at_top = profile.evaluate(top);
    const auto at_gauge = profile.evaluate(gauge_point);
    seat.half_distance = gauge / T(2) - inclined.outboard(gauge_point, at_gauge);
    seat.height = -inclined.up(top, at_top);
    seat.head_distance = T(2) * (seat.half_distance + inclined.outboard(top, at_top));
    seat.clearance = gauge;
    for (int i = 0; i <= profile.piece_count(); ++i) {
      const T joint = profile.joint(i);
      const T innermost = seat.half_distance + inclined.outboard(joint, profile.evaluate(joint));
      seat.clearance = min(seat.clearance, T(T(2) * innermost));
    }
    require(T(0) < seat.clearance, "track: gauge", gauge,
            "greater than " + to_text(T(gauge - seat.clearance)) + " m, or the rails overlap");
    return seat;
  }
};

}  // namespace wheelrail::detail
