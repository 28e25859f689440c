#include <cstdio>
#include <wheelrail/wheelrail.hpp>

int main() {
  using namespace wheelrail;
  const Wheelset wheelset(s1002<double>(), 0.43, 1.5);  // nominal radius, profile spacing [m]
  const TangentTrack track(uic50<double>());            // gauge 1.435 m, inclination 1/20
  const ContactForceModel<double> steel_on_steel;

  // Lateral shift and height of the axle's centre [m], roll and yaw [rad]; rolling at 10 m/s.
  const auto at = WheelsetPosition<double>::of(0.002, 0.42971, 2.5e-5, 0.0);
  const WheelsetMotion<double> motion{{10, 0, 0}, {0, 10 / 0.43, 0}};
  const auto forces = wheelset_forces(wheelset, track, at, motion, steel_on_steel);

  for (const Side side : sides)
    for (const auto& contact : forces.wheel(side).patches)
      std::printf("%s wheel, %.1f mm from the tread circle: %.3f mm deep, %.1f kN\n", name_of(side),
                  1e3 * contact.patch.wheel_lateral, 1e3 * contact.patch.penetration,
                  1e-3 * contact.contact.normal);
  std::printf("on the wheelset: %.0f N to the left, %.0f N upwards\n", forces.force_track.y(),
              forces.force_track.z());
}
