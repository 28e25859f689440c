#pragma once
// The profiles that the examples know by name.

#include <utility>
#include <wheelrail/wheelrail.hpp>

#include "arguments.hpp"

namespace examples {

using RealWheel = wheelrail::PiecewiseProfile<double>;
using ConvexWheel = wheelrail::ConvexModification<RealWheel>;
using RailHead = wheelrail::RailHead<double>;

inline const std::vector<std::string> wheel_names{"s1002", "s1002-convex"};
inline const std::vector<std::string> rail_names{"uic50", "60e1"};
inline const std::vector<std::string> method_names{"strip", "minimum-distance"};

// Calls body(profile) with the wheel profile of that name.
template <class Body>
[[nodiscard]] auto with_wheel_profile(const std::string& name, Body&& body) {
  if (name == "s1002-convex") return body(ConvexWheel(wheelrail::s1002<double>()));
  return body(wheelrail::s1002<double>());
}

// Calls body(search) with the search method of that name.
template <wheelrail::Profile P, class Body>
[[nodiscard]] auto with_search(const std::string& name, const P& profile, Body&& body) {
  if (name == "minimum-distance") {
    return body(wheelrail::MinimumDistanceSearch<double>{wheelrail::convex_parts(profile), {}});
  }
  return body(wheelrail::StripSearch<double>{});
}

// The same for a wheelset that moves by small steps.
template <wheelrail::Profile P, class Body>
[[nodiscard]] auto with_warm_search(const std::string& name, const wheelrail::Wheelset<P>& wheelset,
                                    Body&& body) {
  if (name == "minimum-distance") {
    return body(wheelrail::WarmMinimumDistanceSearch<double>(wheelset));
  }
  return body(wheelrail::WarmStripSearch<double>(wheelset, {.zone_ends = false}));
}

[[nodiscard]] inline const wheelrail::Patch<double>& patch_of(
    const wheelrail::Patch<double>& patch) {
  return patch;
}
[[nodiscard]] inline const wheelrail::Patch<double>& patch_of(
    const wheelrail::PatchForce<double>& force) {
  return force.patch;
}

// Whether `found` holds the patches of `all` and no others, as far as they are deeper than 0.1 um:
// on a wheel that is not convex the minimum distance method can miss a patch without noticing.
template <class Found, class All>
[[nodiscard]] bool same_patches(const Found& found, const All& all) {
  const auto all_within = [](const auto& some, const auto& others) {
    for (const auto& a : some) {
      bool matched = !(patch_of(a).penetration > 1e-7);
      for (const auto& b : others) {
        matched = matched || std::abs(patch_of(a).penetration - patch_of(b).penetration) < 1e-9;
      }
      if (!matched) return false;
    }
    return true;
  };
  return all_within(found, all) && all_within(all, found);
}

[[nodiscard]] inline RailHead rail_profile(const std::string& name) {
  return name == "60e1" ? wheelrail::rail_60e1<double>() : wheelrail::uic50<double>();
}

}  // namespace examples
