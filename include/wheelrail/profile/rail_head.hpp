#pragma once
/// @file
/// Rail heads of tangent arcs (EN 13674-1): crown, shoulder and corner radius on both halves and a
/// straight side, all of it following from the radii, the width, the depth and the side's slope.
/// The nearest point of such a head has a closed form. May include: core, numerics, profile.

#include <array>
#include <vector>
#include <wheelrail/core/detail/lanes.hpp>
#include <wheelrail/profile/piecewise_profile.hpp>

namespace wheelrail {

namespace detail {

// ClosestPoint of each lane.
template <Real T>
struct ClosestPointLanes {
  Lanes<T> lateral, penetration, normal_lateral, normal_up, curvature;
};

}  // namespace detail

/// What a rail head is built from, all [m]; the origin is the top of the head on its axis.
template <Real T>
struct RailHeadDimensions {
  T crown_radius = T(0);     ///< top arc, centred on the axis
  T shoulder_radius = T(0);  ///< between crown and corner
  T corner_radius = T(0);    ///< gauge and field corner
  T width = T(0);            ///< at the points where the corner arcs meet the sides
  T depth = T(0);            ///< of these points below the top
  T side_slope = T(0);       ///< widening of each side per depth [-]: 1/20
  T side_depth = T(0);       ///< depth below the top to which the straight sides are kept
};

/// A symmetric rail head of seven tangent pieces: side, corner, shoulder, crown, shoulder, corner,
/// side. Valid for good once constructed. @note Queries do not allocate.
template <Real T>
class RailHead {
 public:
  using Scalar = T;  ///< the numbers of its coordinates

  /// @throws std::invalid_argument unless crown > shoulder > corner radius > 0, side_slope > 0,
  ///   side_depth > depth > 0 and tangent arcs of these radii join the top to the given corner.
  explicit RailHead(const RailHeadDimensions<T>& dimensions)
      : RailHead(dimensions, joints_of(dimensions)) {}

  /// The same head in another scalar.
  template <Real U>
  [[nodiscard]] RailHead<U> cast() const {
    const auto& d = dimensions_;
    return RailHead<U>({scalar_cast<U>(d.crown_radius), scalar_cast<U>(d.shoulder_radius),
                        scalar_cast<U>(d.corner_radius), scalar_cast<U>(d.width),
                        scalar_cast<U>(d.depth), scalar_cast<U>(d.side_slope),
                        scalar_cast<U>(d.side_depth)});
  }

  /// As they were given.
  [[nodiscard]] const RailHeadDimensions<T>& dimensions() const { return dimensions_; }

  /// @name Of the concept Profile
  /// @{

  /// As Profile says it: lengths in m, pieces and joints from 0.
  [[nodiscard]] T lower() const { return profile_.lower(); }
  [[nodiscard]] T upper() const { return profile_.upper(); }
  [[nodiscard]] int piece_count() const { return profile_.piece_count(); }
  [[nodiscard]] T joint(int i) const { return profile_.joint(i); }
  [[nodiscard]] ProfilePoint<T> evaluate(const T& lateral) const {
    return profile_.evaluate(lateral);
  }
  [[nodiscard]] ProfilePoint<T> evaluate(int piece, const T& lateral) const {
    return profile_.evaluate(piece, lateral);
  }
  [[nodiscard]] DerivativeBounds<T> derivative_bounds(int piece, const T& lower,
                                                      const T& upper) const {
    return profile_.derivative_bounds(piece, lower, upper);
  }
  [[nodiscard]] CurvatureBounds<T> curvature_bounds(int piece, const T& lower,
                                                    const T& upper) const {
    return profile_.curvature_bounds(piece, lower, upper);
  }
  /// @}

  /// The closed form of (61): the arc whose sector holds the point, and the foot on its radius. The
  /// sectors are cut by the normals at the joints. The sides go on straight below side_depth; the
  /// foot's lateral coordinate then lies outside [lower(), upper()].
  /// @param lateral, up the point in the rail's cross-section plane [m].
  /// @pre The point is nearer to the surface than the corner radius where it lies under it, or
  ///   above the centres of the arcs: deeper inside, several points of the surface are nearest.
  [[nodiscard]] ClosestPoint<T> closest_point(const T& lateral, const T& up) const {
    using std::sqrt;
    const T sign = lateral < T(0) ? T(-1) : T(1);
    const T x = sign * lateral;
    std::size_t arc = 0;
    while (arc < 3 && T(0) < ends_[arc].cosine * (x - ends_[arc].lateral) -
                                 ends_[arc].sine * (up - ends_[arc].up)) {
      ++arc;
    }
    if (arc == 3) {
      const Joint& end = ends_[2];
      const T along = end.cosine * (x - end.lateral) - end.sine * (up - end.up);
      const T outside = end.sine * (x - end.lateral) + end.cosine * (up - end.up);
      return {sign * (end.lateral + along * end.cosine), -outside,
              Vector2<T>(sign * end.sine, end.cosine), T(0)};
    }
    const Circle& circle = circles_[arc];
    const T dx = x - circle.lateral;
    const T dz = up - circle.up;
    const T distance = sqrt(T(dx * dx + dz * dz));
    const T inverse = T(1) / distance;
    return {sign * (circle.lateral + circle.radius * dx * inverse), circle.radius - distance,
            Vector2<T>(sign * dx * inverse, dz * inverse), circle.curvature};
  }

  /// The same for a point of each lane.
  [[nodiscard]] detail::ClosestPointLanes<T> closest_points(const detail::Lanes<T>& lateral,
                                                            const detail::Lanes<T>& up) const {
    using Lanes = detail::Lanes<T>;
    const Joint &first = ends_[0], &second = ends_[1], &third = ends_[2];
    const Lanes zero = Lanes::Zero();
    const Lanes sign = T(1) - T(2) * detail::less<T>(lateral, zero);
    const Lanes x = sign * lateral;
    const auto along = [&](const Joint& end) -> Lanes {
      return end.cosine * (x - end.lateral) - end.sine * (up - end.up);
    };
    const Lanes passes_1 = detail::less<T>(zero, along(first));
    const Lanes passes_2 = passes_1 * detail::less<T>(zero, along(second));
    const Lanes along_3 = along(third);
    const Lanes passes_3 = passes_2 * detail::less<T>(zero, along_3);
    const auto of_arc = [&](T Circle::*value) -> Lanes {
      const auto of = [&](std::size_t arc) { return detail::all_lanes(circles_[arc].*value); };
      return detail::choose<T>(passes_2, of(2), detail::choose<T>(passes_1, of(1), of(0)));
    };
    const Lanes centre = of_arc(&Circle::lateral), radius = of_arc(&Circle::radius);
    const Lanes dx = x - centre, dz = up - of_arc(&Circle::up);
    const Lanes distance = (dx * dx + dz * dz).sqrt();
    const Lanes inverse = T(1) / distance;
    detail::ClosestPointLanes<T> foot{sign * (centre + radius * dx * inverse), radius - distance,
                                      sign * dx * inverse, dz * inverse,
                                      of_arc(&Circle::curvature)};
    if (!detail::any<T>(passes_3)) return foot;
    const auto on_side = [&](const Lanes& there, Lanes& here) {
      here = detail::choose<T>(passes_3, there, here);
    };
    on_side(sign * (third.lateral + along_3 * third.cosine), foot.lateral);
    on_side(-(third.sine * (x - third.lateral) + third.cosine * (up - third.up)), foot.penetration);
    on_side(sign * third.sine, foot.normal_lateral);
    on_side(detail::all_lanes(third.cosine), foot.normal_up);
    on_side(zero, foot.curvature);
    return foot;
  }

 private:
  // The far end of a piece on the field half: its point and the normal's angle from upright.
  struct Joint {
    T lateral = T(0), up = T(0), sine = T(0), cosine = T(0);
  };
  struct Circle {
    T lateral = T(0), up = T(0), radius = T(0), curvature = T(0);
  };
  using Joints = std::array<Joint, 3>;

  // A two-link arm: crown less shoulder radius at angle 1, shoulder less corner radius at angle 2,
  // reach from the crown's centre to the corner's centre.
  [[nodiscard]] static Joints joints_of(const RailHeadDimensions<T>& d) {
    using std::sqrt;
    detail::require_positive("rail head: corner radius", d.corner_radius, "[m]");
    detail::require(d.corner_radius < d.shoulder_radius, "rail head: shoulder radius",
                    d.shoulder_radius, "greater than the corner radius [m]");
    detail::require(d.shoulder_radius < d.crown_radius && is_finite(d.crown_radius),
                    "rail head: crown radius", d.crown_radius,
                    "finite and greater than the shoulder radius [m]");
    detail::require_positive("rail head: width", d.width, "[m]");
    detail::require_positive("rail head: depth", d.depth, "[m]");
    detail::require_positive("rail head: side slope", d.side_slope, "[-]");
    detail::require(d.depth < d.side_depth && is_finite(d.side_depth), "rail head: side depth",
                    d.side_depth, "finite and greater than the depth [m]");
    const T side_length = sqrt(T(T(1) + d.side_slope * d.side_slope));
    const T sine3 = T(1) / side_length;
    const T cosine3 = d.side_slope / side_length;
    const T first_link = d.crown_radius - d.shoulder_radius;
    const T second_link = d.shoulder_radius - d.corner_radius;
    const T lateral = d.width / T(2) - d.corner_radius * sine3;
    const T up = d.crown_radius - d.depth - d.corner_radius * cosine3;
    const T reach_squared = lateral * lateral + up * up;
    const T first_along = (reach_squared + first_link * first_link - second_link * second_link) /
                          (T(2) * reach_squared);
    const T height_squared = first_link * first_link / reach_squared - first_along * first_along;
    // The first link leans less than the second: it lies on the axis' side of the reach.
    const T across = T(0) < height_squared ? T(sqrt(height_squared)) : T(0);
    const T sine1 = (first_along * lateral - across * up) / first_link;
    const T cosine1 = (first_along * up + across * lateral) / first_link;
    const T sine2 = (lateral - first_link * sine1) / second_link;
    const T cosine2 = (up - first_link * cosine1) / second_link;
    detail::require(
        T(0) < height_squared && T(0) < sine1 && sine1 < sine2 && sine2 < sine3 && T(0) < cosine2,
        "rail head: no tangent arcs of the crown, shoulder and corner radii (" +
            detail::to_text(d.crown_radius) + ", " + detail::to_text(d.shoulder_radius) + ", " +
            detail::to_text(d.corner_radius) + " m) reach the width " + detail::to_text(d.width) +
            " m at the depth " + detail::to_text(d.depth) + " m");
    const T centre2_lateral = first_link * sine1;
    const T centre2_up = -d.crown_radius + first_link * cosine1;
    return {Joint{d.crown_radius * sine1, d.crown_radius * (cosine1 - T(1)), sine1, cosine1},
            Joint{centre2_lateral + d.shoulder_radius * sine2,
                  centre2_up + d.shoulder_radius * cosine2, sine2, cosine2},
            Joint{d.width / T(2), -d.depth, sine3, cosine3}};
  }

  RailHead(const RailHeadDimensions<T>& d, const Joints& joints)
      : dimensions_(d), ends_(joints), circles_(circles_of(d, joints)), profile_(profile_of()) {}

  [[nodiscard]] static std::array<Circle, 3> circles_of(const RailHeadDimensions<T>& d,
                                                        const Joints& joints) {
    const auto centred = [](const Joint& joint, const T& radius) {
      return Circle{joint.lateral - radius * joint.sine, joint.up - radius * joint.cosine, radius,
                    T(1) / radius};
    };
    return {Circle{T(0), -d.crown_radius, d.crown_radius, T(1) / d.crown_radius},
            centred(joints[1], d.shoulder_radius), centred(joints[2], d.corner_radius)};
  }

  [[nodiscard]] PiecewiseProfile<T> profile_of() const {
    using Piece = ProfilePiece<T>;
    const T end =
        ends_[2].lateral + (dimensions_.side_depth - dimensions_.depth) * dimensions_.side_slope;
    const std::array<T, 4> joint{ends_[0].lateral, ends_[1].lateral, ends_[2].lateral, end};
    const T slope = T(1) / dimensions_.side_slope;
    const auto arc = [&](const T& lower, const T& upper, const Circle& c, const T& sign) {
      return Piece::arc(lower, upper, sign * c.lateral, c.up, c.radius, true);
    };
    std::vector<Piece> pieces;
    pieces.reserve(7);
    pieces.push_back(Piece::line(-joint[3], -joint[2], -joint[2], ends_[2].up, slope));
    pieces.push_back(arc(-joint[2], -joint[1], circles_[2], T(-1)));
    pieces.push_back(arc(-joint[1], -joint[0], circles_[1], T(-1)));
    pieces.push_back(arc(-joint[0], joint[0], circles_[0], T(1)));
    pieces.push_back(arc(joint[0], joint[1], circles_[1], T(1)));
    pieces.push_back(arc(joint[1], joint[2], circles_[2], T(1)));
    pieces.push_back(Piece::line(joint[2], joint[3], joint[2], ends_[2].up, -slope));
    return PiecewiseProfile<T>(std::move(pieces));
  }

  RailHeadDimensions<T> dimensions_;
  Joints ends_;
  std::array<Circle, 3> circles_;
  PiecewiseProfile<T> profile_;
};

/// The 60E1 head (EN 13674-1): R300, R80, R13, 72 mm wide 14.3 mm below its top, sides 1:20.
/// The depth to which its sides are kept, 35 mm, is this library's choice.
template <Real T>
[[nodiscard]] RailHead<T> rail_60e1() {
  return RailHead<T>({constant<T>(0.3L), constant<T>(0.08L), constant<T>(0.013L),
                      constant<T>(0.072L), constant<T>(0.0143L), constant<T>(0.05L),
                      constant<T>(0.035L)});
}

/// The head of the UIC50 (50E4), an ASSUMPTION: its width, 70 mm, is confirmed; the depth, 14.1 mm,
/// is that of the 54E1 head. A doubt of 0.05 mm in it moves the shape by less than 0.02 mm within
/// 15 mm of the axis. The depth to which its sides are kept, 35 mm, is a choice.
template <Real T>
[[nodiscard]] RailHead<T> uic50() {
  return RailHead<T>({constant<T>(0.3L), constant<T>(0.08L), constant<T>(0.013L),
                      constant<T>(0.07L), constant<T>(0.0141L), constant<T>(0.05L),
                      constant<T>(0.035L)});
}

}  // namespace wheelrail
