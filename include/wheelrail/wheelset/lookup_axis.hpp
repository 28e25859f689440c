#pragma once
/// @file
/// The equally spaced nodes of a lookup table along one coordinate. May include: core, std.

#include <string>
#include <type_traits>
#include <wheelrail/core/require.hpp>

namespace wheelrail {

/// The nodes of a table along one coordinate: equally spaced, both bounds among them.
template <Real T>
struct LookupRange {
  T lower = T(0);  ///< [m] or [rad]
  T upper = T(0);  ///< [m] or [rad], > lower
  T step = T(0);   ///< between neighbours, at most [m] or [rad], > 0
};

namespace detail {

/// Equally spaced nodes.
template <Real T>
class LookupAxis {
 public:
  struct Place {
    int index = -1;     // of the node before, -1 outside
    T fraction = T(0);  // of the interval
  };

  LookupAxis() = default;
  LookupAxis(const T& lower, const T& upper, int intervals)
      : lower_(lower), upper_(upper), intervals_(intervals) {
    step_ = (upper - lower) / T(intervals);
  }

  /// @throws std::invalid_argument naming @p name of table @p unit.
  [[nodiscard]] static LookupAxis of(const LookupRange<T>& range, const std::string& name,
                                     const std::string& unit) {
    const std::string what = "contact lookup: " + name;
    require_finite("contact lookup: least " + name, range.lower);
    require(is_finite(range.upper) && range.lower < range.upper, "contact lookup: greatest " + name,
            range.upper, "greater than the least one " + unit);
    require_positive(what + " step", range.step, unit);
    const T width = range.upper - range.lower;
    require(width <= T(10000) * range.step, what + " step", range.step,
            "at least 1e-4 of the range " + unit);
    int intervals = 1;
    // A range that is a multiple of the step, but for rounding, has no interval more.
    while (step_of(range, intervals) < width) ++intervals;
    return LookupAxis(range.lower, range.upper, intervals);
  }

  [[nodiscard]] int intervals() const { return intervals_; }
  [[nodiscard]] int nodes() const { return intervals_ + 1; }
  [[nodiscard]] const T& lower() const { return lower_; }
  [[nodiscard]] const T& upper() const { return upper_; }
  [[nodiscard]] T node(int i) const { return i == intervals_ ? upper_ : T(lower_ + step_ * T(i)); }

  /// The interval that holds @p x.
  [[nodiscard]] Place place(const T& x) const {
    if (x < lower_ || upper_ < x) return {};
    const int i = interval(x);
    const T left = node(i);
    return {i, T((x - left) / (node(i + 1) - left))};
  }

 private:
  [[nodiscard]] static T step_of(const LookupRange<T>& range, int intervals) {
    return range.step * (T(intervals) + constant<T>(1e-3L));
  }

  [[nodiscard]] int interval(const T& x) const {
    if constexpr (std::is_floating_point_v<T>) {
      int i = static_cast<int>((x - lower_) / step_);
      i = i < intervals_ ? i : intervals_ - 1;
      // One off at most, by rounding of the nodes.
      if (i > 0 && x < node(i)) --i;
      if (i + 1 < intervals_ && node(i + 1) <= x) ++i;
      return i;
    } else {
      int low = 0, high = intervals_;
      while (low + 1 < high) {
        const int middle = low + (high - low) / 2;
        (x < node(middle) ? high : low) = middle;
      }
      return low;
    }
  }

  T lower_ = T(0), upper_ = T(0), step_ = T(0);
  int intervals_ = 1;
};

}  // namespace detail
}  // namespace wheelrail
