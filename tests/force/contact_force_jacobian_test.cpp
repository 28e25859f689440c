#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <wheelrail/core/dual.hpp>
#include <wheelrail/force/contact_force_jacobian.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::StrictScalar;

namespace {

// Rows: longitudinal, lateral and normal force. Columns: by the velocities in the order of
// ContactForceJacobian: longitudinal, lateral, normal; spin; penetration; speed; forward speed.
using Slopes = Eigen::Matrix<double, 3, 7>;
using Number = wheelrail::Dual<double, 7>;

Slopes slopes_of(const ContactForceJacobian<double>& jacobian) {
  Slopes slopes;
  slopes << jacobian.by_velocity, jacobian.by_spin_velocity, jacobian.by_penetration,
      jacobian.by_speed, jacobian.by_forward_speed;
  return slopes;
}

// The force model itself, in dual numbers.
Slopes automatic(const ContactForceModel<Number>& model, const ContactKinematics<double>& c) {
  ContactKinematics<Number> lifted;
  lifted.curvatures = {Number(c.curvatures.longitudinal), Number(c.curvatures.lateral)};
  lifted.longitudinal_velocity = Number(c.longitudinal_velocity, 0);
  lifted.lateral_velocity = Number(c.lateral_velocity, 1);
  lifted.normal_velocity = Number(c.normal_velocity, 2);
  lifted.spin_velocity = Number(c.spin_velocity, 3);
  lifted.penetration = Number(c.penetration, 4);
  lifted.speed = Number(c.speed, 5);
  lifted.forward_speed = Number(c.forward_speed, 6);
  const ContactForce<Number> force = model(lifted);
  Slopes slopes;
  slopes << Eigen::Map<const Eigen::Matrix<double, 1, 7>>(
      force.creep.longitudinal.derivatives.data()),
      Eigen::Map<const Eigen::Matrix<double, 1, 7>>(force.creep.lateral.derivatives.data()),
      Eigen::Map<const Eigen::Matrix<double, 1, 7>>(force.normal.derivatives.data());
  return slopes;
}

// A wheel of 0.43 m on a rail of 0.3 m, pressed by 50 kN, rolling at 10 m/s.
template <class T>
ContactKinematics<T> rolling_contact() {
  ContactKinematics<T> contact;
  contact.penetration = T(0.067355e-3);
  contact.curvatures = hertz_curvatures(T(T(1) / T(0.43)), T(0), T(0), T(T(1) / T(0.3)));
  contact.forward_speed = contact.speed = T(10);
  return contact;
}

}  // namespace

TEST_CASE("contact_force_jacobian: automatic derivatives of the force model agree",
          "[force][random][autodiff]") {
  const ContactForceModel<double> model;
  const ContactForceModel<Number> dual_model;
  std::mt19937 random(20260402);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto any_size = [&](double decades) { return std::pow(10, decades * unit(random)); };
  int damped = 0, backwards = 0, slow = 0, sliding = 0;
  double worst = 0;
  for (int i = 0; i < 4000; ++i) {
    ContactKinematics<double> c;
    c.penetration = 60e-6 * any_size(1);
    c.curvatures = {1.16 * any_size(0.2), 3 * any_size(1)};
    c.forward_speed = 5 * unit(random) * any_size(1.5);
    c.speed = std::abs(c.forward_speed) * (1 + 1e-3 * unit(random) * unit(random));
    c.longitudinal_velocity = 1e-3 * c.speed * unit(random) * any_size(2);
    c.lateral_velocity = 1e-3 * c.speed * unit(random) * any_size(2);
    c.spin_velocity = 0.2 * c.speed * unit(random) * any_size(1);
    c.normal_velocity = 0.15 * unit(random);
    const auto force = model(c);
    const Slopes found = slopes_of(contact_force_jacobian(model, c, force));
    const Slopes expected = automatic(dual_model, c);
    const double terms = 0.25 * force.normal / std::hypot(c.speed, 0.01);
    for (Eigen::Index row = 0; row < 3; ++row) {
      for (Eigen::Index k = 0; k < 7; ++k) {
        // Against the greatest entry of its column, which has its unit. By the speeds, automatic
        // derivatives are differences of terms as large as the friction over the speed.
        const double size = std::max(expected.col(k).cwiseAbs().maxCoeff(), 4 < k ? terms : 0.0);
        const double error = std::abs(found(row, k) - expected(row, k));
        worst = std::max(worst, error == 0 ? 0 : error / size);
      }
    }
    damped += 0 < std::abs(found(2, 2)) ? 1 : 0;
    backwards += c.forward_speed < 0 ? 1 : 0;
    slow += c.speed < 0.2 ? 1 : 0;
    const double friction = 0.25 * force.normal;
    sliding += 0.95 * friction < std::hypot(force.creep.longitudinal, force.creep.lateral) ? 1 : 0;
  }
  CAPTURE(std::log10(worst));
  CHECK(worst < 1e-10);
  CHECK((2000 < damped && damped < 3500));
  CHECK(backwards > 1500);
  CHECK(slow > 300);
  CHECK(sliding > 300);
}

TEST_CASE("contact_force_jacobian: rolling freely, the blocks are closed forms",
          "[force][reference]") {
  // No creep: Kalker's coefficients over the speed; Hertz's stiffness 3 f_n / (2 d); and the slope
  // of (64) in the middle, 3 (1 - c_e) / (4 v0) of the elastic force.
  const ContactForceModel<double> model;
  const auto contact = rolling_contact<double>();
  const auto force = model(contact);
  const auto jacobian = contact_force_jacobian(model, contact, force);
  const auto kalker = KalkerTable<double>(0.296).at(force.ellipse.a, force.ellipse.b);
  const double per_speed = 1 / std::sqrt(100 + 1e-4);
  const double area = force.ellipse.a * force.ellipse.b;
  const double shear = 206e9 / 2.592 * area * per_speed;
  const double elastic = force.stiffness * std::pow(contact.penetration, 1.5);
  Eigen::Matrix3d damping = Eigen::Matrix3d::Zero();
  damping.diagonal() << -shear * kalker.c11, -shear * kalker.c22, -elastic * 0.25 * 3 / 4 / 0.1;
  CHECK((jacobian.by_velocity - damping).norm() < 1e-12 * damping.norm());
  CHECK(jacobian.by_velocity(2, 2) == Approx(damping(2, 2)).epsilon(1e-12));
  CHECK(jacobian.by_spin_velocity.y() ==
        Approx(-shear * std::sqrt(area) * kalker.c23).epsilon(1e-6));
  CHECK(jacobian.by_penetration.z() ==
        Approx(1.5 * elastic * 0.875 / contact.penetration).epsilon(1e-13));
  CHECK(jacobian.by_penetration.head<2>().norm() == 0);
  CHECK(jacobian.by_speed.norm() == 0);
  CHECK(jacobian.by_forward_speed.norm() == 0);
}

TEST_CASE("contact_force_jacobian: outside +- v0 the normal force is not damped", "[force]") {
  const ContactForceModel<double> model;
  auto contact = rolling_contact<double>();
  for (const double velocity : {-0.11, 0.11}) {
    contact.normal_velocity = velocity;
    const auto jacobian = contact_force_jacobian(model, contact, model(contact));
    CHECK(jacobian.by_velocity.col(2).norm() == 0);
    CHECK(jacobian.by_penetration.z() > 0);
  }
}

TEST_CASE("contact_force_jacobian: no contact has no slope; NaN stays NaN", "[force][bad-input]") {
  const ContactForceModel<double> model;
  auto contact = rolling_contact<double>();
  for (const double penetration : {0.0, -1e-3}) {
    contact.penetration = penetration;
    CHECK(slopes_of(contact_force_jacobian(model, contact, model(contact))).norm() == 0);
  }
  contact.penetration = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(slopes_of(contact_force_jacobian(model, contact, model(contact))).sum()));
  contact = rolling_contact<double>();
  contact.speed = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(slopes_of(contact_force_jacobian(model, contact, model(contact))).sum()));
}

TEST_CASE("contact_force_jacobian: any scalar, no allocation", "[force][no-alloc]") {
  const auto of = []<class T>(T) {
    const ContactForceModel<T> model;
    auto contact = rolling_contact<T>();
    contact.lateral_velocity = T(0.01);
    contact.spin_velocity = T(-0.5);
    return contact_force_jacobian(model, contact, model(contact));
  };
  const auto in_double = of(0.0);
  const auto strict = of(StrictScalar(0));
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      CHECK(strict.by_velocity(row, k).as_double() == in_double.by_velocity(row, k));
    }
    CHECK(strict.by_penetration(row).as_double() == in_double.by_penetration(row));
  }
  const ContactForceModel<double> model;
  const auto contact = rolling_contact<double>();
  const auto force = model(contact);
  double sum = 0;
  CHECK(wheelrail_test::allocations_of(
            [&] { sum += contact_force_jacobian(model, contact, force).by_velocity(0, 0); }) == 0);
  CHECK(sum < 0);
}
