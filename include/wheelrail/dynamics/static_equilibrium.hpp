#pragma once
/// @file
/// Where a system of bodies rests: positions at which accelerations vanish, for a start without
/// transients. May include: core, numerics, dynamics, Eigen, std.

#include <Eigen/LU>
#include <concepts>
#include <span>
#include <string>
#include <wheelrail/core/solve_status.hpp>
#include <wheelrail/dynamics/multibody_system.hpp>

namespace wheelrail {

/// Along the world's axes [m], or about the body's own [rad].
enum class Displacement { x, y, z, roll, pitch, yaw };

/// One of the six displacements of one body.
struct BodyDisplacement {
  int body = 0;                              ///< its index in the model
  Displacement direction = Displacement::z;  ///< which of the six
};

/// Wrenches on all bodies from the state, as MultibodySystem::rate takes them.
template <class Function, class State>
concept ExternalWrenches = StateVector<State> && requires(Function& f, const State& y) {
  { f(y) } -> std::convertible_to<std::span<const Wrench<typename State::Scalar>>>;
};

namespace detail {

template <Real T>
[[nodiscard]] T root_epsilon() {
  using std::sqrt;
  return sqrt(epsilon<T>());
}

}  // namespace detail

/// When the search for an equilibrium ends, and its steps.
template <Real T>
struct EquilibriumOptions {
  /// |acceleration| <= tolerance in all coordinates ends the search [m/s2, rad/s2], > 0; the
  /// default is 1.5e-8 in double.
  T tolerance = detail::root_epsilon<T>();
  /// The derivatives are differences over +- difference [m, rad], > 0; 1.5e-7 in double.
  T difference = T(10) * detail::root_epsilon<T>();
  /// The first step lets each coordinate follow its acceleration for this time [s], > 0.
  T first_time = constant<T>(0.01L);
  /// steps tried <= maximum_iterations.
  int maximum_iterations = 300;
};

/// Invariant: status == converged implies residual <= tolerance. The state is the last
/// that was taken.
template <StateVector State>
struct EquilibriumResult {
  State state;                                   ///< as MultibodySystem has it
  SolveStatus status = SolveStatus::not_finite;  ///< converged: at rest
  int iterations = 0;                            ///< steps tried
  typename State::Scalar residual{};             ///< the greatest |acceleration| [m/s2, rad/s2]
};

/// @return @p y with body @p coordinate.body displaced by @p amount [m] or [rad].
template <StateVector State>
[[nodiscard]] State displaced(State y, const BodyDisplacement& coordinate,
                              const typename State::Scalar& amount) {
  using T = typename State::Scalar;
  const auto component = static_cast<Eigen::Index>(coordinate.direction);
  const Eigen::Index offset = RigidBodyLayout::offset(coordinate.body);
  if (component < 3) {
    y(offset + RigidBodyLayout::position_world + component) += amount;
  } else {
    auto p = y.template segment<4>(offset + RigidBodyLayout::orientation);
    const Vector3<T> axis = Vector3<T>::Unit(component - 3);
    p = euler_product(Vector4<T>(p), euler_parameters_from_axis_angle(axis, amount));
  }
  return y;
}

namespace detail {

/// The accelerations of @p coordinates [m/s2, rad/s2], in their order.
template <class System, class State, class Wrenches>
[[nodiscard]] Eigen::Matrix<typename State::Scalar, Eigen::Dynamic, 1> accelerations(
    const System& system, const State& y, std::span<const BodyDisplacement> coordinates,
    const Wrenches& external_wrenches) {
  const State rate = system.rate(y, external_wrenches);
  Eigen::Matrix<typename State::Scalar, Eigen::Dynamic, 1> values(
      static_cast<Eigen::Index>(coordinates.size()));
  Eigen::Index row = 0;
  for (const BodyDisplacement& c : coordinates) {
    values(row++) = rate(RigidBodyLayout::offset(c.body) + RigidBodyLayout::velocity_world +
                         static_cast<Eigen::Index>(c.direction));
  }
  return values;
}

/// The greatest |v_i|; NaN or infinite where any is.
template <class Column>
[[nodiscard]] typename Column::Scalar greatest_magnitude(const Column& v) {
  using T = typename Column::Scalar;
  T greatest = T(0);
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    const T size = magnitude(v(i));
    if (greatest < size || !is_finite(size)) greatest = size;
  }
  return greatest;
}

inline void require_coordinates(std::span<const BodyDisplacement> coordinates,
                                std::size_t body_count) {
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const int body = coordinates[i].body;
    require(0 <= body && static_cast<std::size_t>(body) < body_count,
            std::string("coordinates[")
                .append(std::to_string(i))
                .append("].body is ")
                .append(std::to_string(body))
                .append(", but must be from 0 to less than the number of bodies, ")
                .append(std::to_string(body_count)));
  }
}

}  // namespace detail

/// Moves @p coordinates until their accelerations a vanish, by pseudo-transient continuation
/// (C. T. Kelley, D. E. Keyes, SIAM J. Numer. Anal. 35 (1998) 508-523): steps
/// (shift I - da/dq)^-1 a, with the shift taken down after each that does not increase |a|, up
/// after one that doubles it and is not taken. At first a body follows its acceleration, so that a
/// wheel above its rail falls on it; in the end it is Newton's method. Joints: vanishing
/// accelerations of a joint's two bodies close it, through the term beta^2 Phi of (91). So both
/// bodies of a joint take part, with all coordinates in which forces act on them.
/// @param start velocities and series springs stay as they are: zero, or those of a steady motion.
/// @param coordinates each at most once; the others are held.
/// @param external_wrenches y -> the wrenches on all bodies; its derivatives may jump.
/// @throws std::invalid_argument naming the coordinate or option that is out of its range.
/// @note Allocates; not for the hot path.
template <Real T, std::size_t MaximumBodies, std::size_t MaximumJoints, StateVector State,
          ExternalWrenches<State> Wrenches>
[[nodiscard]] EquilibriumResult<State> static_equilibrium(
    const MultibodySystem<T, MaximumBodies, MaximumJoints>& system, const State& start,
    std::span<const BodyDisplacement> coordinates, Wrenches&& external_wrenches,
    const EquilibriumOptions<T>& options = {}) {
  using Column = Eigen::Matrix<T, Eigen::Dynamic, 1>;
  using Square = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
  detail::require_coordinates(coordinates, system.body_count());
  detail::require_positive("tolerance", options.tolerance, "[m/s2, rad/s2]");
  detail::require_positive("difference", options.difference, "[m, rad]");
  detail::require_positive("first_time", options.first_time, "[s]");
  detail::require(0 < options.maximum_iterations,
                  std::string("maximum_iterations is ")
                      .append(std::to_string(options.maximum_iterations))
                      .append(", but must be > 0"));

  const auto accelerations = [&](const State& y) -> Column {
    return detail::accelerations(system, y, coordinates, external_wrenches(y));
  };
  const auto n = static_cast<Eigen::Index>(coordinates.size());
  const auto coordinate = [&](Eigen::Index i) -> const BodyDisplacement& {
    return coordinates[static_cast<std::size_t>(i)];
  };
  Column a = accelerations(start);
  EquilibriumResult<State> result{start, SolveStatus::not_finite, 0, detail::greatest_magnitude(a)};
  Square jacobian(n, n);
  T shift = T(1) / detail::square(options.first_time);
  bool has_moved = true;  // since the jacobian was computed
  for (; is_finite(result.residual); ++result.iterations) {
    const bool converged = result.residual <= options.tolerance;
    if (converged || options.maximum_iterations <= result.iterations) {
      result.status = converged ? SolveStatus::converged : SolveStatus::iteration_limit;
      break;
    }
    const T h = options.difference;
    for (Eigen::Index i = 0; has_moved && i < n; ++i) {
      jacobian.col(i) = (accelerations(displaced(result.state, coordinate(i), h)) -
                         accelerations(displaced(result.state, coordinate(i), T(-h)))) /
                        T(T(2) * h);
    }
    const Square matrix = shift * Square::Identity(n, n) - jacobian;
    const Column step = matrix.partialPivLu().solve(a);
    State trial = result.state;
    for (Eigen::Index i = 0; i < n; ++i) trial = displaced(trial, coordinate(i), T(step(i)));
    const Column a_trial = accelerations(trial);
    const T residual = detail::greatest_magnitude(a_trial);
    // What falls on a stiff contact may feel more there than before, but not much more.
    has_moved = residual <= T(2) * result.residual;
    if (has_moved) {
      if (residual <= result.residual) shift *= constant<T>(0.2L);
      result.state = trial;
      result.residual = residual;
      a = a_trial;
    } else {
      shift *= T(10);
    }
  }
  return result;
}

}  // namespace wheelrail
