#pragma once
// A bogie or a vehicle running on a track: the equations of motion, the run and what is recorded.

#include <array>
#include <chrono>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>
#include <wheelrail/dynamics/multibody_system.hpp>
#include <wheelrail/numerics/integrate.hpp>
#include <wheelrail/wheelrail.hpp>

#include "vehicle.hpp"

namespace examples {

// Room for 16 bodies, without heap.
using VehicleState = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 208, 1>;

struct VehicleCase {
  double speed = 18.3;            // [m/s]
  double duration = 10;           // [s]
  double lateral_shift = 0.002;   // of all bodies at the start, to the left [m]
  double start = 0;               // x of the vehicle's middle at the start, on a tangent [m]
  double starting_gap = 1e-6;     // between each wheel and its rail at the start [m]
  double report_interval = 1e-3;  // [s]
  wheelrail::DormandPrinceOptions<double> integrator{
      .relative_tolerance = 1e-5, .absolute_tolerance = 1e-5, .maximum_step = 1e-3};
};

// What is kept of one wheel at one instant.
struct WheelRecord {
  int patch_count = 0;
  struct PatchRecord {
    double wheel_lateral, rail_lateral, penetration, normal_force, semi_axis_a, semi_axis_b;
  };
  std::array<PatchRecord, 4> patches{};  // the first four, from the flange to the field side
  double force_y = 0, force_z = 0;       // on the wheel, in the rail track's plane [N]
  [[nodiscard]] double normal_force() const {
    double sum = 0;
    for (int k = 0; k < std::min(patch_count, 4); ++k) {
      sum += patches[static_cast<std::size_t>(k)].normal_force;
    }
    return sum;
  }
};

struct WheelsetTrace {
  double lateral_shift = 0;  // from the track's middle, to the left [m]
  double yaw = 0;            // against the track, to the left [rad]
  std::array<WheelRecord, 2> wheels;
};

struct VehicleRecord {
  double time = 0;
  double arc_length = 0;                    // of the leading wheelset [m]
  double carbody_lateral_acceleration = 0;  // of the last body, in its own axes [m/s2]
  std::array<WheelsetTrace, 4> wheelsets;
};

struct VehicleHistory {
  std::vector<VehicleRecord> records;
  wheelrail::IntegrationStatus status = wheelrail::IntegrationStatus::not_finite;
  double end_time = 0;
  int steps = 0, rejected_steps = 0;
  long searches = 0, evaluations = 0, failures = 0;
  double constraint_violation = 0;        // greatest |Phi| over the run [m, -]
  double constraint_violation_rate = 0;   // greatest |dPhi/dt| [m/s, 1/s]
  double seconds = 0;                     // of the integration
  std::optional<std::string> derailment;  // which wheel left its rail, when and where
};

// The bodies on a track; contact enters as external wrenches on the wheelsets. World and track frame
// are the same. The rails are looked for where they were found at the time before.
template <class Wheelset, class Track, class Search>
class VehicleOnTrack {
 public:
  using System = wheelrail::MultibodySystem<double>;

  VehicleOnTrack(const Vehicle& vehicle, const Wheelset& wheelset, const Track& track,
                 const wheelrail::ContactForceModel<double>& model, const Search& search)
      : vehicle_(vehicle),
        wheelset_(wheelset),
        track_(track),
        model_(model),
        search_(search),
        system_(vehicle.model),
        arc_lengths_(vehicle.wheelsets.size(), 0.0) {}

  [[nodiscard]] const System& system() const { return system_; }

  // The forces on wheelset i of the vehicle.
  [[nodiscard]] wheelrail::WheelsetForces<double> forces(const VehicleState& y, std::size_t i) {
    const auto state = wheelrail::unpack_rigid_body(y, vehicle_.wheelsets[i]);
    const wheelrail::Matrix3<double> axes = wheelrail::rotation_matrix(state.orientation);
    const wheelrail::Vector3<double> angular_velocity_world = axes * state.angular_velocity_body;
    const auto found =
        wheelset_forces(wheelset_, track_, {state.position_world, axes.col(1), arc_lengths_[i]},
                        {state.velocity_world, angular_velocity_world}, model_, search_);
    const double arc_length = found.wheels[0].arc_length;
    if (wheelrail::is_finite(arc_length)) arc_lengths_[i] = arc_length;
    return found;
  }

  [[nodiscard]] VehicleState operator()(double, const VehicleState& y) {
    std::array<wheelrail::Wrench<double>, 16> wrenches{};
    for (std::size_t i = 0; i < vehicle_.wheelsets.size(); ++i) {
      const auto contact = forces(y, i);
      searches_ += 2;
      for (const auto& wheel : contact.wheels) {
        evaluations_ += wheel.evaluations;
        if (wheel.status != wheelrail::SearchStatus::complete) ++failures_;
      }
      wrenches[static_cast<std::size_t>(vehicle_.wheelsets[i])] = {contact.force_track,
                                                                   contact.moment_track};
    }
    return system_.rate(
        y, std::span<const wheelrail::Wrench<double>>(wrenches.data(), system_.body_count()));
  }

  // All bodies moved sideways, rolling straight ahead; the wheels just above the rails.
  [[nodiscard]] VehicleState start(const VehicleCase& run) const {
    VehicleState y = VehicleState::Zero(system_.state_size());
    double lift = 0, roll = 0;
    for (std::size_t body = 0; body < vehicle_.positions.size(); ++body) {
      const auto& position = vehicle_.positions[body];
      const bool is_wheelset = std::find(vehicle_.wheelsets.begin(), vehicle_.wheelsets.end(),
                                         static_cast<int>(body)) != vehicle_.wheelsets.end();
      if (body == 0) {
        const auto down = touching_position(wheelset_, track_, run.lateral_shift, 0.0,
                                            {.gap = run.starting_gap}, position.x() + run.start);
        if (down.status != wheelrail::SolveStatus::converged) {
          throw std::invalid_argument("the wheelsets cannot be set down on the rails");
        }
        lift = down.height - position.z();
        roll = down.roll;
      }
      wheelrail::RigidBodyState<double> state;
      state.position_world = {position.x() + run.start, run.lateral_shift, position.z() + lift};
      if (is_wheelset) {
        state.orientation = wheelrail::euler_parameters_from_axis_angle<double>({1, 0, 0}, roll);
        state.angular_velocity_body = {0, run.speed / vehicle_.wheel_radius, 0};
      } else if (vehicle_.names[body].ends_with("axlebox")) {
        state.orientation = wheelrail::euler_parameters_from_axis_angle<double>({1, 0, 0}, roll);
      }
      state.velocity_world = {run.speed, 0, 0};
      y.segment<13>(wheelrail::RigidBodyLayout::offset(static_cast<Eigen::Index>(body))) =
          pack(state);
    }
    return y;
  }

  // What is recorded, and whether a wheel has left its rail.
  [[nodiscard]] VehicleRecord record(double time, const VehicleState& y,
                                     std::optional<std::string>& derailment) {
    VehicleRecord record;
    record.time = time;
    for (std::size_t i = 0; i < vehicle_.wheelsets.size(); ++i) {
      const auto state = wheelrail::unpack_rigid_body(y, vehicle_.wheelsets[i]);
      const auto contact = forces(y, i);
      WheelsetTrace& trace = record.wheelsets[i];
      const auto frame = track_.nearest_frame(Side::left, state.position_world, arc_lengths_[i]);
      const auto other = track_.nearest_frame(Side::right, state.position_world, arc_lengths_[i]);
      if (i == 0) record.arc_length = frame.arc_length;
      const wheelrail::Vector3<double> middle = (frame.origin_track + other.origin_track) / 2;
      const wheelrail::Vector3<double> left =
          (frame.origin_track - other.origin_track).normalized();
      const wheelrail::Vector3<double> forward = frame.axes_track.col(0);
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
        kept.force_y = left.dot(wheel.force_track);
        kept.force_z = wheel.force_track.dot(wheelrail::cross(forward, left));
        if (std::abs(trace.lateral_shift) > 0.03 || !wheelrail::is_finite(trace.lateral_shift)) {
          derailment = "the " + vehicle_.names[static_cast<std::size_t>(vehicle_.wheelsets[i])] +
                       " left the rails at " + std::to_string(time) + " s, " +
                       std::to_string(arc_lengths_[i]) + " m along the track";
        }
      }
    }
    return record;
  }

  [[nodiscard]] long searches() const { return searches_; }
  [[nodiscard]] long evaluations() const { return evaluations_; }
  [[nodiscard]] long failures() const { return failures_; }

 private:
  using Side = wheelrail::Side;
  const Vehicle& vehicle_;
  const Wheelset& wheelset_;
  const Track& track_;
  const wheelrail::ContactForceModel<double>& model_;
  const Search& search_;
  System system_;
  std::vector<double> arc_lengths_;  // where each wheelset's rails were found last [m]
  long searches_ = 0;
  long evaluations_ = 0;
  long failures_ = 0;
};

// Runs one case; progress(t) is called at every report. Stops at a derailment and keeps what was
// computed.
template <class Wheelset, class Track, class Search>
[[nodiscard]] VehicleHistory run_vehicle(
    const Vehicle& vehicle, const Wheelset& wheelset, const Track& track,
    const wheelrail::ContactForceModel<double>& model, const Search& search, const VehicleCase& run,
    const std::function<void(double)>& progress = [](double) {}) {
  VehicleOnTrack motion(vehicle, wheelset, track, model, search);
  const VehicleState start = motion.start(run);
  VehicleHistory history;
  history.records.reserve(static_cast<std::size_t>(run.duration / run.report_interval) + 2);
  const auto begin = std::chrono::steady_clock::now();
  const auto result = wheelrail::integrate<VehicleState>(
      motion, 0.0, start, run.duration, run.report_interval, run.integrator,
      [&](double t, const VehicleState& y) {
        history.records.push_back(motion.record(t, y, history.derailment));
        const auto violation = motion.system().constraint_violation(y);
        history.constraint_violation = std::max(history.constraint_violation, violation.residual);
        history.constraint_violation_rate =
            std::max(history.constraint_violation_rate, violation.residual_rate);
        progress(t);
        return !history.derailment;
      });
  history.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
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
