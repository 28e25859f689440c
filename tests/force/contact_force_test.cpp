#include <wheelrail/force/contact_force.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

// A wheel of 0.43 m on a rail of 0.3 m, 50 kN: hertz.md's worked value, approach 0.067355 mm.
ContactKinematics<double> worked_contact() {
  ContactKinematics<double> contact;
  contact.penetration = 0.067355e-3;
  contact.curvatures = hertz_curvatures(1 / 0.43, 0.0, 0.0, 1 / 0.3);
  contact.forward_speed = contact.speed = 10;
  return contact;
}

}  // namespace

// Hertz, E 206 GPa, nu 0.296 (exact elliptic integrals): 50 kN, a 5.540231 mm, b 4.358716 mm.
TEST_CASE("ContactForceModel: the chain gives Hertz's force and ellipse", "[force][reference]") {
  ContactForceOptions<double> options;
  options.normal.restitution_force_ratio = 1;
  const auto force = ContactForceModel<double>(options)(worked_contact());
  CHECK(force.normal == Approx(50e3).epsilon(2e-5));
  CHECK(force.ellipse.a == Approx(5.540231e-3).epsilon(1e-5));
  CHECK(force.ellipse.b == Approx(4.358716e-3).epsilon(1e-5));
  CHECK(force.stiffness == Approx(9.0451597e10).epsilon(1e-7));
  CHECK(force.creep.longitudinal == 0.0);
  CHECK(force.creep.lateral == 0.0);
}

TEST_CASE("ContactForceModel: velocities reach the law that they belong to", "[force]") {
  ContactForceOptions<double> options;
  const ContactForceModel<double> model(options);
  auto contact = worked_contact();
  const double at_rest = model(contact).normal;
  contact.normal_velocity = -0.2;  // closing
  const double closing = model(contact).normal;
  contact.normal_velocity = 0.2;
  CHECK(model(contact).normal / closing == Approx(0.75).epsilon(1e-12));
  CHECK(at_rest / closing == Approx(0.875).epsilon(1e-12));
  contact.normal_velocity = 0;
  contact.longitudinal_velocity = 0.01;
  CHECK(model(contact).creep.longitudinal < 0);
  CHECK(model(contact).creep.lateral == 0.0);
  CHECK(model(contact).creepage.longitudinal == Approx(0.001).epsilon(1e-5));
  contact.longitudinal_velocity = 0;
  contact.lateral_velocity = 0.01;
  CHECK(model(contact).creep.lateral < 0);
  contact.lateral_velocity = 0;
  contact.spin_velocity = 0.5;
  CHECK(model(contact).creep.lateral < 0);
  CHECK(model(contact).creepage.spin == Approx(0.05).epsilon(1e-5));
}

TEST_CASE("ContactForceModel: a constant stiffness replaces Hertz's", "[force]") {
  ContactForceOptions<double> options;
  options.constant_stiffness = 1e10;
  options.normal.restitution_force_ratio = 1;
  const auto force = ContactForceModel<double>(options)(worked_contact());
  CHECK(force.normal == Approx(1e10 * std::pow(0.067355e-3, 1.5)).epsilon(1e-13));
}

TEST_CASE("ContactForceModel: no friction, no creep force; no penetration, no force", "[force]") {
  ContactForceOptions<double> options;
  options.friction_coefficient = 0;
  auto contact = worked_contact();
  contact.lateral_velocity = 1;
  CHECK(ContactForceModel<double>(options)(contact).creep.lateral == 0.0);
  contact.penetration = -1e-3;
  const auto none = ContactForceModel<double>()(contact);
  CHECK(none.normal == 0.0);
  CHECK(none.creep.lateral == 0.0);
}

TEST_CASE("ContactForceModel: without_kinks() sets what rounds the kinks off, and no more",
          "[force]") {
  ContactForceOptions<double> options;
  options.hertz.minimum_lateral_curvature = 0.5;
  options.friction_coefficient = 0.3;
  const auto smooth = without_kinks(options);
  CHECK(smooth.hertz.bound_width == 0.5);
  CHECK(smooth.creepage_rounding == 1e-4);
  CHECK(smooth.friction_coefficient == 0.3);
  // It reaches the law: lateral creepage and no spin is where (86) has a kink.
  auto contact = worked_contact();
  contact.forward_speed = contact.speed = 10;
  contact.lateral_velocity = 1e-3;
  const double sharp = ContactForceModel<double>(options)(contact).creep.lateral;
  const double round = ContactForceModel<double>(smooth)(contact).creep.lateral;
  CHECK(sharp != round);
  CHECK(round == Approx(sharp).epsilon(0.02));
}

TEST_CASE("ContactForceModel: options out of range are named", "[force][bad-input]") {
  using Catch::Matchers::ContainsSubstring;
  const auto with = [](auto change) {
    ContactForceOptions<double> options;
    change(options);
    return ContactForceModel<double>(options);
  };
  CHECK_THROWS_WITH(with([](auto& o) { o.friction_coefficient = -0.1; }),
                    ContainsSubstring("friction coefficient is -0.1"));
  CHECK_THROWS_WITH(with([](auto& o) { o.normal.restitution_force_ratio = 1.5; }),
                    ContainsSubstring("restitution") && ContainsSubstring("1.5"));
  CHECK_THROWS_WITH(with([](auto& o) { o.constant_stiffness = -1; }),
                    ContainsSubstring("constant stiffness is -1"));
  CHECK_THROWS_WITH(with([](auto& o) { o.creepage_rounding = -1e-5; }),
                    ContainsSubstring("creepage rounding is -1e-05"));
  CHECK_THROWS_WITH(with([](auto& o) { o.hertz.bound_width = -1; }),
                    ContainsSubstring("bound width is -1"));
  CHECK_THROWS_WITH(with([](auto& o) { o.hertz.minimum_lateral_curvature = 0; }),
                    ContainsSubstring("minimum lateral curvature is 0"));
  CHECK_THROWS_WITH(with([](auto& o) { o.wheel.young_modulus = -1; }), ContainsSubstring("Young"));
}
