#include <limits>
#include <wheelrail/force/material.hpp>

#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::StrictScalar;

TEST_CASE("steel: Table 1's modulus and Poisson ratio, and the shear modulus that follows",
          "[force][reference]") {
  CHECK(steel<double>().young_modulus == 206e9);
  CHECK(steel<double>().poisson_ratio == 0.296);
  // 206 GPa / (2 * 1.296)
  CHECK(shear_modulus(steel<double>()) == Approx(7.947530864197531e10).epsilon(1e-15));
}

TEST_CASE("MaterialPair: like materials keep their own constants", "[force]") {
  const MaterialPair<double> pair;
  CHECK(pair.shear_modulus() == Approx(shear_modulus(steel<double>())).epsilon(1e-15));
  CHECK(pair.poisson_ratio() == Approx(0.296).epsilon(1e-15));
  // (70) twice: 2 (1 - 0.296^2) / (pi 206e9)
  CHECK(pair.compliance() ==
        Approx(2 * (1 - 0.296 * 0.296) / (pi<double>() * 206e9)).epsilon(1e-15));
  CHECK(pair.effective_modulus() == Approx(206e9 / (2 * 0.912384)).epsilon(1e-15));
}

TEST_CASE("MaterialPair: unlike materials combine by Kalker's rules", "[force]") {
  // Shear moduli 40 and 120 GPa: 1/G = (1/40 + 1/120)/2 = 1/60; nu/G = (0.25/40 + 0.3/120)/2.
  const Material<double> soft{100e9, 0.25};
  const Material<double> hard{312e9, 0.3};
  const MaterialPair<double> pair(soft, hard);
  CHECK(pair.shear_modulus() == Approx(60e9).epsilon(1e-15));
  CHECK(pair.poisson_ratio() == Approx(60 * (0.25 / 40 + 0.3 / 120) / 2).epsilon(1e-15));
  CHECK(1 / pair.effective_modulus() == Approx(0.9375 / 100e9 + 0.91 / 312e9).epsilon(1e-15));

  const MaterialPair<double> exchanged(hard, soft);
  CHECK(exchanged.compliance() == pair.compliance());
  CHECK(exchanged.shear_modulus() == pair.shear_modulus());
  CHECK(exchanged.poisson_ratio() == pair.poisson_ratio());
}

TEST_CASE("MaterialPair: bad materials are named with the broken rule", "[force][bad-input]") {
  const auto good = steel<double>();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH(MaterialPair<double>({-1, 0.3}, good),
                    "wheel material: Young's modulus is -1, but must be finite and > 0 [Pa]");
  CHECK_THROWS_WITH(MaterialPair<double>(good, {2e11, 0.5}),
                    "rail material: Poisson's ratio is 0.5, but must be in [0, 0.5) [-]");
  CHECK_THROWS_AS(MaterialPair<double>(good, {0, 0.3}), std::invalid_argument);
  CHECK_THROWS_AS(MaterialPair<double>(good, {infinity, 0.3}), std::invalid_argument);
  CHECK_THROWS_AS(MaterialPair<double>({2e11, -0.01}, good), std::invalid_argument);
  CHECK_THROWS_AS(MaterialPair<double>({2e11, nan}, good), std::invalid_argument);
  CHECK_THROWS_AS(MaterialPair<double>({nan, 0.3}, good), std::invalid_argument);
  CHECK_NOTHROW(MaterialPair<double>({2e11, 0.0}, good));
}

TEST_CASE("MaterialPair: any scalar", "[force]") {
  const MaterialPair<double> pair;
  CHECK(static_cast<double>(MaterialPair<float>().compliance()) ==
        Approx(pair.compliance()).epsilon(1e-6));
  CHECK(static_cast<double>(MaterialPair<long double>().poisson_ratio()) ==
        Approx(pair.poisson_ratio()).epsilon(1e-15));
  CHECK(MaterialPair<StrictScalar>().shear_modulus().as_double() == pair.shear_modulus());
}
