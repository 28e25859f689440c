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
      : wheel_(wheel),
        rail_(rail),
        placement_(placement),
        rail_lower_(rail.profile().lower()),
        rail_upper_(rail.profile().upper()),
        squared_tan_yaw_(square(placement.tan_yaw)),
        y_bend_(T(-3) * squared_tan_yaw_ * placement.cos_yaw) {}

  [[nodiscard]] int count() const { return count_; }

  [[nodiscard]] Strip at(int piece, const T& u) {
    if constexpr (has_derivatives<T>) {
      return strip(piece, u, wheel_.profile().evaluate(piece, u));
    } else {
      return flat(piece, u);
    }
  }

  // The same, put into `result`, which saves a copy. Not for dual numbers, as below.
  [[gnu::flatten]] void put(int piece, const T& u, Strip& result) {
    result = strip(piece, u, wheel_.profile().evaluate(piece, u));
  }

  // The strip of the wheel's own of that index.
  [[nodiscard]] Strip of_wheel(int index) {
    const auto& strip = wheel_.strips().strips()[static_cast<std::size_t>(index)];
    return flat(strip.piece, strip.lateral, strip.point);
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
  // Flat, since what is called returns more than is needed, through memory; but not in dual numbers,
  // which take long to compile.
  [[nodiscard, gnu::flatten]] Strip flat(int piece, const T& u) {
    return strip(piece, u, wheel_.profile().evaluate(piece, u));
  }
  [[nodiscard, gnu::flatten]] Strip flat(int piece, const T& u, const ProfilePoint<T>& point) {
    return strip(piece, u, point);
  }

  [[nodiscard]] Strip strip(int piece, const T& u, const ProfilePoint<T>& point) {
    ++count_;
    const LocusPoint<T> locus = locus_point(wheel_, placement_, u, point);
    if (!locus.exists) return Strip{.wheel_lateral = u, .piece = piece};
    const ClosestPoint<T> foot = rail_foot(rail_.profile(), locus.lateral, locus.up);
    const Vector2<T>& normal = foot.normal_rail;
    // The foot moves along the surface, so only the locus' own motion across it counts.
    const T slope = -(normal.x() * locus.lateral_rate + normal.y() * locus.up_rate);
    const bool exists = is_finite(foot.penetration, slope) && !(foot.lateral < rail_lower_) &&
                        !(rail_upper_ < foot.lateral);
    return Strip{
        u,     foot.lateral, foot.penetration, slope, slope_rate(point, locus, foot), normal,
        piece, exists};
  }

  // d slope / d wheel_lateral: (57), (59) twice differentiated. What is left out, the terms with F''',
  // vanishes where the slope does.
  [[nodiscard]] T slope_rate(const ProfilePoint<T>& point, const LocusPoint<T>& locus,
                             const ClosestPoint<T>& foot) const {
    const Vector2<T>& n = foot.normal_rail;
    const T& bend = point.second_derivative;
    const T steepness = point.slope * point.slope;
    const T y_bend = y_bend_ * point.slope * bend;
    const T& inverse_cosine = locus.inverse_cosine;
    const T z_bend =
        -bend * locus.angle.cosine +
        squared_tan_yaw_ * bend * inverse_cosine *
            (T(2) * steepness + wheel_.radius(point) * bend * inverse_cosine * inverse_cosine);
    const T along = n.y() * locus.lateral_rate - n.x() * locus.up_rate;
    return -(n.x() * placement_.cos_roll + n.y() * placement_.sin_roll) * y_bend -
           (n.y() * placement_.cos_roll - n.x() * placement_.sin_roll) * z_bend -
           foot.curvature / (T(1) - foot.curvature * foot.penetration) * along * along;
  }

  const Wheel<P>& wheel_;
  const Rail<R>& rail_;
  const WheelPlacement<T>& placement_;
  T rail_lower_, rail_upper_;  // [m]
  T squared_tan_yaw_;
  T y_bend_;  // of the locus point's second derivative [-]
  Strip edge_;
  int edge_index_ = -1;
  int count_ = 0;
};

}  // namespace wheelrail::detail
