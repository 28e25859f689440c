#pragma once
/// @file
/// A lookup table of one wheel's contact over lateral shift, roll and yaw, for fast studies, and by
/// how much it is wrong: its error against the online search is measured when it is made.
/// May include: all but dynamics and io.
///
/// At the table's nodes the wheel is set down on its rail. What is known in closed form is not
/// tabulated: on a straight track the yaw counts by its square only (57)-(60); the gradient of the
/// height at which the wheel touches follows from the contact normal (virtual work); how the contact
/// deepens and moves when the wheel is lower than that follows from normal and curvatures.
/// One patch is looked up, the deepest. Cells where another place of the wheel may be the deepest, or
/// where there may be several patches, are flagged, and a result says so.

#include <array>
#include <concepts>
#include <cstdint>
#include <random>
#include <string>
#include <vector>
#include <wheelrail/wheelset/contact_lookup_report.hpp>
#include <wheelrail/wheelset/kinematics.hpp>
#include <wheelrail/wheelset/lookup_axis.hpp>

namespace wheelrail {

/// What a table covers, and how its error is measured.
template <Real T>
struct ContactLookupOptions {
  /// Of the axle's centre, to the left [m].
  LookupRange<T> lateral_shift{constant<T>(-0.008L), constant<T>(0.008L), constant<T>(0.25e-3L)};
  /// [rad], positive where the left wheel rises.
  LookupRange<T> roll{constant<T>(-2e-3L), constant<T>(2e-3L), constant<T>(0.25e-3L)};
  T greatest_yaw = constant<T>(0.02L);  ///< the table covers |yaw| <= greatest_yaw [rad], > 0
  int yaw_intervals = 4;                ///< equal in yaw^2, >= 1
  /// The table covers penetration <= greatest_penetration [m], > 0. A cell is flagged for several
  /// patches where a node has them at this penetration, a half or a quarter of it.
  T greatest_penetration = constant<T>(1e-4L);
  /// A cell is flagged for a jump where the contact points of its nodes lie more than contact_step
  /// apart on the wheel [m], > 0. On a convex rail the contact point moves to one side only as shift
  /// and roll grow, so that without yaw no unflagged cell holds a greater jump.
  T contact_step = constant<T>(2e-3L);
  int poses = 2000;        ///< at which the error is measured, >= 1
  std::uint64_t seed = 1;  ///< of these poses: std::mt19937_64
};

/// The table of one wheel of a wheelset on its rail of a straight track. It holds no reference to
/// them. Valid for good once constructed.
///
/// Between the nodes: the touching height by the blend of the corners' heights, each moved half-way
/// along its gradient, which is exact for quadratics and continuous: the error is of third order in
/// the steps of shift and roll, of second order in that of yaw^2. The geometry is multilinear: second
/// order. Both hold where the curvatures are smooth; where profiles of arcs pass from one to the
/// next, the height is of second order and the geometry of first. In cells flagged for a jump the
/// highest of the corners' tangent planes is the height, and the corner that is the deepest by its
/// own plane is the contact: between two places there is none.
template <Real T>
class ContactLookup {
 public:
  /// Sets the wheel down at every node, and measures the error.
  /// @param track anything with `rail(side)` and `nearest_frame(side, point_track, guess)`, straight
  ///   along x at x = 0, where the axle's centre is.
  /// @throws std::invalid_argument naming the first option that breaks its rule, and where there are
  ///   more than 10 million nodes.
  /// @note Allocates. Some 30 us a node.
  template <Profile P, class Track>
  requires std::same_as<typename P::Scalar, T> ContactLookup(
      const Wheelset<P>& wheelset, const Track& track, Side side,
      const ContactLookupOptions<T>& options = {})
      : options_(options), side_(side) {
    check_options();
    const Online<P, Track> online{wheelset, track, side};
    set_down_at_nodes(online);
    measure(online);
  }

  /// The contact at a pose of the wheelset.
  /// @param lateral_shift of the axle's centre, to the left [m]. @param height of it [m].
  /// @param roll [rad], positive where the left wheel rises. @param yaw to the left [rad].
  /// @return the deepest patch, with flags and status: see ContactLookupResult.
  /// @note Does not allocate. Differentiable within a cell.
  [[nodiscard]] ContactLookupResult<T> at(const T& lateral_shift, const T& height, const T& roll,
                                          const T& yaw) const {
    ContactLookupResult<T> result;
    if (!is_finite(lateral_shift) || !is_finite(height) || !is_finite(roll) || !is_finite(yaw)) {
      return result;
    }
    result.status = LookupStatus::outside;
    const Cell cell{shifts_.place(lateral_shift), rolls_.place(roll),
                    squared_yaws_.place(T(yaw * yaw))};
    if (cell.shift.index < 0 || cell.roll.index < 0 || cell.yaw.index < 0) return result;
    const std::uint8_t flags = flags_[cell_index(cell)];
    result.may_jump = (flags & jump_flag) != 0;
    result.may_have_several = (flags & several_flag) != 0;
    result.status = LookupStatus::no_contact;
    if ((flags & void_flag) != 0) return result;
    const T drop = result.may_jump ? choose(cell, lateral_shift, roll, height, result)
                                   : blend(cell, lateral_shift, roll, height, result);
    lower(drop, result);
    return result;
  }

  [[nodiscard]] const LookupReport<T>& report() const { return report_; }  ///< its measured error
  /// As they were given.
  [[nodiscard]] const ContactLookupOptions<T>& options() const { return options_; }
  [[nodiscard]] Side side() const { return side_; }  ///< of the wheel

  /// What nodes and flags take [bytes].
  [[nodiscard]] std::size_t memory() const {
    return nodes_.size() * sizeof(Node) + flags_.size() * sizeof(std::uint8_t);
  }

 private:
  struct Node {
    LookupContact<T> contact;
    T height = T(0), by_shift = T(0),
      by_roll = T(0);  // at which the wheel touches, and its gradient
  };
  using Axis = detail::LookupAxis<T>;
  struct Cell {
    typename Axis::Place shift, roll, yaw;
  };
  struct Pose {
    T lateral_shift, height, roll, yaw;
  };

  static constexpr std::uint8_t jump_flag = 1, several_flag = 2, void_flag = 4;

  // The search that the table stands for.
  template <class P, class Track>
  struct Online {
    const Wheelset<P>& wheelset;
    const Track& track;
    Side side;

    [[nodiscard]] WheelTouch<T> set_down(const Pose& start) const {
      return detail::WheelsetSetter<P, Track>(wheelset, track, {}, start.lateral_shift, start.yaw)
          .set_down(side, start.roll, start.height);
    }
    [[nodiscard]] ContactResult<T> find(const Pose& pose) const {
      const auto at = WheelsetPosition<T>::of(pose.lateral_shift, pose.height, pose.roll, pose.yaw);
      return find_contact(wheelset.wheel(side), track.rail(side),
                          place_wheel(wheelset, track, side, at),
                          SearchOptions<ValueOf<T>>{.zone_ends = false});
    }
    // The pose at which a wheel that touches penetrates, nearly.
    [[nodiscard]] Pose pressed(const Pose& at, const WheelTouch<T>& touch,
                               const T& penetration) const {
      using std::cos;
      Pose lower = at;
      lower.height = touch.height - penetration / T(cos(touch.contact().contact_angle));
      return lower;
    }
  };

  void check_options() {
    detail::require_positive("contact lookup: greatest yaw", options_.greatest_yaw, "[rad]");
    detail::require(options_.greatest_yaw < T(1), "contact lookup: greatest yaw",
                    options_.greatest_yaw, "less than 1 [rad]");
    detail::require(1 <= options_.yaw_intervals && options_.yaw_intervals <= 10000,
                    "contact lookup: there are " + std::to_string(options_.yaw_intervals) +
                        " yaw intervals, but must be 1 to 10000");
    detail::require_positive("contact lookup: greatest penetration", options_.greatest_penetration,
                             "[m]");
    detail::require_positive("contact lookup: contact step", options_.contact_step, "[m]");
    detail::require(1 <= options_.poses, "contact lookup: there are " +
                                             std::to_string(options_.poses) +
                                             " poses, but must be at least 1");
    shifts_ = Axis::of(options_.lateral_shift, "lateral shift", "[m]");
    rolls_ = Axis::of(options_.roll, "roll", "[rad]");
    detail::require(detail::magnitude(rolls_.lower()) < T(1) && rolls_.upper() < T(1),
                    "contact lookup: the rolls must be less than 1 [rad]");
    squared_yaws_ =
        Axis(T(0), T(options_.greatest_yaw * options_.greatest_yaw), options_.yaw_intervals);
    const std::int64_t nodes =
        std::int64_t{shifts_.nodes()} * rolls_.nodes() * squared_yaws_.nodes();
    detail::require(nodes <= 10'000'000, "contact lookup: there are " + std::to_string(nodes) +
                                             " nodes, but must be at most 10000000");
  }

  [[nodiscard]] std::size_t node_index(int shift, int roll, int yaw) const {
    return static_cast<std::size_t>(
        (std::int64_t{shift} * rolls_.nodes() + roll) * squared_yaws_.nodes() + yaw);
  }
  [[nodiscard]] std::size_t cell_index(const Cell& cell) const {
    return static_cast<std::size_t>(
        (std::int64_t{cell.shift.index} * rolls_.intervals() + cell.roll.index) *
            squared_yaws_.intervals() +
        cell.yaw.index);
  }
  [[nodiscard]] const Node& corner(const Cell& cell, int i, int j, int k) const {
    return nodes_[node_index(cell.shift.index + i, cell.roll.index + j, cell.yaw.index + k)];
  }

  template <class Online>
  void set_down_at_nodes(const Online& online) {
    using std::sqrt;
    nodes_.resize(node_index(shifts_.nodes() - 1, rolls_.nodes() - 1, squared_yaws_.nodes() - 1) +
                  1);
    std::vector<std::uint8_t> node_flags(nodes_.size(), 0);
    const WheelsetKinematics<T> level = detail::level_start(online.wheelset);
    const WheelTouch<T>& level_wheel = level.wheel(side_);
    for (int j = 0; j < rolls_.nodes(); ++j) {
      for (int k = 0; k < squared_yaws_.nodes(); ++k) {
        const T roll = rolls_.node(j);
        const T level_height = level_wheel.height + level_wheel.height_by_roll * roll;
        T start = level_height;
        for (int i = 0; i < shifts_.nodes(); ++i) {
          const Pose pose{shifts_.node(i), start, roll, T(sqrt(squared_yaws_.node(k)))};
          const WheelTouch<T> touch = online.set_down(pose);
          const std::size_t index = node_index(i, j, k);
          start = level_height;
          node_flags[index] = void_flag;
          if (touch.status != TouchStatus::touching) continue;
          start = touch.height;
          nodes_[index] = node_of(touch);
          node_flags[index] = has_several(online, pose, touch) ? several_flag : std::uint8_t{0};
        }
      }
    }
    flag_cells(node_flags);
  }

  [[nodiscard]] static Node node_of(const WheelTouch<T>& touch) {
    const Patch<T>& patch = touch.contact();
    return {{patch.wheel_lateral, patch.rail_lateral, patch.contact_angle, patch.rolling_radius,
             patch.wheel_longitudinal_curvature, patch.wheel_lateral_curvature,
             patch.rail_lateral_curvature},
            touch.height,
            touch.height_by_shift,
            touch.height_by_roll};
  }

  template <class Online>
  [[nodiscard]] bool has_several(const Online& online, const Pose& pose,
                                 const WheelTouch<T>& touch) const {
    for (const int part : {1, 2, 4}) {
      const T penetration = options_.greatest_penetration / T(part);
      const auto found = online.find(online.pressed(pose, touch, penetration));
      if (found.status != SearchStatus::complete || found.patches.size() > 1) return true;
    }
    return false;
  }

  void flag_cells(const std::vector<std::uint8_t>& node_flags) {
    flags_.reserve(static_cast<std::size_t>(shifts_.intervals()) *
                   static_cast<std::size_t>(rolls_.intervals()) *
                   static_cast<std::size_t>(squared_yaws_.intervals()));
    for (int i = 0; i < shifts_.intervals(); ++i) {
      for (int j = 0; j < rolls_.intervals(); ++j) {
        for (int k = 0; k < squared_yaws_.intervals(); ++k) {
          flags_.push_back(flags_of_cell(i, j, k, node_flags));
          const std::uint8_t flags = flags_.back();
          const bool is_void = (flags & void_flag) != 0;
          ++report_.cells;
          report_.void_cells += is_void ? 1 : 0;
          if (is_void) continue;
          report_.jump_cells += (flags & jump_flag) != 0 ? 1 : 0;
          report_.several_cells += (flags & several_flag) != 0 ? 1 : 0;
          report_.flagged_cells += flags != 0 ? 1 : 0;
        }
      }
    }
  }

  [[nodiscard]] std::uint8_t flags_of_cell(int i, int j, int k,
                                           const std::vector<std::uint8_t>& node_flags) const {
    int flags = 0;
    T least = nodes_[node_index(i, j, k)].contact.wheel_lateral, greatest = least;
    for (int c = 0; c < 8; ++c) {
      const std::size_t node = node_index(i + (c & 1), j + ((c >> 1) & 1), k + (c >> 2));
      flags |= node_flags[node];
      least = detail::min(least, nodes_[node].contact.wheel_lateral);
      greatest = detail::max(greatest, nodes_[node].contact.wheel_lateral);
    }
    if ((flags & void_flag) != 0) return void_flag;
    if (options_.contact_step < greatest - least) flags |= jump_flag;
    return static_cast<std::uint8_t>(flags);
  }

  // By how much the height changes from a corner to a pose, along the gradient there.
  [[nodiscard]] T rise(const Cell& cell, const Node& node, int i, int j, const T& shift,
                       const T& roll) const {
    return node.by_shift * (shift - shifts_.node(cell.shift.index + i)) +
           node.by_roll * (roll - rolls_.node(cell.roll.index + j));
  }
  [[nodiscard]] static T weight_of(const typename Axis::Place& place, int end) {
    return end == 1 ? place.fraction : T(T(1) - place.fraction);
  }

  // Every quantity of the cell's corners, weighted. Returns how much lower the wheel is than where
  // it touches. (On S1002 and 60E1 with the default steps the height's greatest error is a fifth
  // of that without gradients.)
  [[nodiscard]] T blend(const Cell& cell, const T& shift, const T& roll, const T& height,
                        ContactLookupResult<T>& result) const {
    LookupContact<T> sum{T(0), T(0), T(0), T(0), T(0), T(0), T(0)};
    T touching_height = T(0);
    for (int c = 0; c < 8; ++c) {
      const int i = c & 1, j = (c >> 1) & 1, k = c >> 2;
      const Node& node = corner(cell, i, j, k);
      const LookupContact<T>& at = node.contact;
      const T weight = weight_of(cell.shift, i) * weight_of(cell.roll, j) * weight_of(cell.yaw, k);
      touching_height += weight * (node.height + rise(cell, node, i, j, shift, roll) / T(2));
      sum.wheel_lateral += weight * at.wheel_lateral;
      sum.rail_lateral += weight * at.rail_lateral;
      sum.contact_angle += weight * at.contact_angle;
      sum.rolling_radius += weight * at.rolling_radius;
      sum.wheel_longitudinal_curvature += weight * at.wheel_longitudinal_curvature;
      sum.wheel_lateral_curvature += weight * at.wheel_lateral_curvature;
      sum.rail_lateral_curvature += weight * at.rail_lateral_curvature;
    }
    result.contact = sum;
    result.touching_height = touching_height;
    return touching_height - height;
  }

  // Whichever place is the first to touch holds the wheel up; whichever is the deepest is the
  // contact, at the yaw nearer by. Returns how much lower the wheel is than where that one touches.
  [[nodiscard]] T choose(const Cell& cell, const T& shift, const T& roll, const T& height,
                         ContactLookupResult<T>& result) const {
    using std::cos;
    const int nearer = cell.yaw.fraction < constant<T>(0.5L) ? 0 : 1;
    std::array<T, 2> highest{};
    const auto height_by = [&](int c, int k) {
      const Node& node = corner(cell, c & 1, c >> 1, k);
      return T(node.height + rise(cell, node, c & 1, c >> 1, shift, roll));
    };
    for (int k = 0; k < 2; ++k) {
      T& top = highest[static_cast<std::size_t>(k)];
      top = height_by(0, k);
      for (int c = 1; c < 4; ++c) top = detail::max(top, height_by(c, k));
    }
    result.touching_height =
        weight_of(cell.yaw, 0) * highest[0] + weight_of(cell.yaw, 1) * highest[1];
    const T by_yaw = result.touching_height - highest[static_cast<std::size_t>(nearer)];
    T deepest = T(0), drop = T(0);
    for (int c = 0; c < 4; ++c) {
      const LookupContact<T>& contact = corner(cell, c & 1, c >> 1, nearer).contact;
      const T below = height_by(c, nearer) + by_yaw - height;
      const T penetration = below * T(cos(contact.contact_angle));
      if (c > 0 && !(deepest < penetration)) continue;
      deepest = penetration;
      drop = below;
      result.contact = contact;
    }
    return drop;
  }

  // Lowers the wheel from the height at which it touches: by `drop` cos(angle) along the normal, and
  // by `drop` sin(angle) along the contact plane, where contact moves as on two circles.
  void lower(const T& drop, ContactLookupResult<T>& result) const {
    using std::cos;
    using std::sin;
    LookupContact<T>& contact = result.contact;
    const T cosine = cos(contact.contact_angle), sine = sin(contact.contact_angle);
    result.penetration = drop * cosine;
    result.status = LookupStatus::not_touching;
    if (!(T(0) < drop)) return;
    const T along = drop * sine;
    const T sum = contact.wheel_lateral_curvature + contact.rail_lateral_curvature;
    if (T(0) < sum) {
      const T on_wheel = detail::clamp(T(along * contact.rail_lateral_curvature / sum),
                                       T(-options_.contact_step), options_.contact_step);
      const T turn = on_wheel * contact.wheel_lateral_curvature;
      result.penetration -= along * turn / T(2);
      contact.wheel_lateral += on_wheel * cosine;
      contact.rail_lateral += (on_wheel - along) * cosine;
      contact.rolling_radius -= on_wheel * sine;
      contact.contact_angle += turn;
    }
    result.status = LookupStatus::found;
    if (!(options_.greatest_penetration < result.penetration)) return;
    const ContactLookupResult<T> flags = result;
    result = {};
    result.may_jump = flags.may_jump;
    result.may_have_several = flags.may_have_several;
    result.status = LookupStatus::too_deep;
  }

  template <class Online>
  void measure(const Online& online) {
    std::mt19937_64 engine(options_.seed);
    const auto uniform = [&engine](const T& lower, const T& upper) {
      // The upper 53 bits, as two whole numbers that an int holds.
      const std::uint64_t bits = engine() >> 11;
      const T upper_part = T(static_cast<int>(bits >> 27));
      const T lower_part = T(static_cast<int>(bits & ((1U << 27) - 1)));
      const T fraction = (upper_part + lower_part / T(1 << 27)) / T(1 << 26);
      return T(lower + fraction * (upper - lower));
    };
    detail::LookupErrorSum<T> plain, flagged;
    const T radius = online.wheelset.wheel(side_).nominal_radius();
    for (int n = 0; n < options_.poses; ++n) {
      Pose pose;
      pose.lateral_shift = uniform(shifts_.lower(), shifts_.upper());
      pose.roll = uniform(rolls_.lower(), rolls_.upper());
      pose.yaw = uniform(T(-options_.greatest_yaw), options_.greatest_yaw);
      // Not quite the greatest penetration: beyond it there is nothing to compare.
      const T penetration = uniform(T(0), options_.greatest_penetration) * constant<T>(0.98L);
      pose.height = radius;
      ++report_.unmeasured;
      const WheelTouch<T> touch = online.set_down(pose);
      if (touch.status != TouchStatus::touching) continue;
      pose = online.pressed(pose, touch, penetration);
      const ContactResult<T> found = online.find(pose);
      if (found.status != SearchStatus::complete || found.patches.empty()) continue;
      --report_.unmeasured;
      const Patch<T>* deepest = &found.patches[0];
      for (const Patch<T>& patch : found.patches) {
        if (deepest->penetration < patch.penetration) deepest = &patch;
      }
      const auto looked_up = at(pose.lateral_shift, pose.height, pose.roll, pose.yaw);
      if (!is_finite(looked_up.penetration)) {
        ++report_.refused;
        continue;
      }
      (looked_up.is_flagged() ? flagged : plain)
          .add(looked_up, touch.height, *deepest, found.patches.size(), options_.contact_step);
    }
    report_.plain = plain.result();
    report_.flagged = flagged.result();
  }

  ContactLookupOptions<T> options_;
  Side side_;
  Axis shifts_, rolls_, squared_yaws_;
  std::vector<Node> nodes_;          // by shift, roll, yaw
  std::vector<std::uint8_t> flags_;  // of the cells, in the same order
  LookupReport<T> report_;
};

}  // namespace wheelrail
