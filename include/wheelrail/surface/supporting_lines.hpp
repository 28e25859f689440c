#pragma once
/// @file
/// Lines in the cross-section that a convex rail lies under, one for each direction: what stays above
/// one of them does not touch the rail. May include: core, numerics, profile.

#include <vector>
#include <wheelrail/core/detail/lanes.hpp>
#include <wheelrail/core/vector.hpp>
#include <wheelrail/profile/profile.hpp>

namespace wheelrail {

/// A line that a whole profile lies under: normal . point <= height, for its points (lateral, up).
template <Real T>
struct SupportingLine {
  Vector2<T> normal{T(0), T(0)};  ///< outward: (lateral, up)
  T height{};                     ///< [m]
};

/// Tangents of a convex profile, for each direction in which a point may lie from one inside.
template <Real T>
class SupportingLines {
 public:
  static constexpr int count = 512;

  /// Without lines.
  SupportingLines() = default;

  /// @pre profile is convex
  template <Profile P>
  explicit SupportingLines(const P& profile) {
    using std::sqrt;
    const T half_width = (profile.upper() - profile.lower()) / T(2);
    const T middle = profile.lower() + half_width;
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
      const ProfilePoint<T> point = profile.evaluate(lower);
      const T normal_up = T(1) / sqrt(T(T(1) + point.slope * point.slope));
      const Vector2<T> normal(-point.slope * normal_up, normal_up);
      lines_.push_back({normal, normal.x() * lower + normal.y() * point.value});
    }
  }

  /// A line that the profile touches nearly where it is nearest to a point [m] above it.
  /// @pre there are lines
  [[nodiscard]] const SupportingLine<T>& near(const T& lateral, const T& up) const {
    using std::sqrt;
    const T dy = lateral - inside_.x(), dz = detail::max(T(0), T(up - inside_.y()));
    return line((T(1) + dy / sqrt(T(dy * dy + dz * dz))) * T(count / 2));
  }

  /// `near` for the point of each lane: visit(lane, line).
  template <class Visit>
  void near_each(const detail::Lanes<T>& lateral, const detail::Lanes<T>& up, Visit&& visit) const {
    using Lanes = detail::Lanes<T>;
    const Lanes dy = lateral - inside_.x(), dz = (up - inside_.y()).max(T(0));
    const Lanes place = (T(1) + dy / (dy * dy + dz * dz).sqrt()) * T(count / 2);
    if constexpr (std::is_floating_point_v<T>) {
      const Lanes least = Lanes::Zero(), greatest = detail::all_lanes(T(count - 1));
      const Lanes from_least = detail::choose<T>(detail::less<T>(least, place), place, least);
      const Lanes within =
          detail::choose<T>(detail::less<T>(from_least, greatest), from_least, greatest);
      for (int lane = 0; lane < detail::lane_count; ++lane) {
        visit(lane, lines_[static_cast<std::size_t>(static_cast<int>(within[lane]))]);
      }
    } else {
      for (int lane = 0; lane < detail::lane_count; ++lane) visit(lane, line(place[lane]));
    }
  }

 private:
  // The line at a place among all, from 0 to `count`.
  [[nodiscard]] const SupportingLine<T>& line(const T& place) const {
    int low = 0;
    if constexpr (std::is_floating_point_v<T>) {
      if (T(0) < place) low = place < T(count) ? static_cast<int>(place) : count - 1;
    } else {
      for (int high = count; low + 1 < high;) {
        const int middle = low + (high - low) / 2;
        (place < T(middle) ? high : low) = middle;
      }
    }
    return lines_[static_cast<std::size_t>(low)];
  }

  Vector2<T> inside_{T(0), T(0)};
  std::vector<SupportingLine<T>> lines_;
};

}  // namespace wheelrail
