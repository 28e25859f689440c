#pragma once
/// @file
/// The strips of a wheel, laid out once for all searches: profile points at a fixed spacing, and a
/// tree over the intervals between them that bounds how far the profile rises above its tangents.
/// May include: core, numerics, profile.

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

/// A node covers the strips from `first` to `last`. Invariant: for every lateral u of it
/// F(u) <= F(centre) + F'(centre) (u - centre) + rise, |u - centre| <= half_width.
template <Real T>
struct StripNode {
  T centre{};             ///< lateral coordinate of the strip in its middle [m]
  T half_width{};         ///< [m]
  ProfilePoint<T> point;  ///< at the centre
  T rise{};               ///< [m]
  T bend{};               ///< greatest F'' [1/m], not less than 0
  /// Times tan(yaw)^2: how far the second derivative of the contact locus departs from F'' [1/m]
  T yaw_bend{};
  int first = 0;
  int last = 0;  ///< first + 1: a leaf, the interval between two strips of one piece
  int skip = 0;  ///< the node after this one's subtree; the first child is the next node
};

/// The strips of a profile in order, and its nodes in preorder.
/// Between strips, F'' is taken to lie within its values at the ends and middle of each interval:
/// so it is for polynomials and arcs over intervals as short as these.
template <Real T>
class StripTree {
 public:
  /// @param spacing strips are at most this far apart [m].
  /// @throws std::invalid_argument unless spacing is finite and > 0 and makes at most 100,000
  /// strips.
  template <Profile P>
  StripTree(const P& profile, const T& nominal_radius, const T& spacing)
      : nominal_radius_(nominal_radius) {
    detail::require_positive("wheel: strip spacing", spacing, "[m]");
    detail::require((profile.upper() - profile.lower()) / spacing < T(100000),
                    "wheel: strip spacing", spacing, "at least 1e-5 of the profile's width [m]");
    for (int piece = 0; piece < profile.piece_count(); ++piece) {
      const T lower = profile.joint(piece), upper = profile.joint(piece + 1);
      int count = 1;
      while (spacing * T(count) < upper - lower) ++count;
      for (int i = 0; i <= count; ++i) {
        const T u = i == count ? upper : T(lower + (upper - lower) * T(i) / T(count));
        strips_.push_back({u, profile.evaluate(piece, u), piece});
        if (i > 0) {
          const T middle = (strips_[strips_.size() - 2].lateral + u) / T(2);
          leaves_.push_back(static_cast<int>(strips_.size()) - 2);
          middles_.push_back({middle, profile.evaluate(piece, middle), piece});
        }
      }
    }
    build(0, static_cast<int>(leaves_.size()), profile);
    leaves_.clear();
    middles_.clear();
  }

  [[nodiscard]] const std::vector<Strip<T>>& strips() const { return strips_; }
  [[nodiscard]] const std::vector<StripNode<T>>& nodes() const { return nodes_; }

 private:
  template <Profile P>
  void build(int begin, int end, const P& profile) {
    const auto at = [](const auto& list, int i) -> const auto& {
      return list[static_cast<std::size_t>(i)];
    };
    const std::size_t self = nodes_.size();
    nodes_.emplace_back();
    StripNode<T> node;
    node.first = at(leaves_, begin);
    node.last = at(leaves_, end - 1) + 1;
    const T lower = at(strips_, node.first).lateral, upper = at(strips_, node.last).lateral;
    const bool is_leaf = end - begin == 1;
    node.centre = (lower + upper) / T(2);
    node.half_width = (upper - lower) / T(2);
    node.point = is_leaf ? at(middles_, begin).point : profile.evaluate(node.centre);
    for (int leaf = begin; leaf < end; ++leaf) {
      const Strip<T>& left = at(strips_, at(leaves_, leaf));
      const Strip<T>& right = at(strips_, at(leaves_, leaf) + 1);
      const T above = [&] {
        T greatest = T(0);
        for (const Strip<T>* strip : {&left, &at(middles_, leaf), &right}) {
          greatest = detail::max(greatest, T(strip->point.value - node.point.value -
                                             node.point.slope * (strip->lateral - node.centre)));
        }
        return greatest;
      }();
      // Where F'' < 0 the profile rises above its chords, by at most -F'' width^2 / 32 each half.
      const T sag = detail::max(T(0), T(-detail::min(at(middles_, leaf).point.second_derivative,
                                                     detail::min(left.point.second_derivative,
                                                                 right.point.second_derivative))));
      const T third =
          detail::magnitude(T(right.point.second_derivative - left.point.second_derivative)) /
          (right.lateral - left.lateral);
      for (const Strip<T>* strip : {&left, &at(middles_, leaf), &right}) {
        const T radius = nominal_radius_ + strip->point.value;
        const T slope = detail::magnitude(strip->point.slope);
        const T second = detail::magnitude(strip->point.second_derivative);
        node.bend = detail::max(node.bend, strip->point.second_derivative);
        node.yaw_bend =
            detail::max(node.yaw_bend, T(radius * (second * second + (T(1) + slope) * third) +
                                         slope * second * (T(3) + T(2) * slope)));
      }
      node.rise = detail::max(
          node.rise, T(above + sag * detail::square(T(right.lateral - left.lateral)) / T(32)));
    }
    if (!is_leaf) {
      const int middle = begin + (end - begin) / 2;
      build(begin, middle, profile);
      build(middle, end, profile);
    }
    node.skip = static_cast<int>(nodes_.size());
    nodes_[self] = node;
  }

  T nominal_radius_;
  std::vector<Strip<T>> strips_;
  std::vector<StripNode<T>> nodes_;
  std::vector<int> leaves_;        // first strip of each interval, while building
  std::vector<Strip<T>> middles_;  // and its middle
};

}  // namespace wheelrail
