#pragma once
// An oracle for contact searches: the whole surface of a wheel, turned with the wheelset, against
// the arcs of a rail head, by brute force. It shares no formula with the library: of the library it
// takes the wheel profile's values (no derivatives), the rail head's dimensions and where the rail
// stands in the track.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>
#include <wheelrail/core/side.hpp>
#include <wheelrail/profile/rail_head.hpp>

namespace wheelrail_test {

// One wheel of a wheelset in the track frame (x forward, y left, z up): the axle points along
// Rz(yaw) Rx(roll) e_y, the profiles' origins are `spacing` apart. [m], [rad]
struct WheelsetPose {
  double lateral_shift = 0.0;
  double height = 0.0;  // of the axle's middle
  double roll = 0.0;
  double yaw = 0.0;
  double spacing = 1.5;

  using Point = std::array<double, 3>;

  // A vector of the wheelset's frame, in the track frame.
  [[nodiscard]] Point turned(const Point& v) const {
    const double cr = std::cos(roll), sr = std::sin(roll);
    const double cy = std::cos(yaw), sy = std::sin(yaw);
    const Point rolled{v[0], cr * v[1] - sr * v[2], sr * v[1] + cr * v[2]};
    return {cy * rolled[0] - sy * rolled[1], sy * rolled[0] + cy * rolled[1], rolled[2]};
  }
  // A point of the wheelset's frame, in the track frame.
  [[nodiscard]] Point placed(const Point& p) const {
    const Point t = turned(p);
    return {t[0], t[1] + lateral_shift, t[2] + height};
  }
  // The profile's origin of one wheel, track frame.
  [[nodiscard]] Point wheel_origin(wheelrail::Side side) const {
    return placed({0.0, side == wheelrail::Side::left ? spacing / 2 : -spacing / 2, 0.0});
  }
  // The axle's direction towards the field side of one wheel, track frame.
  [[nodiscard]] Point axle_outwards(wheelrail::Side side) const {
    return turned({0.0, side == wheelrail::Side::left ? 1.0 : -1.0, 0.0});
  }
  // The same wheelset seen in a mirror: the other side's contact must be the same.
  [[nodiscard]] WheelsetPose mirrored() const {
    return {-lateral_shift, height, -roll, -yaw, spacing};
  }
};

// A rail head of tangent arcs with straight sides; depth of points under its surface.
class ArcRail {
 public:
  // The two angles at which the arcs meet follow from width and depth by Newton's method.
  explicit ArcRail(const wheelrail::RailHeadDimensions<double>& d) {
    const double end_angle = std::atan2(1.0, d.side_slope);
    const double r1 = d.crown_radius, r2 = d.shoulder_radius, r3 = d.corner_radius;
    const double reach_y = d.width / 2 - r3 * std::sin(end_angle);
    const double reach_z = r1 - d.depth - r3 * std::cos(end_angle);
    double a = 0.03, b = 0.23;
    for (int i = 0; i < 50; ++i) {
      const double fy = (r1 - r2) * std::sin(a) + (r2 - r3) * std::sin(b) - reach_y;
      const double fz = (r1 - r2) * std::cos(a) + (r2 - r3) * std::cos(b) - reach_z;
      const double yy = (r1 - r2) * std::cos(a), yb = (r2 - r3) * std::cos(b);
      const double zz = -(r1 - r2) * std::sin(a), zb = -(r2 - r3) * std::sin(b);
      const double determinant = yy * zb - yb * zz;
      a -= (fy * zb - yb * fz) / determinant;
      b -= (yy * fz - fy * zz) / determinant;
    }
    arcs_[0] = {0.0, -r1, r1, 0.0, a};
    arcs_[1] = {(r1 - r2) * std::sin(a), -r1 + (r1 - r2) * std::cos(a), r2, a, b};
    arcs_[2] = {arcs_[1].y + (r2 - r3) * std::sin(b), arcs_[1].z + (r2 - r3) * std::cos(b), r3, b,
                end_angle};
    side_y_ = d.width / 2;
    side_z_ = -d.depth;
    side_sine_ = std::sin(end_angle);
    side_cosine_ = std::cos(end_angle);
  }

  // Depth of (y, z) under the surface, negative above it [m]: the least distance to all pieces.
  [[nodiscard]] double depth(double y, double z) const {
    y = std::abs(y);
    double nearest = 1e30, depth = 0.0;
    for (const Arc& arc : arcs_) {
      const double angle = std::atan2(y - arc.y, z - arc.z);
      const double distance = std::hypot(y - arc.y, z - arc.z);
      const double clamped = std::clamp(angle, arc.begin, arc.end);
      const double away = clamped == angle ? std::abs(arc.radius - distance)
                                           : std::hypot(y - arc.y - arc.radius * std::sin(clamped),
                                                        z - arc.z - arc.radius * std::cos(clamped));
      if (away < nearest) {
        nearest = away;
        depth = distance < arc.radius ? away : -away;
      }
    }
    const double outside = side_sine_ * (y - side_y_) + side_cosine_ * (z - side_z_);
    const double along = side_cosine_ * (y - side_y_) - side_sine_ * (z - side_z_);
    if (along > 0.0 && std::abs(outside) < nearest) depth = -outside;
    return depth;
  }

 private:
  struct Arc {
    double y, z, radius, begin, end;  // angles from upright
  };
  std::array<Arc, 3> arcs_{};
  double side_y_ = 0.0, side_z_ = 0.0, side_sine_ = 0.0, side_cosine_ = 0.0;
};

// Where a rail stands: its profile's origin in the track's section and its lean inwards.
struct RailStand {
  double y = 0.0, z = 0.0;  // [m]
  double lean = 0.0;        // [rad]
};

// A run of strips that reach under the rail's surface.
struct Zone {
  double lateral = 0.0;      // of the deepest strip
  double penetration = 0.0;  // of the deepest strip
  bool has_rival = false;    // another local maximum is within 1 nm of the deepest
  double lower = 0.0, upper = 0.0;
  double angle = 0.0;  // of the deepest point, about the axle
};

struct BruteForceResult {
  std::vector<Zone> zones;
  // The least distance from 0 of any minimum between two maxima: below 1 nm, whether two zones are
  // one is rounding.
  double saddle = 1e30;
};

// Zones are where the depth exceeds `level`; all depths here are those above it.
template <class WheelProfile>
class BruteForceContact {
 public:
  BruteForceContact(const WheelProfile& profile, double nominal_radius, const ArcRail& rail,
                    const RailStand& stand, wheelrail::Side side, const WheelsetPose& pose,
                    double level = 0.0)
      : profile_(profile),
        nominal_radius_(nominal_radius),
        rail_(rail),
        stand_(stand),
        sign_(side == wheelrail::Side::left ? 1.0 : -1.0),
        level_(level),
        across_(pose.turned({0.0, sign_, 0.0})),
        ahead_(pose.turned({1.0, 0.0, 0.0})),
        above_(pose.turned({0.0, 0.0, 1.0})),
        origin_(pose.wheel_origin(side)) {}

  // Depth under the rail of the wheel's point at `lateral`, `angle` from straight below,
  // right-handed about the axle's direction to the field side.
  [[nodiscard]] double depth(double lateral, double angle) const {
    return depth_of(lateral, nominal_radius_ + profile_.evaluate(lateral).value, angle);
  }

  // The greatest depth over the angle of one strip.
  struct Strip {
    double lateral, depth, angle;
  };
  [[nodiscard]] Strip strip(double lateral, double start_angle) const {
    const double radius = nominal_radius_ + profile_.evaluate(lateral).value;
    double angle = start_angle;
    double best = depth_of(lateral, radius, angle);
    for (int i = 0; i < 12; ++i) {
      constexpr double h = 2e-4;
      const double more = depth_of(lateral, radius, angle + h);
      const double less = depth_of(lateral, radius, angle - h);
      const double slope = (more - less) / (2 * h);
      const double bend = (more - 2 * best + less) / (h * h);
      double step = bend < -1e-3 ? -slope / bend : (slope > 0 ? 0.02 : -0.02);
      step = std::clamp(step, -0.05, 0.05);
      double value = depth_of(lateral, radius, angle + step);
      for (int k = 0; k < 20 && value < best - 1e-17; ++k) {
        step /= 2;
        value = depth_of(lateral, radius, angle + step);
      }
      if (value > best) {
        best = value;
        angle += step;
      }
      if (std::abs(step) < 1e-8) break;
    }
    return {lateral, best, angle};
  }

  // All zones: strips at most `fine` apart near the surface, every local extremum refined.
  [[nodiscard]] BruteForceResult zones(double coarse = 1e-4, double fine = 1e-5) const {
    // Nothing within half a strip's rise of the surface is passed over.
    const std::vector<Strip> rough = strips(profile_.lower(), profile_.upper(), coarse, 0.0);
    std::vector<Strip> dense;
    for (std::size_t i = 0; i + 1 < rough.size(); ++i) {
      dense.push_back(rough[i]);
      const double rise = std::abs(rough[i + 1].depth - rough[i].depth) + 2e-4;
      if (std::max(rough[i].depth, rough[i + 1].depth) < -rise) continue;
      const std::vector<Strip> between =
          strips(rough[i].lateral, rough[i + 1].lateral, fine, rough[i].angle);
      dense.insert(dense.end(), between.begin() + 1, between.end() - 1);
    }
    dense.push_back(rough.back());
    return assemble(refined(dense));
  }

 private:
  [[nodiscard]] double depth_of(double lateral, double radius, double angle) const {
    const double s = sign_ * radius * std::sin(angle), c = radius * std::cos(angle);
    const double y = origin_[1] + lateral * across_[1] - s * ahead_[1] - c * above_[1];
    const double z = origin_[2] + lateral * across_[2] - s * ahead_[2] - c * above_[2];
    const double out = sign_ * y - stand_.y, up = z - stand_.z;
    const double cl = std::cos(stand_.lean), sl = std::sin(stand_.lean);
    return rail_.depth(cl * out + sl * up, -sl * out + cl * up) - level_;
  }

  [[nodiscard]] std::vector<Strip> strips(double lower, double upper, double spacing,
                                          double angle) const {
    const int count = std::max(1, static_cast<int>(std::ceil((upper - lower) / spacing - 1e-9)));
    std::vector<Strip> all;
    for (int i = 0; i <= count; ++i) {
      const double u = i == count ? upper : lower + (upper - lower) * i / count;
      all.push_back(strip(u, angle));
      angle = all.back().angle;
    }
    return all;
  }

  // The extremum between two strips by golden section: of sign * depth the greatest.
  [[nodiscard]] Strip extremum(double lower, double upper, double angle, double sign) const {
    constexpr double golden = 0.6180339887498949;
    Strip a = strip(upper - golden * (upper - lower), angle);
    Strip b = strip(lower + golden * (upper - lower), angle);
    while (upper - lower > 2e-10) {
      if (sign * a.depth < sign * b.depth) {
        lower = a.lateral;
        a = b;
        b = strip(lower + golden * (upper - lower), angle);
      } else {
        upper = b.lateral;
        b = a;
        a = strip(upper - golden * (upper - lower), angle);
      }
    }
    return sign * a.depth < sign * b.depth ? b : a;
  }

  // The strips with every local extremum between them put in.
  [[nodiscard]] std::vector<Strip> refined(const std::vector<Strip>& dense) const {
    std::vector<Strip> all;
    for (std::size_t i = 0; i < dense.size(); ++i) {
      const bool inner = i > 0 && i + 1 < dense.size();
      const bool near = dense[i].depth > -2e-4;
      const auto peak = [&](double sign) {
        return inner && near && sign * dense[i].depth >= sign * dense[i - 1].depth &&
               sign * dense[i].depth >= sign * dense[i + 1].depth;
      };
      if (peak(1.0)) {
        all.push_back(extremum(dense[i - 1].lateral, dense[i + 1].lateral, dense[i].angle, 1.0));
      } else if (peak(-1.0)) {
        all.push_back(extremum(dense[i - 1].lateral, dense[i + 1].lateral, dense[i].angle, -1.0));
      } else {
        all.push_back(dense[i]);
      }
    }
    return all;
  }

  [[nodiscard]] static BruteForceResult assemble(const std::vector<Strip>& all) {
    BruteForceResult result;
    std::vector<Strip> peaks;  // of the open zone
    const auto close = [&](double upper) {
      const auto deepest =
          std::max_element(peaks.begin(), peaks.end(),
                           [](const Strip& a, const Strip& b) { return a.depth < b.depth; });
      Zone& zone = result.zones.back();
      zone.upper = upper;
      zone.lateral = deepest->lateral;
      zone.penetration = deepest->depth;
      zone.angle = deepest->angle;
      for (const Strip& other : peaks) {
        zone.has_rival = zone.has_rival || (std::abs(other.lateral - deepest->lateral) > 2e-5 &&
                                            deepest->depth - other.depth < 1e-9);
      }
      peaks.clear();
    };
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool inside = all[i].depth > 0.0;
      const bool was_inside = i > 0 && all[i - 1].depth > 0.0;
      if (i > 0 && i + 1 < all.size()) {
        const double least = std::min(all[i - 1].depth, all[i + 1].depth);
        const double most = std::max(all[i - 1].depth, all[i + 1].depth);
        if (all[i].depth <= least) result.saddle = std::min(result.saddle, std::abs(all[i].depth));
        if (inside && all[i].depth >= most) {
          if (!was_inside) result.zones.push_back({.lower = all[i].lateral});
          peaks.push_back(all[i]);
          if (!(all[i + 1].depth > 0.0)) close(all[i].lateral);
          continue;
        }
      }
      if (inside && !was_inside) result.zones.push_back({.lower = all[i].lateral});
      if (inside && (i == 0 || i + 1 == all.size())) peaks.push_back(all[i]);
      if (inside && (i + 1 == all.size() || !(all[i + 1].depth > 0.0))) {
        if (peaks.empty()) peaks.push_back(all[i]);
        close(all[i].lateral);
      }
    }
    return result;
  }

  const WheelProfile& profile_;
  double nominal_radius_;
  const ArcRail& rail_;
  RailStand stand_;
  double sign_;
  double level_;
  WheelsetPose::Point across_, ahead_, above_, origin_;
};

}  // namespace wheelrail_test
