#pragma once
// A bogie or a vehicle running on a track: the equations of motion, the run and what is recorded.

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>
#include <wheelrail/dynamics/multibody_system.hpp>
#include <wheelrail/dynamics/static_equilibrium.hpp>
#include <wheelrail/numerics/integrate.hpp>
#include <wheelrail/wheelrail.hpp>

#include "vehicle.hpp"
#include "vehicle_contact.hpp"

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
  double normal_force = 0;               // the sum over all patches [N]
  double force_y = 0, force_z = 0;       // on the wheel, in the rail track's plane [N]
};

struct WheelsetTrace {
  double lateral_shift = 0;  // from the track's middle, to the left [m]
  double yaw = 0;            // against the track, to the left [rad]
  std::array<WheelRecord, 2> wheels;
};

struct VehicleRecord {
  double time = 0;
  double arc_length = 0;  // of the leading wheelset [m]
  std::array<WheelsetTrace, 4> wheelsets;
};

struct VehicleHistory {
  std::vector<VehicleRecord> records;  // up to the end, however the run ended
  wheelrail::IntegrationStatus status = wheelrail::IntegrationStatus::not_finite;
  double end_time = 0;
  int steps = 0, rejected_steps = 0;
  long searches = 0, evaluations = 0, failures = 0;
  double constraint_violation = 0;           // greatest |Phi| over the run [m, -]
  double constraint_violation_rate = 0;      // greatest |dPhi/dt| [m/s, 1/s]
  double seconds = 0;                        // processor time of the integration, records included
  std::optional<std::string> derailment;     // which wheel left its rail, when, where and how
  std::optional<std::string> failed_search;  // the last one of a run that failed without derailing
};

// A vehicle that stands on its rails.
struct StandingVehicle {
  VehicleState state;
  wheelrail::SolveStatus status = wheelrail::SolveStatus::not_finite;
  double residual = 0;                                    // greatest |acceleration| [m/s2, rad/s2]
  std::array<std::array<double, 2>, 4> wheel_loads = {};  // of each wheelset, left and right [N]
};

// The wheelset that carries each body by a joint, or is it; ground_body for the sprung bodies.
[[nodiscard]] std::vector<int> wheelset_of_bodies(const Vehicle& vehicle);

// All six displacements of the bodies on springs.
[[nodiscard]] std::vector<wheelrail::BodyDisplacement> sprung_displacements(const Vehicle& vehicle);

// The vehicle's model with the vertical preloads that hold all bodies on springs where they stand on
// level track; of all such preloads those nearest to the given ones.
// Throws std::invalid_argument where no preloads do.
[[nodiscard]] wheelrail::MultibodyModel<double> balanced_model(const Vehicle& vehicle);

// The bodies on a track; contact enters as external wrenches on the wheelsets. World and track frame
// are the same. The rails are looked for where they were found at the time before.
class VehicleOnTrack {
  using Side = wheelrail::Side;

 public:
  using System = wheelrail::MultibodySystem<double>;

  template <class Wheelset, class Track, class Search>
  VehicleOnTrack(const Vehicle& vehicle, const Wheelset& wheelset, const Track& track,
                 const wheelrail::ContactForceModel<double>& model, const Search& search)
      : VehicleOnTrack(vehicle,
                       contact_of(wheelset, track, model, search, vehicle.wheelsets.size())) {}
  VehicleOnTrack(const Vehicle& vehicle, VehicleContact contact);

  [[nodiscard]] const System& system() const { return system_; }

  // The forces on wheelset i of the vehicle.
  [[nodiscard]] wheelrail::WheelsetForces<double> forces(const VehicleState& y, std::size_t i);

  // NaN where a search fails: the integrator then tries a shorter step, and stops if that does not
  // help.
  [[nodiscard]] VehicleState operator()(double time, const VehicleState& y);

  // All bodies moved sideways, rolling straight ahead; the wheels just above the rails, the bodies on
  // springs in balance over them.
  // Throws std::invalid_argument where the wheelsets cannot be set down or nothing balances.
  [[nodiscard]] VehicleState start(const VehicleCase& run);

  // The vehicle at rest where run.start and run.lateral_shift put it. Friction keeps wheels from
  // sliding and rolling, so that the whole force of each contact is vertical, whatever its normal.
  // Throws as start does.
  [[nodiscard]] StandingVehicle standing(VehicleCase run);

  // What is recorded, and whether a wheel has left its rail.
  struct Observation {
    VehicleRecord record;
    std::optional<std::string> derailment;
  };

  [[nodiscard]] Observation observe(double time, const VehicleState& y);

  // A search of the last evaluation that had one fail, with time and place.
  [[nodiscard]] const std::optional<std::string>& failed_search() const { return failed_search_; }
  [[nodiscard]] long searches() const { return searches_; }
  [[nodiscard]] long evaluations() const { return evaluations_; }
  [[nodiscard]] long failures() const { return failures_; }

 private:
  using Wrenches = std::array<wheelrail::Wrench<double>, 16>;
  using Patches = decltype(wheelrail::WheelForces<double>::patches);

  [[nodiscard]] std::span<const wheelrail::Wrench<double>> wrench_span(
      const Wrenches& wrenches) const;

  [[nodiscard]] std::string wheel_name(std::size_t wheelset, Side side) const;

  [[nodiscard]] std::string place(double time, std::size_t wheelset) const;

  [[nodiscard]] wheelrail::TouchingPosition<double> set_down(const VehicleCase& run,
                                                             double x) const;

  [[nodiscard]] bool stands_on_flange(Side side, const wheelrail::Patch<double>& patch) const;

  // How a wheel is no longer guided by its rail; nullptr where it is.
  // outwards, up: of the wheel profile's origin from the rail profile's, in the track plane [m].
  [[nodiscard]] const char* way_off(Side side, const Patches& patches, double outwards,
                                    double up) const;

  const Vehicle& vehicle_;
  VehicleContact contact_;
  System system_;
  std::vector<double> arc_lengths_;  // where each wheelset's rails were found last [m]
  std::optional<std::string> failed_search_;
  long searches_ = 0;
  long evaluations_ = 0;
  long failures_ = 0;
};

// Runs one case; progress(t) is called at every report. Stops at a derailment, at the first report
// that sees it, and where searches fail whatever the step; keeps what was computed.
[[nodiscard]] VehicleHistory run_vehicle(VehicleOnTrack& motion, const VehicleCase& run,
                                         const std::function<void(double)>& progress);

template <class Wheelset, class Track, class Search>
[[nodiscard]] VehicleHistory run_vehicle(
    const Vehicle& vehicle, const Wheelset& wheelset, const Track& track,
    const wheelrail::ContactForceModel<double>& model, const Search& search, const VehicleCase& run,
    const std::function<void(double)>& progress = [](double) {}) {
  VehicleOnTrack motion(vehicle, wheelset, track, model, search);
  return run_vehicle(motion, run, progress);
}

}  // namespace examples
