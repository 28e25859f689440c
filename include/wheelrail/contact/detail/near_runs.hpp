#pragma once
// The part of a contact search that looks nowhere near the contacts: 1 of penetration_bounds.hpp, by
// which whole branches of a wheel's strip trees are left out. May include: core, numerics, profile,
// surface, contact/placement.

#include <wheelrail/contact/detail/locus_strip.hpp>

namespace wheelrail::detail {

// A node over so few is not divided further where the yaw is small, but what lies above the last
// line is left off its ends: that costs less than its parts' tests. Where the yaw is greater, its
// bounds are so loose that finer runs pay.
inline constexpr int finest_node = 8;
template <Real T>
inline constexpr T small_squared_tan_yaw = constant<T>(1e-4L);

// A line above the rail, with the normal n, at P; the bound g is taken of it, which is linear over a
// node.
template <Real T>
struct LineAbove {
  T along_axle = T(0);             // n.a
  T across_axle = T(0);            // sqrt(1 - (n.a)^2)
  T height = T(1) / epsilon<T>();  // n.(P - o) [m]; at first above everything

  [[nodiscard, gnu::always_inline]] inline T depth_at_centre(const StripNode<T>& node) const {
    return height - node.centre * along_axle + node.greatest_radius * across_axle;
  }
  // By which the bound changes along the profile.
  [[nodiscard, gnu::always_inline]] inline T lean(const StripNode<T>& node) const {
    return node.slope * across_axle - along_axle;
  }
  [[nodiscard, gnu::always_inline]] inline T greatest_depth(const StripNode<T>& node) const {
    const T slope = lean(node);
    return depth_at_centre(node) + magnitude(slope) * node.half_width;
  }
};

// From one strip to another.
struct StripRange {
  int first = 0, last = 0;
};

// A node without the strips at its end that the line keeps `limit` [m] from the rail.
template <Real T>
[[nodiscard, gnu::always_inline]] inline StripRange near_part(const StripTree<T>& tree,
                                                              const StripNode<T>& node,
                                                              const LineAbove<T>& line,
                                                              const T& limit) {
  const T lean = line.lean(node);
  const T excess = line.depth_at_centre(node) - limit;
  const Strip<T>* const strips = tree.strips().data();
  const auto is_above = [&](int strip) {
    return excess + lean * (strips[strip].lateral - node.centre) < T(0);
  };
  StripRange part{node.first, node.last};
  if (T(0) < lean) {
    while (part.first < part.last && is_above(part.first + 1)) ++part.first;
  } else {
    while (part.first < part.last && is_above(part.last - 1)) --part.last;
  }
  return part;
}

// Calls visit(first, last) for all strips, piece by piece: above a rail that is not convex there are no
// lines.
template <Real T, class Visit>
void for_each_piece(const StripTree<T>& tree, const Visit& visit) {
  const auto& strips = tree.strips();
  for (std::size_t first = 0, i = 1; i <= strips.size(); ++i) {
    if (i < strips.size() && strips[i].piece == strips[first].piece) continue;
    visit(static_cast<int>(first), static_cast<int>(i - 1));
    first = i;
  }
}

// The runs of strips that no line above the rail keeps off it. What is called for each node is
// always inlined: a search spends much of its time here.
template <Profile P, Profile R>
class NearRuns {
 public:
  using T = typename P::Scalar;
  using Line = LineAbove<T>;

  // threshold: of a zone's penetration, less what rounding makes of it [m].
  NearRuns(const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<T>& placement,
           const T& threshold)
      : wheel_(wheel),
        rail_(rail),
        placement_(placement),
        axle_lateral_(placement.cos_roll * placement.cos_yaw),
        axle_up_(placement.sin_roll * placement.cos_yaw),
        fold_(placement.sin_yaw * placement.tan_yaw),
        squared_sin_yaw_(square(placement.sin_yaw)),
        threshold_(threshold),
        lines_(rail.supporting_lines()) {}

  // Calls visit(first, last), in order, for the longest runs of strips of one piece that are not
  // proved to stay `clearance` [m] above a line.
  template <class Visit>
  void for_each(const T& clearance, Visit&& visit) const {
    if (!rail_.is_convex()) return for_each_piece(wheel_.strips(), visit);
    const T limit = threshold_ - clearance;
    const int finest = square(placement_.tan_yaw) < small_squared_tan_yaw<T> ? finest_node : 1;
    const StripNode<T>* const begin = wheel_.strips().nodes().data();
    const StripNode<T>* const end = begin + wheel_.strips().nodes().size();
    Line line;       // the last one that was looked at
    StripRange run;  // so far: empty
    for (const StripNode<T>* node = begin; true; node = begin + node->skip) {
      // The next one that is part of a run.
      while (node != end) {
        bool is_above = line.greatest_depth(*node) < limit;
        if (!is_above) {
          line = line_over(*node);
          is_above = line.greatest_depth(*node) < limit;
        }
        if (!is_above && node->run_length <= finest) break;
        node = is_above ? begin + node->skip : node + 1;
      }
      const StripRange next =
          node == end ? StripRange{} : near_part(wheel_.strips(), *node, line, limit);
      if (run.first != run.last && (node == end || next.first != run.last)) {
        visit(run.first, run.last);
        run.first = run.last;
      }
      if (node == end) return;
      if (run.first == run.last) run.first = next.first;
      run.last = next.last;
    }
  }

  // Whether what lies between a strip and its neighbour is proved to stay `clearance` [m] above the
  // rail's tangent at the foot of `strip`, one of the two. first: the left one's index.
  [[nodiscard]] bool is_above(const LocusStrip<T>& strip, int first, const T& clearance) const {
    if (!strip.exists || !rail_.is_convex()) return false;
    const T foot_up = rail_.profile().evaluate(strip.rail_lateral).value;
    const Line tangent = line({strip.normal_rail, strip.normal_rail.x() * strip.rail_lateral +
                                                      strip.normal_rail.y() * foot_up});
    return tangent.greatest_depth(wheel_.strips().leaf(first)) < threshold_ - clearance;
  }

 private:
  // The one over, or under, the locus point of the node's middle strip, but for yaw squared.
  [[nodiscard, gnu::always_inline]] inline Line line_over(const StripNode<T>& node) const {
    const T& radius = node.greatest_radius;
    const T y = node.centre - radius * (node.slope * fold_);
    const T lateral =
        placement_.position_rail.y() + y * placement_.cos_roll + radius * placement_.sin_roll;
    return line(lines_.over(lateral));
  }

  [[nodiscard, gnu::always_inline]] inline Line line(const SupportingLine<T>& line) const {
    using std::sqrt;
    const T along = line.normal.x() * axle_lateral_ + line.normal.y() * axle_up_;
    // The other part of the axle's direction, which 1 - (n.a)^2 would lose where the line is steep.
    const T other = line.normal.x() * axle_up_ - line.normal.y() * axle_lateral_;
    return {along, sqrt(T(other * other + squared_sin_yaw_)),
            line.height - line.normal.x() * placement_.position_rail.y() -
                line.normal.y() * placement_.position_rail.z()};
  }

  const Wheel<P>& wheel_;
  const Rail<R>& rail_;
  const WheelPlacement<T>& placement_;
  T axle_lateral_;  // of the axle's direction, rail frame
  T axle_up_;
  T fold_;  // of the section plane by the yaw
  T squared_sin_yaw_;
  T threshold_;
  const SupportingLines<T>& lines_;
};

}  // namespace wheelrail::detail
