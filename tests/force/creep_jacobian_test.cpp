#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <wheelrail/core/dual.hpp>
#include <wheelrail/force/creep_jacobian.hpp>

#include "force/example_contact.hpp"
#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::example;
using wheelrail_test::StrictScalar;

namespace {

// Rows: longitudinal and lateral force; columns: by the three creepages and the normal force.
using Slopes = Eigen::Matrix<double, 2, 4>;

Slopes slopes_of(const CreepJacobian<double>& jacobian) {
  Slopes slopes;
  slopes << jacobian.by_creepage, jacobian.by_normal_force;
  return slopes;
}

// polach_force in dual numbers, the ellipse growing with the cube root of the normal force or held.
Slopes automatic(const Creepage<double>& xi, const PolachContact<double>& contact,
                 EllipseUnderLoad ellipse) {
  using Number = wheelrail::Dual<double, 4>;
  PolachContact<Number> lifted{{Number(contact.ellipse.a), Number(contact.ellipse.b)},
                               {Number(contact.kalker.c11), Number(contact.kalker.c22),
                                Number(contact.kalker.c23), Number(contact.kalker.c33)},
                               Number(contact.shear_modulus),
                               Number(contact.friction_coefficient),
                               Number(contact.normal_force, 3)};
  if (ellipse == EllipseUnderLoad::grows) {
    const double third = 1 / (3 * contact.normal_force);
    lifted.ellipse.a.derivatives[3] = contact.ellipse.a * third;
    lifted.ellipse.b.derivatives[3] = contact.ellipse.b * third;
  }
  const auto force = polach_force<Number>(
      {Number(xi.longitudinal, 0), Number(xi.lateral, 1), Number(xi.spin, 2)}, lifted);
  Slopes slopes;
  slopes << Eigen::Map<const Eigen::Matrix<double, 1, 4>>(force.longitudinal.derivatives.data()),
      Eigen::Map<const Eigen::Matrix<double, 1, 4>>(force.lateral.derivatives.data());
  return slopes;
}

// The size that each column has in Kalker's linear theory, or at full friction.
Eigen::RowVector4d scales_of(const PolachContact<double>& c) {
  const double stiffness = c.shear_modulus * c.ellipse.a * c.ellipse.b;
  return {stiffness * c.kalker.c11, stiffness * c.kalker.c22,
          stiffness * std::sqrt(c.ellipse.a * c.ellipse.b) * c.kalker.c23, c.friction_coefficient};
}

}  // namespace

TEST_CASE("creep_jacobian: automatic derivatives of polach_force agree",
          "[force][random][autodiff]") {
  std::mt19937 random(20260401);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto any_size = [&](double decades) { return std::pow(10, decades * unit(random)); };
  int small = 0, in_between = 0, sliding = 0, spun = 0, growing = 0;
  double worst = 0, worst_of_entry = 0, worst_force = 0;
  for (int i = 0; i < 20000; ++i) {
    auto contact = example<double>();
    contact.ellipse.a *= any_size(0.7);
    contact.ellipse.b *= any_size(0.7);
    contact.normal_force *= any_size(1);
    contact.kalker.c11 *= any_size(0.3);
    contact.kalker.c22 *= any_size(0.3);
    const Creepage<double> xi{1e-3 * unit(random) * any_size(3), 1e-3 * unit(random) * any_size(3),
                              0.3 * unit(random) * any_size(2)};
    const auto ellipse = i % 2 == 0 ? EllipseUnderLoad::grows : EllipseUnderLoad::held;
    const auto jacobian = creep_jacobian(xi, contact, ellipse);
    const auto force = polach_force(xi, contact);
    const double bound = contact.normal_force * contact.friction_coefficient;
    worst_force =
        std::max({worst_force, std::abs(jacobian.force.longitudinal - force.longitudinal) / bound,
                  std::abs(jacobian.force.lateral - force.lateral) / bound});
    const Slopes found = slopes_of(jacobian), expected = automatic(xi, contact, ellipse);
    const Eigen::RowVector4d scales = scales_of(contact);
    for (Eigen::Index row = 0; row < 2; ++row) {
      for (Eigen::Index k = 0; k < 4; ++k) {
        const double error = std::abs(found(row, k) - expected(row, k));
        worst = std::max(worst, error / scales(k));
        if (1e-6 * scales(k) < std::abs(expected(row, k))) {
          worst_of_entry = std::max(worst_of_entry, error / std::abs(expected(row, k)));
        }
      }
    }
    const double ratio = std::hypot(force.longitudinal, force.lateral) / bound;
    small += ratio < 0.1 ? 1 : 0;
    in_between += 0.1 < ratio && ratio < 0.9 ? 1 : 0;
    sliding += 0.95 < ratio ? 1 : 0;
    const double with_spin = std::abs(xi.lateral + contact.ellipse.a * xi.spin);
    spun += std::abs(xi.lateral) < with_spin ? 1 : 0;
    growing += ellipse == EllipseUnderLoad::grows ? 1 : 0;
  }
  CAPTURE(std::log10(worst), std::log10(worst_of_entry), std::log10(worst_force));
  CHECK(worst_force < 1e-14);
  CHECK(worst < 1e-13);
  CHECK(worst_of_entry < 1e-10);
  CHECK(small > 1000);
  CHECK(in_between > 1000);
  CHECK(sliding > 1000);
  CHECK((4000 < spun && spun < 16000));
  CHECK(growing == 10000);
}

TEST_CASE("creep_jacobian: without creepages the slopes are Kalker's", "[force][reference]") {
  const auto contact = example<double>();
  const double stiffness = contact.shear_modulus * 6e-3 * 4.5e-3;
  const double spin_stiffness = stiffness * std::sqrt(2.7e-5) * contact.kalker.c23;
  const auto at_rest = creep_jacobian<double>({}, contact);
  Eigen::Matrix<double, 2, 3> kalker;
  kalker << -stiffness * contact.kalker.c11, 0, 0,  //
      0, -stiffness * contact.kalker.c22, -spin_stiffness;
  CHECK((at_rest.by_creepage - kalker).norm() < 1e-14 * stiffness);
  CHECK(at_rest.by_normal_force.norm() == 0);
  CHECK(at_rest.force.longitudinal == 0);
  CHECK(at_rest.force.lateral == 0);

  // Along the axes they are the limit; creepages that are too small to be squared are none.
  for (const double tiny : {1e-7, 1e-12, 1e-40, 1e-150, 1e-170}) {
    CAPTURE(tiny);
    const double within = 1e5 * tiny + 1e-14;
    const auto x = creep_jacobian({tiny, 0.0, 0.0}, contact);
    CHECK(x.by_creepage(0, 0) == Approx(kalker(0, 0)).epsilon(within));
    CHECK(x.by_creepage(1, 0) == 0);
    const auto y = creep_jacobian({0.0, tiny, 0.0}, contact);
    CHECK(y.by_creepage(1, 1) == Approx(kalker(1, 1)).epsilon(within));
    CHECK(y.by_creepage(1, 2) == Approx(kalker(1, 2)).epsilon(within));
    CHECK(y.by_creepage(0, 1) == 0);
    const auto spin = creep_jacobian({0.0, 0.0, tiny}, contact);
    CHECK(spin.by_creepage(1, 2) == Approx(kalker(1, 2)).epsilon(within));
    CHECK(spin.by_creepage(0, 0) == Approx(kalker(0, 0)).epsilon(within));
    CHECK(spin.by_creepage(1, 1) == Approx(kalker(1, 1)).epsilon(within));
    // In linear theory forces grow with G a b, in spin with G (a b)^1.5: f_n^(2/3) and f_n.
    CHECK(x.by_normal_force.x() / x.force.longitudinal * 50e3 == Approx(2.0 / 3).epsilon(within));
    CHECK(spin.by_normal_force.y() / spin.force.lateral * 50e3 == Approx(1).epsilon(within));
  }
}

TEST_CASE("creep_jacobian: the slopes along and across the slip are closed forms",
          "[force][reference]") {
  // With c11 = c22 and no spin the force is a function of |xi| against the slip: along it the slope
  // is k / (1 + eps^2)^2, across it f / xi.
  auto contact = example<double>();
  contact.kalker.c22 = contact.kalker.c11;
  const double k = contact.shear_modulus * 6e-3 * 4.5e-3 * contact.kalker.c11;
  for (const double slip : {1e-9, 1e-5, 1e-3, 4e-3, 0.05, 10.0}) {
    for (const double angle : {0.0, 0.3, 1.4, 2.5, -2.0}) {
      CAPTURE(slip, angle);
      const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
      const Eigen::Vector2d across(-along.y(), along.x());
      const auto jacobian = creep_jacobian({slip * along.x(), slip * along.y(), 0.0}, contact);
      const double eps = pi<double>() * k * slip / (4 * 12500.0);
      const double force = 2 * 12500 / pi<double>() * (eps / (1 + eps * eps) + std::atan(eps));
      const Eigen::Matrix2d slopes = jacobian.by_creepage.leftCols<2>();
      const double tangent = k / ((1 + eps * eps) * (1 + eps * eps));
      CHECK(along.dot(slopes * along) == Approx(-tangent).epsilon(1e-12).margin(1e-15 * k));
      CHECK(across.dot(slopes * across) == Approx(-force / slip).epsilon(1e-12));
      CHECK(std::abs(across.dot(slopes * along)) < 1e-14 * k);
      CHECK(slopes(0, 1) == Approx(slopes(1, 0)).epsilon(1e-13).margin(1e-15 * k));
    }
  }
}

TEST_CASE("creep_jacobian: in full sliding the force follows the normal force alone", "[force]") {
  const auto contact = example<double>();
  const double k = contact.shear_modulus * 6e-3 * 4.5e-3 * contact.kalker.c11;
  for (const auto ellipse : {EllipseUnderLoad::grows, EllipseUnderLoad::held}) {
    const auto jacobian = creep_jacobian({6.0, 8.0, 0.0}, contact, ellipse);
    CHECK(jacobian.by_normal_force.x() == Approx(-0.25 * 0.6).epsilon(1e-3));
    CHECK(jacobian.by_normal_force.y() == Approx(-0.25 * 0.8).epsilon(1e-3));
    // What is left turns the force with the slip: mu f_n / xi.
    const Eigen::Vector2d along(0.6, 0.8);
    CHECK((jacobian.by_creepage.leftCols<2>() * along).norm() < 1e-12 * k);
    CHECK(jacobian.by_creepage.leftCols<2>().norm() == Approx(12500 / 10.0).epsilon(1e-3));
  }
}

TEST_CASE("creep_jacobian: on the kink the slopes are those of the side with the spin", "[force]") {
  // |xi_y + a phi| = |xi_y| at phi = 0 and at phi = -2 xi_y / a.
  auto contact = example<double>();
  contact.ellipse.a = 0.0078125;  // so that the kink is met exactly
  contact.kalker.c23 = 0;         // and is all that spin does
  const double xi_y = 1e-3;
  for (const double kink : {0.0, -2 * xi_y / contact.ellipse.a}) {
    CAPTURE(kink);
    const double h = 1e-7;
    const double outwards = kink == 0 ? 1 : -1;  // to where xi_yC counts the spin
    const auto at = creep_jacobian({5e-4, xi_y, kink}, contact);
    const auto moved = polach_force({5e-4, xi_y, kink + outwards * h}, contact);
    const auto inside = polach_force({5e-4, xi_y, kink - outwards * h}, contact);
    const double slope = (moved.lateral - at.force.lateral) / (outwards * h);
    CHECK(at.by_creepage(1, 2) == Approx(slope).epsilon(1e-4));
    CHECK(std::abs(at.by_creepage(1, 2)) > 1);
    CHECK(inside.lateral == Approx(at.force.lateral).epsilon(1e-14));
    const auto within = creep_jacobian({5e-4, xi_y, kink - outwards * h}, contact);
    CHECK(within.by_creepage(0, 2) == 0);
    CHECK(within.by_creepage(1, 2) == 0);
  }
}

TEST_CASE("creep_jacobian: no force or no friction has no slope; NaN stays NaN",
          "[force][bad-input]") {
  auto contact = example<double>();
  contact.friction_coefficient = 0;
  CHECK(slopes_of(creep_jacobian({1e-3, 2e-3, 0.3}, contact)).norm() == 0);
  contact = example<double>();
  contact.normal_force = 0;
  contact.ellipse = {};
  CHECK(slopes_of(creep_jacobian({1e-3, 2e-3, 0.3}, contact)).norm() == 0);
  contact = example<double>();
  contact.normal_force = 1e-200;
  CHECK(slopes_of(creep_jacobian({1e-3, 2e-3, 0.3}, contact)).allFinite());

  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Creepage<double>& xi :
       {Creepage<double>{nan, 0, 0}, Creepage<double>{0, nan, 0}, Creepage<double>{0, 0, nan}}) {
    CHECK(std::isnan(slopes_of(creep_jacobian(xi, example<double>())).sum()));
  }
  contact = example<double>();
  contact.normal_force = nan;
  CHECK(std::isnan(slopes_of(creep_jacobian({1e-3, 0.0, 0.0}, contact)).sum()));
}

TEST_CASE("creep_jacobian: any scalar, no allocation", "[force][no-alloc]") {
  for (const Creepage<double>& xi : {Creepage<double>{1e-3, -5e-4, 0.2}, {2e-3, 1e-6, 0.5}}) {
    const auto in_double = creep_jacobian(xi, example<double>());
    const auto strict = creep_jacobian(
        {StrictScalar(xi.longitudinal), StrictScalar(xi.lateral), StrictScalar(xi.spin)},
        example<StrictScalar>());
    const auto more = creep_jacobian<long double>(
        {static_cast<long double>(xi.longitudinal), static_cast<long double>(xi.lateral),
         static_cast<long double>(xi.spin)},
        example<long double>());
    const auto less =
        creep_jacobian<float>({static_cast<float>(xi.longitudinal), static_cast<float>(xi.lateral),
                               static_cast<float>(xi.spin)},
                              example<float>());
    for (Eigen::Index row = 0; row < 2; ++row) {
      for (Eigen::Index k = 0; k < 3; ++k) {
        CAPTURE(row, k);
        const double slope = in_double.by_creepage(row, k);
        const double scale = scales_of(example<double>())(k);
        CHECK(strict.by_creepage(row, k).as_double() == slope);
        CHECK(static_cast<double>(more.by_creepage(row, k)) == Approx(slope).margin(1e-14 * scale));
        CHECK(static_cast<double>(less.by_creepage(row, k)) == Approx(slope).margin(1e-5 * scale));
      }
      CHECK(strict.by_normal_force(row).as_double() == in_double.by_normal_force(row));
    }
  }
  double sum = 0;
  const auto contact = example<double>();
  CHECK(wheelrail_test::allocations_of([&] {
          sum += creep_jacobian({1e-3, 1e-3, 0.1}, contact).by_creepage(0, 0);
        }) == 0);
  CHECK(sum < 0);
}
