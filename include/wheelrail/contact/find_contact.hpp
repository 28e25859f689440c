#pragma once
/// @file
/// The search for all patches (62), with a proof that none was missed. Parts of the wheel that lie
/// above a tangent of the rail are left out; over the others the wheel's contact locus is walked,
/// the penetration's extrema are solved for, and each run of penetrating strips is a zone whose
/// deepest point is a patch. May include: core, numerics, profile, surface.
///
/// What is proved (ContactResult::is_proved), and from what, stands in detail/penetration_bounds.hpp.

#include <wheelrail/contact/detail/first_guesses.hpp>
#include <wheelrail/contact/detail/lifted_patch.hpp>
#include <wheelrail/contact/detail/locus_strips.hpp>
#include <wheelrail/contact/detail/near_runs.hpp>
#include <wheelrail/contact/detail/penetration_bounds.hpp>
#include <wheelrail/contact/patch_blending.hpp>
#include <wheelrail/contact/search_memory.hpp>

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
  /// Where the penetration varies by at most depth_tolerance [m], a part of the profile is not
  /// divided further: zones shallower than this may be missing, or be one where they are two.
  T depth_tolerance = constant<T>(1e-9L);
  /// Whether zone_lower and zone_upper of the patches are solved for; otherwise they are NaN, but for
  /// the minima between blended patches.
  bool zone_ends = true;
  /// Parts are not divided any more once evaluations > maximum_evaluations; `is_proved` is false
  /// then where the search depended on it.
  int maximum_evaluations = 4000;
  /// Where blending_length > 0 [m], forces do not jump from pose to pose: each local maximum of the
  /// penetration that is deeper than the threshold is a patch with its `share` of the zone's force,
  /// and patches have mean curvatures over this length to either side (patch_blending.hpp). About
  /// the semi-axis of a contact ellipse, 3 mm, will do. The paper has no such thing: 0.
  T blending_length = T(0);
};

namespace detail {

// What maxima and minima of a blended zone differ by [m]. Smaller ones may not have been found.
template <Profile P>
[[nodiscard]] typename P::Scalar blending_resolution(
    const Wheel<P>& wheel, const SearchOptions<typename P::Scalar>& options) {
  using T = typename P::Scalar;
  return max(options.depth_tolerance, T(T(64) * epsilon<T>() * wheel.nominal_radius()));
}

/// Walks the strips of one wheel and collects the zones, in a result that would be copied if returned.
template <Profile P, Profile R>
class StripWalk {
 public:
  using T = typename P::Scalar;

  StripWalk(const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<T>& placement,
            const SearchOptions<T>& options, SearchMemory<T>* memory, ContactResult<T>& result)
      : wheel_(wheel),
        rail_(rail),
        placement_(placement),
        options_(options),
        can_prove_(wheel.strips().is_proved() && rail.is_proved_convex()),
        memory_(memory),
        result_(result),
        margin_(T(64) * epsilon<T>() * wheel.nominal_radius()),
        strips_(wheel, rail, placement),
        near_(wheel, rail, placement, T(options.penetration_threshold - margin_)),
        bounds_(rail, wheel.strips().greatest_radius(), placement,
                T(options.penetration_threshold - margin_)),
        newton_(wheel) {
    is_blending_ = T(0) < options.blending_length;
    resolution_ = blending_resolution(wheel, options);
  }

  // Into the result, which is as constructed.
  void run() {
    result_.is_proved = can_prove_;
    if (memory_ == nullptr || !can_prove_) {
      near_.for_each(T(0), [this](int first, int last) {
        visit_run(first, last, strips_.of_wheel(first), strips_.of_wheel(last));
      });
    } else {
      const T& threshold = options_.penetration_threshold;
      if (!memory_->covers(rail_, placement_, threshold)) {
        memory_->restart(rail_, placement_, threshold);
        remember_parts();
      }
      memory_->begin_search(placement_);
      for (auto& part : memory_->parts()) visit_remembered(part);
    }
    leave_zone();
    result_.evaluations += strips_.count();
  }

 private:
  using Strip = LocusStrip<T>;

  // A strip and its index in the wheel, -1 where it is none of the wheel's.
  struct Indexed {
    Strip strip;
    int index;
  };

  // What is near the rail, and what will be known of it during the memory's motion.
  void remember_parts() {
    const auto& motion = memory_->motion();
    const PenetrationBounds<R> bounds(rail_, wheel_.strips().greatest_radius(), placement_,
                                      T(options_.penetration_threshold - margin_), motion);
    near_.for_each(motion.distance, [&](int first, int last) {
      const Strip left = strips_.edge(first);
      remember_run(first, last, left, strips_.edge(last), bounds);
    });
    leave_outside();
  }

  void remember_run(int first, int last, const Strip& left, const Strip& right,
                    const PenetrationBounds<R>& bounds) {
    const ShapeBounds<T> shape = wheel_.strips().shape_between(first, last);
    const Judgement<T> judgement = remember_if_known({left, first}, {right, last}, shape, bounds);
    if (judgement.verdict != Verdict::open) return;
    if (last == first + 1) {
      if (is_above(first, left, right, memory_->motion().distance)) return;
      remember_leaf({left, first}, {right, last}, judgement, bounds);
    } else {
      const int between = first + (last - first) / 2;
      const Strip middle = strips_.of_wheel(between);
      remember_run(first, between, left, middle, bounds);
      remember_run(between, last, middle, right, bounds);
    }
  }

  // What lies between two neighbouring strips, of which nothing is known: divided where that helps.
  void remember_leaf(const Indexed& left, const Indexed& right, const Judgement<T>& judgement,
                     const PenetrationBounds<R>& bounds) {
    if (judgement.is_bounded) {
      const int piece = left.strip.piece;
      const T lower = left.strip.wheel_lateral, upper = right.strip.wheel_lateral;
      const Indexed middle{strips_.at(piece, T(lower + (upper - lower) / T(2))), -1};
      const std::size_t known = memory_->parts().size();
      const auto is_known = [&](const Indexed& one, const Indexed& other) {
        const auto within = shape_bounds(wheel_.profile(), piece, one.strip.wheel_lateral,
                                         other.strip.wheel_lateral);
        return remember_if_known(one, other, within, bounds).verdict != Verdict::open;
      };
      if (is_known(left, middle) && is_known(middle, right)) return;
      memory_->truncate(known);
    }
    remember({left.strip, right.strip, left.index, right.index, false});
  }

  // Returns the judgement on what lies between two strips, as it will hold.
  Judgement<T> remember_if_known(const Indexed& left, const Indexed& right,
                                 const ShapeBounds<T>& shape, const PenetrationBounds<R>& bounds) {
    const auto& motion = memory_->motion();
    const MovingStrip<T> moving_left = bounds.moving(left.strip, shape, motion);
    const MovingStrip<T> moving_right = bounds.moving(right.strip, shape, motion);
    const Judgement<T> judgement = bounds.judge(moving_left, moving_right, shape);
    // Without a maximum between two ends that stay outside there is nothing.
    const bool may_rise = T(0) < moving_left.greatest_slope() && moving_right.least_slope() < T(0);
    if (judgement.verdict == Verdict::simple &&
        (may_rise || !stays_outside(moving_left) || !stays_outside(moving_right))) {
      remember({remembered(left, moving_left), remembered(right, moving_right), left.index,
                right.index, true});
    }
    return judgement;
  }

  void remember(RememberedPart<T> part) {
    using Joins = typename RememberedPart<T>::Joins;
    const auto parts = memory_->parts();
    if (!parts.empty() && parts.back().right.wheel_lateral == part.left.wheel_lateral) {
      const bool same_piece = parts.back().right.piece == part.left.piece;
      part.joins = same_piece ? Joins::same : Joins::joint;
    } else {
      leave_outside();
      settle_outside(part.left);
    }
    part.extremum = extremum_guess(part.left, part.right);
    part.found_at = placement_.position_rail.y();
    memory_->add(part);
  }

  // What lies beside the remembered parts stays outside, and so do their ends there.
  void leave_outside() {
    if (!memory_->parts().empty()) settle_outside(memory_->parts().back().right);
  }
  static void settle_outside(Strip& strip) {
    if (!strip.is_exact) strip.side = Strip::Side::outside;
  }

  // What holds of a strip during the motion. It need not be looked at then if it deepens to one side,
  // unless it may be the deepest itself, at a joint.
  [[nodiscard]] Strip remembered(const Indexed& now, const MovingStrip<T>& moving) const {
    Strip strip = now.strip;
    const bool keeps_slope = T(0) < moving.least_slope() || moving.greatest_slope() < T(0);
    strip.is_exact =
        !(moving.exists && keeps_slope && (stays_outside(moving) || !is_joint(now.index)));
    if (strip.is_exact) return strip;
    const T inside = options_.penetration_threshold + margin_;
    if (stays_outside(moving)) strip.side = Strip::Side::outside;
    if (inside < moving.least_penetration()) strip.side = Strip::Side::inside;
    return strip;
  }
  [[nodiscard]] bool stays_outside(const MovingStrip<T>& strip) const {
    return strip.greatest_penetration() < options_.penetration_threshold - margin_;
  }

  // Whether a strip is the first or the last one of its piece.
  [[nodiscard]] bool is_joint(int index) const {
    if (index < 0) return false;
    const auto& strips = wheel_.strips().strips();
    const auto i = static_cast<std::size_t>(index);
    return i == 0 || i + 1 == strips.size() || strips[i - 1].piece != strips[i].piece ||
           strips[i + 1].piece != strips[i].piece;
  }

  void visit_remembered(RememberedPart<T>& part) {
    using Joins = typename RememberedPart<T>::Joins;
    const Strip left = now(part.left, part.left_index);
    const Strip right = now(part.right, part.right_index);
    if (part.joins == Joins::apart) leave_zone();
    const bool is_visited =
        part.joins == Joins::same && (!left.is_exact || (last_.is_exact && is_same(last_, left)));
    if (!is_visited) visit(left);
    if (part.is_simple) {
      T extremum = memory_->extremum_near(part);
      if (visit_extremum(left, right, extremum)) memory_->found_extremum(part, extremum);
    } else {
      if (!is_above(part.left_index, left, right, T(0))) visit_part(left, right, 0);
    }
    visit(right);
  }

  [[nodiscard]] static bool is_same(const Strip& one, const Strip& other) {
    return one.piece == other.piece && one.wheel_lateral == other.wheel_lateral;
  }

  // A remembered strip, at the placement as it is where that matters.
  [[nodiscard]] Strip now(const Strip& remembered, int index) {
    if (!remembered.is_exact) return remembered;
    if (0 <= index) return strips_.edge(index);
    return last_.is_exact && is_same(last_, remembered)
               ? last_
               : strips_.at(remembered.piece, remembered.wheel_lateral);
  }

  // Whether what lies between two neighbouring strips is above a tangent at one of their feet.
  [[nodiscard]] bool is_above(int first, const Strip& left, const Strip& right,
                              const T& clearance) const {
    return near_.is_above(left, first, clearance) || near_.is_above(right, first, clearance);
  }

  // The strips from `first` to `last`, of one piece, with those at both ends.
  void visit_run(int first, int last, const Strip& left, const Strip& right) {
    const Judgement<T> judgement =
        bounds_.judge(left, right, wheel_.strips().shape_between(first, last));
    if (judgement.verdict == Verdict::excluded) return;
    const bool is_open = judgement.verdict == Verdict::open;
    if (is_open && last == first + 1 && is_above(first, left, right, T(0))) return;
    if (is_open && first + 1 < last) {
      const int between = first + (last - first) / 2;
      const Strip middle = strips_.of_wheel(between);
      visit_run(first, between, left, middle);
      visit_run(between, last, middle, right);
      return;
    }
    enter(first, left);
    reached_ = last;
    if (judgement.verdict == Verdict::simple) {
      visit_extremum(left, right, extremum_guess(left, right));
    } else {
      visit_open(left, right, judgement, 0);
    }
    visit(right);
  }

  // Between two strips, the left one visited, of which nothing is known: they are divided until it
  // is, or too little to matter. Where that proves nothing, they are taken to have one extremum.
  void visit_open(const Strip& left, const Strip& right, const Judgement<T>& judgement, int depth) {
    // What is unbounded becomes bounded soon, or never.
    const int maximum_depth = judgement.is_bounded ? 16 : 6;
    const bool is_small = judgement.variation < options_.depth_tolerance;
    if (!is_small && can_prove_ && depth < maximum_depth &&
        strips_.count() < options_.maximum_evaluations) {
      const T half_width = (right.wheel_lateral - left.wheel_lateral) / T(2);
      const Strip middle = strips_.at(left.piece, T(left.wheel_lateral + half_width));
      visit_part(left, middle, depth + 1);
      visit(middle);
      visit_part(middle, right, depth + 1);
      return;
    }
    result_.is_proved = result_.is_proved && is_small;
    if (depth == 0) visit_rail_joints(right);
    visit_extremum(last_, right, extremum_guess(last_, right));
  }

  void visit_part(const Strip& left, const Strip& right, int depth) {
    const Judgement<T> judgement = bounds_.judge(
        left, right,
        shape_bounds(wheel_.profile(), left.piece, left.wheel_lateral, right.wheel_lateral));
    if (judgement.verdict == Verdict::simple) {
      visit_extremum(left, right, extremum_guess(left, right));
    }
    if (judgement.verdict == Verdict::open) visit_open(left, right, judgement, depth);
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

  // Of a strip that is exact, or whose side is known.
  [[nodiscard]] bool penetrates(const Strip& at) const {
    if (!at.is_exact) return at.side == Strip::Side::inside;
    return at.exists && options_.penetration_threshold < at.penetration;
  }
  [[nodiscard]] static bool has_side(const Strip& at) {
    return at.is_exact || at.side != Strip::Side::unknown;
  }

  // Where the foot passes a joint of the rail between the last strip and the next, the
  // penetration's second derivative jumps, and it can have an extremum on either side: a strip is
  // put there.
  void visit_rail_joints(const Strip& next) {
    const R& rail = rail_.profile();
    if (!last_.exists || !next.exists) return;
    int piece = piece_of(rail, last_.rail_lateral);
    const int end = piece_of(rail, next.rail_lateral);
    while (piece != end) {
      const T joint = rail.joint(piece < end ? piece + 1 : piece);
      const auto root = bracketed_root<T>(
          [&](const T& u) { return T(strips_.at(next.piece, u).rail_lateral - joint); },
          last_.wheel_lateral, next.wheel_lateral, T(last_.rail_lateral - joint),
          T(next.rail_lateral - joint),
          {.step_tolerance = (next.wheel_lateral - last_.wheel_lateral) / T(1000)});
      piece += piece < end ? 1 : -1;
      const Strip at = strips_.at(next.piece, root.position);
      if (root.status != SolveStatus::converged || !at.exists) {
        result_.status = SearchStatus::not_converged;
        continue;
      }
      visit_extremum(last_, at, extremum_guess(last_, at));
      visit(at);
    }
  }

  [[nodiscard]] T extremum_guess(const Strip& left, const Strip& right) const {
    return detail::extremum_guess(left, right, options_.penetration_threshold);
  }

  // Solves for the extremum of the penetration between two strips of one piece, if there is one
  // that can matter: a maximum that may reach the threshold, or a minimum between two that do.
  // `position` is where it is looked for first, and where it was found.
  bool visit_extremum(const Strip& left, const Strip& right, T& position) {
    if (!left.exists || !right.exists || left.slope == T(0) || right.slope == T(0)) return false;
    const bool is_maximum = T(0) < left.slope && right.slope < T(0);
    const bool is_minimum = left.slope < T(0) && T(0) < right.slope;
    if (!is_maximum && !is_minimum) return false;
    // The left one was visited.
    if (is_minimum && (!zone_is_open_ || (has_side(right) && !penetrates(right)))) return false;
    bool lost = false;
    Strip at;
    const auto root = bracketed_newton<T>(
        [&](const T& u) {
          strips_.put(left.piece, u, at);
          lost = lost || !at.exists;
          return ValueAndSlope<T>{at.slope, at.slope_rate};
        },
        left.wheel_lateral, right.wheel_lateral, left.slope, right.slope, position,
        // Where the bodies nearly conform, the slope's rounding outweighs its rate.
        newton_.extremum());
    if (root.status != SolveStatus::converged || lost) {
      result_.status = SearchStatus::not_converged;
      return false;
    }
    // The last step changes an extremum by its square: rounding.
    at.wheel_lateral = position = root.position;
    visit(at);
    return true;
  }
  void visit_extremum(const Strip& left, const Strip& right, T&& position) {
    visit_extremum(left, right, position);
  }

  // The next strip in the order of wheel_lateral: opens, deepens or closes a zone.
  void visit(const Strip& next) {
    if (!has_side(next)) return;
    const bool inside = penetrates(next);
    if (inside && !zone_is_open_) {
      zone_is_open_ = true;
      zone_is_cut_ = !last_.exists;
      zone_lower_ = options_.zone_ends ? next.wheel_lateral : T(T(0) / T(0));
      if (options_.zone_ends && last_.exists) zone_lower_ = boundary(last_, next);
      deepest_ = next;
    } else if (!inside && zone_is_open_) {
      zone_is_cut_ = zone_is_cut_ || !next.exists;
      close_zone(options_.zone_ends && next.exists ? boundary(last_, next) : last_.wheel_lateral);
    } else if (is_blending_ && inside && next.is_exact && deepest_.is_exact) {
      blend(next);
    } else if (inside && next.is_exact &&
               (!deepest_.is_exact || deepest_.penetration < next.penetration)) {
      deepest_ = next;
    }
    last_ = next;
  }

  // The next strip of an open zone of which each local maximum becomes a patch.
  void blend(const Strip& next) {
    if (!has_fallen_) {
      if (deepest_.penetration < next.penetration) deepest_ = next;
      minimum_ = deepest_.penetration - resolution_;
    }
    if (next.penetration < minimum_) {
      has_fallen_ = true;
      minimum_ = next.penetration;
      minimum_lateral_ = next.wheel_lateral;
    } else if (has_fallen_ && minimum_ + resolution_ < next.penetration) {
      add_patch(minimum_lateral_, minimum_);
      zone_lower_ = minimum_lateral_;
      zone_is_cut_ = has_fallen_ = false;
      deepest_ = next;
    }
  }

  // Ends the walk over neighbouring strips; a zone that is open there ends with the profile.
  void leave_zone() {
    if (zone_is_open_) {
      zone_is_cut_ = true;
      close_zone(last_.wheel_lateral);
    }
    last_ = Strip();
  }

  // Where the penetration passes the threshold between two neighbouring strips. @pre zone_ends
  [[nodiscard]] T boundary(const Strip& left, const Strip& right) {
    if (left.wheel_lateral == right.wheel_lateral) return left.wheel_lateral;
    const T& threshold = options_.penetration_threshold;
    const Strip& inside = penetrates(left) ? left : right;
    const T depth = inside.penetration - threshold;
    T start = boundary_guess(left, right, penetrates(left), threshold);
    if (memory_ != nullptr) {
      start = memory_->zone_end_between(left.wheel_lateral, right.wheel_lateral,
                                        inside.wheel_lateral, depth, start);
    }
    bool lost = false;
    const T left_side = penetrates(left) ? T(1) : T(-1);  // all that matters of the values there
    const auto root = bracketed_newton<T>(
        [&](const T& u) {
          const int piece = left.piece == right.piece ? left.piece : piece_of(wheel_.profile(), u);
          const Strip at = strips_.at(piece, u);
          lost = lost || !at.exists;
          return ValueAndSlope<T>{T(at.penetration - threshold), at.slope};
        },
        left.wheel_lateral, right.wheel_lateral, left_side, T(-left_side), start,
        newton_.zone_end());
    if (memory_ != nullptr) memory_->add_zone_end(root.position, inside.wheel_lateral, depth);
    if (root.status != SolveStatus::converged || lost) {
      result_.status = SearchStatus::not_converged;
    }
    return root.position;
  }

  void close_zone(const T& zone_upper) {
    zone_is_open_ = has_fallen_ = false;
    add_patch(options_.zone_ends ? zone_upper : T(T(0) / T(0)), T(0));
  }

  void add_patch(const T& zone_upper, const T& penetration_to_next) {
    ++result_.evaluations;
    const bool is_kept = result_.patches.push_back_made([&] {
      Patch<T> patch =
          patch_on_strip(wheel_, rail_, placement_, deepest_.piece, deepest_.wheel_lateral);
      patch.zone_lower = zone_lower_;
      patch.zone_upper = zone_upper;
      patch.zone_is_cut = zone_is_cut_;
      if (is_blending_) {
        patch.penetration_to_next = penetration_to_next;
        patch = with_mean_curvatures(patch, wheel_, rail_, options_.blending_length);
      }
      if (options_.maximum_penetration < patch.penetration) result_.status = SearchStatus::too_deep;
      return patch;
    });
    if (!is_kept) result_.status = SearchStatus::too_many_patches;
  }

  const Wheel<P>& wheel_;
  const Rail<R>& rail_;
  const WheelPlacement<T>& placement_;
  const SearchOptions<T>& options_;
  bool can_prove_;           // given that nothing is too steep or divided too often
  SearchMemory<T>* memory_;  // null: nothing is remembered
  ContactResult<T>& result_;
  T margin_;  // rounding of the bound and of the penetration [m]
  LocusStrips<P, R> strips_;
  NearRuns<P, R> near_;
  PenetrationBounds<R> bounds_;
  NewtonEnds<T> newton_;
  int reached_ = -1;  // the last strip of the wheel that was visited
  Strip last_;
  DeepestStrip<T> deepest_;  // of the zone
  T zone_lower_ = T(0);
  bool zone_is_open_ = false, zone_is_cut_ = false;
  bool is_blending_ = false;
  bool has_fallen_ = false;  // of a blended zone: from a local maximum to a minimum so far
  T resolution_ = T(0), minimum_ = T(0), minimum_lateral_ = T(0);
};

// Sets the shares of blended patches.
template <Real T>
void share_out(ContactResult<T>& result, const T& resolution) {
  const auto shares = blended_shares(result.patches, resolution);
  for (std::size_t i = 0; i < result.patches.size(); ++i) result.patches[i].share = shares[i];
}

template <Profile P, Profile R>
[[nodiscard]] ContactResult<typename P::Scalar> find_contact(
    const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<typename P::Scalar>& placement,
    const SearchOptions<ValueOf<typename P::Scalar>>& options,
    SearchMemory<ValueOf<typename P::Scalar>>* memory) {
  using T = typename P::Scalar;
  if constexpr (has_derivatives<T>) {
    using Values = typename Wheel<P>::Values;
    using RailValues = typename Rail<R>::Values;
    const auto found =
        detail::find_contact<typename Values::ProfileType, typename RailValues::ProfileType>(
            wheel.values(), rail.values(), placement.values(), options, memory);
    auto result = lifted_result(wheel, rail, placement, found, options.penetration_threshold);
    if (ValueOf<T>(0) < options.blending_length) {
      for (auto& patch : result.patches) {
        patch = with_mean_curvatures(patch, wheel, rail, T(options.blending_length));
      }
      share_out(result, T(blending_resolution(wheel.values(), options)));
    }
    return result;
  } else {
    ContactResult<T> result;
    if (!is_finite_placement(placement) || !is_finite(options.penetration_threshold)) {
      result.status = SearchStatus::not_finite;
      return result;
    }
    StripWalk<P, R>(wheel, rail, placement, options, memory, result).run();
    if (memory != nullptr && !result.is_proved) {
      // At this very placement more may be excluded than near it.
      const int evaluations = result.evaluations;
      result = {};
      StripWalk<P, R>(wheel, rail, placement, options, nullptr, result).run();
      result.evaluations += evaluations;
    }
    if (T(0) < options.blending_length) share_out(result, blending_resolution(wheel, options));
    return result;
  }
}

}  // namespace detail

/// All patches between @p wheel and @p rail at @p placement.
/// @return one patch for each zone of the wheel profile whose locus lies under the rail's surface, in
///   the order of wheel_lateral; penetration is solved for to rounding, wheel_lateral and the zone's
///   ends to the square of sqrt(epsilon) radii over the profile's own radius: hardly more (an end that
///   zone_is_cut tells of: to a strip; over a corner of the rail profile: to 2 sqrt(epsilon) radii,
///   the penetration to its angle times that). Strips whose foot lies beyond the rail profile's ends
///   do not count as penetrating. Where a zone holds several local maxima the deepest is its patch;
///   with SearchOptions::blending_length each is one, its zone ending at the minima between them.
/// @note Does not allocate. Equations (57), (59), (61), (62) of the paper.
/// @note Dual numbers: exact derivatives, of patches that stay. At its birth a patch has them but for
///   the zone's ends, whose slopes grow beyond bounds, as does that of its place where it merges with a
///   minimum. That (62) drops a patch then, no derivative tells. At joints those of one side.
template <Profile P, Profile R>
[[nodiscard]] ContactResult<typename P::Scalar> find_contact(
    const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<typename P::Scalar>& placement,
    const SearchOptions<ValueOf<typename P::Scalar>>& options = {}) {
  return detail::find_contact<P, R>(wheel, rail, placement, options, nullptr);
}

/// The same with a warm start: the same patches to the last bit, whatever @p memory holds, in less
/// time where the wheel stands nearly as in the search before. (Newton's method may end on another one
/// of two multiples of its grid between which rounding decides: in float, where the penetration hardly
/// varies and so is the same within 2 epsilon radii.) options.maximum_evaluations counts its own.
/// @param memory made for this wheel, used on this rail; one search at a time may use it.
template <Profile P, Profile R>
[[nodiscard]] ContactResult<typename P::Scalar> find_contact(
    const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<typename P::Scalar>& placement,
    SearchMemory<ValueOf<typename P::Scalar>>& memory,
    const SearchOptions<ValueOf<typename P::Scalar>>& options = {}) {
  WHEELRAIL_ASSERT(memory.is_for(wheel));
  return detail::find_contact<P, R>(wheel, rail, placement, options, &memory);
}

}  // namespace wheelrail
