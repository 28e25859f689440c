// The bogie and the vehicle of the paper (§6.2, §6.3): what examples/bogie_on_tangent_track and
// vehicle_on_curved_track run.

#include "support/vehicle_run.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numeric>

#include "../support/catch.hpp"
#include "support/curve.hpp"
#include "support/profiles.hpp"
#include "support/vehicle_output.hpp"
#include "support/wheelset_run.hpp"

using namespace wheelrail;
using namespace examples;
using Catch::Matchers::ContainsSubstring;

namespace {

std::string vehicle_path(const std::string& name) {
  return std::string(WHEELRAIL_SOURCE_DIR) + "/examples/vehicles/" + name;
}

const VehicleData& data() {
  static const VehicleData value(vehicle_path("metro_trailer.csv"));
  return value;
}

double weight_of(const Vehicle& vehicle) {
  double mass = 0;
  for (const auto& body : vehicle.model.bodies) mass += body.mass();
  return 9.81 * mass;
}

// Means over the records from `begin` to `end` [s] of all wheels' forces in the track's plane.
struct MeanForces {
  double lateral = 0, vertical = 0, speed = 0;  // [N], [N], [m/s]
};

MeanForces mean_forces(const VehicleHistory& history, std::size_t wheelsets, double begin,
                       double end) {
  MeanForces mean;
  double count = 0, first = 0, last = 0;
  for (const auto& r : history.records) {
    if (r.time < begin || end < r.time) continue;
    if (count == 0) first = r.arc_length;
    last = r.arc_length;
    count += 1;
    for (std::size_t i = 0; i < wheelsets; ++i) {
      for (const auto& wheel : r.wheelsets[i].wheels) {
        mean.lateral += wheel.force_y;
        mean.vertical += wheel.force_z;
      }
    }
  }
  REQUIRE(count > 10);
  mean.lateral /= count;
  mean.vertical /= count;
  mean.speed = (last - first) / (end - begin);
  return mean;
}

using RealWheelset = Wheelset<RealWheel>;

// What a VehicleOnTrack keeps references to.
struct World {
  RealWheelset wheelset{s1002<double>(), 0.43, 1.5};
  TangentTrack<examples::RailHead> track{uic50<double>()};
  ContactForceModel<double> model;
  StripSearch<double> search;

  [[nodiscard]] VehicleOnTrack put_on(const Vehicle& vehicle) const {
    return {vehicle, wheelset, track, model, search};
  }
};

constexpr std::size_t carbody = 10;

// The vehicle with its carbody's centre of mass elsewhere; the springs stay where they are.
Vehicle with_centre_of_mass_moved(Vehicle vehicle, const Vector3<double>& by) {
  vehicle.positions[carbody] += by;
  for (auto& spring : vehicle.model.spring_dampers) {
    if (spring.a == static_cast<int>(carbody)) spring.point_a -= by;
    if (spring.b == static_cast<int>(carbody)) spring.point_b -= by;
  }
  return vehicle;
}

double greatest_acceleration(const VehicleState& rate, std::size_t body) {
  const Eigen::Index offset = RigidBodyLayout::offset(static_cast<Eigen::Index>(body));
  return rate.segment<6>(offset + RigidBodyLayout::velocity_world).cwiseAbs().maxCoeff();
}

double sum_of_loads(const StandingVehicle& standing) {
  double sum = 0;
  for (const auto& loads : standing.wheel_loads) sum += loads[0] + loads[1];
  return sum;
}

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE(
    "VehicleOnTrack::start: bodies on springs are in balance, the wheels just above the rails",
    "[examples]") {
  const World world;
  const Vehicle vehicle = build_vehicle(data(), VehicleKind::vehicle);
  const auto moved = GENERATE(Vector3<double>(0, 0, 0), Vector3<double>(0.8, 0.1, 0.2));
  const double shift = GENERATE(0.0, 0.003);
  CAPTURE(moved.transpose(), shift);
  const Vehicle uneven = with_centre_of_mass_moved(vehicle, moved);
  auto motion = world.put_on(uneven);
  VehicleCase run;
  run.lateral_shift = shift;
  const VehicleState y = motion.start(run);
  const VehicleState rate = motion(0, y);
  for (std::size_t body = 0; body < uneven.model.bodies.size(); ++body) {
    CAPTURE(uneven.names[body]);
    const auto state = unpack_rigid_body(y, static_cast<int>(body));
    CHECK(state.position_world.y() - uneven.positions[body].y() == Approx(shift).margin(1e-4));
    // With the wheelsets' tilt of 0.04 mrad, and where the axles' height puts them.
    CHECK(std::abs(state.position_world.z() - uneven.positions[body].z()) < 1e-3);
    if (uneven.names[body].ends_with("frame") || body == carbody) {
      CHECK(greatest_acceleration(rate, body) < 1e-7);
    } else {
      CHECK(greatest_acceleration(rate, body) > 40);  // what they carry presses them down
    }
  }
  for (const int body : uneven.wheelsets) {
    const auto state = unpack_rigid_body(y, body);
    const Vector3<double> axle = rotation_matrix(state.orientation).col(1);
    for (const Side side : sides) {
      const auto nearest = wheelrail::detail::nearest_point(
          world.wheelset.wheel(side), world.track.rail(side),
          place_wheel(world.wheelset, world.track, side, {state.position_world, axle, 0}));
      CHECK(nearest.penetration == Approx(-run.starting_gap).margin(1e-12));
    }
  }
  // A symmetric vehicle's springs share their loads equally.
  if (moved.norm() > 0) return;
  for (const auto& spring : motion.system().model().spring_dampers) {
    const bool is_primary =
        spring.a != static_cast<int>(carbody) && spring.b != static_cast<int>(carbody);
    const double load = is_primary ? -(2000 + 10000) * 9.81 / 4 : 20000 * 9.81 / 4;
    CHECK(spring.preload_a.z() == Approx(load).epsilon(1e-9));
  }
}

TEST_CASE("VehicleOnTrack::start: what cannot stand or balance is refused",
          "[examples][bad-input]") {
  const World world;
  const Vehicle vehicle = build_vehicle(data(), VehicleKind::vehicle);
  Vehicle lame = vehicle;
  for (auto& spring : lame.model.spring_dampers) {
    if (spring.b == static_cast<int>(carbody)) spring.point_a.y() = spring.point_b.y() = 0.95;
  }
  CHECK_THAT(message_of([&] { static_cast<void>(world.put_on(lame)); }),
             ContainsSubstring("springs cannot hold its bodies in balance"));
  auto motion = world.put_on(vehicle);
  const auto starting = [&](double shift) {
    VehicleCase run;
    run.lateral_shift = shift;
    return message_of([&] { static_cast<void>(motion.start(run)); });
  };
  CHECK(starting(0.006).empty());
  CHECK_THAT(starting(0.02), ContainsSubstring("cannot be set down") &&
                                 ContainsSubstring("0.02 m") &&
                                 ContainsSubstring("its left flange would stand on the rail head"));
  CHECK_THAT(starting(0.2),
             ContainsSubstring("cannot be set down") && ContainsSubstring("(not_finite)"));
}

TEST_CASE("VehicleOnTrack::standing: wheel loads are those of statics", "[examples][reference]") {
  const World world;
  const Vehicle vehicle = build_vehicle(data(), VehicleKind::vehicle);
  const auto stand = [&](const Vehicle& v) {
    auto motion = world.put_on(v);
    VehicleCase run;
    run.lateral_shift = 0;
    const auto standing = motion.standing(run);
    REQUIRE(standing.status == SolveStatus::converged);
    // Accelerations below 1.5e-8 m/s2 leave no more than 1e-8 of the weight.
    CHECK(sum_of_loads(standing) == Approx(weight_of(v)).epsilon(1e-8));
    return standing;
  };
  const double weight = weight_of(vehicle), of_carbody = 20000 * 9.81;
  const auto even = stand(vehicle);
  for (const auto& loads : even.wheel_loads) {
    for (const double load : loads) CHECK(load == Approx(weight / 8).epsilon(1e-8));
  }

  // Along the vehicle: the lever between the bogies, 11.1 m apart. The front's contacts and springs
  // give more, which pitches the vehicle by a microradian: 1e-7 of the loads.
  const auto forward = stand(with_centre_of_mass_moved(vehicle, {1, 0, 0}));
  for (std::size_t i = 0; i < 4; ++i) {
    const double lever = (i < 2 ? 1.0 : -1.0) / 11.1;
    for (const double load : forward.wheel_loads[i]) {
      CHECK(load == Approx(weight / 8 + of_carbody * lever / 4).epsilon(1e-6));
    }
  }

  // Across: the moment about the middle between the rails, of loads where the wheels touch.
  const double offset = 0.1;
  const Vehicle leaning = with_centre_of_mass_moved(vehicle, {0, offset, 0});
  const auto left_heavy = stand(leaning);
  auto motion = world.put_on(leaning);
  double moment = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto contact = motion.forces(left_heavy.state, i);
    for (const Side side : sides) {
      REQUIRE(contact.wheel(side).patches.size() == 1);
      moment += left_heavy.wheel_loads[i][index_of(side)] *
                contact.wheel(side).patches[0].position_track.y();
    }
    const auto& [left, right] = left_heavy.wheel_loads[i];
    CHECK(left + right == Approx(weight / 4).epsilon(1e-8));
    // A quarter of the moment each, the contacts about 0.76 m from the middle.
    CHECK(left - right == Approx(of_carbody * offset / 4 / 0.76).epsilon(0.01));
  }
  // The contacts' flattening leans the vehicle by a few microradians.
  CHECK(moment == Approx(of_carbody * offset).epsilon(1e-3));
}

TEST_CASE("bogie case: methods, damping and the place on the rail are the paper's",
          "[examples][reference]") {
  const Vehicle bogie = build_vehicle(data(), VehicleKind::bogie);
  REQUIRE(bogie.model.bodies.size() == 5);
  const ConvexWheel profile(s1002<double>());
  const Wheelset wheelset(profile, 0.43, 1.5);
  const TangentTrack track(uic50<double>());
  const ContactForceModel<double> model;
  const VehicleCase run;
  const auto strips = run_vehicle(bogie, wheelset, track, model, StripSearch<double>{}, run);
  const auto by_distance = run_vehicle(
      bogie, wheelset, track, model, MinimumDistanceSearch<double>{convex_parts(profile), {}}, run);
  REQUIRE(strips.status == IntegrationStatus::finished);
  REQUIRE(by_distance.status == IntegrationStatus::finished);
  REQUIRE(strips.failures + by_distance.failures == 0);
  double apart = 0, early = 0, late = 0, least = 1, greatest = -1;
  for (std::size_t i = 0; i < strips.records.size(); ++i) {
    const auto& r = strips.records[i];
    apart = std::max(apart, std::abs(r.wheelsets[0].lateral_shift -
                                     by_distance.records[i].wheelsets[0].lateral_shift));
    const double shift = std::abs(r.wheelsets[0].lateral_shift);
    if (r.time < 4) early = std::max(early, shift);
    if (r.time > 6) late = std::max(late, shift);
    if (r.time < 1) continue;
    REQUIRE(r.wheelsets[0].wheels[0].patch_count == 1);
    least = std::min(least, r.wheelsets[0].wheels[0].patches[0].rail_lateral);
    greatest = std::max(greatest, r.wheelsets[0].wheels[0].patches[0].rail_lateral);
  }
  CHECK(apart < 10e-9);
  CHECK(late < 0.6 * early);  // the single wheelset's oscillation grows
  CHECK(greatest - least < 0.05e-3);
  CHECK(strips.constraint_violation < 1e-7);

  const auto single = run_wheelset(wheelset, track, model, StripSearch<double>{}, WheelsetCase{});
  double single_late = 0;
  for (const auto& r : single.records) {
    if (r.time > 6) single_late = std::max(single_late, std::abs(r.lateral_shift()));
  }
  CHECK(late < 0.7 * single_late);

  const auto mean = mean_forces(strips, 2, 8, 10);
  CHECK(mean.vertical == Approx(weight_of(bogie)).epsilon(1e-4));
  CHECK(std::abs(mean.lateral) < 2e-3 * weight_of(bogie));
}

TEST_CASE("VehicleOnTrack: each vehicle file stands in balance", "[examples]") {
  for (const char* name : {"metro_trailer.csv", "manchester_vehicle1.csv"}) {
    CAPTURE(name);
    const Vehicle vehicle = build_vehicle(VehicleData(vehicle_path(name)), VehicleKind::vehicle);
    const RealWheelset wheelset(s1002<double>(), vehicle.wheel_radius, vehicle.profile_spacing);
    const World world;
    VehicleOnTrack motion(vehicle, wheelset, world.track, world.model, world.search);
    const auto rate = motion(0, motion.start({}));
    const auto carrier = wheelset_of_bodies(vehicle);
    for (std::size_t body = 0; body < carrier.size(); ++body) {
      if (carrier[body] == ground_body) CHECK(greatest_acceleration(rate, body) < 1e-7);
    }
    const auto standing = motion.standing({});
    CHECK(standing.status == SolveStatus::converged);
    CHECK(sum_of_loads(standing) == Approx(weight_of(vehicle)).epsilon(1e-8));
  }
}

// Steady curving, in closed form: how far the carbody and the frames lean and shift on their springs,
// and the moment of all forces about the line midway between the rails. Outwards is positive.
struct SteadyCurving {
  double lateral_shift = 0;  // of the carbody's centre of mass, in the track plane [m]
  double moment = 0;         // [N m]
};

// lateral, vertical: centrifugal acceleration and gravity in the track plane [m/s2]. wheelset_shift,
// wheelset_roll: means of the wheelsets [m, rad]. spin: moment that turns the spinning wheelsets.
SteadyCurving steady_curving(double lateral, double vertical, double wheelset_shift,
                             double wheelset_roll, double spin) {
  const double car = data()["carbody mass"], frames = 2 * data()["bogie frame mass"];
  const double axles =
      4 * (data()["wheelset mass"] + data()["axlebox body mass (both boxes of one wheelset)"]);
  const double radius = data()["wheel radius"];
  const double car_height = data()["carbody centre of mass height"];
  const double frame_height = data()["bogie frame centre of mass height"];
  const double spring_height = data()["secondary height above rail"];
  const auto roll_stiffness = [](int count, double stiffness, double half_width) {
    return count * stiffness * half_width * half_width;
  };
  const double primary_roll =
      roll_stiffness(8, data()["primary kz per box"], data()["primary lateral semi-distance"]);
  const double secondary_roll =
      roll_stiffness(4, data()["secondary kz per side"], data()["secondary lateral semi-distance"]);
  const double primary = 8 * data()["primary ky per box"];
  const double secondary = 4 * data()["secondary ky per side"];
  const double arm = car_height - spring_height;
  // Springs give along the axes of the frames, which lean; moments are taken about the axles for the
  // frames, about the secondary springs for the carbody. Each pass is several times nearer.
  double frame_roll = wheelset_roll, car_roll = wheelset_roll, frame_shift = 0, car_shift = 0;
  for (int i = 0; i < 30; ++i) {
    const double push = lateral + vertical * frame_roll;
    const double slide = wheelset_shift + (car + frames) * push / primary;
    frame_shift = slide + frame_roll * (frame_height - radius);
    car_shift =
        slide + frame_roll * (spring_height - radius) + car * push / secondary + car_roll * arm;
    frame_roll =
        wheelset_roll +
        (car * (lateral * (car_height - radius) + vertical * (car_shift - wheelset_shift)) +
         frames * (lateral * (frame_height - radius) + vertical * (frame_shift - wheelset_shift))) /
            primary_roll;
    car_roll = frame_roll + car * arm * (lateral + vertical * car_roll) / secondary_roll;
  }
  const auto moment = [&](double mass, double height, double shift) {
    return mass * (lateral * height + vertical * shift);
  };
  return {car_shift, moment(car, car_height, car_shift) +
                         moment(frames, frame_height, frame_shift) +
                         moment(axles, radius, wheelset_shift) + spin};
}

TEST_CASE("vehicle case: in the curve the forces carry weight, cant deficiency and their moment",
          "[examples][reference]") {
  const Vehicle vehicle = build_vehicle(data(), VehicleKind::vehicle);
  REQUIRE(vehicle.model.bodies.size() == 11);
  CurveLayout layout;
  layout.approach = 20;  // short, so that the arc is reached soon
  layout.arc = 200;
  const auto track = curved_track(uic50<double>(), layout, {});
  const World world;
  VehicleCase run;
  run.start = vehicle_start;
  run.duration = 10;
  require_length(track, vehicle, run);
  VehicleOnTrack motion(vehicle, world.wheelset, track, world.model, world.search);
  // Sums of the mean, over the last seconds, by which time the transition has died away.
  const double begin = 8;
  double count = 0, lateral = 0, vertical = 0, moment = 0, first = 0, last = 0;
  double wheelset_shift = 0, wheelset_roll = 0, car_shift = 0, derailments = 0;
  const auto result = integrate<VehicleState>(
      motion, 0.0, motion.start(run), run.duration, 0.01, run.integrator,
      [&](double t, const VehicleState& y) {
        if (t < begin) return true;
        const auto seen = motion.observe(t, y);
        if (seen.derailment) ++derailments;
        if (count == 0) first = seen.record.arc_length;
        last = seen.record.arc_length;
        ++count;
        // Outwards is to the right.
        const auto plane = [&](const Vector3<double>& place) {
          const auto frame = track.nearest_frame(Side::left, place, last);
          const auto other = track.nearest_frame(Side::right, place, last);
          Matrix3<double> axes;
          axes.col(0) = frame.axes_track.col(0);
          axes.col(1) = (other.origin_track - frame.origin_track).normalized();
          axes.col(2) = cross(Vector3<double>(axes.col(1)), Vector3<double>(axes.col(0)));
          return std::pair(Vector3<double>((frame.origin_track + other.origin_track) / 2), axes);
        };
        for (std::size_t i = 0; i < 4; ++i) {
          const auto state = unpack_rigid_body(y, vehicle.wheelsets[i]);
          const auto contact = motion.forces(y, i);
          const auto [middle, axes] = plane(state.position_world);
          const Vector3<double> arm = state.position_world - middle;
          const Vector3<double> about_middle =
              contact.moment_track + cross(arm, contact.force_track);
          lateral -= contact.force_track.dot(axes.col(1));
          vertical += contact.force_track.dot(axes.col(2));
          moment -= about_middle.dot(axes.col(0));
          wheelset_shift += arm.dot(axes.col(1)) / 4;
          wheelset_roll += rotation_matrix(state.orientation).col(1).dot(axes.col(2)) / 4;
        }
        // The carbody's middle lies on the level chord between its bogies, not on the arc.
        const auto place = unpack_rigid_body(y, static_cast<int>(carbody)).position_world;
        const auto [middle, axes] = plane(place);
        const double chord = (11.1 * 11.1 + 2.1 * 2.1) / 8 / layout.radius;
        car_shift += (place - middle).dot(axes.col(1)) +
                     chord * std::sqrt(1 - std::pow(layout.cant / 1.5, 2));
        return true;
      });
  REQUIRE(result.status == IntegrationStatus::finished);
  CHECK(derailments == 0);
  CHECK(motion.failures() == 0);
  CHECK(motion.system().constraint_violation(result.state).residual < 1e-6);
  for (double* sum : {&lateral, &vertical, &moment, &wheelset_shift, &wheelset_roll, &car_shift}) {
    *sum /= count;
  }
  const double speed = (last - first) / (run.duration - begin);
  const double mass = weight_of(vehicle) / 9.81;
  const double sine = layout.cant / 1.5, cosine = std::sqrt(1 - sine * sine);
  const double centrifugal = speed * speed / layout.radius;
  const double outwards = centrifugal * cosine - 9.81 * sine;
  const double down = 9.81 * cosine + centrifugal * sine;
  // The axles turn with the curve: rate of turning times angular momentum.
  const double spin = 4 * 80.0 * (speed / 0.43) * (speed / layout.radius);
  const auto expected = steady_curving(outwards, down, wheelset_shift, wheelset_roll, spin);
  // Measured 4e-6, 3e-4, 1.1e-3 (3e-3 further on) and 1e-4: what swings on after the transition, and
  // second powers of the small angles, a percent.
  CHECK(vertical == Approx(mass * down).epsilon(1e-4));
  CHECK(lateral == Approx(mass * outwards).epsilon(2e-3));
  CHECK(moment == Approx(expected.moment).epsilon(5e-3));
  CHECK(car_shift == Approx(expected.lateral_shift).epsilon(5e-3));
}

TEST_CASE("vehicle case: a run is repeated bit for bit", "[examples]") {
  const Vehicle vehicle = build_vehicle(data(), VehicleKind::vehicle);
  CurveLayout layout;
  layout.approach = 20;
  layout.arc = 30;
  const auto track = curved_track(uic50<double>(), layout, {});
  const Wheelset wheelset(s1002<double>(), 0.43, 1.5);
  VehicleCase run;
  run.start = vehicle_start;
  run.duration = 1;
  const auto once = [&] {
    return run_vehicle(vehicle, wheelset, track, ContactForceModel<double>(), StripSearch<double>{},
                       run);
  };
  const auto a = once(), b = once();
  REQUIRE(a.records.size() == b.records.size());
  for (std::size_t i = 0; i < a.records.size(); ++i) {
    REQUIRE(a.records[i].wheelsets[0].lateral_shift == b.records[i].wheelsets[0].lateral_shift);
    REQUIRE(a.records[i].wheelsets[3].wheels[1].force_y ==
            b.records[i].wheelsets[3].wheels[1].force_y);
  }
}

TEST_CASE("bogie case: with smaller tolerances and with shorter steps lateral shifts converge",
          "[examples]") {
  const World world;
  const Vehicle bogie = build_vehicle(data(), VehicleKind::bogie);
  const auto with = [&](double tolerance, double maximum_step) {
    VehicleCase run;
    run.duration = 1;
    run.report_interval = 0.05;
    run.integrator = {.relative_tolerance = tolerance,
                      .absolute_tolerance = tolerance,
                      .maximum_step = maximum_step};
    auto history = run_vehicle(bogie, world.wheelset, world.track, world.model, world.search, run);
    REQUIRE(history.status == IntegrationStatus::finished);
    return history;
  };
  const auto apart = [&](const VehicleHistory& a, const VehicleHistory& b) {
    double greatest = 0;
    for (std::size_t i = 0; i < a.records.size(); ++i) {
      for (std::size_t k = 0; k < 2; ++k) {
        greatest = std::max(greatest, std::abs(a.records[i].wheelsets[k].lateral_shift -
                                               b.records[i].wheelsets[k].lateral_shift));
      }
    }
    return greatest;
  };
  // The tolerance alone chooses the steps: measured 0.36 um, 12 nm, 4 nm, 0.6 nm, 0.06 nm.
  std::vector<VehicleHistory> runs;
  for (const double tolerance : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
    runs.push_back(with(tolerance, 0));
  }
  double before = 1;
  for (std::size_t i = 1; i < runs.size(); ++i) {
    const double difference = apart(runs[i - 1], runs[i]);
    CAPTURE(i, difference, before);
    CHECK(difference < before / 2);
    before = difference;
  }
  CHECK(before < 1e-10);
  // A tolerance that never rejects leaves equal steps: of order 5, 32 times less for each half.
  before = 1;
  for (const double step : {1e-3, 0.5e-3, 0.25e-3}) {
    const double error = apart(with(1e-2, step), runs.back());
    CAPTURE(step, error, before);
    CHECK(error < before / 10);
    before = error;
  }
  // At the programs' defaults the longest step of 1 ms decides: 10 nm.
  CHECK(apart(with(1e-5, 1e-3), runs.back()) < 20e-9);
}

TEST_CASE("run_vehicle: a wheel that leaves its rail ends the run, which keeps its records",
          "[examples]") {
  const World world;
  const Vehicle vehicle = build_vehicle(data(), VehicleKind::vehicle);
  struct Way {
    double radius, speed, friction;
    const char *wheel, *how;
  };
  const Way way = GENERATE(
      // 1.74 g outwards turn the vehicle over the outer rail; at 0.68 g and with that
      // friction the outer flange climbs before (Nadal: from 0.47 of the wheel's load on), at
      // the same place for starts that differ by rounding. In wider curves that friction makes
      // a motion of which rounding decides when and how it ends.
      Way{60, 32, 0.6, "the front leading wheelset's left wheel left its rail", "it is lifted"},
      Way{60, 20, 1, "the front leading wheelset's right wheel left its rail",
          "its flange stands on the rail head"});
  CAPTURE(way.how);
  const auto track = curved_track(
      uic50<double>(),
      {.approach = 20, .transition = 30, .arc = 300, .radius = way.radius, .cant = 0}, {});
  const ContactForceModel<double> rough({.friction_coefficient = way.friction});
  VehicleCase run;
  run.speed = way.speed;
  run.start = vehicle_start;
  run.duration = 5;
  run.report_interval = 5e-3;
  const auto history = run_vehicle(vehicle, world.wheelset, track, rough, world.search, run);
  REQUIRE(history.derailment);
  CAPTURE(*history.derailment, history.end_time);
  CHECK_THAT(*history.derailment, ContainsSubstring(way.wheel) && ContainsSubstring(way.how));
  CHECK_THAT(*history.derailment, ContainsSubstring(format(" at %.3f s, ", history.end_time)) &&
                                      ContainsSubstring(" m along the track: "));
  CHECK(history.status == IntegrationStatus::stopped_by_observer);
  CHECK(history.failures == 0);
  CHECK_FALSE(history.failed_search);
  // When and where: behind the transition's middle, at the last record.
  CHECK(history.end_time == history.records.back().time);
  const double place = history.records.back().arc_length;
  CHECK(place == Approx(run.start + 6.6 + run.speed * history.end_time).epsilon(0.02));
  CHECK((35 < place && place < 100));
  CHECK(history.records.size() == Approx(history.end_time / run.report_interval + 1).margin(1.01));
  // No record lies beyond what the criterion lets pass.
  for (const auto& r : history.records) CHECK(std::abs(r.wheelsets[0].lateral_shift) < 0.03);
}

TEST_CASE("VehicleOnTrack::observe: lifted, on its flange or beside its rail a wheel is off",
          "[examples]") {
  const Vehicle bogie = build_vehicle(data(), VehicleKind::bogie);
  const World world;
  const auto seen = [&](const TangentTrack<examples::RailHead>& track, double shift, double lift) {
    VehicleOnTrack motion(bogie, world.wheelset, track, world.model, world.search);
    VehicleState y = VehicleState::Zero(motion.system().state_size());
    for (std::size_t body = 0; body < 5; ++body) {
      RigidBodyState<double> state;
      state.position_world = bogie.positions[body] + Vector3<double>(0, shift, lift);
      y.segment<13>(RigidBodyLayout::offset(static_cast<Eigen::Index>(body))) = pack(state);
    }
    return motion.observe(1.5, y).derailment.value_or("on the rails");
  };
  const TangentTrack<examples::RailHead> wide(uic50<double>(), {.gauge = 1.545});
  CHECK(seen(world.track, 0, 0) == "on the rails");
  CHECK(seen(world.track, 0.0062, 0) == "on the rails");  // at the flange
  // S1002's flange is 28 mm high. Lifted by less, it still guides.
  CHECK(seen(world.track, 0, 0.027) == "on the rails");
  CHECK_THAT(seen(world.track, 0, 0.029),
             ContainsSubstring(
                 "the leading wheelset's left wheel left its rail at 1.500 s, 1.1 m along the "
                 "track: it is lifted higher than its flange"));
  // The flange on the head's middle.
  CHECK_THAT(
      seen(world.track, -0.05, 0.027),
      ContainsSubstring("right wheel") && ContainsSubstring("its flange stands on the rail head"));
  CHECK_THAT(seen(world.track, 0.05, 0.027),
             ContainsSubstring("left wheel") && ContainsSubstring("stands"));
  // Rails too far apart: the right wheel drops between them.
  CHECK(seen(wide, 0, 0) == "on the rails");
  CHECK_THAT(seen(wide, 0.006, 0),
             ContainsSubstring("right wheel") && ContainsSubstring("inside the rail head"));
}

TEST_CASE("run_vehicle: searches that fail end the run with time and place", "[examples]") {
  const World world;
  const Vehicle bogie = build_vehicle(data(), VehicleKind::bogie);
  // 4 m of track: nobody asked require_length.
  const NodalTrack<examples::RailHead> track(
      uic50<double>(), CentreLine<double>({TrackSegment<double>::tangent(4)}));
  VehicleCase run;
  run.start = 2;
  run.speed = 5;
  const auto history = run_vehicle(bogie, world.wheelset, track, world.model, world.search, run);
  CHECK(history.status == IntegrationStatus::not_finite);
  REQUIRE(history.failed_search);
  CHECK_THAT(*history.failed_search,
             ContainsSubstring("the contact search of the leading wheelset's left wheel failed "
                               "(not_finite) at 0.190 s, 4.0 m along the track"));
  CHECK(history.end_time == Approx((4 - 2 - 1.05) / 5).epsilon(1e-3));
  CHECK(history.records.back().time == history.end_time);
  CHECK(history.records.size() > 180);
  CHECK(history.failures < 200);

  // So does a start too deep in the rails.
  VehicleCase deep;
  deep.starting_gap = -0.011;
  const auto at_once =
      run_vehicle(bogie, world.wheelset, world.track, world.model, world.search, deep);
  CHECK(at_once.status == IntegrationStatus::not_finite);
  CHECK(at_once.end_time == 0);
  CHECK(at_once.records.size() == 1);
  CHECK_THAT(at_once.failed_search.value_or(""), ContainsSubstring("(too_deep) at 0.000 s"));
}

TEST_CASE("require_length: the vehicle starts on straight track and ends on the track",
          "[examples][bad-input]") {
  const Vehicle vehicle = build_vehicle(data(), VehicleKind::vehicle);
  const auto track = curved_track(uic50<double>(), {.approach = 20}, {});
  const auto with = [&](double start, double duration) {
    VehicleCase run;
    run.speed = 10;
    run.start = start;
    run.duration = duration;
    return message_of([&] { require_length(track, vehicle, run); });
  };
  // 742 m long; the vehicle reaches 6.6 m to both ends, and the cant begins 2 m before the curve.
  CHECK(with(10, 10).empty());
  CHECK(with(6.6, 72.7).empty());
  CHECK_THAT(with(6.6, 72.9),
             ContainsSubstring("the track is 742") && ContainsSubstring("run needs 743.2"));
  CHECK_THAT(with(6.5, 10),
             ContainsSubstring("starts 0.1 m before the track") && ContainsSubstring("6.6 m"));
  CHECK(with(11.3, 10).empty());
  CHECK_THAT(with(11.5, 10),
             ContainsSubstring("straight and level") && ContainsSubstring("18.1 m along it"));
  CHECK_THAT(with(std::nan(""), 10), ContainsSubstring("straight and level"));
}

TEST_CASE("VehicleData: what is missing or wrong is named", "[examples][bad-input]") {
  const auto path = std::filesystem::temp_directory_path() /
                    ("wheelrail-vehicle-" + std::to_string(getpid()) + ".csv");
  const auto with = [&](const std::string& text) {
    std::ofstream(path) << text;
    return build_vehicle(VehicleData(path.string()), VehicleKind::bogie);
  };
  const std::string header = "quantity,value,unit,source\n";
  CHECK_THROWS_WITH(with("quantity,value,unit\nwheel radius,0.43,m\n"),
                    ContainsSubstring("lacks the quantity"));
  CHECK_THROWS_WITH(with("quantity,value,unit\nwheel radius,-0.43,m\n"),
                    ContainsSubstring(":2: 'wheel radius' is -0.43") && ContainsSubstring("> 0"));
  CHECK_THROWS_WITH(with("quantity,value,unit\nwheel radius,much,m\n"), ContainsSubstring(":2: "));
  CHECK_THROWS_WITH(with("wheel radius,0.43,m\n"), ContainsSubstring(":1: the header"));
  CHECK_THROWS_WITH(with(header + "wheel radius,1,m\nwheel radius,2,m\n"),
                    ContainsSubstring(":3: 'wheel radius' is given twice"));
  CHECK_THROWS_WITH(with(header + "wheel radius,1,m,unconfirmed\nwheel radius,2,m,confirmed\n"),
                    ContainsSubstring(":3: 'wheel radius' is given twice"));
  CHECK_THROWS_WITH(with(""), ContainsSubstring("no header"));
  std::filesystem::remove(path);
  CHECK_THROWS_WITH(VehicleData("/nowhere.csv"), ContainsSubstring("cannot open '/nowhere.csv'"));
  const std::string directory = std::filesystem::temp_directory_path().string();
  CHECK_THROWS_WITH(VehicleData(directory),
                    ContainsSubstring("'" + directory + "' is not a readable file"));
  CHECK_THROWS_AS(data().has("wheel diameter"), std::logic_error);
}
