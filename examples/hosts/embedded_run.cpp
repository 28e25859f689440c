#include "embedded_run.hpp"

#include <stdexcept>

#include "../support/wheelset_run.hpp"

namespace examples {

namespace {

// Calls body(system, run) with the case of examples/wheelset_on_tangent_track.
template <class Body>
auto with_case(Body&& body) {
  const WheelsetCase run;
  const wheelrail::Wheelset wheelset(wheelrail::s1002<double>(), 0.43, 1.5);
  const wheelrail::TangentTrack track(wheelrail::uic50<double>());
  const wheelrail::ContactForceModel<double> model;
  const wheelrail::WarmStripSearch<double> search(wheelset, {.zone_ends = false});
  return body(WheelsetOnTrack(wheelset, track, model, search, run), run);
}

}  // namespace

WheelsetBody wheelset_at_start() {
  return with_case([](const auto& system, const WheelsetCase& run) {
    const auto start = system.start(run);
    const Eigen::Matrix3d axes_track = wheelrail::rotation_matrix(start.orientation);
    return WheelsetBody{.mass = run.mass,
                        .inertia = {run.roll_inertia, run.spin_inertia, run.roll_inertia},
                        .gravity = run.gravity,
                        .centre_track = start.position_world,
                        .axes_track = axes_track,
                        .velocity_track = start.velocity_world,
                        .angular_velocity_track = axes_track * start.angular_velocity_body};
  });
}

std::vector<double> embedded_lateral_shifts(double interval, int count, double tolerance) {
  return with_case([&](auto system, const WheelsetCase& run) {
    auto options = run.integrator;
    options.relative_tolerance = options.absolute_tolerance = tolerance;
    std::vector<double> shifts;
    const auto result = wheelrail::integrate<State>(
        system, 0.0, pack(system.start(run)), interval * count, interval, options,
        [&](double, const State& y) {
          shifts.push_back(wheelrail::unpack_rigid_body(y).position_world.y());
          return true;
        });
    if (result.status != wheelrail::IntegrationStatus::finished || system.failures() > 0) {
      throw std::runtime_error(
          format("the embedded run stopped at %.6g s: %s, %ld contact searches failed", result.time,
                 name_of(result.status), system.failures()));
    }
    return shifts;
  });
}

}  // namespace examples
