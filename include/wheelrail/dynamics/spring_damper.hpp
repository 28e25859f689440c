#pragma once
/// @file
/// Springs and dampers in three directions between points of two bodies, or of a body and the
/// ground: primary and secondary suspension, bump stops, traction rods.
/// May include: core, dynamics, Eigen, std.

#include <array>
#include <string>
#include <wheelrail/dynamics/body_motion.hpp>
#include <wheelrail/dynamics/characteristic.hpp>

namespace wheelrail {

/// Acts along the three axes of a's frame, which turn with a. With d the displacement of b's point
/// from a's point and d' its rate, both as an observer on a sees them, axis by axis:
/// force on b = preload - spring(d) - damper(d'). The opposite acts on a, at the same place: where
/// b's point is. So momentum and angular momentum are conserved, and the springs have a potential,
/// for any displacement.
///
/// A damper with series stiffness k acts through a spring of its own (a Maxwell element): its force
/// is k x with x the elongation of that spring, a state of its own: dx/dt = d' - damper^-1(k x).
/// (A length, not a force, so that it compares with the positions in an integrator's tolerance.)
template <Real T>
struct SpringDamper {
  int a = ground_body;                        ///< index of the body whose axes are used, or ground
  Vector3<T> point_a = Vector3<T>::Zero();    ///< from a's centre of mass, in a's axes [m]
  int b = ground_body;                        ///< index of the other body, or ground
  Vector3<T> point_b = Vector3<T>::Zero();    ///< from b's centre of mass, in b's axes [m]
  std::array<Characteristic<T>, 3> spring{};  ///< over displacement [m], for a's x, y and z
  std::array<Characteristic<T>, 3> damper{};  ///< over velocity [m/s], for a's x, y and z
  /// Force on b without displacement, in a's axes [N]: z > 0 carries b's weight.
  Vector3<T> preload_a = Vector3<T>::Zero();
  /// Of each damper, in a's axes [N/m], >= 0; zero stands for a rigid connection. Where it is not
  /// zero, the damper's force must strictly increase.
  Vector3<T> series_stiffness_a = Vector3<T>::Zero();
};

/// What a SpringDamper does at one instant.
template <Real T>
struct SpringDamperAction {
  Vector3<T> force_b_world;      ///< on b; the opposite acts on a [N]
  Vector3<T> point_world;        ///< where both act [m]
  Vector3<T> elongation_rate_a;  ///< of the series springs, in a's axes; zero without [m/s]
};

/// The displacement of b's point against a's, and its rate, seen from a.
template <Real T>
struct SpringDamperMotion {
  Vector3<T> point_world;     ///< b's point [m]
  Vector3<T> displacement_a;  ///< in a's axes [m]
  Vector3<T> velocity_a;      ///< in a's axes [m/s]
};

/// @param a, b the motions of the two bodies; BodyMotion{} for the ground.
template <Real T>
[[nodiscard]] inline SpringDamperMotion<T> relative_motion(const SpringDamper<T>& element,
                                                           const BodyMotion<T>& a,
                                                           const BodyMotion<T>& b) {
  const Vector3<T> arm_b_world = b.body_to_world * element.point_b;
  const Vector3<T> point_world = b.position_world + arm_b_world;
  const Vector3<T> arm_a_world = point_world - a.position_world;
  const Vector3<T> velocity_world = (b.velocity_world - a.velocity_world) +
                                    cross(b.angular_velocity_world, arm_b_world) -
                                    cross(a.angular_velocity_world, arm_a_world);
  return {point_world, a.body_to_world.transpose() * arm_a_world - element.point_a,
          a.body_to_world.transpose() * velocity_world};
}

/// @param elongation_a of the series springs, in a's axes [m]; not used without.
/// @param a, b the motions of the two bodies; BodyMotion{} for the ground.
template <Real T>
[[nodiscard]] inline SpringDamperAction<T> action(const SpringDamper<T>& element,
                                                  const BodyMotion<T>& a, const BodyMotion<T>& b,
                                                  const Vector3<T>& elongation_a) {
  const SpringDamperMotion<T> motion = relative_motion(element, a, b);
  Vector3<T> force_a, elongation_rate_a = Vector3<T>::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    const T& velocity = motion.velocity_a(i);
    T damping;
    if (T(0) < element.series_stiffness_a(i)) {
      damping = element.series_stiffness_a(i) * elongation_a(i);
      elongation_rate_a(i) = velocity - element.damper[axis].argument(damping);
    } else {
      damping = element.damper[axis].force(velocity);
    }
    force_a(i) =
        element.preload_a(i) - element.spring[axis].force(motion.displacement_a(i)) - damping;
  }
  return {a.body_to_world * force_a, motion.point_world, elongation_rate_a};
}

/// The energy stored in springs and series springs [J], zero without displacement; the preload
/// counts with its potential -preload . d.
template <Real T>
[[nodiscard]] T stored_energy(const SpringDamper<T>& element, const BodyMotion<T>& a,
                              const BodyMotion<T>& b, const Vector3<T>& elongation_a) {
  const Vector3<T> d = relative_motion(element, a, b).displacement_a;
  T energy = T(0);
  for (Eigen::Index i = 0; i < 3; ++i) {
    energy +=
        element.spring[static_cast<std::size_t>(i)].energy(d(i)) - element.preload_a(i) * d(i);
    if (T(0) < element.series_stiffness_a(i)) {
      energy += element.series_stiffness_a(i) * elongation_a(i) * elongation_a(i) / T(2);
    }
  }
  return energy;
}

/// What the dampers turn into heat [W]; >= 0 if their forces vanish at rest.
template <Real T>
[[nodiscard]] T dissipated_power(const SpringDamper<T>& element, const BodyMotion<T>& a,
                                 const BodyMotion<T>& b, const Vector3<T>& elongation_a) {
  const Vector3<T> velocity_a = relative_motion(element, a, b).velocity_a;
  T power = T(0);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Characteristic<T>& damper = element.damper[static_cast<std::size_t>(i)];
    if (element.series_stiffness_a(i) == T(0)) {
      power += damper.force(velocity_a(i)) * velocity_a(i);
    } else {
      const T force = element.series_stiffness_a(i) * elongation_a(i);
      power += force * damper.argument(force);
    }
  }
  return power;
}

namespace detail {

/// @throws std::invalid_argument naming the field of @p element that breaks a rule.
template <Real T>
void require_valid(const SpringDamper<T>& element, const std::string& name, std::size_t bodies) {
  static constexpr const char* axes[] = {".x", ".y", ".z"};
  require_two_bodies(name, element.a, element.b, bodies);
  require_finite_vector(name + ".point_a", element.point_a);
  require_finite_vector(name + ".point_b", element.point_b);
  require_finite_vector(name + ".preload_a", element.preload_a);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const T& stiffness = element.series_stiffness_a(i);
    const std::string field = name + ".series_stiffness_a" + axes[i];
    require_not_negative(field, stiffness, "[N/m]");
    require(
        stiffness == T(0) || element.damper[static_cast<std::size_t>(i)].is_strictly_increasing(),
        field, stiffness, "0 where the damper's force does not strictly increase");
  }
}

}  // namespace detail
}  // namespace wheelrail
