#include <limits>
#include <string>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/surface/wheel.hpp>

#include "support/catch.hpp"
#include "support/numeric_difference.hpp"

using namespace wheelrail;
using wheelrail_test::central_difference;

namespace {

using Wheel1002 = Wheel<PiecewiseProfile<double>>;

Vector3<double> point_of(const Wheel1002& wheel, double lateral, double angle) {
  return wheel.position_wheel(lateral, wheel.profile().evaluate(lateral),
                              WheelAngle<double>::of(angle));
}

// The derivative of the surface point by one parameter, by differences.
Vector3<double> derivative(const Wheel1002& wheel, double lateral, double angle, bool by_angle) {
  Vector3<double> d;
  for (int i = 0; i < 3; ++i) {
    d(i) = by_angle ? central_difference([&](double x) { return point_of(wheel, lateral, x)(i); },
                                         angle, 1e-3)
                    : central_difference([&](double x) { return point_of(wheel, x, angle)(i); },
                                         lateral, 5e-5);
  }
  return d;
}

std::string message_of(const PiecewiseProfile<double>& profile, double radius) {
  try {
    const Wheel wheel(profile, radius);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("Wheel: tangents and normal are those of differences of its points",
          "[surface][reference]") {
  const Wheel1002 wheel(s1002<double>(), 0.43);
  // One lateral position in each section, H to A [m].
  for (const double u : {-0.066, -0.055, -0.045, -0.039, -0.037, -0.03, 0.0, 0.02, 0.05}) {
    for (const double angle : {-0.3, 0.0, 0.1, 1.0}) {
      CAPTURE(u, angle);
      const auto at = wheel.profile().evaluate(u);
      const auto turned = WheelAngle<double>::of(angle);
      const Vector3<double> by_u = derivative(wheel, u, angle, false);
      const Vector3<double> by_angle = derivative(wheel, u, angle, true);
      const auto t_u = wheel.lateral_tangent_wheel(at, turned);
      const auto t_s = wheel.longitudinal_tangent_wheel(turned);
      const auto n = wheel.normal_wheel(at, turned);
      CHECK((by_u / by_u.norm() - t_u).norm() < 1e-7);
      // The angle grows right-handed about y: below the axle, the point moves backwards.
      CHECK((by_angle / by_angle.norm() + t_s).norm() < 1e-8);
      CHECK(std::abs(n.dot(t_u)) + std::abs(n.dot(t_s)) + std::abs(t_u.dot(t_s)) < 1e-15);
      CHECK(std::abs(n.norm() - 1) < 1e-15);
      // Outwards: away from the axle.
      const Vector3<double> p = point_of(wheel, u, angle);
      CHECK(n.x() * p.x() + n.z() * p.z() > 0);
      CHECK(std::hypot(p.x(), p.z()) == Approx(wheel.radius(at)));
    }
  }
}

TEST_CASE("Wheel: principal curvatures are those of the fundamental forms",
          "[surface][reference]") {
  const Wheel1002 wheel(s1002<double>(), 0.43);
  for (const double u : {-0.066, -0.055, -0.045, -0.039, -0.037, -0.03, 0.0, 0.02, 0.05}) {
    CAPTURE(u);
    const double angle = 0.2;
    const Vector3<double> by_u = derivative(wheel, u, angle, false);
    const Vector3<double> by_angle = derivative(wheel, u, angle, true);
    Vector3<double> uu, ss, us;
    for (int i = 0; i < 3; ++i) {
      uu(i) = central_difference([&](double x) { return derivative(wheel, x, angle, false)(i); }, u,
                                 5e-5);
      ss(i) = central_difference([&](double x) { return derivative(wheel, u, x, true)(i); }, angle,
                                 1e-3);
      us(i) = central_difference([&](double x) { return derivative(wheel, u, x, false)(i); }, angle,
                                 1e-3);
    }
    Vector3<double> normal = cross(by_angle, by_u);
    normal /= normal.norm();
    if (normal.dot(point_of(wheel, 0.0, angle)) < 0) normal = -normal;
    const double lateral = -uu.dot(normal) / by_u.squaredNorm();
    const double longitudinal = -ss.dot(normal) / by_angle.squaredNorm();
    const auto at = wheel.profile().evaluate(u);
    CHECK(std::abs(us.dot(normal)) < 1e-6);
    CHECK(std::abs(wheel.lateral_curvature(at) - lateral) < 1e-3);
    CHECK(std::abs(wheel.longitudinal_curvature(at) - longitudinal) < 1e-6);
  }
}

TEST_CASE("Wheel: a sphere and a cone have their closed forms", "[surface][reference]") {
  // An arc about a point of the axle: F = -R0 + sqrt(R^2 - u^2).
  constexpr double nominal = 0.43, radius = 0.45;
  const PiecewiseProfile<double> arc(
      {ProfilePiece<double>::arc(-0.06, 0.06, 0.0, -nominal, radius, true)});
  const Wheel sphere(arc, nominal);
  for (const double u : {-0.05, 0.0, 0.03}) {
    const auto at = sphere.profile().evaluate(u);
    const auto angle = WheelAngle<double>::of(0.4);
    CHECK(sphere.lateral_curvature(at) == Approx(1 / radius).epsilon(1e-13));
    CHECK(sphere.longitudinal_curvature(at) == Approx(1 / radius).epsilon(1e-13));
    CHECK((sphere.position_wheel(u, at, angle) - radius * sphere.normal_wheel(at, angle)).norm() <
          1e-14);
  }
  const PiecewiseProfile<double> line({ProfilePiece<double>::line(-0.06, 0.06, 0.0, 0.0, -0.05)});
  const Wheel cone(line, nominal);
  const auto at = cone.profile().evaluate(0.02);
  CHECK(cone.lateral_curvature(at) == 0.0);
  // The normal reaches the axle after r / cos(slope angle).
  CHECK(cone.longitudinal_curvature(at) ==
        Approx(std::cos(std::atan(0.05)) / (nominal - 0.05 * 0.02)).epsilon(1e-14));
}

TEST_CASE("Wheel: bad radii are refused with their values", "[surface][bad-input]") {
  const auto profile = s1002<double>();
  using Catch::Matchers::ContainsSubstring;
  CHECK_THAT(message_of(profile, 0.0),
             ContainsSubstring("nominal radius is 0") && ContainsSubstring("> 0"));
  CHECK_THAT(message_of(profile, -0.43), ContainsSubstring("nominal radius is -0.43"));
  CHECK_THAT(message_of(profile, std::numeric_limits<double>::quiet_NaN()),
             ContainsSubstring("nan"));
  CHECK_THAT(message_of(profile, std::numeric_limits<double>::infinity()),
             ContainsSubstring("inf"));
  // The tread's end lies 2.6 mm inside the nominal radius.
  CHECK_THAT(message_of(profile, 0.002),
             ContainsSubstring("lateral 0.06 m") && ContainsSubstring("nominal radius 0.002 m"));
  CHECK(message_of(profile, 0.43).empty());
}
