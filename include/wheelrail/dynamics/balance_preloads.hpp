#pragma once
/// @file
/// Preloads of springs that hold a system of bodies where it is, so that a simulation starts at
/// rest. May include: core, numerics, dynamics, Eigen, std.

#include <Eigen/QR>
#include <span>
#include <string>
#include <utility>
#include <wheelrail/dynamics/static_equilibrium.hpp>

namespace wheelrail {

/// One component of the preload of model().spring_dampers[spring_damper].
struct PreloadComponent {
  std::size_t spring_damper = 0;  ///< index in the model
  int axis = 2;                   ///< 0, 1, 2: a's x, y, z
};

/// Invariant: status == converged implies residual <= sqrt(epsilon<T>()). iteration_limit: these
/// preloads cannot balance what acts; they are the best in the sense of least squares.
template <Real T>
struct PreloadBalance {
  MultibodyModel<T> model;                       ///< with the new preloads
  SolveStatus status = SolveStatus::not_finite;  ///< converged: all is balanced
  T residual = T(0);  ///< the greatest |acceleration| that is left [m/s2, rad/s2]
};

/// The accelerations of @p coordinates are made to vanish in the state @p y by the change of
/// @p preloads with the least sum of squares: springs that are placed symmetrically share a
/// symmetric load equally. Accelerations are affine in preloads, so that one linear solve, and one
/// more against its rounding, do.
/// @param coordinates of the bodies that the springs are to carry. Bodies on joints and rails
///   usually stay out: their balance comes from contact, see `static_equilibrium`.
/// @param external_wrenches on all bodies in the state @p y.
/// @throws std::invalid_argument naming what is out of its range.
/// @note Allocates; not for the hot path.
template <Real T, std::size_t MaximumBodies, std::size_t MaximumJoints, StateVector State>
[[nodiscard]] PreloadBalance<T> balance_preloads(
    const MultibodySystem<T, MaximumBodies, MaximumJoints>& system, const State& y,
    std::span<const PreloadComponent> preloads, std::span<const BodyDisplacement> coordinates,
    std::span<const Wrench<T>> external_wrenches) {
  using System = MultibodySystem<T, MaximumBodies, MaximumJoints>;
  using Column = Eigen::Matrix<T, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
  detail::require_coordinates(coordinates, system.body_count());
  for (std::size_t i = 0; i < preloads.size(); ++i) {
    const std::string name = std::string("preloads[").append(std::to_string(i)).append("]");
    const std::size_t count = system.model().spring_dampers.size();
    detail::require(preloads[i].spring_damper < count,
                    std::string(name)
                        .append(".spring_damper is ")
                        .append(std::to_string(preloads[i].spring_damper))
                        .append(", but must be less than their number, ")
                        .append(std::to_string(count)));
    detail::require(0 <= preloads[i].axis && preloads[i].axis < 3,
                    std::string(name)
                        .append(".axis is ")
                        .append(std::to_string(preloads[i].axis))
                        .append(", but must be 0, 1 or 2"));
  }
  const auto rows = static_cast<Eigen::Index>(coordinates.size());
  const auto columns = static_cast<Eigen::Index>(preloads.size());
  const auto accelerations = [&](const MultibodyModel<T>& model) -> Column {
    return detail::accelerations(System(model), y, coordinates, external_wrenches);
  };
  const auto preload = [&](MultibodyModel<T>& model, Eigen::Index i) -> T& {
    const PreloadComponent& c = preloads[static_cast<std::size_t>(i)];
    return model.spring_dampers[c.spring_damper].preload_a(c.axis);
  };

  PreloadBalance<T> result{system.model(), SolveStatus::not_finite, T(0)};
  // A force in which rounding does not show: the heaviest body's, at 1 m/s2.
  T unit = T(0);
  for (const RigidBody<T>& body : result.model.bodies) unit = detail::max(unit, body.mass());
  Column a = accelerations(result.model);
  result.residual = detail::greatest_magnitude(a);
  if (!is_finite(result.residual)) return result;
  Matrix effect(rows, columns);  // of a change of each preload by `unit`
  for (Eigen::Index i = 0; i < columns; ++i) {
    MultibodyModel<T> changed = result.model;
    preload(changed, i) += unit;
    effect.col(i) = accelerations(changed) - a;
  }
  Eigen::CompleteOrthogonalDecomposition<Matrix> solver(rows, columns);
  solver.setThreshold(detail::root_epsilon<T>());
  solver.compute(effect);
  for (int pass = 0; pass < 2; ++pass) {
    const Column change = solver.solve(a);
    for (Eigen::Index i = 0; i < columns; ++i) preload(result.model, i) -= unit * change(i);
    a = accelerations(result.model);
    result.residual = detail::greatest_magnitude(a);
  }
  const T tolerance = detail::root_epsilon<T>();
  result.status =
      result.residual <= tolerance ? SolveStatus::converged : SolveStatus::iteration_limit;
  return result;
}

}  // namespace wheelrail
