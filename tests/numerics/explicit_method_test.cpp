#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <limits>
#include <random>
#include <vector>
#include <wheelrail/numerics/dormand_prince.hpp>
#include <wheelrail/numerics/explicit_method.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"

using namespace wheelrail;
using Complex = std::complex<double>;

namespace {

constexpr ExplicitMethod methods[] = {ExplicitMethod::euler, ExplicitMethod::runge_kutta_4,
                                      ExplicitMethod::dormand_prince};

// R(z) by steps of the methods themselves, for y' = z y from 1 with the step 1.
Complex stepped(ExplicitMethod method, const Complex& z) {
  if (method == ExplicitMethod::euler) return 1.0 + z;
  if (method == ExplicitMethod::runge_kutta_4) {
    const Complex k1 = z, k2 = z * (1.0 + k1 / 2.0), k3 = z * (1.0 + k2 / 2.0);
    return 1.0 + (k1 + 2.0 * k2 + 2.0 * k3 + z * (1.0 + k3)) / 6.0;
  }
  using State = Eigen::Vector2d;
  detail::DormandPrinceStages<State> k;
  const auto rate = [&](const State& y) {
    const Complex value = z * Complex(y(0), y(1));
    return State(value.real(), value.imag());
  };
  const State start(1, 0);
  k[0] = rate(start);
  for (std::size_t i = 1; i < 6; ++i) {
    k[i] = rate(detail::dormand_prince_point<State>(start, 1.0, k, i));
  }
  const State end = detail::dormand_prince_point<State>(start, 1.0, k, 6);
  return {end(0), end(1)};
}

// The first sample of a ray at which |R| > 1, by walking along it.
double walked_exit(ExplicitMethod method, const Complex& direction, double stride) {
  double x = stride;
  while (x < 6 && std::norm(stability_function(method, x * direction)) <= 1) x += stride;
  return x;
}

}  // namespace

TEST_CASE("stability_function: it is what one step of the method does", "[numerics][random]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-4, 4);
  for (const ExplicitMethod method : methods) {
    for (int i = 0; i < 100; ++i) {
      const Complex z(unit(random), unit(random));
      CHECK(std::abs(stability_function(method, z) - stepped(method, z)) <
            1e-13 * (1 + std::abs(stepped(method, z))));
    }
  }
}

TEST_CASE("largest_stable_step: the regions' ends on the real and on the imaginary axis",
          "[numerics][reference]") {
  const auto real = [](ExplicitMethod m) { return largest_stable_step(m, Complex(-50, 0)) * 50; };
  const auto imaginary = [](ExplicitMethod m) {
    return largest_stable_step(m, Complex(0, 50)) * 50;
  };
  CHECK(real(ExplicitMethod::euler) == Approx(2).epsilon(1e-14));
  CHECK(imaginary(ExplicitMethod::euler) == 0);
  // 1 + z/2 + z^2/6 + z^3/24 = 0: -2.78529356...; on the imaginary axis 2 sqrt 2.
  CHECK(real(ExplicitMethod::runge_kutta_4) == Approx(2.785293563405282).epsilon(1e-14));
  CHECK(imaginary(ExplicitMethod::runge_kutta_4) == Approx(2 * std::sqrt(2)).epsilon(1e-13));
  // R(z) = 1 with z != 0: 1 + z/2 + z^2/6 + z^3/24 + z^4/120 + z^5/600 = 0; and u = y^2 of
  // |R(iy)| = 1: u^3 - 25 u^2 + 225 u - 200 = 0.
  const double z = -real(ExplicitMethod::dormand_prince);
  CHECK(std::abs(1 + z * (1 / 2.0 + z * (1 / 6.0 + z * (1 / 24.0 + z * (1 / 120.0 + z / 600))))) <
        1e-13);
  CHECK(z == Approx(-3.307).margin(1e-3));
  const double u = std::pow(imaginary(ExplicitMethod::dormand_prince), 2);
  CHECK(std::abs(u * (u * (u - 25) + 225) - 200) < 1e-10);
}

TEST_CASE("largest_stable_step: Euler's method on a damped oscillator has the step 2 zeta/omega",
          "[numerics][reference]") {
  for (const double zeta : {1e-6, 1e-3, 0.1, 0.7, 0.999}) {
    const double omega = 300;
    const Complex eigenvalue(-zeta * omega, omega * std::sqrt(1 - zeta * zeta));
    CAPTURE(zeta);
    CHECK(largest_stable_step(ExplicitMethod::euler, eigenvalue) ==
          Approx(2 * zeta / omega).epsilon(1e-9));
    CHECK(largest_stable_step(ExplicitMethod::euler, std::conj(eigenvalue)) ==
          largest_stable_step(ExplicitMethod::euler, eigenvalue));
  }
}

TEST_CASE("largest_stable_step: the first exit of every ray, as a walk along it finds it",
          "[numerics][random]") {
  for (const ExplicitMethod method : methods) {
    for (double angle = pi<double>() / 2 + 1e-3; angle < pi<double>(); angle += 0.01) {
      const Complex direction = std::polar(1.0, angle);
      const double found = largest_stable_step(method, direction);
      const double walked = walked_exit(method, direction, 1e-4);
      CAPTURE(angle, static_cast<int>(method));
      CHECK(walked == Approx(found).margin(1.01e-4));
      CHECK(std::norm(stability_function(method, found * direction)) == Approx(1).epsilon(1e-12));
    }
  }
}

TEST_CASE("first_rise_above_zero: an excursion of a thousandth is seen", "[numerics]") {
  // ((x - 1)^2 - c) (x - 4): above zero from 0.999 to 1.001 with c = 1e-6, only from 4 on
  // with -1e-6.
  const auto rise = [](double c, double end) {
    return detail::first_rise_above_zero(
        std::array<double, 5>{-4 * (1 - c), 8 + 1 - c, -4 - 2, 1, 0}, end);
  };
  CHECK(rise(1e-6, 5) == Approx(0.999).epsilon(1e-12));
  CHECK(rise(-1e-6, 5) == Approx(4).epsilon(1e-14));
  CHECK(rise(-1e-6, 3) == 3);
  CHECK(detail::first_rise_above_zero(std::array<double, 2>{1, -1}, 5.0) == 0);
  CHECK(detail::first_rise_above_zero(std::array<double, 2>{0, 1}, 5.0) == 0);
}

TEST_CASE("largest_stable_step: the eigenvalue that limits, and the ones left out", "[numerics]") {
  const std::vector<Complex> values{{-1, 3}, {-100, 0}, {0.5, 2}, {0.5, -2}, {1e-4, 0}, {0, 40}};
  const auto found = largest_stable_step<double>(ExplicitMethod::runge_kutta_4, values);
  CHECK(found.status == SolveStatus::converged);
  CHECK(found.eigenvalue == Complex(-100, 0));
  CHECK(found.step == Approx(0.02785293563405282).epsilon(1e-13));
  CHECK(found.decaying == 3);
  CHECK(found.growing == 2);
  CHECK(found.still == 1);
  const auto euler = largest_stable_step<double>(ExplicitMethod::euler, values);
  CHECK(euler.step == 0);
  CHECK(euler.eigenvalue == Complex(0, 40));
  // What rounding makes of an undamped motion is undamped.
  const std::vector<Complex> rounded{{1e-7, 40}};
  CHECK(largest_stable_step<double>(ExplicitMethod::runge_kutta_4, rounded).step * 40 ==
        Approx(2 * std::sqrt(2)).epsilon(1e-13));
}

TEST_CASE("largest_stable_step: nothing limits zeros, nothing is made of NaN",
          "[numerics][bad-input]") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::nan("");
  const auto method = ExplicitMethod::runge_kutta_4;
  CHECK(largest_stable_step(method, Complex(0, 0)) == infinity);
  CHECK(largest_stable_step(method, Complex(1, 5)) == 0);
  CHECK(std::isnan(largest_stable_step(method, Complex(nan, 0))));
  CHECK(std::isnan(largest_stable_step(method, Complex(-infinity, 0))));
  const std::vector<Complex> with_nan{{-1, 0}, {nan, 0}};
  CHECK(std::isnan(largest_stable_step<double>(method, with_nan).step));
  CHECK(largest_stable_step<double>(method, with_nan).status == SolveStatus::not_finite);
  CHECK(largest_stable_step<double>(method, std::vector<Complex>{}).step == infinity);
  const std::vector<Complex> growing{{1, 1}};
  CHECK(largest_stable_step<double>(method, growing).step == infinity);
  CHECK(largest_stable_step<double>(method, growing).growing == 1);
}

TEST_CASE("largest_stable_step: float and long double; no allocation", "[numerics][no-alloc]") {
  const auto method = ExplicitMethod::runge_kutta_4;
  CHECK(largest_stable_step(method, std::complex<float>(-1, 1)) ==
        Approx(largest_stable_step(method, Complex(-1, 1))).epsilon(1e-6));
  CHECK(static_cast<double>(largest_stable_step(method, std::complex<long double>(0, 1))) ==
        Approx(2 * std::sqrt(2)).epsilon(1e-15));
  const Complex values[] = {{-1, 3}, {-100, 0}};
  double sum = 0;
  CHECK(wheelrail_test::allocations_of(
            [&] { sum += largest_stable_step<double>(method, values).step; }) == 0);
  CHECK(sum > 0);
}
