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

[[nodiscard]] inline RailHead rail_profile(const std::string& name) {
  return name == "60e1" ? wheelrail::rail_60e1<double>() : wheelrail::uic50<double>();
}

}  // namespace examples
