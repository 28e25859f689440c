#include <limits>
#include <random>
#include <string>
#include <wheelrail/contact/find_contact.hpp>
#include <wheelrail/contact/minimum_distance.hpp>
#include <wheelrail/profile/convex_modification.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/track/tangent_track.hpp>

#include "support/allocation_counter.hpp"
#include "support/brute_force_contact.hpp"
#include "support/catch.hpp"
#include "support/placed.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::placed;
using wheelrail_test::WheelsetPose;

namespace {

using Convex = ConvexModification<PiecewiseProfile<double>>;
using Track = TangentTrack<RailHead<double>>;
constexpr MinimumDistanceForm forms[] = {MinimumDistanceForm::wheel_normal,
                                         MinimumDistanceForm::rail_normal};

Vector3<double> vector_of(const WheelsetPose::Point& p) {
  return Vector3<double>(p[0], p[1], p[2]);
}

WheelPlacement<double> place(const Track& track, Side side, const WheelsetPose& pose) {
  const Vector3<double> wheel_track = vector_of(pose.wheel_origin(side));
  return place_wheel(track.nearest_frame(side, wheel_track), wheel_track,
                     vector_of(pose.axle_outwards(side)));
}

template <class P>
void set_penetration(WheelsetPose& pose, const Wheel<P>& wheel, const Track& track, Side side,
                     double penetration) {
  pose.height = wheel.nominal_radius();
  for (int i = 0; i < 12; ++i) {
    const auto result = find_contact(wheel, track.rail(side), place(track, side, pose),
                                     {.penetration_threshold = -0.2});
    REQUIRE(!result.patches.empty());
    const Patch<double>* deepest = &result.patches[0];
    for (const auto& patch : result.patches) {
      if (deepest->penetration < patch.penetration) deepest = &patch;
    }
    pose.height += (deepest->penetration - penetration) / std::cos(deepest->contact_angle);
  }
}

}  // namespace

TEST_CASE("convex_parts: the modified S1002 has two, split where the paper's lines meet",
          "[contact][reference]") {
  const auto parts = convex_parts(Convex(s1002<double>()));
  REQUIRE(parts.size() == 2);
  // From the coefficients of UIC 510-2: tread tangent at the inflection and flange line [m].
  CHECK(std::abs(parts[0].upper - -34.122025969e-3) < 1e-12);
  CHECK(parts[1].lower == parts[0].upper);
  CHECK(parts[0].lower == s1002<double>().lower());
  CHECK(parts[1].upper == s1002<double>().upper());
  CHECK(convex_parts(s1002<double>(S1002Form::standard)).size() == 1);
}

TEST_CASE("minimum_distance: the Jacobian is that of differences", "[contact][random]") {
  const Wheel wheel(s1002<double>(), 0.43);
  const Rail rail(uic50<double>());
  std::mt19937_64 generator(31);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  using Equations = detail::MinimumDistanceEquations<PiecewiseProfile<double>, RailHead<double>>;
  int compared = 0;
  for (const auto form : forms) {
    for (int i = 0; i < 300; ++i) {
      const double yaw = 0.05 * uniform(generator), roll = 0.06 * uniform(generator);
      auto placement = placed(0.003, 0.43, yaw, roll);
      placement.position_rail.x() = 0.01;
      const Equations equations(wheel, rail, placement, form);
      const Equations::Vector x(0.1 * uniform(generator), 0.03 * uniform(generator),
                                0.1 * uniform(generator), 0.045 * uniform(generator));
      constexpr double h = 1e-6;
      // Differences say nothing across a joint.
      if (piece_of(rail.profile(), x(1) - h) != piece_of(rail.profile(), x(1) + h)) continue;
      if (piece_of(wheel.profile(), x(3) - h) != piece_of(wheel.profile(), x(3) + h)) continue;
      ++compared;
      const auto at = equations(x);
      for (int k = 0; k < 4; ++k) {
        const Equations::Vector step = h * Equations::Vector::Unit(k);
        const Equations::Vector more = equations(Equations::Vector(x + step)).residual;
        const Equations::Vector less = equations(Equations::Vector(x - step)).residual;
        const Equations::Vector difference = (more - less) / (2 * h);
        CAPTURE(i, k);
        // Entries reach some hundreds (1/R of the corner and slopes of 3).
        CHECK((difference - at.jacobian.col(k)).norm() < 1e-6 * (1 + at.jacobian.col(k).norm()));
      }
    }
  }
  CHECK(compared > 550);
}

TEST_CASE("minimum_distance_residual: lengths and cosines of the pair, zero at the solution",
          "[contact]") {
  const Wheel wheel(Convex(s1002<double>()), 0.43);
  const Track track(uic50<double>());
  const Rail<RailHead<double>>& rail = track.rail(Side::left);
  const auto parts = convex_parts(wheel.profile());
  WheelsetPose pose{0.001, 0.43, 0.0, 0.01};
  set_penetration(pose, wheel, track, Side::left, 1e-4);
  const auto placement = place(track, Side::left, pose);
  const PointPair<double> solved = minimum_distance(wheel, rail, placement, parts[1]).points;
  for (const auto form : forms) {
    const auto at_solution = minimum_distance_residual(wheel, rail, placement, solved, form);
    CHECK(at_solution.lpNorm<Eigen::Infinity>() < 1e-14);
    // Along the rail by 3 mm: the distance vector gets this component along it and no cosine
    // changes.
    PointPair<double> moved = solved;
    moved.arc_length += 3e-3;
    const auto apart = minimum_distance_residual(wheel, rail, placement, moved, form);
    CHECK(apart(1) * apart(1) + apart(0) * apart(0) == Approx(9e-6).epsilon(1e-3));
    CHECK(std::abs(apart(2) - at_solution(2)) < 1e-15);
    CHECK(std::abs(apart(3) - at_solution(3)) < 1e-15);
  }
  const auto along_rail = minimum_distance_residual(
      wheel, rail, placement,
      {solved.arc_length + 3e-3, solved.rail_lateral, solved.wheel_angle, solved.wheel_lateral},
      MinimumDistanceForm::rail_normal);
  CHECK(along_rail(1) == Approx(-3e-3).epsilon(1e-10));
  // A wheel that stands straight on the rail's top: the lengths are plain differences.
  WheelPlacement<double> straight;
  straight.position_rail = Vector3<double>(0, 0, 0.4295);
  const auto across = minimum_distance_residual(Wheel(s1002<double>(), 0.43), rail, straight,
                                                {-0.002, 0, 0, 0.03}, forms[0]);
  const auto on_wheel = s1002<double>().evaluate(0.03);
  const double length = std::hypot(1.0, on_wheel.slope);
  const double down = 0.4295 - 0.43 - on_wheel.value;  // of the wheel's point over the rail's
  CHECK(across(0) == Approx((0.03 - on_wheel.slope * down) / length).epsilon(1e-12));
  CHECK(std::abs(across(1)) == Approx(0.002).epsilon(1e-12));
  CHECK(std::abs(across(2)) == Approx(std::abs(on_wheel.slope) / length).epsilon(1e-12));
  CHECK(across(3) == 0);
}

TEST_CASE("minimum_distance: finds what find_contact finds on the convex profile",
          "[contact][random]") {
  const Wheel wheel(Convex(s1002<double>()), 0.43);
  const auto parts = convex_parts(wheel.profile());
  const Track track(uic50<double>());
  std::mt19937_64 generator(32);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int compared = 0, flange = 0, failures = 0, most_iterations = 0;
  double worst_penetration = 0, worst_position = 0;
  for (int i = 0; i < 400; ++i) {
    const Side side = i % 2 == 0 ? Side::left : Side::right;
    WheelsetPose pose;
    pose.yaw = 0.03 * uniform(generator);
    pose.roll = 0.01 * uniform(generator);
    pose.lateral_shift = 0.01 * uniform(generator);
    set_penetration(pose, wheel, track, side, 1e-5 + 2e-4 * std::abs(uniform(generator)));
    const auto placement = place(track, side, pose);
    const auto strips = find_contact(wheel, track.rail(side), placement);
    for (const auto form : forms) {
      CAPTURE(i, pose.lateral_shift, pose.roll, pose.yaw, pose.height, form);
      MinimumDistanceOptions<double> options;
      options.form = form;
      const auto result =
          find_contact_by_minimum_distance(wheel, track.rail(side), placement, parts, options);
      if (result.status != SearchStatus::complete) ++failures;
      REQUIRE(result.patches.size() == strips.patches.size());
      for (std::size_t k = 0; k < result.patches.size(); ++k) {
        const auto& a = result.patches[k];
        const auto& b = strips.patches[k];
        worst_penetration = std::max(worst_penetration, std::abs(a.penetration - b.penetration));
        worst_position = std::max(worst_position, std::abs(a.wheel_lateral - b.wheel_lateral));
        CHECK(std::abs(a.penetration - b.penetration) < 1e-12);
        CHECK(std::abs(a.wheel_lateral - b.wheel_lateral) < 1e-9);
        CHECK(std::abs(a.rail_lateral - b.rail_lateral) < 1e-9);
        CHECK(std::abs(a.longitudinal - b.longitudinal) < 1e-9);
        CHECK(std::isnan(a.zone_lower));
        ++compared;
        if (b.wheel_lateral < -0.0384) ++flange;
      }
      for (const auto& part : parts) {
        const auto found = minimum_distance(wheel, track.rail(side), placement, part, options);
        if (found.proximity == ProximityCase::penetrating) {
          most_iterations = std::max(most_iterations, found.iterations);
          CHECK(found.residual < 1e-13);
        }
      }
    }
  }
  INFO("compared " << compared << ", flange " << flange << ", not complete " << failures
                   << ", most iterations " << most_iterations << ", worst penetration "
                   << worst_penetration << ", worst position " << worst_position);
  CHECK(compared >= 800);
  CHECK(flange > 40);
  CHECK(failures == 0);
  // Newton's method: a handful of steps to the right curves, then two or three that double digits.
  CHECK(most_iterations <= 20);
}

TEST_CASE("minimum_distance: tells the three cases of the paper's Fig. 5 apart", "[contact]") {
  const Wheel wheel(Convex(s1002<double>()), 0.43);
  const Track track(uic50<double>());
  const auto parts = convex_parts(wheel.profile());
  for (const auto form : forms) {
    for (const double penetration : {-1e-5, 1e-8, -1e-8, 1e-5}) {
      WheelsetPose pose{0.001, 0.43, 0.0, 0.01};
      set_penetration(pose, wheel, track, Side::left, penetration);
      MinimumDistanceOptions<double> options;
      options.form = form;
      options.touching_tolerance = 1e-7;
      const auto found = minimum_distance(wheel, track.rail(Side::left),
                                          place(track, Side::left, pose), parts[1], options);
      CHECK(std::abs(found.distance + penetration) < 1e-13);
      CHECK(found.proximity == (penetration == 1e-5    ? ProximityCase::penetrating
                                : penetration == -1e-5 ? ProximityCase::apart
                                                       : ProximityCase::touching));
    }
  }
}

TEST_CASE("minimum_distance: without a tolerance only rounding touches", "[contact]") {
  const Wheel wheel(Convex(s1002<double>()), 0.43);
  const Track track(uic50<double>());
  const auto parts = convex_parts(wheel.profile());
  WheelsetPose pose{0.001, 0.43, 0.0, 0.01};
  set_penetration(pose, wheel, track, Side::left, 0);
  const auto proximity_at = [&](double penetration) {
    WheelsetPose moved = pose;
    moved.height -= penetration;
    return minimum_distance(wheel, track.rail(Side::left), place(track, Side::left, moved),
                            parts[1])
        .proximity;
  };
  // 64 rounding units of 0.43 m are 6.1e-15 m.
  CHECK(proximity_at(0) == ProximityCase::touching);
  CHECK(proximity_at(5e-14) == ProximityCase::penetrating);
  CHECK(proximity_at(-5e-14) == ProximityCase::apart);
}

TEST_CASE("minimum_distance: evaluations are the starting strips and the Newton systems",
          "[contact]") {
  const Wheel wheel(Convex(s1002<double>()), 0.43);
  const Track track(uic50<double>());
  const auto parts = convex_parts(wheel.profile());
  WheelsetPose pose{0.001, 0.43, 0.0, 0.01};
  set_penetration(pose, wheel, track, Side::left, 1e-4);
  const auto placement = place(track, Side::left, pose);
  MinimumDistanceOptions<double> options;
  options.starting_strips = 17;
  int sum = 0;
  for (const auto& part : parts) {
    const auto found = minimum_distance(wheel, track.rail(Side::left), placement, part, options);
    CHECK(found.iterations > 0);
    CHECK(found.evaluations == found.iterations + 17);
    sum += found.evaluations;
  }
  const auto all =
      find_contact_by_minimum_distance(wheel, track.rail(Side::left), placement, parts, options);
  CHECK(all.evaluations == sum);
  const auto solved = minimum_distance(wheel, track.rail(Side::left), placement, parts[1]);
  const auto again =
      minimum_distance(wheel, track.rail(Side::left), placement, parts[1], solved.points, options);
  CHECK(again.evaluations == again.iterations);
}

TEST_CASE("minimum_distance: no step is longer than maximum_step", "[contact]") {
  const Wheel wheel(Convex(s1002<double>()), 0.43);
  const Track track(uic50<double>());
  const auto parts = convex_parts(wheel.profile());
  WheelsetPose pose{0.001, 0.43, 0.0, 0.01};
  set_penetration(pose, wheel, track, Side::left, 1e-4);
  const auto placement = place(track, Side::left, pose);
  const auto solve = [&](double maximum_step, int maximum_iterations) {
    MinimumDistanceOptions<double> options;
    options.maximum_step = maximum_step;
    options.maximum_iterations = maximum_iterations;
    PointPair<double> start =
        minimum_distance(wheel, track.rail(Side::left), placement, parts[1]).points;
    start.arc_length += 0.005;
    return minimum_distance(wheel, track.rail(Side::left), placement, parts[1], start, options);
  };
  const auto solution = solve(0, 50);
  REQUIRE(solution.proximity == ProximityCase::penetrating);
  const double far = solution.points.arc_length + 0.005;
  // Five steps of 1 mm, the last of them already Newton's own.
  for (int steps = 1; steps <= 3; ++steps) {
    const auto cut = solve(1e-3, steps);
    CHECK(cut.proximity == ProximityCase::not_converged);
    CHECK(far - cut.points.arc_length <= 1e-3 * steps * (1 + 1e-9));
    CHECK(far - cut.points.arc_length > 0);
  }
  const auto slow = solve(1e-3, 50);
  CHECK(slow.proximity == ProximityCase::penetrating);
  CHECK(slow.iterations > solution.iterations);
  CHECK(std::abs(slow.distance - solution.distance) < 1e-14);
  // 0 is a fortieth of the radius.
  const auto same = solve(0.43 / 40, 50);
  CHECK(same.iterations == solution.iterations);
  CHECK(same.distance == solution.distance);
}

TEST_CASE("minimum_distance: converges quadratically from near by", "[contact]") {
  const Wheel wheel(Convex(s1002<double>()), 0.43);
  const Track track(uic50<double>());
  const auto parts = convex_parts(wheel.profile());
  WheelsetPose pose{0.001, 0.43, 0.0, 0.01};
  set_penetration(pose, wheel, track, Side::left, 1e-4);
  const auto placement = place(track, Side::left, pose);
  for (const auto form : forms) {
    MinimumDistanceOptions<double> options;
    options.form = form;
    const auto found =
        minimum_distance(wheel, track.rail(Side::left), placement, parts[1], options);
    REQUIRE(found.proximity == ProximityCase::penetrating);
    PointPair<double> start = found.points;
    start.rail_lateral += 1e-4;
    start.wheel_lateral += 1e-4;
    start.wheel_angle += 1e-3;
    const auto again =
        minimum_distance(wheel, track.rail(Side::left), placement, parts[1], start, options);
    CHECK(again.proximity == ProximityCase::penetrating);
    // 1e-4 m, 1e-7, 1e-13 and the step that finds nothing left.
    CHECK(again.iterations <= 5);
    CHECK(std::abs(again.points.wheel_lateral - found.points.wheel_lateral) < 1e-12);
  }
}

TEST_CASE("minimum_distance: in the real profile's fillet it fails or says where it ended",
          "[contact][random]") {
  const Wheel wheel(s1002<double>(), 0.43);
  const Track track(uic50<double>());
  const auto parts = convex_parts(wheel.profile());
  REQUIRE(parts.size() == 1);
  std::mt19937_64 generator(33);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int poses = 0, same = 0, other_extremum = 0, failed = 0;
  while (poses < 200) {
    WheelsetPose pose;
    pose.yaw = 0.03 * uniform(generator);
    pose.lateral_shift = 0.0060 + 0.0006 * uniform(generator);
    set_penetration(pose, wheel, track, Side::left, 1e-4);
    const auto placement = place(track, Side::left, pose);
    ++poses;
    const auto strips = find_contact(wheel, track.rail(Side::left), placement);
    double deepest = 0;
    for (const auto& patch : strips.patches) deepest = std::max(deepest, patch.penetration);
    const auto found = minimum_distance(wheel, track.rail(Side::left), placement, parts[0]);
    const bool success = found.proximity == ProximityCase::penetrating ||
                         found.proximity == ProximityCase::apart ||
                         found.proximity == ProximityCase::touching;
    if (!success) {
      ++failed;
    } else {
      // A success is at least a pair of points with common normals.
      CHECK(found.residual < 1e-12);
      if (std::abs(-found.distance - deepest) < 1e-12) {
        ++same;
      } else {
        ++other_extremum;
        CHECK(-found.distance < deepest);
      }
    }
  }
  INFO("of " << poses << " the deepest point " << same << ", another extremum " << other_extremum
             << ", reported failures " << failed);
  CHECK(same + other_extremum + failed == poses);
  // This is why the strips are searched.
  CHECK(other_extremum + failed > 0);
}

TEST_CASE("minimum_distance: NaN gives not_finite", "[contact][bad-input]") {
  const Wheel wheel(Convex(s1002<double>()), 0.43);
  const Rail rail(uic50<double>());
  WheelPlacement<double> placement;
  placement.position_rail = Vector3<double>(0, 0, 0.4295);
  const auto parts = convex_parts(wheel.profile());
  CHECK(find_contact_by_minimum_distance(wheel, rail, placement, parts).patches.size() == 1);
  placement.sin_roll = std::numeric_limits<double>::quiet_NaN();
  const auto result = find_contact_by_minimum_distance(wheel, rail, placement, parts);
  CHECK(result.status == SearchStatus::not_finite);
  CHECK(result.patches.empty());
  const auto found = minimum_distance(wheel, rail, placement, parts[1]);
  CHECK(found.proximity == ProximityCase::not_converged);
}

TEST_CASE("minimum_distance: Newton's step solves the linear system", "[contact][random]") {
  const Wheel wheel(s1002<double>(), 0.43);
  const Rail rail(uic50<double>());
  std::mt19937_64 generator(34);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const auto form : forms) {
    for (int i = 0; i < 200; ++i) {
      const double yaw = 0.05 * uniform(generator), roll = 0.06 * uniform(generator);
      auto placement = placed(0.003, 0.43, yaw, roll);
      placement.position_rail.x() = 0.01;
      const detail::MinimumDistanceEquations equations(wheel, rail, placement, form);
      const Vector4<double> x(0.1 * uniform(generator), 0.03 * uniform(generator),
                              0.1 * uniform(generator), 0.045 * uniform(generator));
      const auto at = equations(x);
      const Vector4<double> step = equations.newton_step(equations.pair(x));
      REQUIRE(is_finite(step.sum()));
      const double size = at.jacobian.cwiseAbs().maxCoeff() * step.lpNorm<Eigen::Infinity>();
      CAPTURE(i, form);
      CHECK((at.jacobian * step + at.residual).lpNorm<Eigen::Infinity>() < 1e-13 * (1 + size));
    }
  }
}

TEST_CASE("minimum_distance: the nearest strip found by halving is the nearest of many",
          "[contact][random]") {
  const Wheel wheel(Convex(s1002<double>()), 0.43);
  const auto parts = convex_parts(wheel.profile());
  std::mt19937_64 generator(35);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const Track& track : {Track(uic50<double>()), Track(rail_60e1<double>())}) {
    for (int i = 0; i < 300; ++i) {
      const Side side = i % 2 == 0 ? Side::left : Side::right;
      const WheelsetPose pose{0.008 * uniform(generator), 0.4298 + 2e-4 * uniform(generator),
                              0.005 * uniform(generator), 0.02 * uniform(generator)};
      const auto placement = place(track, side, pose);
      const auto& rail = track.rail(side);
      for (const auto& part : parts) {
        const double width = part.upper - part.lower;
        double deepest = -1, nearest = 0;
        for (int k = 0; k < 1000; ++k) {
          const double u = part.lower + width * (k + 0.5) / 1000;
          const auto locus = locus_point(wheel, placement, u, wheel.profile().evaluate(u));
          REQUIRE(locus.exists);
          const double depth = rail_foot(rail.profile(), locus.lateral, locus.up).penetration;
          if (deepest < depth) deepest = depth, nearest = u;
        }
        CAPTURE(i, pose.lateral_shift, pose.yaw, pose.roll, part.lower);
        const auto start = detail::nearest_strip(wheel, rail, placement, part, 6);
        // The last of six halvings lies within a 64th of the part, and the sample within a 1000th.
        CHECK(std::abs(start.wheel_lateral - nearest) < width * (1.0 / 64 + 1.0 / 1000));
      }
    }
  }
}

TEST_CASE("minimum_distance: a warm start gives the answers of a cold one in fewer evaluations",
          "[contact][random]") {
  const Wheel wheel(Convex(s1002<double>()), 0.43);
  const auto parts = convex_parts(wheel.profile());
  std::mt19937_64 generator(36);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const auto form : forms) {
    const Track track(form == forms[0] ? uic50<double>() : rail_60e1<double>());
    MinimumDistanceOptions<double> options;
    options.form = form;
    MinimumDistanceMemory<double> memory;
    WheelsetPose pose;
    int patches = 0, flange = 0, without = 0, allocations = 0;
    long after_jump = 0, cold_after_jump = 0, in_runs = 0, cold_in_runs = 0;
    for (int i = 0; i < 3000; ++i) {
      // Runs of 30 small steps, and then a jump anywhere, at times to the other rail.
      const bool jump = i % 30 == 0;
      const Side side = i / 300 % 2 == 0 ? Side::left : Side::right;
      if (jump) {
        pose.lateral_shift = 0.010 * uniform(generator);
        pose.roll = 0.005 * uniform(generator);
        pose.yaw = 0.02 * uniform(generator);
        set_penetration(pose, wheel, track, side, 1e-4 * uniform(generator));
      } else {
        pose.lateral_shift += 2e-5 * uniform(generator);
        pose.roll += 1e-5 * uniform(generator);
        pose.yaw += 5e-5 * uniform(generator);
        pose.height += 2e-6 * uniform(generator);
      }
      auto placement = place(track, side, pose);
      placement.position_rail.x() = 0.01 * i;  // it rolls along
      const auto& rail = track.rail(side);
      const auto cold = find_contact_by_minimum_distance(wheel, rail, placement, parts, options);
      ContactResult<double> warm;
      allocations += static_cast<int>(wheelrail_test::allocations_of([&] {
        warm = find_contact_by_minimum_distance(wheel, rail, placement, parts, memory, options);
      }));
      CAPTURE(i, form, pose.lateral_shift, pose.roll, pose.yaw, pose.height);
      CHECK(cold.status == SearchStatus::complete);
      CHECK(warm.status == cold.status);
      REQUIRE(warm.patches.size() == cold.patches.size());
      for (std::size_t k = 0; k < cold.patches.size(); ++k) {
        const auto &a = warm.patches[k], &b = cold.patches[k];
        CHECK(std::abs(a.penetration - b.penetration) < 1e-14);
        CHECK(std::abs(a.wheel_lateral - b.wheel_lateral) < 1e-10);
        CHECK(std::abs(a.rail_lateral - b.rail_lateral) < 1e-10);
        CHECK(std::abs(a.longitudinal - b.longitudinal) < 1e-10);
        CHECK(std::abs(a.wheel_angle - b.wheel_angle) < 1e-10);
        CHECK((a.position_rail - b.position_rail).norm() < 1e-10);
        CHECK((a.normal_rail - b.normal_rail).norm() < 1e-9);
        ++patches;
        if (b.wheel_lateral < -0.0384) ++flange;
      }
      without += cold.patches.empty();
      (jump ? after_jump : in_runs) += warm.evaluations;
      (jump ? cold_after_jump : cold_in_runs) += cold.evaluations;
    }
    INFO("patches " << patches << ", flange " << flange << ", poses without " << without
                    << ", evaluations in runs " << in_runs << " of " << cold_in_runs
                    << ", after jumps " << after_jump << " of " << cold_after_jump);
    CHECK(patches > 1000);
    CHECK(flange > 100);
    CHECK(without > 500);
    CHECK(allocations == 0);
    CHECK(3 * in_runs < cold_in_runs);
    // What a warm start costs where it is of no use.
    CHECK(after_jump < 2 * cold_after_jump);
  }
}

TEST_CASE("minimum_distance: a warm start at the same placement has nothing to do", "[contact]") {
  const Wheel wheel(Convex(s1002<double>()), 0.43);
  const Track track(uic50<double>());
  const auto parts = convex_parts(wheel.profile());
  WheelsetPose pose{0.001, 0.43, 0.0, 0.01};
  set_penetration(pose, wheel, track, Side::left, 1e-4);
  const auto placement = place(track, Side::left, pose);
  const auto& rail = track.rail(Side::left);
  MinimumDistanceMemory<double> memory;
  const auto first = find_contact_by_minimum_distance(wheel, rail, placement, parts, memory);
  const auto cold = find_contact_by_minimum_distance(wheel, rail, placement, parts);
  CHECK(first.evaluations == cold.evaluations);
  CHECK(memory.parts[0].is_known);
  CHECK(memory.parts[1].is_known);
  CHECK_FALSE(memory.parts[2].is_known);
  const auto again = find_contact_by_minimum_distance(wheel, rail, placement, parts, memory);
  CHECK(again.evaluations <= 4);
  REQUIRE(again.patches.size() == 1);
  CHECK(std::abs(again.patches[0].penetration - cold.patches[0].penetration) < 1e-15);
}

TEST_CASE("minimum_distance: a memory of anything costs time, not the answer",
          "[contact][random][bad-input]") {
  const Wheel wheel(Convex(s1002<double>()), 0.43);
  const Track track(uic50<double>());
  const auto parts = convex_parts(wheel.profile());
  const auto& rail = track.rail(Side::left);
  std::mt19937_64 generator(37);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int cold_after_all = 0;
  for (int i = 0; i < 400; ++i) {
    WheelsetPose pose;
    pose.lateral_shift = 0.008 * uniform(generator);
    pose.yaw = 0.02 * uniform(generator);
    set_penetration(pose, wheel, track, Side::left, 1e-4);
    const auto placement = place(track, Side::left, pose);
    MinimumDistanceMemory<double> memory;
    for (auto& part : memory.parts) {
      part = {{uniform(generator), 0.04 * uniform(generator), 3 * uniform(generator),
               0.07 * uniform(generator)},
              true};
    }
    if (i % 10 == 0) memory.parts[1].points.wheel_angle = std::nan("");
    const auto cold = find_contact_by_minimum_distance(wheel, rail, placement, parts);
    const auto warm = find_contact_by_minimum_distance(wheel, rail, placement, parts, memory);
    CAPTURE(i, pose.lateral_shift, pose.yaw);
    CHECK(warm.status == SearchStatus::complete);
    REQUIRE(warm.patches.size() == cold.patches.size());
    for (std::size_t k = 0; k < cold.patches.size(); ++k) {
      CHECK(std::abs(warm.patches[k].penetration - cold.patches[k].penetration) < 1e-14);
      CHECK(std::abs(warm.patches[k].wheel_lateral - cold.patches[k].wheel_lateral) < 1e-10);
    }
    cold_after_all += cold.evaluations <= warm.evaluations;
  }
  CHECK(cold_after_all > 390);
  // What is not finite is not remembered.
  WheelPlacement<double> nowhere;
  nowhere.position_rail = Vector3<double>(0, std::nan(""), 0.43);
  MinimumDistanceMemory<double> memory;
  const auto result = find_contact_by_minimum_distance(wheel, rail, nowhere, parts, memory);
  CHECK(result.status == SearchStatus::not_finite);
  CHECK_FALSE(memory.parts[0].is_known);
}

TEMPLATE_TEST_CASE("minimum_distance: any scalar, warm and cold", "[contact]", float, long double,
                   wheelrail_test::StrictScalar) {
  using T = TestType;
  const auto number = [](long double x) { return constant<T>(x); };
  const auto place_in = [](auto make, auto scalar) {
    using S = decltype(scalar);
    WheelPlacement<S> placement;
    placement.position_rail = Vector3<S>(S(0), make(0.001L), make(0.4295L));
    placement.sin_yaw = make(0.006L);
    placement.cos_yaw = make(0.999982L);
    placement.tan_yaw = placement.sin_yaw / placement.cos_yaw;
    return placement;
  };
  const Wheel<ConvexModification<PiecewiseProfile<T>>> wheel(
      ConvexModification<PiecewiseProfile<T>>(s1002<T>()), number(0.43L));
  const Rail<RailHead<T>> rail(uic50<T>());
  const Wheel wheel_double(Convex(s1002<double>()), 0.43);
  const Rail rail_double(uic50<double>());
  const auto expected =
      find_contact_by_minimum_distance(wheel_double, rail_double, place_in(constant<double>, 0.0),
                                       convex_parts(wheel_double.profile()));
  REQUIRE(expected.patches.size() == 1);
  MinimumDistanceMemory<T> memory;
  const auto parts = convex_parts(wheel.profile());
  const auto placement = place_in(number, T(0));
  const auto as_double = [](const T& x) {
    if constexpr (std::is_floating_point_v<T>) {
      return static_cast<double>(x);
    } else {
      return x.as_double();
    }
  };
  const double tolerance = std::is_same_v<T, float> ? 2e-7 : 1e-15;
  for (int i = 0; i < 3; ++i) {
    const auto found = find_contact_by_minimum_distance(wheel, rail, placement, parts, memory);
    CHECK(found.status == SearchStatus::complete);
    REQUIRE(found.patches.size() == 1);
    CHECK(std::abs(as_double(found.patches[0].penetration) - expected.patches[0].penetration) <
          tolerance);
    CHECK(std::abs(as_double(found.patches[0].wheel_lateral) - expected.patches[0].wheel_lateral) <
          1e5 * tolerance);
  }
}
