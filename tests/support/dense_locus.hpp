#pragma once
// An oracle for the zones of one wheel on one rail: its contact locus, sampled densely, against the
// arcs of a rail head. It shares no formula with the contact search: of the library it takes the
// wheel profile's values and slopes, and where the profile's pieces join.
//
// The locus is written with vectors. A strip is the circle of radius R = R0 + F about the axle's
// point o + u a; the surface's normal at the radius' direction e is e - F' a. It lies in the rail's
// cross-section where e_x = F' a_x, which leaves one e that points down.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <vector>

#include "support/brute_force_contact.hpp"

namespace wheelrail_test {

// The strips that are looked at, evaluated once: at most `spacing` apart along the profile, and the
// joints.
struct StripTable {
  std::vector<double> lateral, radius, slope;

  template <class WheelProfile>
  StripTable(const WheelProfile& profile, double nominal_radius, double spacing) {
    for (int piece = 0; piece < profile.piece_count(); ++piece) {
      const double upper = profile.joint(piece + 1);
      for (double u = profile.joint(piece); u < upper;) {
        const auto point = profile.evaluate(piece, u);
        lateral.push_back(u);
        radius.push_back(nominal_radius + point.value);
        slope.push_back(point.slope);
        u += spacing / std::hypot(1.0, point.slope);
      }
    }
    const auto end = profile.evaluate(profile.piece_count() - 1, profile.upper());
    lateral.push_back(profile.upper());
    radius.push_back(nominal_radius + end.value);
    slope.push_back(end.slope);
  }
  [[nodiscard]] std::size_t size() const { return lateral.size(); }
};

// A run of strips whose locus lies under the rail's surface.
struct LocusZone {
  double lateral = 0.0, penetration = 0.0;  // of its deepest point
  // Its ends lie between these samples.
  double outside_lower = 0.0, inside_lower = 0.0, inside_upper = 0.0, outside_upper = 0.0;
  double gap = -1.0;    // the least depth between it and the next zone
  bool is_cut = false;  // it ends with the profile
};

template <class WheelProfile>
class DenseLocus {
 public:
  DenseLocus(const WheelProfile& profile, double nominal_radius, const StripTable& table,
             const ArcRail& rail, const RailStand& stand)
      : profile_(profile),
        nominal_radius_(nominal_radius),
        table_(table),
        rail_(rail),
        stand_(stand),
        cosine_(std::cos(stand.lean)),
        sine_(std::sin(stand.lean)) {}

  // The left wheel of a wheelset.
  void place(const WheelsetPose& pose) {
    const auto origin = pose.wheel_origin(wheelrail::Side::left);
    const auto axle = pose.axle_outwards(wheelrail::Side::left);
    const double out = origin[1] - stand_.y, up = origin[2] - stand_.z;
    y_ = cosine_ * out + sine_ * up;
    z_ = cosine_ * up - sine_ * out;
    axle_x_ = axle[0];
    axle_y_ = cosine_ * axle[1] + sine_ * axle[2];
    axle_z_ = cosine_ * axle[2] - sine_ * axle[1];
    in_section_ = std::sqrt(1.0 - axle_x_ * axle_x_);
    const std::size_t count = table_.size();
    points_.resize(count);
    arc_length_.assign(count, 0.0);
    first_ = 0;
    for (std::size_t i = 0; i < count; ++i) {
      points_[i] = point(table_.lateral[i], table_.radius[i], table_.slope[i]);
      if (!points_[i].exists) {
        if (first_ != i) throw std::logic_error("the locus ends within the profile");
        first_ = i + 1;
      } else if (i > first_) {
        arc_length_[i] = arc_length_[i - 1] + std::hypot(points_[i].y - points_[i - 1].y,
                                                         points_[i].z - points_[i - 1].z);
      }
    }
    hint_ = first_;
  }

  void lift(double by) {
    y_ += sine_ * by;
    z_ += cosine_ * by;
  }

  // The depth of the locus under the rail's surface, negative above it.
  [[nodiscard]] double depth(double lateral) const {
    return depth(profile_.evaluate(lateral), lateral);
  }

  // The same; at a joint, where a profile of rounded numbers may jump by a few 10 pm, that one of
  // its two limits which is nearer to `expected`.
  [[nodiscard]] double depth_near(double expected, double lateral) const {
    double best = depth(lateral);
    for (int piece = 0; piece < profile_.piece_count(); ++piece) {
      if (lateral != profile_.joint(piece + 1)) continue;
      const double other = depth(profile_.evaluate(piece, lateral), lateral);
      if (std::abs(other - expected) < std::abs(best - expected)) best = other;
    }
    return best;
  }

  // The greatest depth, of every stride-th strip or refined. No point is deeper than another by
  // more than their distance, which leaves most out.
  [[nodiscard]] double deepest(std::size_t stride) {
    std::size_t at = hint_;
    double best = depth_of(points_[at]);
    for (std::size_t i = first_; i < points_.size();) {
      const double here = depth_of(points_[i]);
      if (best < here) {
        best = here;
        at = i;
      }
      const double start = arc_length_[i];
      i += stride;
      while (i < points_.size() && arc_length_[i] - start < best - here) i += stride;
    }
    hint_ = at;
    if (stride > 1 || at == first_ || at + 1 == points_.size()) return best;
    return extremum(table_.lateral[at - 1], table_.lateral[at + 1], 1.0, 2e-9).depth;
  }

  // Lifts or lowers the wheel until deepest() is `target` [m] to 0.1 %. The depth falls with the
  // height, at a steep flange a third as fast. By how much it was lifted; nothing after 60 steps.
  [[nodiscard]] std::optional<double> set_deepest(double target) {
    double height = 0.0, high = 1.0, low = -1.0, rate = 1.0;
    std::size_t stride = 8;
    for (int i = 0; i < 60; ++i) {
      const double error = deepest(stride) - target;
      if (stride > 1 && std::abs(error) < 2e-5) {
        stride = 1;
        continue;
      }
      if (stride == 1 && std::abs(error) < 1e-3 * std::abs(target)) return height;
      (error > 0 ? low : high) = height;
      double next = height + error / rate;
      if (!(low < next && next < high)) next = (low + high) / 2;
      const double before = error;
      lift(next - height);
      const double after = deepest(stride) - target;
      rate = std::clamp((before - after) / (next - height), 0.2, 1.0);
      height = next;
    }
    return std::nullopt;
  }

  // All zones, in the order of lateral. Between two neighbouring strips the depth is taken to have
  // one extremum at most; near zero, within 0.2 um, between eighths of them.
  [[nodiscard]] const std::vector<LocusZone>& zones() {
    sample();
    refine();
    assemble();
    return zones_;
  }

  // Whether a zone was seen under the rail's sides where the given profile has none.
  [[nodiscard]] bool reaches_below(double side_depth, double side_slope) const {
    const double rise = side_slope / std::hypot(1.0, side_slope);
    return std::any_of(samples_.begin(), samples_.end(), [&](const Sample& s) {
      if (!(s.depth > 0.0)) return false;
      const auto at = profile_.evaluate(s.lateral);
      const Point p = point(s.lateral, nominal_radius_ + at.value, at.slope);
      return z_ + p.z + s.depth * rise < -side_depth;
    });
  }

 private:
  struct Point {
    double y, z;  // from the profile's origin, in the rail's section
    bool exists;
  };
  struct Sample {
    double lateral, depth;
    bool is_joined;  // nothing was left out before it
  };

  [[nodiscard]] Point point(double lateral, double radius, double slope) const {
    // e = along b + down d: b is x less its part along the axle, d is down and across the axle.
    const double along = slope * axle_x_ / in_section_;
    if (!(along * along < 1.0)) return {0.0, 0.0, false};
    const double down = std::sqrt(1.0 - along * along);
    const double b = -axle_x_ / in_section_ * along;
    const double e_y = b * axle_y_ + down * axle_z_ / in_section_;
    const double e_z = b * axle_z_ - down * axle_y_ / in_section_;
    return {lateral * axle_y_ + radius * e_y, lateral * axle_z_ + radius * e_z, true};
  }

  template <class ProfilePoint>
  [[nodiscard]] double depth(const ProfilePoint& at, double lateral) const {
    const Point p = point(lateral, nominal_radius_ + at.value, at.slope);
    return p.exists ? depth_of(p) : -1.0;
  }

  [[nodiscard]] double depth_of(const Point& p) const { return rail_.depth(y_ + p.y, z_ + p.z); }

  // By golden section: of sign * depth the greatest.
  [[nodiscard]] Sample extremum(double lower, double upper, double sign, double width) const {
    constexpr double golden = 0.6180339887498949;
    double a = upper - golden * (upper - lower), b = lower + golden * (upper - lower);
    double at_a = depth(a), at_b = depth(b);
    while (upper - lower > width) {
      if (sign * at_a < sign * at_b) {
        lower = a;
        a = b;
        at_a = at_b;
        b = lower + golden * (upper - lower);
        at_b = depth(b);
      } else {
        upper = b;
        b = a;
        at_b = at_a;
        a = upper - golden * (upper - lower);
        at_a = depth(a);
      }
    }
    return sign * at_a < sign * at_b ? Sample{b, at_b, true} : Sample{a, at_a, true};
  }

  void sample() {
    samples_.clear();
    bool is_joined = false;
    for (std::size_t i = first_; i < points_.size();) {
      const Sample here{table_.lateral[i], depth_of(points_[i]), is_joined};
      if (is_joined) {
        const Sample before = samples_.back();
        const bool near_zero =
            std::max(before.depth, here.depth) > -2e-7 && std::min(before.depth, here.depth) < 2e-7;
        for (int k = 1; near_zero && k < 8; ++k) {
          const double u = before.lateral + (here.lateral - before.lateral) * k / 8;
          samples_.push_back({u, depth(u), true});
        }
      }
      samples_.push_back(here);
      // What cannot rise above half the depth that is missing here.
      std::size_t next = i + 1;
      while (next + 1 < points_.size() &&
             arc_length_[next + 1] - arc_length_[i] < -0.5 * here.depth) {
        ++next;
      }
      is_joined = next == i + 1;
      i = next;
    }
  }

  // Puts in the extrema: maxima that may reach the surface, minima that may part two zones.
  void refine() {
    extrema_.clear();
    for (std::size_t i = 1; i + 1 < samples_.size(); ++i) {
      const Sample &before = samples_[i - 1], &at = samples_[i], &after = samples_[i + 1];
      if (!at.is_joined || !after.is_joined || at.depth < -1e-6) continue;
      const bool is_top = at.depth >= before.depth && at.depth >= after.depth;
      const bool is_bottom = at.depth <= before.depth && at.depth <= after.depth && at.depth < 1e-6;
      if (is_top || is_bottom) {
        extrema_.push_back(extremum(before.lateral, after.lateral, is_top ? 1.0 : -1.0, 2e-9));
      }
    }
    const auto middle = static_cast<std::ptrdiff_t>(samples_.size());
    samples_.insert(samples_.end(), extrema_.begin(), extrema_.end());
    std::inplace_merge(samples_.begin(), samples_.begin() + middle, samples_.end(),
                       [](const Sample& a, const Sample& b) { return a.lateral < b.lateral; });
  }

  void assemble() {
    zones_.clear();
    bool is_open = false;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const Sample& at = samples_[i];
      if (at.depth > 0.0) {
        if (!is_open) {
          const double outside = i > 0 ? samples_[i - 1].lateral : at.lateral;
          zones_.push_back({at.lateral, at.depth, outside, at.lateral, at.lateral, at.lateral, 0.0,
                            i == 0 || !at.is_joined});
        }
        LocusZone& zone = zones_.back();
        if (zone.penetration < at.depth) {
          zone.penetration = at.depth;
          zone.lateral = at.lateral;
        }
        zone.inside_upper = zone.outside_upper = at.lateral;
        zone.is_cut = zone.is_cut || i + 1 == samples_.size();
        is_open = true;
      } else {
        if (is_open) zones_.back().outside_upper = at.lateral;
        if (!zones_.empty()) zones_.back().gap = std::min(zones_.back().gap, at.depth);
        is_open = false;
      }
    }
  }

  const WheelProfile& profile_;
  double nominal_radius_;
  const StripTable& table_;
  const ArcRail& rail_;
  RailStand stand_;
  double cosine_, sine_;
  double y_ = 0.0, z_ = 0.0;  // the wheel profile's origin, rail frame
  double axle_x_ = 0.0, axle_y_ = 1.0, axle_z_ = 0.0, in_section_ = 1.0;
  std::vector<Point> points_;
  std::vector<double> arc_length_;
  std::size_t first_ = 0, hint_ = 0;
  std::vector<Sample> samples_, extrema_;
  std::vector<LocusZone> zones_;
};

}  // namespace wheelrail_test
