// The bogie and the vehicle of the paper (§6.2, §6.3): what examples/bogie_on_tangent_track and
// vehicle_on_curved_track run.

#include "support/vehicle_run.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "../support/catch.hpp"
#include "support/curve.hpp"
#include "support/profiles.hpp"
#include "support/vehicle_output.hpp"
#include "support/wheelset_run.hpp"

using namespace wheelrail;
using namespace examples;

namespace {

const VehicleData& data() {
  static const VehicleData value(std::string(WHEELRAIL_SOURCE_DIR) +
                                 "/examples/vehicles/metro_trailer.csv");
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

}  // namespace

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

TEST_CASE("vehicle case: in the curve the forces carry weight and cant deficiency",
          "[examples][reference]") {
  const Vehicle vehicle = build_vehicle(data(), VehicleKind::vehicle);
  REQUIRE(vehicle.model.bodies.size() == 11);
  CurveLayout layout;
  layout.approach = 20;  // short, so that the arc is reached soon
  layout.arc = 200;
  const auto track = curved_track(uic50<double>(), layout, {});
  const Wheelset wheelset(s1002<double>(), 0.43, 1.5);
  VehicleCase run;
  run.start = vehicle_start;
  run.duration = 10;
  require_length(track, vehicle, run);
  const auto history = run_vehicle(vehicle, wheelset, track, ContactForceModel<double>(),
                                   StripSearch<double>{}, run);
  REQUIRE(history.status == IntegrationStatus::finished);
  REQUIRE_FALSE(history.derailment);
  CHECK(history.failures == 0);
  CHECK(history.constraint_violation < 1e-6);
  const auto mean = mean_forces(history, 4, 8, 9.5);
  const double mass = weight_of(vehicle) / 9.81;
  const double sine = layout.cant / 1.5, cosine = std::sqrt(1 - sine * sine);
  const double centripetal = mean.speed * mean.speed / layout.radius;
  CHECK(mean.vertical == Approx(mass * (9.81 * cosine + centripetal * sine)).epsilon(5e-3));
  CHECK(mean.lateral == Approx(mass * (centripetal * cosine - 9.81 * sine)).epsilon(0.02));
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

TEST_CASE("VehicleData: what is missing or wrong is named", "[examples][bad-input]") {
  using Catch::Matchers::Contains;
  const auto path = std::filesystem::temp_directory_path() /
                    ("wheelrail-vehicle-" + std::to_string(getpid()) + ".csv");
  const auto with = [&](const std::string& text) {
    std::ofstream(path) << text;
    return build_vehicle(VehicleData(path.string()), VehicleKind::bogie);
  };
  CHECK_THROWS_WITH(with("quantity,value,unit\nwheel radius,0.43,m\n"),
                    Contains("lacks the quantity"));
  CHECK_THROWS_WITH(with("quantity,value,unit\nwheel radius,-0.43,m\n"),
                    Contains("'wheel radius' is -0.43") && Contains("> 0"));
  CHECK_THROWS_WITH(with("quantity,value,unit\nwheel radius,much,m\n"), Contains(":2: "));
  CHECK_THROWS_WITH(with("wheel radius,0.43,m\n"), Contains(":1: the header"));
  CHECK_THROWS_WITH(with("quantity,value,unit\na,1,m\na,2,m\n"), Contains("given twice"));
  CHECK_THROWS_WITH(with(""), Contains("no header"));
  std::filesystem::remove(path);
  CHECK_THROWS_WITH(VehicleData("/nowhere.csv"), Contains("cannot open '/nowhere.csv'"));
}
