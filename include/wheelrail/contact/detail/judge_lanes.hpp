#pragma once
// PenetrationBounds::judge in lanes: what is known of several parts at once.
// May include: core, numerics, profile, surface, contact/placement.

#include <wheelrail/contact/detail/locus_strip_lanes.hpp>
#include <wheelrail/contact/detail/penetration_bounds.hpp>

namespace wheelrail::detail {

// ShapeBounds of each lane.
template <Real T>
struct ShapeBoundsLanes {
  Lanes<T> least_second, greatest_second, steepest, flattest, second, third;

  void set(int lane, const ShapeBounds<T>& shape) {
    least_second[lane] = shape.least_second;
    greatest_second[lane] = shape.greatest_second;
    steepest[lane] = shape.steepest;
    flattest[lane] = shape.flattest;
    second[lane] = shape.second;
    third[lane] = shape.third;
  }
};

// Flags of what PenetrationBounds::judge says of the part in each lane; neither: Verdict::open.
template <Real T>
struct VerdictLanes {
  Lanes<T> is_excluded = Lanes<T>::Zero(), is_simple = Lanes<T>::Zero();

  [[nodiscard]] Verdict verdict(int lane) const {
    if (T(0) < is_excluded[lane]) return Verdict::excluded;
    return T(0) < is_simple[lane] ? Verdict::simple : Verdict::open;
  }
};

// The bounds of one wheel on one rail, of wheels that stand still, in the order of operations of
// PenetrationBounds, where all of it is explained.
template <Profile R>
class PenetrationBoundsLanes {
 public:
  using T = typename R::Scalar;
  using L = Lanes<T>;
  using Ends = LocusStripLanes<T>;

  // As those of PenetrationBounds.
  PenetrationBoundsLanes(const Rail<R>& rail, const T& greatest_radius, const T& threshold)
      : rail_(rail), radius_(greatest_radius), threshold_(all_lanes(threshold)) {}

  [[nodiscard]] VerdictLanes<T> judge(const PlacementLanes<T>& at, const Ends& left,
                                      const Ends& right, const ShapeBoundsLanes<T>& shape) const {
    VerdictLanes<T> verdicts;
    if (!rail_.is_convex()) return verdicts;
    const L zero = L::Zero();
    const auto up = [&](const Ends& end) -> L {
      return end.normal_up * at.cos_roll - end.normal_lateral * at.sin_roll;
    };
    const auto aside = [&](const Ends& end) -> L {
      return end.normal_lateral * at.cos_roll + end.normal_up * at.sin_roll;
    };
    const L left_up = up(left), right_up = up(right);
    const L least_up = left_up.min(right_up);
    const L width = right.wheel_lateral - left.wheel_lateral;
    const L yaw = at.tan_yaw * at.tan_yaw;
    const L &slope = shape.steepest, slope_squared = slope * slope;
    const L hollow = zero.max(shape.greatest_second).max(-least_up * shape.second);
    const L sine_squared = yaw * slope_squared;
    const L half = all_lanes(T(T(1) / T(2)));
    L is_bounded = left.exists * right.exists *
                   less<T>(sine_squared + yaw * (slope_squared + radius_ * hollow), half);
    const L cosine = T(1) - sine_squared, secant = T(1) + sine_squared;
    const L steep = slope * secant;
    const L twist = yaw * radius_ * shape.third * secant;
    const L turned = twist * width;
    is_bounded = is_bounded * less<T>(turned, half);
    const L by_yaw =
        yaw * (slope * shape.second * (T(3) + T(2) * steep) +
               twist * (slope_squared * (T(2) + slope) + radius_ * shape.second * (T(1) + steep)));
    const L steepest = (left.slope.abs().max(right.slope.abs()) + (hollow + by_yaw) * width) *
                       (T(1) + turned * (T(1) + T(2) * turned));
    const L bend = hollow + by_yaw + twist * steepest;
    const L variation = steepest * width;
    verdicts.is_excluded = is_bounded * (T(1) - may_penetrate(left, right, width, bend));
    verdicts.is_simple = is_bounded * rises_or_falls(left, right, width, bend);
    const auto is_open = [&]() -> L {
      return is_bounded * (T(1) - verdicts.is_excluded.max(verdicts.is_simple));
    };
    L goes_on = is_open();
    if (!any<T>(goes_on)) return verdicts;
    const L speed_squared =
        T(1) + shape.flattest * shape.flattest -
        yaw * (T(1) + T(2) * (slope_squared + radius_ * hollow) + slope_squared * slope_squared +
               T(2) * radius_ * slope_squared * hollow);
    const L sliding_squared = speed_squared - steepest * steepest;
    goes_on = goes_on * less<T>(zero, sliding_squared);
    if (!any<T>(goes_on)) return verdicts;
    const L left_aside = aside(left), right_aside = aside(right);
    const L may_be_upright = (T(1) - less<T>(zero, left_aside.min(right_aside))) *
                             (T(1) - less<T>(left_aside.max(right_aside), zero));
    const L greatest_up = choose<T>(may_be_upright, all_lanes(T(1)), left_up.max(right_up));
    const L at_least = (shape.least_second * least_up).min(shape.least_second * greatest_up);
    const L at_most = (shape.greatest_second * least_up).max(shape.greatest_second * greatest_up);
    const L least_product = at_least.min(shape.greatest_second * least_up);
    const L greatest_product = at_most.max(shape.least_second * least_up);
    const L wheel_bend =
        bend - hollow +
        choose<T>(less<T>(greatest_product, zero), greatest_product * cosine, greatest_product);
    L curvature = zero, greatest_curvature = zero;
    for (int lane = 0; lane < lane_count; ++lane) {
      if (!(T(0) < goes_on[lane])) continue;
      const CurvatureBounds<T> bounds =
          rail_.curvatures(left.rail_lateral[lane], right.rail_lateral[lane]);
      curvature[lane] = bounds.least;
      greatest_curvature[lane] = bounds.greatest;
    }
    const L gap = zero.max(variation - left.penetration.min(right.penetration));
    const L greatest_bend =
        zero.max(wheel_bend - sliding_squared * curvature / (T(1) + curvature * gap));
    verdicts.is_simple = verdicts.is_simple.max(
        goes_on *
        rises_or_falls(left, right, width, greatest_bend).max(equal<T>(greatest_bend, zero)));
    goes_on = goes_on * is_open();
    if (!any<T>(goes_on)) return verdicts;
    verdicts.is_excluded = verdicts.is_excluded.max(
        goes_on * (T(1) - may_penetrate(left, right, width, greatest_bend)));
    goes_on = goes_on * is_open();
    if (!any<T>(goes_on)) return verdicts;
    const L stretch = T(1) + yaw * radius_ * shape.second * (secant * secant);
    const L greatest_speed = (T(1) + slope_squared) * (stretch * stretch);
    const L deepest = zero.max(left.penetration.max(right.penetration) + variation);
    const L wheel_bend_least =
        choose<T>(less<T>(least_product, zero), least_product, least_product * cosine) - by_yaw -
        twist * steepest -
        T(2) * yaw * radius_ * (shape.second * shape.second) * ((secant * secant) * secant);
    const L under_centre = T(1) - greatest_curvature * deepest;
    goes_on = goes_on * less<T>(zero, under_centre);
    const L least_bend = wheel_bend_least - greatest_speed * greatest_curvature / under_centre;
    verdicts.is_simple = verdicts.is_simple.max(
        goes_on *
        less<T>(zero, least_bend).max(keeps_sign(left, right, width, least_bend, greatest_bend)));
    return verdicts;
  }

 private:
  // Whether the slope keeps the sign that it has at an end.
  [[nodiscard]] static L rises_or_falls(const Ends& left, const Ends& right, const L& width,
                                        const L& bend) {
    return less<T>(bend * width, right.slope).max(less<T>(bend * width, -left.slope));
  }

  [[nodiscard]] static L keeps_sign(const Ends& left, const Ends& right, const L& width,
                                    const L& least_bend, const L& greatest_bend) {
    const L zero = L::Zero(), range = greatest_bend - least_bend;
    const L rises = less<T>(zero, left.slope) * less<T>(zero, right.slope) *
                    less<T>(zero, left.slope * range + least_bend * (left.slope - right.slope +
                                                                     greatest_bend * width));
    const L falls = less<T>(left.slope, zero) * less<T>(right.slope, zero) *
                    less<T>(left.slope * range +
                                greatest_bend * (right.slope - left.slope - least_bend * width),
                            zero);
    return rises.max(falls);
  }

  [[nodiscard]] L may_penetrate(const Ends& left, const Ends& right, const L& width,
                                const L& bend) const {
    const L zero = L::Zero(), bulge = bend * width * width / T(2);
    const L from_left = left.penetration + zero.max(left.slope) * width + bulge;
    const L from_right = right.penetration + zero.max(-right.slope) * width + bulge;
    return less<T>(threshold_, from_left.min(from_right));
  }

  const Rail<R>& rail_;
  T radius_;
  L threshold_;
};

}  // namespace wheelrail::detail
