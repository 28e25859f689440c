#include <Eigen/Geometry>
#include <random>
#include <wheelrail/profile/convex_modification.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/track/tangent_track.hpp>
#include <wheelrail/wheelset/touching_position.hpp>
#include <wheelrail/wheelset/wheelset_forces.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"

using namespace wheelrail;

namespace {

using Vector = Vector3<double>;

const TangentTrack<RailHead<double>>& paper_track() {
  static const TangentTrack<RailHead<double>> track(uic50<double>());
  return track;
}

const Wheelset<PiecewiseProfile<double>>& paper_wheelset() {
  static const Wheelset<PiecewiseProfile<double>> wheelset(s1002<double>(), 0.43, 1.5);
  return wheelset;
}

// A wheelset pressed onto the rails by some tens of micrometres, rolling, with some slip.
struct Case {
  WheelsetPosition<double> at;
  WheelsetMotion<double> motion;
};

Case random_case(std::mt19937& random) {
  const auto between = [&random](double lower, double upper) {
    return lower + (upper - lower) * (static_cast<double>(random()) / 4294967296.0);
  };
  const double shift = between(-0.0065, 0.0065), yaw = between(-0.02, 0.02);
  const auto set_down =
      touching_position(paper_wheelset(), paper_track(), shift, yaw, {.gap = -60e-6});
  const double height = set_down.position.position_track.z();
  Case result{
      WheelsetPosition<double>::of(shift, height, set_down.roll + between(-2e-5, 2e-5), yaw), {}};
  result.motion.velocity_track = {between(5, 40), between(-0.1, 0.1), between(-0.02, 0.02)};
  result.motion.angular_velocity_track = {
      between(-0.05, 0.05), result.motion.velocity_track.x() / 0.43 * between(0.99, 1.01),
      between(-0.05, 0.05)};
  return result;
}

// Reflection in the plane y = 0: of a position, velocity or force, and of an axial vector.
Vector mirrored(const Vector& v) {
  return {v.x(), -v.y(), v.z()};
}
Vector mirrored_axial(const Vector& v) {
  return {-v.x(), v.y(), -v.z()};
}

}  // namespace

TEST_CASE("wheelset_forces: a wheelset standing still carries its load upwards and nothing else",
          "[wheelset]") {
  const auto down = touching_position(paper_wheelset(), paper_track(), 0.0, 0.0, {.gap = -50e-6});
  const auto forces = wheelset_forces(paper_wheelset(), paper_track(), down.position, {},
                                      ContactForceModel<double>());
  const auto& left = forces.wheel(Side::left).patches[0];
  // By hand: Hertz with the curvatures of the patch, opening and closing force at rest.
  const double expected = left.contact.stiffness * std::pow(50e-6, 1.5) * (1 + 0.75) / 2;
  CHECK(left.contact.normal == Approx(expected).epsilon(1e-9));
  CHECK(forces.force_track.z() ==
        Approx(2 * expected * std::cos(left.patch.contact_angle)).epsilon(1e-9));
  CHECK(forces.force_track.y() == 0.0);
  CHECK(forces.force_track.x() == 0.0);
  CHECK(forces.moment_track.norm() < 1e-9 * forces.force_track.z());
}

TEST_CASE("wheelset_forces: the contact frame is right-handed, forward, left, up", "[wheelset]") {
  std::mt19937 random(1);
  int patches = 0;
  for (int i = 0; i < 100; ++i) {
    const Case c = random_case(random);
    const auto forces = wheelset_forces(paper_wheelset(), paper_track(), c.at, c.motion,
                                        ContactForceModel<double>());
    for (const auto& wheel : forces.wheels) {
      for (const auto& p : wheel.patches) {
        ++patches;
        CHECK(p.longitudinal_track.norm() == Approx(1).epsilon(1e-13));
        CHECK(p.lateral_track.norm() == Approx(1).epsilon(1e-11));
        CHECK(std::abs(p.longitudinal_track.dot(p.normal_track)) < 1e-11);
        CHECK(p.longitudinal_track.x() > 0.9);
        CHECK(p.lateral_track.y() > 0.1);
        CHECK(p.normal_track.z() > 0.1);
      }
    }
  }
  CHECK(patches > 150);
}

// The power of the wrench is that of the patches' forces, and the normal force works at the rate at
// which the search's own penetration grows.
TEST_CASE("wheelset_forces: wrench, contact velocities and penetration agree", "[wheelset]") {
  std::mt19937 random(2);
  const ContactForceModel<double> model;
  int compared = 0;
  for (int i = 0; i < 60; ++i) {
    const Case c = random_case(random);
    const auto forces = wheelset_forces(paper_wheelset(), paper_track(), c.at, c.motion, model);
    double power = 0;
    for (const auto& wheel : forces.wheels) {
      for (const auto& p : wheel.patches) {
        const Vector arm = p.position_track - c.at.position_track;
        const Vector velocity =
            c.motion.velocity_track + c.motion.angular_velocity_track.cross(arm);
        power += p.force_track.dot(velocity);
      }
    }
    CHECK(forces.force_track.dot(c.motion.velocity_track) +
              forces.moment_track.dot(c.motion.angular_velocity_track) ==
          Approx(power).epsilon(1e-9));

    const double h = 1e-7;
    const auto moved = [&](double t) {
      const Vector turn = c.motion.angular_velocity_track * t;
      Vector axle = c.at.axle_track;
      if (turn.norm() > 0) axle = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * axle;
      return WheelsetPosition<double>{c.at.position_track + c.motion.velocity_track * t, axle};
    };
    for (const Side side : sides) {
      const auto now = forces.wheel(side);
      const auto find = [&](double t) {
        return find_contact(paper_wheelset().wheel(side), paper_track().rail(side),
                            place_wheel(paper_wheelset(), paper_track(), side, moved(t)));
      };
      const auto before = find(-h), after = find(h);
      if (now.patches.size() != 1 || before.patches.size() != 1 || after.patches.size() != 1)
        continue;
      ++compared;
      const double rate = (after.patches[0].penetration - before.patches[0].penetration) / (2 * h);
      CHECK(now.patches[0].penetration_velocity == Approx(rate).margin(2e-8).epsilon(1e-6));
    }
  }
  CHECK(compared > 60);
}

TEST_CASE("wheelset_forces: a mirrored wheelset gets the mirrored wrench to the last bit",
          "[wheelset][symmetry][random]") {
  std::mt19937 random(3);
  const ContactForceModel<double> model;
  int touching = 0;
  for (int i = 0; i < 200; ++i) {
    const Case c = random_case(random);
    const WheelsetPosition<double> at{
        mirrored(c.at.position_track),
        // the axle points to the left again
        Vector(-c.at.axle_track.x(), c.at.axle_track.y(), -c.at.axle_track.z())};
    const WheelsetMotion<double> motion{mirrored(c.motion.velocity_track),
                                        mirrored_axial(c.motion.angular_velocity_track)};
    const auto a = wheelset_forces(paper_wheelset(), paper_track(), c.at, c.motion, model);
    const auto b = wheelset_forces(paper_wheelset(), paper_track(), at, motion, model);
    CHECK(a.force_track == mirrored(b.force_track));
    CHECK(a.moment_track == mirrored_axial(b.moment_track));
    touching += a.force_track.norm() > 0;
  }
  CHECK(touching > 190);
}

TEST_CASE("wheelset_forces: gravitational stiffness opposes a lateral shift, creep a sliding",
          "[wheelset]") {
  ContactForceOptions<double> smooth;
  smooth.friction_coefficient = 0;
  for (const double shift : {0.002, 0.005}) {
    const auto down =
        touching_position(paper_wheelset(), paper_track(), shift, 0.0, {.gap = -50e-6});
    const auto still = wheelset_forces(paper_wheelset(), paper_track(), down.position, {},
                                       ContactForceModel<double>(smooth));
    CHECK(still.force_track.y() < 0);
  }
  const auto down = touching_position(paper_wheelset(), paper_track(), 0.0, 0.0, {.gap = -50e-6});
  WheelsetMotion<double> motion{{10, 0.01, 0}, {0, 10 / 0.43, 0}};
  const ContactForceModel<double> model;
  CHECK(wheelset_forces(paper_wheelset(), paper_track(), down.position, motion, model)
            .force_track.y() < 0);
  motion = {{10, 0, 0}, {0, 10.1 / 0.43, 0}};  // spinning too fast drives the wheelset forwards
  CHECK(wheelset_forces(paper_wheelset(), paper_track(), down.position, motion, model)
            .force_track.x() > 0);
}

TEST_CASE("wheelset_forces: no allocation, by either method", "[wheelset][no-alloc]") {
  std::mt19937 random(4);
  const ConvexModification profile(s1002<double>());
  const Wheelset convex(profile, 0.43, 1.5);
  const MinimumDistanceSearch<double> search{convex_parts(profile), {}};
  const ContactForceModel<double> model;
  const Case c = random_case(random);
  double sum = 0;
  const long allocations = wheelrail_test::allocations_of([&] {
    for (int i = 0; i < 10; ++i) {
      sum +=
          wheelset_forces(paper_wheelset(), paper_track(), c.at, c.motion, model).force_track.z();
      sum += wheelset_forces(convex, paper_track(), c.at, c.motion, model, search).force_track.z();
    }
  });
  CHECK(allocations == 0);
  CHECK(sum > 0);
}

TEST_CASE("wheelset_forces: far above the rails nothing happens; NaN is a status",
          "[wheelset][bad-input]") {
  const ContactForceModel<double> model;
  const auto above = wheelset_forces(paper_wheelset(), paper_track(),
                                     WheelsetPosition<double>::of(0, 1, 0, 0), {}, model);
  CHECK(above.force_track == Vector::Zero());
  CHECK(above.wheel(Side::left).status == SearchStatus::complete);
  const auto bad = wheelset_forces(paper_wheelset(), paper_track(),
                                   WheelsetPosition<double>::of(0, std::nan(""), 0, 0), {}, model);
  CHECK(bad.wheel(Side::left).status == SearchStatus::not_finite);
  CHECK(bad.wheel(Side::left).patches.empty());
}

TEST_CASE("wheelset_forces: float and long double agree with double", "[wheelset]") {
  const auto vertical = []<class T>(T) {
    const Wheelset<PiecewiseProfile<T>> wheelset(s1002<T>(), T(0.43L), T(1.5L));
    const TangentTrack<RailHead<T>> track(uic50<T>());
    const auto at = WheelsetPosition<T>::of(T(0.002L), T(0.42965L), T(2.5e-5L), T(0.001L));
    return wheelset_forces(wheelset, track, at,
                           {Vector3<T>(T(10), T(0), T(0)), Vector3<T>(T(0), T(10 / 0.43L), T(0))},
                           ContactForceModel<T>())
        .force_track.z();
  };
  const double expected = vertical(double{});
  CHECK(expected > 1e4);
  CHECK(static_cast<double>(vertical(0.0L)) == Approx(expected).epsilon(1e-9));
  // 0.43 m in float carries 3e-8 m, of 1e-4 m of penetration.
  CHECK(static_cast<double>(vertical(0.0F)) == Approx(expected).epsilon(5e-3));
}
