// A wheelset's wrench and its exact derivatives by the twelve numbers of its position and motion.
#include <cmath>
#include <cstdio>
#include <wheelrail/wheelrail.hpp>

int main() {
  using namespace wheelrail;
  using Number = Dual<double, 12>;
  const Wheelset wheelset(s1002<Number>(), Number(0.43), Number(1.5));
  const TangentTrack track(uic50<Number>());
  const ContactForceModel<Number> steel_on_steel;

  const double values[12] = {0, 0.002, 0.42971, 2.5e-5, 0, 0, 10, 0, 0, 0, 10 / 0.43, 0};
  Number q[12];
  for (unsigned i = 0; i < 12; ++i) q[i] = Number(values[i], i);
  auto at = WheelsetPosition<Number>::of(q[1], q[2], q[3], q[4]);
  at.position_track.x() = q[0];
  const WheelsetMotion<Number> motion{{q[6], q[7], q[8]}, {q[9], q[10], q[11]}};
  const auto forces = wheelset_forces(wheelset, track, at, motion, steel_on_steel);

  const Number& lateral = forces.force_track.y();
  std::printf("%.0f N to the left, %.3g N/m by its lateral shift, %.3g N s/m by its velocity\n",
              lateral.value, lateral.derivatives[1], lateral.derivatives[7]);
  return std::abs(lateral.value + 50) < 1 && lateral.derivatives[7] < 0 ? 0 : 1;
}
