#pragma once
/// @file
/// The ways to find contacts, as values that can be passed to what needs contacts.
/// May include: core, numerics, profile, surface, contact.

#include <wheelrail/contact/find_contact.hpp>
#include <wheelrail/contact/minimum_distance.hpp>

namespace wheelrail {

/// The strip search, for any profiles. Called with a wheel, its rail and the placement.
template <Real T>
struct StripSearch {
  SearchOptions<T> options{};

  template <Profile P, Profile R>
  [[nodiscard]] ContactResult<T> operator()(const Wheel<P>& wheel, const Rail<R>& rail,
                                            const WheelPlacement<T>& placement) const {
    return find_contact(wheel, rail, placement, options);
  }
};

/// The minimum distance method, for convex profiles. Called like StripSearch.
template <Real T>
struct MinimumDistanceSearch {
  ConvexParts<T> parts;  ///< of the wheel profile: `convex_parts(profile)`
  MinimumDistanceOptions<T> options{};

  template <Profile P, Profile R>
  [[nodiscard]] ContactResult<T> operator()(const Wheel<P>& wheel, const Rail<R>& rail,
                                            const WheelPlacement<T>& placement) const {
    return find_contact_by_minimum_distance(wheel, rail, placement, parts, options);
  }
};

}  // namespace wheelrail
