#pragma once
/// @file
/// Wheel and rail profiles from and to files of SIMPACK, MiniProf and two-column tables; what these
/// formats are is said in io/profile_format.hpp. Promises: what is not stated in a file is detected
/// where its shape is clear, refused where it is not, and reported; an input either gives finite
/// points or an error that names file and line; time and memory are limited by the options.
/// Points come as they were measured: profile/profile_points.hpp finds and mends their defects.
/// May include: core, profile, io.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <wheelrail/io/detail/miniprof_profile.hpp>
#include <wheelrail/io/detail/profile_axes.hpp>
#include <wheelrail/io/detail/profile_text.hpp>
#include <wheelrail/io/detail/simpack_profile.hpp>
#include <wheelrail/io/detail/table_profile.hpp>
#include <wheelrail/io/detail/whole_file.hpp>
#include <wheelrail/io/profile_format.hpp>

namespace wheelrail {

namespace detail {

// By the first line that is no comment.
[[nodiscard]] inline ProfileFormat format_of(const ProfileText& text) {
  for (const ProfileLine& line : text.lines()) {
    if (std::string_view("!#%\"").find(line.text.front()) != std::string_view::npos) {
      continue;
    }
    const std::string lower = lower_case(without_simpack_comment(line.text));
    if (lower.ends_with(".begin")) return ProfileFormat::simpack;
    return lower.find('=') != std::string::npos ? ProfileFormat::miniprof : ProfileFormat::table;
  }
  return ProfileFormat::table;
}

// A file's extension may not contradict its kind.
[[nodiscard]] inline bool extension_fits(const std::string& name, ProfileKind kind) {
  const std::string extension =
      lower_case(std::string_view(name).substr(std::min(name.rfind('.'), name.size())));
  const bool is_wheel = extension == ".prw" || extension == ".whl";
  const bool is_rail = extension == ".prr" || extension == ".ban" || extension == ".rai";
  return kind == ProfileKind::wheel ? !is_rail : !is_wheel;
}

[[nodiscard]] inline RawProfile read_raw(const ProfileText& text, ProfileKind kind,
                                         ProfileFormat format, const ProfileReadOptions& options) {
  if (!extension_fits(text.name(), kind)) {
    text.refuse(1, joined({"the extension is the other kind's, but a ",
                           kind == ProfileKind::wheel ? "wheel" : "rail", " is asked for"}));
  }
  RawProfile raw;
  switch (format) {
    case ProfileFormat::simpack:
      raw = SimpackReader(text, kind, options.unit.has_value(), options.maximum_points).profile();
      break;
    case ProfileFormat::miniprof:
      raw = read_miniprof(text, options.maximum_points);
      break;
    case ProfileFormat::table:
      raw = read_table(text, options.maximum_points);
      break;
  }
  if (raw.lateral.size() < least_profile_points) {
    text.refuse(text.last_line(), joined({"there are ", std::to_string(raw.lateral.size()),
                                          " points, but must be at least 4"}));
  }
  for (std::size_t i = 0; i < raw.lateral.size(); ++i) {
    // Keeps all that follows finite.
    if (!(std::abs(raw.lateral[i]) <= 1e9) || !(std::abs(raw.value[i]) <= 1e9)) {
      text.refuse(raw.lines[i],
                  joined({"the point is at (", to_text(raw.lateral[i]), ", ", to_text(raw.value[i]),
                          "), but must be nearer to the origin than 1e9"}));
    }
  }
  return raw;
}

// The shortest text that reads as the same number, in any locale.
template <std::floating_point T>
void append_number(std::string& text, const T& value) {
  char digits[64];
  const auto result = std::to_chars(digits, digits + sizeof digits, value);
  text.append(digits, result.ptr);
}

// A length in the file's unit. In another one than metres, fewer digits are taken where they are
// read as the same length, and zero has no sign: what was read as 12.3 mm is written as that, not as
// 12.299999999999999.
template <std::floating_point T>
void append_length(std::string& text, const T& length, const T& units) {
  if (units == T(1)) {
    append_number(text, length);
    return;
  }
  const T scaled = length * units + T(0);  // -0 + 0 is 0
  char digits[64];
  const auto end = std::to_chars(digits, digits + sizeof digits, scaled, std::chars_format::general,
                                 std::numeric_limits<T>::digits10);
  T read = T(0);
  std::from_chars(digits, end.ptr, read);
  if (read / units == length) {
    text.append(digits, end.ptr);
  } else {
    append_number(text, scaled);
  }
}

}  // namespace detail

/// A profile from the text of a file.
/// @param text of the file, whole.
/// @param name of the file, for errors; its extension may not be the other kind's.
/// @param kind whose cross-section it is: the text may contradict it, but need not say it.
/// @return points in metres and in the axes of ProfilePoints, in the file's order or, where its
///   last point lies nearer to the flange or gauge side than its first, in the opposite one.
///   Lengths without a unit are in mm where the lateral extent is over 1, else in m.
/// @throws std::invalid_argument "<name>:<line>: <what> is <value>, but must be <rule>".
template <Real T = double>
[[nodiscard]] ProfileFile<T> parse_profile(std::string_view text, const std::string& name,
                                           ProfileKind kind,
                                           const ProfileReadOptions& options = {}) {
  const detail::ProfileText lines(name, text, options.maximum_bytes);
  ProfileFile<T> file;
  file.kind = kind;
  file.format = options.format ? *options.format : detail::format_of(lines);
  detail::RawProfile raw = detail::read_raw(lines, kind, file.format, options);
  const detail::ProfileAxes axes = detail::read_axes(lines, raw, kind, options);
  file.units_per_metre = {T(axes.units_per_metre.value), axes.units_per_metre.basis};
  file.value = axes.value;
  file.lateral = axes.lateral;
  const T lateral_sign = axes.lateral.value == LateralAxis::field_side ? T(1) : T(-1);
  const T value_sign = axes.value.value == ValueAxis::outward ? T(1) : T(-1);
  for (std::size_t i = 0; i < raw.lateral.size(); ++i) {
    file.points.lateral.push_back(lateral_sign * T(raw.lateral[i]) / file.units_per_metre.value);
    file.points.value.push_back(value_sign * T(raw.value[i]) / file.units_per_metre.value);
  }
  file.reversed = file.points.lateral.back() < file.points.lateral.front();
  if (file.reversed) {
    std::reverse(file.points.lateral.begin(), file.points.lateral.end());
    std::reverse(file.points.value.begin(), file.points.value.end());
  }
  file.comments = std::move(raw.comments);
  file.header = std::move(raw.header);
  file.not_applied = std::move(raw.not_applied);
  return file;
}

/// A profile from a file, as parse_profile() reads its text.
/// @throws std::invalid_argument as parse_profile() does, and "<path>:1: <reason>" where there is
///   no such file, it is no regular one (a directory, a pipe) or cannot be read.
template <Real T = double>
[[nodiscard]] ProfileFile<T> read_profile(const std::filesystem::path& path, ProfileKind kind,
                                          const ProfileReadOptions& options = {}) {
  const std::string name = path.string();
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  detail::require(std::filesystem::exists(status), name + ":1: there is no such file");
  detail::require(std::filesystem::is_regular_file(status),
                  name + ":1: it is no regular file, but must be one");
  const auto bytes = std::filesystem::file_size(path, error);
  detail::require(!error && bytes <= options.maximum_bytes,
                  detail::joined({name, ":1: there are ", std::to_string(bytes),
                                  " bytes, but there must be at most ",
                                  std::to_string(options.maximum_bytes)}));
  std::ifstream file(path, std::ios::binary);
  std::string text;
  text.resize(static_cast<std::size_t>(bytes));
  file.read(text.data(), static_cast<std::streamsize>(bytes));
  detail::require(file.good() && file.gcount() == static_cast<std::streamsize>(bytes),
                  name + ":1: it cannot be read");
  return parse_profile<T>(text, name, kind, options);
}

/// The text of a profile file. Numbers are the shortest that read back the same: in metres points
/// of float and double come back bit for bit, in millimetres to rounding, and so that a short
/// decimal number of millimetres is written as it was read.
///
/// SIMPACK: z downwards at the contact (outward on a wheel, inward on a rail), y to the field side,
/// a wheel's points from the field side. MiniProf: in mm, X to the field side, Y outward. Table:
/// `lateral,value` with the unit. Only the table states its axes; from the others they must be
/// detected or given, as from any such file.
/// @param points finite, at least 4 [m].
/// @throws std::invalid_argument where points or a comment (one line, at least a letter or digit)
///   break these rules.
template <std::floating_point T>
[[nodiscard]] std::string profile_text(const ProfilePoints<T>& points, ProfileKind kind,
                                       const ProfileWriteOptions& options = {}) {
  detail::require(
      points.size() >= detail::least_profile_points && points.value.size() == points.size(),
      detail::joined({"profile file: there are ", std::to_string(points.size()), " laterals and ",
                      std::to_string(points.value.size()),
                      " values, but must be as many of both, at least 4"}));
  for (std::size_t i = 0; i < points.size(); ++i) {
    detail::require_finite("profile file: lateral of point " + std::to_string(i),
                           points.lateral[i]);
    detail::require_finite("profile file: value of point " + std::to_string(i), points.value[i]);
  }
  const bool is_simpack = options.format == ProfileFormat::simpack;
  const bool is_miniprof = options.format == ProfileFormat::miniprof;
  const bool is_wheel = kind == ProfileKind::wheel;
  const T units = is_miniprof || options.unit == LengthUnit::millimetre ? T(1000) : T(1);
  const T value_sign = is_simpack && !is_wheel ? T(-1) : T(1);
  std::string text;
  for (const std::string& comment : options.comments) {
    detail::RawProfile read;
    detail::add_comment(read, detail::joined({"#", comment}));
    const bool is_line = std::all_of(comment.begin(), comment.end(), [](char c) {
      const auto byte = static_cast<unsigned char>(c);
      return byte == '\t' || (byte >= 0x20 && byte != 0x7F);
    });
    detail::require(is_line && !read.comments.empty(),
                    detail::joined({"profile file: a comment is ", detail::shown(comment),
                                    ", but must be one line with a letter or digit"}));
    text.append(is_simpack ? "! " : (is_miniprof ? "Comment=" : "# "));
    text.append(detail::trimmed(comment)).append("\n");
  }
  if (is_simpack) {
    text.append("header.begin\n  version = 1\n  type = ").append(is_wheel ? "1" : "0");
    text.append("\nheader.end\nspline.begin\n  units.len = ");
    text.append(units == T(1) ? "'m'\n  units.len.f = 1" : "'mm'\n  units.len.f = 1000");
    text.append("\n  point.begin\n");
  } else if (is_miniprof) {
    text.append("ColumnDef=X,Y\nXYPoints=").append(std::to_string(points.size())).append("\n\n");
  } else {
    text.append(units == T(1) ? "lateral [m],value [m]\n" : "lateral [mm],value [mm]\n");
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::size_t i = is_simpack && is_wheel ? points.size() - 1 - k : k;
    detail::append_length(text, points.lateral[i], units);
    text.append(is_simpack || is_miniprof ? " " : ",");
    detail::append_length(text, T(value_sign * points.value[i]), units);
    text.append("\n");
  }
  if (is_simpack) text.append("  point.end\nspline.end\n");
  return text;
}

/// Writes profile_text() to a neighbouring file, `<path>.part`, and renames it: a reader never sees
/// half a profile.
/// @throws std::invalid_argument as profile_text() does and where the extension is the other
///   kind's; std::runtime_error where the file cannot be written.
template <std::floating_point T>
void write_profile(const std::filesystem::path& path, const ProfilePoints<T>& points,
                   ProfileKind kind, const ProfileWriteOptions& options = {}) {
  const std::string name = path.string();
  detail::require(detail::extension_fits(name, kind),
                  name + ": the extension is the other kind's, but must fit the profile");
  const std::string text = profile_text(points, kind, options);
  if (!detail::write_whole_file(path, text)) {
    detail::throw_or_abort<std::runtime_error>(name + ": cannot be written");
  }
}

}  // namespace wheelrail
