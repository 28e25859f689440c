#pragma once
/// @file
/// A torsion spring against the roll of one body on another: an anti-roll bar.
/// May include: core, dynamics, Eigen, std.

#include <string>
#include <wheelrail/dynamics/body_motion.hpp>

namespace wheelrail {

/// The roll angle of b against a is that of b's y axis about a's x axis: atan2 of its z and its y
/// component in a's axes, zero where the frames are parallel. The moment on b is
/// -(stiffness angle + damping rate) times the gradient of the angle, the opposite acts on a. The
/// gradient is a's x axis, plus a part of the order of b's yaw on a that makes the spring
/// conservative for any orientation.
template <Real T>
struct TorsionSpring {
  int a = ground_body;  ///< index of a body, or ground
  int b = ground_body;  ///< index of the other body, or ground
  T stiffness = T(0);   ///< [N m/rad], >= 0
  T damping = T(0);     ///< [N m s/rad], >= 0
};

/// The roll of b against a.
template <Real T>
struct RelativeRoll {
  T angle = T(0);             ///< in (-pi, pi] [rad]
  T rate = T(0);              ///< its derivative in time [rad/s]
  Vector3<T> gradient_world;  ///< rate = gradient . (angular velocity of b - of a) [-]
};

/// @param a, b the motions of the two bodies; BodyMotion{} for the ground.
/// @pre b's y axis is not along a's x axis; NaN there.
template <Real T>
[[nodiscard]] RelativeRoll<T> relative_roll(const BodyMotion<T>& a, const BodyMotion<T>& b) {
  using std::atan2;
  const Vector3<T> e = a.body_to_world.transpose() * b.body_to_world.col(1);
  const T along = e.x() / (e.y() * e.y() + e.z() * e.z());
  const Vector3<T> gradient_a(T(1), -along * e.y(), -along * e.z());
  RelativeRoll<T> roll;
  roll.angle = atan2(e.z(), e.y());
  roll.gradient_world = a.body_to_world * gradient_a;
  roll.rate = roll.gradient_world.dot(b.angular_velocity_world - a.angular_velocity_world);
  return roll;
}

/// The moment on b, in world axes; the opposite acts on a [N m].
template <Real T>
[[nodiscard]] Vector3<T> moment_b_world(const TorsionSpring<T>& element, const BodyMotion<T>& a,
                                        const BodyMotion<T>& b) {
  const RelativeRoll<T> roll = relative_roll(a, b);
  return roll.gradient_world * T(-(element.stiffness * roll.angle + element.damping * roll.rate));
}

/// [J], zero without roll.
template <Real T>
[[nodiscard]] T stored_energy(const TorsionSpring<T>& element, const BodyMotion<T>& a,
                              const BodyMotion<T>& b) {
  return element.stiffness * detail::square(relative_roll(a, b).angle) / T(2);
}

/// [W], >= 0.
template <Real T>
[[nodiscard]] T dissipated_power(const TorsionSpring<T>& element, const BodyMotion<T>& a,
                                 const BodyMotion<T>& b) {
  return element.damping * detail::square(relative_roll(a, b).rate);
}

namespace detail {

/// @throws std::invalid_argument naming the field of @p element that breaks a rule.
template <Real T>
void require_valid(const TorsionSpring<T>& element, const std::string& name, std::size_t bodies) {
  require_two_bodies(name, element.a, element.b, bodies);
  require_not_negative(name + ".stiffness", element.stiffness, "[N m/rad]");
  require_not_negative(name + ".damping", element.damping, "[N m s/rad]");
}

}  // namespace detail
}  // namespace wheelrail
