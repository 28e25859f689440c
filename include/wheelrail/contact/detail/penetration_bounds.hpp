#pragma once
/// @file
/// What is known of the penetration between two strips of a wheel: enough to prove that a search
/// missed no patch. May include: core, numerics, profile, surface.
///
/// What is proved (ContactResult::is_proved), for a locally straight, convex rail and profiles with
/// derivative bounds (HasDerivativeBounds), but for rounding:
///
/// 1. A part above a tangent does not touch (find_contact.hpp). The rail lies under its tangent plane with the normal n
///    at P; the strip at u, a circle of radius R(u) = R0 + F(u) about the axle's point o + u a, is no
///    deeper than g(u) = -n.(o - P) - u n.a + R(u) sqrt(1 - (n.a)^2) under it, whatever the yaw, and
///    StripTree bounds F over an interval.
/// 2. The penetration p along the locus L(u) is the least depth under all tangents, each of which
///    changes with -n.L'': so p'' <= max(-n.L''), which bounds p and p' between two strips. Where p
///    stays below the threshold, or p' keeps its sign, nothing is hidden between them.
/// 3. Where the rail's curvature is at least k it lies, near each foot, inside a circle of radius 1/k:
///    p'' <= -n.L'' - (|L'|^2 - p'^2) k / (1 + k gap). Where that is negative p has one maximum at
///    most. Where |p'| < |L'| the foot moves one way, from the foot of one strip to the other's.
/// 4. With k the greatest curvature, p'' >= -n.L'' - |L'|^2 k / (1 - k p): where that is positive p
///    has one minimum at most.
/// 5. Strips of which none of this can be said are divided until it can, or until p varies by less
///    than the depth tolerance between them.
///
/// L' and L'' follow from (57) and (59) with t = tan(yaw): L'' = -F'' (0, cos s_w) and terms in t^2
/// times F', F'' and F'''; those with F''' lie along L' but for t^4.

#include <wheelrail/contact/search_memory.hpp>

namespace wheelrail::detail {

/// A strip with its penetration and d penetration / d wheel_lateral.
template <Real T>
struct LocusStrip {
  T wheel_lateral{};       ///< [m]
  T rail_lateral{};        ///< of the foot [m]
  T penetration{};         ///< [m]
  T slope{};               ///< [-]
  T slope_rate{};          ///< d slope / d wheel_lateral, without terms of yaw squared [1/m]
  RailTangent<T> tangent;  ///< of the rail, at the foot
  int piece = -1;          ///< of the wheel's profile
  bool exists = false;     ///< false where the strip has no locus point, or the rail no foot for it
};

enum class Verdict {
  excluded,  ///< the penetration stays below the threshold
  simple,    ///< it has one extremum at most
  open       ///< nothing is known
};

/// Of the penetration between two strips of one piece.
template <Real T>
struct Judgement {
  Verdict verdict = Verdict::open;
  T variation{};           ///< by which it varies at most [m]
  bool is_bounded = true;  ///< false where the yaw is too great for the bounds as they are
};

/// The bounds of one wheel at one yaw on one rail.
template <Profile R>
class PenetrationBounds {
 public:
  using T = typename R::Scalar;

  /// @param greatest_radius of the wheel [m]. @param threshold of a zone's penetration [m].
  PenetrationBounds(const Rail<R>& rail, const T& greatest_radius, const T& tan_yaw,
                    const T& threshold)
      : rail_(rail),
        radius_(greatest_radius),
        squared_tan_yaw_(tan_yaw * tan_yaw),
        threshold_(threshold) {}

  /// By 2, 3 and 4 of this file's head. @param shape holds between the strips.
  [[nodiscard]] Judgement<T> judge(const LocusStrip<T>& left, const LocusStrip<T>& right,
                                   const ShapeBounds<T>& shape) const {
    using std::sqrt;
    const Judgement<T> unknown{Verdict::open, radius_, left.exists || right.exists};
    if (!rail_.is_convex() || !left.exists || !right.exists) return unknown;
    const T width = right.wheel_lateral - left.wheel_lateral;
    const T& yaw = squared_tan_yaw_;
    const T slope = shape.steepest, slope_squared = square(slope);
    const T& radius = radius_;
    const T hollow = max(T(0), shape.greatest_second);
    const T sine_squared = yaw * slope_squared;
    if (!(sine_squared + yaw * (slope_squared + radius * hollow) < constant<T>(0.5L))) {
      return {Verdict::open, radius_, false};
    }
    const T cosine = sqrt(T(T(1) - sine_squared));
    const T twist = yaw * radius * shape.third / cosine;
    if (!(twist * width < constant<T>(0.5L))) return unknown;
    const T by_yaw = yaw * (slope * shape.second * (T(3) + T(2) * slope / cosine) +
                            twist * (slope_squared * (T(2) + slope) +
                                     radius * shape.second * (T(1) + slope / cosine)));
    const T steepest =
        (max(magnitude(left.slope), magnitude(right.slope)) + (hollow + by_yaw) * width) /
        (T(1) - twist * width);
    const T bend = hollow + by_yaw + twist * steepest;
    const T variation = steepest * width;
    if (!may_penetrate(left, right, bend)) return {Verdict::excluded, variation};
    if (bend * width < right.slope || bend * width < -left.slope) {
      return {Verdict::simple, variation};
    }
    const T speed_squared = T(1) + square(shape.flattest) -
                            yaw * (T(1) + T(2) * (slope_squared + radius * hollow) +
                                   square(slope_squared) + T(2) * radius * slope_squared * hollow);
    const T sliding_squared = speed_squared - square(steepest);
    if (!(T(0) < sliding_squared)) return {Verdict::open, variation};
    // So the foot moves one way, from the left strip's to the right one's, and so does the normal.
    const Vector2<T>& one = left.tangent.normal_rail;
    const Vector2<T>& other = right.tangent.normal_rail;
    const bool passes_top = (one.x() < T(0)) != (other.x() < T(0));
    const T least_up = min(one.y(), other.y());
    const T greatest_up = passes_top ? T(1) : max(one.y(), other.y());
    const T wheel_bend =
        bend - hollow +
        shape.greatest_second * (shape.greatest_second < T(0) ? T(least_up * cosine) : greatest_up);
    const T curvature = rail_.least_curvature(left.rail_lateral, right.rail_lateral);
    const T gap = max(T(0), T(variation - min(left.penetration, right.penetration)));
    const T greatest_bend =
        max(T(0), T(wheel_bend - sliding_squared * curvature / (T(1) + curvature * gap)));
    if (greatest_bend * width < right.slope || greatest_bend * width < -left.slope ||
        greatest_bend == T(0)) {
      return {Verdict::simple, variation};
    }
    if (!may_penetrate(left, right, greatest_bend)) return {Verdict::excluded, variation};
    // Convex, where the wheel is more hollow than the rail is curved?
    const T stretch = T(1) + yaw * radius * shape.second / square(cosine);
    const T greatest_speed = (T(1) + slope_squared) * square(stretch);
    const T deepest = max(T(0), T(max(left.penetration, right.penetration) + variation));
    const T greatest_curvature = rail_.greatest_curvature(left.rail_lateral, right.rail_lateral);
    const T wheel_bend_least =
        least_up * cosine * shape.least_second - by_yaw - twist * steepest -
        T(2) * yaw * radius * square(shape.second) / (square(cosine) * cosine);
    const bool is_convex = greatest_curvature * deepest < T(1) &&
                           greatest_speed * greatest_curvature <
                               wheel_bend_least * (T(1) - greatest_curvature * deepest);
    return {is_convex ? Verdict::simple : Verdict::open, variation};
  }

 private:
  // Whether the penetration can pass the threshold, its second derivative being at most `bend`.
  [[nodiscard]] bool may_penetrate(const LocusStrip<T>& left, const LocusStrip<T>& right,
                                   const T& bend) const {
    const T width = right.wheel_lateral - left.wheel_lateral;
    const T bulge = bend * width * width / T(2);
    const T from_left = left.penetration + max(T(0), left.slope) * width + bulge;
    const T from_right = right.penetration + max(T(0), T(-right.slope)) * width + bulge;
    return threshold_ < min(from_left, from_right);
  }

  const Rail<R>& rail_;
  T radius_;
  T squared_tan_yaw_;
  T threshold_;
};

/// The cubic with the penetrations and slopes of two strips, over the share t of the way from the
/// left to the right one: where a root or an extremum is looked for first.
template <Real T>
struct PenetrationCubic {
  T c0, c1, c2, c3;

  PenetrationCubic(const LocusStrip<T>& left, const LocusStrip<T>& right, const T& threshold) {
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

}  // namespace wheelrail::detail
