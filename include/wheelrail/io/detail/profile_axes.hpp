#pragma once
// Unit and axes of a profile file, from its points where the file does not state them. May
// include: core, io.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>
#include <wheelrail/io/detail/profile_text.hpp>

namespace wheelrail::detail {

struct ProfileAxes {
  Reading<double> units_per_metre{};
  Reading<ValueAxis> value{};
  Reading<LateralAxis> lateral{};
};

[[nodiscard]] inline double extent_of(const std::vector<double>& coordinates) {
  const auto [least, greatest] = std::minmax_element(coordinates.begin(), coordinates.end());
  return *greatest - *least;
}

// Of lengths in no stated unit: millimetres where the lateral extent is over 1, for no profile is
// wider than a metre.
[[nodiscard]] inline Reading<double> read_units(const ProfileText& text, const RawProfile& raw,
                                                const ProfileReadOptions& options) {
  const double extent = extent_of(raw.lateral);
  Reading<double> units{extent > 1 ? 1000.0 : 1.0, ReadingBasis::detected};
  if (options.unit) {
    units = {*options.unit == LengthUnit::millimetre ? 1000.0 : 1.0, ReadingBasis::forced};
  } else if (raw.units_per_metre) {
    units = {*raw.units_per_metre, ReadingBasis::stated};
  }
  const double widest = std::max(extent, extent_of(raw.value));
  if (!(0 < extent) || !(widest <= units.value) || !(1e-3 * units.value <= widest)) {
    text.refuse(raw.lines.front(),
                joined({"the profile is ", to_text(extent / units.value), " m wide and ",
                        to_text(extent_of(raw.value) / units.value),
                        " m high, but must be wider than 0 and from 0.001 to 1 m in size (a unit "
                        "given as an option may help)"}));
  }
  return units;
}

// The levels of a profile, each with the lateral width that lies at it: upright faces count for
// nothing and single bad points for little.
class ProfileLevels {
 public:
  explicit ProfileLevels(const RawProfile& raw) {
    for (std::size_t i = 1; i < raw.lateral.size(); ++i) {
      const double width = std::abs(raw.lateral[i] - raw.lateral[i - 1]);
      segments_.push_back({(raw.value[i] + raw.value[i - 1]) / 2, width,
                           (raw.lateral[i] + raw.lateral[i - 1]) / 2});
      width_ += width;
    }
    std::sort(segments_.begin(), segments_.end(),
              [](const Segment& a, const Segment& b) { return a.level < b.level; });
  }

  // What that share of the width lies below.
  [[nodiscard]] double at(double share) const {
    double below = 0;
    for (const Segment& segment : segments_) {
      below += segment.width;
      if (below >= share * width_) return segment.level;
    }
    return segments_.back().level;
  }

  // The mean lateral coordinate of what lies at @p lowest or above, up to @p highest.
  [[nodiscard]] double lateral_between(double lowest, double highest) const {
    double sum = 0, width = 0;
    for (const Segment& segment : segments_) {
      if (segment.level < lowest || segment.level > highest) continue;
      sum += segment.width * segment.lateral;
      width += segment.width;
    }
    return sum / width;
  }

  [[nodiscard]] double least() const { return segments_.front().level; }
  [[nodiscard]] double greatest() const { return segments_.back().level; }

 private:
  struct Segment {
    double level = 0, width = 0, lateral = 0;
  };
  std::vector<Segment> segments_;
  double width_ = 0;
};

// A wheel's flange stands out of the tread by more than anything stands in, a rail's sides lie
// deeper under its top than anything stands out: by half as much again, or it is not clear. Tread
// and top are the level that half of the width lies below; the highest and the lowest twentieth of
// the width do not count. On a wheel the flange is the gauge side. A rail's shape does not tell
// its sides apart: its file is taken to be in the library's own axis.
[[nodiscard]] inline ProfileAxes read_axes(const ProfileText& text, const RawProfile& raw,
                                           ProfileKind kind, const ProfileReadOptions& options) {
  ProfileAxes axes;
  axes.units_per_metre = read_units(text, raw, options);
  const std::size_t line = raw.lines.front();
  const ProfileLevels levels(raw);
  const double low = levels.at(0.05), middle = levels.at(0.5), high = levels.at(0.95);

  if (options.value) {
    axes.value = {*options.value, ReadingBasis::forced};
  } else if (raw.axes_stated) {
    axes.value = {ValueAxis::outward, ReadingBasis::stated};
  } else {
    const double above = high - middle, below = middle - low;
    if (std::max(above, below) < 1.5 * std::min(above, below) || above == below) {
      text.refuse(line, joined({"the points reach ", to_text(above), " above and ", to_text(below),
                                " below their median level, but one must be 1.5 times the other "
                                "for the vertical axis to be told; give it as an option"}));
    }
    const bool is_outward = (above > below) == (kind == ProfileKind::wheel);
    axes.value = {is_outward ? ValueAxis::outward : ValueAxis::inward, ReadingBasis::detected};
  }

  if (options.lateral) {
    axes.lateral = {*options.lateral, ReadingBasis::forced};
  } else if (raw.axes_stated) {
    axes.lateral = {LateralAxis::field_side, ReadingBasis::stated};
  } else if (kind == ProfileKind::rail) {
    axes.lateral = {LateralAxis::field_side, ReadingBasis::assumed};
  } else {
    const double flange = axes.value.value == ValueAxis::outward
                              ? levels.lateral_between(high, levels.greatest())
                              : levels.lateral_between(levels.least(), low);
    const double least = *std::min_element(raw.lateral.begin(), raw.lateral.end());
    const double share = (flange - least) / extent_of(raw.lateral);
    if (!(share <= 0.4 || 0.6 <= share)) {
      text.refuse(line, joined({"the greatest radius lies at ", to_text(share),
                                " of the width, but must be off the middle, 0.4 to 0.6, for the "
                                "flange to be told; give the lateral axis as an option"}));
    }
    axes.lateral = {share < 0.5 ? LateralAxis::field_side : LateralAxis::gauge_side,
                    ReadingBasis::detected};
  }
  return axes;
}

}  // namespace wheelrail::detail
