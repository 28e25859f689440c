#pragma once
/// @file
/// What a contact search may remember for the next one: a warm start that changes the time, never
/// the answer. May include: core, numerics, profile, surface, contact/placement.
///
/// The idea is that of neighbour lists in molecular dynamics (L. Verlet, Computer "experiments" on
/// classical fluids I, Phys. Rev. 159 (1967) 98-103). A search that finds parts of the wheel more
/// than a `skin` above the rail need not look at them again before the wheel has moved by that much:
/// each was under a plane that the rail lies under, and no point of the wheel has moved farther than
/// d = |o' - o| + (|u| + R) |a' - a| from one that it may be taken for. o is the profile's origin
/// seen along the rail, which is straight there; a the axle's direction; a wheel may be turned about
/// its axle at will; |u| and R are the greatest of the profile.

#include <vector>
#include <wheelrail/contact/placement.hpp>

namespace wheelrail {

/// A line in the rail's cross-section that the whole rail lies under: normal . point <= height.
template <Real T>
struct RailTangent {
  Vector2<T> normal_rail{T(0), T(0)};  ///< outward: (lateral, up); zero: none
  T height{};                          ///< [m]
};

/// The blocks of one wheel's strip tree that were near the rail at some placement. Whatever it holds,
/// in any order of poses, the patches are those of a cold search to the last bit. The caller owns it:
/// one for each wheel on its rail, used by one search at a time.
template <Real T>
class SearchMemory {
 public:
  /// A block that is or was near the rail, and the tangent that last kept it from touching.
  struct Block {
    int node = 0;
    RailTangent<T> tangent;
  };

  /// @param skin how far the wheel may move before its surroundings are looked at anew [m].
  /// @throws std::invalid_argument unless skin is finite and > 0.
  /// @note Allocates; searches do not.
  template <Profile P>
  explicit SearchMemory(const Wheel<P>& wheel, const T& skin = constant<T>(1e-4L))
      : skin_(skin),
        reach_(detail::max(detail::magnitude(wheel.profile().lower()),
                           detail::magnitude(wheel.profile().upper())) +
               wheel.strips().greatest_radius()) {
    detail::require_positive("search memory: skin", skin, "[m]");
    blocks_.reserve(static_cast<std::size_t>(wheel.strips().block_count()));
  }

  [[nodiscard]] const T& skin() const { return skin_; }
  /// Those near the rail, from the flange to the field side.
  [[nodiscard]] std::vector<Block>& blocks() { return blocks_; }

  /// Whether all blocks that penetrate `rail` deeper than `threshold` [m] at `placement` are here.
  template <Profile R>
  [[nodiscard]] bool covers(const Rail<R>& rail, const WheelPlacement<T>& placement,
                            const T& threshold) const {
    using std::sqrt;
    if (!is_valid_ || !(checksum_ == rail.checksum()) || !(threshold_ == threshold)) return false;
    const T lateral = placement.position_rail.y() - lateral_;
    const T up = placement.position_rail.z() - up_;
    const Vector3<T> turn = axle_rail(placement) - axle_rail_;
    const T moved = sqrt(T(lateral * lateral + up * up)) + reach_ * sqrt(dot(turn, turn));
    return moved < skin_;
  }

  /// Forgets all blocks: those within the skin at `placement` will be put here.
  template <Profile R>
  void restart(const Rail<R>& rail, const WheelPlacement<T>& placement, const T& threshold) {
    blocks_.clear();
    checksum_ = rail.checksum();
    threshold_ = threshold;
    lateral_ = placement.position_rail.y();
    up_ = placement.position_rail.z();
    axle_rail_ = axle_rail(placement);
    is_valid_ = true;
  }

 private:
  [[nodiscard]] static Vector3<T> axle_rail(const WheelPlacement<T>& placement) {
    return Vector3<T>(-placement.sin_yaw, placement.cos_yaw * placement.cos_roll,
                      placement.cos_yaw * placement.sin_roll);
  }

  T skin_;
  T reach_;
  std::vector<Block> blocks_;
  bool is_valid_ = false;
  T checksum_{};
  T threshold_{};
  T lateral_{}, up_{};
  Vector3<T> axle_rail_ = Vector3<T>::UnitY();
};

}  // namespace wheelrail
