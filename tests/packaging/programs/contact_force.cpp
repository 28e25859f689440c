// The force law alone, for the contact of someone else's search.
#include <cmath>
#include <cstdio>
#include <wheelrail/force/contact_force.hpp>

int main() {
  using namespace wheelrail;
  ContactForceOptions<double> options;
  options.normal.restitution_force_ratio = 1;
  const ContactForceModel<double> steel_on_steel(options);

  ContactKinematics<double> contact;
  contact.penetration = 0.067355e-3;
  contact.curvatures = hertz_curvatures(1 / 0.43, 0.0, 0.0, 1 / 0.3);
  contact.longitudinal_velocity = 0.01;
  contact.forward_speed = contact.speed = 10;

  const ContactForce<double> force = steel_on_steel(contact);
  std::printf("%.1f kN, creep %.0f N\n", 1e-3 * force.normal, force.creep.longitudinal);
  return std::abs(force.normal - 50e3) < 1 && force.creep.longitudinal < 0 ? 0 : 1;
}
