#pragma once
/// @file
/// Many placements of a wheel, each component in an array of its own, as a search that works on
/// several at once reads them. May include: core, numerics, profile, surface, contact/placement.

#include <array>
#include <vector>
#include <wheelrail/contact/placement.hpp>
#include <wheelrail/core/assert.hpp>

namespace wheelrail {

/// Placements in the order in which they were put there. Invariant: all arrays have size() elements.
template <Real T>
class PlacementBatch {
 public:
  PlacementBatch() = default;

  [[nodiscard]] std::size_t size() const { return side_.size(); }  ///< number of placements
  [[nodiscard]] bool empty() const { return side_.empty(); }       ///< size() == 0

  /// Makes room for @p count placements. @note Allocates.
  void reserve(std::size_t count) {
    side_.reserve(count);
    for (std::vector<T>* component : components()) component->reserve(count);
  }

  /// Forgets all placements and keeps their room.
  void clear() {
    side_.clear();
    for (std::vector<T>* component : components()) component->clear();
  }

  /// @note Allocates where there is no room.
  void push_back(const WheelPlacement<T>& placement) {
    if (side_.size() == side_.capacity()) reserve(2 * side_.size() + 8);
    side_.push_back(placement.side);
    x_.push_back(placement.position_rail.x());
    y_.push_back(placement.position_rail.y());
    z_.push_back(placement.position_rail.z());
    sin_yaw_.push_back(placement.sin_yaw);
    cos_yaw_.push_back(placement.cos_yaw);
    tan_yaw_.push_back(placement.tan_yaw);
    sin_roll_.push_back(placement.sin_roll);
    cos_roll_.push_back(placement.cos_roll);
    inclination_.push_back(placement.inclination);
  }

  /// The placement that was put there as the one of that index. @pre index < size()
  [[nodiscard]] WheelPlacement<T> at(std::size_t index) const {
    WHEELRAIL_ASSERT(index < size());
    return {side_[index],     Vector3<T>(x_[index], y_[index], z_[index]),
            sin_yaw_[index],  cos_yaw_[index],
            tan_yaw_[index],  sin_roll_[index],
            cos_roll_[index], inclination_[index]};
  }

  /// Components of WheelPlacement, by index.
  [[nodiscard]] const std::vector<T>& lateral_rail() const { return y_; }     ///< [m]
  [[nodiscard]] const std::vector<T>& up_rail() const { return z_; }          ///< [m]
  [[nodiscard]] const std::vector<T>& sin_yaw() const { return sin_yaw_; }    ///< [-]
  [[nodiscard]] const std::vector<T>& cos_yaw() const { return cos_yaw_; }    ///< [-]
  [[nodiscard]] const std::vector<T>& tan_yaw() const { return tan_yaw_; }    ///< [-]
  [[nodiscard]] const std::vector<T>& sin_roll() const { return sin_roll_; }  ///< [-]
  [[nodiscard]] const std::vector<T>& cos_roll() const { return cos_roll_; }  ///< [-]

 private:
  [[nodiscard]] std::array<std::vector<T>*, 9> components() {
    return {&x_, &y_, &z_, &sin_yaw_, &cos_yaw_, &tan_yaw_, &sin_roll_, &cos_roll_, &inclination_};
  }

  std::vector<Side> side_;
  std::vector<T> x_, y_, z_;  // of position_rail
  std::vector<T> sin_yaw_, cos_yaw_, tan_yaw_, sin_roll_, cos_roll_, inclination_;
};

}  // namespace wheelrail
