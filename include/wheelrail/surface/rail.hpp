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

template <Profile P>
[[nodiscard]] bool is_convex(const P& profile) {
  using T = typename P::Scalar;
  for (const auto& joint : inspect_joints(profile)) {
    if (joint.slope_jump < -constant<T>(1e-6L)) return false;
  }
  return concave_intervals(profile).empty();
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

  explicit Rail(P profile) : profile_(std::move(profile)), is_convex_(detail::is_convex(profile_)) {
    constexpr int samples = 256;
    for (int piece = 0; piece < profile_.piece_count(); ++piece) {
      const T lower = profile_.joint(piece), upper = profile_.joint(piece + 1);
      T least = curvature(profile_.evaluate(piece, lower));
      for (int i = 1; i <= samples; ++i) {
        const T u = i == samples ? upper : T(lower + (upper - lower) * T(i) / T(samples));
        least = detail::min(least, curvature(profile_.evaluate(piece, u)));
      }
      least_curvatures_.push_back(least);
    }
  }

  [[nodiscard]] const P& profile() const { return profile_; }

  /// Whether the profile has no concave zone and no concave corner, as `inspect_joints` and
  /// `concave_intervals` see it (jumps of the slope below 1e-6 pass). Searches use it.
  [[nodiscard]] bool is_convex() const { return is_convex_; }

  /// The least curvature of the pieces between two lateral coordinates [1/m], from samples.
  [[nodiscard]] T least_curvature(const T& one, const T& other) const {
    const int a = piece_of(profile_, one), b = piece_of(profile_, other);
    T least = least_curvatures_[static_cast<std::size_t>(a < b ? a : b)];
    for (int piece = (a < b ? a : b) + 1; piece <= (a < b ? b : a); ++piece) {
      least = detail::min(least, least_curvatures_[static_cast<std::size_t>(piece)]);
    }
    return least;
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
  P profile_;
  bool is_convex_;
  std::vector<T> least_curvatures_;  // of each piece
};

}  // namespace wheelrail
