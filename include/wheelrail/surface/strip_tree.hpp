#pragma once
/// @file
/// The strips of a wheel, laid out once for all searches: profile points at a fixed spacing, and a
/// tree over the intervals between them that bounds the profile's shape: how far it rises above its
/// tangents, and how its derivatives vary. May include: core, numerics, profile.

#include <vector>
#include <wheelrail/core/require.hpp>
#include <wheelrail/profile/profile.hpp>

namespace wheelrail {

/// One strip: a profile point as its piece has it.
template <Real T>
struct Strip {
  T lateral{};  ///< [m]
  ProfilePoint<T> point;
  int piece = 0;
};

/// What a profile F keeps within over an interval.
template <Real T>
struct ShapeBounds {
  T least_second{};     ///< <= F'' [1/m]
  T greatest_second{};  ///< >= F'' [1/m]
  T steepest{};         ///< >= |F'| [-]
  T flattest{};         ///< <= |F'|, not less than 0 [-]
  T second{};           ///< >= |F''| [1/m]
  T third{};            ///< >= |F'''| [1/m2]
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
/// F(u) <= F(centre) + F'(centre) (u - centre) + rise, |u - centre| <= half_width.
template <Real T>
struct StripNode {
  T centre{};             ///< lateral coordinate of the strip in its middle [m]
  T half_width{};         ///< [m]
  ProfilePoint<T> point;  ///< at the centre
  T rise{};               ///< [m]
  ShapeBounds<T> shape;
  int first = 0;
  int last = 0;  ///< first + 1: a leaf, the interval between two strips of one piece
  int skip = 0;  ///< the node after this one's subtree; the first child is the next node
  /// A block: at most StripTree::block_strips intervals of one piece; its parent, if any, is none.
  bool is_block = false;
};

/// The strips of a profile in order, and its nodes in preorder. Nodes over several pieces are split
/// at a joint.
template <Real T>
class StripTree {
 public:
  static constexpr int block_strips = 8;

  /// @param spacing strips are at most this far apart [m].
  /// @throws std::invalid_argument unless spacing is finite and > 0 and makes at most 100,000
  /// strips.
  template <Profile P>
  StripTree(const P& profile, const T& nominal_radius, const T& spacing)
      : greatest_radius_(nominal_radius), is_proved_(HasDerivativeBounds<P>) {
    detail::require_positive("wheel: strip spacing", spacing, "[m]");
    detail::require((profile.upper() - profile.lower()) / spacing < T(100000),
                    "wheel: strip spacing", spacing, "at least 1e-5 of the profile's width [m]");
    std::vector<Leaf> leaves;
    for (int piece = 0; piece < profile.piece_count(); ++piece) {
      const T lower = profile.joint(piece), upper = profile.joint(piece + 1);
      int count = 1;
      while (spacing * T(count) < upper - lower) ++count;
      for (int i = 0; i <= count; ++i) {
        const T u = i == count ? upper : T(lower + (upper - lower) * T(i) / T(count));
        strips_.push_back({u, profile.evaluate(piece, u), piece});
        if (i > 0) leaves.push_back(leaf_before(profile, piece));
      }
    }
    for (const Leaf& leaf : leaves) {
      for (const Strip<T>& strip : {at(leaf.first), leaf.middle, at(leaf.first + 1)}) {
        greatest_radius_ =
            detail::max(greatest_radius_, T(nominal_radius + strip.point.value + leaf.bulge));
      }
    }
    build(leaves, 0, static_cast<int>(leaves.size()), profile, true);
  }

  /// Not less than the radius of any strip [m].
  [[nodiscard]] const T& greatest_radius() const { return greatest_radius_; }
  [[nodiscard]] const std::vector<Strip<T>>& strips() const { return strips_; }
  [[nodiscard]] const std::vector<StripNode<T>>& nodes() const { return nodes_; }
  [[nodiscard]] int block_count() const { return block_count_; }
  /// Whether all bounds are proved: the profile has derivative bounds.
  [[nodiscard]] bool is_proved() const { return is_proved_; }

 private:
  // The interval between two strips of one piece.
  struct Leaf {
    int first = 0;
    Strip<T> middle;
    ShapeBounds<T> shape;
    T bulge{};  // F is at most this far above its chords to the middle [m]
  };

  // The leaf between the last two strips.
  template <Profile P>
  [[nodiscard]] Leaf leaf_before(const P& profile, int piece) const {
    Leaf leaf;
    leaf.first = static_cast<int>(strips_.size()) - 2;
    const T lower = strips_[strips_.size() - 2].lateral, upper = strips_.back().lateral;
    const T u = lower + (upper - lower) / T(2);
    leaf.middle = {u, profile.evaluate(piece, u), piece};
    leaf.shape = shape_bounds(profile, piece, lower, upper);
    // Where F'' < 0 it rises above its chords, by at most -F'' width^2 / 32 each half, and stays under
    // its tangent in the middle.
    leaf.bulge = leaf.shape.second * detail::square(T(upper - lower)) / T(32);
    if (leaf.shape.greatest_second < T(0)) {
      const ProfilePoint<T>& middle = leaf.middle.point;
      const T reach = middle.slope * (upper - lower) / T(2);
      const T under_tangent =
          detail::max(T(middle.value - reach - strips_[strips_.size() - 2].point.value),
                      T(middle.value + reach - strips_.back().point.value));
      leaf.bulge = detail::min(leaf.bulge, under_tangent);
    }
    return leaf;
  }

  // Where to part the leaves from begin to end: at the joint nearest to the middle, or there.
  [[nodiscard]] int split(const std::vector<Leaf>& leaves, int begin, int end) const {
    const int middle = begin + (end - begin) / 2;
    int best = -1;
    for (int i = begin + 1; i < end; ++i) {
      const bool is_joint = leaves[static_cast<std::size_t>(i)].middle.piece !=
                            leaves[static_cast<std::size_t>(i - 1)].middle.piece;
      const auto distance = [&](int at) { return at < middle ? middle - at : at - middle; };
      if (is_joint && (best < 0 || distance(i) < distance(best))) best = i;
    }
    return best < 0 ? middle : best;
  }

  template <Profile P>
  void build(const std::vector<Leaf>& leaves, int begin, int end, const P& profile,
             bool above_blocks) {
    const std::size_t self = nodes_.size();
    nodes_.emplace_back();
    const Leaf& front = leaves[static_cast<std::size_t>(begin)];
    const Leaf& back = leaves[static_cast<std::size_t>(end - 1)];
    StripNode<T> node;
    node.first = front.first;
    node.last = back.first + 1;
    node.is_block =
        above_blocks && front.middle.piece == back.middle.piece && end - begin <= block_strips;
    if (node.is_block) ++block_count_;
    const T lower = at(node.first).lateral, upper = at(node.last).lateral;
    node.centre = lower + (upper - lower) / T(2);
    node.half_width = (upper - lower) / T(2);
    node.point = end - begin == 1 ? front.middle.point : profile.evaluate(node.centre);
    node.shape = front.shape;
    for (int i = begin; i < end; ++i) {
      const Leaf& leaf = leaves[static_cast<std::size_t>(i)];
      for (const Strip<T>& strip : {at(leaf.first), leaf.middle, at(leaf.first + 1)}) {
        node.rise = detail::max(node.rise,
                                T(strip.point.value - node.point.value -
                                  node.point.slope * (strip.lateral - node.centre) + leaf.bulge));
      }
      node.shape.least_second = detail::min(node.shape.least_second, leaf.shape.least_second);
      node.shape.greatest_second =
          detail::max(node.shape.greatest_second, leaf.shape.greatest_second);
      node.shape.steepest = detail::max(node.shape.steepest, leaf.shape.steepest);
      node.shape.flattest = detail::min(node.shape.flattest, leaf.shape.flattest);
      node.shape.second = detail::max(node.shape.second, leaf.shape.second);
      node.shape.third = detail::max(node.shape.third, leaf.shape.third);
    }
    if (end - begin > 1) {
      const int middle = split(leaves, begin, end);
      build(leaves, begin, middle, profile, above_blocks && !node.is_block);
      build(leaves, middle, end, profile, above_blocks && !node.is_block);
    }
    node.skip = static_cast<int>(nodes_.size());
    nodes_[self] = node;
  }

  [[nodiscard]] const Strip<T>& at(int strip) const {
    return strips_[static_cast<std::size_t>(strip)];
  }

  T greatest_radius_;
  std::vector<Strip<T>> strips_;
  std::vector<StripNode<T>> nodes_;
  int block_count_ = 0;
  bool is_proved_;
};

}  // namespace wheelrail
