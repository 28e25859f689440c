#pragma once
/// @file
/// Lines in the cross-section that a convex rail lies under, for each direction and for each place on
/// its flat part: what stays above one of them does not touch the rail.
/// May include: core, numerics, profile.

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

/// Tangents of a convex profile, for each direction in which a point may lie from one inside.
template <Real T>
class SupportingLines {
 public:
  static constexpr int count = 512;  ///< directions

  /// Without lines.
  SupportingLines() = default;

  /// @pre profile is convex
  template <Profile P>
  explicit SupportingLines(const P& profile) {
    using std::sqrt;
    const T half_width = (profile.upper() - profile.lower()) / T(2);
    const T middle = profile.lower() + half_width;
    flat_lower_ = where_slope_is(profile, constant<T>(0.5L));
    flat_upper_ = where_slope_is(profile, constant<T>(-0.5L));
    const T flat_width = flat_upper_ - flat_lower_;
    per_lateral_ = T(count) / flat_width;
    over_.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      over_.push_back(tangent(profile, T(flat_lower_ + flat_width * T(2 * i + 1) / T(2 * count))));
    }
    inside_ = {middle, T(profile.evaluate(middle).value - half_width)};
    lines_.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      // The profile's point in the direction (sine, cosine), or the end of it that is nearest to that.
      const T sine = T(2 * i + 1 - count) / T(count);
      const T cosine = sqrt(T(T(1) - sine * sine));
      T lower = profile.lower(), upper = profile.upper();
      for (int step = 0; step < 24; ++step) {
        const T lateral = lower + (upper - lower) / T(2);
        const T up = profile.evaluate(lateral).value;
        const bool is_left = (lateral - inside_.x()) * cosine < (up - inside_.y()) * sine;
        (is_left ? lower : upper) = lateral;
      }
      lines_.push_back(tangent(profile, lower));
    }
  }

  /// Whether the profile's slope is at most 1/2 at a lateral coordinate [m]: there `over` tells nearly
  /// as much as `near`, in less time.
  [[nodiscard]] bool is_flat_at(const T& lateral) const {
    return flat_lower_ < lateral && lateral < flat_upper_;
  }

  /// A line that the profile touches nearly at a lateral coordinate [m]. @pre is_flat_at(lateral)
  [[nodiscard]] const SupportingLine<T>& over(const T& lateral) const {
    return over_[static_cast<std::size_t>(index_of(T((lateral - flat_lower_) * per_lateral_)))];
  }

  /// A line that the profile touches nearly where it is nearest to a point [m] above it.
  /// @pre there are lines
  [[nodiscard]] const SupportingLine<T>& near(const T& lateral, const T& up) const {
    using std::sqrt;
    const T dy = lateral - inside_.x(), dz = detail::max(epsilon<T>(), T(up - inside_.y()));
    return lines_[static_cast<std::size_t>(
        index_of((T(1) + dy / sqrt(T(dy * dy + dz * dz))) * T(count / 2)))];
  }

  /// `over`, or `near` where the profile is not flat, for the point of each lane: visit(lane, line).
  template <class Visit>
  void near_each(const detail::Lanes<T>& lateral, const detail::Lanes<T>& up, Visit&& visit) const {
    using Lanes = detail::Lanes<T>;
    const Lanes dy = lateral - inside_.x(), dz = (up - inside_.y()).max(epsilon<T>());
    const Lanes place = (T(1) + dy / (dy * dy + dz * dz).sqrt()) * T(count / 2);
    for (int lane = 0; lane < detail::lane_count; ++lane) {
      const bool is_flat = is_flat_at(lateral[lane]);
      visit(lane, is_flat ? over(lateral[lane])
                          : lines_[static_cast<std::size_t>(index_of(place[lane]))]);
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

  // The tangent at a lateral coordinate.
  template <Profile P>
  [[nodiscard]] static SupportingLine<T> tangent(const P& profile, const T& lateral) {
    using std::sqrt;
    const ProfilePoint<T> point = profile.evaluate(lateral);
    const T normal_up = T(1) / sqrt(T(T(1) + point.slope * point.slope));
    const Vector2<T> normal(-point.slope * normal_up, normal_up);
    return {normal, normal.x() * lateral + normal.y() * point.value};
  }

  // The index of the line at a place among all, from 0 to `count` but for rounding.
  [[nodiscard]] static int index_of(const T& place) {
    int low = 0;
    if constexpr (std::is_floating_point_v<T>) {
      low = place < T(count) ? static_cast<int>(place) : count - 1;
    } else {
      for (int high = count; low + 1 < high;) {
        const int middle = low + (high - low) / 2;
        (place < T(middle) ? high : low) = middle;
      }
    }
    return low;
  }

  Vector2<T> inside_{T(0), T(0)};
  std::vector<SupportingLine<T>> lines_;     // for each direction from there
  T flat_lower_ = T(0), flat_upper_ = T(0);  // [m]
  T per_lateral_ = T(0);                     // lines over the flat part [1/m]
  std::vector<SupportingLine<T>> over_;      // for each place on the flat part
};

}  // namespace wheelrail
