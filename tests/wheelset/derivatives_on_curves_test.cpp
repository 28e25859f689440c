// Derivatives where derivatives_test.cpp does not go: on a curved track, whose rails are looked for by
// Newton's method, and through blended patches. Against differences in double.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <wheelrail/wheelrail.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

using Number = Dual<double, 4>;  // by x, y, z [m] and yaw [rad]
using Pose = std::array<double, 4>;

// The wrench [N, N m] of a pose, from a function that has it in any scalar.
template <class Wrench>
void check_slopes(const Pose& pose, const Wrench& wrench) {
  std::array<Number, 4> q;
  for (std::size_t i = 0; i < 4; ++i) q[i] = Number(pose[i], i);
  const std::array<Number, 6> dual = wrench(q);
  for (std::size_t k = 0; k < 4; ++k) {
    const double step = 1e-7;
    const auto at = [&](double by) {
      Pose moved = pose;
      moved[k] += by;
      return wrench(moved);
    };
    const auto a = at(step), b = at(-step), c = at(2 * step), d = at(-2 * step);
    for (std::size_t i = 0; i < 6; ++i) {
      const double slope = (8 * (a[i] - b[i]) - (c[i] - d[i])) / (12 * step);
      double size = 0;
      for (const double by : dual[i].derivatives) size = std::max(size, std::abs(by));
      INFO("number " << i << " by " << k << ": difference " << slope << ", dual "
                     << dual[i].derivatives[k]);
      CHECK(std::abs(dual[i].derivatives[k] - slope) <= 1e-6 * size);
    }
  }
}

template <class T>
std::array<T, 6> numbers(const WheelsetForces<T>& forces) {
  std::array<T, 6> all;
  for (std::size_t i = 0; i < 3; ++i) {
    all[i] = forces.force_track(static_cast<Eigen::Index>(i));
    all[i + 3] = forces.moment_track(static_cast<Eigen::Index>(i));
  }
  return all;
}

template <class T>
NodalTrack<RailHead<T>> curve() {
  using Segment = TrackSegment<T>;
  return NodalTrack<RailHead<T>>(uic50<T>(),
                                 CentreLine<T>({Segment::tangent(T(20)), Segment::clothoid(T(40)),
                                                Segment::arc(T(40), T(300), Side::left, T(0.1))}));
}

}  // namespace

TEST_CASE("wheelset_forces: on a transition, dual numbers have the derivatives of differences",
          "[wheelset][track][autodiff]") {
  const auto wrench = [](const auto& q) {
    using T = typename std::decay_t<decltype(q)>::value_type;
    const NodalTrack<RailHead<T>> track = curve<T>();
    const Wheelset wheelset(s1002<T>(), T(0.43), T(1.5));
    const ContactForceModel<T> steel;
    WheelsetPosition<T> at = WheelsetPosition<T>::of(q[1], q[2], T(0.02), q[3]);
    at.position_track.x() = q[0];
    at.arc_length = T(40);
    return numbers(wheelset_forces(
        wheelset, track, at, WheelsetMotion<T>{{T(10), T(0), T(0)}, {T(0), T(23.3), T(0)}}, steel));
  };
  // Where both wheels stand on the rails, found from the frame at 41 m.
  const auto track = curve<double>();
  const auto left = track.frame(Side::left, 41.0), right = track.frame(Side::right, 41.0);
  const Vector3<double> middle = (left.origin_track + right.origin_track) / 2;
  const Pose pose{middle.x(), middle.y() + 0.002, middle.z() + 0.4296, 0.034};
  const auto forces = wrench(pose);
  REQUIRE(forces[2] > 1e4);
  check_slopes(pose, wrench);
}

TEST_CASE(
    "wheelset_forces: through blended patches, dual numbers have the derivatives of differences",
    "[wheelset][contact][autodiff]") {
  std::size_t most = 0;
  const auto wrench = [&](const auto& q) {
    using T = typename std::decay_t<decltype(q)>::value_type;
    const TangentTrack track(uic50<T>());
    const Wheelset wheelset(s1002<T>(), T(0.43), T(1.5));
    const ContactForceModel<T> steel(without_kinks<T>());
    WheelsetPosition<T> at = WheelsetPosition<T>::of(q[1], q[2], T(0), q[3]);
    at.position_track.x() = q[0];
    const auto forces = wheelset_forces(
        wheelset, track, at, WheelsetMotion<T>{{T(10), T(0), T(0)}, {T(0), T(23.3), T(0)}}, steel,
        StripSearch<T>{{.blending_length = 0.003}});
    for (const auto& wheel : forces.wheels) {
      for (const auto& p : wheel.patches) most += p.patch.share < T(1) ? 1U : 0U;
    }
    return numbers(forces);
  };
  // In the sweep of contact_patch_blending_test, where tread and flange are one zone.
  for (const double shift : {0.00555, 0.0056, 0.00565})
    check_slopes({0, shift, 0.4297, 0.001}, wrench);
  CHECK(most > 0);
}
