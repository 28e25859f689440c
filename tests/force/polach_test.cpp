#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <wheelrail/core/dual.hpp>
#include <wheelrail/force/polach.hpp>

#include "force/example_contact.hpp"
#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/numeric_difference.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::example;
using wheelrail_test::StrictScalar;

namespace {

// Creepages [-], [-], [1/m]; the forces on the wheel of that contact [N]; those of Kalker's linear
// theory. An independent evaluation of Polach's formulas (1999) as they stand.
struct Row {
  double longitudinal, lateral, spin, force_x, force_y, linear_x, linear_y;
};
constexpr Row rows[] = {
    {0.0001, 0, 0, -988.404518843, -0, -990.956751333, -0},
    {0.001, 0, 0, -8002.21462887, -0, -9909.56751333, -0},
    {0.005, 0, 0, -12343.7693816, -0, -49547.8375667, -0},
    {0, 0.0001, 0, -0, -893.836354114, -0, -895.722402},
    {0, 0.001, 0, -0, -7480.55398408, -0, -8957.22402},
    {0, 0.005, 0, -0, -12293.6807928, -0, -44786.1201},
    {0, 0, 1e-06, -0, -0.0210333698069, -0, -0.0210333698069},
    {0, 0, 0.05, -0, -1048.34727045, -0, -1051.66849035},
    {0, 0, 0.3, -0, -5648.02596611, -0, -6310.01094208},
    {0, 0, 1, -0, -7886.38898713, -0, -21033.3698069},
    {0.001, 0.001, 0, -6699.87973337, -6699.87973337, -9909.56751333, -8957.22402},
    {0.001, 0.001, 0.3, -3972.31720789, -8561.87897523, -9909.56751333, -15267.2349621},
    {0.001, -0.001, 0.3, -6699.87973337, 2390.91891082, -9909.56751333, 2647.21307792},
    {-0.001, 0.0005, -0.2, 7302.86941507, -1280.1106272, 9909.56751333, -271.938048613},
    {0.002, 1e-06, 0.5, -6723.24372554, -6525.17944542, -19819.1350267, -10525.6421275},
    {0, -0.001, 0.3, -0, 1386.76314909, -0, 2647.21307792},
    {1e-07, 0, 0.3, -0.591986125299, -5648.02595739, -0.990956751333, -6310.01094208},
};

double magnitude_of(const CreepForce<double>& f) {
  return std::hypot(f.longitudinal, f.lateral);
}

// (88) as printed, with (89).
long double k_as_printed(long double eps) {
  const long double delta = (eps * eps - 1) / (eps * eps + 1);
  return eps * (delta * delta * delta / 3 - delta * delta / 2 + 1 / 6.0L) -
         std::pow(1 - delta * delta, 1.5L) / 3;
}

}  // namespace

TEST_CASE("polach_force: an independent evaluation gives the same forces", "[force][reference]") {
  const auto contact = example<double>();
  for (const Row& row : rows) {
    CAPTURE(row.longitudinal, row.lateral, row.spin);
    const auto f = polach_force({row.longitudinal, row.lateral, row.spin}, contact);
    CHECK(f.longitudinal == Approx(row.force_x).epsilon(1e-11));
    CHECK(f.lateral == Approx(row.force_y).epsilon(1e-11));
  }
}

TEST_CASE("polach_force: small creepages give Kalker's linear forces, spin included",
          "[force][reference]") {
  const auto contact = example<double>();
  const double stiffness = contact.shear_modulus * 6e-3 * 4.5e-3;
  // c_jj and xi_yC mix the directions, so that Polach's limit is Kalker's along the axes only.
  for (const double tiny : {1e-7, 1e-12, 1e-40}) {
    CAPTURE(tiny);
    const double within = 1e4 * tiny + 1e-14;
    const auto x = polach_force({tiny, 0.0, 0.0}, contact);
    CHECK(x.longitudinal == Approx(-stiffness * 4.61805088 * tiny).epsilon(within));
    CHECK(x.lateral == 0);
    const auto y = polach_force({0.0, tiny, 0.0}, contact);
    CHECK(y.lateral == Approx(-stiffness * 4.17424032 * tiny).epsilon(within));
    const auto spin = polach_force({0.0, 0.0, tiny}, contact);
    CHECK(spin.lateral ==
          Approx(-stiffness * std::sqrt(2.7e-5) * 1.88638784 * tiny).epsilon(within));
    CHECK(spin.longitudinal == 0);
  }
  for (const Row& row : rows) {
    // The table's own linear forces, at a millionth of its creepages.
    if ((row.longitudinal != 0) + (row.lateral != 0) + (row.spin != 0) != 1) continue;
    const double s = 1e-6;
    const auto f = polach_force({s * row.longitudinal, s * row.lateral, s * row.spin}, contact);
    CHECK(f.longitudinal == Approx(s * row.linear_x).epsilon(1e-6));
    CHECK(f.lateral == Approx(s * row.linear_y).epsilon(1e-6));
  }
}

TEST_CASE("polach_force: the spin force is (87) with (88) as printed", "[force][reference]") {
  const auto contact = example<double>();
  const double a = 6e-3, b = 4.5e-3;
  const double k_s = 1 + 6.3 * (1 - std::exp(-a / b));
  for (const double spin : {0.05, 0.3, 0.7, 1.0, 3.0, 10.0}) {
    CAPTURE(spin);
    const double eps = 8.0 / 3 * contact.shear_modulus * b * std::sqrt(a * b) * contact.kalker.c23 *
                       a * spin / (0.25 * 50e3 * k_s);
    const double k = std::abs(static_cast<double>(k_as_printed(static_cast<long double>(eps))));
    const double force = 9.0 / 16 * a * 0.25 * 50e3 * k * k_s / a;  // f_yS phi / xi_C
    CHECK(polach_force({0.0, 0.0, spin}, contact).lateral == Approx(-force).epsilon(1e-13));
  }
}

TEST_CASE("polach_force: large slip saturates at friction, against the slip", "[force]") {
  const auto contact = example<double>();
  for (const double angle : {0.0, 0.4, 1.3, 2.2, 3.0, -1.0}) {
    CAPTURE(angle);
    const auto f = polach_force({std::cos(angle), std::sin(angle), 0.0}, contact);
    CHECK(magnitude_of(f) == Approx(0.25 * 50e3).epsilon(1e-6));
    CHECK(f.longitudinal == Approx(-12500 * std::cos(angle)).margin(0.02));
    CHECK(f.lateral == Approx(-12500 * std::sin(angle)).margin(0.02));
  }
}

TEST_CASE("polach_force: pure spin is greatest at eps_S = 1/sqrt 3", "[force][reference]") {
  // |k_M| = (2/3) eps / (1 + eps^2)^2 there is sqrt(3)/8, so that the force is mu f_n (9/16) K_S
  // sqrt(3)/8: 0.687 mu f_n for a/b = 4/3.
  const auto contact = example<double>();
  double greatest = 0;
  for (double spin = 0; spin < 5; spin += 1e-3) {
    greatest = std::max(greatest, magnitude_of(polach_force({0.0, 0.0, spin}, contact)) / 12500);
  }
  const double k_s = 1 + 6.3 * (1 - std::exp(-4.0 / 3));
  CHECK(greatest == Approx(9.0 / 16 * k_s * std::sqrt(3.0) / 8).epsilon(1e-5));
  CHECK(greatest == Approx(0.687).margin(5e-4));
}

TEST_CASE("polach_force: never more than friction and never with the slip", "[force][random]") {
  std::mt19937 random(20240607);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto any_size = [&](double decades) { return std::pow(10, decades * unit(random)); };
  int saturated = 0, in_between = 0;
  for (int i = 0; i < 20000; ++i) {
    auto contact = example<double>();
    contact.ellipse.a *= any_size(1);
    contact.normal_force *= any_size(1);
    const Creepage<double> xi{1e-3 * unit(random) * any_size(2), 1e-3 * unit(random) * any_size(2),
                              0.3 * unit(random) * any_size(1)};
    const double bound = contact.normal_force * contact.friction_coefficient;
    const auto f = polach_force(xi, contact);
    const double ratio = magnitude_of(f) / bound;
    REQUIRE(ratio <= 1 + 1e-14);
    REQUIRE(f.longitudinal * xi.longitudinal <= 0);
    saturated += ratio > 0.95 ? 1 : 0;
    in_between += 0.1 < ratio && ratio < 0.9 ? 1 : 0;
  }
  CHECK(saturated > 2000);
  CHECK(in_between > 2000);
}

TEST_CASE("polach_force: a mirrored contact has the mirrored force, bit for bit",
          "[force][symmetry]") {
  const auto contact = example<double>();
  for (const Row& row : rows) {
    CAPTURE(row.longitudinal, row.lateral, row.spin);
    const auto f = polach_force({row.longitudinal, row.lateral, row.spin}, contact);
    const auto mirrored = polach_force({row.longitudinal, -row.lateral, -row.spin}, contact);
    CHECK(mirrored.longitudinal == f.longitudinal);
    CHECK(mirrored.lateral == -f.lateral);
    const auto braking = polach_force({-row.longitudinal, row.lateral, row.spin}, contact);
    CHECK(braking.longitudinal == -f.longitudinal);
    CHECK(braking.lateral == f.lateral);
  }
}

TEST_CASE("polach_force: continuous at vanishing creepage, with and without spin", "[force]") {
  const auto contact = example<double>();
  const auto zero = polach_force({0.0, 0.0, 0.0}, contact);
  CHECK(zero.longitudinal == 0);
  CHECK(zero.lateral == 0);
  for (const double spin : {0.0, 0.3}) {
    const auto at = polach_force({0.0, 0.0, spin}, contact);
    for (double angle = 0; angle < 6.3; angle += 0.3) {
      CAPTURE(spin, angle);
      const auto near =
          polach_force({1e-12 * std::cos(angle), 1e-12 * std::sin(angle), spin}, contact);
      CHECK(near.longitudinal == Approx(at.longitudinal).margin(2e-5));
      CHECK(near.lateral == Approx(at.lateral).margin(2e-5));
    }
  }
}

TEST_CASE("polach_force: with creepages rounded off, no kink where (86) has one", "[force]") {
  // |xi_y| = |xi_y + a phi| at xi_y = -a phi / 2, and at phi = 0.
  auto contact = example<double>();
  const double spin = 0.4, kink = -contact.ellipse.a * spin / 2;
  const auto turn = [&](double lateral, double about, bool by_spin) {
    const auto force = [&](double by) {
      return by_spin ? polach_force<double>({5e-4, lateral, about + by / 6e-3}, contact).lateral
                     : polach_force<double>({5e-4, about + by, spin}, contact).lateral;
    };
    // By how much the difference quotient changes at the kink, in parts of itself.
    const double step = 1e-7;
    const double before = force(0) - force(-step), after = force(step) - force(0);
    return std::abs(after - before) / std::abs(after);
  };
  const auto sharp = polach_force<double>({5e-4, 1e-3, 0.1}, contact);
  CHECK(turn(0, kink, false) > 0.01);
  CHECK(turn(1e-3, 0, true) > 0.01);
  contact.creepage_rounding = 1e-4;
  CHECK(turn(0, kink, false) < 1e-3);
  CHECK(turn(1e-3, 0, true) < 1e-3);
  const auto round = polach_force<double>({5e-4, 1e-3, 0.1}, contact);
  CHECK(round.longitudinal == Approx(sharp.longitudinal).epsilon(0.01));
  CHECK(round.lateral == Approx(sharp.lateral).epsilon(0.01));
  CHECK(polach_force<double>({0, 0, 0}, contact).lateral == 0);
}

TEST_CASE("polach_force: continuous where the series takes over", "[force]") {
  // Around eps^8 = the rounding unit of double, eps^2 = 1.2e-4.
  for (const double s : {0.5e-4, 1.2e-4, 1.3e-4, 3e-4}) {
    const double exact = static_cast<double>(
        detail::polach_saturation(static_cast<long double>(s)));  // its own switch is lower
    CHECK(detail::polach_saturation(s) == Approx(exact).epsilon(5e-16));
  }
  CHECK(detail::polach_saturation(0.0) == 1);
}

TEST_CASE("polach_force: no force or no friction is exactly nothing", "[force][bad-input]") {
  auto contact = example<double>();
  contact.friction_coefficient = 0;
  CHECK(magnitude_of(polach_force({1e-3, 2e-3, 0.3}, contact)) == 0);
  contact = example<double>();
  contact.normal_force = 0;
  contact.ellipse = {};
  CHECK(magnitude_of(polach_force({1e-3, 2e-3, 0.3}, contact)) == 0);
  // And next to nothing beside it.
  contact = example<double>();
  contact.friction_coefficient = 1e-200;
  CHECK(magnitude_of(polach_force({1e-3, 2e-3, 0.3}, contact)) < 1e-195);

  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(magnitude_of(polach_force({nan, 0.0, 0.0}, example<double>()))));
  CHECK(std::isnan(magnitude_of(polach_force({0.0, nan, 0.0}, example<double>()))));
  CHECK(std::isnan(magnitude_of(polach_force({0.0, 0.0, nan}, example<double>()))));
  contact.normal_force = nan;
  CHECK(std::isnan(magnitude_of(polach_force({1e-3, 0.0, 0.0}, contact))));
}

TEST_CASE("polach_force: automatic derivatives from curvatures and slip to forces",
          "[force][autodiff]") {
  // Lateral curvature, normal force, creepages and spin: through Hertz, Kalker and Polach.
  using Number = wheelrail::Dual<double, 5>;
  const auto chain = []<class T>(const std::array<T, 5>& x, T) {
    const MaterialPair<T> steels;
    const KalkerTable<T> table(steels.poisson_ratio());
    const auto ellipse = hertz_ellipse(hertz_shape<T>({T(1.16), x[0]}), steels, x[1]);
    return polach_force<T>({x[2], x[3], x[4]}, {ellipse, table.at(ellipse.a, ellipse.b),
                                                steels.shear_modulus(), T(0.25), x[1]});
  };
  for (const std::array<double, 5> at : {std::array<double, 5>{3, 5e4, 1e-3, -5e-4, 0.2},
                                         {1.0, 2e4, 1e-4, 2e-3, -0.1},
                                         {35, 8e4, -5e-3, 1e-3, 1.0},
                                         {0.2, 8e4, -5e-4, 1e-3, 0.5}}) {
    std::array<Number, 5> dual;
    for (std::size_t i = 0; i < 5; ++i) dual[i] = Number(at[i], i);
    const auto lifted = chain(dual, Number(0));
    CHECK(lifted.lateral.value == Approx(chain(at, 0.0).lateral).epsilon(1e-13));
    for (std::size_t i = 0; i < 5; ++i) {
      CAPTURE(at[0], i);
      const auto along = [&](auto member) {
        return wheelrail_test::central_difference(
            [&](double x) {
              auto moved = at;
              moved[i] = x;
              return chain(moved, 0.0).*member;
            },
            at[i], 1e-3 * std::abs(at[i]));
      };
      const double scale = 12500 / std::abs(at[i]);
      CHECK(lifted.longitudinal.derivatives[i] ==
            Approx(along(&CreepForce<double>::longitudinal)).epsilon(1e-8).margin(1e-10 * scale));
      CHECK(lifted.lateral.derivatives[i] ==
            Approx(along(&CreepForce<double>::lateral)).epsilon(1e-8).margin(1e-10 * scale));
    }
  }
}

TEST_CASE("polach_force: the derivatives at rest are Kalker's coefficients", "[force][autodiff]") {
  using Number = wheelrail::Dual<double, 3>;
  const auto contact = example<double>();
  const double stiffness = contact.shear_modulus * 6e-3 * 4.5e-3;
  const auto f =
      polach_force<Number>({Number(0, 0), Number(0, 1), Number(0, 2)}, example<Number>());
  CHECK(f.longitudinal.derivatives[0] == Approx(-stiffness * contact.kalker.c11).epsilon(1e-14));
  CHECK(f.longitudinal.derivatives[1] == 0);
  CHECK(f.longitudinal.derivatives[2] == 0);
  CHECK(f.lateral.derivatives[0] == 0);
  CHECK(f.lateral.derivatives[1] == Approx(-stiffness * contact.kalker.c22).epsilon(1e-14));
  CHECK(f.lateral.derivatives[2] ==
        Approx(-stiffness * std::sqrt(2.7e-5) * contact.kalker.c23).epsilon(1e-14));
}

TEST_CASE("polach_force: any scalar, no allocation", "[force][no-alloc]") {
  const auto contact = example<double>();
  for (const Row& row : rows) {
    CAPTURE(row.longitudinal, row.lateral, row.spin);
    const auto f = polach_force({row.longitudinal, row.lateral, row.spin}, contact);
    const auto strict = polach_force(
        {StrictScalar(row.longitudinal), StrictScalar(row.lateral), StrictScalar(row.spin)},
        example<StrictScalar>());
    CHECK(strict.longitudinal.as_double() == f.longitudinal);
    CHECK(strict.lateral.as_double() == f.lateral);
    const auto less = polach_force({static_cast<float>(row.longitudinal),
                                    static_cast<float>(row.lateral), static_cast<float>(row.spin)},
                                   example<float>());
    CHECK(static_cast<double>(less.longitudinal) == Approx(f.longitudinal).epsilon(2e-6));
    CHECK(static_cast<double>(less.lateral) == Approx(f.lateral).epsilon(2e-5));
    const auto more =
        polach_force({static_cast<long double>(row.longitudinal),
                      static_cast<long double>(row.lateral), static_cast<long double>(row.spin)},
                     example<long double>());
    CHECK(static_cast<double>(more.longitudinal) == Approx(f.longitudinal).epsilon(1e-13));
    CHECK(static_cast<double>(more.lateral) == Approx(f.lateral).epsilon(1e-13));
  }
  double sum = 0;
  CHECK(wheelrail_test::allocations_of([&] {
          sum += polach_force({1e-3, 1e-3, 0.1}, contact).lateral;
        }) == 0);
  CHECK(sum < 0);
}
