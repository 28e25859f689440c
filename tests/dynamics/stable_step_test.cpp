#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <random>
#include <wheelrail/dynamics/stable_step.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

using Matrix = Linearization<double>::Matrix;

// q'' = -stiffness q - damping q', for a mass of one.
Linearization<double> system_of(const Matrix& stiffness, const Matrix& damping) {
  const Eigen::Index n = stiffness.rows();
  Linearization<double> system;
  system.coordinate_count = n;
  system.state_matrix = Matrix::Zero(2 * n, 2 * n);
  system.state_matrix.topRightCorner(n, n).setIdentity();
  system.state_matrix.bottomLeftCorner(n, n) = -stiffness;
  system.state_matrix.bottomRightCorner(n, n) = -damping;
  return system;
}

Linearization<double> oscillator(double omega, double zeta) {
  return system_of(Matrix::Constant(1, 1, omega * omega), Matrix::Constant(1, 1, 2 * zeta * omega));
}

// What one step makes of the state (q, q').
Matrix step_matrix(ExplicitMethod method, const Linearization<double>& system, double h) {
  const Eigen::Index n = system.state_matrix.rows();
  const auto c = detail::stability_coefficients<double>(method);
  Matrix step = Matrix::Zero(n, n);
  for (std::size_t k = c.size(); 0 < k; --k) {
    step = (h * step * system.state_matrix + c[k - 1] * Matrix::Identity(n, n)).eval();
  }
  return step;
}
Matrix semi_implicit_step_matrix(const Linearization<double>& system, double h) {
  const Eigen::Index n = system.coordinate_count;
  Matrix velocity = Matrix::Identity(2 * n, 2 * n), position = velocity;
  velocity.bottomRows(n) += h * system.state_matrix.bottomRows(n);
  position.topRightCorner(n, n) = h * Matrix::Identity(n, n);
  return position * velocity;
}

// The size of the 2^28th power.
double grown(Matrix step) {
  for (int i = 0; i < 28; ++i) step = (step * step).eval();
  return step.norm();
}

Matrix random_positive(std::mt19937& random, Eigen::Index n, double scale) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const Matrix root = Matrix::NullaryExpr(n, n, [&] { return unit(random); });
  return scale * (root * root.transpose() + 0.05 * Matrix::Identity(n, n));
}

constexpr ExplicitMethod methods[] = {ExplicitMethod::euler, ExplicitMethod::runge_kutta_4,
                                      ExplicitMethod::dormand_prince};

}  // namespace

TEST_CASE("largest_stable_step: a damped oscillator has the closed forms' steps",
          "[dynamics][reference]") {
  const double omega = 250;
  for (const double zeta : {0.01, 0.3, 0.95}) {
    CAPTURE(zeta);
    const auto modes = eigenmodes(oscillator(omega, zeta));
    CHECK(largest_stable_step(ExplicitMethod::euler, modes).step ==
          Approx(2 * zeta / omega).epsilon(1e-9));
    CHECK(largest_stable_step(ExplicitMethod::euler, modes).decaying == 1);
  }
  const auto undamped = eigenmodes(oscillator(omega, 0));
  CHECK(largest_stable_step(ExplicitMethod::runge_kutta_4, undamped).step ==
        Approx(2 * std::sqrt(2) / omega).epsilon(1e-12));
  CHECK(largest_stable_step(ExplicitMethod::euler, undamped).step == 0);
  // Overdamped: the faster of two real eigenvalues.
  const double faster = omega * (3 + std::sqrt(8));
  const auto overdamped = eigenmodes(oscillator(omega, 3));
  CHECK(largest_stable_step(ExplicitMethod::euler, overdamped).step ==
        Approx(2 / faster).epsilon(1e-12));
  CHECK(largest_stable_step(ExplicitMethod::runge_kutta_4, overdamped).step ==
        Approx(2.785293563405282 / faster).epsilon(1e-12));
}

TEST_CASE("largest_stable_step: powers of the step matrix stay below it and grow above it",
          "[dynamics][random]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> size(-1, 1);
  int oscillating = 0, real = 0;
  for (int i = 0; i < 30; ++i) {
    const auto system = system_of(random_positive(random, 4, 1000),
                                  random_positive(random, 4, 30 * std::pow(10, size(random))));
    for (const ExplicitMethod method : methods) {
      const auto found = largest_stable_step(method, eigenmodes(system));
      REQUIRE(found.status == SolveStatus::converged);
      REQUIRE(found.growing == 0);
      CHECK(grown(step_matrix(method, system, 0.98 * found.step)) < 1e-3);
      CHECK(!(grown(step_matrix(method, system, 1.02 * found.step)) < 1e3));
      (found.eigenvalue.imag() == 0 ? real : oscillating) += 1;
    }
    const double step = semi_implicit_euler_stable_step(system);
    CHECK(grown(semi_implicit_step_matrix(system, 0.98 * step)) < 1e-3);
    CHECK(!(grown(semi_implicit_step_matrix(system, 1.02 * step)) < 1e3));
  }
  CHECK(oscillating > 10);
  CHECK(real > 10);
}

TEST_CASE("semi_implicit_euler_stable_step: an oscillator has the closed form's step",
          "[dynamics][reference]") {
  const double omega = 250;
  for (const double zeta : {0.0, 0.01, 0.7, 1.0, 5.0}) {
    CAPTURE(zeta);
    CHECK(semi_implicit_euler_stable_step(oscillator(omega, zeta)) ==
          Approx(2 * (std::sqrt(1 + zeta * zeta) - zeta) / omega).epsilon(1e-9));
  }
  // A damper alone: that of Euler's method.
  CHECK(semi_implicit_euler_stable_step(system_of(
            Matrix::Zero(1, 1), Matrix::Constant(1, 1, 40))) == Approx(2.0 / 40).epsilon(1e-12));
  CHECK(std::isinf(
      semi_implicit_euler_stable_step(system_of(Matrix::Zero(1, 1), Matrix::Zero(1, 1)))));
}

TEST_CASE("largest_stable_step: a growing mode, as hunting is, is told and sets no limit",
          "[dynamics]") {
  Matrix stiffness = Matrix::Zero(2, 2), damping = Matrix::Zero(2, 2);
  stiffness.diagonal() << 100, 1e4;
  damping.diagonal() << -0.2, 4;
  const auto system = system_of(stiffness, damping);
  const auto found = largest_stable_step(ExplicitMethod::runge_kutta_4, eigenmodes(system));
  CHECK(found.growing == 1);
  CHECK(found.decaying == 1);
  CHECK(std::abs(found.eigenvalue) == Approx(100).epsilon(1e-9));
  CHECK(found.step == Approx(0.0283).epsilon(0.02));
}

TEST_CASE("largest_stable_step: series springs and NaN are refused", "[dynamics][bad-input]") {
  auto system = oscillator(10, 0.1);
  system.elongation_count = 1;
  CHECK_THROWS_WITH(semi_implicit_euler_stable_step(system),
                    Catch::Matchers::ContainsSubstring("elongations"));
  system = oscillator(std::numeric_limits<double>::quiet_NaN(), 0.1);
  CHECK(std::isnan(semi_implicit_euler_stable_step(system)));
  const auto found = largest_stable_step(ExplicitMethod::euler, eigenmodes(system));
  CHECK(found.status == SolveStatus::not_finite);
  CHECK(std::isnan(found.step));
}
