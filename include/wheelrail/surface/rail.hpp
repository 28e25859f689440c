#pragma once
/// @file
/// The rail, a profile swept along a path, locally straight: points, tangents, normal and
/// curvatures, equations (1)-(4), (10)-(18) of the paper. May include: core, numerics, profile.
///
/// Rail frame: origin at the profile's origin; y along the profile's lateral axis towards the field
/// side, z along its upward axis (inclined with the rail), x = y x z along the rail: forwards on
/// the left rail, backwards on the right one. Right-handed on both sides.

#include <utility>
#include <vector>
#include <wheelrail/core/side.hpp>
#include <wheelrail/core/vector.hpp>
#include <wheelrail/profile/inspection.hpp>
#include <wheelrail/surface/supporting_lines.hpp>

namespace wheelrail {

/// Where a rail frame lies in the track frame: (4).
/// Invariant: axes_track is a rotation; its columns are the rail frame's x, y and z axes.
template <Real T>
struct RailFrame {
  Side side = Side::left;
  Vector3<T> origin_track = Vector3<T>::Zero();  ///< [m]
  Matrix3<T> axes_track = Matrix3<T>::Identity();
  /// Angle by which the rail's y axis rises above the track plane towards the field side [rad].
  T inclination = T(0);
  T arc_length = T(0);  ///< of the frame's origin along the track [m]

  /// A direction given in the track frame, in the rail frame.
  [[nodiscard]] Vector3<T> direction_rail(const Vector3<T>& direction_track) const {
    const auto& a = axes_track;
    const auto& d = direction_track;
    return Vector3<T>(a(0, 0) * d.x() + a(1, 0) * d.y() + a(2, 0) * d.z(),
                      a(0, 1) * d.x() + a(1, 1) * d.y() + a(2, 1) * d.z(),
                      a(0, 2) * d.x() + a(1, 2) * d.y() + a(2, 2) * d.z());
  }

  /// A direction given in the rail frame, in the track frame.
  [[nodiscard]] Vector3<T> direction_track(const Vector3<T>& direction_rail) const {
    const auto& a = axes_track;
    const auto& d = direction_rail;
    return Vector3<T>(a(0, 0) * d.x() + a(0, 1) * d.y() + a(0, 2) * d.z(),
                      a(1, 0) * d.x() + a(1, 1) * d.y() + a(1, 2) * d.z(),
                      a(2, 0) * d.x() + a(2, 1) * d.y() + a(2, 2) * d.z());
  }

  /// A point given in the rail frame [m], in the track frame [m].
  [[nodiscard]] Vector3<T> position_track(const Vector3<T>& position_rail) const {
    return origin_track + direction_track(position_rail);
  }
};

namespace detail {

/// No concave zone, as `concave_intervals` sees it, and no corner more concave than @p corner [rad].
template <Profile P>
[[nodiscard]] bool is_convex(const P& profile, const typename P::Scalar& corner) {
  using T = typename P::Scalar;
  for (const auto& joint : inspect_joints(profile)) {
    const T slope = profile.evaluate(joint.lateral).slope;
    if (joint.slope_jump < -corner * (T(1) + slope * slope)) return false;
  }
  return concave_intervals(profile).empty();
}

/// The curvature over [lower, upper] of one piece: bounds where the profile has them, otherwise from
/// both ends.
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

}  // namespace detail

/// A rail: its profile swept along x of the rail frame.
/// @note Queries do not allocate. Differentiable wherever the profile is.
template <Profile P>
class Rail {
 public:
  using Scalar = typename P::Scalar;
  using T = Scalar;
  using ProfileType = P;

  explicit Rail(P profile)
      : profile_(std::move(profile)),
        is_convex_(detail::is_convex(profile_,
                                     detail::max(constant<T>(1e-6L), T(T(256) * epsilon<T>())))) {
    constexpr int intervals = 256;
    const T corner = T(256) * epsilon<T>();
    bool nowhere_concave = HasDerivativeBounds<P>;
    for (int piece = 0; piece < profile_.piece_count(); ++piece) {
      const T first = profile_.joint(piece);
      const T width = profile_.joint(piece + 1) - first;
      const T own = curvature(profile_.evaluate(piece, first));
      PieceCurvature of{own, own, T(0)};
      for (int i = 0; i < intervals; ++i) {
        const T lower = first + width * T(i) / T(intervals);
        const T upper = i + 1 == intervals ? profile_.joint(piece + 1)
                                           : T(first + width * T(i + 1) / T(intervals));
        const auto bounds = detail::curvature_bounds(profile_, piece, lower, upper);
        of.least = detail::min(of.least, bounds.least);
        of.greatest = detail::max(of.greatest, bounds.greatest);
        checksum_ += T(1 + i % 7) * profile_.evaluate(piece, upper).value + lower;
      }
      if (piece > 0) {
        const T below = profile_.evaluate(piece - 1, first).slope;
        const T above = profile_.evaluate(piece, first).slope;
        const bool is_corner =
            corner * (T(1) + above * above) < detail::magnitude(T(below - above));
        if (is_corner) of.at_lower_joint = T(1) / epsilon<T>();
      }
      curvatures_.push_back(of);
      nowhere_concave = nowhere_concave && !(of.least < T(0));
    }
    is_proved_convex_ = nowhere_concave && detail::is_convex(profile_, corner);
    if (is_convex_) supporting_lines_ = SupportingLines<T>(profile_);
  }

  [[nodiscard]] const P& profile() const { return profile_; }

  /// Whether the profile has no concave zone and no concave corner, as `inspect_joints` and
  /// `concave_intervals` see it (jumps of the slope below 1e-6 pass). Searches use it.
  [[nodiscard]] bool is_convex() const { return is_convex_; }
  /// Whether it is convex for certain: the profile's derivative bounds say so, and its corners are
  /// concave by rounding at most.
  [[nodiscard]] bool is_proved_convex() const { return is_proved_convex_; }
  /// Tangents of the profile where it is convex; otherwise none. Where it is not proved convex, it may
  /// rise above one by the jumps of its slope that pass, 1e-6 of its width each.
  [[nodiscard]] const SupportingLines<T>& supporting_lines() const { return supporting_lines_; }
  /// Differs for rails of different profiles, but for chance [m].
  [[nodiscard]] const T& checksum() const { return checksum_; }

  /// The least curvature of the pieces between two lateral coordinates [1/m]: a bound where the
  /// profile has bounds, otherwise from samples.
  [[nodiscard]] T least_curvature(const T& one, const T& other) const {
    const auto [first, last] = pieces_between(one, other);
    T least = curvatures_[first].least;
    for (std::size_t piece = first + 1; piece <= last; ++piece) {
      least = detail::min(least, curvatures_[piece].least);
    }
    return least;
  }

  /// The greatest curvature there [1/m], as far as the profile has bounds; infinite over a corner.
  [[nodiscard]] T greatest_curvature(const T& one, const T& other) const {
    const auto [first, last] = pieces_between(one, other);
    T greatest = curvatures_[first].greatest;
    for (std::size_t piece = first + 1; piece <= last; ++piece) {
      greatest = detail::max(
          greatest, detail::max(curvatures_[piece].greatest, curvatures_[piece].at_lower_joint));
    }
    return greatest;
  }

  /// (3), (60): the surface point [m], rail frame.
  [[nodiscard]] static Vector3<T> position_rail(const T& arc_length, const T& lateral,
                                                const ProfilePoint<T>& point) {
    return Vector3<T>(arc_length, lateral, point.value);
  }

  /// (12): unit tangent along the profile towards the field side, rail frame.
  [[nodiscard]] static Vector3<T> lateral_tangent_rail(const ProfilePoint<T>& point) {
    using std::sqrt;
    const T cosine = T(1) / sqrt(T(T(1) + point.slope * point.slope));
    return Vector3<T>(T(0), cosine, point.slope * cosine);
  }

  /// (16): unit normal out of the rail, rail frame.
  [[nodiscard]] static Vector3<T> normal_rail(const ProfilePoint<T>& point) {
    using std::sqrt;
    const T cosine = T(1) / sqrt(T(T(1) + point.slope * point.slope));
    return Vector3<T>(T(0), -point.slope * cosine, cosine);
  }

  /// (17): curvature of the profile [1/m], positive where the rail is convex. The curvature along
  /// the rail is zero (18).
  [[nodiscard]] static T lateral_curvature(const ProfilePoint<T>& point) {
    return curvature(point);
  }

 private:
  struct PieceCurvature {
    T least{}, greatest{};  // inside [1/m]
    T at_lower_joint{};     // where that is a corner: hardly finite [1/m]
  };

  // The first and the last piece between two lateral coordinates in any order.
  [[nodiscard]] std::pair<std::size_t, std::size_t> pieces_between(const T& one,
                                                                   const T& other) const {
    const auto a = static_cast<std::size_t>(piece_of(profile_, one));
    const auto b = static_cast<std::size_t>(piece_of(profile_, other));
    return a < b ? std::pair(a, b) : std::pair(b, a);
  }

  P profile_;
  bool is_convex_;
  bool is_proved_convex_ = false;
  T checksum_ = T(0);
  std::vector<PieceCurvature> curvatures_;
  SupportingLines<T> supporting_lines_;
};

}  // namespace wheelrail
