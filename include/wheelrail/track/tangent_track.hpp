#pragma once
/// @file
/// A straight, level track: two rails, of one profile or each of its own, inclined inwards and set
/// apart to gauge.
/// May include: core, numerics, profile, surface.
///
/// Track frame: x forward, y left, z up; the highest points of the two heads lie at z = 0, the
/// plane y = 0 is midway between them. The gauge is the distance of the heads' inner faces 14 mm
/// below.

#include <array>
#include <wheelrail/numerics/detail/arc_tangent.hpp>
#include <wheelrail/surface/rail.hpp>
#include <wheelrail/track/detail/rail_seat.hpp>

namespace wheelrail {

/// How rails are laid. Defaults: the paper's Table 1.
template <Real T>
struct TrackDimensions {
  T gauge = constant<T>(1.435L);       ///< [m]
  T inclination = constant<T>(0.05L);  ///< slope of the rail's axis towards the track's middle [-]
};

/// A straight, level track. Valid for good once constructed. @note Queries do not allocate.
template <Profile R>
class TangentTrack {
 public:
  using Scalar = typename R::Scalar;  ///< the numbers of its coordinates
  using T = Scalar;                   ///< the same, short
  using RailProfile = R;              ///< of the rails

  /// @param profile of both rails, not yet inclined, lateral coordinate to the field side.
  /// @throws std::invalid_argument unless the gauge is > 0 and the heads do not overlap, the
  ///   inclination is in (-0.5, 0.5), and the profile reaches 14 mm below its highest point.
  explicit TangentTrack(const R& profile, const TrackDimensions<T>& dimensions = {})
      : TangentTrack(profile, profile, dimensions) {}

  /// Rails of their own on the left and on the right, each with its gauge point half the gauge from
  /// the middle. @throws std::invalid_argument as above.
  TangentTrack(R left, R right, const TrackDimensions<T>& dimensions)
      : rails_{Rail<R>(std::move(left)), Rail<R>(std::move(right))}, dimensions_(dimensions) {
    for (const Side side : sides) {
      const auto seat =
          detail::RailSeat<T>::of(rail(side).profile(), dimensions_.gauge, dimensions_.inclination);
      head_distance_ += seat.head_distance / T(2);
      const T sign = outboard_sign<T>(side);
      RailFrame<T>& frame = frames_[index_of(side)];
      frame.side = side;
      frame.origin_track = Vector3<T>(T(0), sign * seat.half_distance, seat.height);
      // y to the field side, rising; z leaning inwards; x = y x z.
      frame.axes_track << sign, T(0), T(0),             //
          T(0), sign * seat.cosine, -sign * seat.sine,  //
          T(0), seat.sine, seat.cosine;
      frame.inclination = detail::arc_tangent(dimensions_.inclination);
    }
  }

  /// Of that side.
  [[nodiscard]] const Rail<R>& rail(Side side) const { return rails_[index_of(side)]; }
  /// Gauge and inclination.
  [[nodiscard]] const TrackDimensions<T>& dimensions() const { return dimensions_; }

  /// Distance between the highest points of the two heads [m].
  [[nodiscard]] const T& head_distance() const { return head_distance_; }

  /// The rail frame at the foot of @p point_track on the rail's path: (36), closed form here.
  /// The guess of the arc length, which other tracks need, does not matter.
  [[nodiscard]] RailFrame<T> nearest_frame(Side side, const Vector3<T>& point_track,
                                           const T& /*guess*/ = T(0)) const {
    RailFrame<T> frame = frames_[index_of(side)];
    frame.arc_length = point_track.x();
    frame.origin_track.x() = point_track.x();
    return frame;
  }

 private:
  std::array<Rail<R>, 2> rails_;  // ordered as `sides`
  TrackDimensions<T> dimensions_;
  T head_distance_ = T(0);
  std::array<RailFrame<T>, 2> frames_;
};

}  // namespace wheelrail
