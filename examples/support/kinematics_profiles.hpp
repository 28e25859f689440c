#pragma once
// Profiles by name or from files, one type for wheels and one for rails, and the track that is laid
// with them.

#include <filesystem>
#include <optional>
#include <variant>
#include <wheelrail/io/profile_file.hpp>
#include <wheelrail/profile/profile_points.hpp>
#include <wheelrail/profile/spline_profile.hpp>

#include "output.hpp"
#include "profiles.hpp"

namespace examples {

// One of several profiles, chosen at run time: all pass on their bounds, so that a search stays as
// well proved as on the profile itself.
template <class... Models>
class AnyProfile {
 public:
  using Scalar = double;

  template <class Model>
  requires(std::same_as<Model, Models> || ...) explicit AnyProfile(Model model)
      : model_(std::move(model)) {}

  [[nodiscard]] double lower() const {
    return visit([](const auto& p) { return p.lower(); });
  }
  [[nodiscard]] double upper() const {
    return visit([](const auto& p) { return p.upper(); });
  }
  [[nodiscard]] int piece_count() const {
    return visit([](const auto& p) { return p.piece_count(); });
  }
  [[nodiscard]] double joint(int i) const {
    return visit([&](const auto& p) { return p.joint(i); });
  }
  [[nodiscard]] wheelrail::ProfilePoint<double> evaluate(double lateral) const {
    return visit([&](const auto& p) { return p.evaluate(lateral); });
  }
  [[nodiscard]] wheelrail::ProfilePoint<double> evaluate(int piece, double lateral) const {
    return visit([&](const auto& p) { return p.evaluate(piece, lateral); });
  }
  [[nodiscard]] wheelrail::DerivativeBounds<double> derivative_bounds(int piece, double lower,
                                                                      double upper) const {
    return visit([&](const auto& p) { return p.derivative_bounds(piece, lower, upper); });
  }
  [[nodiscard]] wheelrail::CurvatureBounds<double> curvature_bounds(int piece, double lower,
                                                                    double upper) const {
    return visit([&](const auto& p) { return p.curvature_bounds(piece, lower, upper); });
  }
  [[nodiscard]] wheelrail::ClosestPoint<double> closest_point(double lateral, double up) const
      requires(wheelrail::HasClosestPoint<Models>&&...) {
    return visit([&](const auto& p) { return p.closest_point(lateral, up); });
  }

 private:
  template <class Body>
  [[nodiscard]] auto visit(Body&& body) const {
    return std::visit(body, model_);
  }

  std::variant<Models...> model_;
};

using MeasuredProfile = wheelrail::SplineProfile<double>;
using AnyWheel = AnyProfile<RealWheel, ConvexWheel, MeasuredProfile>;
using AnyRail = AnyProfile<RailHead, MeasuredProfile>;
static_assert(wheelrail::HasDerivativeBounds<AnyWheel> && wheelrail::HasDerivativeBounds<AnyRail>);
static_assert(wheelrail::HasClosestPoint<AnyRail>);

// A profile and what is said of how it came about: lines without their ends.
template <class P>
struct LoadedProfile {
  P profile;
  std::string name;
  std::vector<std::string> notes;
};

[[nodiscard]] inline const char* name_of(wheelrail::ProfileFormat format) {
  switch (format) {
    case wheelrail::ProfileFormat::simpack:
      return "SIMPACK";
    case wheelrail::ProfileFormat::miniprof:
      return "MiniProf";
    case wheelrail::ProfileFormat::table:
      return "table";
  }
  return "unknown";
}

[[nodiscard]] inline const char* name_of(wheelrail::ReadingBasis basis) {
  switch (basis) {
    case wheelrail::ReadingBasis::stated:
      return "stated in the file";
    case wheelrail::ReadingBasis::detected:
      return "detected";
    case wheelrail::ReadingBasis::assumed:
      return "assumed, the file does not say";
    case wheelrail::ReadingBasis::forced:
      return "by option";
  }
  return "unknown";
}

// What the options say of all files.
struct FileOptions {
  std::optional<double> noise{};  // [m]; none: estimated
  bool repair = false;
  std::optional<wheelrail::LengthUnit> unit{};
  std::optional<wheelrail::LateralAxis> lateral{};
  std::optional<wheelrail::ValueAxis> value{};

  // `kind` is "wheel" or "rail".
  [[nodiscard]] static FileOptions of(const Arguments& arguments, const std::string& kind) {
    using wheelrail::LateralAxis, wheelrail::LengthUnit, wheelrail::ValueAxis;
    FileOptions options;
    if (arguments.text("--noise") != "estimate") {
      options.noise = 1e-6 * arguments.within("--noise", 0, 1000);
    }
    options.repair = arguments.given("--repair");
    const std::string unit = arguments.choice("--unit", {"detect", "mm", "m"});
    if (unit != "detect") options.unit = unit == "mm" ? LengthUnit::millimetre : LengthUnit::metre;
    const std::string prefix = std::string("--").append(kind);
    const std::string lateral = arguments.choice(prefix + "-lateral", {"detect", "field", "gauge"});
    if (lateral != "detect") {
      options.lateral = lateral == "field" ? LateralAxis::field_side : LateralAxis::gauge_side;
    }
    const std::string value = arguments.choice(prefix + "-value", {"detect", "outward", "inward"});
    if (value != "detect") {
      options.value = value == "outward" ? ValueAxis::outward : ValueAxis::inward;
    }
    return options;
  }
};

namespace detail {

[[nodiscard]] inline std::string described(const wheelrail::PointFinding<double>& finding,
                                           const wheelrail::ProfilePoints<double>& points) {
  std::string text = format("point %zu", finding.index);
  if (finding.index < points.size()) {
    text.append(format(" at (%.6g, %.6g) mm", 1e3 * points.lateral[finding.index],
                       1e3 * points.value[finding.index]));
  }
  const bool is_count = finding.defect == wheelrail::PointDefect::too_few_points;
  return text.append(": ")
      .append(wheelrail::to_string(finding.defect))
      .append(is_count ? format(", %g", finding.measure)
                       : format(", %.4g mm", 1e3 * finding.measure));
}

// The level that is given; or that which the points tell of, where it is above a nanometre;
// otherwise none: they are interpolated.
[[nodiscard]] inline double noise_of(const wheelrail::ProfilePoints<double>& points,
                                     const FileOptions& options) {
  if (options.noise) return *options.noise;
  const double estimate = wheelrail::estimated_noise(points.lateral, points.value);
  return estimate < 1e-9 ? 0.0 : estimate;
}

// The points to go on with. Without repair nothing may be wrong with them but zig-zags that the
// noise explains: the smoothing deals with these.
[[nodiscard]] inline wheelrail::ProfilePoints<double> checked_points(
    const wheelrail::ProfilePoints<double>& points, const FileOptions& options,
    std::vector<std::string>& notes) {
  if (options.repair) {
    auto repair = wheelrail::repair_points(points);
    notes.push_back(format("repaired: %zu of %zu points dropped, %zu kept",
                           points.size() - repair.points.size(), points.size(),
                           repair.points.size()));
    constexpr std::size_t listed = 20;
    for (std::size_t i = 0; i < repair.repaired.size() && i < listed; ++i) {
      notes.push_back(std::string("  ").append(described(repair.repaired[i], points)));
    }
    if (repair.repaired.size() > listed) {
      notes.push_back(format("  and %zu more", repair.repaired.size() - listed));
    }
    return std::move(repair.points);
  }
  std::size_t defects = 0;
  bool is_repairable = true;
  std::string first;
  for (const auto& finding : wheelrail::diagnose_points(points)) {
    const bool is_noise = finding.defect == wheelrail::PointDefect::zig_zag &&
                          finding.measure < 6 * noise_of(points, options);
    if (is_noise) continue;
    // The first that stands in the way of a repair, or else the first.
    const bool is_graver = is_repairable && !wheelrail::is_repairable(finding.defect);
    if (defects++ == 0 || is_graver) first = described(finding, points);
    if (is_graver) is_repairable = false;
  }
  if (defects > 0) {
    throw std::invalid_argument(
        format("defects in the points: %zu, but there must be none: ", defects)
            .append(first)
            .append(is_repairable ? " (--repair drops such points)"
                                  : " (no --repair can mend that)"));
  }
  return points;
}

[[nodiscard]] inline MeasuredProfile read_measured(const std::string& path,
                                                   wheelrail::ProfileKind kind,
                                                   const FileOptions& options,
                                                   std::vector<std::string>& notes) {
  const auto file = wheelrail::read_profile<double>(
      path, kind,
      {.format = {}, .unit = options.unit, .value = options.value, .lateral = options.lateral});
  notes.push_back(format("%s, %zu points", name_of(file.format), file.points.size()));
  const double units = file.units_per_metre.value;
  const std::string unit = units == 1000 ? "mm" : (units == 1 ? "m" : format("1/%.9g m", units));
  notes.push_back(std::string("unit: ").append(unit).append(
      format(" (%s)", name_of(file.units_per_metre.basis))));
  notes.push_back(
      format("lateral grows to the %s side (%s)",
             file.lateral.value == wheelrail::LateralAxis::field_side ? "field" : "gauge or flange",
             name_of(file.lateral.basis)));
  notes.push_back(format("value grows %s the body (%s)",
                         file.value.value == wheelrail::ValueAxis::outward ? "out of" : "into",
                         name_of(file.value.basis)));
  if (file.reversed) notes.push_back("points run from the field side: turned round");
  for (const std::string& key : file.not_applied) {
    notes.push_back(std::string("not applied: ").append(key.substr(0, 80)));
  }
  const auto points = [&] {
    try {
      return checked_points(file.points, options, notes);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(std::string(path).append(": ").append(error.what()));
    }
  }();
  try {
    MeasuredProfile profile(points.lateral, points.value, {.noise = noise_of(points, options)});
    const auto& report = profile.report();
    notes.push_back(format(
        "%s: noise level %g um, deviation %.3g um (root mean square), %.3g um at most, at point %d",
        report.status == wheelrail::SmoothingStatus::interpolating ? "interpolated" : "smoothed",
        1e6 * report.noise, 1e6 * report.rms_deviation, 1e6 * report.greatest_deviation,
        report.greatest_deviation_index));
    notes.push_back(format("from %.6g to %.6g mm, least radius of curvature %.4g mm at %.5g mm",
                           1e3 * profile.lower(), 1e3 * profile.upper(), 1e3 * report.least_radius,
                           1e3 * report.greatest_curvature_lateral));
    return profile;
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string(path).append(": ").append(error.what()));
  }
}

// Whether a value is one of the names; otherwise it must be a file.
[[nodiscard]] inline bool is_name(const std::string& value, const std::string& option,
                                  const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) {
    if (name == value) return true;
    list.append(name).append(", ");
  }
  std::error_code ignored;
  if (value.empty() || !std::filesystem::exists(value, ignored)) {
    throw std::invalid_argument(std::string(option)
                                    .append(" is '")
                                    .append(value)
                                    .append("', but must be ")
                                    .append(list)
                                    .append("or a file that is there"));
  }
  return false;
}

}  // namespace detail

// The wheel that an option names. Throws with the option's name.
[[nodiscard]] inline LoadedProfile<AnyWheel> load_wheel(const Arguments& arguments,
                                                        const std::string& option) {
  const std::string value = arguments.text(option);
  if (detail::is_name(value, option, wheel_names)) {
    return value == "s1002"
               ? LoadedProfile<AnyWheel>{AnyWheel(wheelrail::s1002<double>()), value, {}}
               : LoadedProfile<AnyWheel>{
                     AnyWheel(ConvexWheel(wheelrail::s1002<double>())), value, {}};
  }
  std::vector<std::string> notes;
  try {
    const AnyWheel wheel(detail::read_measured(value, wheelrail::ProfileKind::wheel,
                                               FileOptions::of(arguments, "wheel"), notes));
    if (!(wheel.lower() < 0 && 0 < wheel.upper())) {
      throw std::invalid_argument(
          format("the points go from %g to %g mm, but must reach over the tread circle, lateral 0",
                 1e3 * wheel.lower(), 1e3 * wheel.upper()));
    }
    notes.push_back(format("at the tread circle the radius is the nominal one %+.4f mm",
                           plain(1e3 * wheel.evaluate(0.0).value)));
    return {wheel, value, notes};
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string(option).append(": ").append(error.what()));
  }
}

// The rail that an option names. Throws with the option's name.
[[nodiscard]] inline LoadedProfile<AnyRail> load_rail(const Arguments& arguments,
                                                      const std::string& option) {
  const std::string value = arguments.text(option);
  if (detail::is_name(value, option, rail_names)) {
    return {AnyRail(rail_profile(value)), value, {}};
  }
  std::vector<std::string> notes;
  try {
    const AnyRail rail(detail::read_measured(value, wheelrail::ProfileKind::rail,
                                             FileOptions::of(arguments, "rail"), notes));
    return {rail, value, notes};
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string(option).append(": ").append(error.what()));
  }
}

// A track whose rails may be laid by the height of their profiles' origins: the gauge is then
// measured 14 mm under height 0 of the profile, not 14 mm under its highest point.
class LaidTrack {
 public:
  LaidTrack(AnyRail left, AnyRail right, const wheelrail::TrackDimensions<double>& dimensions,
            bool by_origin)
      : track_(std::move(left), std::move(right), dimensions) {
    if (!by_origin) return;
    for (const wheelrail::Side side : wheelrail::sides) {
      const double origin = dimensions.gauge / 2 - gauge_lateral(track_.rail(side).profile(), side);
      const double seat = std::abs(track_.nearest_frame(side, {0, 0, 0}).origin_track.y());
      offsets_[index_of(side)] = origin - seat;
    }
  }

  [[nodiscard]] const wheelrail::Rail<AnyRail>& rail(wheelrail::Side side) const {
    return track_.rail(side);
  }
  [[nodiscard]] const wheelrail::TrackDimensions<double>& dimensions() const {
    return track_.dimensions();
  }
  [[nodiscard]] double head_distance() const {
    return track_.head_distance() + offsets_[0] + offsets_[1];
  }
  [[nodiscard]] wheelrail::RailFrame<double> nearest_frame(
      wheelrail::Side side, const wheelrail::Vector3<double>& point_track, double guess = 0) const {
    auto frame = track_.nearest_frame(side, point_track, guess);
    frame.origin_track.y() += wheelrail::outboard_sign<double>(side) * offsets_[index_of(side)];
    return frame;
  }
  // How much farther to the outside a rail lies than by its highest point [m].
  [[nodiscard]] double offset(wheelrail::Side side) const { return offsets_[index_of(side)]; }

 private:
  // Where the gauge side passes 14 mm below height 0. Smoothing moves the ends of points by some um:
  // an end that lies up to 0.1 mm too high goes on along its tangent.
  [[nodiscard]] static double gauge_lateral(const AnyRail& rail, wheelrail::Side side) {
    const double depth = 0.014, slack = 1e-4;
    const auto above = [&](double u) { return rail.evaluate(u).value + depth; };
    const auto end = rail.evaluate(rail.lower());
    double left = rail.lower();
    if (above(left) > 0 && above(left) <= slack && end.slope > 0) {
      return left - above(left) / end.slope;
    }
    for (int piece = 0; piece < rail.piece_count(); ++piece) {
      const double right = rail.joint(piece + 1);
      if (above(left) <= 0 && 0 < above(right)) {
        return wheelrail::bracketed_root<double>(above, left, right, above(left), above(right))
            .position;
      }
      left = right;
    }
    throw std::invalid_argument(
        format("--track-profile: the %s rail's gauge side ends at height %.4g mm: it must "
               "reach from -14 mm, where the gauge is measured, upwards",
               name_of(side), 1e3 * end.value));
  }

  wheelrail::TangentTrack<AnyRail> track_;
  std::array<double, 2> offsets_{0, 0};  // [m], to the field side
};

}  // namespace examples
