#pragma once
/// @file
/// What a profile file can be: kinds, formats, units and axes, the options of reading and writing
/// and what a reading reports. The formats, as read (what is written is said at write_profile()):
///
/// - **SIMPACK** (.prw wheel, .prr rail): sections `header.begin` .. `header.end` and
///   `spline.begin` .. `spline.end` of `key = value` lines; within the latter `point.begin` ..
///   `point.end` with lines `y z [weight]`. `!` (or `%`) begins a comment, texts stand in `'`.
///   Applied to the points, in this order: shift.y, shift.z; rotate, from y to z, by units.ang.f
///   (user per rad); bound.y (points outside go), bound.z (points are clipped), each where
///   min < max; mirror.y, mirror.z; units.len.f (user per m). `type` must be the kind: 0 rail,
///   1 wheel. approx.smooth, point.dist.min, weights and unknown keys are not applied, which is
///   reported. The order of points is this library's own, so that inversion does not matter.
/// - **MiniProf** (.whl wheel, .ban and .rai rail): `Key=Value` lines, then lines of numbers in mm,
///   as the key ColumnDef names their columns (`X,Y,*` without it: X lateral, Y vertical, others
///   are not read, `*` any number of them). Applied: XOffset, YOffset [mm]. XYPoints must be the
///   number of points. Lines that begin with `!`, `"`, `%` or `#` are comments.
/// - **Table** (.txt, .csv, .dat and others): two columns, split by `;`, `,` or white space, after
///   at most one header line of two names. `!`, `#` and `%` begin a comment. A header's unit in
///   brackets, `[mm]` or `(m)`, holds for both columns; the names `lateral` and `value` say that
///   the axes are those of ProfilePoints.
///
/// In all: UTF-8 or ASCII, with or without byte order mark, any line ends; numbers with a decimal
/// point. May include: core, profile.

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <wheelrail/profile/profile_points.hpp>

namespace wheelrail {

/// Whose cross-section a file holds.
enum class ProfileKind { wheel, rail };

/// How a file is written; see the head of this header.
enum class ProfileFormat { simpack, miniprof, table };

/// The unit of a file's lengths.
enum class LengthUnit { metre, millimetre };

/// Where a file's vertical coordinate grows to: out of the body (on a wheel downwards at the rail,
/// to larger radii; on a rail upwards) or into it.
enum class ValueAxis { outward, inward };

/// Where a file's lateral coordinate grows to.
enum class LateralAxis { field_side, gauge_side };

/// What a reading rests on.
enum class ReadingBasis {
  stated,    ///< the file or its format says so
  detected,  ///< the shape says so, clearly
  assumed,   ///< nothing says so: the library's own convention
  forced     ///< an option says so, whatever the file says
};

/// Something read and what it rests on.
template <class V>
struct Reading {
  V value{};             ///< what was read
  ReadingBasis basis{};  ///< what it rests on
};

/// How to read a file; what is not given here is stated in it or is detected.
struct ProfileReadOptions {
  std::optional<ProfileFormat> format{};  ///< else told from the first line that is no comment
  std::optional<LengthUnit> unit{};       ///< of all lengths in the file
  std::optional<ValueAxis> value{};       ///< of the vertical column, after a mirror in the file
  std::optional<LateralAxis> lateral{};   ///< of the lateral column, after a mirror in the file
  std::size_t maximum_bytes = std::size_t{1} << 23;  ///< refused: size > maximum_bytes
  std::size_t maximum_points = 100000;               ///< refused: points > maximum_points
};

/// How to write a file.
struct ProfileWriteOptions {
  ProfileFormat format = ProfileFormat::table;  ///< of the file
  LengthUnit unit = LengthUnit::metre;  ///< MiniProf knows millimetres only and ignores this
  std::vector<std::string> comments{};  ///< one line each
};

/// A profile file as read.
template <Real T>
struct ProfileFile {
  ProfileKind kind{};              ///< wheel or rail
  ProfileFormat format{};          ///< of the file
  ProfilePoints<T> points{};       ///< [m], the library's axes, from flange or gauge to field side
  Reading<T> units_per_metre{};    ///< lengths of the file in a metre [1/m]: 1000 where in mm
  Reading<ValueAxis> value{};      ///< which way the file's values grow
  Reading<LateralAxis> lateral{};  ///< which way its lateral coordinates grow
  bool reversed{};                 ///< the file runs from the field side
  std::vector<std::string> comments{};  ///< lines of the file that say something to people
  std::vector<std::pair<std::string, std::string>> header{};  ///< keys and values, as in the file
  std::vector<std::string> not_applied{};  ///< keys and columns that were read but change nothing
};

}  // namespace wheelrail
