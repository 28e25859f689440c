#pragma once
// Strips of a wheel with their penetration into a rail and its derivatives. May include: core,
// numerics, profile, surface, contact/placement.

#include <wheelrail/contact/detail/locus_strip.hpp>
#include <wheelrail/contact/locus.hpp>
#include <wheelrail/contact/rail_foot.hpp>

namespace wheelrail::detail {

// Evaluates strips at one placement, and counts them.
template <Profile P, Profile R>
class LocusStrips {
 public:
  using T = typename P::Scalar;
  using Strip = LocusStrip<T>;

  LocusStrips(const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<T>& placement)
      : wheel_(wheel), rail_(rail), placement_(placement) {}

  [[nodiscard]] int count() const { return count_; }

  [[nodiscard]] Strip at(int piece, const T& u) {
    return at(piece, u, wheel_.profile().evaluate(piece, u));
  }

  // The strip of the wheel's own of that index.
  [[nodiscard]] Strip of_wheel(int index) {
    const auto& strip = wheel_.strips().strips()[static_cast<std::size_t>(index)];
    return at(strip.piece, strip.lateral, strip.point);
  }

  // The same where the call before may have been for it too.
  [[nodiscard]] Strip edge(int index) {
    if (index != edge_index_) {
      edge_ = of_wheel(index);
      edge_index_ = index;
    }
    return edge_;
  }

 private:
  [[nodiscard]] Strip at(int piece, const T& u, const ProfilePoint<T>& point) {
    ++count_;
    Strip strip;
    strip.wheel_lateral = u;
    strip.piece = piece;
    const LocusPoint<T> locus = locus_point(wheel_, placement_, u, point);
    if (!locus.exists) return strip;
    const ClosestPoint<T> foot = rail_foot(rail_.profile(), locus.lateral, locus.up);
    const Vector2<T>& normal = foot.normal_rail;
    strip.rail_lateral = foot.lateral;
    strip.normal_rail = normal;
    strip.penetration = foot.penetration;
    // The foot moves along the surface, so only the locus' own motion across it counts.
    strip.slope = -(normal.x() * locus.lateral_rate + normal.y() * locus.up_rate);
    strip.slope_rate = slope_rate(point, locus, foot);
    strip.exists = is_finite(strip.penetration) && is_finite(strip.slope) &&
                   !(foot.lateral < rail_.profile().lower()) &&
                   !(rail_.profile().upper() < foot.lateral);
    return strip;
  }

  // d slope / d wheel_lateral: (57), (59) twice differentiated. What is left out, terms with F''' and
  // of yaw to the fourth, vanishes where the slope does, but for yaw to the fourth.
  [[nodiscard]] T slope_rate(const ProfilePoint<T>& point, const LocusPoint<T>& locus,
                             const ClosestPoint<T>& foot) const {
    const Vector2<T>& n = foot.normal_rail;
    const T& bend = point.second_derivative;
    const T steepness = point.slope * point.slope;
    const T squared_tan_yaw = placement_.tan_yaw * placement_.tan_yaw;
    const T y_bend = T(-3) * squared_tan_yaw * placement_.cos_yaw * point.slope * bend;
    const T z_bend = -bend * locus.angle.cosine +
                     squared_tan_yaw * bend * (T(2) * steepness + wheel_.radius(point) * bend);
    const T along = n.y() * locus.lateral_rate - n.x() * locus.up_rate;
    return -(n.x() * placement_.cos_roll + n.y() * placement_.sin_roll) * y_bend -
           (n.y() * placement_.cos_roll - n.x() * placement_.sin_roll) * z_bend -
           foot.curvature / (T(1) - foot.curvature * foot.penetration) * along * along;
  }

  const Wheel<P>& wheel_;
  const Rail<R>& rail_;
  const WheelPlacement<T>& placement_;
  Strip edge_;
  int edge_index_ = -1;
  int count_ = 0;
};

}  // namespace wheelrail::detail
