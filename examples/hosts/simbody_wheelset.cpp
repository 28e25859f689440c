// The paper's wheelset in Simbody: a free body, weight, and a custom force that asks wheelrail for
// the wrench of the rails; integrated with error control.
//
// Simbody 3.7's headers are C++17: as C++20 their comparisons are ambiguous. And its State is laid
// out differently where NDEBUG is defined: compile with or without it as the library was; Debian's
// was without. CMakeLists.txt sees to both; wheelset_contact.hpp is why C++17 is enough here.

#include <SimTKsimbody.h>

#include "host_comparison.hpp"
#include "wheelset_contact.hpp"

namespace {

using SimTK::Real;
using SimTK::SpatialVec;
using SimTK::Vec3;

Eigen::Vector3d to_eigen(const Vec3& v) {
  return {v[0], v[1], v[2]};
}
Vec3 to_simbody(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

// The rails under one wheelset. Ground is the track frame; the body's origin is the middle of the
// axle and its y axis the axle, to the left.
//
// calcForce is const, and a System may have several States. What the contact search remembers lives
// in the State, as a cache entry that calcForce may write to; a copied State has its own. An
// integrator that drops a step or goes back in time need not care: with whatever memory, a search
// finds the same to the last bit. Threads need a System each: Simbody 3.7's force subsystem mixes
// up the States of two threads.
class Rails : public SimTK::Force::Custom::Implementation {
 public:
  Rails(const SimTK::GeneralForceSubsystem& forces, const SimTK::MobilizedBody& wheelset)
      : forces_(forces), wheelset_(wheelset) {}

  void realizeTopology(SimTK::State& state) const override {
    // Of Stage::Topology: valid whatever else in the State changes. The State owns it.
    contact_ = forces_.allocateCacheEntry(state, SimTK::Stage::Topology,
                                          new SimTK::Value<examples::WheelsetContact>());
  }

  void calcForce(const SimTK::State& state, SimTK::Vector_<SpatialVec>& body_forces,
                 SimTK::Vector_<Vec3>&, SimTK::Vector&) const override {
    auto& contact =
        SimTK::Value<examples::WheelsetContact>::updDowncast(forces_.updCacheEntry(state, contact_))
            .upd();
    // All of these are expressed in Ground, the angular velocity too.
    const examples::ContactWrench wrench =
        contact.wrench({to_eigen(wheelset_.getBodyOriginLocation(state)),
                        to_eigen(wheelset_.getBodyRotation(state).y().asVec3()),
                        to_eigen(wheelset_.getBodyOriginVelocity(state)),
                        to_eigen(wheelset_.getBodyAngularVelocity(state))});
    // A moment and a force at the body's origin, both in Ground: first the moment.
    wheelset_.applyBodyForce(
        state, SpatialVec(to_simbody(wrench.moment_track), to_simbody(wrench.force_track)),
        body_forces);
  }

  // Creep and damping have no potential.
  Real calcPotentialEnergy(const SimTK::State&) const override { return 0; }

 private:
  const SimTK::GeneralForceSubsystem& forces_;
  SimTK::MobilizedBody wheelset_;
  mutable SimTK::CacheEntryIndex contact_;  // set by realizeTopology, as Simbody's own forces do
};

std::vector<double> lateral_shifts(const examples::WheelsetBody& data, double interval, int count,
                                   double accuracy) {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter(system);
  SimTK::GeneralForceSubsystem forces(system);
  const SimTK::Force::UniformGravity weight(forces, matter, Vec3(0, 0, -data.gravity));
  const SimTK::Body::Rigid body(
      SimTK::MassProperties(data.mass, Vec3(0), SimTK::Inertia(to_simbody(data.inertia))));
  // Free bodies have quaternions, so that the spin passes no singular angle.
  const SimTK::MobilizedBody::Free wheelset(matter.Ground(), body);
  const SimTK::Force::Custom rails(forces, new Rails(forces, wheelset));  // which owns it

  SimTK::State state = system.realizeTopology();
  SimTK::Mat33 axes;
  for (int i = 0; i < 3; ++i) axes(i) = to_simbody(data.axes_track.col(i));
  wheelset.setQToFitTransform(
      state, SimTK::Transform(SimTK::Rotation(axes), to_simbody(data.centre_track)));
  wheelset.setUToFitVelocity(
      state, SpatialVec(to_simbody(data.angular_velocity_track), to_simbody(data.velocity_track)));

  SimTK::RungeKuttaMersonIntegrator integrator(system);
  integrator.setAccuracy(accuracy);
  integrator.setAllowInterpolation(false);  // it would be less exact than the steps
  SimTK::TimeStepper stepper(system, integrator);
  stepper.initialize(state);
  std::vector<double> shifts;
  for (int i = 0; i <= count; ++i) {
    stepper.stepTo(interval * i);
    shifts.push_back(wheelset.getBodyOriginLocation(stepper.getState())[1]);
  }
  return shifts;
}

}  // namespace

int main(int argc, char** argv) {
  examples::Host simbody;
  simbody.name = "Simbody";
  simbody.summary =
      "Runs the paper's wheelset on a tangent track in Simbody and with the integrator that comes\n"
      "with wheelrail, and compares the lateral shifts: for 10 s they must agree within 1 um.";
  simbody.option = "--accuracy";
  simbody.placeholder = "ACC";
  simbody.default_value = "1e-9";
  simbody.help = "of Simbody's Runge-Kutta-Merson integrator [-], 1e-12 to 0.01";
  simbody.least = 1e-12;
  simbody.greatest = 1e-2;
  simbody.is_step = false;
  simbody.bound = [](double) { return 1e-6; };
  simbody.lateral_shifts = lateral_shifts;
  return examples::compare_with_embedded_run(argc, argv, simbody);
}
