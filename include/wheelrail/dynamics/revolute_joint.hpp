#pragma once
/// @file
/// A hinge between two bodies, or a body and the ground: its five constraints, as (91)-(94) need
/// them. May include: core, dynamics, Eigen, std.

#include <array>
#include <wheelrail/core/scalar_value.hpp>
#include <wheelrail/dynamics/body_motion.hpp>

namespace wheelrail {

/// A column of five: three of a joint's point [m], two of its axis [-]; or their rates.
template <Real T>
using Vector5 = Eigen::Matrix<T, 5, 1, Eigen::DontAlign>;

/// Phi and what follows from it at one instant. With the accelerations q'' = (dv/dt in the world,
/// domega/dt in the body) of both bodies, as rigid_body.hpp has them:
/// d2 Phi/dt2 = jacobians[0] q''_a + jacobians[1] q''_b - gamma.
template <Real T>
struct JointEquations {
  using Jacobian = Eigen::Matrix<T, 5, 6, Eigen::DontAlign>;  ///< of one body, by columns as below

  Vector5<T> residual;       ///< Phi [m, -]
  Vector5<T> residual_rate;  ///< dPhi/dt [m/s, 1/s]
  /// Phi_q of a and of b; the ground's is to be left out. The columns of the translations are those
  /// of I and of -I.
  std::array<Jacobian, 2> jacobians;
  Vector5<T> gamma;  ///< the terms quadratic in velocities [m/s2, 1/s2]
};

/// The last two rows of JointEquations, those of the axis.
template <Real T>
struct JointAxisEquations {
  using Gradients = Eigen::Matrix<T, 3, 2, Eigen::DontAlign>;  ///< of one body

  Vector2<T> residual;       ///< Phi [-]
  Vector2<T> residual_rate;  ///< dPhi/dt [1/s]
  /// Of a and of b: column i is row 3 + i of Phi_q for the rotation; the translation's are zero.
  std::array<Gradients, 2> gradients;
  Vector2<T> gamma;  ///< the terms quadratic in velocities [1/s2]
};

/// The point and the axis of a stay on those of b: Nikravesh (1988), 7.2.2. Rotation about the axis
/// stays free. Axes that point against each other satisfy the constraints too.
template <Real T>
class RevoluteJoint {
 public:
  /// @param a, b indices of two bodies of a system, at most one of them `ground_body`.
  /// @param point_a, point_b the joint, from each body's centre of mass in its axes [m]; in world
  ///   axes from the world's origin for the ground.
  /// @param axis_a, axis_b its axis in each body's axes, of any length but zero [-].
  /// @throws std::invalid_argument naming the value and the rule that it breaks.
  RevoluteJoint(int a, const Vector3<T>& point_a, const Vector3<T>& axis_a, int b,
                const Vector3<T>& point_b, const Vector3<T>& axis_b)
      : bodies_{a, b},
        point_a_(point_a),
        point_b_(point_b),
        axis_a_(unit("axis_a", axis_a)),
        axis_b_(unit("axis_b", axis_b)) {
    detail::require_finite_vector("point_a", point_a);
    detail::require_finite_vector("point_b", point_b);
    // The coordinate axis that is most square to axis_b makes the first perpendicular.
    Eigen::Index least = 0;
    for (Eigen::Index i = 1; i < 3; ++i) {
      if (detail::magnitude(axis_b_(i)) < detail::magnitude(axis_b_(least))) least = i;
    }
    perpendiculars_b_[0] = unit("axis_b", cross(axis_b_, Vector3<T>(Vector3<T>::Unit(least))));
    perpendiculars_b_[1] = cross(axis_b_, perpendiculars_b_[0]);
    if constexpr (!has_derivatives<T>) {
      is_centred_ = point_a == Vector3<T>::Zero() && point_b == Vector3<T>::Zero();
    }
  }

  /// The indices of a and b.
  [[nodiscard]] const std::array<int, 2>& bodies() const { return bodies_; }
  /// Whether the point is the centre of mass of both bodies (the origin of the ground): then its
  /// rows do not turn them. Never in dual numbers: a point may be zero and have derivatives.
  [[nodiscard]] bool is_centred() const { return is_centred_; }
  /// The axis, of unit length, in a's axes [-].
  [[nodiscard]] const Vector3<T>& axis_a() const { return axis_a_; }

  /// Phi = (point of a - point of b in the world, axis of a . two perpendiculars to the axis of b),
  /// with its derivatives.
  /// @param a, b the motions of the two bodies; BodyMotion{} for the ground.
  [[nodiscard]] JointEquations<T> equations(const BodyMotion<T>& a, const BodyMotion<T>& b) const {
    const Vector3<T> arm_a_world = a.body_to_world * point_a_;
    const Vector3<T> arm_b_world = b.body_to_world * point_b_;
    const Vector3<T>& wa = a.angular_velocity_world;
    const Vector3<T>& wb = b.angular_velocity_world;
    const Vector3<T> turning_a = cross(wa, arm_a_world), turning_b = cross(wb, arm_b_world);

    JointEquations<T> e;
    e.residual.template head<3>() =
        (a.position_world - b.position_world) + (arm_a_world - arm_b_world);
    e.residual_rate.template head<3>() =
        (a.velocity_world - b.velocity_world) + (turning_a - turning_b);
    e.gamma.template head<3>() = cross(wb, turning_b) - cross(wa, turning_a);
    for (auto& jacobian : e.jacobians) jacobian.setZero();
    for (Eigen::Index i = 0; i < 3; ++i) {
      // Rows of v + A (omega_body x point): e_i . A (w x s) = (s x A^T e_i) . w.
      const Vector3<T> row_a = a.body_to_world.row(i).transpose();
      const Vector3<T> row_b = b.body_to_world.row(i).transpose();
      e.jacobians[0](i, i) = T(1);
      e.jacobians[0].row(i).template tail<3>() = cross(point_a_, row_a).transpose();
      e.jacobians[1](i, i) = T(-1);
      e.jacobians[1].row(i).template tail<3>() = cross(row_b, point_b_).transpose();
    }

    const JointAxisEquations<T> axis = axis_equations(a, b);
    e.residual.template tail<2>() = axis.residual;
    e.residual_rate.template tail<2>() = axis.residual_rate;
    e.gamma.template tail<2>() = axis.gamma;
    for (std::size_t side = 0; side < 2; ++side) {
      e.jacobians[side].template bottomRightCorner<2, 3>() = axis.gradients[side].transpose();
    }
    return e;
  }

  /// Those of the axis alone.
  /// @param a, b as in `equations`.
  [[nodiscard]] JointAxisEquations<T> axis_equations(const BodyMotion<T>& a,
                                                     const BodyMotion<T>& b) const {
    // The axis of a, h, and its rates as an observer on b sees them, but for angular accelerations.
    const Vector3<T>& wa = a.angular_velocity_world;
    const Vector3<T>& wb = b.angular_velocity_world;
    const Vector3<T> h = a.body_to_world * axis_a_;  // in the world, as all without suffix
    const Vector3<T> spin = wa - wb;
    const Vector3<T> h_rate = cross(spin, h);
    const Vector3<T> h_rate2 = cross(spin, cross(wa, h)) - cross(wb, h_rate);
    const Vector3<T> h_b = b.body_to_world.transpose() * h;
    JointAxisEquations<T> e;
    for (Eigen::Index i = 0; i < 2; ++i) {
      const Vector3<T>& u_b = perpendiculars_b_[static_cast<std::size_t>(i)];
      const Vector3<T> u = b.body_to_world * u_b;
      const Vector3<T> u_a = a.body_to_world.transpose() * u;
      e.residual(i) = dot(h, u);
      e.residual_rate(i) = dot(h_rate, u);
      e.gamma(i) = -dot(h_rate2, u);
      // The same product of h and u, in the axes of either body.
      e.gradients[0].col(i) = cross(axis_a_, u_a);
      e.gradients[1].col(i) = cross(u_b, h_b);
    }
    return e;
  }

 private:
  static Vector3<T> unit(const char* name, const Vector3<T>& v) {
    using std::sqrt;
    const T length = sqrt(v.squaredNorm());
    detail::require(is_finite(length) && T(0) < length, std::string("the length of ") + name,
                    length, "finite and > 0 [-]");
    return v / length;
  }

  std::array<int, 2> bodies_;
  Vector3<T> point_a_, point_b_;
  Vector3<T> axis_a_, axis_b_;
  std::array<Vector3<T>, 2> perpendiculars_b_;
  bool is_centred_ = false;
};

}  // namespace wheelrail
