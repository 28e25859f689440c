#pragma once
/// @file
/// A track of any layout with irregularities, §2.1: each rail's path is a table of position,
/// tangent and normal over the arc length, interpolated by cubic splines.
/// May include: core, numerics, profile, surface.
///
/// The track frame is that of the centre line's start. Both rails are parametrised by the arc
/// length of the centre line. Departures from the paper: the binormal is not a table of its own but
/// the cross product of the other two, and the axes are made orthonormal again after interpolation.

#include <array>
#include <wheelrail/numerics/cubic_spline.hpp>
#include <wheelrail/numerics/detail/arc_tangent.hpp>
#include <wheelrail/numerics/lifted_root.hpp>
#include <wheelrail/track/centre_line.hpp>
#include <wheelrail/track/irregularities.hpp>
#include <wheelrail/track/tangent_track.hpp>

namespace wheelrail {

/// How fine the table of nodes is.
template <Real T>
struct NodalTrackOptions {
  /// Nodes lie at most this far apart [m]. A jump J of a curvature's slope [1/m2], as where a
  /// clothoid begins, moves the path there by less than J spacing^3 / 30:
  /// 40 nm where one of 40 m leads to 300 m radius.
  T spacing = constant<T>(0.25L);
};

/// The interface of TangentTrack, with a length. Valid for good once constructed.
/// @note Queries do not allocate.
template <Profile R>
class NodalTrack {
 public:
  using Scalar = typename R::Scalar;  ///< the numbers of its coordinates
  using T = Scalar;                   ///< the same, short
  using RailProfile = R;              ///< of the rails

  /// The pre-processor. @param profile as for TangentTrack.
  /// @throws std::invalid_argument as TangentTrack does; unless the spacing is > 0 and at least a
  ///   millionth of the length; and naming the arc length at which the rails overlap or the cant
  ///   with the cross-level reaches half of the cant base.
  NodalTrack(R profile, CentreLine<T> centre_line, const TrackDimensions<T>& dimensions = {},
             const TrackIrregularities<T>& irregularities = {},
             const NodalTrackOptions<T>& options = {})
      : rail_(std::move(profile)),
        centre_line_(std::move(centre_line)),
        dimensions_(dimensions),
        seat_(detail::RailSeat<T>::of(rail_.profile(), dimensions.gauge, dimensions.inclination)),
        paths_{path(Side::left, irregularities, options),
               path(Side::right, irregularities, options)} {
    inclination_ = detail::arc_tangent(dimensions_.inclination);
  }

  [[nodiscard]] const Rail<R>& rail(Side) const { return rail_; }  ///< the same on both sides
  /// Gauge and inclination.
  [[nodiscard]] const TrackDimensions<T>& dimensions() const { return dimensions_; }
  /// As it was given.
  [[nodiscard]] const CentreLine<T>& centre_line() const { return centre_line_; }
  [[nodiscard]] T length() const { return paths_[0].upper(); }  ///< of the centre line [m]

  /// Distance between the highest points of the two heads, by design [m].
  [[nodiscard]] const T& head_distance() const { return seat_.head_distance; }

  /// The rail frame at @p arc_length [m]; all NaN before 0 and after length().
  [[nodiscard]] RailFrame<T> frame(Side side, const T& arc_length) const {
    return frame_of(side, paths_[index_of(side)].evaluate(arc_length).value, arc_length);
  }

  /// (36): the rail frame whose plane x = 0 holds @p point_track [m], by Newton's method from the
  /// arc length @p guess [m], such as that of the time before; where it fails, by a search
  /// outwards from the guess. The result does not depend on the guess beyond rounding as
  /// long as the guess is nearer than any other foot.
  /// @return all NaN where there is no foot between 0 and length().
  [[nodiscard]] RailFrame<T> nearest_frame(Side side, const Vector3<T>& point_track,
                                           const T& guess = T(0)) const {
    using std::sqrt;
    const auto& path = paths_[index_of(side)];
    const auto along = [&](const auto& at) {
      const Vector3<T> arm_track = at.value.col(0) - point_track;
      const Vector3<T> tangent_track = at.value.col(1);
      return ValueAndSlope<T>{dot(arm_track, tangent_track),
                              dot(Vector3<T>(at.slope.col(0)), tangent_track) +
                                  dot(arm_track, Vector3<T>(at.slope.col(1)))};
    };
    // Convergence is quadratic with a factor far below 1/m: a step this small [m] is the last, and
    // the table goes straight along it to rounding.
    const T small_step = sqrt(epsilon<T>());
    T s = detail::clamp(guess, T(0), length());
    int lifting_steps = ScalarTraits<T>::lifting_steps;
    // A guess from the time before is not the foot yet: its step needs no normal.
    const ValueAndSlope<T> first = along(path.template evaluate_columns<2>(s));
    if (T(0) < first.slope) s = detail::clamp(T(s - first.value / first.slope), T(0), length());
    for (int i = 0; i < 10; ++i) {
      const auto at = path.template evaluate_columns<3>(s);
      const ValueAndSlope<T> residual = along(at);
      if (!(T(0) < residual.slope)) break;
      const T step = -residual.value / residual.slope;
      if (detail::magnitude(step) <= small_step) {
        if (lifting_steps-- == 0) {
          return frame_of(side, Node(at.value + step * at.slope), T(s + step));
        }
        s = s + step;
        continue;
      }
      const T next = detail::clamp(T(s + step), T(0), length());
      if (next == s) break;
      s = next;
    }
    const auto along_at = [&](const T& x) { return along(path.evaluate(x)); };
    return frame(side, bracketed_foot(along_at, guess));
  }

 private:
  using Node = Eigen::Matrix<T, 3, 3, Eigen::DontAlign>;  // columns: position, tangent, normal
  using Path = CubicSpline<T, Node>;

  [[nodiscard]] static Vector3<T> unit(const Vector3<T>& a) {
    using std::sqrt;
    return (T(1) / sqrt(dot(a, a))) * a;
  }

  // All NaN outside the track.
  [[nodiscard]] RailFrame<T> frame_of(Side side, const Node& at, const T& arc_length) const {
    const T slack = T(16) * epsilon<T>() * length();
    const bool inside = -slack <= arc_length && arc_length <= length() + slack;
    const T valid = inside ? T(1) : T(T(0) / T(0));
    const Vector3<T> x_track = (valid * outboard_sign<T>(side)) * unit(Vector3<T>(at.col(1)));
    const Vector3<T> normal_track = at.col(2);
    const Vector3<T> y_track =
        unit(Vector3<T>(normal_track - dot(normal_track, x_track) * x_track));
    RailFrame<T> frame;
    frame.side = side;
    frame.origin_track = valid * at.col(0);
    frame.axes_track.col(0) = x_track;
    frame.axes_track.col(1) = y_track;
    frame.axes_track.col(2) = cross(x_track, y_track);
    frame.inclination = valid * inclination_;
    frame.arc_length = valid * arc_length;
    return frame;
  }

  // The foot nearest to the guess, in steps of a 1024th of the length outwards from it; or NaN.
  template <class Along>
  [[nodiscard]] T bracketed_foot(const Along& along, const T& guess) const {
    const T middle = detail::clamp(guess, T(0), length());
    const T step = length() / T(1024);
    std::array<T, 2> end{middle, middle};
    std::array<T, 2> value{along(middle).value, along(middle).value};
    for (int i = 0; i < 1024 && is_finite(value[0]) && is_finite(value[1]); ++i) {
      for (const std::size_t k : {0U, 1U}) {
        const T from = end[k], from_value = value[k];
        end[k] = detail::clamp(T(k == 0 ? from - step : from + step), T(0), length());
        value[k] = along(end[k]).value;
        const T below = k == 0 ? value[k] : from_value, above = k == 0 ? from_value : value[k];
        if (T(0) < below || above < T(0)) continue;
        const auto root = bracketed_newton<T>(along, detail::min(from, end[k]),
                                              detail::max(from, end[k]), below, above, from);
        return lifted_root<T>(value_of(root.position), along);
      }
    }
    return T(0) / T(0);
  }

  // One rail's table. The tangents are those of a spline through the positions.
  [[nodiscard]] Path path(Side side, const TrackIrregularities<T>& irregularities,
                          const NodalTrackOptions<T>& options) const {
    const T length = centre_line_.length();
    detail::require_positive("track: spacing", options.spacing, "[m]");
    detail::require(length <= T(1000000) * options.spacing, "track: spacing", options.spacing,
                    "at least a millionth of the length, " + detail::to_text(length) + " m");
    int intervals = 3;
    while (T(intervals) * options.spacing < length) ++intervals;
    const T sign = outboard_sign<T>(side);
    std::vector<T> arc_lengths;
    std::vector<Vector3<T>> positions_track;
    std::vector<Node> nodes;
    for (int i = 0; i <= intervals; ++i) {
      const T s = i == intervals ? length : T(length * T(i) / T(intervals));
      const CentreLinePoint<T> centre = centre_line_.evaluate(s);
      const Irregularity<T> off = irregularities.evaluate(s);
      const std::string where = "track: at arc length " + detail::to_text(s) + " m the ";
      detail::require(T(0) < seat_.clearance + off.gauge, where + "gauge",
                      T(dimensions_.gauge + off.gauge),
                      "greater than " + detail::to_text(T(dimensions_.gauge - seat_.clearance)) +
                          " m, or the rails overlap");
      const T base = centre_line_.options().cant_base;
      const T sin_cant = centre.sin_cant + off.cross_level / base;
      detail::require(T(2) * detail::magnitude(sin_cant) < T(1), where + "cant with cross-level",
                      T(sin_cant * base), "less than half of the cant base");
      const Matrix3<T> axes_track = track_plane_axes(centre.heading, sin_cant);
      const Vector3<T> left_track = axes_track.col(1), up_track = axes_track.col(2);
      positions_track.push_back(centre.position_track +
                                (off.lateral + sign * (seat_.half_distance + off.gauge / T(2))) *
                                    left_track +
                                (seat_.height + off.vertical) * up_track);
      arc_lengths.push_back(s);
      Node node;
      node.col(2) = (sign * seat_.cosine) * left_track + seat_.sine * up_track;
      nodes.push_back(node);
    }
    const CubicSpline<T, Vector3<T>> line(arc_lengths, positions_track);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Vector3<T> tangent_track = unit(line.evaluate(arc_lengths[i]).slope);
      const Vector3<T> normal_track = nodes[i].col(2);
      nodes[i].col(0) = positions_track[i];
      nodes[i].col(1) = tangent_track;
      nodes[i].col(2) =
          unit(Vector3<T>(normal_track - dot(normal_track, tangent_track) * tangent_track));
    }
    return Path(std::move(arc_lengths), std::move(nodes));
  }

  Rail<R> rail_;
  CentreLine<T> centre_line_;
  TrackDimensions<T> dimensions_;
  detail::RailSeat<T> seat_;
  std::array<Path, 2> paths_;
  T inclination_ = T(0);
};

}  // namespace wheelrail
