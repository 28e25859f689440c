#pragma once
// A single wheelset running on a tangent track (§6.1 of the paper): the equations of motion, the
// run, and what is recorded of it.

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>
#include <wheelrail/dynamics/rigid_body_vector.hpp>
#include <wheelrail/numerics/integrate.hpp>
#include <wheelrail/wheelrail.hpp>

#include "output.hpp"
#include "parallel.hpp"

namespace examples {

using wheelrail::Side;
using State = wheelrail::Vector13<double>;

// Defaults: Tables 1 and 2 of the paper; mass and inertia of a light metro trailer's wheelset,
// assumed round numbers.
struct WheelsetCase {
  double speed = 10;              // [m/s]
  double duration = 10;           // [s]
  double lateral_shift = 0.002;   // at the start, to the left [m]
  double yaw = 0;                 // at the start, to the left [rad]
  double mass = 1000;             // [kg]
  double roll_inertia = 600;      // about x, and about z [kg m2]
  double spin_inertia = 80;       // about the axle [kg m2]
  double gravity = 9.81;          // [m/s2]
  double starting_gap = 1e-6;     // between each wheel and its rail at the start [m]
  double report_interval = 1e-3;  // [s]
  wheelrail::DormandPrinceOptions<double> integrator{
      .relative_tolerance = 1e-5, .absolute_tolerance = 1e-5, .maximum_step = 1e-3};
};

// How far outside the tread circle a wheel may touch its rail at the start [m]: there, 16 mm above
// the tread, the steepest part of the S1002's flange ends. Further out the wheel has climbed and
// its flange stands on the rail head.
constexpr double greatest_flange_contact = 0.016;

// What finds the patches that are recorded: the same, with their zones' ends. Its memory is its own
// and goes from report to report.
template <class Wheelset, class Search>
[[nodiscard]] Search recording_search(const Wheelset&, const Search& search) {
  return search;
}
template <class Wheelset>
[[nodiscard]] wheelrail::WarmStripSearch<double> recording_search(
    const Wheelset& wheelset, const wheelrail::WarmStripSearch<double>&) {
  return wheelrail::WarmStripSearch<double>(wheelset);
}

// The equations of motion of a wheelset on a track; world and track frame are the same.
template <class Wheelset, class Track, class Search>
class WheelsetOnTrack {
 public:
  WheelsetOnTrack(const Wheelset& wheelset, const Track& track,
                  const wheelrail::ContactForceModel<double>& model, const Search& search,
                  const WheelsetCase& run)
      : wheelset_(wheelset),
        track_(track),
        model_(model),
        search_(search),
        body_(run.mass, {run.roll_inertia, run.spin_inertia, run.roll_inertia}),
        gravity_(run.gravity) {}

  [[nodiscard]] const wheelrail::RigidBody<double>& body() const { return body_; }

  [[nodiscard]] static wheelrail::WheelsetPosition<double> position(
      const wheelrail::RigidBodyState<double>& state) {
    return {state.position_world, wheelrail::rotation_matrix(state.orientation).col(1)};
  }

  [[nodiscard]] wheelrail::WheelsetForces<double> forces(
      const wheelrail::RigidBodyState<double>& state) {
    return forces_by(search_, state);
  }
  template <class Finder>
  [[nodiscard]] wheelrail::WheelsetForces<double> forces_by(
      Finder& find, const wheelrail::RigidBodyState<double>& state) const {
    const wheelrail::Vector3<double> angular_velocity_world =
        wheelrail::rotation_matrix(state.orientation) * state.angular_velocity_body;
    return wheelset_forces(wheelset_, track_, position(state),
                           {state.velocity_world, angular_velocity_world}, model_, find);
  }

  [[nodiscard]] State operator()(double, const State& y) {
    const auto state = wheelrail::unpack_rigid_body(y);
    const auto contact = forces(state);
    searches_ += 2;
    for (const auto& wheel : contact.wheels) {
      evaluations_ += wheel.evaluations;
      if (wheel.status != wheelrail::SearchStatus::complete) ++failures_;
    }
    wheelrail::Wrench<double> wrench{contact.force_track, contact.moment_track};
    wrench.force_world.z() -= body_.mass() * gravity_;
    return pack(derivative(body_, state, wrench));
  }

  // Kinetic energy and that of the weight [J].
  [[nodiscard]] double energy(const wheelrail::RigidBodyState<double>& state) const {
    return kinetic_energy(body_, state) + body_.mass() * gravity_ * state.position_world.z();
  }

  // At rest relative to its rolling: the wheels just above the rails. Throws std::invalid_argument,
  // naming the option of wheelset_on_tangent_track, where they cannot stand on them.
  [[nodiscard]] wheelrail::RigidBodyState<double> start(const WheelsetCase& run) const {
    const auto set_down =
        touching_position(wheelset_, track_, run.lateral_shift, run.yaw, {.gap = run.starting_gap});
    const std::string at = format("--lateral-shift is %g m, but ", run.lateral_shift);
    if (set_down.status == wheelrail::SolveStatus::not_finite) {
      throw std::invalid_argument(at + "must leave each wheel over its rail");
    }
    if (set_down.status != wheelrail::SolveStatus::converged) {
      throw std::invalid_argument(
          at + format("with --yaw %g the wheelset cannot be set down on the rails there (%s)",
                      run.yaw, name_of(set_down.status)));
    }
    for (const Side side : wheelrail::sides) {
      const auto& contact = set_down.patches[wheelrail::index_of(side)];
      const double outside = contact.rolling_radius - wheelset_.wheel(side).nominal_radius();
      if (outside > greatest_flange_contact) {
        throw std::invalid_argument(
            at + format("must keep the flanges beside the rail heads: the %s one would stand on "
                        "its rail, touching %.1f mm outside the tread circle (at most %g mm)",
                        name_of(side), 1e3 * outside, 1e3 * greatest_flange_contact));
      }
    }
    wheelrail::RigidBodyState<double> state;
    state.position_world = set_down.position.position_track;
    state.orientation = wheelrail::euler_product(
        wheelrail::euler_parameters_from_axis_angle<double>({0, 0, 1}, run.yaw),
        wheelrail::euler_parameters_from_axis_angle<double>({1, 0, 0}, set_down.roll));
    state.velocity_world = {run.speed * std::cos(run.yaw), run.speed * std::sin(run.yaw), 0};
    const double radius = wheelset_.wheel(Side::left).nominal_radius();
    state.angular_velocity_body = {0, run.speed / radius, 0};
    return state;
  }

  [[nodiscard]] long searches() const { return searches_; }
  [[nodiscard]] long evaluations() const { return evaluations_; }
  [[nodiscard]] long failures() const { return failures_; }

 private:
  const Wheelset& wheelset_;
  const Track& track_;
  const wheelrail::ContactForceModel<double>& model_;
  Search search_;
  wheelrail::RigidBody<double> body_;
  double gravity_;
  long searches_ = 0;
  long evaluations_ = 0;
  long failures_ = 0;
};

// One reported instant. Lists of the length that they need: new pages of memory for the longest
// took longer than an evaluation.
struct WheelsetRecord {
  struct Wheel {
    std::vector<wheelrail::PatchForce<double>> patches;
    wheelrail::Vector3<double> force_track;  // the sum over the patches [N]
  };
  struct Forces {
    std::array<Wheel, 2> wheels;  // ordered as `sides`

    [[nodiscard]] const Wheel& wheel(Side side) const { return wheels[index_of(side)]; }
  };
  [[nodiscard]] static Wheel kept(const wheelrail::WheelForces<double>& wheel) {
    return {{wheel.patches.begin(), wheel.patches.end()}, wheel.force_track};
  }

  double time;  // [s]
  wheelrail::RigidBodyState<double> state;
  wheelrail::Vector3<double> axle_track;
  Forces forces;

  [[nodiscard]] double lateral_shift() const { return state.position_world.y(); }
  [[nodiscard]] double yaw() const { return std::atan2(-axle_track.x(), axle_track.y()); }
  [[nodiscard]] double roll() const { return std::asin(axle_track.z()); }
};

struct WheelsetHistory {
  std::vector<WheelsetRecord> records;
  wheelrail::IntegrationStatus status = wheelrail::IntegrationStatus::not_finite;
  double end_time = 0;  // [s]
  int steps = 0;
  int rejected_steps = 0;
  long searches = 0;     // one wheel on its rail, in the integration only
  long evaluations = 0;  // strips and Newton systems in these searches
  long failures = 0;     // searches that were not complete
  double seconds = 0;    // processor time of the integration, records included
};

// Runs one case; progress(t) is called at every report.
template <class Wheelset, class Track, class Search>
[[nodiscard]] WheelsetHistory run_wheelset(
    const Wheelset& wheelset, const Track& track, const wheelrail::ContactForceModel<double>& model,
    const Search& search, const WheelsetCase& run,
    const std::function<void(double)>& progress = [](double) {}) {
  WheelsetOnTrack system(wheelset, track, model, search, run);
  auto recorder = recording_search(wheelset, search);
  const State start = pack(system.start(run));
  WheelsetHistory history;
  history.records.reserve(static_cast<std::size_t>(run.duration / run.report_interval) + 2);
  const double begin = thread_seconds();
  const auto result = wheelrail::integrate<State>(
      system, 0.0, start, run.duration, run.report_interval, run.integrator,
      [&](double t, const State& y) {
        const auto state = wheelrail::unpack_rigid_body(y);
        const auto forces = system.forces_by(recorder, state);
        history.records.push_back(
            {t,
             state,
             system.position(state).axle_track,
             {WheelsetRecord::kept(forces.wheels[0]), WheelsetRecord::kept(forces.wheels[1])}});
        progress(t);
        return true;
      });
  history.seconds = thread_seconds() - begin;
  history.status = result.status;
  history.end_time = result.time;
  history.steps = result.steps;
  history.rejected_steps = result.rejected_steps;
  history.searches = system.searches();
  history.evaluations = system.evaluations();
  history.failures = system.failures();
  return history;
}

// The mean wavelength of the lateral motion [m], from all its passages through the track's middle;
// NaN with fewer than two of them.
[[nodiscard]] inline double hunting_wavelength(const WheelsetHistory& history) {
  double first = 0, last = 0;
  int passages = 0;
  for (std::size_t i = 1; i < history.records.size(); ++i) {
    const auto& before = history.records[i - 1];
    const auto& after = history.records[i];
    if ((before.lateral_shift() < 0) == (after.lateral_shift() < 0)) continue;
    const double share = before.lateral_shift() / (before.lateral_shift() - after.lateral_shift());
    const double x0 = before.state.position_world.x();
    last = x0 + share * (after.state.position_world.x() - x0);
    if (passages++ == 0) first = last;
  }
  return passages < 2 ? std::nan("") : 2 * (last - first) / (passages - 1);
}

}  // namespace examples
