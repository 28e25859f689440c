#pragma once
/// @file
/// Lines in the cross-section that a convex rail lies under, one for each place across it: what stays
/// above one of them does not touch the rail. May include: core, numerics, profile.

#include <vector>
#include <wheelrail/core/detail/lanes.hpp>
#include <wheelrail/core/vector.hpp>
#include <wheelrail/profile/profile.hpp>

namespace wheelrail {

/// A line that a whole profile lies under: normal . point <= height, for its points (lateral, up).
template <Real T>
struct SupportingLine {
  Vector2<T> normal{T(0), T(0)};  ///< outward: (lateral, up)
  T height = T(0);                ///< [m]
};

/// Tangents of a convex profile, at places across it where it is no steeper than `steepest` (72 degrees,
/// a usual flange's). Beyond, the last one stands for all: steeper ones saved no strips of a search.
template <Real T>
class SupportingLines {
 public:
  static constexpr int count = 512;   ///< lines
  static constexpr int steepest = 3;  ///< slope of the profile [-]

  /// Without lines.
  SupportingLines() = default;

  /// @pre profile is convex
  template <Profile P>
  explicit SupportingLines(const P& profile) : lower_(where_slope_is(profile, T(steepest))) {
    using std::sqrt;
    const T width = where_slope_is(profile, T(-steepest)) - lower_;
    per_lateral_ = T(0) < width ? T(T(count) / width) : T(0);
    lines_.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      const T lateral = lower_ + width * T(2 * i + 1) / T(2 * count);
      const ProfilePoint<T> point = profile.evaluate(lateral);
      const T normal_up = T(1) / sqrt(T(T(1) + point.slope * point.slope));
      const Vector2<T> normal(-point.slope * normal_up, normal_up);
      lines_.push_back({normal, normal.x() * lateral + normal.y() * point.value});
    }
  }

  /// The line that the profile touches nearly at @p lateral [m], or nearest to there.
  /// @pre there are lines, and lateral is finite
  [[nodiscard]] const SupportingLine<T>& over(const T& lateral) const {
    const T place = (lateral - lower_) * per_lateral_;
    int low = 0;
    if constexpr (std::is_floating_point_v<T>) {
      low = place < T(count) ? static_cast<int>(detail::max(T(0), place)) : count - 1;
    } else {
      for (int high = count; low + 1 < high;) {
        const int middle = low + (high - low) / 2;
        (place < T(middle) ? high : low) = middle;
      }
    }
    return lines_[static_cast<std::size_t>(low)];
  }

  /// That of each lane: visit(lane, line).
  template <class Visit>
  void over_each(const detail::Lanes<T>& lateral, const Visit& visit) const {
    if constexpr (std::is_floating_point_v<T>) {
      const detail::Lanes<T> place =
          ((lateral - lower_) * per_lateral_).max(T(0)).min(T(count - 1));
      for (int lane = 0; lane < detail::lane_count; ++lane) {
        visit(lane, lines_[static_cast<std::size_t>(static_cast<int>(place[lane]))]);
      }
    } else {
      for (int lane = 0; lane < detail::lane_count; ++lane) visit(lane, over(lateral[lane]));
    }
  }

 private:
  // Where a convex profile's slope passes a value, or the end that is nearest to that.
  template <Profile P>
  [[nodiscard]] static T where_slope_is(const P& profile, const T& slope) {
    T lower = profile.lower(), upper = profile.upper();
    for (int step = 0; step < 24; ++step) {
      const T lateral = lower + (upper - lower) / T(2);
      (slope < profile.evaluate(lateral).slope ? lower : upper) = lateral;
    }
    return lower + (upper - lower) / T(2);
  }

  T lower_ = T(0);        // [m]
  T per_lateral_ = T(0);  // lines [1/m]
  std::vector<SupportingLine<T>> lines_;
};

}  // namespace wheelrail
