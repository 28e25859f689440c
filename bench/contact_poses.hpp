#pragma once
// The poses of contact_bench: one wheel over its rail, set down with some tens of micrometres of
// penetration, and what the searches find there.

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <vector>
#include <wheelrail/contact/find_contact_batch.hpp>
#include <wheelrail/numerics/cubic_spline.hpp>
#include <wheelrail/wheelrail.hpp>

namespace wheelrail_bench {

using wheelrail::Side;
using Real = wheelrail::PiecewiseProfile<double>;
using Convex = wheelrail::ConvexModification<Real>;
using Placement = wheelrail::WheelPlacement<double>;

// The tread and the flange's face of a profile, from points at a spacing [m].
[[nodiscard]] inline Real spline_of(const Real& profile, double spacing) {
  std::vector<double> nodes, values;
  const double lower = -0.055;
  const int count = static_cast<int>((profile.upper() - lower) / spacing);
  for (int i = 0; i <= count; ++i) {
    nodes.push_back(lower + (profile.upper() - lower) * i / count);
    values.push_back(profile.evaluate(nodes.back()).value);
  }
  const wheelrail::CubicSpline<double, double> spline(nodes, values);
  std::vector<wheelrail::ProfilePiece<double>> pieces;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    const double width = nodes[i + 1] - nodes[i];
    // At its ends; the second derivative is linear in between.
    const auto from = spline.evaluate(nodes[i]), to = spline.evaluate(nodes[i + 1]);
    const std::array<double, 4> coefficients{
        from.value, from.slope, from.second_derivative / 2,
        (to.second_derivative - from.second_derivative) / (6 * width)};
    pieces.push_back(wheelrail::ProfilePiece<double>::polynomial(nodes[i], nodes[i + 1], nodes[i],
                                                                 1.0, coefficients));
  }
  return Real(std::move(pieces));
}

[[nodiscard]] inline wheelrail::WheelPlacement<float> rounded(const Placement& pose) {
  wheelrail::WheelPlacement<float> result;
  result.side = pose.side;
  result.position_rail = pose.position_rail.cast<float>();
  result.sin_yaw = static_cast<float>(pose.sin_yaw);
  result.cos_yaw = static_cast<float>(pose.cos_yaw);
  result.tan_yaw = static_cast<float>(pose.tan_yaw);
  result.sin_roll = static_cast<float>(pose.sin_roll);
  result.cos_roll = static_cast<float>(pose.cos_roll);
  return result;
}

struct StripItem {
  const Placement* placement;
  int piece;
  double lateral;
  wheelrail::ProfilePoint<double> point;
};

struct CreepItem {
  wheelrail::Creepage<double> creepage;
  wheelrail::PolachContact<double> contact;
};

struct Setting {
  wheelrail::Wheelset<Real> wheelset{wheelrail::s1002<double>(), 0.43, 1.5};
  wheelrail::TangentTrack<wheelrail::RailHead<double>> track{wheelrail::uic50<double>()};
  wheelrail::Wheel<Real> real{wheelrail::s1002<double>(), 0.43};
  wheelrail::Wheel<Convex> convex{Convex(wheelrail::s1002<double>()), 0.43};
  wheelrail::Wheel<Real> spline{spline_of(wheelrail::s1002<double>(), 1e-3), 0.43};
  wheelrail::Wheel<wheelrail::PiecewiseProfile<float>> float_wheel{wheelrail::s1002<float>(),
                                                                   0.43F};
  wheelrail::Rail<wheelrail::RailHead<float>> float_rail{wheelrail::uic50<float>()};
  wheelrail::ConvexParts<double> parts = wheelrail::convex_parts(convex.profile());
  std::vector<Placement> poses;  // 256 over the gauge clearance, in no order
  std::vector<wheelrail::WheelPlacement<float>> float_poses;
  // 4096 as `poses` are, one by one and as batches.
  std::vector<Placement> many;
  wheelrail::PlacementBatch<double> batch;
  std::vector<wheelrail::WheelPlacement<float>> float_many;
  wheelrail::PlacementBatch<float> float_batch;
  std::vector<Placement> path;                       // 4096 of a hunting motion
  std::map<int, std::vector<Placement>> by_patches;  // 128 of each
  std::map<int, std::vector<Placement>> by_yaw;      // 128 at +-1, 10, 30 mrad
  std::vector<StripItem> strips;
  std::vector<wheelrail::LocusPoint<double>> loci;
  std::vector<wheelrail::ContactKinematics<double>> contacts;
  std::vector<CreepItem> creep;

  Setting() {
    for (int i = 0; i < 1000 && poses.size() < 256; ++i) {
      add_pose(poses, between(-0.006, 0.006), between(-0.01, 0.01));
    }
    for (const Placement& pose : poses) float_poses.push_back(rounded(pose));
    // 18.3 m/s, a wavelength of 12 m, an amplitude of 5.5 mm: into the flange's fillet and out again.
    for (int i = 0; i < 4096; ++i) {
      const double phase = 2 * 3.14159265358979 * 18.3 / 12 * i / 6000.0;
      add_pose(path, 0.0055 * std::sin(phase), 0.0055 * 0.5235987756 * std::cos(phase), 5e-5);
    }
    for (const int yaw : {1, 10, 30}) {
      for (int i = 0; i < 1000 && by_yaw[yaw].size() < 128; ++i) {
        const double sign = by_yaw[yaw].size() % 2 == 0 ? 1 : -1;
        add_pose(by_yaw[yaw], between(-0.006, 0.006), sign * yaw * 1e-3);
      }
    }
    for (int i = 0; i < 1000 && by_patches[0].size() < 128; ++i) {
      add_pose(by_patches[0], between(-0.006, 0.006), between(-0.01, 0.01), -between(5e-6, 8e-5));
    }
    for (int tries = 0; tries < 20000 && !is_full(); ++tries) {
      std::vector<Placement> one;
      add_pose(one, between(0.004, 0.0065), between(-0.01, 0.01), between(1e-5, 2e-4));
      if (one.empty()) continue;
      const int count = static_cast<int>(find_contact(real, rail(), one[0]).patches.size());
      if (0 < count && count < 4 && by_patches[count].size() < 128) {
        by_patches[count].push_back(one[0]);
      }
    }
    add_stage_items();
    for (int i = 0; i < 5000 && many.size() < 4096; ++i) {
      add_pose(many, between(-0.006, 0.006), between(-0.01, 0.01));
    }
    for (const Placement& pose : many) {
      batch.push_back(pose);
      float_many.push_back(rounded(pose));
      float_batch.push_back(float_many.back());
    }
  }

  [[nodiscard]] const wheelrail::Rail<wheelrail::RailHead<double>>& rail() const {
    return track.rail(Side::left);
  }

  // What keeps the results from being comparable, or null: the methods must agree on the convex
  // wheel, warm with cold, float with double and the spline with the profile that it came from.
  [[nodiscard]] const char* fault() const {
    using namespace wheelrail;
    const auto differ = [](const auto& one, const auto& other, double tolerance) {
      if (one.patches.size() != other.patches.size()) return true;
      for (std::size_t k = 0; k < one.patches.size(); ++k) {
        const double a = static_cast<double>(one.patches[k].penetration);
        const double b = static_cast<double>(other.patches[k].penetration);
        if (!(std::abs(a - b) <= tolerance)) return true;
      }
      return one.status != SearchStatus::complete || other.status != SearchStatus::complete;
    };
    if (!is_full() || poses.size() < 256 || path.size() < 4096 || many.size() < 4096) {
      return "poses are missing";
    }
    int float_misses = 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const auto& pose = poses[i];
      const auto on_convex = find_contact(convex, rail(), pose);
      const auto on_real = find_contact(real, rail(), pose);
      if (differ(on_convex, find_contact_by_minimum_distance(convex, rail(), pose, parts), 1e-12)) {
        return "the methods disagree on the convex wheel";
      }
      if (on_real.patches.empty()) return "a pose does not touch";
      if (differ(on_real, find_contact(spline, rail(), pose), 2e-6)) ++float_misses;
      if (differ(on_real, find_contact(float_wheel, float_rail, float_poses[i]), 2e-6)) {
        ++float_misses;
      }
    }
    // A shallow zone may be there on one profile, or in one precision, and not in the other.
    if (float_misses > 16) return "spline or float searches differ";
    SearchMemory<double> memory(real);
    MinimumDistanceMemory<double> distance_memory;
    for (const auto& pose : path) {
      if (differ(find_contact(real, rail(), pose), find_contact(real, rail(), pose, memory), 0)) {
        return "a warm search differs from the cold one";
      }
      if (differ(find_contact_by_minimum_distance(convex, rail(), pose, parts),
                 find_contact_by_minimum_distance(convex, rail(), pose, parts, distance_memory),
                 1e-12)) {
        return "the warm minimum distance method differs from the cold one";
      }
    }
    for (const int threads : {1, 2}) {
      const auto found = find_contacts(real, rail(), batch, {}, threads);
      const auto float_found = find_contacts(float_wheel, float_rail, float_batch, {}, threads);
      int unlike_floats = 0;
      for (std::size_t i = 0; i < many.size(); ++i) {
        if (differ(find_contact(real, rail(), many[i]), found[i], 1e-15)) {
          return "a batch differs from single searches";
        }
        if (differ(find_contact(float_wheel, float_rail, float_many[i]), float_found[i], 1e-6)) {
          ++unlike_floats;
        }
      }
      if (unlike_floats > 64) return "a batch of floats differs from single searches";
    }
    return nullptr;
  }

 private:
  [[nodiscard]] double between(double lower, double upper) {
    return lower + (upper - lower) * (static_cast<double>(random_()) / 4294967296.0);
  }

  [[nodiscard]] bool is_full() const {
    for (const auto& [yaw, set] : by_yaw) {
      if (set.size() < 128) return false;
    }
    for (const int count : {0, 1, 2, 3}) {
      const auto found = by_patches.find(count);
      if (found == by_patches.end() || found->second.size() < 128) return false;
    }
    return true;
  }

  void add_pose(std::vector<Placement>& to, double shift, double yaw, double penetration = 0) {
    if (penetration == 0) penetration = between(5e-6, 8e-5);
    const auto down = touching_position(wheelset, track, shift, yaw, {.gap = -penetration});
    if (down.status != wheelrail::SolveStatus::converged) return;
    to.push_back(place_wheel(wheelset, track, Side::left, down.position));
  }

  void add_stage_items() {
    using namespace wheelrail;
    const ContactForceModel<double> model;
    const KalkerTable<double> kalker(0.28);
    for (const Placement& pose : poses) {
      for (const auto& patch : find_contact(real, rail(), pose).patches) {
        const auto point = real.profile().evaluate(patch.wheel_lateral);
        strips.push_back(
            {&pose, piece_of(real.profile(), patch.wheel_lateral), patch.wheel_lateral, point});
        loci.push_back(locus_point(real, pose, patch.wheel_lateral, point));
        contacts.push_back({.penetration = patch.penetration,
                            .curvatures = hertz_curvatures(patch.wheel_longitudinal_curvature, 0.0,
                                                           patch.wheel_lateral_curvature,
                                                           patch.rail_lateral_curvature),
                            .longitudinal_velocity = 0.01,
                            .lateral_velocity = 0.005,
                            .spin_velocity = 0.2,
                            .forward_speed = 10,
                            .speed = 10});
        const auto force = model(contacts.back());
        creep.push_back({force.creepage,
                         {force.ellipse, kalker.at(force.ellipse.a, force.ellipse.b), 82e9, 0.25,
                          force.normal}});
      }
    }
  }

  std::mt19937 random_{2020};
};

}  // namespace wheelrail_bench
