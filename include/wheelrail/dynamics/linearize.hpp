#pragma once
/// @file
/// Small motions about a state: the equations of a system of bodies as one matrix, and its modes,
/// natural frequencies and damping ratios. May include: core, dynamics, Eigen, std.

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <complex>
#include <concepts>
#include <span>
#include <string>
#include <vector>
#include <wheelrail/dynamics/static_equilibrium.hpp>

namespace wheelrail {

namespace detail {

template <Real T>
[[nodiscard]] T cube_root_epsilon() {
  using std::pow;
  return pow(epsilon<T>(), T(T(1) / T(3)));
}

}  // namespace detail

/// The defaults balance the rounding of central differences against their third derivatives.
template <Real T>
struct LinearizationOptions {
  /// Differences are taken over +- displacement of coordinates and of series springs [m, rad], > 0;
  /// 6.1e-6 in double.
  T displacement = detail::cube_root_epsilon<T>();
  /// And over +- velocity [m/s, rad/s], > 0; 6.1e-6 in double.
  T velocity = detail::cube_root_epsilon<T>();
};

/// d(q, q', x)/dt = state_matrix (q, q', x) for small displacements q of the coordinates, their
/// velocities q' and elongations x of all series springs (SpringDamper).
/// Invariant: state_matrix is square, with 2 coordinate_count + elongation_count rows.
template <Real T>
struct Linearization {
  using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;  ///< of any size

  Matrix state_matrix;                ///< SI units: m and rad, s
  Eigen::Index coordinate_count = 0;  ///< number of q
  Eigen::Index elongation_count = 0;  ///< number of x
  T residual = T(0);  ///< the greatest |acceleration| in the state itself, 0 at rest [m/s2, rad/s2]

  /// -M^-1 K of a textbook, whose units are those of [1/s2] with m and rad as they stand.
  [[nodiscard]] Matrix acceleration_by_displacement() const {
    return state_matrix.block(coordinate_count, 0, coordinate_count, coordinate_count);
  }
  /// -M^-1 C of a textbook, [1/s]; dampers with series springs have no part in it.
  [[nodiscard]] Matrix acceleration_by_velocity() const {
    return state_matrix.block(coordinate_count, coordinate_count, coordinate_count,
                              coordinate_count);
  }
};

/// Linearises @p system about the state @p y by central differences.
/// @param y the state that small motions are counted from; usually one of equilibrium, see
///   `residual`. It may hold velocities, but no body turns whose roll, pitch or yaw is a coordinate:
///   these are about its own axes, which must not turn away.
/// @param coordinates each at most once; the others are held: their displacements and velocities
///   stay zero. Bodies on a joint take part both or neither, with all coordinates in which the joint
///   acts, for its reactions are those on free bodies. Each constraint then adds two eigenvalues,
///   those of Baumgarte's Phi'' + 2 alpha Phi' + beta^2 Phi = 0, with |eigenvalue| = beta if
///   alpha <= beta; the others are the motion's.
/// @param external_wrenches y -> the wrenches on all bodies. Where their derivatives, or those of an
///   element's table, jump, the result is the mean over both sides.
/// @throws std::invalid_argument naming the coordinate or option that is out of its range.
/// @note Allocates; not for the hot path.
template <Real T, std::size_t MaximumBodies, std::size_t MaximumJoints, StateVector State,
          ExternalWrenches<State> Wrenches>
[[nodiscard]] Linearization<T> linearize(
    const MultibodySystem<T, MaximumBodies, MaximumJoints>& system, const State& y,
    std::span<const BodyDisplacement> coordinates, Wrenches&& external_wrenches,
    const LinearizationOptions<T>& options = {}) {
  using Column = Eigen::Matrix<T, Eigen::Dynamic, 1>;
  detail::require_coordinates(coordinates, system.body_count());
  detail::require_positive("displacement", options.displacement, "[m, rad]");
  detail::require_positive("velocity", options.velocity, "[m/s, rad/s]");
  const auto velocity_row = [&](std::size_t i) -> Eigen::Index {
    return RigidBodyLayout::offset(coordinates[i].body) + RigidBodyLayout::velocity_world +
           static_cast<Eigen::Index>(coordinates[i].direction);
  };
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const std::string name = std::string("coordinates[").append(std::to_string(i)).append("]");
    for (std::size_t k = 0; k < i; ++k) {
      detail::require(velocity_row(k) != velocity_row(i),
                      std::string(name)
                          .append(" is coordinates[")
                          .append(std::to_string(k))
                          .append("] again, but each must be given once"));
    }
    const Vector3<T> turning = y.template segment<3>(RigidBodyLayout::offset(coordinates[i].body) +
                                                     RigidBodyLayout::angular_velocity_body);
    detail::require(coordinates[i].direction < Displacement::roll || turning == Vector3<T>::Zero(),
                    std::string(name).append(" is a rotation, but its body must not turn in y"));
  }

  const auto n = static_cast<Eigen::Index>(coordinates.size());
  const Eigen::Index first_elongation =
      RigidBodyLayout::offset(static_cast<Eigen::Index>(system.body_count()));
  const Eigen::Index m = system.state_size() - first_elongation;
  const auto rates = [&](const State& at) -> Column {
    const State rate = system.rate(at, external_wrenches(at));
    Column values(n + m);
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      values(static_cast<Eigen::Index>(i)) = rate(velocity_row(i));
    }
    values.tail(m) = rate.tail(m);
    return values;
  };
  Linearization<T> result;
  result.coordinate_count = n;
  result.elongation_count = m;
  result.residual = detail::greatest_magnitude(Column(rates(y).head(n)));
  result.state_matrix = Linearization<T>::Matrix::Zero(2 * n + m, 2 * n + m);
  result.state_matrix.block(0, n, n, n).setIdentity();
  const auto take = [&](Eigen::Index column, const T& h, const auto& changed) {
    result.state_matrix.col(column).tail(n + m) =
        (rates(changed(h)) - rates(changed(T(-h)))) / T(T(2) * h);
  };
  const auto plus = [&](Eigen::Index row, const T& h) {
    return State(y + h * State::Unit(y.size(), row));
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto index = static_cast<std::size_t>(i);
    take(i, options.displacement,
         [&](const T& h) -> State { return displaced(y, coordinates[index], h); });
    take(n + i, options.velocity, [&](const T& h) { return plus(velocity_row(index), h); });
  }
  for (Eigen::Index i = 0; i < m; ++i) {
    take(2 * n + i, options.displacement,
         [&](const T& h) { return plus(first_elongation + i, h); });
  }
  return result;
}

/// @return @p system without its dampers, and without the series springs, which hold nothing then.
template <Real T>
[[nodiscard]] Linearization<T> undamped(const Linearization<T>& system) {
  const Eigen::Index n = system.coordinate_count;
  Linearization<T> result{system.state_matrix.topLeftCorner(2 * n, 2 * n), n, 0, system.residual};
  result.state_matrix.block(n, n, n, n).setZero();
  return result;
}

/// A motion in which all coordinates are proportional to exp(eigenvalue t).
template <std::floating_point T>
struct Eigenmode {
  std::complex<T> eigenvalue;  ///< [1/s]
  T frequency = T(0);  ///< |eigenvalue| / (2 pi): of an oscillator the natural one, undamped [Hz]
  T damping_ratio = T(0);  ///< -Re eigenvalue / |eigenvalue| [-]; +-1 where nothing oscillates
  /// Amplitudes of the coordinates [m, rad], in their order; the greatest is 1.
  Eigen::Matrix<std::complex<T>, Eigen::Dynamic, 1> shape;
};

/// Invariant: status == converged, or modes is empty.
template <std::floating_point T>
struct Eigenmodes {
  std::vector<Eigenmode<T>> modes;               ///< from the lowest frequency
  SolveStatus status = SolveStatus::not_finite;  ///< converged: all modes were found
};

/// The modes of @p system; one for each pair of conjugate eigenvalues, one for each real one.
/// Motion that nothing resists has the eigenvalue zero twice, of which rounding makes frequencies
/// of the order of the square root of epsilon times the highest.
/// @note Allocates; not for the hot path.
template <std::floating_point T>
[[nodiscard]] Eigenmodes<T> eigenmodes(const Linearization<T>& system) {
  Eigenmodes<T> result;
  if (!system.state_matrix.allFinite()) return result;
  result.status = SolveStatus::converged;
  if (system.state_matrix.size() == 0) return result;
  const Eigen::EigenSolver<typename Linearization<T>::Matrix> solver(system.state_matrix);
  if (solver.info() != Eigen::Success) return {{}, SolveStatus::iteration_limit};
  const auto vectors = solver.eigenvectors();
  for (Eigen::Index i = 0; i < solver.eigenvalues().size(); ++i) {
    Eigenmode<T> mode;
    mode.eigenvalue = solver.eigenvalues()(i);
    if (mode.eigenvalue.imag() < T(0)) continue;
    const T size = std::abs(mode.eigenvalue);
    mode.frequency = size / (T(2) * pi<T>());
    mode.damping_ratio = T(0) < size ? -mode.eigenvalue.real() / size : T(0);
    mode.shape = vectors.col(i).head(system.coordinate_count);
    Eigen::Index greatest = 0;
    const bool moves = 0 < mode.shape.size() && T(0) < mode.shape.cwiseAbs().maxCoeff(&greatest);
    if (moves) mode.shape /= std::complex<T>(mode.shape(greatest));
    result.modes.push_back(std::move(mode));
  }
  std::stable_sort(result.modes.begin(), result.modes.end(),
                   [](const auto& a, const auto& b) { return a.frequency < b.frequency; });
  return result;
}

}  // namespace wheelrail
