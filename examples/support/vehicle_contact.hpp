#pragma once
// The contact of a vehicle's wheelsets with a track, without its types: what runs vehicles is compiled
// once for all profiles, tracks and ways of searching.

#include <algorithm>
#include <array>
#include <functional>
#include <vector>
#include <wheelrail/wheelrail.hpp>

namespace examples {

// Equal wheelsets on one track. What it was made of must outlive it.
struct VehicleContact {
  template <class T>
  using PerSide = std::array<T, 2>;  // ordered as wheelrail::sides

  // The forces on wheelset number i; each has a search of its own.
  std::function<wheelrail::WheelsetForces<double>(std::size_t i,
                                                  const wheelrail::WheelsetPosition<double>&,
                                                  const wheelrail::WheelsetMotion<double>&)>
      forces;
  std::function<wheelrail::RailFrame<double>(
      wheelrail::Side, const wheelrail::Vector3<double>& point_track, double guess)>
      nearest_frame;
  std::function<wheelrail::Vector3<double>(wheelrail::Side,
                                           const wheelrail::WheelsetPosition<double>&)>
      wheel_track;
  // Set down at a lateral shift [m] with a gap [m] at x [m], without yaw.
  std::function<wheelrail::TouchingPosition<double>(double lateral_shift, double gap, double x)>
      touching;
  PerSide<double> nominal_radius{};  // [m]
  PerSide<double> flange_height{};   // above the tread circle [m]
  PerSide<double> field_end{};       // of the profile [m]
};

template <class Wheelset, class Track, class Search>
[[nodiscard]] VehicleContact contact_of(const Wheelset& wheelset, const Track& track,
                                        const wheelrail::ContactForceModel<double>& model,
                                        const Search& search, std::size_t wheelsets) {
  VehicleContact contact;
  contact.forces = [&, searches = std::vector<Search>(wheelsets, search)](
                       std::size_t i, const auto& at, const auto& motion) mutable {
    return wheelset_forces(wheelset, track, at, motion, model, searches[i]);
  };
  contact.nearest_frame = [&](wheelrail::Side side, const auto& point_track, double guess) {
    return track.nearest_frame(side, point_track, guess);
  };
  contact.wheel_track = [&](wheelrail::Side side, const auto& at) {
    return wheelset.wheel_track(side, at);
  };
  contact.touching = [&](double lateral_shift, double gap, double x) {
    return touching_position(wheelset, track, lateral_shift, 0.0, {.gap = gap}, x);
  };
  for (const wheelrail::Side side : wheelrail::sides) {
    const auto k = index_of(side);
    const auto& profile = wheelset.wheel(side).profile();
    contact.nominal_radius[k] = wheelset.wheel(side).nominal_radius();
    contact.field_end[k] = profile.upper();
    for (int i = 0; i <= 256; ++i) {
      const double lateral = profile.lower() + i * (profile.upper() - profile.lower()) / 256;
      contact.flange_height[k] =
          std::max(contact.flange_height[k], profile.evaluate(lateral).value);
    }
  }
  return contact;
}

}  // namespace examples
