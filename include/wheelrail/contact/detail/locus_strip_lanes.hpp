#pragma once
// LocusStrips in lanes: strips of several placements at once, and Newton's method over them.
// May include: core, numerics, profile, surface, contact/placement.

#include <wheelrail/contact/detail/locus_strip.hpp>
#include <wheelrail/contact/placement_batch.hpp>
#include <wheelrail/contact/rail_foot.hpp>
#include <wheelrail/numerics/bracketed_root.hpp>
#include <wheelrail/profile/detail/profile_lanes.hpp>
#include <wheelrail/profile/rail_head.hpp>

namespace wheelrail::detail {

// A profile that has its nearest point in lanes, too.
template <class P>
concept HasClosestPoints = requires(const P profile, const Lanes<typename P::Scalar> lanes) {
  { profile.closest_points(lanes, lanes) } -> std::same_as<ClosestPointLanes<typename P::Scalar>>;
};

// rail_foot in lanes.
template <Profile R>
[[nodiscard]] ClosestPointLanes<typename R::Scalar> rail_feet(
    const R& profile, const Lanes<typename R::Scalar>& lateral,
    const Lanes<typename R::Scalar>& up) {
  using T = typename R::Scalar;
  if constexpr (HasClosestPoints<R>) {
    return profile.closest_points(lateral, up);
  } else {
    ClosestPointLanes<T> feet;
    for (int lane = 0; lane < lane_count; ++lane) {
      // A lane without a locus point has no foot.
      const bool exists = is_finite(lateral[lane]) && is_finite(up[lane]);
      const T nan = T(0) / T(0);
      const ClosestPoint<T> foot = exists ? rail_foot(profile, lateral[lane], up[lane])
                                          : ClosestPoint<T>{nan, nan, {nan, nan}, nan};
      feet.lateral[lane] = foot.lateral;
      feet.penetration[lane] = foot.penetration;
      feet.normal_lateral[lane] = foot.normal_rail.x();
      feet.normal_up[lane] = foot.normal_rail.y();
      feet.curvature[lane] = foot.curvature;
    }
    return feet;
  }
}

// What the locus needs of a placement.
template <Real T>
struct SectionPlacement {
  T lateral_rail, up_rail, sin_yaw, cos_yaw, tan_yaw, sin_roll, cos_roll;

  SectionPlacement(const PlacementBatch<T>& placements, std::size_t index)
      : lateral_rail(placements.lateral_rail()[index]),
        up_rail(placements.up_rail()[index]),
        sin_yaw(placements.sin_yaw()[index]),
        cos_yaw(placements.cos_yaw()[index]),
        tan_yaw(placements.tan_yaw()[index]),
        sin_roll(placements.sin_roll()[index]),
        cos_roll(placements.cos_roll()[index]) {}
};

// That of each lane.
template <Real T>
struct PlacementLanes {
  Lanes<T> lateral_rail, up_rail, sin_yaw, cos_yaw, tan_yaw, sin_roll, cos_roll;

  void set(int lane, const SectionPlacement<T>& placement) {
    lateral_rail[lane] = placement.lateral_rail;
    up_rail[lane] = placement.up_rail;
    sin_yaw[lane] = placement.sin_yaw;
    cos_yaw[lane] = placement.cos_yaw;
    tan_yaw[lane] = placement.tan_yaw;
    sin_roll[lane] = placement.sin_roll;
    cos_roll[lane] = placement.cos_roll;
  }
};

// LocusStrip in lanes, without its piece.
template <Real T>
struct LocusStripLanes {
  Lanes<T> wheel_lateral, rail_lateral, penetration, slope, slope_rate, normal_lateral, normal_up;
  Lanes<T> exists;  // flag

  void set(int lane, const LocusStrip<T>& strip) {
    wheel_lateral[lane] = strip.wheel_lateral;
    rail_lateral[lane] = strip.rail_lateral;
    penetration[lane] = strip.penetration;
    slope[lane] = strip.slope;
    slope_rate[lane] = strip.slope_rate;
    normal_lateral[lane] = strip.normal_rail.x();
    normal_up[lane] = strip.normal_rail.y();
    exists[lane] = T(strip.exists ? 1 : 0);
  }
  // One lane's strip. @param lateral where it is said to be [m]
  [[nodiscard]] LocusStrip<T> strip(int lane, int piece, const T& lateral) const {
    LocusStrip<T> result;
    result.wheel_lateral = lateral;
    result.piece = piece;
    result.exists = T(0) < exists[lane];
    result.rail_lateral = rail_lateral[lane];
    result.penetration = penetration[lane];
    result.slope = slope[lane];
    result.slope_rate = slope_rate[lane];
    result.normal_rail = Vector2<T>(normal_lateral[lane], normal_up[lane]);
    return result;
  }
};

// LocusPoint in lanes, without what only its place along the rail needs.
template <Real T>
struct LocusPointLanes {
  Lanes<T> radius, sine, cosine, inverse_cosine, lateral, up, lateral_rate, up_rate;
  Lanes<T> exists;  // flag
};

// As locus_point has it, in its order of operations.
template <Profile P>
[[nodiscard]] LocusPointLanes<typename P::Scalar> locus_points(
    const Wheel<P>& wheel, const PlacementLanes<typename P::Scalar>& at,
    const Lanes<typename P::Scalar>& u, const ProfilePointLanes<typename P::Scalar>& point) {
  using T = typename P::Scalar;
  const Lanes<T>&slope = point.slope, &bend = point.second_derivative;
  LocusPointLanes<T> locus;
  locus.radius = wheel.nominal_radius() + point.value;
  locus.sine = at.tan_yaw * slope;
  const Lanes<T> cosine_squared = T(1) - locus.sine * locus.sine;
  locus.exists = less<T>(all_lanes(T(0)), cosine_squared);
  locus.cosine = cosine_squared.sqrt();
  const Lanes<T> fold = at.sin_yaw * at.tan_yaw;
  const Lanes<T> y = u * at.cos_yaw - locus.radius * slope * fold;
  const Lanes<T> z = -locus.radius * locus.cosine;
  const Lanes<T> y_rate = at.cos_yaw - (slope * slope + locus.radius * bend) * fold;
  locus.inverse_cosine = T(1) / locus.cosine;
  const Lanes<T> z_rate =
      -slope * locus.cosine + locus.radius * at.tan_yaw * locus.sine * bend * locus.inverse_cosine;
  locus.lateral = at.lateral_rail + at.cos_roll * y - at.sin_roll * z;
  locus.up = at.up_rail + at.sin_roll * y + at.cos_roll * z;
  locus.lateral_rate = at.cos_roll * y_rate - at.sin_roll * z_rate;
  locus.up_rate = at.sin_roll * y_rate + at.cos_roll * z_rate;
  return locus;
}

// As LocusStrips::at has it, in its order of operations.
template <Profile P, Profile R>
[[nodiscard]] LocusStripLanes<typename P::Scalar> locus_strips(
    const Wheel<P>& wheel, const Rail<R>& rail, const PlacementLanes<typename P::Scalar>& at,
    const Lanes<typename P::Scalar>& u, const ProfilePointLanes<typename P::Scalar>& point) {
  using T = typename P::Scalar;
  const LocusPointLanes<T> locus = locus_points(wheel, at, u, point);
  const Lanes<T>&slope = point.slope, &bend = point.second_derivative;
  const Lanes<T>& inverse_cosine = locus.inverse_cosine;
  const ClosestPointLanes<T> foot = rail_feet(rail.profile(), locus.lateral, locus.up);
  const Lanes<T>&n_y = foot.normal_lateral, &n_z = foot.normal_up;
  const Lanes<T> steepness = slope * slope;
  const Lanes<T> squared_tan_yaw = at.tan_yaw * at.tan_yaw;
  const Lanes<T> y_bend = T(-3) * squared_tan_yaw * at.cos_yaw * slope * bend;
  const Lanes<T> z_bend =
      -bend * locus.cosine +
      squared_tan_yaw * bend * inverse_cosine *
          (T(2) * steepness + locus.radius * bend * inverse_cosine * inverse_cosine);
  const Lanes<T> along = n_z * locus.lateral_rate - n_y * locus.up_rate;
  LocusStripLanes<T> result;
  result.wheel_lateral = u;
  result.rail_lateral = foot.lateral;
  result.penetration = foot.penetration;
  result.normal_lateral = n_y;
  result.normal_up = n_z;
  result.slope = -(n_y * locus.lateral_rate + n_z * locus.up_rate);
  result.slope_rate = -(n_y * at.cos_roll + n_z * at.sin_roll) * y_bend -
                      (n_z * at.cos_roll - n_y * at.sin_roll) * z_bend -
                      foot.curvature / (T(1) - foot.curvature * foot.penetration) * along * along;
  const Lanes<T> is_beyond = less<T>(foot.lateral, all_lanes(rail.profile().lower()))
                                 .max(less<T>(all_lanes(rail.profile().upper()), foot.lateral));
  result.exists =
      locus.exists * finite<T>(result.penetration) * finite<T>(result.slope) * (T(1) - is_beyond);
  return result;
}

// What bracketed_newton_lanes ended with.
template <Real T>
struct RootLanes {
  Lanes<T> position;
  Lanes<T> iterations;
  Lanes<T> is_converged;  // flag
};

// bracketed_newton on a grid, in lanes: each of them takes the steps that it would take alone, at most
// 16, and waits for the others at the point that it was evaluated at last.
// function(x, value, slope): sets the last two. rising: flags of the lanes where f is below zero at
// the lower end; it must not be zero at the ends.
template <Real T, class Function>
[[nodiscard]] RootLanes<T> bracketed_newton_lanes(Function&& function, Lanes<T> lower,
                                                  Lanes<T> upper, const Lanes<T>& rising,
                                                  const Lanes<T>& start,
                                                  const RootOptions<T>& options) {
  constexpr int maximum_iterations = 16;  // more than any lane is worth waiting for
  using L = Lanes<T>;
  const T large = options.grid / epsilon<T>();
  L x = (start + large) - large;
  x = x.max(lower).min(upper);
  L step_before_last = upper - lower, last_step = step_before_last, value, slope;
  L goes_on = all_lanes(T(1));
  RootLanes<T> root{x, L::Zero(), L::Zero()};
  for (int iteration = 1; iteration <= maximum_iterations && any<T>(goes_on); ++iteration) {
    function(x, value, slope);
    const L is_good = finite<T>(value);
    const L is_zero = T(1) - less<T>(all_lanes(options.residual_tolerance), value.abs());
    const L is_low = equal<T>(less<T>(value, L::Zero()), rising);
    const L low = choose<T>(is_low, x, lower), high = choose<T>(is_low, upper, x);
    const L newton = x - value / slope;
    const L newton_step = (newton - x).abs();
    const L is_long =
        less<T>(all_lanes(options.grid), newton_step).max(T(1) - equal<T>((x + large) - large, x));
    const L is_useful = finite<T>(newton) * less<T>(low, newton) * less<T>(newton, high) *
                        (T(1) - less<T>(step_before_last.abs(), T(2) * newton_step) * is_long);
    const L next = choose<T>(is_useful, newton, low + (high - low) / T(2));
    const L step = next - x, length = step.abs();
    const L multiple = (next + large) - large;
    const L is_back = equal<T>(multiple, x) * is_useful;
    const L fits = is_back.max(less<T>(low, multiple) * less<T>(multiple, high));
    const L next_x = choose<T>(fits, multiple, next);
    const L is_short =
        T(1) -
        less<T>((T(2) * epsilon<T>() * x.abs()).max(all_lanes(options.step_tolerance)), length);
    const L is_root = is_good * is_zero.max(is_short).max(is_back);
    root.position = choose<T>(goes_on, choose<T>(is_zero, x, next), root.position);
    root.iterations += goes_on;
    root.is_converged = choose<T>(goes_on, is_root, root.is_converged);
    goes_on = goes_on * is_good * (T(1) - is_root);
    lower = choose<T>(goes_on, low, lower);
    upper = choose<T>(goes_on, high, upper);
    step_before_last = choose<T>(goes_on, last_step, step_before_last);
    last_step = choose<T>(goes_on, step, last_step);
    x = choose<T>(goes_on, next_x, x);
  }
  return root;
}

}  // namespace wheelrail::detail
