#pragma once
/// @file
/// The ways to find contacts, as values that can be passed to what needs contacts.
/// May include: core, numerics, profile, surface, contact, wheelset.

#include <array>
#include <wheelrail/contact/find_contact.hpp>
#include <wheelrail/contact/minimum_distance.hpp>
#include <wheelrail/wheelset/wheelset.hpp>

namespace wheelrail {

/// The strip search, for any profiles. Called with a wheel, its rail and the placement.
template <Real T>
struct StripSearch {
  SearchOptions<ValueOf<T>> options{};  ///< of find_contact

  /// The patches, as find_contact has them.
  template <Profile P, Profile R>
  [[nodiscard]] ContactResult<T> operator()(const Wheel<P>& wheel, const Rail<R>& rail,
                                            const WheelPlacement<T>& placement) const {
    return find_contact(wheel, rail, placement, options);
  }
};

/// StripSearch with a warm start, for one wheelset that moves by small steps: the same patches in less
/// time. Keep one for each wheelset; a copy has memories of its own.
template <Real T>
class WarmStripSearch {
 public:
  /// @note Allocates; searches do not.
  template <Profile P>
  explicit WarmStripSearch(const Wheelset<P>& wheelset,
                           const SearchOptions<ValueOf<T>>& options = {})
      : options_(options),
        memories_{SearchMemory<ValueOf<T>>(wheelset.wheel(Side::left).values()),
                  SearchMemory<ValueOf<T>>(wheelset.wheel(Side::right).values())} {}

  /// The patches, as find_contact has them. Not const: it remembers.
  template <Profile P, Profile R>
  [[nodiscard]] ContactResult<T> operator()(const Wheel<P>& wheel, const Rail<R>& rail,
                                            const WheelPlacement<T>& placement) {
    return find_contact(wheel, rail, placement, memories_[index_of(placement.side)], options_);
  }

 private:
  SearchOptions<ValueOf<T>> options_;
  std::array<SearchMemory<ValueOf<T>>, 2> memories_;  // ordered as `sides`
};

/// The minimum distance method, for convex profiles. Called like StripSearch.
template <Real T>
struct MinimumDistanceSearch {
  ConvexParts<ValueOf<T>> parts;                 ///< of the wheel profile: `convex_parts(profile)`
  MinimumDistanceOptions<ValueOf<T>> options{};  ///< of the method

  /// The patches, as find_contact_by_minimum_distance has them.
  template <Profile P, Profile R>
  [[nodiscard]] ContactResult<T> operator()(const Wheel<P>& wheel, const Rail<R>& rail,
                                            const WheelPlacement<T>& placement) const {
    return find_contact_by_minimum_distance(wheel, rail, placement, parts, options);
  }
};

/// MinimumDistanceSearch with a warm start, for one wheelset that moves by small steps. Keep one for
/// each wheelset; a copy has memories of its own.
template <Real T>
class WarmMinimumDistanceSearch {
 public:
  /// @throws std::invalid_argument as convex_parts does.
  /// @note Allocates; searches do not.
  template <Profile P>
  explicit WarmMinimumDistanceSearch(const Wheelset<P>& wheelset,
                                     const MinimumDistanceOptions<ValueOf<T>>& options = {})
      : options_(options),
        parts_{convex_parts(wheelset.wheel(Side::left).profile()),
               convex_parts(wheelset.wheel(Side::right).profile())} {}

  /// The patches, as find_contact_by_minimum_distance has them. Not const: it remembers.
  template <Profile P, Profile R>
  [[nodiscard]] ContactResult<T> operator()(const Wheel<P>& wheel, const Rail<R>& rail,
                                            const WheelPlacement<T>& placement) {
    const auto side = index_of(placement.side);
    return find_contact_by_minimum_distance(wheel, rail, placement, parts_[side], memories_[side],
                                            options_);
  }

 private:
  MinimumDistanceOptions<ValueOf<T>> options_;
  std::array<ConvexParts<ValueOf<T>>, 2> parts_;                 // ordered as `sides`
  std::array<MinimumDistanceMemory<ValueOf<T>>, 2> memories_{};  // ordered as `sides`
};

}  // namespace wheelrail
