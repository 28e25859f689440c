#pragma once
/// @file
/// The search for all patches (62): the wheel's contact locus is walked strip by strip, every local
/// extremum of the penetration between two strips is solved for, and each run of penetrating strips
/// is a zone whose deepest point is a patch. May include: core, numerics, profile, surface.

#include <wheelrail/contact/patch.hpp>

namespace wheelrail {

template <Real T>
struct SearchOptions {
  /// Neighbouring strips are at most this far apart [m]. Two zones are told apart, and a zone is
  /// found however shallow, when the penetration has at most one extremum between two strips, the
  /// joints of wheel and rail counted as strips.
  T strip_spacing = constant<T>(0.5e-3L);
  /// A zone is where penetration > penetration_threshold [m]. A negative threshold also finds where
  /// the bodies are close without touching; the patches' penetration is then negative.
  T penetration_threshold = T(0);
};

namespace detail {

/// The search at work on one wheel and rail: walks the strips and collects the zones.
template <Profile P, Profile R>
class StripWalk {
 public:
  using T = typename P::Scalar;

  StripWalk(const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<T>& placement,
            const SearchOptions<T>& options)
      : wheel_(wheel), rail_(rail), placement_(placement), options_(options) {}

  [[nodiscard]] ContactResult<T> run() {
    const P& profile = wheel_.profile();
    for (int piece = 0; piece < profile.piece_count(); ++piece) {
      const T lower = profile.joint(piece);
      const T upper = profile.joint(piece + 1);
      const int strips = strips_in(T(upper - lower));
      visit(strip(piece, lower));
      for (int i = 1; i <= strips; ++i) {
        const T u = i == strips ? upper : T(lower + (upper - lower) * T(i) / T(strips));
        const Strip next = strip(piece, u);
        visit_rail_joints(next);
        visit_extremum(last_, next);
        visit(next);
      }
    }
    if (zone_is_open_) {
      zone_is_cut_ = true;
      close_zone(last_.wheel_lateral);
    }
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
    T second_derivative{};  // of the wheel's profile [1/m]
    int piece = -1;
    bool exists = false;
  };

  [[nodiscard]] int strips_in(const T& length) const {
    int strips = 1;
    while (strips < 4096 && options_.strip_spacing * T(strips) < length) ++strips;
    return strips;
  }

  [[nodiscard]] Strip strip(int piece, const T& u) {
    ++result_.evaluations;
    Strip at;
    at.wheel_lateral = u;
    at.piece = piece;
    const LocusPoint<T> locus =
        locus_point(wheel_, placement_, u, wheel_.profile().evaluate(piece, u));
    if (!locus.exists) return at;
    const ClosestPoint<T> foot = rail_foot(rail_.profile(), locus.lateral, locus.up);
    at.rail_lateral = foot.lateral;
    at.second_derivative = locus.profile.second_derivative;
    at.penetration = foot.penetration;
    // The foot moves along the surface, so only the locus' own motion across it counts.
    at.slope = -(foot.normal_rail.x() * locus.lateral_rate + foot.normal_rail.y() * locus.up_rate);
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
          T(next.rail_lateral - joint), {.step_tolerance = options_.strip_spacing / T(1000)});
      piece += piece < end ? 1 : -1;
      if (root.status != SolveStatus::converged) continue;
      const Strip at = strip(next.piece, root.position);
      visit_extremum(last_, at);
      visit(at);
    }
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
    bool lost = false;
    const auto root = bracketed_root<T>(
        [&](const T& u) {
          const Strip at = strip(left.piece, u);
          lost = lost || !at.exists;
          return at.slope;
        },
        left.wheel_lateral, right.wheel_lateral, left.slope, right.slope,
        {.step_tolerance = step_tolerance()});
    if (root.status != SolveStatus::converged || lost) {
      result_.status = SearchStatus::not_converged;
      return;
    }
    visit(strip(left.piece, root.position));
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

  // Where the penetration passes the threshold between two neighbouring strips.
  [[nodiscard]] T boundary(const Strip& left, const Strip& right) {
    if (left.piece != right.piece) return right.wheel_lateral;
    const T& threshold = options_.penetration_threshold;
    const auto root = bracketed_newton<T>(
        [&](const T& u) {
          const Strip at = strip(left.piece, u);
          return ValueAndSlope<T>{T(at.penetration - threshold), at.slope};
        },
        left.wheel_lateral, right.wheel_lateral, T(left.penetration - threshold),
        T(right.penetration - threshold),
        T(left.wheel_lateral + (right.wheel_lateral - left.wheel_lateral) *
                                   (left.penetration - threshold) /
                                   (left.penetration - right.penetration)),
        {.step_tolerance = step_tolerance()});
    if (root.status != SolveStatus::converged) result_.status = SearchStatus::not_converged;
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
    if (!result_.patches.push_back(patch)) result_.status = SearchStatus::too_many_patches;
  }

  // Lateral positions are solved for to rounding of the wheel's size.
  [[nodiscard]] T step_tolerance() const { return T(2) * epsilon<T>() * wheel_.nominal_radius(); }

  const Wheel<P>& wheel_;
  const Rail<R>& rail_;
  const WheelPlacement<T>& placement_;
  const SearchOptions<T>& options_;
  ContactResult<T> result_;
  Strip last_;
  Strip deepest_;
  T zone_lower_{};
  bool zone_is_open_ = false;
  bool zone_is_cut_ = false;
};

}  // namespace detail

/// All patches between @p wheel and @p rail at @p placement.
/// @return one patch for each zone of the wheel profile whose locus lies under the rail's surface,
/// in
///   the order of wheel_lateral; wheel_lateral, penetration and the zone's ends are solved for to
///   rounding (an end that zone_is_cut tells of: to a strip). Strips whose foot lies beyond the
///   rail profile's ends do not count as penetrating. Where a zone holds several local maxima the
///   deepest is its patch.
/// @pre options.strip_spacing > 0
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
