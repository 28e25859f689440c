#pragma once
/// @file
/// The orientation of a body by its four Euler parameters p = (e0, e1, e2, e3), scalar first:
/// e0 = cos(angle/2), (e1, e2, e3) = axis sin(angle/2), as the paper's §5 has them. World means the
/// inertial frame, body the frame that turns with the body; A(p) takes components from body to
/// world. P. E. Nikravesh, Computer-Aided Analysis of Mechanical Systems (1988), ch. 6: A = G L^T,
/// dp/dt = L^T omega_body / 2 = G^T omega_world / 2. Departure: p need not be of unit length.
/// May include: core, Eigen, std.
///
/// The terms of every sum keep their relative signs when the motion is reflected in the x-z plane,
/// (e0, e1, e2, e3) -> (e0, -e1, e2, -e3): reflected input gives reflected output, bit for bit
/// unless the compiler fuses multiplications with additions (-ffp-contract).

#include <wheelrail/core/vector.hpp>

namespace wheelrail {

/// p = (1, 0, 0, 0) [-]: the body's axes are the world's.
template <Real T>
[[nodiscard]] Vector4<T> identity_euler_parameters() {
  return Vector4<T>(T(1), T(0), T(0), T(0));
}

/// A(p) [-]: v_world = A v_body; the columns are the body's axes in the world.
/// @param p Euler parameters of the body in the world, of any length but zero.
/// @return orthonormal to a few rounding units, whatever |p|.
template <Real T>
[[nodiscard]] inline Matrix3<T> rotation_matrix(const Vector4<T>& p) {
  const T s = T(2) / p.squaredNorm();
  const T e0 = p(0), e1 = p(1), e2 = p(2), e3 = p(3);
  Matrix3<T> a;
  a << T(1) - s * (e2 * e2 + e3 * e3), s * (e1 * e2 - e0 * e3), s * (e1 * e3 + e0 * e2),
      s * (e1 * e2 + e0 * e3), T(1) - s * (e1 * e1 + e3 * e3), s * (e2 * e3 - e0 * e1),
      s * (e1 * e3 - e0 * e2), s * (e2 * e3 + e0 * e1), T(1) - s * (e1 * e1 + e2 * e2);
  return a;
}

/// p q [-]: turns by @p q first, then by @p p, so A(p q) = A(p) A(q); |p q| = |p| |q|.
template <Real T>
[[nodiscard]] Vector4<T> euler_product(const Vector4<T>& p, const Vector4<T>& q) {
  return Vector4<T>(p(0) * q(0) - p(1) * q(1) - p(2) * q(2) - p(3) * q(3),
                    p(0) * q(1) + p(1) * q(0) + p(2) * q(3) - p(3) * q(2),
                    p(0) * q(2) + p(2) * q(0) + p(3) * q(1) - p(1) * q(3),
                    p(0) * q(3) + p(3) * q(0) + p(1) * q(2) - p(2) * q(1));
}

/// The turn back [-]: A of it is the transpose of A(p).
template <Real T>
[[nodiscard]] Vector4<T> euler_conjugate(const Vector4<T>& p) {
  return Vector4<T>(p(0), -p(1), -p(2), -p(3));
}

/// p of unit length [-], the same orientation. A zero p gives NaN.
template <Real T>
[[nodiscard]] Vector4<T> unit_euler_parameters(const Vector4<T>& p) {
  using std::sqrt;
  return p / T(sqrt(p.squaredNorm()));
}

/// dp/dt = L(p)^T omega_body / 2 [1/s]; keeps |p|, and dA/dt = A [omega_body x] for any |p|.
/// @param angular_velocity_body of the body against the world, in body axes [rad/s].
template <Real T>
[[nodiscard]] Vector4<T> euler_parameter_rate(const Vector4<T>& p,
                                              const Vector3<T>& angular_velocity_body) {
  const Vector3<T> half = angular_velocity_body / T(2);
  return euler_product(p, Vector4<T>(T(0), half.x(), half.y(), half.z()));
}

/// dp/dt = G(p)^T omega_world / 2 [1/s]; the same from the components in the world.
/// @param angular_velocity_world of the body against the world, in world axes [rad/s].
template <Real T>
[[nodiscard]] Vector4<T> euler_parameter_rate_from_world(const Vector4<T>& p,
                                                         const Vector3<T>& angular_velocity_world) {
  const Vector3<T> half = angular_velocity_world / T(2);
  return euler_product(Vector4<T>(T(0), half.x(), half.y(), half.z()), p);
}

/// omega_body = 2 L(p) dp/dt / |p|^2 [rad/s], in body axes; the part of @p p_rate along p, which
/// turns nothing, is left out.
/// @param p_rate dp/dt [1/s].
template <Real T>
[[nodiscard]] Vector3<T> angular_velocity_body(const Vector4<T>& p, const Vector4<T>& p_rate) {
  const Vector4<T> turn = euler_product(euler_conjugate(p), p_rate);
  return turn.template tail<3>() * T(T(2) / p.squaredNorm());
}

/// The turn by @p angle [rad] about @p axis_world, positive by the right hand.
/// @param axis_world of any length [-]; it has the same components in body and world. The zero
///   vector has no direction and gives NaN.
/// @return of unit length [-].
template <Real T>
[[nodiscard]] Vector4<T> euler_parameters_from_axis_angle(const Vector3<T>& axis_world,
                                                          const T& angle) {
  using std::cos, std::sin, std::sqrt;
  const T half = angle / T(2);
  const T s = sin(half) / sqrt(axis_world.squaredNorm());
  return Vector4<T>(cos(half), s * axis_world.x(), s * axis_world.y(), s * axis_world.z());
}

/// The Euler parameters of A(p) = @p body_to_world: S. W. Shepperd, Quaternion from rotation
/// matrix, J. Guidance and Control 1 (1978) 223-224. The largest of the four is found first and
/// never divides by less than 1/2, so no orientation is special.
/// @param body_to_world a proper rotation [-]; off by d, it moves the result by the order of d. A
///   reflection is none and gives the parameters of no particular turn.
/// @return of unit length, with e0 >= 0; half a turn, where p and -p both have e0 = 0, gives the
///   one whose largest component is positive [-]. NaN gives NaN.
template <Real T>
[[nodiscard]] Vector4<T> euler_parameters_from_rotation_matrix(const Matrix3<T>& body_to_world) {
  const Matrix3<T>& a = body_to_world;
  const T trace = a(0, 0) + a(1, 1) + a(2, 2);
  Eigen::Index largest = -1;  // of e1, e2, e3 by index 0, 1, 2; -1 is e0
  T greatest = trace;
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (greatest < a(i, i)) {
      greatest = a(i, i);
      largest = i;
    }
  }
  // Four times the largest parameter times p.
  Vector4<T> p;
  switch (largest) {
    case -1:
      p << T(1) + trace, a(2, 1) - a(1, 2), a(0, 2) - a(2, 0), a(1, 0) - a(0, 1);
      break;
    case 0:
      p << a(2, 1) - a(1, 2), T(1) + (a(0, 0) - a(1, 1) - a(2, 2)), a(0, 1) + a(1, 0),
          a(2, 0) + a(0, 2);
      break;
    case 1:
      p << a(0, 2) - a(2, 0), a(0, 1) + a(1, 0), T(1) + (a(1, 1) - a(0, 0) - a(2, 2)),
          a(1, 2) + a(2, 1);
      break;
    default:
      p << a(1, 0) - a(0, 1), a(2, 0) + a(0, 2), a(1, 2) + a(2, 1),
          T(1) + (a(2, 2) - a(0, 0) - a(1, 1));
  }
  return unit_euler_parameters(p(0) < T(0) ? Vector4<T>(-p) : p);
}

}  // namespace wheelrail
