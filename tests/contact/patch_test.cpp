#include <string>
#include <wheelrail/contact/find_contact.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

TEST_CASE("Patch: axes are orthonormal and the zone holds the deepest strip", "[contact]") {
  const Wheel wheel(s1002<double>(), 0.43);
  const Rail rail(uic50<double>());
  int patches = 0;
  for (const Side side : sides) {
    for (int i = 0; i < 200; ++i) {
      WheelPlacement<double> placement;
      placement.side = side;
      const double yaw = 0.03 * std::sin(1.7 * i), roll = -0.05 + 0.005 * std::sin(0.9 * i);
      placement.position_rail = Vector3<double>(0, 0.02 + 0.01 * std::sin(i), 0.4295);
      placement.sin_yaw = std::sin(yaw);
      placement.cos_yaw = std::cos(yaw);
      placement.tan_yaw = placement.sin_yaw / placement.cos_yaw;
      placement.sin_roll = std::sin(roll);
      placement.cos_roll = std::cos(roll);
      placement.inclination = 0.05;
      const auto result = find_contact(wheel, rail, placement);
      for (const auto& patch : result.patches) {
        ++patches;
        CHECK(patch.zone_lower <= patch.wheel_lateral);
        CHECK(patch.wheel_lateral <= patch.zone_upper);
        CHECK(patch.penetration > 0);
        CHECK(std::abs(patch.normal_rail.norm() - 1) < 1e-14);
        CHECK(std::abs(patch.longitudinal_rail.norm() - 1) < 1e-14);
        CHECK(std::abs(patch.normal_rail.dot(patch.longitudinal_rail)) < 1e-14);
        const auto at = wheel.profile().evaluate(patch.wheel_lateral);
        CHECK(patch.rolling_radius == 0.43 + at.value);
        // From the wheel's point, the penetration leads along the normal to the rail's surface.
        if (rail.profile().lower() < patch.rail_lateral &&
            patch.rail_lateral < rail.profile().upper()) {
          const auto on_rail = rail.profile().evaluate(patch.rail_lateral);
          const Vector3<double> foot = patch.position_rail + patch.penetration * patch.normal_rail;
          CHECK(std::abs(foot.y() - patch.rail_lateral) < 1e-13);
          CHECK(std::abs(foot.z() - on_rail.value) < 1e-13);
          CHECK((Rail<RailHead<double>>::normal_rail(on_rail) - patch.normal_rail).norm() < 1e-9);
          CHECK(patch.rail_lateral_curvature == Approx(curvature(on_rail)).epsilon(1e-12));
        }
        const double forwards =
            outboard_sign<double>(side) * (patch.position_rail.x() - placement.position_rail.x());
        CHECK(std::abs(patch.longitudinal - forwards) < 1e-15);
      }
    }
  }
  CHECK(patches > 200);
}

TEST_CASE("name_of: every search status has its name", "[contact]") {
  CHECK(std::string(name_of(SearchStatus::complete)) == "complete");
  CHECK(std::string(name_of(SearchStatus::not_converged)) == "not_converged");
  CHECK(std::string(name_of(SearchStatus::too_many_patches)) == "too_many_patches");
  CHECK(std::string(name_of(SearchStatus::not_finite)) == "not_finite");
}

TEST_CASE("ContactResult: a fresh one is empty and complete", "[contact]") {
  const ContactResult<double> result;
  CHECK(result.patches.empty());
  CHECK(result.status == SearchStatus::complete);
  CHECK(result.evaluations == 0);
}
