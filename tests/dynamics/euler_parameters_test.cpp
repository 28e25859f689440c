#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <random>
#include <wheelrail/dynamics/euler_parameters.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

using V3 = Vector3<double>;
using V4 = Vector4<double>;
using M3 = Matrix3<double>;

class Random {
 public:
  double operator()() { return uniform_(engine_); }
  V3 vector() { return V3((*this)(), (*this)(), (*this)()); }
  V4 orientation() { return V4((*this)(), (*this)(), (*this)(), (*this)()); }

 private:
  std::mt19937_64 engine_{20240611};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

// The reflection in the x-z plane.
V4 mirror(const V4& p) {
  return V4(p(0), -p(1), p(2), -p(3));
}
V3 mirror_axial(const V3& w) {
  return V3(-w.x(), w.y(), -w.z());
}
M3 mirror(const M3& a) {
  const M3 s = V3(1, -1, 1).asDiagonal();
  return s * a * s;
}

M3 tilde(const V3& v) {
  M3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace

TEST_CASE("rotation_matrix: quarter turns carry body axes to world axes by the right hand",
          "[dynamics][euler_parameters][reference]") {
  const double quarter = pi<double>() / 2;
  const V3 x = V3::UnitX(), y = V3::UnitY(), z = V3::UnitZ();
  const auto turned = [&](const V3& axis, const V3& v) -> V3 {
    return rotation_matrix(euler_parameters_from_axis_angle(V3(3 * axis), quarter)) * v;
  };
  CHECK((turned(x, y) - z).norm() < 1e-15);
  CHECK((turned(y, z) - x).norm() < 1e-15);
  CHECK((turned(z, x) - y).norm() < 1e-15);
  CHECK(rotation_matrix(identity_euler_parameters<double>()) == M3::Identity());
}

TEST_CASE("rotation_matrix: a rotation for any length of p, the one of an independent quaternion",
          "[dynamics][euler_parameters][random]") {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const V4 p = random.orientation() * std::pow(10.0, 3 * random());
    const M3 a = rotation_matrix(p);
    CHECK((a.transpose() * a - M3::Identity()).cwiseAbs().maxCoeff() < 2e-15);
    CHECK(a.determinant() == Approx(1.0).epsilon(1e-14));
    const Eigen::Matrix3d other = Eigen::Quaterniond(p(0), p(1), p(2), p(3)).normalized().matrix();
    CHECK((a - other).cwiseAbs().maxCoeff() < 2e-15);
    CHECK((rotation_matrix(V4(-p)) - a).cwiseAbs().maxCoeff() == 0.0);
    CHECK((rotation_matrix(unit_euler_parameters(p)) - a).cwiseAbs().maxCoeff() < 2e-15);
    CHECK(unit_euler_parameters(p).norm() == Approx(1.0).epsilon(1e-15));
  }
}

TEST_CASE("euler_product: turns compose from right to left and come back",
          "[dynamics][euler_parameters][random]") {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const V4 p = random.orientation(), q = random.orientation();
    const M3 both = rotation_matrix(euler_product(p, q));
    CHECK((both - rotation_matrix(p) * rotation_matrix(q)).cwiseAbs().maxCoeff() < 4e-15);
    CHECK(euler_product(p, q).norm() == Approx(p.norm() * q.norm()).epsilon(1e-14));
    const V4 back = euler_product(p, euler_conjugate(p));
    CHECK((back - V4(p.squaredNorm(), 0, 0, 0)).norm() < 1e-15);
  }
}

TEST_CASE("euler_parameter_rate: the rotation matrix turns at the angular velocity",
          "[dynamics][euler_parameters][random]") {
  using T = long double;
  Random random;
  for (int i = 0; i < 200; ++i) {
    const Vector4<T> p = random.orientation().cast<T>();
    const Vector3<T> w = random.vector().cast<T>();
    const Vector4<T> rate = euler_parameter_rate(p, w);
    // dA/dt by central differences, against A tilde(w).
    const T h = T(1e-5);
    const Matrix3<T> change =
        (rotation_matrix(Vector4<T>(p + h * rate)) - rotation_matrix(Vector4<T>(p - h * rate))) /
        (2 * h);
    const Matrix3<T> a = rotation_matrix(p);
    const Matrix3<T> expected = a * tilde(w.cast<double>()).cast<T>();
    CHECK((change - expected).cwiseAbs().maxCoeff() < 1e-7L);
    CHECK(std::fabs(p.dot(rate)) < 1e-18L);  // the length stays
    const Vector3<T> w_world = a * w;
    CHECK((euler_parameter_rate_from_world(p, w_world) - rate).norm() < 1e-18L);
    // A change of length is no turn.
    const Vector4<T> with_length = rate + T(0.3) * p;
    CHECK((angular_velocity_body(p, with_length) - w).norm() < 1e-17L);
  }
}

TEST_CASE("euler_parameters_from_rotation_matrix: every branch gives the matrix back",
          "[dynamics][euler_parameters][random]") {
  Random random;
  std::array<int, 4> largest_counts{};
  for (int i = 0; i < 4000; ++i) {
    // Every other case is close to half a turn about an axis, where e0 vanishes.
    V4 p = random.orientation();
    if (i % 2 == 0) p(0) *= 1e-9;
    p = unit_euler_parameters(p(0) < 0 ? V4(-p) : p);
    Eigen::Index largest = 0;
    p.cwiseAbs().maxCoeff(&largest);
    ++largest_counts[static_cast<std::size_t>(largest)];
    const V4 found = euler_parameters_from_rotation_matrix(rotation_matrix(p));
    CHECK((found - p).norm() < 2e-15);
  }
  for (const int count : largest_counts) CHECK(count > 300);

  for (int axis = 0; axis < 3; ++axis) {  // exact half turns: e0 = 0
    V4 p = V4::Zero();
    p(axis + 1) = 1;
    CHECK(euler_parameters_from_rotation_matrix(rotation_matrix(p)) == p);
  }
  CHECK(euler_parameters_from_rotation_matrix(M3(M3::Identity())) == V4(1, 0, 0, 0));
}

TEST_CASE("euler_parameters_from_rotation_matrix: a matrix off by d moves the result by d",
          "[dynamics][euler_parameters]") {
  const V4 p = unit_euler_parameters(V4(0.3, -0.7, 0.2, 0.5));
  for (const double off : {1e-3, 1e-6, 1e-9}) {
    const M3 a = rotation_matrix(p) + off * M3(M3::Ones());
    const V4 found = euler_parameters_from_rotation_matrix(a);
    CHECK(found.norm() == Approx(1.0).epsilon(1e-15));
    CHECK(std::min((found - p).norm(), (found + p).norm()) < 3 * off);
  }
}

TEST_CASE("euler_parameters_from_axis_angle: half the angle about the axis; no axis, no turn",
          "[dynamics][euler_parameters]") {
  const V4 p = euler_parameters_from_axis_angle(V3(0, 0, -2), pi<double>() / 3);
  CHECK((p - V4(std::sqrt(0.75), 0, 0, -0.5)).norm() < 1e-15);
  CHECK_FALSE(is_finite(euler_parameters_from_axis_angle(V3(0, 0, 0), 1.0)(1)));
  CHECK_FALSE(is_finite(unit_euler_parameters(V4(0, 0, 0, 0))(0)));
}

TEST_CASE("euler parameters: reflected input gives reflected output bit for bit",
          "[dynamics][euler_parameters][symmetry][random]") {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const V4 p = random.orientation(), q = random.orientation();
    const V3 w = random.vector();
    const double angle = 4 * random();
    CHECK(rotation_matrix(mirror(p)) == mirror(rotation_matrix(p)));
    CHECK(euler_product(mirror(p), mirror(q)) == mirror(euler_product(p, q)));
    CHECK(euler_parameter_rate(mirror(p), mirror_axial(w)) == mirror(euler_parameter_rate(p, w)));
    CHECK(euler_parameter_rate_from_world(mirror(p), mirror_axial(w)) ==
          mirror(euler_parameter_rate_from_world(p, w)));
    CHECK(angular_velocity_body(mirror(p), mirror(q)) == mirror_axial(angular_velocity_body(p, q)));
    CHECK(euler_parameters_from_axis_angle(mirror_axial(w), angle) ==
          mirror(euler_parameters_from_axis_angle(w, angle)));
    const M3 a = rotation_matrix(p);
    CHECK(euler_parameters_from_rotation_matrix(mirror(a)) ==
          mirror(euler_parameters_from_rotation_matrix(a)));
  }
}
