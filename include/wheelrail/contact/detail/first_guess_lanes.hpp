#pragma once
// First guesses in lanes, between a pair of strips in each. May include: core, numerics, profile,
// surface, contact/placement.

#include <wheelrail/contact/detail/first_guesses.hpp>
#include <wheelrail/contact/detail/locus_strip_lanes.hpp>

namespace wheelrail::detail {

// PenetrationCurve in lanes.
template <Real T>
struct PenetrationCurveLanes {
  using L = Lanes<T>;

  Cubic<L, T> from_left, from_right;
  L joint, has_joint;

  PenetrationCurveLanes(const LocusStripLanes<T>& left, const LocusStripLanes<T>& right,
                        const T& threshold) {
    const L width = right.wheel_lateral - left.wheel_lateral;
    const L rise = right.penetration - left.penetration;
    const L s0 = width * left.slope, s1 = width * right.slope;
    const L r0 = width * width * left.slope_rate, r1 = width * width * right.slope_rate;
    const L k = (s1 - r1 - s0) / (r0 - r1), rest = T(1) - k;
    const L lesser = r0.abs().min(r1.abs()), greater = r0.abs().max(r1.abs());
    has_joint = less<T>(constant<T>(1.5L) * lesser, greater) * less<T>(L::Zero(), k) *
                less<T>(L::Zero(), rest);
    joint = choose<T>(has_joint, k, all_lanes(T(1)));
    const L straight = k * (s0 + k * r0 / T(2)) + rest * (s1 - rest * r1 / T(2));
    const L c3 = (rise - straight) / (k * k * k + rest * rest * rest);
    from_left.c0 = left.penetration - threshold;
    from_left.c1 = s0;
    from_left.c2 = choose<T>(has_joint, r0 / T(2), T(3) * rise - T(2) * s0 - s1);
    from_left.c3 = choose<T>(has_joint, c3, s0 + s1 - T(2) * rise);
    from_right.c0 = right.penetration - threshold;
    from_right.c1 = s1;
    from_right.c2 = r1 / T(2);
    from_right.c3 = c3;
  }

  [[nodiscard]] L root(const L& t) const {
    return choose<T>(is_left(from_left.value(joint), from_left.c0), from_left.near_root(t),
                     T(1) + from_right.near_root(t - T(1)));
  }
  [[nodiscard]] L extremum() const {
    const L side = T(1) - T(2) * less<T>(from_left.c1, L::Zero());
    return choose<T>(is_left(from_left.slope(joint), from_left.c1), from_left.extremum(side),
                     T(1) + from_right.extremum(side));
  }

 private:
  // Flags of the lanes without a joint, or where what is looked for lies before it.
  [[nodiscard]] L is_left(const L& at_joint, const L& at_left) const {
    return T(1) - has_joint * equal<T>(less<T>(at_joint, L::Zero()), less<T>(at_left, L::Zero()));
  }
};

template <Real T>
[[nodiscard]] Lanes<T> between(const LocusStripLanes<T>& left, const LocusStripLanes<T>& right,
                               const Lanes<T>& share, const Lanes<T>& otherwise) {
  const Lanes<T> is_within = less<T>(Lanes<T>::Zero(), share) * less<T>(share, all_lanes(T(1)));
  return left.wheel_lateral +
         choose<T>(is_within, share, otherwise) * (right.wheel_lateral - left.wheel_lateral);
}

template <Real T>
[[nodiscard]] Lanes<T> extremum_guess(const LocusStripLanes<T>& left,
                                      const LocusStripLanes<T>& right, const T& threshold) {
  const Lanes<T> secant = left.slope / (left.slope - right.slope);
  const PenetrationCurveLanes<T> curve(left, right, threshold);
  return between<T>(left, right, curve.extremum(), secant);
}

// left_is_inside: flags
template <Real T>
[[nodiscard]] Lanes<T> boundary_guess(const LocusStripLanes<T>& left,
                                      const LocusStripLanes<T>& right,
                                      const Lanes<T>& left_is_inside, const T& threshold) {
  using L = Lanes<T>;
  const L inside = choose<T>(left_is_inside, left.penetration, right.penetration);
  const L outside = choose<T>(left_is_inside, right.penetration, left.penetration);
  const L inside_slope = choose<T>(left_is_inside, left.slope, right.slope);
  const L depth = inside - threshold, chord = depth / (inside - outside);
  const L width = right.wheel_lateral - left.wheel_lateral;
  const L at_top = less<T>(inside_slope.abs() * width.abs(), depth / T(4));
  const L from_inside = choose<T>(at_top, chord.sqrt(), chord);
  const L share = choose<T>(left_is_inside, from_inside, T(1) - from_inside);
  const PenetrationCurveLanes<T> curve(left, right, threshold);
  return between<T>(left, right, curve.root(share), share);
}

}  // namespace wheelrail::detail
