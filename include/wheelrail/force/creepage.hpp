#pragma once
/// @file
/// Creepages: the sliding and spinning of a wheel over a rail for each metre that it rolls,
/// (71)-(74). The contact frame is right-handed: x forward along the rail, y to the left in the
/// contact plane, z along the normal from the rail into the wheel. May include: core.

#include <wheelrail/core/require.hpp>
#include <wheelrail/core/scalar.hpp>

namespace wheelrail {

/// Of the wheel against the rail, in the contact frame.
template <Real T>
struct Creepage {
  T longitudinal = T(0);  ///< xi_x [-]
  T lateral = T(0);       ///< xi_y [-]
  T spin = T(0);          ///< phi [1/m]
};

/// How creepages stay finite at rest.
template <Real T>
struct CreepageOptions {
  /// Velocities are divided by sqrt(speed^2 + this^2) [m/s], > 0, so that standing still is no
  /// division by zero; 0.01 m/s changes creepages at 1 m/s by 5e-5 of them. A CHOICE.
  T minimum_speed = constant<T>(0.01L);
};

/// @throws std::invalid_argument unless the minimum speed is finite and > 0.
template <Real T>
void validate(const CreepageOptions<T>& options) {
  detail::require_positive("creepage: minimum speed", options.minimum_speed, "[m/s]");
}

/// (71)-(73), smooth through zero speed.
///
/// Spin creepage acts through the direction of rolling: turn the contact frame round, and it pushes
/// the wheel the other way. (73) is written for rolling along +x. Rolling backwards turns the sign
/// of `spin` here, so that a creep force law need not know of it.
/// @param longitudinal_velocity, lateral_velocity of the wheel's material point minus that of the
///   rail's, (74), along x and y of the contact frame [m/s].
/// @param spin_velocity of the wheel against the rail about z of the contact frame [rad/s].
/// @param forward_speed of the wheelset along the rail, signed [m/s].
/// @param speed of the wheelset's centre, v of (71)-(73) [m/s]; its sign is not used.
/// @pre the options are valid. @note No allocation. Smooth in all arguments.
template <Real T>
[[nodiscard]] Creepage<T> creepage(const T& longitudinal_velocity, const T& lateral_velocity,
                                   const T& spin_velocity, const T& forward_speed, const T& speed,
                                   const CreepageOptions<T>& options = {}) {
  using std::sqrt;
  const T floor = detail::square(options.minimum_speed);
  const T inverse_speed = T(1) / sqrt(T(speed * speed + floor));
  const T direction = forward_speed / sqrt(T(forward_speed * forward_speed + floor));
  return {longitudinal_velocity * inverse_speed, lateral_velocity * inverse_speed,
          spin_velocity * inverse_speed * direction};
}

}  // namespace wheelrail
