#pragma once
// The patches of a search on values, with the derivatives of a dual scalar: the implicit-function
// theorem, once for each patch. May include: core, numerics, profile, surface, contact/patch,
// contact/detail/locus_strips.
//
// A patch is where the penetration's slope along the locus vanishes; its zone ends where the
// penetration passes the threshold. Both have derivatives where the slope's rate, or the slope at the
// zone's end, does not vanish: find_contact.hpp says where that is.

#include <wheelrail/contact/detail/locus_strips.hpp>
#include <wheelrail/contact/patch.hpp>
#include <wheelrail/numerics/lifted_root.hpp>

namespace wheelrail::detail {

template <Profile P, Profile R>
class PatchLifter {
 public:
  using T = typename P::Scalar;
  using V = ValueOf<T>;

  PatchLifter(const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<T>& placement,
              const V& threshold)
      : wheel_(wheel), rail_(rail), placement_(placement), threshold_(threshold) {}

  // @param previous the patch before it in the list; null: there is none.
  [[nodiscard]] Patch<T> operator()(const Patch<V>& found, const Patch<V>* previous) const {
    Patch<T> patch = patch_on_strip(wheel_, rail_, placement_, found.wheel_piece,
                                    stationary(found.wheel_piece, found.wheel_lateral));
    const bool begins_at_minimum = previous != nullptr && V(0) < previous->penetration_to_next;
    const bool ends_at_minimum = V(0) < found.penetration_to_next;
    patch.zone_lower = begins_at_minimum ? minimum(found.zone_lower) : zone_end(found.zone_lower);
    patch.zone_upper = ends_at_minimum ? minimum(found.zone_upper) : zone_end(found.zone_upper);
    patch.zone_is_cut = found.zone_is_cut;
    if (ends_at_minimum) {
      patch.penetration_to_next = at(piece_at(found.zone_upper), patch.zone_upper).penetration;
    }
    return patch;
  }

 private:
  [[nodiscard]] LocusStrip<T> at(int piece, const T& u) const {
    return LocusStrips<P, R>(wheel_, rail_, placement_).at(piece, u);
  }

  [[nodiscard]] int piece_at(const V& u) const { return piece_of(wheel_.values().profile(), u); }

  // Where the slope vanishes; a corner of the profile, or an end, stays where it is.
  [[nodiscard]] T stationary(int piece, const V& u) const {
    using std::sqrt;
    const LocusStrip<T> here = at(piece, T(u));
    if (magnitude(value_of(here.slope)) <= V(64) * V(sqrt(epsilon<V>()))) {
      return lifted_root<T>(u, [&](const T& x) {
        const LocusStrip<T> strip = at(piece, x);
        return ValueAndSlope<T>{strip.slope, strip.slope_rate};
      });
    }
    const P& profile = wheel_.profile();
    const V rounding = V(64) * epsilon<V>() * wheel_.values().nominal_radius();
    for (const int i : {piece, piece + 1}) {
      const T joint = profile.joint(i);
      if (magnitude(V(value_of(joint) - u)) <= rounding) return joint;
    }
    return T(u);  // a strip beside which the rail's profile ends
  }

  [[nodiscard]] T minimum(const V& u) const { return stationary(piece_at(u), u); }

  // NaN and ends at which the penetration does not pass the threshold stay what they are.
  [[nodiscard]] T zone_end(const V& u) const {
    using std::sqrt;
    if (!is_finite(u)) return T(u);
    const int piece = piece_at(u);
    const V beyond = value_of(at(piece, T(u)).penetration) - threshold_;
    if (!(magnitude(beyond) <= V(sqrt(epsilon<V>())) * wheel_.values().nominal_radius())) {
      return T(u);
    }
    return lifted_root<T>(u, [&](const T& x) {
      const LocusStrip<T> strip = at(piece, x);
      return ValueAndSlope<T>{strip.penetration, strip.slope};
    });
  }

  const Wheel<P>& wheel_;
  const Rail<R>& rail_;
  const WheelPlacement<T>& placement_;
  V threshold_;
};

// A result on values, its patches lifted.
template <Profile P, Profile R>
[[nodiscard]] ContactResult<typename P::Scalar> lifted_result(
    const Wheel<P>& wheel, const Rail<R>& rail, const WheelPlacement<typename P::Scalar>& placement,
    const ContactResult<ValueOf<typename P::Scalar>>& found,
    const ValueOf<typename P::Scalar>& threshold) {
  using T = typename P::Scalar;
  ContactResult<T> result;
  result.status = found.status;
  result.evaluations = found.evaluations;
  result.is_proved = found.is_proved;
  const PatchLifter<P, R> lifted(wheel, rail, placement, threshold);
  const Patch<ValueOf<T>>* previous = nullptr;
  for (const auto& patch : found.patches) {
    // As many as the other list holds.
    static_cast<void>(result.patches.push_back(lifted(patch, previous)));
    previous = &patch;
  }
  return result;
}

}  // namespace wheelrail::detail
