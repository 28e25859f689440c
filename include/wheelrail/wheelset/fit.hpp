#pragma once
/// @file
/// Whether a wheelset can stand on a track at all: a check for data from outside, before a run.
/// May include: all but dynamics and io.

#include <wheelrail/profile/inspection.hpp>
#include <wheelrail/wheelset/wheelset.hpp>

namespace wheelrail {

/// Where the flange face of a wheel profile passes @p height [m] above the tread circle: the
/// largest lateral coordinate below 0 [m] with F = height. With 10 mm this is where EN 15313
/// measures the flange thickness.
/// @throws std::invalid_argument when the profile has no such point.
template <Profile P>
[[nodiscard]] typename P::Scalar flange_face(
    const P& profile, const typename P::Scalar& height = constant<typename P::Scalar>(0.01L)) {
  using T = typename P::Scalar;
  const int samples = 512;
  T right = detail::min(T(0), profile.upper());
  const auto above = [&](const T& u) { return T(profile.evaluate(u).value - height); };
  T value_right = above(right);
  const T start = right;
  for (int i = 1; i <= samples; ++i) {
    const T left =
        i == samples ? profile.lower() : T(start + (profile.lower() - start) * T(i) / T(samples));
    const T value_left = above(left);
    if (value_right < T(0) && !(value_left < T(0))) {
      return bracketed_root<T>(above, left, right, value_left, value_right).position;
    }
    right = left;
    value_right = value_left;
  }
  detail::require(false, "wheel profile: it has no flange " + detail::to_text(height) +
                             " m above the tread circle");
  return right;
}

/// Checks that the flanges go between the rails and the treads reach over the heads.
/// @throws std::invalid_argument that names the gauge and its limits.
/// @param track anything with `dimensions().gauge` and `head_distance()`, as TangentTrack has.
template <Profile P, class Track>
void require_fit(const Wheelset<P>& wheelset, const Track& track) {
  using T = typename P::Scalar;
  const auto& left = wheelset.wheel(Side::left).profile();
  const auto& right = wheelset.wheel(Side::right).profile();
  const T gauge = track.dimensions().gauge;
  const T flange_distance = wheelset.profile_spacing() + flange_face(left) + flange_face(right);
  detail::require(flange_distance < gauge, "track: gauge", gauge,
                  "greater than the distance of the wheelset's flange faces, " +
                      detail::to_text(flange_distance) + " m: the wheelset does not fit");
  const T tread_distance = wheelset.profile_spacing() + left.upper() + right.upper();
  detail::require(track.head_distance() < tread_distance, "track: gauge", gauge,
                  "less than " +
                      detail::to_text(T(gauge + tread_distance - track.head_distance())) +
                      " m, or the rail heads lie outside the wheels: the wheelset does not fit");
}

}  // namespace wheelrail
