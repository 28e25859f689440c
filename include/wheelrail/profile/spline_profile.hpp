#pragma once
/// @file
/// A profile from measured points: both coordinates smoothed over the arc length, because a flange's
/// face is steep, then turned into value(lateral) with a continuous second derivative. May include:
/// core, numerics, profile.
///
/// The smoothing penalises the third derivative (numerics/smoothing_spline.hpp). Profiles are arcs
/// next to arcs: it leaves an arc as it is, where Reinsch's penalty on the second derivative pulls
/// the curvature towards 0, at the ends to 0. With 10 um of noise on S1002 that bends the ends by
/// 30 to 60 um; and it left none of 20 rails with that noise convex, this one all of 480.
///
/// The searches ask for value, slope and second derivative at a lateral coordinate many times. The
/// curve (u(s), v(s)) would have to be solved for s each time; so it is turned once into
/// polynomials of degree 5 in u that take its value, slope and second derivative at both ends, over
/// intervals as long as they follow it within a small part of the noise. They are fewer than the
/// points; two of them make one piece of the Profile.

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>
#include <wheelrail/numerics/lifted_root.hpp>
#include <wheelrail/numerics/smoothing_spline.hpp>
#include <wheelrail/profile/noise_estimate.hpp>
#include <wheelrail/profile/piecewise_profile.hpp>

namespace wheelrail {

/// How a profile is made from points.
template <Real T>
struct SplineFitOptions {
  /// The level of the measurement noise across the profile, one standard deviation [m], >= 0. A
  /// level above the true one bends the shape where its curvature changes fast, one below it leaves
  /// waves. 0 interpolates with a cubic spline, not-a-knot.
  T noise = constant<T>(1e-5L);
  /// The fit is the smoothest curve from which the n points deviate (root mean square) by noise (1
  /// + margin / sqrt(2 n)) [-], >= 0. The noise of n points has a root mean square with the
  /// standard deviation noise / sqrt(2 n): where it is above what the curve may deviate by, the
  /// difference is made up by waves. Then a rail may be concave in places, and no search on it is
  /// proved: with 0 one of twelve such rails is, with 2 none of 480 was.
  T margin = T(2);
  /// The profile follows the smoothed curve within curve_tolerance [m], >= 0. 0: a thousandth of
  /// the noise, and not less than rounding, 64 epsilon times the greatest coordinate, nor than
  /// 1e-10 m.
  T curve_tolerance = T(0);
};

/// What came of the points.
template <Real T>
struct SplineFitReport {
  T noise = T(0);                ///< the level that was asked for, without its margin [m]
  T smoothing_parameter = T(0);  ///< lambda of the smoothing spline [m^5]; 0: interpolated
  /// How far the points lie from the curve, across it [m].
  T rms_deviation = T(0);
  T greatest_deviation = T(0);       ///< the greatest of them [m]
  int greatest_deviation_index = 0;  ///< of that point, from 0
  T curve_deviation = T(0);          ///< of the profile from the smoothed curve, as sampled [m]
  T greatest_curvature = T(0);  ///< of the greatest size [1/m], positive where the body is convex
  T greatest_curvature_lateral = T(0);  ///< where that is [m]
  T least_radius = T(0);                ///< 1 / |greatest_curvature| [m]
  T steepest_slope = T(0);              ///< the greatest |d value / d lateral| [-]
  int polynomial_count = 0;             ///< that the profile is made of
  SmoothingStatus status = SmoothingStatus::interpolating;  ///< how lambda came about

  /// The same in another scalar.
  template <Real U>
  [[nodiscard]] SplineFitReport<U> cast() const {
    return {scalar_cast<U>(noise),
            scalar_cast<U>(smoothing_parameter),
            scalar_cast<U>(rms_deviation),
            scalar_cast<U>(greatest_deviation),
            greatest_deviation_index,
            scalar_cast<U>(curve_deviation),
            scalar_cast<U>(greatest_curvature),
            scalar_cast<U>(greatest_curvature_lateral),
            scalar_cast<U>(least_radius),
            scalar_cast<U>(steepest_slope),
            polynomial_count,
            status};
  }
};

/// A C2 profile through or near points. Valid for good once constructed. Its ends are those of the
/// fit. @note Queries do not allocate.
template <Real T>
class SplineProfile {
 public:
  using Scalar = T;  ///< the numbers of its coordinates
  /// Steeper than this, a profile is no function of the lateral coordinate any more [-].
  static constexpr int slope_limit = 100;

  /// @param laterals [m], values [m]: the points in the profile's own coordinates, from the flange
  ///   (or gauge) side to the field side. At least 4. The laterals grow; they may step back by what
  ///   the noise explains, 6 times its level.
  /// @throws std::invalid_argument naming the first point or option that breaks its rule, or where
  ///   the smoothed curve turns back, is steeper than slope_limit or cannot be followed within the
  ///   curve tolerance.
  SplineProfile(const std::vector<T>& laterals, const std::vector<T>& values,
                const SplineFitOptions<T>& options = {}) {
    check(laterals, values, options);
    const std::vector<T> arc = arc_lengths(laterals, values);
    std::vector<Point> points;
    points.reserve(arc.size());
    for (std::size_t i = 0; i < arc.size(); ++i) points.emplace_back(laterals[i], values[i]);
    report_.noise = options.noise;
    const Curve curve = fitted(arc, points, options.margin);
    check_slopes(curve);
    report_deviations(curve, points);
    T tolerance = options.curve_tolerance;
    if (tolerance == T(0)) {
      T size = T(0);
      for (const Point& point : points) {
        size = detail::max(size,
                           detail::max(detail::magnitude(point.x()), detail::magnitude(point.y())));
      }
      tolerance = detail::max(detail::max(T(options.noise / T(1000)), constant<T>(1e-10L)),
                              T(T(64) * epsilon<T>() * size));
    }
    convert(curve, tolerance);
    report_.polynomial_count = static_cast<int>(elements_.size());
    make_table();
    report_curvature();
  }

  /// The same profile in another scalar, not fitted again.
  template <Real U>
  [[nodiscard]] SplineProfile<U> cast() const {
    SplineProfile<U> profile;
    for (const Element& element : elements_) {
      profile.elements_.push_back(element.template cast<U>());
    }
    for (const End& end : ends_) {
      profile.ends_.push_back(
          {scalar_cast<U>(end.lateral), scalar_cast<U>(end.value), scalar_cast<U>(end.slope)});
    }
    profile.table_ = table_;
    profile.inverse_cell_ = scalar_cast<U>(inverse_cell_);
    profile.report_ = report_.template cast<U>();
    return profile;
  }

  [[nodiscard]] const SplineFitReport<T>& report() const { return report_; }  ///< of the fit

  [[nodiscard]] T lower() const { return ends_.front().lateral; }  ///< where it begins [m]
  [[nodiscard]] T upper() const { return ends_.back().lateral; }   ///< where it ends [m]
  /// Pieces, as the concept Profile has them.
  [[nodiscard]] int piece_count() const {
    return static_cast<int>((elements_.size() + per_piece - 1) / per_piece);
  }
  [[nodiscard]] T joint(int i) const { return ends_[first_of(i)].lateral; }  ///< [m]

  /// @pre lower() <= lateral <= upper()
  [[nodiscard]] ProfilePoint<T> evaluate(const T& lateral) const {
    return elements_[element_of(lateral)].evaluate(lateral);
  }
  /// @pre 0 <= piece < piece_count(), lateral in that piece
  [[nodiscard]] ProfilePoint<T> evaluate(int piece, const T& lateral) const {
    return elements_[element_in(piece, lateral)].evaluate(lateral);
  }
  /// @pre 0 <= piece < piece_count(), lower <= upper in that piece
  [[nodiscard]] DerivativeBounds<T> derivative_bounds(int piece, const T& lower,
                                                      const T& upper) const {
    DerivativeBounds<T> bounds;
    for_elements(
        piece, lower, upper, [&](const auto& element, const T& from, const T& to, bool first) {
          const DerivativeBounds<T> own = element.derivative_bounds(from, to);
          if (first) bounds = own;
          bounds.least_second = detail::min(bounds.least_second, own.least_second);
          bounds.greatest_second = detail::max(bounds.greatest_second, own.greatest_second);
          bounds.greatest_third = detail::max(bounds.greatest_third, own.greatest_third);
        });
    return bounds;
  }
  /// @pre as for derivative_bounds
  [[nodiscard]] CurvatureBounds<T> curvature_bounds(int piece, const T& lower,
                                                    const T& upper) const {
    CurvatureBounds<T> bounds;
    for_elements(piece, lower, upper,
                 [&](const auto& element, const T& from, const T& to, bool first) {
                   const CurvatureBounds<T> own = element.curvature_bounds(from, to);
                   if (first) bounds = own;
                   bounds.least = detail::min(bounds.least, own.least);
                   bounds.greatest = detail::max(bounds.greatest, own.greatest);
                 });
    return bounds;
  }

  /// The foot of the perpendicular from a point of the plane, HasClosestPoint: Newton's method in the
  /// one polynomial between whose end normals the point lies, to rounding.
  /// @param lateral, up the point in the profile's plane [m].
  /// @return `penetration` is NaN where that did not converge, after 60 iterations at most.
  /// @pre The profile is convex, or the point is nearer to it than its smallest radius of curvature;
  ///   otherwise one of several feet is found.
  [[nodiscard]] ClosestPoint<T> closest_point(const T& lateral, const T& up) const {
    using std::sqrt;
    // How far, along the tangent, a place of the profile lies ahead of the point.
    const auto ahead = [&](const T& u, const T& value, const T& slope) {
      return T(u - lateral + (value - up) * slope);
    };
    std::size_t first = 0, last = ends_.size() - 1;
    T at_first = ahead(ends_[first].lateral, ends_[first].value, ends_[first].slope);
    T at_last = ahead(ends_[last].lateral, ends_[last].value, ends_[last].slope);
    if (T(0) < at_first) return foot_on_tangent(ends_[first], lateral, up);
    if (at_last < T(0)) return foot_on_tangent(ends_[last], lateral, up);
    while (first + 1 < last) {
      const std::size_t middle = first + (last - first) / 2;
      const T at = ahead(ends_[middle].lateral, ends_[middle].value, ends_[middle].slope);
      (T(0) < at ? last : first) = middle;
      (T(0) < at ? at_last : at_first) = at;
    }
    const Element& element = elements_[first];
    const T width = element.upper() - element.lower();
    const T tolerance = T(8) * epsilon<T>() * (upper() - lower());
    const auto equation = [&](const T& u) {
      const ProfilePoint<T> point = element.evaluate(u);
      return ValueAndSlope<T>{
          ahead(u, point.value, point.slope),
          T(1) + point.slope * point.slope + (point.value - up) * point.second_derivative};
    };
    const auto root = bracketed_newton<T>(
        equation, element.lower(), element.upper(), at_first, at_last,
        T(element.lower() + width * (at_first / (at_first - at_last))),
        {.step_tolerance = tolerance, .residual_tolerance = tolerance, .maximum_iterations = 60});
    const T foot_lateral = lifted_root<T>(value_of(root.position), equation);
    const ProfilePoint<T> point = element.evaluate(foot_lateral);
    const T cosine = T(1) / T(sqrt(T(T(1) + point.slope * point.slope)));
    const Vector2<T> normal_rail(T(-point.slope * cosine), cosine);
    ClosestPoint<T> foot{
        foot_lateral,
        (foot_lateral - lateral) * normal_rail.x() + (point.value - up) * normal_rail.y(),
        normal_rail, curvature(point)};
    if (root.status != SolveStatus::converged) foot.penetration = T(0) / T(0);
    return foot;
  }

 private:
  template <Real U>
  friend class SplineProfile;
  SplineProfile() = default;  // of cast

  // Where one polynomial ends and the next begins.
  struct End {
    T lateral = T(0), value = T(0), slope = T(0);
  };

  // The foot on the straight line that goes on beyond an end of the profile.
  [[nodiscard]] static ClosestPoint<T> foot_on_tangent(const End& end, const T& lateral,
                                                       const T& up) {
    using std::sqrt;
    const T cosine = T(1) / T(sqrt(T(T(1) + end.slope * end.slope)));
    const T sine = end.slope * cosine;
    const T dy = lateral - end.lateral, dz = up - end.value;
    return {end.lateral + (dy * cosine + dz * sine) * cosine, dy * sine - dz * cosine,
            Vector2<T>(T(-sine), cosine), T(0)};
  }

  using Element = ProfilePiece<T>;
  using Point = Vector2<T>;  // (lateral, value) [m]
  using Curve = CubicSpline<T, Point>;
  // A piece of the Profile is two polynomials: one alone would cost strips, of which a piece has two
  // at least, and more would loosen what is kept of a piece as a whole, a rail's curvature: with four
  // 14 of 2400 searches of wheels and rails with noise are not proved, with two none.
  static constexpr std::size_t per_piece = 2;
  // Parts of an interval between two nodes of the curve at whose ends a polynomial is compared.
  static constexpr int samples = 4;

  // A point of the curve as a function of the lateral coordinate.
  struct Node {
    T arc_length = T(0);
    T lateral = T(0);
    ProfilePoint<T> point;
  };

  static void check(const std::vector<T>& laterals, const std::vector<T>& values,
                    const SplineFitOptions<T>& options) {
    const std::size_t n = laterals.size();
    detail::require(n >= 4 && values.size() == n,
                    detail::joined({"spline profile: there are ", std::to_string(n),
                                    " lateral coordinates and ", std::to_string(values.size()),
                                    " values, but must be as many, at least 4"}));
    detail::require_not_negative("spline profile: noise", options.noise, "[m]");
    detail::require_not_negative("spline profile: margin", options.margin, "[-]");
    detail::require_not_negative("spline profile: curve tolerance", options.curve_tolerance, "[m]");
    const T play = T(6) * options.noise;
    T farthest = laterals.front();
    for (std::size_t i = 0; i < n; ++i) {
      const auto name = [i](const char* what) {
        return detail::joined({"spline profile: ", what, " of point ", std::to_string(i)});
      };
      if (!is_finite(laterals[i])) detail::require_finite(name("lateral"), laterals[i]);
      if (!is_finite(values[i])) detail::require_finite(name("value"), values[i]);
      if (i > 0 && !(farthest - play < laterals[i])) {
        detail::require(false, name("lateral"), laterals[i],
                        "greater than the greatest before it, " + detail::to_text(farthest) +
                            " m, less 6 times the noise");
      }
      if (i > 0 && laterals[i] == laterals[i - 1] && values[i] == values[i - 1]) {
        detail::require(false, name("lateral"), laterals[i],
                        "different from that of the point before, or its value must");
      }
      farthest = detail::max(farthest, laterals[i]);
    }
  }

  [[nodiscard]] static std::vector<T> arc_lengths(const std::vector<T>& laterals,
                                                  const std::vector<T>& values) {
    using std::sqrt;
    std::vector<T> arc(laterals.size(), T(0));
    for (std::size_t i = 1; i < arc.size(); ++i) {
      arc[i] = arc[i - 1] + T(sqrt(T(detail::square(T(laterals[i] - laterals[i - 1])) +
                                     detail::square(T(values[i] - values[i - 1])))));
    }
    return arc;
  }

  // The curve through or near the points.
  [[nodiscard]] Curve fitted(const std::vector<T>& arc, const std::vector<Point>& points,
                             const T& margin) {
    using std::sqrt;
    if (report_.noise == T(0)) {
      report_.status = SmoothingStatus::interpolating;
      return Curve(arc, points);
    }
    const SmoothingProblem<T, Point> problem(arc, points, SmoothingPenalty::third_derivative);
    T doubled = T(0);
    for (std::size_t i = 0; i < points.size(); ++i) doubled += T(2);
    const auto spline = SmoothingSpline<T, Point>::with_noise(
        problem, T(report_.noise * (T(1) + margin / T(sqrt(doubled)))),
        [](const SmoothedValues<T, Point>& values) { return rms_across(values); });
    report_.smoothing_parameter = spline.smoothing_parameter();
    report_.status = spline.status();
    return spline.spline();
  }

  // Root mean square of the residuals' part across the curve, whose direction is that from the point
  // before to the point after. Noise along the curve goes into the arc length and says nothing.
  [[nodiscard]] static T rms_across(const SmoothedValues<T, Point>& values) {
    using std::sqrt;
    const std::size_t n = values.fitted.size();
    T sum = T(0), count = T(0);
    for (std::size_t i = 0; i < n; ++i) {
      const Point& before = values.fitted[i == 0 ? 0 : i - 1];
      const Point& after = values.fitted[i + 1 == n ? i : i + 1];
      const T du = after.x() - before.x(), dv = after.y() - before.y();
      const T across = values.residuals[i].y() * du - values.residuals[i].x() * dv;
      sum += across * across / (du * du + dv * dv);
      count += T(1);
    }
    return sqrt(T(sum / count));
  }

  // u'(s) and v'(s) are parabolas between two nodes. Where slope_limit u' + v' and slope_limit u' -
  // v' stay positive, u' does too, and |v'| is below the limit: each is least at an end or its
  // vertex.
  static void check_slopes(const Curve& curve) {
    const auto& nodes = curve.nodes();
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      const auto left = curve.evaluate(nodes[i]), right = curve.evaluate(nodes[i + 1]);
      for (const T& sign : {T(1), T(-1)}) {
        const auto room = [&sign](const Point& rate) {
          return T(T(slope_limit) * rate.x() - sign * rate.y());
        };
        const T from = room(left.second_derivative), to = room(right.second_derivative);
        T s = room(left.slope) < room(right.slope) ? nodes[i] : nodes[i + 1];
        if (from < T(0) && T(0) < to) {
          s = nodes[i] + (nodes[i + 1] - nodes[i]) * (from / (from - to));
        }
        const auto at = curve.evaluate(s);
        if (T(0) < room(at.slope)) continue;
        const T slope = at.slope.y() / at.slope.x();
        detail::require(
            false,
            detail::joined({"spline profile: after point ", std::to_string(i), ", at lateral ",
                            detail::to_text(T(at.value.x())), " m, the slope of the curve"}),
            slope,
            at.slope.x() < T(0)
                ? std::string("of a curve that does not turn back: cut the points there")
                : detail::joined({"less than ", std::to_string(slope_limit),
                                  " in size: cut the points there"}));
      }
    }
  }

  void report_deviations(const Curve& curve, const std::vector<Point>& points) {
    using std::sqrt;
    T sum = T(0), count = T(0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto at = curve.evaluate(curve.nodes()[i]);
      const Point off = points[i] - at.value;
      const T across = detail::magnitude(T(off.y() * at.slope.x() - off.x() * at.slope.y())) /
                       T(sqrt(detail::squared_norm<T>(at.slope)));
      sum += across * across;
      count += T(1);
      if (report_.greatest_deviation < across) {
        report_.greatest_deviation = across;
        report_.greatest_deviation_index = static_cast<int>(i);
      }
    }
    report_.rms_deviation = sqrt(T(sum / count));
  }

  [[nodiscard]] static Node node_at(const Curve& curve, const T& arc_length) {
    const auto at = curve.evaluate(arc_length);
    const T slope = at.slope.y() / at.slope.x();
    return {arc_length,
            at.value.x(),
            {at.value.y(), slope,
             (at.second_derivative.y() - slope * at.second_derivative.x()) /
                 (at.slope.x() * at.slope.x())}};
  }

  // The polynomial of degree 5 that shares value, slope and second derivative with both ends.
  [[nodiscard]] static Element between(const Node& left, const Node& right) {
    const T width = right.lateral - left.lateral;
    const ProfilePoint<T>& a = left.point;
    const ProfilePoint<T>& b = right.point;
    const T half = constant<T>(0.5L) * width * width;
    const T first = width * a.slope, second = half * a.second_derivative;
    // What is left at the right end of value, slope and half the second derivative, over t = 0..1.
    const T value = b.value - a.value - first - second;
    const T slope = width * b.slope - first - T(2) * second;
    const T bend = half * b.second_derivative - second;
    const std::array<T, 6> coefficients{a.value,
                                        first,
                                        second,
                                        T(10) * value - T(4) * slope + bend,
                                        T(-15) * value + T(7) * slope - T(2) * bend,
                                        T(6) * value - T(3) * slope + bend};
    return Element::polynomial(left.lateral, right.lateral, left.lateral, width, coefficients);
  }

  // Of a polynomial from the curve, across it.
  [[nodiscard]] static T deviation(const Element& element, const Node& node) {
    using std::sqrt;
    const ProfilePoint<T> own = element.evaluate(node.lateral);
    return T(detail::magnitude(T(own.value - node.point.value)) /
             T(sqrt(T(T(1) + own.slope * own.slope))));
  }

  // Halves the curve until a polynomial follows it within the tolerance.
  void convert(const Curve& curve, const T& tolerance) {
    const auto& arc = curve.nodes();
    std::vector<Node> nodes;  // those of the spline, and between them what is only looked at
    nodes.reserve(arc.size() * static_cast<std::size_t>(samples));
    for (std::size_t i = 0; i + 1 < arc.size(); ++i) {
      for (int k = 0; k < samples; ++k) {
        nodes.push_back(node_at(curve, T(arc[i] + (arc[i + 1] - arc[i]) * T(k) / T(samples))));
      }
    }
    nodes.push_back(node_at(curve, arc.back()));
    struct Part {
      std::size_t first, last;
    };
    constexpr std::size_t parts = samples;
    std::vector<Part> open{{0, nodes.size() - 1}};
    while (!open.empty()) {
      const auto [first, last] = open.back();
      open.pop_back();
      if (last - first <= parts) {
        convert_one(curve, nodes[first], nodes[last], tolerance, 0);
        continue;
      }
      const Element element = between(nodes[first], nodes[last]);
      T worst = T(0);
      for (std::size_t i = first + 1; i < last && !(tolerance < worst); ++i) {
        worst = detail::max(worst, deviation(element, nodes[i]));
      }
      if (tolerance < worst) {
        const std::size_t middle = (first / parts + (last - first) / parts / 2) * parts;
        open.push_back({middle, last});
        open.push_back({first, middle});
      } else {
        elements_.push_back(element);
        report_.curve_deviation = detail::max(report_.curve_deviation, worst);
      }
    }
  }

  // The same inside one cubic.
  void convert_one(const Curve& curve, const Node& left, const Node& right, const T& tolerance,
                   int depth) {
    constexpr int maximum_depth = 12;
    const Element element = between(left, right);
    const T width = right.arc_length - left.arc_length;
    T worst = T(0);
    for (int k = 1; k < samples; ++k) {
      const Node node = node_at(curve, T(left.arc_length + width * T(k) / T(samples)));
      worst = detail::max(worst, deviation(element, node));
    }
    if (tolerance < worst && depth < maximum_depth) {
      const Node middle = node_at(curve, T(left.arc_length + width / T(2)));
      convert_one(curve, left, middle, tolerance, depth + 1);
      convert_one(curve, middle, right, tolerance, depth + 1);
      return;
    }
    if (tolerance < worst) {
      detail::require(false,
                      detail::joined({"spline profile: at lateral ", detail::to_text(left.lateral),
                                      " m the distance of the profile from the smoothed curve"}),
                      worst, "at most the curve tolerance, " + detail::to_text(tolerance) + " m");
    }
    elements_.push_back(element);
    report_.curve_deviation = detail::max(report_.curve_deviation, worst);
  }

  // Twice as many cells of equal width as there are polynomials, each with the polynomial at its
  // lower end.
  void make_table() {
    for (const Element& element : elements_) {
      const ProfilePoint<T> point = element.evaluate(element.lower());
      ends_.push_back({element.lower(), point.value, point.slope});
    }
    const T last = elements_.back().upper();
    const ProfilePoint<T> point = elements_.back().evaluate(last);
    ends_.push_back({last, point.value, point.slope});
    const std::size_t cells = 2 * elements_.size();
    T count = T(0);
    for (std::size_t i = 0; i < cells; ++i) count += T(1);
    inverse_cell_ = count / (upper() - lower());
    T cell = T(0);
    std::size_t element = 0;
    for (std::size_t i = 0; i < cells; ++i) {
      const T start = lower() + cell / inverse_cell_;
      while (element + 1 < elements_.size() && !(start < elements_[element].upper())) ++element;
      table_.push_back(element);
      cell += T(1);
    }
  }

  void report_curvature() {
    for (const Element& element : elements_) {
      constexpr int steps = 8;
      for (int k = 0; k <= steps; ++k) {
        const T u = element.lower() + (element.upper() - element.lower()) * T(k) / T(steps);
        const ProfilePoint<T> point = element.evaluate(u);
        const T own = curvature(point);
        report_.steepest_slope =
            detail::max(report_.steepest_slope, detail::magnitude(point.slope));
        if (detail::magnitude(report_.greatest_curvature) < detail::magnitude(own)) {
          report_.greatest_curvature = own;
          report_.greatest_curvature_lateral = u;
        }
      }
    }
    report_.least_radius = T(1) / detail::magnitude(report_.greatest_curvature);
  }

  // The polynomial that holds a lateral coordinate, the right one at a node; the outermost ones for
  // one outside and for NaN.
  [[nodiscard]] std::size_t element_of(const T& lateral) const {
    std::size_t i = 0;
    if constexpr (std::is_floating_point_v<T>) {
      const T position = (lateral - lower()) * inverse_cell_;
      const std::size_t last = table_.size() - 1;
      if (T(0) < position) {
        i = table_[position < T(last) ? static_cast<std::size_t>(position) : last];
      }
      while (0 < i && lateral < ends_[i].lateral) --i;
      while (i + 1 < elements_.size() && ends_[i + 1].lateral <= lateral) ++i;
    } else {
      std::size_t end = elements_.size();
      while (i + 1 < end) {
        const std::size_t middle = i + (end - i) / 2;
        (lateral < ends_[middle].lateral ? end : i) = middle;
      }
    }
    return i;
  }
  [[nodiscard]] std::size_t element_in(int piece, const T& lateral) const {
    const std::size_t first = first_of(piece), end = first_of(piece + 1);
    const std::size_t i = element_of(lateral);
    return i < first ? first : (i < end ? i : end - 1);
  }
  // The first polynomial of a piece; their number for the piece after the last.
  [[nodiscard]] std::size_t first_of(int piece) const {
    const std::size_t first = per_piece * static_cast<std::size_t>(piece);
    return first < elements_.size() ? first : elements_.size();
  }

  template <class Visit>
  void for_elements(int piece, const T& lower, const T& upper, Visit&& visit) const {
    const std::size_t first = element_in(piece, lower), last = element_in(piece, upper);
    for (std::size_t i = first; i <= last; ++i) {
      visit(elements_[i], i == first ? lower : elements_[i].lower(),
            i == last ? upper : elements_[i].upper(), i == first);
    }
  }

  std::vector<Element> elements_;
  std::vector<End> ends_;  // of the polynomials, one more than these
  std::vector<std::size_t> table_;
  T inverse_cell_ = T(0);
  SplineFitReport<T> report_;
};

}  // namespace wheelrail
