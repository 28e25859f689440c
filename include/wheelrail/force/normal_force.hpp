#pragma once
/// @file
/// The normal contact force of a penetration: Hertz's elastic force with the hysteresis damping of
/// (63) and (64). May include: core.

#include <wheelrail/core/require.hpp>
#include <wheelrail/core/scalar.hpp>

namespace wheelrail {

/// The damping of (63): a ratio of forces [-] and a velocity [m/s], as in Table 1 of the paper.
template <Real T>
struct NormalForceOptions {
  /// c_e [-], in [0, 1]: the force of a contact that opens faster than velocity_tolerance over that
  /// of one that closes. It is a ratio of forces and so of energies: a hard impact rebounds with
  /// sqrt(c_e) of its velocity. With 1 the velocity has no effect.
  T restitution_force_ratio = constant<T>(0.75L);
  /// v0 [m/s] > 0: between -v0 and v0 the force changes smoothly over.
  T velocity_tolerance = constant<T>(0.1L);
};

/// @throws std::invalid_argument unless 0 <= c_e <= 1 and v0 is finite and > 0.
template <Real T>
void validate(const NormalForceOptions<T>& options) {
  detail::require(
      !(options.restitution_force_ratio < T(0)) && options.restitution_force_ratio <= T(1),
      "normal force: restitution force ratio", options.restitution_force_ratio, "in [0, 1] [-]");
  detail::require_positive("normal force: velocity tolerance", options.velocity_tolerance, "[m/s]");
}

/// (63) with the exponent 3/2 and (64).
/// @param stiffness K of (67) [N/m^1.5], >= 0: hertz_stiffness.
/// @param penetration [m]; positive in contact.
/// @param penetration_velocity its rate [m/s]; positive while the contact is pressed together. The
///   paper's (65) as printed has the other sign.
/// @return the force on either body along its inward normal [N], >= 0; 0 unless penetration > 0.
///   Once continuously differentiable in both. NaN in gives NaN.
/// @pre the options are valid. @note No allocation.
template <Real T>
[[nodiscard]] T normal_force(const T& stiffness, const T& penetration,
                             const T& penetration_velocity,
                             const NormalForceOptions<T>& options = {}) {
  using std::sqrt;
  if (penetration <= T(0)) return T(0);
  const T ratio = options.restitution_force_ratio;
  // (64), held in [0, 1]: the cubic's slope is zero at both ends, so (63) is one expression.
  const T r = detail::clamp(
      T((penetration_velocity + options.velocity_tolerance) / (T(2) * options.velocity_tolerance)),
      T(0), T(1));
  const T damping = ratio + (T(1) - ratio) * r * r * (T(3) - T(2) * r);
  return stiffness * penetration * sqrt(penetration) * damping;
}

}  // namespace wheelrail
