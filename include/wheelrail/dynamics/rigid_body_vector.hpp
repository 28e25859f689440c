#pragma once
/// @file
/// Rigid bodies in one column of numbers, for integrators (numerics/dormand_prince.hpp): body i of
/// a system holds the thirteen numbers from 13 i on, in the order of RigidBodyState's fields.
/// May include: core, dynamics, Eigen, std.

#include <wheelrail/core/assert.hpp>
#include <wheelrail/dynamics/rigid_body.hpp>

namespace wheelrail {

/// Where a body's numbers stand within its thirteen.
struct RigidBodyLayout {
  static constexpr Eigen::Index position_world = 0;  ///< index of the first of 3 [m]
  static constexpr Eigen::Index orientation = 3;  ///< index of the first of 4 Euler parameters [-]
  static constexpr Eigen::Index velocity_world = 7;          ///< index of the first of 3 [m/s]
  static constexpr Eigen::Index angular_velocity_body = 10;  ///< index of the first of 3 [rad/s]
  static constexpr Eigen::Index size = 13;                   ///< numbers of one body

  /// Where body @p index begins in the column of a system.
  [[nodiscard]] static constexpr Eigen::Index offset(Eigen::Index index) { return size * index; }
};

/// Position [m], Euler parameters [-], velocity [m/s], angular velocity [rad/s]; or their rates.
template <Real T>
using Vector13 = Eigen::Matrix<T, RigidBodyLayout::size, 1, Eigen::DontAlign>;

/// `y.segment<13>(RigidBodyLayout::offset(i)) = pack(state)` lays body i into a system's column.
template <Real T>
[[nodiscard]] Vector13<T> pack(const RigidBodyState<T>& state) {
  using Layout = RigidBodyLayout;
  Vector13<T> packed;
  packed.template segment<3>(Layout::position_world) = state.position_world;
  packed.template segment<4>(Layout::orientation) = state.orientation;
  packed.template segment<3>(Layout::velocity_world) = state.velocity_world;
  packed.template segment<3>(Layout::angular_velocity_body) = state.angular_velocity_body;
  return packed;
}

/// The same for the rates, in the same places.
template <Real T>
[[nodiscard]] Vector13<T> pack(const RigidBodyRate<T>& rate) {
  using Layout = RigidBodyLayout;
  Vector13<T> packed;
  packed.template segment<3>(Layout::position_world) = rate.velocity_world;
  packed.template segment<4>(Layout::orientation) = rate.orientation_rate;
  packed.template segment<3>(Layout::velocity_world) = rate.acceleration_world;
  packed.template segment<3>(Layout::angular_velocity_body) = rate.angular_acceleration_body;
  return packed;
}

/// The state of body @p index in the column of a system; the inverse of `pack`, bit for bit.
/// @pre the column has at least 13 (index + 1) rows.
template <class Derived>
[[nodiscard]] RigidBodyState<typename Derived::Scalar> unpack_rigid_body(
    const Eigen::MatrixBase<Derived>& column, Eigen::Index index = 0) {
  using Layout = RigidBodyLayout;
  const Eigen::Index offset = Layout::offset(index);
  WHEELRAIL_ASSERT(0 <= index && offset + Layout::size <= column.rows());
  return {column.template segment<3>(offset + Layout::position_world),
          column.template segment<4>(offset + Layout::orientation),
          column.template segment<3>(offset + Layout::velocity_world),
          column.template segment<3>(offset + Layout::angular_velocity_body)};
}

}  // namespace wheelrail
