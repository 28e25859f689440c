#pragma once
// Where between two strips the penetration has an extremum or passes the threshold, from what the two
// strips tell: where Newton's method starts; and when it ends. May include: core, numerics, profile,
// surface, contact/placement.

#include <cmath>
#include <wheelrail/contact/detail/locus_strip.hpp>
#include <wheelrail/numerics/bracketed_root.hpp>
#include <wheelrail/surface/wheel.hpp>

namespace wheelrail::detail {

// When Newton's method along the profile of a wheel ends. The root's error is the square of the last
// step, which is shorter than the grid, over the radius of a profile: rounding, but in float.
template <Real T>
class NewtonEnds {
 public:
  template <Profile P>
  explicit NewtonEnds(const Wheel<P>& wheel)
      : rounding_(T(4) * epsilon<T>() * wheel.nominal_radius()) {
    using std::sqrt;
    grid_ = min(T(T(4) * sqrt(epsilon<T>()) * wheel.nominal_radius()), constant<T>(1e-4L));
  }

  // For a zone's end: the residual is one of penetration [m].
  [[nodiscard]] RootOptions<T> zone_end() const {
    return {.step_tolerance = rounding_, .residual_tolerance = rounding_, .grid = grid_};
  }
  // For an extremum of the penetration: the residual is its slope [-].
  [[nodiscard]] RootOptions<T> extremum() const {
    return {.step_tolerance = rounding_, .residual_tolerance = T(4) * epsilon<T>(), .grid = grid_};
  }

 private:
  T rounding_;  // [m]
  T grid_;      // [m]
};

// A cubic c0 + c1 t + c2 t^2 + c3 t^3 in numbers of V, scalars T or lanes of them.
template <class V, Real T = V>
struct Cubic {
  V c0{}, c1{}, c2{}, c3{};

  [[nodiscard]] V value(const V& t) const { return c0 + t * (c1 + t * (c2 + t * c3)); }
  [[nodiscard]] V slope(const V& t) const { return c1 + t * (T(2) * c2 + t * T(3) * c3); }
  // Two Newton steps from t.
  [[nodiscard]] V near_root(V t) const {
    for (int i = 0; i < 2; ++i) t -= value(t) / slope(t);
    return t;
  }
  // The maximum where side = 1, the minimum where side = -1, to rounding that grows where c1 is tiny;
  // not finite, or not a number, where there is none.
  [[nodiscard]] V extremum(const V& side) const {
    using std::sqrt;
    return c1 / (side * sqrt(V(c2 * c2 - T(3) * c1 * c3)) - c2);
  }
};

// The penetration less the threshold between two strips, over the share t of the way from the left to
// the right one. Where the foot passes a joint of the rail its second derivative jumps: then it is
// taken to be two cubics with the same third derivative, which have the slopes and the second
// derivatives of the strips and rise by as much together as the penetration does; they change places
// where they would meet in slope if they were parabolas. Otherwise it is the cubic with the
// penetrations and slopes of both.
template <Real T>
struct PenetrationCurve {
  Cubic<T> from_left;   // over t
  Cubic<T> from_right;  // over t - 1; unused without a joint
  T joint = T(1);       // t there; 1: there is none

  PenetrationCurve(const LocusStrip<T>& left, const LocusStrip<T>& right, const T& threshold) {
    const T width = right.wheel_lateral - left.wheel_lateral;
    const T rise = right.penetration - left.penetration;
    const T s0 = width * left.slope, s1 = width * right.slope;
    const T r0 = width * width * left.slope_rate, r1 = width * width * right.slope_rate;
    const T k = (s1 - r1 - s0) / (r0 - r1), rest = T(1) - k;
    const T less = min(magnitude(r0), magnitude(r1)), greater = max(magnitude(r0), magnitude(r1));
    if (constant<T>(1.5L) * less < greater && T(0) < k && T(0) < rest) {
      joint = k;
      const T straight =
          k * (s0 + k * r0 / T(2)) + rest * (s1 - rest * r1 / T(2));  // the rise without c3
      const T c3 = (rise - straight) / (k * k * k + rest * rest * rest);
      from_left = {left.penetration - threshold, s0, r0 / T(2), c3};
      from_right = {right.penetration - threshold, s1, r1 / T(2), c3};
    } else {
      from_left = {left.penetration - threshold, s0, T(3) * rise - T(2) * s0 - s1,
                   s0 + s1 - T(2) * rise};
    }
  }

  // Near where it is zero, from the share t on.
  [[nodiscard]] T root(const T& t) const {
    const bool is_left = joint == T(1) || (from_left.value(joint) < T(0)) != (from_left.c0 < T(0));
    return is_left ? from_left.near_root(t) : T(T(1) + from_right.near_root(T(t - T(1))));
  }
  // Near where its slope is zero.
  [[nodiscard]] T extremum() const {
    const T side = from_left.c1 < T(0) ? T(-1) : T(1);
    const bool is_left = joint == T(1) || (from_left.slope(joint) < T(0)) != (from_left.c1 < T(0));
    return is_left ? from_left.extremum(side) : T(T(1) + from_right.extremum(side));
  }
};

// `share` of the way from left to right; where it leads out of the interval, `otherwise`.
template <Real T>
[[nodiscard]] T between(const LocusStrip<T>& left, const LocusStrip<T>& right, const T& share,
                        const T& otherwise) {
  return left.wheel_lateral + (T(0) < share && share < T(1) ? share : otherwise) *
                                  (right.wheel_lateral - left.wheel_lateral);
}

// Where between two strips the penetration's extremum may be, if there is one [m].
template <Real T>
[[nodiscard]] T extremum_guess(const LocusStrip<T>& left, const LocusStrip<T>& right,
                               const T& threshold) {
  const T secant = left.slope / (left.slope - right.slope);
  return between(left, right, PenetrationCurve<T>(left, right, threshold).extremum(), secant);
}

// Where between two strips, one of which penetrates, the penetration may pass the threshold [m]. It
// is looked for from a parabola with its top at the strip inside, where that is the zone's deepest;
// otherwise from a chord.
template <Real T>
[[nodiscard]] T boundary_guess(const LocusStrip<T>& left, const LocusStrip<T>& right,
                               bool left_is_inside, const T& threshold) {
  using std::sqrt;
  const LocusStrip<T>& inside = left_is_inside ? left : right;
  const LocusStrip<T>& outside = left_is_inside ? right : left;
  const T depth = inside.penetration - threshold;
  const T chord = depth / (inside.penetration - outside.penetration);
  const bool at_top =
      magnitude(inside.slope) * magnitude(T(right.wheel_lateral - left.wheel_lateral)) <
      depth / T(4);
  const T from_inside = at_top ? T(sqrt(chord)) : chord;
  const T share = left_is_inside ? from_inside : T(T(1) - from_inside);
  return between(left, right, PenetrationCurve<T>(left, right, threshold).root(share), share);
}

}  // namespace wheelrail::detail
