#pragma once
/// @file
/// What is known of the penetration between two strips of a wheel: enough to prove that a search
/// missed no patch. May include: core, numerics, profile, surface.
///
/// What is proved (ContactResult::is_proved), for a locally straight, convex rail and profiles with
/// derivative bounds (HasDerivativeBounds), but for rounding:
///
/// 1. A part above a tangent does not touch (near_runs.hpp). The rail lies under its tangent plane
///    with the normal n at P; the strip at u, a circle of radius R(u) = R0 + F(u) about the axle's point
///    o + u a, is no deeper than g(u) = -n.(o - P) - u n.a + R(u) sqrt(1 - (n.a)^2) under it, whatever
///    the yaw, and StripTree bounds F over an interval.
/// 2. The penetration p along the locus L(u) is the least depth under all tangents, each of which
///    changes with -n.L'': so p'' <= max(-n.L''), which bounds p and p' between two strips. Where p
///    stays below the threshold, or p' keeps its sign, nothing is hidden between them.
/// 3. Where the rail's curvature is at least k it lies, near each foot, inside a circle of radius 1/k:
///    p'' <= -n.L'' - (|L'|^2 - p'^2) k / (1 + k gap). Where that is negative p has one maximum at
///    most. Where |p'| < |L'| the foot moves one way, from the foot of one strip to the other's.
/// 4. With k the greatest curvature, p'' >= -n.L'' - |L'|^2 k / (1 - k p): where that is positive p
///    has one minimum at most. Where it is negative, but p' has one sign at both strips and cannot
///    change twice in between by these bounds of p'' from both sides, p has no extremum at all.
/// 5. Strips of which none of this can be said are divided until it can, or until p varies by less
///    than the depth tolerance between them.
///
/// L' and L'' follow from (57) and (59) with t = tan(yaw): L'' = -F'' (0, cos s_w) and terms in t^2
/// times F', F'' and F'''; those with F''' lie along L' but for t^4.

#include <wheelrail/contact/detail/locus_strip.hpp>

namespace wheelrail::detail {

enum class Verdict {
  excluded,  ///< the penetration stays below the threshold
  simple,    ///< it has one extremum at most
  open       ///< nothing is known
};

/// Of the penetration between two strips of one piece.
template <Real T>
struct Judgement {
  Verdict verdict = Verdict::open;
  T variation = T(0);      ///< by which it varies at most [m]
  bool is_bounded = true;  ///< false where the yaw is too great for the bounds as they are
};

/// How far a wheel may move from where it is, seen along the rail: |o' - o| + reach |a' - a| <=
/// distance, o its profile's origin, a the axle's direction; reach >= |u| + R for all its strips.
template <Real T>
struct WheelMotion {
  T distance = T(0);  ///< [m]
  T reach = T(0);     ///< [m]

  /// By how much yaw and roll may each change [rad]. @pre 100 distance <= reach, here and below
  [[nodiscard]] T greatest_turn(const T& tan_yaw) const {
    return constant<T>(1.01L) * (T(1) + tan_yaw * tan_yaw) * distance / reach;
  }
  /// Not less than |tan yaw| after the motion.
  [[nodiscard]] T greatest_tan_yaw(const T& tan_yaw) const {
    return magnitude(tan_yaw) + constant<T>(1.1L) * (T(1) + tan_yaw * tan_yaw) * distance / reach;
  }
};

/// The bounds of one wheel at one yaw on one rail.
template <Profile R>
class PenetrationBounds {
 public:
  using T = typename R::Scalar;

  /// @param greatest_radius of the wheel [m]. @param threshold of a zone's penetration [m].
  /// @param motion that the bounds allow for besides the placement's own yaw and roll.
  PenetrationBounds(const Rail<R>& rail, const T& greatest_radius,
                    const WheelPlacement<T>& placement, const T& threshold,
                    const WheelMotion<T>& motion = {T(0), T(1)})
      : rail_(rail),
        radius_(greatest_radius),
        cos_roll_(placement.cos_roll),
        sin_roll_(placement.sin_roll),
        squared_tan_yaw_(square(motion.greatest_tan_yaw(placement.tan_yaw))),
        turn_(motion.greatest_turn(placement.tan_yaw)),
        threshold_(threshold) {}

  /// What a strip keeps within during a motion, by the derivatives of (57) and (59) by yaw and roll.
  /// These bounds are of the greatest yaw in it. @param shape holds at the strip.
  [[nodiscard]] MovingStrip<T> moving(const LocusStrip<T>& strip, const ShapeBounds<T>& shape,
                                      const WheelMotion<T>& motion) const {
    using std::sqrt;
    MovingStrip<T> result;
    result.wheel_lateral = strip.wheel_lateral;
    const T yaw = sqrt(squared_tan_yaw_), widened = T(1) + squared_tan_yaw_;
    const T slope = shape.steepest, sine = yaw * slope;
    if (!strip.exists || !(sine * sine < constant<T>(0.5L))) return result;
    const T cosine = sqrt(T(T(1) - sine * sine));
    // Yaw and roll each change by at most this much; the locus and its rate by rolling and yawing:
    const T& turn = turn_;
    const T by_turn = motion.reach * (T(1) + yaw) + radius_ * sine * yaw +
                      radius_ * sine * (T(1) + widened + slope * widened / cosine);
    const T travel = max(motion.distance, T(turn * by_turn));
    const T bend = radius_ * shape.second;
    const T speed =
        sqrt(T(T(1) + slope * slope)) * (T(1) + squared_tan_yaw_ * bend / square(cosine));
    const T rate_change =
        turn *
        (speed + yaw + (slope * slope + bend) * (T(1) + widened) * yaw +
         widened * sine * (slope * slope + T(2) * bend + square(T(sine / cosine)) * bend) / cosine);
    // The foot of a point outside a convex body moves no farther than the point; of one inside by p,
    // where the curvature is at most k and k p < 1/2, at most 1 / (1 - k p) < 2 times as far.
    const T deepest = max(T(0), T(strip.penetration + travel));
    result.foot = strip.rail_lateral;
    result.foot_change = T(2) * travel;
    const R& rail = rail_.profile();
    if (!(rail.lower() < result.least_foot()) || !(result.greatest_foot() < rail.upper())) {
      return result;
    }
    const T curvature = rail_.greatest_curvature(result.least_foot(), result.greatest_foot());
    const T curved = deepest * curvature;
    if (!(curved < constant<T>(0.5L))) return result;
    result.foot_change = travel / (T(1) - curved);
    // The foot moves so far along the surface; where that has a corner, its curvature is unbounded.
    result.normal_rail = strip.normal_rail;
    result.normal_change = result.foot_change * curvature;
    result.penetration = strip.penetration;
    result.penetration_change = travel;
    result.slope = strip.slope;
    result.slope_change = speed * result.normal_change + rate_change;
    result.exists = is_finite(result.slope_change);
    return result;
  }

  /// By 2, 3 and 4 of this file's head. @param left, right LocusStrip, or MovingStrip where the
  /// verdict has to hold while the wheel moves. @param shape holds between the strips.
  template <class End>
  [[nodiscard]] Judgement<T> judge(const End& left, const End& right,
                                   const ShapeBounds<T>& shape) const {
    const Judgement<T> unknown{Verdict::open, radius_, left.exists || right.exists};
    if (!rail_.is_convex() || !left.exists || !right.exists) return unknown;
    // Along the axes that the wheel's roll turns.
    const auto up = [&](const Vector2<T>& n) { return n.y() * cos_roll_ - n.x() * sin_roll_; };
    const auto aside = [&](const Vector2<T>& n) { return n.x() * cos_roll_ + n.y() * sin_roll_; };
    const T left_up = up(left.normal_rail), right_up = up(right.normal_rail);
    T turn = turn_;
    if constexpr (End::moves) turn = turn + max(left.normal_change, right.normal_change);
    const T least_up = min(left_up, right_up) - turn;
    const T width = right.wheel_lateral - left.wheel_lateral;
    const T& yaw = squared_tan_yaw_;
    const T slope = shape.steepest, slope_squared = square(slope);
    const T& radius = radius_;
    // Not less than -n.L'' without yaw, beside an upright flank too.
    const T hollow = max(max(T(0), shape.greatest_second), T(-least_up * shape.second));
    const T sine_squared = yaw * slope_squared;
    if (!(sine_squared + yaw * (slope_squared + radius * hollow) < constant<T>(0.5L))) {
      return {Verdict::open, radius_, false};
    }
    // cos s_w is not less, its inverse not greater: no root and no division is waited for here.
    const T cosine = T(1) - sine_squared, secant = T(1) + sine_squared;
    const T steep = slope * secant;
    const T twist = yaw * radius * shape.third * secant;
    const T turned = twist * width;
    if (!(turned < constant<T>(0.5L))) return unknown;
    const T by_yaw =
        yaw * (slope * shape.second * (T(3) + T(2) * steep) +
               twist * (slope_squared * (T(2) + slope) + radius * shape.second * (T(1) + steep)));
    // 1 / (1 - turned) is not greater than the last factor.
    const T steepest =
        (max(greatest_slope_of(left), greatest_slope_of(right)) + (hollow + by_yaw) * width) *
        (T(1) + turned * (T(1) + T(2) * turned));
    const T bend = hollow + by_yaw + twist * steepest;
    const T variation = steepest * width;
    if (!may_penetrate(left, right, bend)) return {Verdict::excluded, variation};
    if (bend * width < right.least_slope() || bend * width < -left.greatest_slope()) {
      return {Verdict::simple, variation};
    }
    const T speed_squared = T(1) + square(shape.flattest) -
                            yaw * (T(1) + T(2) * (slope_squared + radius * hollow) +
                                   square(slope_squared) + T(2) * radius * slope_squared * hollow);
    const T sliding_squared = speed_squared - square(steepest);
    if (!(T(0) < sliding_squared)) return {Verdict::open, variation};
    // So the foot moves one way, from the left strip's to the right one's, and so does the normal.
    const T first_foot = min(left.least_foot(), right.least_foot());
    const T last_foot = max(left.greatest_foot(), right.greatest_foot());
    const T left_aside = aside(left.normal_rail), right_aside = aside(right.normal_rail);
    T greatest_up = max(left_up, right_up) + turn;
    const T least_lateral = min(left_aside, right_aside) - turn;
    const T greatest_lateral = max(left_aside, right_aside) + turn;
    const bool may_be_upright = !(T(0) < least_lateral) && !(greatest_lateral < T(0));
    if (may_be_upright) greatest_up = T(1);
    // F'' n_up cos s_w is within these.
    const T at_least = min(shape.least_second * least_up, shape.least_second * greatest_up);
    const T at_most = max(shape.greatest_second * least_up, shape.greatest_second * greatest_up);
    const T least_product = min(at_least, T(shape.greatest_second * least_up));
    const T greatest_product = max(at_most, T(shape.least_second * least_up));
    const T wheel_bend =
        bend - hollow + (greatest_product < T(0) ? T(greatest_product * cosine) : greatest_product);
    const auto [curvature, greatest_curvature] = rail_.curvatures(first_foot, last_foot);
    const T gap =
        max(T(0), T(variation - min(left.least_penetration(), right.least_penetration())));
    const T greatest_bend =
        max(T(0), T(wheel_bend - sliding_squared * curvature / (T(1) + curvature * gap)));
    if (greatest_bend * width < right.least_slope() ||
        greatest_bend * width < -left.greatest_slope() || greatest_bend == T(0)) {
      return {Verdict::simple, variation};
    }
    if (!may_penetrate(left, right, greatest_bend)) return {Verdict::excluded, variation};
    // Convex, where the wheel is more hollow than the rail is curved?
    const T stretch = T(1) + yaw * radius * shape.second * square(secant);
    const T greatest_speed = (T(1) + slope_squared) * square(stretch);
    const T deepest =
        max(T(0), T(max(left.greatest_penetration(), right.greatest_penetration()) + variation));
    const T wheel_bend_least =
        (least_product < T(0) ? least_product : T(least_product * cosine)) - by_yaw -
        twist * steepest - T(2) * yaw * radius * square(shape.second) * (square(secant) * secant);
    const T under_centre = T(1) - greatest_curvature * deepest;
    if (!(T(0) < under_centre)) return {Verdict::open, variation};
    const T least_bend = wheel_bend_least - greatest_speed * greatest_curvature / under_centre;
    if (T(0) < least_bend || keeps_sign(left, right, least_bend, greatest_bend)) {
      return {Verdict::simple, variation};
    }
    return {Verdict::open, variation};
  }

 private:
  template <class End>
  [[nodiscard]] static T greatest_slope_of(const End& end) {
    return max(magnitude(end.least_slope()), magnitude(end.greatest_slope()));
  }

  // Whether the penetration's slope has one sign, as its second derivative has both within bounds.
  // @pre least_bend <= 0 < greatest_bend
  template <class End>
  [[nodiscard]] static bool keeps_sign(const End& left, const End& right, const T& least_bend,
                                       const T& greatest_bend) {
    // Where the bounds of the slope from the left and from the right meet it is nearest to zero.
    const T width = right.wheel_lateral - left.wheel_lateral;
    const T range = greatest_bend - least_bend;
    const T from_left = left.least_slope(), from_right = right.least_slope();
    if (T(0) < from_left && T(0) < from_right) {
      return T(0) <
             from_left * range + least_bend * (from_left - from_right + greatest_bend * width);
    }
    const T to_left = left.greatest_slope(), to_right = right.greatest_slope();
    return to_left < T(0) && to_right < T(0) &&
           to_left * range + greatest_bend * (to_right - to_left - least_bend * width) < T(0);
  }

  // Whether the penetration can pass the threshold, its second derivative being at most `bend`.
  template <class End>
  [[nodiscard]] bool may_penetrate(const End& left, const End& right, const T& bend) const {
    const T width = right.wheel_lateral - left.wheel_lateral;
    const T bulge = bend * width * width / T(2);
    const T from_left =
        left.greatest_penetration() + max(T(0), left.greatest_slope()) * width + bulge;
    const T from_right =
        right.greatest_penetration() + max(T(0), T(-right.least_slope())) * width + bulge;
    return threshold_ < min(from_left, from_right);
  }

  const Rail<R>& rail_;
  T radius_;
  T cos_roll_, sin_roll_;
  T squared_tan_yaw_;
  T turn_;  // by which yaw and roll each may change [rad]
  T threshold_;
};

}  // namespace wheelrail::detail
