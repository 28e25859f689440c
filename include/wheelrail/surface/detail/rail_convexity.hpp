#pragma once
// What a search uses of a rail's curvature: whether its profile is convex, bounds, lines above it.
// May include: core, numerics, profile, surface.

#include <utility>
#include <vector>
#include <wheelrail/profile/inspection.hpp>
#include <wheelrail/surface/supporting_lines.hpp>

namespace wheelrail::detail {

// No concave zone, as `concave_intervals` sees it, and no corner more concave than @p corner [rad].
template <Profile P>
[[nodiscard]] bool is_convex_profile(const P& profile, const typename P::Scalar& corner) {
  using T = typename P::Scalar;
  for (const auto& joint : inspect_joints(profile)) {
    const T slope = profile.evaluate(joint.lateral).slope;
    if (joint.slope_jump < -corner * (T(1) + slope * slope)) return false;
  }
  return concave_intervals(profile).empty();
}

// The curvature over [lower, upper] of one piece: bounds where the profile has them, otherwise from
// both ends.
template <Profile P>
[[nodiscard]] CurvatureBounds<typename P::Scalar> curvature_bounds(
    const P& profile, int piece, const typename P::Scalar& lower, const typename P::Scalar& upper) {
  using T = typename P::Scalar;
  if constexpr (HasDerivativeBounds<P>) {
    return profile.curvature_bounds(piece, lower, upper);
  } else {
    const T one = curvature(profile.evaluate(piece, lower));
    const T other = curvature(profile.evaluate(piece, upper));
    return {min(one, other), max(one, other)};
  }
}

// Of the profile of a rail. Rail says what each query means.
template <Profile P>
class RailConvexity {
 public:
  using T = typename P::Scalar;

  explicit RailConvexity(const P& profile)
      : is_convex_(is_convex_profile(profile, max(constant<T>(1e-6L), T(T(256) * epsilon<T>())))) {
    constexpr int intervals = 256;
    rounding_ = T(64) * epsilon<T>() * (profile.upper() - profile.lower());
    const T corner = T(256) * epsilon<T>();
    bool nowhere_concave = HasDerivativeBounds<P>;
    for (int piece = 0; piece < profile.piece_count(); ++piece) {
      const T first = profile.joint(piece);
      const T width = profile.joint(piece + 1) - first;
      const T own = curvature(profile.evaluate(piece, first));
      PieceCurvature of{first, own, own};
      for (int i = 0; i < intervals; ++i) {
        const T lower = first + width * T(i) / T(intervals);
        const T upper = i + 1 == intervals ? profile.joint(piece + 1)
                                           : T(first + width * T(i + 1) / T(intervals));
        const auto bounds = curvature_bounds(profile, piece, lower, upper);
        of.least = min(of.least, bounds.least);
        of.greatest = max(of.greatest, bounds.greatest);
        checksum_ += T(1 + i % 7) * profile.evaluate(piece, upper).value + lower;
      }
      if (piece > 0) {
        const T below = profile.evaluate(piece - 1, first).slope;
        const T above = profile.evaluate(piece, first).slope;
        const bool is_corner = corner * (T(1) + above * above) < magnitude(T(below - above));
        if (is_corner) of.at_lower_joint = T(1) / epsilon<T>();
      }
      curvatures_.push_back(of);
      nowhere_concave = nowhere_concave && !(of.least < T(0));
    }
    is_proved_convex_ = nowhere_concave && is_convex_profile(profile, corner);
    if (is_convex_) supporting_lines_ = SupportingLines<T>(profile);
  }

  [[nodiscard]] bool is_convex() const { return is_convex_; }
  [[nodiscard]] bool is_proved_convex() const { return is_proved_convex_; }
  [[nodiscard]] const SupportingLines<T>& supporting_lines() const { return supporting_lines_; }
  [[nodiscard]] const T& checksum() const { return checksum_; }

  [[nodiscard]] CurvatureBounds<T> curvatures(const T& one, const T& other) const {
    const bool rises = !(other < one);
    const T& last = rises ? other : one;
    std::size_t piece = piece_at(rises ? one : other);
    CurvatureBounds<T> bounds{curvatures_[piece].least, curvatures_[piece].greatest};
    // A foot on a corner is there but for rounding.
    if ((rises ? one : other) - curvatures_[piece].lower < rounding_) {
      bounds.greatest = max(bounds.greatest, curvatures_[piece].at_lower_joint);
    }
    for (++piece; piece < curvatures_.size() && !(last < curvatures_[piece].lower); ++piece) {
      const PieceCurvature& next = curvatures_[piece];
      bounds.least = min(bounds.least, next.least);
      bounds.greatest = max(bounds.greatest, max(next.greatest, next.at_lower_joint));
    }
    return bounds;
  }

 private:
  struct PieceCurvature {
    T lower = T(0);                           // where the piece begins [m]
    T least = T(0), greatest = T(0);          // inside [1/m]
    T at_lower_joint = T(-1) / epsilon<T>();  // where that is a corner: hardly finite [1/m]
  };

  // The piece that holds `lateral`, as piece_of finds it.
  [[nodiscard]] std::size_t piece_at(const T& lateral) const {
    constexpr std::size_t few = 8;
    std::size_t piece = 0, end = curvatures_.size();
    while (few < end - piece) {
      const std::size_t middle = piece + (end - piece) / 2;
      (lateral < curvatures_[middle].lower ? end : piece) = middle;
    }
    const std::size_t first = piece;
    piece += (end - piece) / 2;  // most feet are near the middle of a rail head
    while (first < piece && lateral < curvatures_[piece].lower) --piece;
    while (piece + 1 < end && !(lateral < curvatures_[piece + 1].lower)) ++piece;
    return piece;
  }

  bool is_convex_;
  bool is_proved_convex_ = false;
  T checksum_ = T(0);
  T rounding_ = T(0);  // of a lateral coordinate [m]
  std::vector<PieceCurvature> curvatures_;
  SupportingLines<T> supporting_lines_;
};

}  // namespace wheelrail::detail
