#pragma once
/// @file
/// What a contact search may remember for the next one: a warm start that changes the time, never
/// the answer. May include: core, numerics, profile, surface.

#include <vector>
#include <wheelrail/surface/rail.hpp>
#include <wheelrail/surface/wheel.hpp>

namespace wheelrail {

/// A line in the rail's cross-section that the whole rail lies under: normal . point <= height.
template <Real T>
struct RailTangent {
  Vector2<T> normal_rail{T(0), T(0)};  ///< outward: (lateral, up); zero: none
  T height{};                          ///< [m]
};

/// What is remembered of one part of a wheel.
template <Real T>
struct PartMemory {
  RailTangent<T> tangent;  ///< that last kept it from touching
  bool is_open = false;    ///< in the last search nothing did; not used of blocks
};

/// What each part of a wheel was in the last search: under which tangent of the rail it could not
/// touch, or open. A tangent stays what it is wherever the wheel goes, and what is open is searched:
/// so whatever is remembered, in any order of poses, the patches are those of a cold search to the
/// last bit (a proof may succeed that fails cold, where a remembered tangent excludes more). One
/// memory serves the wheel that it was made for, one search at a time. The caller owns it.
template <Real T>
class SearchMemory {
 public:
  /// @note Allocates; searches do not.
  template <Profile P>
  explicit SearchMemory(const Wheel<P>& wheel)
      : parts_(static_cast<std::size_t>(wheel.strips().slot_count())) {}

  /// By the slots of the wheel's strip tree; forgotten when they were of a rail of another profile.
  template <Profile R>
  [[nodiscard]] std::vector<PartMemory<T>>& parts(const Rail<R>& rail) {
    if (!(checksum_ == rail.checksum())) {
      for (PartMemory<T>& part : parts_) part = {};
      checksum_ = rail.checksum();
    }
    return parts_;
  }

 private:
  std::vector<PartMemory<T>> parts_;
  T checksum_{};
};

}  // namespace wheelrail
