#pragma once
/// @file
/// Contact kinematics over a range of lateral shifts, with the jumps of the contact points.
/// May include: all but dynamics and io.

#include <string>
#include <utility>
#include <vector>
#include <wheelrail/core/require.hpp>
#include <wheelrail/wheelset/kinematics.hpp>

namespace wheelrail {

/// Which lateral shifts a table holds, and how closely jumps are looked for.
template <Real T>
struct KinematicsRange {
  T lower = constant<T>(-0.01L);  ///< least lateral shift [m]
  T upper = constant<T>(0.01L);   ///< greatest lateral shift [m], > lower
  T step = constant<T>(0.5e-3L);  ///< between neighbouring shifts, at most (to rounding) [m], > 0
  T yaw = T(0);                   ///< of all of them, to the left [rad]
  /// Where a contact point moves by more than contact_step over the wheel from one shift to the
  /// next, shifts are put in between [m], > 0.
  T contact_step = constant<T>(1e-3L);
  /// It jumps if it still does when they are this close [m], > 0.
  T jump_width = constant<T>(1e-7L);
};

/// A contact point leaves one place of the wheel for another between two shifts of a table.
template <Real T>
struct ContactJump {
  std::size_t before = 0;         ///< index of the shift before it; that after it is the next
  Side side = Side::left;         ///< of the wheel
  T lateral_shift = T(0);         ///< half-way between both [m]
  T wheel_lateral_before = T(0);  ///< contact point at the shift before [m]
  T wheel_lateral_after = T(0);   ///< contact point at the shift after [m]
};

/// Kinematics over lateral shifts. Invariant: the shifts grow strictly; the first and the last one
/// are the range's; all that are multiples of the step from its middle are there.
template <Real T>
struct KinematicsTable {
  std::vector<WheelsetKinematics<T>> shifts;  ///< in the order of lateral_shift
  std::vector<ContactJump<T>> jumps;          ///< in the order of lateral_shift
};

namespace detail {

/// Fills the gaps of a table where a contact point moves fast.
template <Profile P, class Track>
class TableRefinement {
 public:
  using T = typename P::Scalar;

  TableRefinement(const Wheelset<P>& wheelset, const Track& track, const KinematicsRange<T>& range,
                  const KinematicsOptions<T>& options)
      : wheelset_(wheelset), track_(track), range_(range), options_(options) {}

  void append(const WheelsetKinematics<T>& next) {
    if (!table_.shifts.empty()) close_gap(WheelsetKinematics<T>(table_.shifts.back()), next, 0);
    table_.shifts.push_back(next);
  }

  [[nodiscard]] KinematicsTable<T>&& take() { return std::move(table_); }

 private:
  [[nodiscard]] T contact_motion(Side side, const WheelsetKinematics<T>& one,
                                 const WheelsetKinematics<T>& other) const {
    return magnitude(
        T(one.wheel(side).contact().wheel_lateral - other.wheel(side).contact().wheel_lateral));
  }

  // What lies between two neighbouring shifts, the first of which is the last in the table.
  void close_gap(const WheelsetKinematics<T>& one, const WheelsetKinematics<T>& other, int depth) {
    if (one.status != TouchStatus::touching || other.status != TouchStatus::touching) return;
    const T width = other.lateral_shift - one.lateral_shift;
    const T middle = one.lateral_shift + width / T(2);
    const bool is_wide = range_.jump_width < width && one.lateral_shift < middle &&
                         middle < other.lateral_shift && depth < 60;
    bool moves = false;
    for (const Side side : sides) {
      if (!(range_.contact_step < contact_motion(side, one, other))) continue;
      moves = true;
      if (is_wide) continue;
      table_.jumps.push_back({table_.shifts.size() - 1, side, middle,
                              one.wheel(side).contact().wheel_lateral,
                              other.wheel(side).contact().wheel_lateral});
    }
    if (!moves || !is_wide) return;
    const auto at =
        WheelsetSetter<P, Track>(wheelset_, track_, options_, middle, range_.yaw).run(one);
    close_gap(one, at, depth + 1);
    table_.shifts.push_back(at);
    close_gap(at, other, depth + 1);
  }

  const Wheelset<P>& wheelset_;
  const Track& track_;
  const KinematicsRange<T>& range_;
  const KinematicsOptions<T>& options_;
  KinematicsTable<T> table_;
};

}  // namespace detail

/// Kinematics for the shifts of a range, from its middle outwards. A shift where the wheelset does
/// not touch has its status in the table.
/// @throws std::invalid_argument unless lower < upper, all steps are finite and > 0, and there are
///   at most 100,000 steps, and unless the options keep their rules.
/// @note Allocates.
template <Profile P, class Track>
[[nodiscard]] KinematicsTable<typename P::Scalar> kinematics_table(
    const Wheelset<P>& wheelset, const Track& track,
    const KinematicsRange<typename P::Scalar>& range = {},
    const KinematicsOptions<typename P::Scalar>& options = {}) {
  using T = typename P::Scalar;
  detail::require_finite("kinematics: least lateral shift", range.lower);
  detail::require(is_finite(range.upper) && range.lower < range.upper,
                  "kinematics: greatest lateral shift", range.upper,
                  "greater than the least one [m]");
  detail::require_positive("kinematics: step", range.step, "[m]");
  detail::require_positive("kinematics: contact step", range.contact_step, "[m]");
  detail::require_positive("kinematics: jump width", range.jump_width, "[m]");
  detail::require_positive("kinematics: closeness", options.closeness, "[m]");
  detail::require_not_negative("kinematics: tolerance", options.tolerance, "[m]");
  detail::require(1 <= options.maximum_iterations,
                  "kinematics: there are " + std::to_string(options.maximum_iterations) +
                      " iterations at most, but there must be at least 1");
  const T half_width = (range.upper - range.lower) / T(2);
  detail::require(half_width < T(50000) * range.step, "kinematics: step", range.step,
                  "at least 1e-5 of the range [m]");
  // What the ends are off by as rounded decimal numbers is no step of its own.
  const T rounding = T(4) * epsilon<T>() *
                     detail::max(detail::magnitude(range.lower), detail::magnitude(range.upper));
  int count = 1;  // on either side of the middle
  while (range.step * T(count) < half_width - rounding) ++count;
  const T middle = range.lower + half_width;
  const auto shift = [&](int i) {
    if (i == -count) return range.lower;
    return i == count ? range.upper : T(middle + range.step * T(i));
  };
  std::vector<WheelsetKinematics<T>> shifts(static_cast<std::size_t>(2 * count + 1));
  const auto at = [&](int i) -> WheelsetKinematics<T>& {
    return shifts[static_cast<std::size_t>(i + count)];
  };
  const auto solve = [&](int i, const WheelsetKinematics<T>& start) {
    const detail::WheelsetSetter<P, Track> setter(wheelset, track, options, shift(i), range.yaw);
    at(i) =
        setter.run(start.status == TouchStatus::touching ? start : detail::level_start(wheelset));
  };
  solve(0, {});
  for (int i = 1; i <= count; ++i) {
    solve(i, at(i - 1));
    solve(-i, at(1 - i));
  }
  detail::TableRefinement<P, Track> refinement(wheelset, track, range, options);
  for (const WheelsetKinematics<T>& state : shifts) refinement.append(state);
  return refinement.take();
}

}  // namespace wheelrail
