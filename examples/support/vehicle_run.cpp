#include "vehicle_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <wheelrail/dynamics/balance_preloads.hpp>

#include "output.hpp"
#include "parallel.hpp"
#include "wheelset_run.hpp"  // greatest_flange_contact

namespace examples {

std::vector<int> wheelset_of_bodies(const Vehicle& vehicle) {
  std::vector<int> carrier(vehicle.model.bodies.size(), wheelrail::ground_body);
  const auto at = [&](int body) -> int& { return carrier[static_cast<std::size_t>(body)]; };
  for (const int wheelset : vehicle.wheelsets) at(wheelset) = wheelset;
  for (const auto& joint : vehicle.model.joints) {
    const auto [a, b] = joint.bodies();
    for (const int wheelset : vehicle.wheelsets) {
      if (a == wheelset || b == wheelset) at(a == wheelset ? b : a) = wheelset;
    }
  }
  return carrier;
}

std::vector<wheelrail::BodyDisplacement> sprung_displacements(const Vehicle& vehicle) {
  using enum wheelrail::Displacement;
  std::vector<wheelrail::BodyDisplacement> all;
  const std::vector<int> carrier = wheelset_of_bodies(vehicle);
  for (std::size_t body = 0; body < carrier.size(); ++body) {
    if (carrier[body] != wheelrail::ground_body) continue;
    for (const auto direction : {x, y, z, roll, pitch, yaw}) {
      all.push_back({static_cast<int>(body), direction});
    }
  }
  return all;
}

wheelrail::MultibodyModel<double> balanced_model(const Vehicle& vehicle) {
  const wheelrail::MultibodySystem<double> system(vehicle.model);
  VehicleState y = VehicleState::Zero(system.state_size());
  for (std::size_t body = 0; body < vehicle.positions.size(); ++body) {
    wheelrail::RigidBodyState<double> state;
    state.position_world = vehicle.positions[body];
    y.segment<13>(wheelrail::RigidBodyLayout::offset(static_cast<Eigen::Index>(body))) =
        pack(state);
  }
  std::vector<wheelrail::PreloadComponent> preloads;
  for (std::size_t i = 0; i < vehicle.model.spring_dampers.size(); ++i) {
    if (vehicle.model.spring_dampers[i].spring[2].slope(0) > 0) preloads.push_back({i});
  }
  const std::vector<wheelrail::Wrench<double>> none(system.body_count());
  auto balance =
      wheelrail::balance_preloads<double>(system, y, preloads, sprung_displacements(vehicle), none);
  if (balance.status != wheelrail::SolveStatus::converged) {
    throw std::invalid_argument(
        format("the vehicle's springs cannot hold its bodies in balance: with the best preloads an "
               "acceleration of %.3g m/s2 or rad/s2 is left",
               balance.residual));
  }
  return std::move(balance.model);
}

VehicleOnTrack::VehicleOnTrack(const Vehicle& vehicle, VehicleContact contact)
    : vehicle_(vehicle),
      contact_(std::move(contact)),
      system_(balanced_model(vehicle)),
      arc_lengths_(vehicle.wheelsets.size(), 0.0) {}

wheelrail::WheelsetForces<double> VehicleOnTrack::forces(const VehicleState& y, std::size_t i) {
  const auto state = wheelrail::unpack_rigid_body(y, vehicle_.wheelsets[i]);
  const wheelrail::Matrix3<double> axes = wheelrail::rotation_matrix(state.orientation);
  const wheelrail::Vector3<double> angular_velocity_world = axes * state.angular_velocity_body;
  const auto found = contact_.forces(i, {state.position_world, axes.col(1), arc_lengths_[i]},
                                     {state.velocity_world, angular_velocity_world});
  const double arc_length = found.wheels[0].arc_length;
  if (wheelrail::is_finite(arc_length)) arc_lengths_[i] = arc_length;
  return found;
}

VehicleState VehicleOnTrack::operator()(double time, const VehicleState& y) {
  std::array<wheelrail::Wrench<double>, 16> wrenches{};
  bool has_failed = false;
  for (std::size_t i = 0; i < vehicle_.wheelsets.size(); ++i) {
    const auto contact = forces(y, i);
    searches_ += 2;
    for (const Side side : wheelrail::sides) {
      const auto& wheel = contact.wheel(side);
      evaluations_ += wheel.evaluations;
      if (wheel.status == wheelrail::SearchStatus::complete) continue;
      ++failures_;
      if (!has_failed) {
        failed_search_ = "the contact search of " + wheel_name(i, side) + " failed (" +
                         name_of(wheel.status) + ") " + place(time, i);
      }
      has_failed = true;
    }
    wrenches[static_cast<std::size_t>(vehicle_.wheelsets[i])] = {contact.force_track,
                                                                 contact.moment_track};
  }
  if (has_failed) {
    return VehicleState::Constant(y.size(), std::numeric_limits<double>::quiet_NaN());
  }
  return system_.rate(y, wrench_span(wrenches));
}

VehicleState VehicleOnTrack::start(const VehicleCase& run) {
  const std::vector<int> carrier = wheelset_of_bodies(vehicle_);
  std::vector<wheelrail::RigidBodyState<double>> states(carrier.size());
  double lift = 0;
  for (std::size_t i = 0; i < vehicle_.wheelsets.size(); ++i) {
    const auto wheelset = static_cast<std::size_t>(vehicle_.wheelsets[i]);
    const auto& nominal = vehicle_.positions[wheelset];
    const auto down = set_down(run, nominal.x() + run.start);
    arc_lengths_[i] = nominal.x() + run.start;
    lift += (down.height - nominal.z()) / static_cast<double>(vehicle_.wheelsets.size());
    const auto orientation =
        wheelrail::euler_parameters_from_axis_angle<double>({1, 0, 0}, down.roll);
    const auto axes = wheelrail::rotation_matrix(orientation);
    for (std::size_t body = 0; body < carrier.size(); ++body) {
      if (carrier[body] != vehicle_.wheelsets[i]) continue;
      states[body].orientation = orientation;
      states[body].position_world =
          down.position.position_track + axes * (vehicle_.positions[body] - nominal);
    }
    states[wheelset].angular_velocity_body = {0, run.speed / vehicle_.wheel_radius, 0};
  }
  VehicleState y = VehicleState::Zero(system_.state_size());
  for (std::size_t body = 0; body < carrier.size(); ++body) {
    auto& state = states[body];
    if (carrier[body] == wheelrail::ground_body) {
      state.position_world =
          vehicle_.positions[body] + wheelrail::Vector3<double>(run.start, run.lateral_shift, lift);
    }
    state.velocity_world = {run.speed, 0, 0};
    y.segment<13>(wheelrail::RigidBodyLayout::offset(static_cast<Eigen::Index>(body))) =
        pack(state);
  }
  const std::array<wheelrail::Wrench<double>, 16> none{};
  const auto balance =
      wheelrail::static_equilibrium(system_, y, sprung_displacements(vehicle_),
                                    [&](const VehicleState&) { return wrench_span(none); });
  if (balance.status != wheelrail::SolveStatus::converged) {
    throw std::invalid_argument(
        format("the bodies on springs find no balance over the wheelsets at the start: an "
               "acceleration of %.3g m/s2 or rad/s2 is left",
               balance.residual));
  }
  return balance.state;
}

StandingVehicle VehicleOnTrack::standing(VehicleCase run) {
  run.speed = 0;
  const VehicleState above = start(run);
  std::vector<wheelrail::BodyDisplacement> coordinates = sprung_displacements(vehicle_);
  const std::vector<int> carrier = wheelset_of_bodies(vehicle_);
  for (std::size_t body = 0; body < carrier.size(); ++body) {
    using enum wheelrail::Displacement;
    if (carrier[body] == wheelrail::ground_body) continue;
    const int index = static_cast<int>(body);
    for (const auto direction : {z, roll}) coordinates.push_back({index, direction});
    if (carrier[body] != index) coordinates.push_back({index, pitch});
  }
  std::array<wheelrail::Wrench<double>, 16> wrenches{};
  StandingVehicle result;
  const auto hold = [&](const VehicleState& y) {
    for (std::size_t i = 0; i < vehicle_.wheelsets.size(); ++i) {
      const auto body = static_cast<std::size_t>(vehicle_.wheelsets[i]);
      const wheelrail::Vector3<double> centre =
          wheelrail::unpack_rigid_body(y, vehicle_.wheelsets[i]).position_world;
      const auto contact = forces(y, i);
      wrenches[body] = {};
      for (const Side side : wheelrail::sides) {
        double& load = result.wheel_loads[i][index_of(side)];
        load = 0;
        for (const auto& patch : contact.wheel(side).patches) {
          const wheelrail::Vector3<double> force(0, 0,
                                                 patch.contact.normal / patch.normal_track.z());
          const wheelrail::Vector3<double> arm = patch.position_track - centre;
          wrenches[body] += {force, wheelrail::cross(arm, force)};
          load += force.z();
        }
      }
    }
    return wrench_span(wrenches);
  };
  const auto rest = wheelrail::static_equilibrium(system_, above, coordinates, hold);
  static_cast<void>(hold(rest.state));  // its loads
  result.state = rest.state;
  result.status = rest.status;
  result.residual = rest.residual;
  return result;
}

VehicleOnTrack::Observation VehicleOnTrack::observe(double time, const VehicleState& y) {
  Observation seen;
  VehicleRecord& record = seen.record;
  record.time = time;
  for (std::size_t i = 0; i < vehicle_.wheelsets.size(); ++i) {
    const auto state = wheelrail::unpack_rigid_body(y, vehicle_.wheelsets[i]);
    const auto contact = forces(y, i);
    WheelsetTrace& trace = record.wheelsets[i];
    const auto frame = contact_.nearest_frame(Side::left, state.position_world, arc_lengths_[i]);
    const auto other = contact_.nearest_frame(Side::right, state.position_world, arc_lengths_[i]);
    if (i == 0) record.arc_length = frame.arc_length;
    const wheelrail::Vector3<double> middle = (frame.origin_track + other.origin_track) / 2;
    const wheelrail::Vector3<double> left = (frame.origin_track - other.origin_track).normalized();
    const wheelrail::Vector3<double> forward = frame.axes_track.col(0);
    const wheelrail::Vector3<double> up = wheelrail::cross(forward, left);
    trace.lateral_shift = left.dot(state.position_world - middle);
    const wheelrail::Vector3<double> axle = wheelrail::rotation_matrix(state.orientation).col(1);
    trace.yaw = std::atan2(-axle.dot(forward), axle.dot(left));
    for (const Side side : wheelrail::sides) {
      const auto& wheel = contact.wheel(side);
      WheelRecord& kept = trace.wheels[index_of(side)];
      kept.patch_count = static_cast<int>(wheel.patches.size());
      for (std::size_t k = 0; k < std::min<std::size_t>(wheel.patches.size(), 4); ++k) {
        const auto& p = wheel.patches[k];
        kept.patches[k] = {p.patch.wheel_lateral, p.patch.rail_lateral, p.patch.penetration,
                           p.contact.normal,      p.contact.ellipse.a,  p.contact.ellipse.b};
      }
      for (const auto& patch : wheel.patches) kept.normal_force += patch.contact.normal;
      kept.force_y = left.dot(wheel.force_track);
      kept.force_z = wheel.force_track.dot(up);
      const wheelrail::Vector3<double> from_rail =
          contact_.wheel_track(side, {state.position_world, axle, arc_lengths_[i]}) -
          (side == Side::left ? frame : other).origin_track;
      const double outwards = wheelrail::outboard_sign<double>(side) * from_rail.dot(left);
      const char* how = way_off(side, wheel.patches, outwards, from_rail.dot(up));
      if (how != nullptr && !seen.derailment) {
        seen.derailment = wheel_name(i, side) + " left its rail " + place(time, i) + ": " + how;
      }
    }
  }
  return seen;
}

std::span<const wheelrail::Wrench<double>> VehicleOnTrack::wrench_span(
    const Wrenches& wrenches) const {
  return {wrenches.data(), system_.body_count()};
}

std::string VehicleOnTrack::wheel_name(std::size_t wheelset, Side side) const {
  return "the " + vehicle_.names[static_cast<std::size_t>(vehicle_.wheelsets[wheelset])] + "'s " +
         name_of(side) + " wheel";
}

std::string VehicleOnTrack::place(double time, std::size_t wheelset) const {
  return format("at %.3f s, %.1f m along the track", time, arc_lengths_[wheelset]);
}

wheelrail::TouchingPosition<double> VehicleOnTrack::set_down(const VehicleCase& run,
                                                             double x) const {
  const auto down = contact_.touching(run.lateral_shift, run.starting_gap, x);
  const auto fail = [&](const std::string& why) {
    throw std::invalid_argument(
        format("a wheelset cannot be set down on the rails at x = %g m, "
               "%g m from the middle (%s)",
               x, run.lateral_shift, why.c_str()));
  };
  if (down.status != wheelrail::SolveStatus::converged) fail(name_of(down.status));
  for (const Side side : wheelrail::sides) {
    if (stands_on_flange(side, down.patches[index_of(side)])) {
      fail(std::string("its ") + name_of(side) + " flange would stand on the rail head");
    }
  }
  return down;
}

bool VehicleOnTrack::stands_on_flange(Side side, const wheelrail::Patch<double>& patch) const {
  return patch.rolling_radius - contact_.nominal_radius[index_of(side)] > greatest_flange_contact;
}

const char* VehicleOnTrack::way_off(Side side, const Patches& patches, double outwards,
                                    double up) const {
  for (const auto& p : patches) {
    if (stands_on_flange(side, p.patch)) return "its flange stands on the rail head";
  }
  if (up - contact_.nominal_radius[index_of(side)] > contact_.flange_height[index_of(side)]) {
    return "it is lifted higher than its flange";
  }
  if (outwards + contact_.field_end[index_of(side)] < 0)
    return "its tread lies inside the rail head";
  return nullptr;
}

VehicleHistory run_vehicle(VehicleOnTrack& motion, const VehicleCase& run,
                           const std::function<void(double)>& progress) {
  const VehicleState start = motion.start(run);
  VehicleHistory history;
  history.records.reserve(static_cast<std::size_t>(run.duration / run.report_interval) + 2);
  const auto keep = [&](double t, const VehicleState& y) {
    auto seen = motion.observe(t, y);
    history.records.push_back(seen.record);
    history.derailment = std::move(seen.derailment);
    const auto violation = motion.system().constraint_violation(y);
    history.constraint_violation = std::max(history.constraint_violation, violation.residual);
    history.constraint_violation_rate =
        std::max(history.constraint_violation_rate, violation.residual_rate);
    progress(t);
    return !history.derailment;
  };
  const double begin = thread_seconds();
  const auto result = wheelrail::integrate<VehicleState>(motion, 0.0, start, run.duration,
                                                         run.report_interval, run.integrator, keep);
  const bool has_failed = result.status != wheelrail::IntegrationStatus::finished &&
                          result.status != wheelrail::IntegrationStatus::stopped_by_observer;
  if (has_failed) {
    if (history.records.empty() || history.records.back().time < result.time) {
      static_cast<void>(keep(result.time, result.state));  // the last instant that was reached
    }
    if (!history.derailment) history.failed_search = motion.failed_search();
  }
  history.seconds = thread_seconds() - begin;
  history.status = result.status;
  history.end_time = result.time;
  history.steps = result.steps;
  history.rejected_steps = result.rejected_steps;
  history.searches = motion.searches();
  history.evaluations = motion.evaluations();
  history.failures = motion.failures();
  return history;
}

}  // namespace examples
