#pragma once
// The carbody's modes on its suspension, with wheelsets and axleboxes held: from the library's
// equations of motion, and from small systems of equations made by hand, which share with them only
// how modes are told apart.

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <vector>
#include <wheelrail/dynamics/linearize.hpp>

#include "vehicle.hpp"

namespace examples {

enum class CarbodyMode { bounce, pitch, lower_sway, upper_sway, yaw, surge };

inline constexpr std::array<const char*, 6> carbody_mode_names{"bounce",     "pitch", "lower sway",
                                                               "upper sway", "yaw",   "surge"};

struct ModeValues {
  double undamped_frequency = 0;  // with all dampers taken out [Hz]
  double natural_frequency = 0;   // |eigenvalue| / (2 pi) with dampers; see DampedValues [Hz]
  double damping_ratio = 0;       // [-]; >= 1: overdamped
  double rotation_centre = 0;     // above the rail, of an undamped sway; 0 for other modes [m]
};

// In the order of CarbodyMode.
using CarbodyModes = std::array<ModeValues, 6>;

namespace detail {

// A motion in proportion to exp(eigenvalue t); one of each pair of conjugates.
struct Motion {
  std::complex<double> eigenvalue;
  Eigen::VectorXcd shape;
};

// |x* M y|^2 / ((x* M x) (y* M y)): the share of y's kinetic energy that is in the shape x, where
// x is one of a set of shapes that are orthogonal in M.
[[nodiscard]] double share_in(const Eigen::VectorXcd& x, const Eigen::VectorXcd& y,
                              const Eigen::VectorXd& masses);

// An oscillation's |eigenvalue| and -Re eigenvalue / |eigenvalue|. An overdamped mode has two real
// eigenvalues a and b: sqrt(a b) and -(a + b) / 2 / sqrt(a b), as of an oscillator; NaN where two are
// not left for it.
struct DampedValues {
  double frequency = std::nan("");      // [Hz]
  double damping_ratio = std::nan("");  // [-], >= 1 where nothing oscillates
};

// What becomes of undamped modes with dampers. First each oscillation goes to a mode, then two real
// motions to each mode that is left; pairs of mode and motion that share most come first. So a mode
// keeps its name where oscillations are fewer than modes, and no oscillation is without one.
[[nodiscard]] std::vector<DampedValues> follow(const std::vector<Eigen::VectorXcd>& modes,
                                               const std::vector<Motion>& motions,
                                               const Eigen::VectorXd& masses);

// For each CarbodyMode the undamped mode that it is, by shares of kinetic energy: bounce is where the
// carbody's z has its greatest share, and so on; the sways are where its y and roll have. The lower
// one turns about an axis below the centre of mass, the upper one above.
// @param masses of the coordinates, which begin with the carbody's x, y, z, roll, pitch, yaw.
[[nodiscard]] std::array<std::size_t, 6> identify(const std::vector<Eigen::VectorXcd>& modes,
                                                  const Eigen::VectorXd& masses);

// Throws std::runtime_error where an undamped mode does not oscillate: no spring, or one weaker than
// the weight that leans on it. Rounding makes 1e-8 of the highest frequency of nothing at all.
void require_oscillations(const std::vector<wheelrail::Eigenmode<double>>& modes,
                          const Eigen::VectorXd& masses,
                          const std::vector<std::string>& coordinates);

}  // namespace detail

// From the equations of motion, linearised where the vehicle stands on a straight track.
// Throws std::runtime_error where it does not rest there, springs do not hold it, or modes cannot be
// told apart.
[[nodiscard]] CarbodyModes carbody_modes(const Vehicle& vehicle);

struct ModesByHand {
  CarbodyModes with_frames;  // the frames move on the primary suspension
  CarbodyModes rigid;        // the frames are held: one mass; y and roll, x and pitch of it
};

// From the data alone, for the three planes in which a vehicle with two mirror planes moves. Its two
// frames do the same, or the opposite; series springs are left out. Weights act as they do in
// SpringDamper: a preload N turns with the element's a, the frame, and acts where b's end is. Its
// potential is, in second order, N times
// roll_a (y_b - z_b roll_b - y_a) + z_a roll_a^2 / 2 + z_b roll_b^2 / 2
// with the heights z_a and z_b of its point over the centres of mass of a and b; in the vertical
// plane the same of pitch and x, where a point moves by + z pitch.
[[nodiscard]] ModesByHand modes_by_hand(const VehicleData& data);

}  // namespace examples
