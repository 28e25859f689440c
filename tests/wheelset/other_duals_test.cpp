// Other dual numbers than the library's own as scalars: the same derivatives. Compiled without
// optimisation, since theirs takes long.

#include <Eigen/Core>
#include <array>
#include <type_traits>
#include <unsupported/Eigen/AutoDiff>
#include <wheelrail/wheelrail.hpp>
#if __has_include(<ceres/jet.h>)
#include <ceres/jet.h>
#endif

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

constexpr int count = 10;  // position and motion

template <class T>
struct Variable;

template <>
struct Variable<Dual<double, count>> {
  static Dual<double, count> make(double x, int i) { return {x, static_cast<std::size_t>(i)}; }
  static double slope(const Dual<double, count>& x, int i) {
    return x.derivatives[static_cast<std::size_t>(i)];
  }
};
template <>
struct Variable<Eigen::AutoDiffScalar<Eigen::Matrix<double, count, 1>>> {
  using T = Eigen::AutoDiffScalar<Eigen::Matrix<double, count, 1>>;
  static T make(double x, int i) { return T(x, count, i); }
  static double slope(const T& x, int i) { return x.derivatives()(i); }
};
#if __has_include(<ceres/jet.h>)
template <>
struct Variable<ceres::Jet<double, count>> {
  static ceres::Jet<double, count> make(double x, int i) { return {x, i}; }
  static double slope(const ceres::Jet<double, count>& x, int i) { return x.v(i); }
};
#endif

// A flange on its rail, and the wheel opposite on its tread.
template <class T>
WheelsetForces<T> forces() {
  constexpr std::array<double, count> values{0.0062, 0.4299, 3e-4, 0.012, 10,
                                             0.02,   0.001,  0.01, 23.3,  0.02};
  std::array<T, count> q;
  for (int i = 0; i < count; ++i) {
    q[static_cast<std::size_t>(i)] = Variable<T>::make(values[static_cast<std::size_t>(i)], i);
  }
  const Wheelset wheelset(s1002<T>(), T(0.43), T(1.5));
  const TangentTrack track(uic50<T>());
  const ContactForceModel<T> steel;
  return wheelset_forces(wheelset, track, WheelsetPosition<T>::of(q[0], q[1], q[2], q[3]),
                         WheelsetMotion<T>{{q[4], q[5], q[6]}, {q[7], q[8], q[9]}}, steel);
}

template <class T>
void check_against_own() {
  using Own = Dual<double, count>;
  const auto own = forces<Own>();
  const auto other = forces<T>();
  const auto same = [](const Own& a, const T& b) {
    CHECK(value_of(b) == Approx(a.value).epsilon(1e-10).margin(1e-12));
    double size = 0;
    for (const double by : a.derivatives) size = std::max(size, std::abs(by));
    for (int i = 0; i < count; ++i) {
      CHECK(std::abs(Variable<T>::slope(b, i) - Variable<Own>::slope(a, i)) <= 1e-10 * size);
    }
  };
  for (int i = 0; i < 3; ++i) {
    same(own.force_track(i), other.force_track(i));
    same(own.moment_track(i), other.moment_track(i));
  }
  for (const Side side : sides) {
    REQUIRE(own.wheel(side).patches.size() > 0);
    REQUIRE(own.wheel(side).patches.size() == other.wheel(side).patches.size());
    for (std::size_t i = 0; i < own.wheel(side).patches.size(); ++i) {
      const auto& a = own.wheel(side).patches[i].patch;
      const auto& b = other.wheel(side).patches[i].patch;
      same(a.wheel_lateral, b.wheel_lateral);
      same(a.penetration, b.penetration);
      same(a.contact_angle, b.contact_angle);
      same(a.zone_lower, b.zone_lower);
    }
  }
}

}  // namespace

TEST_CASE("wheelset_forces: Eigen's AutoDiffScalar has the derivatives of Dual",
          "[wheelset][autodiff]") {
  check_against_own<Eigen::AutoDiffScalar<Eigen::Matrix<double, count, 1>>>();
}

#if __has_include(<ceres/jet.h>)
TEST_CASE("wheelset_forces: ceres::Jet has the derivatives of Dual", "[wheelset][autodiff]") {
  check_against_own<ceres::Jet<double, count>>();
}
#endif
