// The paper's wheelset in DART: a free body to which wheelrail's wrench of the rails is applied
// before each step of the world.

#include <cmath>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/simulation/World.hpp>

#include "host_comparison.hpp"
#include "wheelset_contact.hpp"

namespace {

using dart::dynamics::BodyNode;
using dart::dynamics::FreeJoint;

// The world frame is the track frame; the body's origin is the middle of the axle and its y axis
// the axle, to the left. DART forgets external forces after a step: this belongs before each.
// Skeletons that are stepped in several threads need a WheelsetContact each.
void apply_rails(examples::WheelsetContact& contact, BodyNode& wheelset) {
  const Eigen::Isometry3d& pose = wheelset.getTransform();
  // Both velocities are expressed in the world frame, which is the default.
  const examples::ContactWrench wrench =
      contact.wrench({pose.translation(), pose.linear().col(1), wheelset.getLinearVelocity(),
                      wheelset.getAngularVelocity()});
  // At the body's origin, in the world frame: neither is what the body's own axes would say.
  const bool is_local = false;
  wheelset.addExtForce(wrench.force_track, Eigen::Vector3d::Zero(), is_local);
  wheelset.addExtTorque(wrench.moment_track, is_local);
}

std::vector<double> lateral_shifts(const examples::WheelsetBody& data, double interval, int count,
                                   double step) {
  const auto world = dart::simulation::World::create();
  world->setGravity(Eigen::Vector3d(0, 0, -data.gravity));
  world->setTimeStep(step);
  const auto skeleton = dart::dynamics::Skeleton::create("wheelset");
  const auto [joint, wheelset] = skeleton->createJointAndBodyNodePair<FreeJoint>();
  wheelset->setInertia(dart::dynamics::Inertia(data.mass, Eigen::Vector3d::Zero(),
                                               Eigen::Matrix3d(data.inertia.asDiagonal())));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = data.axes_track;
  pose.translation() = data.centre_track;
  joint->setTransform(pose);
  joint->setLinearVelocity(data.velocity_track);
  joint->setAngularVelocity(data.angular_velocity_track);
  world->addSkeleton(skeleton);

  // One for each wheelset, kept from step to step.
  examples::WheelsetContact contact;
  const int steps = static_cast<int>(std::lround(interval / step));
  std::vector<double> shifts{data.centre_track.y()};
  for (int i = 1; i <= count; ++i) {
    for (int k = 0; k < steps; ++k) {
      apply_rails(contact, *wheelset);
      world->step();
    }
    shifts.push_back(wheelset->getTransform().translation().y());
  }
  return shifts;
}

}  // namespace

int main(int argc, char** argv) {
  examples::Host dart;
  dart.name = "DART";
  dart.summary =
      "Runs the paper's wheelset on a tangent track in DART, whose semi-implicit Euler steps are\n"
      "of first order, and with the integrator that comes with wheelrail, and compares the\n"
      "lateral shifts: with the step, a half and a quarter of it. For 10 s they must agree within\n"
      "0.02 m/s times the step, which is 2 um at 0.1 ms.";
  dart.option = "--step";
  dart.placeholder = "S";
  dart.default_value = "1e-4";
  dart.help = "of DART [s], 5e-5 to 4e-4, a whole number of times in 0.01";
  dart.least = 5e-5;
  dart.greatest = 4e-4;
  dart.is_step = true;
  dart.bound = [](double step) { return 0.02 * step; };
  dart.lateral_shifts = lateral_shifts;
  return examples::compare_with_embedded_run(argc, argv, dart);
}
