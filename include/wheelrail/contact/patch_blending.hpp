#pragma once
/// @file
/// How the local maxima of one zone share its force, so that no force jumps where zones join and
/// maxima vanish; and curvatures that do not jump where arcs meet. The paper has neither: (62) drops
/// the lesser of two patches when their zones join. find_contact uses both where
/// SearchOptions::blending_length > 0. May include: core, numerics, profile, surface.
///
/// Let A = d^1.5 at each local maximum of the penetration, and B = s^1.5 at each minimum between
/// two of them that is positive: what (63) makes of depths. A zone has the sum of A less the sum of
/// B. That is the number of its separate pieces deeper than a level, summed over level^1.5: A for
/// one maximum, the sum for two zones that just join (B = 0), unchanged where a maximum meets a
/// minimum and both vanish, and never less when the wheel sinks. At a minimum both sides give up
/// parts of their A that make B, each in proportion to the other's excess M = A - B:
///   A_l' = A_l - B M_r / (M_l + M_r),   A_r' = A_r - B M_l / (M_l + M_r).
/// A maximum about to vanish has M = 0 and gives up all it has, the other side nothing. Nobody asks
/// which of them is the deepest.
///
/// Where a zone has more minima, one after the other joins its two sides to one that has A_l' + A_r',
/// and what that gives up later, all in it do in proportion. The sum does not depend on the order,
/// its parts do: so they are the mean over all orders, where of the minima that are left each is the
/// next with a probability in proportion to B (1/M_l + 1/M_r). One at which a maximum vanishes
/// always comes first, so that nobody's share changes; one at which zones just join comes last; and
/// that two become equally deep does not matter.
///
/// Depths that meet differ by the 3/2 power of what is left to that pose, and their place moves by
/// the 1/2 power: a maximum's share times its force is once differentiable there, as d^1.5 is at 0.
/// So is the wrench, where both profiles have continuous second derivatives and the force law has no
/// kink of its own (without_kinks()). Where arcs meet, the place of a patch has a kink as it passes
/// the joint: on arcs the wrench is continuous, with kinks. Both hold to some 1e-7 of the wrench, since
/// the search rounds places to sqrt(epsilon) radii, 6 nm in double. Nothing is promised where a
/// profile ends inside a zone (Patch::zone_is_cut), with a threshold > 0, or if a status is not
/// complete.

#include <array>
#include <wheelrail/contact/patch.hpp>

namespace wheelrail {

namespace detail {

/// One zone at work: its maxima, the minima to the right of each but the last, and sets of minima, as
/// bits, that have joined their sides.
template <Real T>
struct BlendedZone {
  static constexpr std::size_t capacity = ContactResult<T>::maximum_patches;
  using Shares = std::array<T, capacity>;

  std::size_t count = 0;
  std::array<T, capacity> maxima, minima;  // A and B

  [[nodiscard]] static bool is_in(std::size_t joined, std::size_t minimum) {
    return ((joined >> minimum) & 1U) != 0;
  }

  // The maxima on one side of a minimum that were joined to it, and their amount.
  struct Group {
    std::size_t first = 0, last = 0;
    T amount = T(0);
  };
  [[nodiscard]] Group group_of(std::size_t maximum, std::size_t joined) const {
    Group group{maximum, maximum, maxima[maximum]};
    for (; 0 < group.first && is_in(joined, group.first - 1); --group.first) {
      group.amount += maxima[group.first - 1] - minima[group.first - 1];
    }
    for (; group.last + 1 < count && is_in(joined, group.last); ++group.last) {
      group.amount += maxima[group.last + 1] - minima[group.last];
    }
    return group;
  }

  // What each maximum keeps once all minima have joined their sides.
  [[nodiscard]] Shares shares() const {
    const std::size_t all = (std::size_t{1} << (count - 1)) - 1;
    std::array<Shares, std::size_t{1} << (capacity - 1)> kept;  // from a set of minima on
    kept[all].fill(T(1));
    for (std::size_t joined = all; 0 < joined--;) {
      Shares& sum = kept[joined];
      sum.fill(T(0));
      T weights = T(0);
      for (std::size_t k = 0; k + 1 < count; ++k) {
        if (is_in(joined, k)) continue;
        const Group left = group_of(k, joined), right = group_of(k + 1, joined);
        const T& given = minima[k];
        const T left_excess = left.amount - given, right_excess = right.amount - given;
        const T both = left_excess + right_excess;
        const bool vanishes = !(T(0) < left_excess && T(0) < right_excess);
        T weight = T(1);
        if (vanishes) {  // this one is the next for certain
          sum.fill(T(0));
          weights = T(0);
        } else {
          weight = given * both / (left_excess * right_excess);
        }
        const T left_part = T(0) < both ? T(right_excess / both) : T(T(1) / T(2));
        const T left_keeps = T(1) - given * left_part / left.amount;
        const T right_keeps = T(1) - given * (T(1) - left_part) / right.amount;
        const Shares& then = kept[joined | (std::size_t{1} << k)];
        for (std::size_t i = 0; i < count; ++i) {
          const bool is_left = left.first <= i && i <= left.last;
          const bool is_right = right.first <= i && i <= right.last;
          const T keeps = is_left ? left_keeps : (is_right ? right_keeps : T(1));
          sum[i] += weight * keeps * then[i];
        }
        weights += weight;
        if (vanishes) break;
      }
      for (std::size_t i = 0; i < count; ++i) sum[i] = sum[i] / weights;
    }
    return kept[0];
  }
};

}  // namespace detail

/// Of each patch, the share of its force that counts, in [0, 1]; 1 for a patch without a neighbour
/// in its zone, and for all that are not in the list.
/// @param patches all local maxima, with penetration and penetration_to_next [m].
/// @param resolution of the list [m]: maxima that stand out by less are not in it. Minima count as
///   deeper by this, so that a maximum has lost its share before it may be missing.
/// @pre penetration_to_next + resolution is below the penetrations on both sides of it.
/// @return as many as a list can hold; shares of the forces are once differentiable in all depths.
/// @note Does not allocate. No square root of zero is taken.
template <Real T>
[[nodiscard]] std::array<T, ContactResult<T>::maximum_patches> blended_shares(
    const FixedList<Patch<T>, ContactResult<T>::maximum_patches>& patches,
    const T& resolution = T(0)) {
  using std::sqrt;
  const auto amount_of = [](const T& depth) { return T(depth * sqrt(depth)); };
  std::array<T, ContactResult<T>::maximum_patches> shares;
  shares.fill(T(1));
  for (std::size_t first = 0; first < patches.size(); ++first) {
    if (!(T(0) < patches[first].penetration_to_next)) continue;
    detail::BlendedZone<T> zone;
    const auto add = [&](const Patch<T>& patch) {
      zone.maxima[zone.count++] = amount_of(patch.penetration);
    };
    std::size_t last = first;
    for (; T(0) < patches[last].penetration_to_next && last + 1 < patches.size(); ++last) {
      zone.minima[zone.count] = amount_of(T(patches[last].penetration_to_next + resolution));
      add(patches[last]);
    }
    add(patches[last]);
    const auto of_zone = zone.shares();
    for (std::size_t i = first; i <= last; ++i) shares[i] = of_zone[i - first];
    first = last;
  }
  return shares;
}

/// The mean curvature of a profile around a point [1/m], positive where the body is convex: that of
/// the circle through the two points that lie half_length to either side of it, along the tangent,
/// with the change of direction between them. Exact on one arc.
/// @param lateral of the point [m], in the profile. @param half_length [m], > 0.
/// @return continuous where the profile's slope is; once differentiable where its second derivative
///   is continuous, but for kinks where one of the two points reaches an end of the profile: it
///   stays there.
/// @note Does not allocate.
template <Profile P>
[[nodiscard]] typename P::Scalar mean_curvature(const P& profile, const typename P::Scalar& lateral,
                                                const typename P::Scalar& half_length) {
  using std::sqrt;
  using T = typename P::Scalar;
  const T slope = profile.evaluate(lateral).slope;
  const T half_width = half_length / sqrt(T(T(1) + slope * slope));
  const T lower = detail::max(T(lateral - half_width), T(profile.lower()));
  const T upper = detail::min(T(lateral + half_width), T(profile.upper()));
  const ProfilePoint<T> one = profile.evaluate(lower), other = profile.evaluate(upper);
  // Tangents turn by an angle t to the right; an arc has the chord 2 sin(t / 2) / curvature.
  const T lengths = sqrt(T((T(1) + one.slope * one.slope) * (T(1) + other.slope * other.slope)));
  const T sine = (one.slope - other.slope) / lengths;
  const T cosine = (T(1) + one.slope * other.slope) / lengths;
  const T across = upper - lower, up = other.value - one.value;
  return sine * sqrt(T(T(2) / ((T(1) + cosine) * (across * across + up * up))));
}

namespace detail {

/// The patch with mean curvatures across the track, of the wheel and of the rail.
template <Profile P, Profile R>
[[nodiscard]] Patch<typename P::Scalar> with_mean_curvatures(
    Patch<typename P::Scalar> patch, const Wheel<P>& wheel, const Rail<R>& rail,
    const typename P::Scalar& half_length) {
  using T = typename P::Scalar;
  const T on_rail = clamp(patch.rail_lateral, rail.profile().lower(), rail.profile().upper());
  patch.wheel_lateral_curvature = mean_curvature(wheel.profile(), patch.wheel_lateral, half_length);
  patch.rail_lateral_curvature = mean_curvature(rail.profile(), on_rail, half_length);
  return patch;
}

}  // namespace detail
}  // namespace wheelrail
