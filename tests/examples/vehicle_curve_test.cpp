// The vehicle in the curve (§6.3 of the paper): what its wheels show, and how it is read off.

#include <unistd.h>

#include "../support/catch.hpp"
#include "support/curve.hpp"
#include "support/study_figures.hpp"
#include "support/study_report.hpp"

using namespace wheelrail;
using namespace examples;

namespace {

// A record whose leading wheelset's right wheel touches at these places [m].
VehicleRecord touching_at(double time, std::initializer_list<double> wheel_laterals) {
  VehicleRecord record;
  record.time = time;
  WheelRecord& wheel = record.wheelsets[0].wheels[index_of(Side::right)];
  for (const double lateral : wheel_laterals) {
    wheel.patches[static_cast<std::size_t>(wheel.patch_count++)] = {.wheel_lateral = lateral,
                                                                    .rail_lateral = 0,
                                                                    .penetration = 1e-4,
                                                                    .normal_force = 2000,
                                                                    .semi_axis_a = 0.005,
                                                                    .semi_axis_b = 0.002};
    wheel.normal_force += 2000;
  }
  return record;
}

VehicleHistory by_hand() {
  VehicleHistory history;
  history.records = {touching_at(0.5, {0.01}),
                     touching_at(1.0, {-0.03, 0.005}),
                     touching_at(1.5, {-0.03, -0.017, 0.005}),
                     touching_at(2.0, {0.005}),
                     touching_at(2.5, {-0.032}),
                     touching_at(3.0, {-0.019})};
  return history;
}

VehicleHistory in_the_curve(const auto& profile, const auto& search) {
  const VehicleData data(std::string(WHEELRAIL_SOURCE_DIR) +
                         "/examples/vehicles/metro_trailer.csv");
  const Vehicle vehicle = build_vehicle(data, VehicleKind::vehicle);
  const Wheelset wheelset(profile, vehicle.wheel_radius, vehicle.profile_spacing);
  VehicleCase run;
  run.duration = 41;
  run.start = vehicle_start;
  run.report_interval = curve_report_interval;
  return run_vehicle(vehicle, wheelset, curved_track(uic50<double>(), {}, {}),
                     ContactForceModel<double>(), search, run);
}

}  // namespace

TEST_CASE("curve_contact: begin, end and shares of flange contact by hand", "[examples]") {
  const CurveContact contact = curve_contact(by_hand());
  CHECK(contact.begin == 1.0);
  CHECK(contact.end == 2.5);
  CHECK(contact.share[0] == 0);
  CHECK(contact.share[1] == 0.5);
  CHECK(contact.share[2] == 0.25);
  CHECK(contact.share[3] == 0.25);
  CHECK(flange_contact_text(contact) == "1 to 2.5");
  CHECK(flange_contact_text(curve_contact({})) == "none");
}

TEST_CASE("patches_seen: when there are three patches, and where at 20 s", "[examples]") {
  VehicleHistory history = by_hand();
  CHECK(examples::detail::patches_seen(history) == "three patches or more from 1.50 to 1.50 s");
  history.records.push_back(touching_at(20, {-0.0324}));
  CHECK(examples::detail::patches_seen(history) ==
        "three patches or more from 1.50 to 1.50 s; at 20 s u_w = -32.4 mm (2.0 kN)");
  CHECK(examples::detail::patches_seen({}) == "never three patches");
}

TEST_CASE("ellipses_table: outlines at the paper's instants", "[examples]") {
  const std::string table = ellipses_table(by_hand());
  // At 1 s two outlines of 73 points, the first from its greatest lateral coordinate; then none.
  CHECK(table.find("# t = 1 s\n-28.000000 0.000000 2.0000\n") != std::string::npos);
  CHECK(table.find("\n7.000000 0.000000 2.0000\n") != std::string::npos);
  CHECK(table.find("# t = 6 s\nnan nan nan\n\n\n# t = 20 s\nnan nan nan") != std::string::npos);
  CHECK(std::count(table.begin(), table.end(), '\n') == 1 + 4 + 2 * 74 + 1 + 3 * 3);
  CHECK(outer_wheel_table(by_hand()).starts_with(
      "time,patches,patch,wheel_lateral_mm,normal_force_kN\n0.5,1,0,10,2\n1,2,0,-30,2\n"));
}

TEST_CASE("kinematic_wavelength: a cone's is Klingel's", "[examples][reference]") {
  // 2 pi sqrt(R0 e / (2 conicity)), e the distance of the contact points. The axle's roll shifts a
  // cone of slope 1/20 over a crown of 300 mm: conicity = slope / (1 - slope (R0 + 0.3 m) / (e / 2)),
  // to the order of slope squared. On the S1002 it is that of the study's run to 1 %.
  const TangentTrack track(uic50<double>());
  const RealWheel cone({ProfilePiece<double>::line(-0.03, 0.06, 0, 0, -0.05)});
  const Wheelset wheelset(cone, 0.43, 1.5);
  const auto contact = touching_position(wheelset, track, 0).patches;
  const double distance = 1.5 + contact[0].wheel_lateral + contact[1].wheel_lateral;
  const double conicity = 0.05 / (1 - 0.05 * (0.43 + 0.3) / (distance / 2));
  const double pi = std::acos(-1.0);
  CHECK(kinematic_wavelength(wheelset, track, 0.002) ==
        Approx(2 * pi * std::sqrt(0.43 * distance / (2 * conicity))).epsilon(2.5e-3));
  const Wheelset real(s1002<double>(), 0.43, 1.5);
  CHECK(kinematic_wavelength(real, track, 0.002) == Approx(35.936).epsilon(0.01));
}

TEST_CASE("vehicle case: 41 s through the curve show what the paper says", "[.][slow]") {
  const RealWheel real = s1002<double>();
  const ConvexWheel convex(real);
  const auto on_real = in_the_curve(real, StripSearch<double>{});
  const auto on_convex = in_the_curve(convex, StripSearch<double>{});
  const auto by_distance =
      in_the_curve(convex, MinimumDistanceSearch<double>{convex_parts(convex), {}});
  for (const auto* history : {&on_real, &on_convex, &by_distance}) {
    REQUIRE(history->status == IntegrationStatus::finished);
    CHECK(history->failures == 0);
    CHECK(history->constraint_violation < 1e-7);
    CHECK(history->records.size() == 8201);
  }
  // The curve is laid out for 5.2 and about 37 s.
  const CurveContact flange = curve_contact(on_convex), fillet = curve_contact(on_real);
  CHECK(flange.begin == Approx(5.2).margin(0.1));
  CHECK(flange.end == Approx(37.1).margin(0.1));
  CHECK(fillet.begin == Approx(5.2).margin(0.1));
  CHECK(fillet.end == Approx(36.5).margin(0.1));
  // Convex: always one patch on the tread and one on the flange.
  CHECK(flange.share[2] == 1);
  for (const VehicleRecord& r : on_convex.records) {
    const WheelRecord& wheel = r.wheelsets[0].wheels[index_of(Side::right)];
    REQUIRE(wheel.patch_count <= 2);
    if (wheel.patch_count < 2) continue;
    REQUIRE(wheel.patches[0].wheel_lateral < -0.03);
    REQUIRE(wheel.patches[1].wheel_lateral > 0);
  }
  // S1002: one patch for most of the curve, more at its beginning and end only.
  CHECK(fillet.share[1] > 0.85);
  CHECK(fillet.share[2] > 0.02);
  CHECK(fillet.share[3] > 0.01);
  CHECK(fillet.share[4] == 0);
  for (const VehicleRecord& r : on_real.records) {
    if (r.time < 8 || 34 < r.time) continue;
    REQUIRE(r.wheelsets[0].wheels[index_of(Side::right)].patch_count == 1);
  }
  double apart = 0;
  for (std::size_t i = 0; i < on_convex.records.size(); ++i) {
    apart = std::max(apart, std::abs(on_convex.records[i].wheelsets[0].lateral_shift -
                                     by_distance.records[i].wheelsets[0].lateral_shift));
  }
  CHECK(apart < 10e-9);
}
