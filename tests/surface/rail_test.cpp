#include <array>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/surface/rail.hpp>

#include "support/catch.hpp"
#include "support/numeric_difference.hpp"

using namespace wheelrail;

namespace {

RailFrame<double> frame_of(Side side, double lean) {
  const double s = outboard_sign<double>(side);
  RailFrame<double> frame;
  frame.side = side;
  frame.origin_track = Vector3<double>(3.0, s * 0.75, 0.1);
  frame.axes_track << s, 0, 0, 0, s * std::cos(lean), -s * std::sin(lean), 0, std::sin(lean),
      std::cos(lean);
  frame.inclination = lean;
  return frame;
}

}  // namespace

TEST_CASE("Rail: tangent, normal and curvature are those of differences of its points",
          "[surface][reference]") {
  const Rail rail(rail_60e1<double>());
  // One lateral position in each of the seven pieces [m].
  for (const double u : {-0.0362, -0.030, -0.02, 0.003, 0.02, 0.030, 0.0362}) {
    CAPTURE(u);
    const auto at = rail.profile().evaluate(u);
    const auto up = [&](double x) {
      return Rail<RailHead<double>>::position_rail(0, x, rail.profile().evaluate(x)).z();
    };
    const auto slope = [&](double x) { return wheelrail_test::central_difference(up, x, 1e-6); };
    const double tangent_length = std::hypot(1.0, slope(u));
    const auto tangent_rail = rail.lateral_tangent_rail(at);
    const auto normal_rail = rail.normal_rail(at);
    CHECK(std::abs(tangent_rail.y() - 1 / tangent_length) < 1e-8);
    CHECK(std::abs(tangent_rail.z() - slope(u) / tangent_length) < 1e-8);
    CHECK(tangent_rail.x() == 0.0);
    CHECK(std::abs(normal_rail.dot(tangent_rail)) < 1e-15);
    CHECK(std::abs(normal_rail.norm() - 1) < 1e-15);
    CHECK(normal_rail.z() > 0);
    // x along the rail, y tangent, z normal: right-handed.
    CHECK((cross(Vector3<double>(Vector3<double>::UnitX()), tangent_rail) - normal_rail).norm() <
          1e-15);
    // Curvature as the turning rate of the numeric tangent.
    const auto angle = [&](double x) { return std::atan(slope(x)); };
    const double turning = wheelrail_test::central_difference(angle, u, 2e-5) / tangent_length;
    const double expected = rail.lateral_curvature(at);
    CHECK(std::abs(-turning - expected) < 1e-4 * (1 + std::abs(expected)));
    CHECK(Rail<RailHead<double>>::position_rail(2.5, u, at) == Vector3<double>(2.5, u, at.value));
  }
  // Crown, shoulder, corner, side: 1/R.
  CHECK(rail.lateral_curvature(rail.profile().evaluate(0.0)) == Approx(1 / 0.3));
  CHECK(rail.lateral_curvature(rail.profile().evaluate(-0.02)) == Approx(1 / 0.08));
  CHECK(rail.lateral_curvature(rail.profile().evaluate(0.03)) == Approx(1 / 0.013));
  CHECK(rail.lateral_curvature(rail.profile().evaluate(0.0362)) == 0.0);
}

TEST_CASE("RailFrame: directions there and back again are the same", "[surface]") {
  for (const Side side : sides) {
    for (const double lean : {-0.1, 0.0, 0.05}) {
      const auto frame = frame_of(side, lean);
      const Vector3<double> d(0.3, -0.7, 1.1);
      CHECK((frame.direction_track(frame.direction_rail(d)) - d).norm() < 1e-15);
      CHECK((frame.direction_rail(frame.direction_track(d)) - d).norm() < 1e-15);
      CHECK((frame.direction_track(d) - frame.axes_track * d).norm() < 1e-15);
      CHECK((frame.direction_rail(d) - frame.axes_track.transpose() * d).norm() < 1e-15);
      CHECK((frame.position_track(d) - (frame.origin_track + frame.axes_track * d)).norm() < 1e-15);
    }
  }
}

TEST_CASE("Rail: knows whether its profile is convex, and the least curvature", "[surface]") {
  const Rail rail(rail_60e1<double>());
  CHECK(rail.is_convex());
  CHECK(rail.is_proved_convex());
  CHECK(rail.greatest_curvature(-0.001, 0.002) == Approx(1 / 0.3).epsilon(1e-12));
  CHECK(rail.greatest_curvature(0.002, -0.015) == Approx(1 / 0.08).epsilon(1e-12));
  CHECK(rail.greatest_curvature(-0.030, 0.002) == Approx(1 / 0.013).epsilon(1e-12));
  CHECK(rail.checksum() != Rail(uic50<double>()).checksum());
  CHECK(rail.checksum() == Rail(rail_60e1<double>()).checksum());
  CHECK(rail.least_curvature(-0.001, 0.002) == Approx(1 / 0.3).epsilon(1e-12));
  CHECK(rail.least_curvature(-0.02, -0.015) == Approx(1 / 0.08).epsilon(1e-12));
  CHECK(rail.least_curvature(-0.030, 0.002) == Approx(1 / 0.3).epsilon(1e-12));
  CHECK(rail.least_curvature(0.002, -0.030) == Approx(1 / 0.3).epsilon(1e-12));
  const auto both = rail.curvatures(0.002, -0.015);
  CHECK(both.least == rail.least_curvature(-0.015, 0.002));
  CHECK(both.greatest == rail.greatest_curvature(-0.015, 0.002));
  CHECK(rail.least_curvature(0.030, 0.0362) == Approx(0).margin(1e-12));
  CHECK_FALSE(Rail(s1002<double>()).is_convex());
  using Piece = ProfilePiece<double>;
  CHECK_FALSE(
      Rail(PiecewiseProfile<double>({Piece::line(-1, 0, 0, 0, -0.1), Piece::line(0, 1, 0, 0, 0.1)}))
          .is_convex());
  // A hollow in two pieces has no curvature that is not negative.
  const std::array<double, 3> hollow{0, 0, 0.5};
  const Rail concave(PiecewiseProfile<double>(
      {Piece::polynomial(-1, 0, 0, 1, hollow), Piece::polynomial(0, 1, 0, 1, hollow)}));
  CHECK(concave.greatest_curvature(-0.5, 0.5) < 0);
}
