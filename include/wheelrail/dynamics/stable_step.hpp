#pragma once
/// @file
/// The largest stable step of an explicit integration of a system of bodies, from its eigenvalues.
/// May include: core, numerics, dynamics, Eigen, std.

#include <algorithm>
#include <wheelrail/dynamics/linearize.hpp>
#include <wheelrail/numerics/explicit_method.hpp>

namespace wheelrail {

/// The largest step [s] for which no mode that decays grows numerically; see explicit_method.hpp.
/// @note Modes stand for a conjugate pair each and are counted once. Allocates.
template <std::floating_point T>
[[nodiscard]] StableStep<T> largest_stable_step(ExplicitMethod method, const Eigenmodes<T>& modes,
                                                const StableStepOptions<T>& options = {}) {
  std::vector<std::complex<T>> eigenvalues;
  eigenvalues.reserve(modes.modes.size());
  for (const Eigenmode<T>& mode : modes.modes) eigenvalues.push_back(mode.eigenvalue);
  StableStep<T> result =
      largest_stable_step(method, std::span<const std::complex<T>>(eigenvalues), options);
  if (modes.status == SolveStatus::converged) return result;
  result = {};
  result.status = modes.status;
  return result;
}

/// The largest step [s] of the semi-implicit (symplectic) Euler method, q' += h q''(q, q') and,
/// with the new q', q += h q': where its step matrix first has the eigenvalue -1. With the state
/// matrix [0 1; K C], h = 2 / s for the greatest real s > 0 with det(s^2 + s C + K) = 0: for one
/// oscillator 2 (sqrt(1 + zeta^2) - zeta) / omega.
/// @param system of coordinates only; linearize's with series springs has a first-order part, of
///   which the method says nothing.
/// @return [s]; infinite where no s > 0. That is the largest stable step where mass, damping and
///   stiffness matrices are symmetric and none has a negative eigenvalue; where they are not, other
///   eigenvalues of the step matrix may leave the unit circle before. NaN where no eigenvalues are
///   found.
/// @throws std::invalid_argument if the system has elongations of series springs.
/// @note Allocates.
template <std::floating_point T>
[[nodiscard]] T semi_implicit_euler_stable_step(const Linearization<T>& system) {
  detail::require(system.elongation_count == 0,
                  "semi-implicit Euler: the system must have no elongations of series springs");
  Linearization<T> turned = system;
  turned.state_matrix.bottomRows(system.coordinate_count) *= T(-1);
  const Eigenmodes<T> modes = eigenmodes(turned);
  if (modes.status != SolveStatus::converged) return std::numeric_limits<T>::quiet_NaN();
  T greatest = T(0);
  for (const Eigenmode<T>& mode : modes.modes) {
    if (mode.eigenvalue.imag() == T(0)) greatest = std::max(greatest, mode.eigenvalue.real());
  }
  return T(0) < greatest ? T(T(2) / greatest) : std::numeric_limits<T>::infinity();
}

}  // namespace wheelrail
