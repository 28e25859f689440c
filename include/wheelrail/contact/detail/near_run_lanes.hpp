#pragma once
// NearRuns in lanes: one walk over a wheel's strip trees for several placements.
// May include: core, numerics, profile, surface, contact/placement.

#include <wheelrail/contact/detail/locus_strip_lanes.hpp>
#include <wheelrail/contact/detail/near_runs.hpp>

namespace wheelrail::detail {

// How many strips near_part leaves off both ends of a node in each lane.
template <Real T>
struct NearPartLanes {
  std::array<int, lane_count> left_off_first, left_off_last;
};

// near_part in lanes, by the parts of LineAbove. The bound is linear: what is above the line where it
// rises is all from the first strip on.
template <Real T>
[[nodiscard]] NearPartLanes<T> near_parts(const StripTree<T>& tree, const StripNode<T>& node,
                                          const Lanes<T>& along, const Lanes<T>& across,
                                          const Lanes<T>& height, const Lanes<T>& limit) {
  const Lanes<T> zero = Lanes<T>::Zero(), lean = node.slope * across - along;
  const Lanes<T> excess = height - node.centre * along + node.greatest_radius * across - limit;
  Lanes<T> first = zero, last = zero;
  for (int strip = node.first; strip <= node.last; ++strip) {
    const T from_centre = tree.strips()[static_cast<std::size_t>(strip)].lateral - node.centre;
    const Lanes<T> is_above = less<T>(excess + lean * from_centre, zero);
    if (node.first < strip) first += is_above;
    if (strip < node.last) last += is_above;
  }
  const Lanes<T> rises = less<T>(zero, lean);
  first *= rises;
  last *= T(1) - rises;
  NearPartLanes<T> parts;
  for (std::size_t i = 0; i < lane_count; ++i) {
    parts.left_off_first[i] = count_of<T>(first[static_cast<int>(i)]);
    parts.left_off_last[i] = count_of<T>(last[static_cast<int>(i)]);
  }
  return parts;
}

// Calls visit(lane, first, last) for the runs of each lane as NearRuns::for_each does for one
// placement, without a clearance. threshold: as there [m].
template <Profile P, Profile R, class Visit>
void for_each_near_run(const Wheel<P>& wheel, const Rail<R>& rail,
                       const PlacementLanes<typename P::Scalar>& at,
                       const typename P::Scalar& threshold, Visit&& visit) {
  using T = typename P::Scalar;
  const auto& nodes = wheel.strips().nodes();
  const auto& lines = rail.supporting_lines();
  if (!rail.is_convex()) {
    for (int lane = 0; lane < lane_count; ++lane) {
      for_each_piece(wheel.strips(), [&](int from, int to) { visit(lane, from, to); });
    }
    return;
  }
  const Lanes<T> axle_lateral = at.cos_roll * at.cos_yaw, axle_up = at.sin_roll * at.cos_yaw;
  const Lanes<T> fold = at.sin_yaw * at.tan_yaw;
  Lanes<T> along = Lanes<T>::Zero(),
           across = Lanes<T>::Zero();                         // of the last line, n.a and its root
  Lanes<T> height = Lanes<T>::Constant(T(1) / epsilon<T>());  // n.(P - o) [m]
  // The node that a lane looks at next; a node before it was left out there.
  Lanes<T> resume = Lanes<T>::Zero();
  const Lanes<T> finest = T(1) + T(finest_node - 1) * less<T>(at.tan_yaw * at.tan_yaw,
                                                              all_lanes(small_squared_tan_yaw<T>));
  const Lanes<T> limit = all_lanes(threshold);
  std::array<int, lane_count> first{}, last{};  // of the run so far: empty
  // Flags of the lanes whose line does not keep the node off the rail.
  const auto is_near = [&](const StripNode<T>& node) -> Lanes<T> {
    const Lanes<T> lean = node.slope * across - along;
    return T(1) - less<T>(height - node.centre * along + node.greatest_radius * across +
                              lean.abs() * node.half_width,
                          limit);
  };
  for (std::size_t index = 0; index < nodes.size();) {
    const StripNode<T>& node = nodes[index];
    const T place = T(static_cast<int>(index)), skip = T(static_cast<int>(node.skip));
    const Lanes<T> looks = T(1) - less<T>(all_lanes(place), resume);
    Lanes<T> is_kept = looks * is_near(node);
    bool is_any_kept = any<T>(is_kept);
    if (is_any_kept) {
      const T& radius = node.greatest_radius;
      const Lanes<T> y = node.centre - radius * (node.slope * fold);
      Lanes<T> normal_lateral, normal_up, line_height;
      lines.over_each(at.lateral_rail + y * at.cos_roll + radius * at.sin_roll,
                      [&](int lane, const SupportingLine<T>& line) {
                        normal_lateral[lane] = line.normal.x();
                        normal_up[lane] = line.normal.y();
                        line_height[lane] = line.height;
                      });
      const Lanes<T> new_along = normal_lateral * axle_lateral + normal_up * axle_up;
      along = choose<T>(is_kept, new_along, along);
      const Lanes<T> other = normal_lateral * axle_up - normal_up * axle_lateral;
      across = choose<T>(is_kept, (other * other + at.sin_yaw * at.sin_yaw).sqrt(), across);
      height = choose<T>(
          is_kept, line_height - normal_lateral * at.lateral_rail - normal_up * at.up_rail, height);
      is_kept = is_kept * is_near(node);
      is_any_kept = any<T>(is_kept);
    }
    // The lanes that look at the node's children; for the others that kept it, it belongs to a run.
    Lanes<T> goes_down = is_kept;
    if (is_any_kept && node.run_length <= finest_node) {
      goes_down = is_kept * less<T>(finest, all_lanes(T(node.last - node.first)));
      const NearPartLanes<T> parts =
          near_parts<T>(wheel.strips(), node, along, across, height, limit);
      for (int lane = 0; lane < lane_count; ++lane) {
        if (!(goes_down[lane] < is_kept[lane])) continue;
        const auto i = static_cast<std::size_t>(lane);
        const StripRange part{node.first + parts.left_off_first[i],
                              node.last - parts.left_off_last[i]};
        if (part.first != last[i]) {
          if (first[i] != last[i]) visit(lane, first[i], last[i]);
          first[i] = part.first;
        }
        last[i] = part.last;
      }
      is_any_kept = any<T>(goes_down);
    }
    resume = choose<T>(looks * (T(1) - goes_down), all_lanes(skip), resume);
    index = is_any_kept ? index + 1 : node.skip;
  }
  for (std::size_t i = 0; i < lane_count; ++i) {
    if (first[i] != last[i]) visit(static_cast<int>(i), first[i], last[i]);
  }
}

}  // namespace wheelrail::detail
