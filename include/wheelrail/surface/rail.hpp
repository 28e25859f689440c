#pragma once
/// @file
/// The rail, a profile swept along a path, locally straight: points, tangents, normal and
/// curvatures, equations (1)-(4), (10)-(18) of the paper. May include: core, numerics, profile.
///
/// Rail frame: origin at the profile's origin; y along the profile's lateral axis towards the field
/// side, z along its upward axis (inclined with the rail), x = y x z along the rail: forwards on
/// the left rail, backwards on the right one. Right-handed on both sides.

#include <type_traits>
#include <utility>
#include <wheelrail/core/side.hpp>
#include <wheelrail/core/vector.hpp>
#include <wheelrail/profile/value_profile.hpp>
#include <wheelrail/surface/detail/rail_convexity.hpp>

namespace wheelrail {

/// Where a rail frame lies in the track frame: (4).
/// Invariant: axes_track is a rotation; its columns are the rail frame's x, y and z axes.
template <Real T>
struct RailFrame {
  Side side = Side::left;                          ///< of which rail
  Vector3<T> origin_track = Vector3<T>::Zero();    ///< [m]
  Matrix3<T> axes_track = Matrix3<T>::Identity();  ///< of the rail frame [-]
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

/// A rail: its profile swept along x of the rail frame.
/// @note Queries do not allocate. Differentiable wherever the profile is.
template <Profile P>
class Rail {
 public:
  using Scalar = typename P::Scalar;  ///< the numbers of its coordinates
  using T = Scalar;                   ///< the same, short
  using ProfileType = P;              ///< of its profile

  /// The rail without the derivatives of its scalar.
  using Values = Rail<ValueProfile<P>>;

  /// @param profile in the rail frame, lateral coordinate to the field side.
  explicit Rail(P profile)
      : profile_(std::move(profile)), search_(Search(value_profile(profile_))) {}

  [[nodiscard]] const P& profile() const { return profile_; }  ///< of its cross-section
  /// The rail that a search in T searches on: of the values, or this one where T has no others.
  [[nodiscard]] const Values& values() const {
    if constexpr (has_derivatives<T>) {
      return search_;
    } else {
      return *this;
    }
  }

  /// Whether the profile has no concave zone and no concave corner, as `inspect_joints` and
  /// `concave_intervals` see it (jumps of the slope below 1e-6 pass). Searches use it.
  [[nodiscard]] bool is_convex() const { return search_.is_convex(); }
  /// Whether it is convex for certain: the profile's derivative bounds say so, and its corners are
  /// concave by rounding at most.
  [[nodiscard]] bool is_proved_convex() const { return search_.is_proved_convex(); }
  /// Tangents of the profile where it is convex; otherwise none. Where it is not proved convex, it may
  /// rise above one by the jumps of its slope that pass, 1e-6 of its width each.
  [[nodiscard]] const SupportingLines<ValueOf<T>>& supporting_lines() const {
    return search_.supporting_lines();
  }
  /// Differs for rails of different profiles, but for chance [m].
  [[nodiscard]] const ValueOf<T>& checksum() const { return search_.checksum(); }

  /// The least and the greatest curvature of the pieces between two lateral coordinates [1/m]: bounds
  /// where the profile has them, otherwise from samples. Over a corner the greatest is infinite.
  [[nodiscard]] CurvatureBounds<T> curvatures(const T& one, const T& other) const
      requires(!has_derivatives<T>) {
    return search_.curvatures(one, other);
  }
  /// The least of curvatures(one, other) [1/m].
  [[nodiscard]] T least_curvature(const T& one, const T& other) const
      requires(!has_derivatives<T>) {
    return curvatures(one, other).least;
  }
  /// The greatest of curvatures(one, other) [1/m].
  [[nodiscard]] T greatest_curvature(const T& one, const T& other) const
      requires(!has_derivatives<T>) {
    return curvatures(one, other).greatest;
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
  using Search = std::conditional_t<has_derivatives<T>, Values, detail::RailConvexity<P>>;

  P profile_;
  Search search_;
};

}  // namespace wheelrail
