#pragma once
/// @file
/// The small fixed-size vectors of the library: Eigen's, unaligned so that structs that hold them
/// can live anywhere. A variable of these types carries its frame in its name.
/// May include: core, Eigen, std.

#include <Eigen/Core>
#include <wheelrail/core/scalar.hpp>

namespace wheelrail {

/// A column of two.
template <Real T>
using Vector2 = Eigen::Matrix<T, 2, 1, Eigen::DontAlign>;

/// A column of three.
template <Real T>
using Vector3 = Eigen::Matrix<T, 3, 1, Eigen::DontAlign>;

/// A column of four; Euler parameters store the scalar part first.
template <Real T>
using Vector4 = Eigen::Matrix<T, 4, 1, Eigen::DontAlign>;

/// Three by three; a frame's axes are its columns.
template <Real T>
using Matrix3 = Eigen::Matrix<T, 3, 3, Eigen::DontAlign>;

/// a x b, written out so that any scalar works and the order of operations is fixed.
template <Real T>
[[nodiscard]] inline Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return Vector3<T>(a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
                    a.x() * b.y() - a.y() * b.x());
}

/// a . b, in this order of operations for any scalar.
template <Real T>
[[nodiscard]] inline T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

}  // namespace wheelrail
