#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <wheelrail/dynamics/rigid_body_vector.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/track/tangent_track.hpp>
#include <wheelrail/wheelset/contact_linearization.hpp>
#include <wheelrail/wheelset/touching_position.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/numeric_difference.hpp"

using namespace wheelrail;

namespace {

using Vector = Vector3<double>;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Step = StableStep<double>;

const TangentTrack<RailHead<double>>& track() {
  static const TangentTrack<RailHead<double>> track(uic50<double>());
  return track;
}

const Wheelset<PiecewiseProfile<double>>& wheelset() {
  static const Wheelset<PiecewiseProfile<double>> wheelset(s1002<double>(), 0.43, 1.5);
  return wheelset;
}

const ContactForceModel<double>& model() {
  static const ContactForceModel<double> model;
  return model;
}

// As in examples/support/wheelset_run.hpp.
constexpr WheelsetInertia<double> inertia{1000, 600, 80};
constexpr double weight = 1000 * 9.81;

WheelsetForces<double> forces_of(const WheelsetPosition<double>& at,
                                 const WheelsetMotion<double>& motion) {
  return wheelset_forces(wheelset(), track(), at, motion, model());
}

Vector6d wrench_of(const WheelsetForces<double>& forces) {
  Vector6d wrench;
  wrench << forces.force_track, forces.moment_track;
  return wrench;
}

struct Rolling {
  WheelsetPosition<double> at;
  WheelsetMotion<double> motion;
};

// In the middle of the track, carrying its weight, rolling without longitudinal creep.
Rolling rolling(double speed) {
  double lower = -1e-3, upper = 0;  // of the gap
  Rolling result;
  for (int i = 0; i < 50; ++i) {
    const double gap = (lower + upper) / 2;
    const auto down = touching_position(wheelset(), track(), 0.0, 0.0, {.gap = gap});
    const double radius = down.patches[0].rolling_radius;
    result = {down.position, {{speed, 0, 0}, {0, speed / radius, 0}}};
    (forces_of(result.at, result.motion).force_track.z() < weight ? upper : lower) = gap;
  }
  return result;
}

Step stable_step(const Rolling& c, ExplicitMethod method = ExplicitMethod::runge_kutta_4) {
  const auto slopes = wrench_jacobian(forces_of(c.at, c.motion), c.at, c.motion, model());
  return contact_stable_step(method, slopes, c.at.axle_track, inertia);
}

// Steps of the classical Runge-Kutta method from a little beside the rolling: the slip of the
// treads and the vertical velocity [m/s] at the start and at the end.
struct Deviations {
  std::array<double, 2> slip{}, vertical{};
};
Deviations integrated(const Rolling& c, double step, int steps) {
  const RigidBody<double> body(inertia.mass,
                               {inertia.roll_inertia, inertia.spin_inertia, inertia.roll_inertia});
  const auto rate = [&](const Vector13<double>& y) {
    const auto state = unpack_rigid_body(y);
    const Matrix3<double> to_world = rotation_matrix(state.orientation);
    const auto forces = forces_of({state.position_world, Vector(to_world.col(1))},
                                  {state.velocity_world, to_world * state.angular_velocity_body});
    Wrench<double> wrench{forces.force_track, forces.moment_track};
    wrench.force_world.z() -= weight;
    return Vector13<double>(pack(derivative(body, state, wrench)));
  };
  const double radius = c.motion.velocity_track.x() / c.motion.angular_velocity_track.y();
  const auto slip = [&](const Vector13<double>& y) {
    const auto state = unpack_rigid_body(y);
    return std::abs(state.velocity_world.x() - radius * state.angular_velocity_body.y());
  };
  const auto vertical = [](const Vector13<double>& y) {
    return std::abs(unpack_rigid_body(y).velocity_world.z());
  };
  RigidBodyState<double> start;
  start.position_world = c.at.position_track;
  start.velocity_world = c.motion.velocity_track + Vector(0, 0, 1e-6);
  start.angular_velocity_body = c.motion.angular_velocity_track;
  start.angular_velocity_body.y() *= 1 + 1e-8;
  Vector13<double> y = pack(start);
  Deviations result;
  result.slip[0] = slip(y);
  result.vertical[0] = vertical(y);
  for (int i = 0; i < steps; ++i) {
    const Vector13<double> k1 = rate(y), k2 = rate(y + step / 2 * k1);
    const Vector13<double> k3 = rate(y + step / 2 * k2), k4 = rate(y + step * k3);
    y += step / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  result.slip[1] = slip(y);
  result.vertical[1] = vertical(y);
  return result;
}

}  // namespace

TEST_CASE("wrench_jacobian: differences of wheelset_forces by the velocities agree",
          "[wheelset][random]") {
  std::mt19937 random(20260403);
  std::uniform_real_distribution<double> unit(-1, 1);
  int patches = 0;
  double worst = 0;
  for (int i = 0; i < 30; ++i) {
    const double speed = std::pow(10, 0.75 + 0.75 * unit(random));
    const auto down = touching_position(wheelset(), track(), 0.0065 * unit(random),
                                        0.02 * unit(random), {.gap = -60e-6});
    const WheelsetMotion<double> motion{
        speed * Vector(1, 2e-3 * unit(random), 5e-4 * unit(random)),
        speed * Vector(1e-3 * unit(random), (1 + 2e-3 * unit(random)) / 0.43, 1e-3 * unit(random))};
    const auto forces = forces_of(down.position, motion);
    const auto slopes = wrench_jacobian(forces, down.position, motion, model());
    for (Eigen::Index k = 0; k < 6; ++k) {
      const auto moved = [&](double h) {
        auto with = motion;
        (k < 3 ? with.velocity_track(k) : with.angular_velocity_track(k - 3)) += h;
        return with;
      };
      for (Eigen::Index row = 0; row < 6; ++row) {
        const double difference = wheelrail_test::central_difference(
            [&](double h) { return wrench_of(forces_of(down.position, moved(h)))(row); }, 0.0,
            1e-5 * speed);
        const double size = slopes.by_velocity.col(k).norm();
        worst = std::max(worst, std::abs(difference - slopes.by_velocity(row, k)) / size);
      }
    }
    for (const Side side : sides) patches += static_cast<int>(forces.wheel(side).patches.size());
  }
  CAPTURE(worst);
  CHECK(worst < 1e-6);
  CHECK(patches > 60);
}

TEST_CASE("wrench_jacobian: pressed down, the wheelset stands on two of Hertz's springs",
          "[wheelset]") {
  const Rolling c = rolling(10);
  const auto forces = forces_of(c.at, c.motion);
  const auto slopes = wrench_jacobian(forces, c.at, c.motion, model());
  const auto& left = forces.wheel(Side::left).patches[0];
  const double stiffness = 1.5 * left.contact.normal / left.patch.penetration;
  const double cosine = std::cos(left.patch.contact_angle);
  CHECK(forces.force_track.z() == Approx(weight).epsilon(1e-9));
  // The tilted creep force, 1/40 of the spin's, is in it too.
  CHECK(slopes.by_displacement(2, 2) == Approx(-2 * stiffness * cosine * cosine).epsilon(1e-2));
  const double difference = wheelrail_test::central_difference(
      [&](double h) {
        auto at = c.at;
        at.position_track.z() += h;
        return forces_of(at, c.motion).force_track.z();
      },
      0.0, 1e-8);
  CHECK(slopes.by_displacement(2, 2) == Approx(difference).epsilon(1e-2));
  CHECK(slopes.by_displacement.col(0).norm() < 1e-6 * stiffness);
}

TEST_CASE("contact_stable_step: below it a run of the Runge-Kutta method decays, above it blows up",
          "[wheelset]") {
  for (const double speed : {1.0, 10.0}) {
    CAPTURE(speed);
    const Rolling c = rolling(speed);
    const Step estimate = stable_step(c);
    REQUIRE(estimate.status == SolveStatus::converged);
    CAPTURE(estimate.step, estimate.eigenvalue.real(), estimate.eigenvalue.imag());
    const auto below = integrated(c, 0.8 * estimate.step, 40);
    const auto above = integrated(c, 1.25 * estimate.step, 40);
    CHECK(below.slip[1] < 1e-3 * below.slip[0]);
    CHECK(above.slip[1] > 1e3 * above.slip[0]);
  }
  // Fast, creep damps little, and the vibration on the contacts sets the limit.
  const Rolling c = rolling(100);
  const Step estimate = stable_step(c);
  REQUIRE(estimate.eigenvalue.imag() != 0);
  const auto below = integrated(c, 0.8 * estimate.step, 40);
  const auto above = integrated(c, 1.25 * estimate.step, 40);
  CHECK(below.vertical[1] < 1e-3 * below.vertical[0]);
  CHECK(above.vertical[1] > 1e3 * above.vertical[0]);
}

TEST_CASE("contact_stable_step: its limits are creep over speed, and Hertz's springs",
          "[wheelset][reference]") {
  // Slip decays with both treads' creep on the mass and on the spin's r^2 / I; and both contacts
  // carry the wheelset on 2 (3 f_n / (2 d)).
  const Rolling slow = rolling(1);
  const auto forces = forces_of(slow.at, slow.motion);
  const auto& contact = forces.wheel(Side::left).patches[0].contact;
  const auto kalker = model().kalker().at(contact.ellipse.a, contact.ellipse.b);
  const double slope =
      model().materials().shear_modulus() * contact.ellipse.a * contact.ellipse.b * kalker.c11;
  const double radius = forces.wheel(Side::left).patches[0].patch.rolling_radius;
  const double rate = 2 * slope * (1 / inertia.mass + radius * radius / inertia.spin_inertia);
  const Step estimate = stable_step(slow);
  CHECK(estimate.eigenvalue.imag() == 0);
  // The spin creepage of the coned wheels saturates the contacts a little.
  CHECK(-estimate.eigenvalue.real() < rate);
  CHECK(-estimate.eigenvalue.real() == Approx(rate).epsilon(0.1));
  CHECK(estimate.step == Approx(2.785293563405282 / -estimate.eigenvalue.real()).epsilon(1e-9));
  CHECK(estimate.growing == 0);

  const Rolling fast = rolling(100);
  const auto fast_forces = forces_of(fast.at, fast.motion);
  const auto& pressed = fast_forces.wheel(Side::left).patches[0];
  const double stiffness = 1.5 * pressed.contact.normal / pressed.patch.penetration;
  CHECK(std::abs(stable_step(fast).eigenvalue) ==
        Approx(std::sqrt(2 * stiffness / inertia.mass)).epsilon(0.02));
  CHECK(stable_step(fast, ExplicitMethod::euler).step < 0.01 * stable_step(fast).step);
}

TEST_CASE("contact_stable_step: without a contact nothing limits; NaN is a status; no allocation",
          "[wheelset][bad-input][no-alloc]") {
  const auto none = contact_stable_step(ExplicitMethod::runge_kutta_4, WrenchJacobian<double>{},
                                        Vector(0, 1, 0), inertia);
  CHECK(none.status == SolveStatus::converged);
  CHECK(std::isinf(none.step));
  CHECK(none.still == 12);
  WrenchJacobian<double> bad;
  bad.by_velocity(1, 1) = std::nan("");
  const auto unknown =
      contact_stable_step(ExplicitMethod::runge_kutta_4, bad, Vector(0, 1, 0), inertia);
  CHECK(unknown.status == SolveStatus::not_finite);
  CHECK(std::isnan(unknown.step));

  const Rolling c = rolling(10);
  double sum = 0;
  CHECK(wheelrail_test::allocations_of([&] { sum += stable_step(c).step; }) == 0);
  CHECK(sum > 0);
}
