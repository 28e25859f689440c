#pragma once
// The part of a contact search that looks nowhere near the contacts: 1 of penetration_bounds.hpp, by
// which whole branches of a wheel's strip tree are left out. May include: core, numerics, profile,
// surface, contact/placement.

#include <wheelrail/contact/detail/locus_strip.hpp>
#include <wheelrail/contact/rail_foot.hpp>

namespace wheelrail::detail {

// Which nodes of the strip tree lie above a tangent of the rail.
template <Profile P, Profile R>
class NearBlocks {
 public:
  using T = typename P::Scalar;

  // threshold: of a zone's penetration, less what rounding makes of it [m].
  NearBlocks(const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<T>& placement,
             const T& threshold)
      : wheel_(wheel),
        rail_(rail),
        placement_(placement),
        axle_lateral_(placement.cos_roll * placement.cos_yaw),
        axle_up_(placement.sin_roll * placement.cos_yaw),
        threshold_(threshold) {}

  // Whether the strips of a node are proved to stay `clearance` [m] above a tangent.
  [[nodiscard]] bool is_above(const RailTangent<T>& tangent, const StripNode<T>& node,
                              const T& clearance = T(0)) const {
    return rail_.is_convex() && is_above(plane(tangent), node, clearance);
  }

  // Calls visit(block) for the blocks, in order, of which no tangent proves that. Returns how many
  // feet on the rail were looked for.
  template <class Visit>
  int for_each(const T& clearance, Visit&& visit) {
    feet_ = 0;
    const auto& nodes = wheel_.strips().nodes();
    const int end = static_cast<int>(nodes.size());
    for (int index = 0; index < end;) {
      const StripNode<T>& node = nodes[static_cast<std::size_t>(index)];
      const bool far = is_far(node, clearance);
      if (!far && node.is_block) visit(index);
      index = far || node.is_block ? node.skip : index + 1;
    }
    return feet_;
  }

 private:
  // A tangent as the bound g needs it.
  struct Plane {
    T along_axle{};   // n.a
    T across_axle{};  // sqrt(1 - (n.a)^2)
    T height{};       // n.(P - o) [m]
  };

  [[nodiscard]] Plane plane(const RailTangent<T>& tangent) const {
    using std::sqrt;
    const Vector2<T>& normal = tangent.normal_rail;
    const T along = normal.x() * axle_lateral_ + normal.y() * axle_up_;
    return {along, sqrt(T(T(1) - along * along)),
            tangent.height - normal.x() * placement_.position_rail.y() -
                normal.y() * placement_.position_rail.z()};
  }

  [[nodiscard]] bool is_above(const Plane& plane, const StripNode<T>& node,
                              const T& clearance) const {
    const T greatest_g =
        plane.height - node.centre * plane.along_axle +
        wheel_.radius(node.point) * plane.across_axle +
        magnitude(T(node.point.slope * plane.across_axle - plane.along_axle)) * node.half_width +
        node.rise * plane.across_axle;
    return greatest_g < threshold_ - clearance;
  }

  // By the last tangent that was looked at, or by the one nearest to the node's centre.
  [[nodiscard]] bool is_far(const StripNode<T>& node, const T& clearance) {
    // What bulges that much is rarely above anything; its parts may be.
    if (!rail_.is_convex() || wheel_.nominal_radius() / T(250) < node.rise) return false;
    if (0 < feet_ && is_above(plane_, node, clearance)) return true;
    if (node.is_block) return false;  // the strips at its ends tell more
    ++feet_;
    // The lowest point of the strip, as if there were no yaw.
    const T radius = wheel_.radius(node.point);
    const T lateral = placement_.position_rail.y() + node.centre * placement_.cos_roll +
                      radius * placement_.sin_roll;
    const T up = placement_.position_rail.z() + node.centre * placement_.sin_roll -
                 radius * placement_.cos_roll;
    const ClosestPoint<T> foot = rail_foot(rail_.profile(), lateral, up);
    plane_ = plane({foot.normal_rail,
                    foot.penetration + foot.normal_rail.x() * lateral + foot.normal_rail.y() * up});
    return is_above(plane_, node, clearance);
  }

  const Wheel<P>& wheel_;
  const Rail<R>& rail_;
  const WheelPlacement<T>& placement_;
  T axle_lateral_;  // of the axle's direction, rail frame
  T axle_up_;
  T threshold_;
  Plane plane_;   // the last one that was looked at,
  int feet_ = 0;  // if there was any
};

}  // namespace wheelrail::detail
