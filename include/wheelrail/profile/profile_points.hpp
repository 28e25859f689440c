#pragma once
/// @file
/// Measured cross-sections as ordered points: what is wrong with them, and the repair of what can
/// be repaired without guessing. For construction, not for the hot path: these functions allocate.
/// May include: core, profile.

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>
#include <wheelrail/core/require.hpp>
#include <wheelrail/core/scalar.hpp>

namespace wheelrail {

/// A cross-section as points in the order in which it is run through, from the flange (or gauge)
/// side to the field side, in the profile's own axes. As measured: nothing is promised but what
/// repair_points() returns.
template <Real T>
struct ProfilePoints {
  std::vector<T> lateral{};  ///< [m], growing towards the field side
  std::vector<T> value{};    ///< [m], outward: wheel radius above nominal, or rail height

  /// The number of points. @pre lateral and value are equally long.
  [[nodiscard]] std::size_t size() const { return lateral.size(); }
};

/// What is found in measured points; the comments say what the finding's measure is.
enum class PointDefect {
  not_finite,        ///< a coordinate is NaN or infinite; measure: that coordinate
  too_few_points,    ///< fewer than 4 are left after the repair; measure: how many
  reversed,          ///< all points run from the field side; measure: last less first lateral [m]
  duplicate,         ///< lies on the point before; measure: their distance [m]
  spike,             ///< one point stands off its neighbours; measure: how far [m]
  several_sections,  ///< the points start again; measure: the lateral step back [m]
  overhang,   ///< an end that turns back or is too steep; measure: lateral from the new end [m]
  zig_zag,    ///< lateral goes back a little, or stands; measure: out of order by [m]
  unordered,  ///< as a zig-zag, but farther back; measure: out of order by [m]
  gap         ///< far from the point before; measure: their distance [m]
};

/// Whether repair_points() mends @p defect: it turns reversed points round, and drops duplicates,
/// spikes, overhanging ends and the points of zig-zags.
[[nodiscard]] constexpr bool is_repairable(PointDefect defect) {
  return defect == PointDefect::reversed || defect == PointDefect::duplicate ||
         defect == PointDefect::spike || defect == PointDefect::overhang ||
         defect == PointDefect::zig_zag;
}

/// @p defect in words.
[[nodiscard]] constexpr const char* to_string(PointDefect defect) {
  switch (defect) {
    case PointDefect::not_finite:
      return "not finite";
    case PointDefect::too_few_points:
      return "too few points";
    case PointDefect::reversed:
      return "reversed";
    case PointDefect::duplicate:
      return "duplicate";
    case PointDefect::spike:
      return "spike";
    case PointDefect::several_sections:
      return "several sections";
    case PointDefect::overhang:
      return "overhang";
    case PointDefect::zig_zag:
      return "zig-zag";
    case PointDefect::unordered:
      return "unordered";
    case PointDefect::gap:
      return "gap";
  }
  return "unknown";
}

/// One defect of measured points.
template <Real T>
struct PointFinding {
  PointDefect defect{};  ///< which one it is
  std::size_t index{};   ///< of the point among those given, from 0
  T measure = T(0);      ///< as PointDefect says
};

/// From where on a point is a defect. Lengths are those of measured profiles of some 0.1 m with a
/// noise of some 0.01 mm.
template <Real T>
struct PointLimits {
  /// Duplicate: distance < minimum_step [m]. Repaired points are laterally at least so far apart.
  T minimum_step = constant<T>(1e-7L);
  /// Spike: the distance from the line between the neighbours > spike_height [m] ...
  T spike_height = constant<T>(2e-4L);
  /// ... and > spike_ratio times what the neighbours stand off their own, without the point [-].
  T spike_ratio = T(4);
  /// Zig-zag: out of order by <= zig_zag_step [m]; unordered: by > zig_zag_step.
  T zig_zag_step = constant<T>(5e-4L);
  /// Overhang at an end also where |value step| > end_slope * lateral step [-].
  T end_slope = T(50);
  /// Gap: distance > gap_ratio * median distance of neighbours [-] ...
  T gap_ratio = T(20);
  /// ... and > gap_length [m].
  T gap_length = constant<T>(2e-3L);
  /// Repair drops at most this share of the points as spikes and zig-zags [-].
  T dropped_share = constant<T>(0.1L);
};

/// The points after their repair, and what was done.
template <Real T>
struct PointRepair {
  ProfilePoints<T> points{};                ///< finite, lateral strictly increasing, at least 4
  std::vector<PointFinding<T>> repaired{};  ///< by index; its indices are those before the repair
};

namespace detail {

inline constexpr std::size_t least_profile_points = 4;

// Goes through the points once, in the order of the repair. What a stage drops, the next ones do
// not see, so that one bad point is one finding.
template <Real T>
class PointExamination {
 public:
  PointExamination(const ProfilePoints<T>& points, const PointLimits<T>& limits)
      : points_(points), limits_(limits) {
    require(points.lateral.size() == points.value.size(),
            joined({"profile points: there are ", std::to_string(points.value.size()),
                    " values, but must be as many as laterals, ",
                    std::to_string(points.lateral.size())}));
    require_positive("point limits: minimum step", limits.minimum_step, "[m]");
    require_positive("point limits: spike height", limits.spike_height, "[m]");
    require_positive("point limits: spike ratio", limits.spike_ratio, "[-]");
    require_not_negative("point limits: zig-zag step", limits.zig_zag_step, "[m]");
    require_positive("point limits: end slope", limits.end_slope, "[-]");
    require_positive("point limits: gap ratio", limits.gap_ratio, "[-]");
    require_not_negative("point limits: gap length", limits.gap_length, "[m]");
    require_not_negative("point limits: dropped share", limits.dropped_share, "[-]");
    examine();
    std::stable_sort(findings_.begin(), findings_.end(),
                     [](const auto& a, const auto& b) { return a.index < b.index; });
  }

  [[nodiscard]] const std::vector<PointFinding<T>>& findings() const { return findings_; }
  [[nodiscard]] const std::vector<std::size_t>& kept() const { return kept_; }
  [[nodiscard]] const T& extent() const { return extent_; }
  [[nodiscard]] const T& median_distance() const { return median_distance_; }

 private:
  void examine() {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!is_finite(points_.lateral[i])) {
        add(PointDefect::not_finite, i, points_.lateral[i]);
      } else if (!is_finite(points_.value[i])) {
        add(PointDefect::not_finite, i, points_.value[i]);
      }
      kept_.push_back(i);
    }
    if (!findings_.empty()) return;
    turn_round();
    drop_duplicates();
    drop_spikes();
    if (kept_.size() >= least_profile_points && find_sections()) return;
    cut_overhangs();
    if (!drop_steps_back()) return;
    cut_steep_ends();
    find_gaps();
    if (kept_.size() < least_profile_points) {
      add(PointDefect::too_few_points, 0, T(static_cast<int>(kept_.size())));
    }
  }

  void add(PointDefect defect, std::size_t index, const T& measure) {
    findings_.push_back({defect, index, measure});
  }
  [[nodiscard]] const T& lateral(std::size_t k) const { return points_.lateral[kept_[k]]; }
  [[nodiscard]] const T& value(std::size_t k) const { return points_.value[kept_[k]]; }
  [[nodiscard]] T distance(std::size_t a, std::size_t b) const {
    using std::sqrt;
    return sqrt(T(square(T(lateral(b) - lateral(a))) + square(T(value(b) - value(a)))));
  }

  // From the point k to the line through the points a and b, or to a where these coincide.
  [[nodiscard]] T stand_off(std::size_t k, std::size_t a, std::size_t b) const {
    const T length = distance(a, b);
    if (length < limits_.minimum_step) return distance(a, k);
    const T x = lateral(k) - lateral(a), y = value(k) - value(a);
    return magnitude(T(x * (value(b) - value(a)) - y * (lateral(b) - lateral(a)))) / length;
  }

  void turn_round() {
    if (kept_.size() < 2) return;
    const T across = points_.lateral.back() - points_.lateral.front();
    if (!(across < T(0))) return;
    std::reverse(kept_.begin(), kept_.end());
    add(PointDefect::reversed, 0, across);
  }

  void drop_duplicates() {
    std::vector<std::size_t> rest;
    for (std::size_t k = 0, last = 0; k < kept_.size(); ++k) {
      if (0 < k && distance(last, k) < limits_.minimum_step) {
        add(PointDefect::duplicate, kept_[k], distance(last, k));
        continue;
      }
      rest.push_back(kept_[k]);
      last = k;
    }
    kept_ = std::move(rest);
  }

  // An end point has no neighbour on one side and is not judged. Two spikes side by side hide each
  // other.
  void drop_spikes() {
    const std::size_t n = kept_.size();
    if (n < least_profile_points) return;
    std::vector<std::size_t> rest{kept_[0]};
    for (std::size_t k = 1; k + 1 < n; ++k) {
      const T own = stand_off(k, k - 1, k + 1);
      T others = T(0);
      if (k >= 2) others = stand_off(k - 1, k - 2, k + 1);
      if (k + 2 < n) others = max(others, stand_off(k + 1, k - 1, k + 2));
      if (limits_.spike_height < own && limits_.spike_ratio * others < own) {
        add(PointDefect::spike, kept_[k], own);
      } else {
        rest.push_back(kept_[k]);
      }
    }
    rest.push_back(kept_[n - 1]);
    kept_ = std::move(rest);
  }

  // Few steps back over half of the extent: sections, one after the other.
  [[nodiscard]] bool find_sections() {
    const auto ends = std::minmax_element(
        kept_.begin(), kept_.end(),
        [this](std::size_t a, std::size_t b) { return points_.lateral[a] < points_.lateral[b]; });
    extent_ = points_.lateral[*ends.second] - points_.lateral[*ends.first];
    std::vector<PointFinding<T>> jumps;
    for (std::size_t k = 1; k < kept_.size(); ++k) {
      const T back = lateral(k - 1) - lateral(k);
      if (extent_ / T(2) < back) jumps.push_back({PointDefect::several_sections, kept_[k], back});
    }
    if (jumps.empty() || kept_.size() < 10 * jumps.size()) return false;
    findings_.insert(findings_.end(), jumps.begin(), jumps.end());
    return true;
  }

  void cut(std::size_t first, std::size_t last) {
    for (std::size_t k = 0; k < first; ++k) {
      add(PointDefect::overhang, kept_[k], magnitude(T(lateral(k) - lateral(first))));
    }
    for (std::size_t k = last + 1; k < kept_.size(); ++k) {
      add(PointDefect::overhang, kept_[k], magnitude(T(lateral(last) - lateral(k))));
    }
    kept_.resize(last + 1);
    kept_.erase(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(first));
  }

  // What lies before the last least lateral or after the first greatest one is an overhang where
  // it stays on its own half; else the points are unordered, which the next stage says.
  void cut_overhangs() {
    if (kept_.size() < 2) return;
    std::size_t first = 0, last = 0;
    for (std::size_t k = 1; k < kept_.size(); ++k) {
      if (!(lateral(first) < lateral(k))) first = k;
      if (lateral(last) < lateral(k)) last = k;
    }
    const T middle = (lateral(first) + lateral(last)) / T(2);
    for (std::size_t k = 0; k < first; ++k) {
      if (!(lateral(k) < middle)) return;
    }
    for (std::size_t k = last + 1; k < kept_.size(); ++k) {
      if (!(middle < lateral(k))) return;
    }
    if (first < last) cut(first, last);
  }

  // Keeps the most points whose laterals grow by minimum_step or more: the longest increasing
  // subsequence. tails[l] ends the chain of l + 1 points that ends least.
  // Returns whether no more than zig-zags went.
  [[nodiscard]] bool drop_steps_back() {
    if (kept_.empty()) return true;
    bool is_ordered = true;
    std::vector<std::size_t> tails, before(kept_.size(), 0);
    for (std::size_t k = 0; k < kept_.size(); ++k) {
      const auto place =
          std::partition_point(tails.begin(), tails.end(), [this, k](std::size_t tail) {
            return !(lateral(k) - lateral(tail) < limits_.minimum_step);
          });
      if (place != tails.begin()) before[k] = *(place - 1);
      if (place == tails.end()) {
        tails.push_back(k);
      } else if (lateral(k) < lateral(*place)) {
        *place = k;
      }
    }
    std::vector<std::size_t> chain(tails.size());
    std::size_t k = tails.back();
    for (std::size_t i = chain.size(); i > 0; --i, k = before[k]) chain[i - 1] = k;
    std::vector<std::size_t> rest;
    for (std::size_t j = 0, next = 0; j < kept_.size(); ++j) {
      if (next < chain.size() && chain[next] == j) {
        rest.push_back(kept_[j]);
        ++next;
        continue;
      }
      // How far it lies outside of where its kept neighbours leave room for it.
      T back = T(0);
      if (next > 0) back = max(back, T(lateral(chain[next - 1]) - lateral(j)));
      if (next < chain.size()) back = max(back, T(lateral(j) - lateral(chain[next])));
      const bool is_zig_zag = back <= limits_.zig_zag_step;
      is_ordered = is_ordered && is_zig_zag;
      add(is_zig_zag ? PointDefect::zig_zag : PointDefect::unordered, kept_[j], back);
    }
    kept_ = std::move(rest);
    return is_ordered;
  }

  void cut_steep_ends() {
    if (kept_.size() < 2) return;
    const auto steep = [this](std::size_t k) {
      return limits_.end_slope * magnitude(T(lateral(k + 1) - lateral(k))) <
             magnitude(T(value(k + 1) - value(k)));
    };
    std::size_t first = 0, last = kept_.size() - 1;
    while (first < last && steep(first)) ++first;
    while (first < last && steep(last - 1)) --last;
    cut(first, last);
  }

  void find_gaps() {
    if (kept_.size() < 2) return;
    std::vector<T> distances;
    for (std::size_t k = 1; k < kept_.size(); ++k) distances.push_back(distance(k - 1, k));
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    median_distance_ = *middle;
    for (std::size_t k = 1; k < kept_.size(); ++k) {
      const T own = distance(k - 1, k);
      if (limits_.gap_length < own && limits_.gap_ratio * median_distance_ < own)
        add(PointDefect::gap, kept_[k], own);
    }
  }

  const ProfilePoints<T>& points_;
  const PointLimits<T>& limits_;
  std::vector<PointFinding<T>> findings_;
  std::vector<std::size_t> kept_;
  T extent_ = T(0), median_distance_ = T(0);
};

template <Real T>
[[noreturn]] void refuse_points(const ProfilePoints<T>& points, const PointLimits<T>& limits,
                                const PointExamination<T>& examination,
                                const PointFinding<T>& finding) {
  const std::string measure = to_text(finding.measure);
  const std::string what = [&]() -> std::string {
    switch (finding.defect) {
      case PointDefect::not_finite:
        return joined({"a coordinate is ", measure, ", but must be finite"});
      case PointDefect::too_few_points:
        return joined({"there are ", measure, " points left, but there must be at least 4"});
      case PointDefect::several_sections:
        return joined(
            {"lateral goes back by ", measure, " m, but must not by more than half of its extent, ",
             to_text(examination.extent()), " m: there are several sections; give one of them"});
      case PointDefect::gap:
        return joined({"the point before is ", measure, " m away, but must be at most ",
                       to_text(limits.gap_ratio), " times the median distance, ",
                       to_text(examination.median_distance()), " m (gap)"});
      default:
        return joined({"lateral is out of order by ", measure, " m, but must be by at most ",
                       to_text(limits.zig_zag_step), " m (", to_string(finding.defect), ")"});
    }
  }();
  const std::size_t i = finding.index;
  throw_or_abort(i < points.size() ? joined({"profile points: point ", std::to_string(i), " at (",
                                             to_text(points.lateral[i]), ", ",
                                             to_text(points.value[i]), ") m: ", what})
                                   : joined({"profile points: ", what}));
}

}  // namespace detail

/// What is wrong with measured points, by index; nothing where repair_points() would return them as
/// they are. A point that one finding drops is not judged by the next ones; after a coordinate that
/// is not finite, several sections or unordered points nothing more is judged.
/// @param points finite or not, in any order, in metres.
/// @throws std::invalid_argument where there are not as many values as laterals or a limit is not
///   finite and positive.
/// @note Takes n log n steps. Spikes at an end and spikes side by side are not found.
template <Real T>
[[nodiscard]] std::vector<PointFinding<T>> diagnose_points(const ProfilePoints<T>& points,
                                                           const PointLimits<T>& limits = {}) {
  return detail::PointExamination<T>(points, limits).findings();
}

/// Measured points made a function value(lateral): turned round where they are reversed, without
/// duplicates, single spikes, overhanging or too steep ends (flange back, field face) and without
/// the fewest points that have to go for lateral to grow. No point is moved or made up.
/// @return finite points, lateral growing by minimum_step or more, and what was done.
/// @throws std::invalid_argument with the point's index, its value and the broken rule where a
///   defect is not repairable, where more than dropped_share would be dropped as spikes and
///   zig-zags, and as diagnose_points() does.
template <Real T>
[[nodiscard]] PointRepair<T> repair_points(const ProfilePoints<T>& points,
                                           const PointLimits<T>& limits = {}) {
  const detail::PointExamination<T> examination(points, limits);
  int dropped = 0;
  for (const PointFinding<T>& finding : examination.findings()) {
    if (!is_repairable(finding.defect)) {
      detail::refuse_points(points, limits, examination, finding);
    }
    if (finding.defect == PointDefect::spike || finding.defect == PointDefect::zig_zag) ++dropped;
  }
  detail::require(!(limits.dropped_share * T(static_cast<int>(points.size())) < T(dropped)),
                  detail::joined({"profile points: ", std::to_string(dropped), " of ",
                                  std::to_string(points.size()),
                                  " points are spikes or zig-zags, but their share must be <= ",
                                  detail::to_text(limits.dropped_share)}));
  PointRepair<T> repair;
  repair.repaired = examination.findings();
  for (const std::size_t i : examination.kept()) {
    repair.points.lateral.push_back(points.lateral[i]);
    repair.points.value.push_back(points.value[i]);
  }
  return repair;
}

}  // namespace wheelrail
