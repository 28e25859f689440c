#pragma once
/// @file
/// The track's design geometry: a plane centre line of tangents, clothoids and arcs, with cant.
/// May include: core, numerics, profile, surface.
///
/// The centre line starts at the track frame's origin along x and stays in z = 0. Curvature and
/// heading are positive to the left. Cant is the height of the right rail over the left one,
/// measured across `cant_base`: positive cant leans the track plane into a left curve. It turns the
/// track plane about the centre line, so that half of it lifts one rail and half lowers the other.

#include <vector>
#include <wheelrail/core/require.hpp>
#include <wheelrail/core/side.hpp>
#include <wheelrail/core/vector.hpp>
#include <wheelrail/numerics/detail/gauss_legendre.hpp>

namespace wheelrail {

/// Of constant curvature 0, of one that goes linearly from one to another, of a constant one.
enum class SegmentKind { tangent, clothoid, arc };

/// A piece of the centre line; `tangent`, `clothoid` and `arc` make one.
template <Real T>
struct TrackSegment {
  SegmentKind kind = SegmentKind::tangent;  ///< which of the three
  T length = T(0);                          ///< [m]
  T radius = T(0);                          ///< of an arc [m], > 0
  Side turn = Side::left;                   ///< of an arc
  T cant_start = T(0);  ///< [m], linear to cant_end; a clothoid takes its neighbours'
  T cant_end = T(0);    ///< [m]

  /// Straight. @param length [m], > 0. @param cant [m], constant.
  [[nodiscard]] static TrackSegment tangent(const T& length, const T& cant = T(0)) {
    return {SegmentKind::tangent, length, T(0), Side::left, cant, cant};
  }
  /// Curvature and cant go linearly from the end of the segment before to the start of the next.
  [[nodiscard]] static TrackSegment clothoid(const T& length) {
    return {SegmentKind::clothoid, length, T(0), Side::left, T(0), T(0)};
  }
  /// A circle's. @param length [m], > 0. @param radius [m], > 0. @param cant [m], constant.
  [[nodiscard]] static TrackSegment arc(const T& length, const T& radius, Side turn,
                                        const T& cant = T(0)) {
    return {SegmentKind::arc, length, radius, turn, cant, cant};
  }
};

/// How cant is measured and rounded off, and what counts as a jump.
template <Real T>
struct CentreLineOptions {
  /// Distance over which cant is measured [m]: sin(cant angle) = cant / cant_base. EN 13803 takes
  /// 1.5 m for a gauge of 1.435 m.
  T cant_base = constant<T>(1.5L);
  /// The cant is its linear ramps' mean over this length [m], which rounds their corners as in laid
  /// track, by a parabola: within half of it, and by at most an eighth of it times the change of
  /// slope. 0 leaves them sharp: a wheel meets a step of its vertical velocity.
  T cant_rounding = T(4);
  /// |jump| <= this where segments join.
  T curvature_tolerance = constant<T>(1e-9L);  ///< [1/m]
  T cant_tolerance = constant<T>(1e-9L);       ///< [m]
};

/// Where the track is at an arc length of its centre line.
template <Real T>
struct CentreLinePoint {
  Vector3<T> position_track = Vector3<T>::Zero();  ///< [m]
  T heading = T(0);                                ///< from x to the left [rad]
  T curvature = T(0);                              ///< positive to the left [1/m]
  T cant = T(0);                                   ///< right rail over left [m]
  T sin_cant = T(0);                               ///< of the angle by which the track plane leans
};

/// A track plane's axes (columns): forward, left and up, for a heading and the sine of the cant
/// angle; a positive one lifts the right side.
template <Real T>
[[nodiscard]] Matrix3<T> track_plane_axes(const T& heading, const T& sin_cant) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const T s = sin(heading), c = cos(heading);
  const T cos_cant = sqrt(T(T(1) - sin_cant * sin_cant));
  Matrix3<T> axes_track;
  axes_track << c, -s * cos_cant, -s * sin_cant,  //
      s, c * cos_cant, c * sin_cant,              //
      T(0), -sin_cant, cos_cant;
  return axes_track;
}

/// Segments joined to a line whose curvature and cant are continuous. Valid for good once
/// constructed. @note Queries do not allocate.
template <Real T>
class CentreLine {
 public:
  /// @throws std::invalid_argument naming the segment, counted from 0, unless lengths are > 0,
  /// radii
  ///   > cant_base, |cant| < cant_base / 2, no clothoid is first, last or beside another, no
  ///   segment turns by more than 100 rad, and curvature and cant join.
  explicit CentreLine(std::vector<TrackSegment<T>> segments,
                      const CentreLineOptions<T>& options = {})
      : options_(options) {
    detail::require_positive("centre line: cant base", options.cant_base, "[m]");
    detail::require_not_negative("centre line: cant rounding", options.cant_rounding, "[m]");
    for (const T& tolerance : {options.curvature_tolerance, options.cant_tolerance}) {
      detail::require_not_negative("centre line: joint tolerance", tolerance, "[1/m] or [m]");
    }
    detail::require(!segments.empty(), "centre line: there must be at least one segment");
    for (std::size_t i = 0; i < segments.size(); ++i) pieces_.push_back(checked(segments, i));
    join(segments);
  }

  [[nodiscard]] T length() const { return pieces_.back().start + pieces_.back().length; }  ///< [m]
  /// As they were given.
  [[nodiscard]] const CentreLineOptions<T>& options() const { return options_; }

  /// The number of segments, and the arc length at which segment @p i starts [m].
  [[nodiscard]] std::size_t segment_count() const { return pieces_.size(); }
  [[nodiscard]] const T& segment_start(std::size_t i) const { return pieces_[i].start; }  ///< [m]

  /// At @p arc_length [m]; beyond the ends the end segments go on. The position is integrated by
  /// Gauss-Legendre quadrature in steps that turn by at most 0.5 rad: exact to rounding.
  [[nodiscard]] CentreLinePoint<T> evaluate(const T& arc_length) const {
    std::size_t i = 0;
    while (i + 1 < pieces_.size() && pieces_[i + 1].start <= arc_length) ++i;
    CentreLinePoint<T> point = along(pieces_[i], T(arc_length - pieces_[i].start));
    point.cant += rounding(i, arc_length);
    point.sin_cant = point.cant / options_.cant_base;
    return point;
  }

 private:
  struct Piece {
    T start = T(0), length = T(0);
    Vector3<T> origin_track = Vector3<T>::Zero();
    T heading = T(0);  // at the start
    T curvature_start = T(0), curvature_rate = T(0);
    T cant_start = T(0), cant_rate = T(0);
    int steps = 1;  // of the quadrature
  };

  [[nodiscard]] static std::string name(std::size_t i) {
    return "centre line: segment " + std::to_string(i);
  }

  // Checked by itself; as yet without a place, and a clothoid without its ends.
  [[nodiscard]] Piece checked(const std::vector<TrackSegment<T>>& segments, std::size_t i) const {
    const TrackSegment<T>& segment = segments[i];
    detail::require_positive(name(i) + ": length", segment.length, "[m]");
    Piece piece;
    piece.length = segment.length;
    if (segment.kind == SegmentKind::clothoid) {
      const auto is_other = [&](std::size_t k) {  // 0 - 1 is no segment either
        return k < segments.size() && segments[k].kind != SegmentKind::clothoid;
      };
      detail::require(
          is_other(i - 1) && is_other(i + 1),
          name(i) + " is a clothoid, so a tangent or an arc must come before and after");
      return piece;
    }
    for (const T& cant : {segment.cant_start, segment.cant_end}) {
      detail::require(is_finite(cant) && T(2) * detail::magnitude(cant) < options_.cant_base,
                      name(i) + ": cant", cant,
                      "finite and less than half of the cant base, " +
                          detail::to_text(options_.cant_base) + " m");
    }
    piece.cant_start = segment.cant_start;
    piece.cant_rate = (segment.cant_end - segment.cant_start) / segment.length;
    if (segment.kind == SegmentKind::arc) {
      detail::require(
          is_finite(segment.radius) && options_.cant_base < segment.radius, name(i) + ": radius",
          segment.radius,
          "finite and greater than the cant base, " + detail::to_text(options_.cant_base) + " m");
      piece.curvature_start = outboard_sign<T>(segment.turn) / segment.radius;
    }
    return piece;
  }

  void join(const std::vector<TrackSegment<T>>& segments) {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      Piece& piece = pieces_[i];
      if (segments[i].kind == SegmentKind::clothoid) {
        const Piece& next = pieces_[i + 1];
        piece.curvature_start = pieces_[i - 1].curvature_start;
        piece.curvature_rate = (next.curvature_start - piece.curvature_start) / piece.length;
        piece.cant_start = segments[i - 1].cant_end;
        piece.cant_rate = (next.cant_start - piece.cant_start) / piece.length;
      } else if (i > 0 && segments[i - 1].kind != SegmentKind::clothoid) {
        check_joint(i, "curvature", "1/m", pieces_[i - 1].curvature_start, piece.curvature_start,
                    options_.curvature_tolerance);
        check_joint(i, "cant", "m", segments[i - 1].cant_end, piece.cant_start,
                    options_.cant_tolerance);
      }
      const T curvature_end = piece.curvature_start + piece.curvature_rate * piece.length;
      const T turn = piece.length * detail::max(detail::magnitude(piece.curvature_start),
                                                detail::magnitude(curvature_end));
      detail::require(turn <= T(100), name(i) + ": turn", turn, "at most 100 rad");
      while (T(piece.steps) < T(2) * turn) ++piece.steps;
      if (i == 0) continue;
      const Piece& before = pieces_[i - 1];
      const CentreLinePoint<T> end = along(before, before.length);
      piece.origin_track = end.position_track;
      piece.start = before.start + before.length;
      piece.heading = end.heading;
    }
  }

  static void check_joint(std::size_t i, const std::string& what, const std::string& unit,
                          const T& before, const T& after, const T& tolerance) {
    detail::require(detail::magnitude(T(after - before)) <= tolerance,
                    name(i) + " does not join segment " + std::to_string(i - 1) + ": its " + what +
                        " starts at " + detail::to_text(after) + " " + unit +
                        ", but the one before ends at " + detail::to_text(before) + " " + unit);
  }

  [[nodiscard]] static CentreLinePoint<T> along(const Piece& piece, const T& distance) {
    using std::cos;
    using std::sin;
    const auto heading = [&](const T& u) {
      return T(piece.heading + u * (piece.curvature_start + u * piece.curvature_rate / T(2)));
    };
    CentreLinePoint<T> point;
    const T half = distance / T(2 * piece.steps);
    T x = T(0), y = T(0);
    for (int k = 0; k < piece.steps; ++k) {
      const T middle = half * T(2 * k + 1);
      for (const auto& [abscissa, weight] : detail::gauss_legendre_8<T>) {
        const T before = heading(middle - half * abscissa),
                after = heading(middle + half * abscissa);
        x += weight * (cos(before) + cos(after));
        y += weight * (sin(before) + sin(after));
      }
    }
    point.position_track = piece.origin_track + Vector3<T>(half * x, half * y, T(0));
    point.heading = heading(distance);
    point.curvature = piece.curvature_start + distance * piece.curvature_rate;
    point.cant = piece.cant_start + distance * piece.cant_rate;
    return point;
  }

  // What the mean over [s - rounding / 2, s + rounding / 2] adds to a line with corners.
  [[nodiscard]] T rounding(std::size_t segment, const T& arc_length) const {
    const T half = options_.cant_rounding / T(2);
    T sum = T(0);
    const auto add = [&](std::size_t joint) {  // @return false when it lies too far away
      const T reach = half - detail::magnitude(T(arc_length - pieces_[joint].start));
      if (!(T(0) < reach)) return false;
      sum +=
          (pieces_[joint].cant_rate - pieces_[joint - 1].cant_rate) * reach * reach / (T(4) * half);
      return true;
    };
    for (std::size_t joint = segment; joint > 0 && add(joint);) --joint;
    for (std::size_t joint = segment + 1; joint < pieces_.size() && add(joint);) ++joint;
    return sum;
  }

  CentreLineOptions<T> options_;
  std::vector<Piece> pieces_;
};

}  // namespace wheelrail
