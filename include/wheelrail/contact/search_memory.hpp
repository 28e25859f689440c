#pragma once
/// @file
/// What a contact search may remember for the next one: a warm start that changes the time, not the
/// answer (in float, but for rounding). May include: core, numerics, profile, surface,
/// contact/placement.
///
/// The idea is that of neighbour lists in molecular dynamics (L. Verlet, Computer "experiments" on
/// classical fluids I, Phys. Rev. 159 (1967) 98-103), carried on to the contacts. Until the wheel
/// has moved by a `skin`, all that was proved with that much to spare need not be proved again: that
/// a part of the wheel stays above the rail, that the penetration has one extremum at most over
/// another, that it has passed the threshold or rises at its end (detail/penetration_bounds.hpp).
/// Seen along the rail, which is straight there, no point of the wheel has moved farther than
/// |o' - o| + (|u| + R) |a' - a| from one that it may be taken for: o is the profile's origin, a the
/// axle's direction, |u| and R the greatest of the profile; turning about the axle does not matter.

#include <span>
#include <vector>
#include <wheelrail/contact/detail/penetration_bounds.hpp>
#include <wheelrail/core/fixed_list.hpp>

namespace wheelrail {

namespace detail {

// A part of the wheel near the rail, and what is known of it while the memory covers the placement.
template <Real T>
struct RememberedPart {
  LocusStrip<T> left, right;  // at its ends; not exact: their signs hold, do not look at them again
  int left_index = -1, right_index = -1;  // among the wheel's strips, if they are
  // The penetration has one extremum at most; otherwise nothing is known.
  bool is_simple = false;
  T extremum = T(0);       // where it was last [m]
  T found_at = T(0);       // lateral position of the wheel then [m]
  T extremum_rate = T(0);  // by which it moves as the wheel moves to the side
  // What lies to the left: nothing near the rail, another piece, or a part with the same strip.
  enum class Joins { apart, joint, same } joins = Joins::apart;
};

}  // namespace detail

/// What a search on one wheel knows of its surroundings at some placement. Whatever it holds, in any
/// order of poses, a search gives what a cold one gives (in float, but for rounding). The caller owns it: one for each wheel on
/// its rail, used by one search at a time.
template <Real T>
class SearchMemory {
 public:
  /// @param skin how far the wheel may move, at most, before its surroundings are looked at anew [m].
  ///   Where it moves less, less is allowed for, down to a thirty-second: so more can be known.
  /// @throws std::invalid_argument unless skin is > 0 and at most a hundredth of the wheel's reach.
  /// @note Allocates; searches do not.
  template <Profile P>
  explicit SearchMemory(const Wheel<P>& wheel, const T& skin = constant<T>(1e-4L))
      : motion_{skin, detail::max(detail::magnitude(wheel.profile().lower()),
                                  detail::magnitude(wheel.profile().upper())) +
                          wheel.strips().greatest_radius()},
        skin_(skin),
        parts_(2 * wheel.strips().strips().size()) {  // two for each leaf at most
    detail::require_positive("search memory: skin", skin, "[m]");
    detail::require(T(100) * skin <= motion_.reach, "search memory: skin", skin,
                    "at most a hundredth of the wheel's greatest radius and width [m]");
  }

  /// Whether it may have been made for `wheel`: by the number of its strips.
  template <Profile P>
  [[nodiscard]] bool is_for(const Wheel<P>& wheel) const {
    return parts_.size() == 2 * wheel.strips().strips().size();
  }
  /// The motion that is allowed for.
  [[nodiscard]] const detail::WheelMotion<T>& motion() const { return motion_; }
  /// Those near the rail, from the flange to the field side.
  [[nodiscard]] std::span<detail::RememberedPart<T>> parts() { return {parts_.data(), count_}; }
  /// @pre fewer parts than twice the wheel's strips
  void add(const detail::RememberedPart<T>& part) { parts_[count_++] = part; }
  /// Keeps the first `count` ones. @pre count <= parts().size()
  void truncate(std::size_t count) { count_ = count; }

  /// Whether what is remembered holds at `placement`, for zones deeper than `threshold` [m].
  template <Profile R>
  [[nodiscard]] bool covers(const Rail<R>& rail, const WheelPlacement<T>& placement,
                            const T& threshold) const {
    using std::sqrt;
    if (!is_valid_ || !(checksum_ == rail.checksum()) || !(threshold_ == threshold)) return false;
    const T lateral = placement.position_rail.y() - lateral_;
    const T up = placement.position_rail.z() - up_;
    const Vector3<T> turn = axle_rail(placement) - axle_rail_;
    const T moved = sqrt(T(lateral * lateral + up * up)) + motion_.reach * sqrt(dot(turn, turn));
    return moved < motion_.distance;
  }

  /// Forgets all: what is known at `placement` will be put here.
  template <Profile R>
  void restart(const Rail<R>& rail, const WheelPlacement<T>& placement, const T& threshold) {
    constexpr int many_searches = 64, few_searches = 24;
    if (is_valid_ && searches_ < few_searches) {
      motion_.distance = detail::min(skin_, T(T(2) * motion_.distance));
    } else if (is_valid_ && many_searches < searches_) {
      motion_.distance = detail::max(T(skin_ / T(32)), T(motion_.distance / T(2)));
    }
    searches_ = 0;
    count_ = 0;
    checksum_ = rail.checksum();
    threshold_ = threshold;
    lateral_ = placement.position_rail.y();
    up_ = placement.position_rail.z();
    axle_rail_ = axle_rail(placement);
    is_valid_ = true;
  }

  /// The zones' ends that were found are those of the search before now, which is at `placement`.
  void begin_search(const WheelPlacement<T>& placement) {
    ++searches_;
    now_lateral_ = placement.position_rail.y();
    last_zone_ends_ = zone_ends_;
    zone_ends_.clear();
  }
  /// Where a part's extremum may be now: moved on as it did between the last two times it was found.
  [[nodiscard]] T extremum_near(const detail::RememberedPart<T>& part) const {
    return part.extremum + part.extremum_rate * (now_lateral_ - part.found_at);
  }
  /// Where it is now.
  void found_extremum(detail::RememberedPart<T>& part, const T& lateral) const {
    const T shift = now_lateral_ - part.found_at;
    if (motion_.distance / T(1000) < detail::magnitude(shift)) {
      part.extremum_rate = (lateral - part.extremum) / shift;
    }
    part.extremum = lateral;
    part.found_at = now_lateral_;
  }
  /// @param inside a strip of the zone. @param depth of it beyond the threshold [m].
  void add_zone_end(const T& lateral, const T& inside, const T& depth) {
    static_cast<void>(zone_ends_.push_back({lateral, inside, depth}));
  }
  /// Where a zone's end between two laterals may be now: as in the search before, a parabola through
  /// it and the strip inside; or `otherwise` [m].
  [[nodiscard]] T zone_end_between(const T& lower, const T& upper, const T& inside, const T& depth,
                                   const T& otherwise) const {
    using std::sqrt;
    for (const ZoneEnd& end : last_zone_ends_) {
      if (!(lower < end.lateral) || !(end.lateral < upper)) continue;
      const T moved = inside + (end.lateral - end.inside) * sqrt(T(depth / end.depth));
      return lower < moved && moved < upper ? moved : end.lateral;
    }
    return otherwise;
  }

 private:
  struct ZoneEnd {
    T lateral = T(0), inside = T(0), depth = T(0);
  };
  using ZoneEnds = FixedList<ZoneEnd, 16>;

  [[nodiscard]] static Vector3<T> axle_rail(const WheelPlacement<T>& placement) {
    return Vector3<T>(-placement.sin_yaw, placement.cos_yaw * placement.cos_roll,
                      placement.cos_yaw * placement.sin_roll);
  }

  detail::WheelMotion<T> motion_;
  T skin_;
  int searches_ = 0;                              // since the last restart
  std::vector<detail::RememberedPart<T>> parts_;  // of which the first count_ count
  std::size_t count_ = 0;
  ZoneEnds zone_ends_, last_zone_ends_;
  bool is_valid_ = false;
  T checksum_ = T(0);
  T threshold_ = T(0);
  T lateral_ = T(0), up_ = T(0);
  T now_lateral_ = T(0);  // of the wheel's position in this search [m]
  Vector3<T> axle_rail_ = Vector3<T>::UnitY();
};

}  // namespace wheelrail
