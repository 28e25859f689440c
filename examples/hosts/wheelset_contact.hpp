#pragma once
// The forces of the track on a wheelset, compiled once and behind a header without templates: what
// a simulator includes that is not built as C++20, or that shall not compile the contact search in
// each of its files. C++17.

#include <Eigen/Core>
#include <memory>

namespace examples {

// What contact depends on, in the track frame: x forward, y left, z up, its origin between the
// rails and level with the highest points of their heads. It stands still: velocities are those
// over ground, not those in a frame that moves along. How far the wheelset has turned about its
// axle is no part of it.
struct WheelsetState {
  Eigen::Vector3d centre_track;            // the axle's middle [m]
  Eigen::Vector3d axle_track;              // unit vector along the axle, to the left
  Eigen::Vector3d velocity_track;          // of the axle's middle [m/s]
  Eigen::Vector3d angular_velocity_track;  // spin and all; rolling forwards is +y [rad/s]
};

// Of the rails on the wheelset. The weight is no part of it.
struct ContactWrench {
  Eigen::Vector3d force_track;   // [N]
  Eigen::Vector3d moment_track;  // about the axle's middle [N m]
};

// One wheelset on its track, that of the paper's first case: S1002 on UIC50. Copies share the
// profiles, which nobody changes, and have a search memory each: what was found last makes the next
// search faster and changes no bit of its result. A search writes to its memory, so that one copy
// is for one thread at a time.
class WheelsetContact {
 public:
  WheelsetContact();
  ~WheelsetContact();
  WheelsetContact(const WheelsetContact& other);
  WheelsetContact(WheelsetContact&& other) noexcept;
  WheelsetContact& operator=(const WheelsetContact& other);
  WheelsetContact& operator=(WheelsetContact&& other) noexcept;

  // Throws std::runtime_error where a search was not complete: far off the track, or NaN.
  [[nodiscard]] ContactWrench wrench(const WheelsetState& state);

 private:
  struct Parts;
  struct Memory;
  std::shared_ptr<const Parts> parts_;
  std::unique_ptr<Memory> memory_;
};

}  // namespace examples
