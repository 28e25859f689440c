#pragma once
/// @file
/// The search for all patches (62): strips that a bound keeps from the rail are left out, the
/// wheel's contact locus is walked over the others, every local extremum of the penetration between
/// two strips is solved for, and each run of penetrating strips is a zone whose deepest point is a
/// patch. May include: core, numerics, profile, surface.
///
/// The bound: a convex rail lies under each of its tangent planes. So a point of the wheel is no
/// deeper than under the plane with the normal n at any point P of the rail; the strip at u, a
/// circle of radius R(u) = R0 + F(u) about the axle's point o + u a, is no deeper than
///   g(u) = -n.(o - P) - u n.a + R(u) sqrt(1 - (n.a)^2),
/// whatever the yaw, and F over an interval is bounded by StripTree.

#include <algorithm>
#include <array>
#include <wheelrail/contact/patch.hpp>

namespace wheelrail {

/// What `find_contact` looks for.
template <Real T>
struct SearchOptions {
  /// A zone is where penetration > penetration_threshold [m]. A negative threshold also finds where
  /// the bodies are close without touching; the patches' penetration is then negative.
  T penetration_threshold = T(0);
  /// A patch with penetration > maximum_penetration [m] makes the status too_deep: nearer than this
  /// to its surface, a point inside a rail has one foot on it. Must be below the least radius of
  /// curvature of the rail (13 mm at the corners of the standard heads).
  T maximum_penetration = constant<T>(0.01L);
};

namespace detail {

/// The search at work on one wheel and rail: walks the strips and collects the zones.
template <Profile P, Profile R>
class StripWalk {
 public:
  using T = typename P::Scalar;

  StripWalk(const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<T>& placement,
            const SearchOptions<T>& options)
      : wheel_(wheel),
        rail_(rail),
        placement_(placement),
        options_(options),
        axle_lateral_(placement.cos_roll * placement.cos_yaw),
        axle_up_(placement.sin_roll * placement.cos_yaw),
        margin_(T(64) * epsilon<T>() * wheel.nominal_radius()) {
    using std::sqrt;
    const T root = sqrt(epsilon<T>());
    step_tolerance_ = root * T(sqrt(root)) * wheel.nominal_radius();
  }

  [[nodiscard]] ContactResult<T> run() {
    const auto& nodes = wheel_.strips().nodes();
    int node = 0;
    while (node < static_cast<int>(nodes.size())) {
      const StripNode<T>& at = nodes[static_cast<std::size_t>(node)];
      if (cannot_penetrate(at)) {
        node = at.skip;
        continue;
      }
      ++node;
      if (at.skip == node) {
        visit_interval(at.first, at.last);
      } else if (visit_if_concave(at)) {
        node = at.skip;
      }
    }
    leave_zone();
    return result_;
  }

 private:
  // A strip with its penetration and d penetration / d wheel_lateral. `exists` is false where the
  // strip has no locus point, or the rail no foot for it.
  struct Strip {
    T wheel_lateral{};
    T rail_lateral{};
    T penetration{};
    T slope{};
    T slope_rate{};         // d slope / d wheel_lateral [1/m], without terms of yaw squared
    T second_derivative{};  // of the wheel's profile [1/m]
    int piece = -1;
    bool exists = false;
  };

  // A tangent plane of the rail, as the bound of this file's head needs it.
  struct Plane {
    T along_axle{};   // n.a
    T across_axle{};  // sqrt(1 - (n.a)^2)
    T height{};       // n.(P - o) [m]
  };

  // g of this file's head, over the strips of a node.
  [[nodiscard]] T bound_under(const Plane& plane, const StripNode<T>& node) const {
    return plane.height - node.centre * plane.along_axle +
           wheel_.radius(node.point) * plane.across_axle +
           magnitude(T(node.point.slope * plane.across_axle - plane.along_axle)) * node.half_width +
           node.rise * plane.across_axle;
  }

  // Whether a node lies above a tangent plane of the rail: above one of the last ones that were
  // looked at, or else above the one under the node's centre.
  [[nodiscard]] bool cannot_penetrate(const StripNode<T>& node) {
    using std::sqrt;
    if (!rail_.is_convex()) return false;
    const T limit = options_.penetration_threshold - margin_;
    for (std::size_t i = 0; i < std::min(planes_seen_, planes_.size()); ++i) {
      if (bound_under(planes_[i], node) < limit) return true;
    }
    ++result_.evaluations;
    centre_curvature_ = T(0);
    const LocusPoint<T> locus = locus_point(wheel_, placement_, node.centre, node.point);
    if (!locus.exists) return false;
    const ClosestPoint<T> foot = rail_foot(rail_.profile(), locus.lateral, locus.up);
    centre_curvature_ = foot.curvature;
    Plane& plane = planes_[planes_seen_++ % planes_.size()];
    plane.along_axle = foot.normal_rail.x() * axle_lateral_ + foot.normal_rail.y() * axle_up_;
    plane.across_axle = sqrt(T(T(1) - plane.along_axle * plane.along_axle));
    plane.height = foot.penetration +
                   foot.normal_rail.x() * (locus.lateral - placement_.position_rail.y()) +
                   foot.normal_rail.y() * (locus.up - placement_.position_rail.z());
    return bound_under(plane, node) < limit;
  }

  // Visits a node as one interval if the penetration is concave over it, so that it has one maximum
  // at most: where the rail is more curved than the wheel is hollow.
  [[nodiscard]] bool visit_if_concave(const StripNode<T>& node) {
    const auto& strips = wheel_.strips().strips();
    const auto& first = strips[static_cast<std::size_t>(node.first)];
    const auto& last = strips[static_cast<std::size_t>(node.last)];
    if (!rail_.is_convex() || first.piece != last.piece) return false;
    const T& tan_yaw = placement_.tan_yaw;
    const T wheel_bend = node.bend + tan_yaw * tan_yaw * node.yaw_bend;
    if (!(wheel_bend < constant<T>(0.9L) * centre_curvature_)) return false;
    const Strip right = strip(last.piece, last.lateral, last.point);
    const Strip left =
        node.first == reached_ ? last_ : strip(first.piece, first.lateral, first.point);
    if (!left.exists || !right.exists) return false;
    const T curvature = rail_.least_curvature(left.rail_lateral, right.rail_lateral);
    const T gap = max(T(0), T(-min(left.penetration, right.penetration)));
    const T sliding = T(1) - constant<T>(1.2L) * max(square(left.slope), square(right.slope));
    if (!(wheel_bend < constant<T>(0.9L) * sliding * curvature / (T(1) + curvature * gap))) {
      return false;
    }
    enter(node.first, left);
    reached_ = node.last;
    visit_extremum(last_, right);
    visit(right);
    return true;
  }

  // Begins at the strip `first` of the wheel unless the walk is there already.
  void enter(int first, const Strip& strip_there) {
    if (first == reached_) return;
    // What was left out in between does not penetrate; two strips at a joint are neighbours.
    const bool neighbours =
        reached_ >= 0 && first == reached_ + 1 && last_.wheel_lateral == strip_there.wheel_lateral;
    if (!neighbours) leave_zone();
    visit(strip_there);
  }

  // The interval between two neighbouring strips of the wheel.
  void visit_interval(int first, int last) {
    const auto& strips = wheel_.strips().strips();
    const auto& left = strips[static_cast<std::size_t>(first)];
    const auto& right = strips[static_cast<std::size_t>(last)];
    if (first != reached_) enter(first, strip(left.piece, left.lateral, left.point));
    reached_ = last;
    const Strip next = strip(right.piece, right.lateral, right.point);
    visit_rail_joints(next);
    visit_extremum(last_, next);
    visit(next);
  }

  [[nodiscard]] Strip strip(int piece, const T& u) {
    return strip(piece, u, wheel_.profile().evaluate(piece, u));
  }

  [[nodiscard]] Strip strip(int piece, const T& u, const ProfilePoint<T>& point) {
    ++result_.evaluations;
    Strip at;
    at.wheel_lateral = u;
    at.piece = piece;
    const LocusPoint<T> locus = locus_point(wheel_, placement_, u, point);
    if (!locus.exists) return at;
    const ClosestPoint<T> foot = rail_foot(rail_.profile(), locus.lateral, locus.up);
    at.rail_lateral = foot.lateral;
    at.second_derivative = locus.profile.second_derivative;
    at.penetration = foot.penetration;
    // The foot moves along the surface, so only the locus' own motion across it counts.
    at.slope = -(foot.normal_rail.x() * locus.lateral_rate + foot.normal_rail.y() * locus.up_rate);
    const T along =
        foot.normal_rail.y() * locus.lateral_rate - foot.normal_rail.x() * locus.up_rate;
    at.slope_rate = point.second_derivative * (foot.normal_rail.y() * placement_.cos_roll -
                                               foot.normal_rail.x() * placement_.sin_roll) -
                    foot.curvature / (T(1) - foot.curvature * foot.penetration) * along * along;
    at.exists = is_finite(at.penetration) && is_finite(at.slope) &&
                !(foot.lateral < rail_.profile().lower()) &&
                !(rail_.profile().upper() < foot.lateral);
    return at;
  }

  [[nodiscard]] bool penetrates(const Strip& at) const {
    return at.exists && options_.penetration_threshold < at.penetration;
  }

  // Whether the penetration can pass the threshold between two strips of one piece. Over a convex
  // rail it stays under its tangent plus what the wheel's own second derivative adds: the rail
  // falls away from the tangent at the foot.
  [[nodiscard]] bool may_penetrate(const Strip& left, const Strip& right) const {
    const T width = right.wheel_lateral - left.wheel_lateral;
    const T bulge =
        max(T(0), max(left.second_derivative, right.second_derivative)) * width * width / T(2);
    const T from_left = left.penetration + max(T(0), left.slope) * width + bulge;
    const T from_right = right.penetration + max(T(0), T(-right.slope)) * width + bulge;
    return options_.penetration_threshold < min(from_left, from_right);
  }

  // Where the foot passes a joint of the rail between the last strip and the next, the
  // penetration's second derivative jumps, and it can have an extremum on either side: a strip is
  // put there.
  void visit_rail_joints(const Strip& next) {
    const R& rail = rail_.profile();
    if (!last_.exists || !next.exists || !may_penetrate(last_, next)) return;
    int piece = piece_of(rail, last_.rail_lateral);
    const int end = piece_of(rail, next.rail_lateral);
    while (piece != end) {
      const T joint = rail.joint(piece < end ? piece + 1 : piece);
      const auto root = bracketed_root<T>(
          [&](const T& u) { return T(strip(next.piece, u).rail_lateral - joint); },
          last_.wheel_lateral, next.wheel_lateral, T(last_.rail_lateral - joint),
          T(next.rail_lateral - joint),
          {.step_tolerance = (next.wheel_lateral - last_.wheel_lateral) / T(1000)});
      piece += piece < end ? 1 : -1;
      const Strip at = strip(next.piece, root.position);
      if (root.status != SolveStatus::converged || !at.exists) {
        result_.status = SearchStatus::not_converged;
        continue;
      }
      visit_extremum(last_, at);
      visit(at);
    }
  }

  // The cubic with the penetrations and slopes of two strips, over the share t of the way from the
  // left to the right one: where a root or an extremum is looked for first.
  struct Cubic {
    T c0, c1, c2, c3;

    Cubic(const Strip& left, const Strip& right, const T& threshold) {
      const T width = right.wheel_lateral - left.wheel_lateral;
      const T rise = right.penetration - left.penetration;
      c0 = left.penetration - threshold;
      c1 = width * left.slope;
      c2 = T(3) * rise - width * (T(2) * left.slope + right.slope);
      c3 = width * (left.slope + right.slope) - T(2) * rise;
    }

    // Two Newton steps from the share t.
    [[nodiscard]] T near_root(T t) const {
      for (int i = 0; i < 2; ++i) {
        t -= (c0 + t * (c1 + t * (c2 + t * c3))) / (c1 + t * (T(2) * c2 + t * T(3) * c3));
      }
      return t;
    }
    [[nodiscard]] T near_extremum(T t) const {
      for (int i = 0; i < 2; ++i) {
        t -= (c1 + t * (T(2) * c2 + t * T(3) * c3)) / (T(2) * c2 + t * T(6) * c3);
      }
      return t;
    }
  };

  // `share` of the way from left to right; where it leads out of the interval, `otherwise`.
  [[nodiscard]] static T between(const Strip& left, const Strip& right, const T& share,
                                 const T& otherwise) {
    return left.wheel_lateral + (T(0) < share && share < T(1) ? share : otherwise) *
                                    (right.wheel_lateral - left.wheel_lateral);
  }

  // Solves for the extremum of the penetration between two strips of one piece, if there is one
  // that can matter: a maximum that may reach the threshold, or a minimum between two that do.
  void visit_extremum(const Strip& left, const Strip& right) {
    if (!left.exists || !right.exists || left.slope == T(0) || right.slope == T(0)) return;
    const bool is_maximum = T(0) < left.slope && right.slope < T(0);
    const bool is_minimum = left.slope < T(0) && T(0) < right.slope;
    if (!is_maximum && !is_minimum) return;
    if (is_maximum && !may_penetrate(left, right)) return;
    if (is_minimum && !(penetrates(left) && penetrates(right))) return;
    const T secant = left.slope / (left.slope - right.slope);
    const Cubic cubic(left, right, options_.penetration_threshold);
    bool lost = false;
    Strip before;
    const auto root = bracketed_newton<T>(
        [&](const T& u) {
          const Strip at = strip(left.piece, u);
          lost = lost || !at.exists;
          // The rate leaves out what yaw does to it: from the second strip on, a secant has it.
          const T rate =
              before.exists
                  ? T((at.slope - before.slope) / (at.wheel_lateral - before.wheel_lateral))
                  : at.slope_rate;
          before = at;
          return ValueAndSlope<T>{at.slope, rate};
        },
        left.wheel_lateral, right.wheel_lateral, left.slope, right.slope,
        between(left, right, cubic.near_extremum(secant), secant),
        // Where the bodies nearly conform, the slope's rounding outweighs its rate.
        {.step_tolerance = step_tolerance_, .residual_tolerance = T(4) * epsilon<T>()});
    if (root.status != SolveStatus::converged || lost) {
      result_.status = SearchStatus::not_converged;
      return;
    }
    // The last step changes an extremum by its square: rounding.
    before.wheel_lateral = root.position;
    visit(before);
  }

  // The next strip in the order of wheel_lateral: opens, deepens or closes a zone.
  void visit(const Strip& next) {
    const bool inside = penetrates(next);
    if (inside && !zone_is_open_) {
      zone_is_open_ = true;
      zone_is_cut_ = !last_.exists;
      zone_lower_ = last_.exists ? boundary(last_, next) : next.wheel_lateral;
      deepest_ = next;
    } else if (!inside && zone_is_open_) {
      zone_is_cut_ = zone_is_cut_ || !next.exists;
      close_zone(next.exists ? boundary(last_, next) : last_.wheel_lateral);
    } else if (inside && deepest_.penetration < next.penetration) {
      deepest_ = next;
    }
    last_ = next;
  }

  // Ends the walk over neighbouring strips; a zone that is open there ends with the profile.
  void leave_zone() {
    if (zone_is_open_) {
      zone_is_cut_ = true;
      close_zone(last_.wheel_lateral);
    }
    last_ = Strip();
  }

  // The share of the way from left to right: a parabola with its top at the strip inside, where that
  // is the zone's deepest; otherwise a chord.
  [[nodiscard]] T boundary_share(const Strip& left, const Strip& right) const {
    using std::sqrt;
    const bool left_is_inside = penetrates(left);
    const Strip& inside = left_is_inside ? left : right;
    const Strip& outside = left_is_inside ? right : left;
    const T depth = inside.penetration - options_.penetration_threshold;
    const T chord = depth / (inside.penetration - outside.penetration);
    const bool at_top =
        magnitude(inside.slope) * magnitude(T(right.wheel_lateral - left.wheel_lateral)) <
        depth / T(4);
    const T share = at_top ? T(sqrt(chord)) : chord;
    return left_is_inside ? share : T(T(1) - share);
  }

  // Where the penetration passes the threshold between two neighbouring strips.
  [[nodiscard]] T boundary(const Strip& left, const Strip& right) {
    if (left.piece != right.piece) return right.wheel_lateral;
    const T& threshold = options_.penetration_threshold;
    const T share = boundary_share(left, right);
    bool lost = false;
    const auto root = bracketed_newton<T>(
        [&](const T& u) {
          const Strip at = strip(left.piece, u);
          lost = lost || !at.exists;
          return ValueAndSlope<T>{T(at.penetration - threshold), at.slope};
        },
        left.wheel_lateral, right.wheel_lateral, T(left.penetration - threshold),
        T(right.penetration - threshold),
        between(left, right, Cubic(left, right, threshold).near_root(share), share),
        {.step_tolerance = step_tolerance(), .residual_tolerance = margin_ / T(16)});
    if (root.status != SolveStatus::converged || lost) {
      result_.status = SearchStatus::not_converged;
    }
    return root.position;
  }

  void close_zone(const T& zone_upper) {
    zone_is_open_ = false;
    const ProfilePoint<T> point = wheel_.profile().evaluate(deepest_.piece, deepest_.wheel_lateral);
    const LocusPoint<T> locus = locus_point(wheel_, placement_, deepest_.wheel_lateral, point);
    const ClosestPoint<T> foot = rail_foot(rail_.profile(), locus.lateral, locus.up);
    Patch<T> patch = patch_at(
        wheel_, rail_, placement_, deepest_.wheel_lateral, point, locus.angle, foot.lateral,
        Vector3<T>(T(0), foot.normal_rail.x(), foot.normal_rail.y()), foot.penetration);
    patch.zone_lower = zone_lower_;
    patch.zone_upper = zone_upper;
    patch.zone_is_cut = zone_is_cut_;
    if (options_.maximum_penetration < patch.penetration) result_.status = SearchStatus::too_deep;
    if (!result_.patches.push_back(patch)) result_.status = SearchStatus::too_many_patches;
  }

  // With exact slopes, a last Newton step this long leaves an error of rounding.
  [[nodiscard]] T step_tolerance() const { return step_tolerance_; }

  const Wheel<P>& wheel_;
  const Rail<R>& rail_;
  const WheelPlacement<T>& placement_;
  const SearchOptions<T>& options_;
  T axle_lateral_;  // of the axle's direction, rail frame
  T axle_up_;
  std::array<Plane, 6> planes_;
  std::size_t planes_seen_ = 0;  // planes_ has the last ones
  T centre_curvature_{};         // of the rail under the centre of the last node [1/m]
  T margin_;                     // rounding of the bound and of the penetration [m]
  T step_tolerance_{};           // [m]
  ContactResult<T> result_;
  int reached_ = -1;  // the last strip of the wheel that was visited
  Strip last_;
  Strip deepest_;
  T zone_lower_{};
  bool zone_is_open_ = false;
  bool zone_is_cut_ = false;
};

}  // namespace detail

/// All patches between @p wheel and @p rail at @p placement.
/// @return one patch for each zone of the wheel profile whose locus lies under the rail's surface, in
///   the order of wheel_lateral; wheel_lateral, penetration and the zone's ends are solved for to
///   rounding (an end that zone_is_cut tells of: to a strip). Strips whose foot lies beyond the
///   rail profile's ends do not count as penetrating. Where a zone holds several local maxima the
///   deepest is its patch.
/// @note Does not allocate. Equations (57), (59), (61), (62) of the paper.
template <Profile P, Profile R>
[[nodiscard]] ContactResult<typename P::Scalar> find_contact(
    const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<typename P::Scalar>& placement,
    const SearchOptions<typename P::Scalar>& options = {}) {
  using T = typename P::Scalar;
  if (!detail::is_finite_placement(placement) || !is_finite(options.penetration_threshold)) {
    ContactResult<T> result;
    result.status = SearchStatus::not_finite;
    return result;
  }
  return detail::StripWalk<P, R>(wheel, rail, placement, options).run();
}

}  // namespace wheelrail
