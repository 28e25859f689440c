#pragma once
/// @file
/// The strips of a wheel, laid out once for all searches: profile points at a fixed spacing, and
/// trees over the intervals between them that bound the profile's shape: how far it rises above its
/// tangents, and how its derivatives vary. May include: core, numerics, profile.

#include <algorithm>
#include <bit>
#include <limits>
#include <vector>
#include <wheelrail/core/require.hpp>
#include <wheelrail/profile/profile.hpp>

namespace wheelrail {

/// One strip: a profile point as its piece has it.
template <Real T>
struct Strip {
  T lateral = T(0);       ///< [m]
  ProfilePoint<T> point;  ///< the profile there
  int piece = 0;          ///< of the profile
};

/// What a profile F keeps within over an interval.
template <Real T>
struct ShapeBounds {
  T least_second = T(0);     ///< <= F'' [1/m]
  T greatest_second = T(0);  ///< >= F'' [1/m]
  T steepest = T(0);         ///< >= |F'| [-]
  T flattest = T(0);         ///< <= |F'|, not less than 0 [-]
  T second = T(0);           ///< >= |F''| [1/m]
  T third = T(0);            ///< >= |F'''| [1/m2]

  /// Also holds where `other` does then.
  void widen(const ShapeBounds& other) {
    least_second = detail::min(least_second, other.least_second);
    greatest_second = detail::max(greatest_second, other.greatest_second);
    steepest = detail::max(steepest, other.steepest);
    flattest = detail::min(flattest, other.flattest);
    second = detail::max(second, other.second);
    third = detail::max(third, other.third);
  }
};

/// The bounds over [lower, upper] of one piece: proved where the profile has derivative bounds;
/// otherwise those of three points.
template <Profile P>
[[nodiscard]] ShapeBounds<typename P::Scalar> shape_bounds(const P& profile, int piece,
                                                           const typename P::Scalar& lower,
                                                           const typename P::Scalar& upper) {
  using T = typename P::Scalar;
  const T half_width = (upper - lower) / T(2);
  const ProfilePoint<T> middle = profile.evaluate(piece, T(lower + half_width));
  DerivativeBounds<T> bounds;
  if constexpr (HasDerivativeBounds<P>) {
    bounds = profile.derivative_bounds(piece, lower, upper);
  } else {
    const T left = profile.evaluate(piece, lower).second_derivative;
    const T right = profile.evaluate(piece, upper).second_derivative;
    bounds = {detail::min(middle.second_derivative, detail::min(left, right)),
              detail::max(middle.second_derivative, detail::max(left, right)),
              detail::magnitude(T(right - left)) / (upper - lower)};
  }
  const T second = detail::max(detail::magnitude(bounds.least_second),
                               detail::magnitude(bounds.greatest_second));
  const T slope = detail::magnitude(middle.slope);
  return {bounds.least_second,
          bounds.greatest_second,
          slope + second * half_width,
          detail::max(T(0), T(slope - second * half_width)),
          second,
          bounds.greatest_third};
}

/// A node covers the strips from `first` to `last`. Invariant: for every lateral u of it
/// |u - centre| <= half_width and R(u) <= greatest_radius + slope (u - centre).
template <Real T>
struct StripNode {
  T centre = T(0);           ///< lateral coordinate of the strip in its middle [m]
  T half_width = T(0);       ///< [m]
  T slope = T(0);            ///< of the profile at the centre [-]
  T greatest_radius = T(0);  ///< the radius there, and what the profile rises above its tangent [m]
  int first = 0;             ///< index of a strip
  int last = 0;              ///< first + 1: a leaf, the interval between two strips
  std::size_t skip = 0;      ///< the node after this one's subtree; the first child is the next
  /// last - first; the greatest int where its strips are of several pieces, and so no run.
  int run_length = 0;
};

/// The strips of a profile in order, and the nodes over them: one tree after the other, each in
/// preorder. Nodes over several pieces are split at a joint.
template <Real T>
class StripTree {
 public:
  /// A tree covers at most so many intervals between strips: wider nodes mostly have parts that no line
  /// is below.
  static constexpr int widest_tree = 16;
  /// Where there are more than widest_tree * fewest_trees intervals, trees are wider: there need not be
  /// more of them than about so many.
  static constexpr int fewest_trees = 16;

  /// @param spacing strips are at most this far apart [m].
  /// @throws std::invalid_argument unless spacing is finite and > 0 and makes at most 100,000
  /// strips.
  template <Profile P>
  StripTree(const P& profile, const T& nominal_radius, const T& spacing)
      : greatest_radius_(nominal_radius), is_proved_(HasDerivativeBounds<P>) {
    detail::require_positive("wheel: strip spacing", spacing, "[m]");
    detail::require((profile.upper() - profile.lower()) / spacing < T(100000),
                    "wheel: strip spacing", spacing, "at least 1e-5 of the profile's width [m]");
    std::vector<Interval> intervals;
    for (int piece = 0; piece < profile.piece_count(); ++piece) {
      const T lower = profile.joint(piece), upper = profile.joint(piece + 1);
      int count = 1;
      while (spacing * T(count) < upper - lower) ++count;
      for (int i = 0; i <= count; ++i) {
        const T u = i == count ? upper : T(lower + (upper - lower) * T(i) / T(count));
        strips_.push_back({u, profile.evaluate(piece, u), piece});
        if (i > 0) intervals.push_back(interval_before(profile, piece));
        shapes_.push_back(i > 0 ? intervals.back().shape : ShapeBounds<T>());
      }
    }
    // The bounds over 2 intervals from those over 1 each, over 4 from those over 2, and so on.
    for (std::size_t span = 1, begin = 0; span < strips_.size(); span *= 2) {
      for (std::size_t i = 0; i < strips_.size(); ++i, ++begin) {
        ShapeBounds<T> shape = shapes_[begin];
        if (i + span < strips_.size()) shape.widen(shapes_[begin + span]);
        shapes_.push_back(shape);
      }
    }
    for (const Interval& interval : intervals) {
      for (const Strip<T>& strip : {at(interval.first), interval.middle, at(interval.first + 1)}) {
        greatest_radius_ =
            detail::max(greatest_radius_, T(nominal_radius + strip.point.value + interval.bulge));
      }
    }
    leaves_.resize(strips_.size());
    build(intervals, 0, static_cast<int>(intervals.size()), profile, nominal_radius);
  }

  /// Not less than the radius of any strip [m].
  [[nodiscard]] const T& greatest_radius() const { return greatest_radius_; }
  /// By lateral coordinate.
  [[nodiscard]] const std::vector<Strip<T>>& strips() const { return strips_; }
  /// Tree by tree.
  [[nodiscard]] const std::vector<StripNode<T>>& nodes() const { return nodes_; }
  /// The interval between a strip and the next one of its piece.
  [[nodiscard]] const StripNode<T>& leaf(int first) const {
    return nodes_[leaves_[static_cast<std::size_t>(first)]];
  }
  /// What the profile keeps within between two strips of one piece. @pre first < last
  [[nodiscard]] ShapeBounds<T> shape_between(int first, int last) const {
    const auto count = static_cast<std::size_t>(last - first);
    const int level = static_cast<int>(std::bit_width(count)) - 1;
    const ShapeBounds<T>* shapes =
        shapes_.data() + strips_.size() * static_cast<std::size_t>(level) + 1;
    ShapeBounds<T> shape = shapes[first];
    shape.widen(shapes[last - (1 << level)]);
    return shape;
  }
  /// Whether all bounds are proved: the profile has derivative bounds.
  [[nodiscard]] bool is_proved() const { return is_proved_; }

 private:
  // The interval between two strips of one piece.
  struct Interval {
    int first = 0;
    Strip<T> middle;
    ShapeBounds<T> shape;
    T bulge = T(0);  // F is at most this far above its chords to the middle [m]
  };

  // The interval between the last two strips.
  template <Profile P>
  [[nodiscard]] Interval interval_before(const P& profile, int piece) const {
    Interval interval;
    interval.first = static_cast<int>(strips_.size()) - 2;
    const T lower = strips_[strips_.size() - 2].lateral, upper = strips_.back().lateral;
    const T u = lower + (upper - lower) / T(2);
    interval.middle = {u, profile.evaluate(piece, u), piece};
    interval.shape = shape_bounds(profile, piece, lower, upper);
    // Where F'' < 0 it rises above its chords, by at most -F'' width^2 / 32 each half, and stays under
    // its tangent in the middle.
    interval.bulge = interval.shape.second * detail::square(T(upper - lower)) / T(32);
    if (interval.shape.greatest_second < T(0)) {
      const ProfilePoint<T>& middle = interval.middle.point;
      const T reach = middle.slope * (upper - lower) / T(2);
      const T under_tangent =
          detail::max(T(middle.value - reach - strips_[strips_.size() - 2].point.value),
                      T(middle.value + reach - strips_.back().point.value));
      interval.bulge = detail::min(interval.bulge, under_tangent);
    }
    return interval;
  }

  // Where to part the intervals from begin to end: at the joint nearest to the middle, or there.
  [[nodiscard]] int split(const std::vector<Interval>& intervals, int begin, int end) const {
    const int middle = begin + (end - begin) / 2;
    int best = -1;
    for (int i = begin + 1; i < end; ++i) {
      const bool is_joint = intervals[static_cast<std::size_t>(i)].middle.piece !=
                            intervals[static_cast<std::size_t>(i - 1)].middle.piece;
      const auto distance = [&](int at) { return at < middle ? middle - at : at - middle; };
      if (is_joint && (best < 0 || distance(i) < distance(best))) best = i;
    }
    return best < 0 ? middle : best;
  }

  template <Profile P>
  void build(const std::vector<Interval>& intervals, int begin, int end, const P& profile,
             const T& nominal_radius) {
    const int count = static_cast<int>(intervals.size());
    if (std::max(int{widest_tree}, count / fewest_trees) < end - begin) {
      const int at = split(intervals, begin, end);
      build(intervals, begin, at, profile, nominal_radius);
      build(intervals, at, end, profile, nominal_radius);
      return;
    }
    const std::size_t self = nodes_.size();
    nodes_.emplace_back();
    const Interval& front = intervals[static_cast<std::size_t>(begin)];
    const Interval& back = intervals[static_cast<std::size_t>(end - 1)];
    StripNode<T> node;
    node.first = front.first;
    node.last = back.first + 1;
    const T lower = at(node.first).lateral, upper = at(node.last).lateral;
    node.centre = lower + (upper - lower) / T(2);
    node.half_width = (upper - lower) / T(2);
    const ProfilePoint<T> middle =
        end - begin == 1 ? front.middle.point : profile.evaluate(node.centre);
    node.slope = middle.slope;
    const bool is_in_one_piece = front.middle.piece == back.middle.piece;
    node.run_length = is_in_one_piece ? node.last - node.first : std::numeric_limits<int>::max();
    T rise = T(0);
    for (int i = begin; i < end; ++i) {
      const Interval& interval = intervals[static_cast<std::size_t>(i)];
      for (const Strip<T>& strip : {at(interval.first), interval.middle, at(interval.first + 1)}) {
        rise = detail::max(rise, T(strip.point.value - middle.value -
                                   middle.slope * (strip.lateral - node.centre) + interval.bulge));
      }
    }
    node.greatest_radius = nominal_radius + middle.value + rise;
    if (end - begin == 1) {
      leaves_[static_cast<std::size_t>(node.first)] = self;
    } else {
      const int at = split(intervals, begin, end);
      build(intervals, begin, at, profile, nominal_radius);
      build(intervals, at, end, profile, nominal_radius);
    }
    node.skip = nodes_.size();
    nodes_[self] = node;
  }

  [[nodiscard]] const Strip<T>& at(int strip) const {
    return strips_[static_cast<std::size_t>(strip)];
  }

  T greatest_radius_;
  std::vector<Strip<T>> strips_;
  // Of the interval before each strip; then of the two from there on, of the four, and so on, as long
  // as there are so many; those over several pieces mean nothing.
  std::vector<ShapeBounds<T>> shapes_;
  std::vector<StripNode<T>> nodes_;
  std::vector<std::size_t> leaves_;  // the node of the interval after each strip
  bool is_proved_;
};

}  // namespace wheelrail
