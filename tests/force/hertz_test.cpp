#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <wheelrail/force/hertz.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/numeric_difference.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::StrictScalar;

namespace {

// theta [deg] of (77), m, n, C: exact elliptic integrals in 30-digit arithmetic, at the angles of
// the classical table.
struct Coefficients {
  double theta, m, n, c;
};
constexpr Coefficients coefficients[] = {
    {0.5, 60.96897815, 0.1021851585, 13.753782},
    {1, 36.9319403, 0.1312949292, 7.552640175},
    {1.5, 27.4752363, 0.1522262725, 5.344466227},
    {2, 22.24316988, 0.169191264, 4.192081615},
    {3, 16.47746741, 0.1965970361, 2.98905894},
    {4, 13.29245688, 0.2189194883, 2.359074072},
    {6, 9.78829925, 0.2552236263, 1.699217875},
    {8, 7.856044354, 0.2850613264, 1.352557988},
    {10, 6.611455262, 0.310983497, 1.136749874},
    {20, 3.816011224, 0.4121497359, 0.6783684528},
    {30, 2.730648123, 0.4930597933, 0.5142419656},
    {35, 2.396134871, 0.5305674675, 0.4663568956},
    {40, 2.135709104, 0.5672886334, 0.4304574228},
    {45, 1.926462133, 0.6038281103, 0.4028275639},
    {50, 1.754148304, 0.6406854174, 0.3812013708},
    {55, 1.609409392, 0.6783034698, 0.3641216556},
    {60, 1.485823962, 0.717099922, 0.3506137835},
    {65, 1.378826052, 0.7574898675, 0.3400075912},
    {70, 1.285070844, 0.7999044745, 0.3318347101},
    {75, 1.202044783, 0.8448083236, 0.3257668888},
    {80, 1.127816338, 0.8927174373, 0.3215779465},
    {85, 1.060871197, 0.9442197611, 0.3191201375},
    {90, 1, 1, 0.3183098862},
};

// A/B, C, minor over major axis, m, n, from the same computation, at the ratios of Goldsmith's
// table (Impact, 1960). Its own C are within 0.2 % but for 0.0311 (-1.8 %) and 0.00765 (+0.7 %).
struct Goldsmith {
  double ratio, c, axis_ratio, m, n;
};
constexpr Goldsmith goldsmith[] = {
    {1, 0.3183098862, 1, 1, 1},
    {0.7041, 0.3215776338, 0.7915538831, 1.12780968, 0.8927221313},
    {0.4903, 0.3318339795, 0.6224673419, 1.285061754, 0.7999089744},
    {0.3333, 0.3506197209, 0.4825961032, 1.485880854, 0.7170803102},
    {0.2174, 0.381217937, 0.3651935368, 1.754284284, 0.6406532822},
    {0.1325, 0.4304350936, 0.2656535313, 2.135543633, 0.5673147073},
    {0.0718, 0.5142347852, 0.1805701776, 2.730598797, 0.4930647096},
    {0.0311, 0.6783015827, 0.1080238752, 3.815582172, 0.4121739722},
    {0.00765, 1.136993322, 0.04702180992, 6.612880356, 0.3109496031},
};

// Radii [m] of a wheel along the rolling and of a rail across it, both flat the other way; steel on
// steel (206 GPa, 0.296) under 50 kN: semi-axes [mm], greatest pressure [MPa], approach [mm] and
// stiffness [N/m^1.5], from the same computation. 0: no value.
struct Worked {
  double wheel, rail, a, b, pressure, approach, stiffness;
};
constexpr Worked worked[] = {
    {0.43, 0.3, 5.540231, 4.358716, 988.610, 0.067355, 9.0451597e10},
    {0.43, 0.08, 6.626291, 2.188114, 1646.535, 0.080980, 6.8613117e10},
    {0.43, 0.013, 7.838743, 0.832400, 3658.751, 0.098098, 5.1460934e10},
    {0.43, 0.43, 5.227332, 5.227332, 0, 0.0635465, 0},
};

const MaterialPair<double> steels;
constexpr double force = 50e3;

HertzCurvatures<double> of_angle(double theta) {
  const double cosine = std::cos(theta * pi<double>() / 180);
  return {(1 - cosine) / 2, (1 + cosine) / 2};
}

// The table goes below the default bound of B - A, never below that of B.
constexpr HertzOptions<double> unbounded{.minimum_lateral_curvature = 1e-9};

}  // namespace

TEST_CASE("hertz_shape: m, n and C over the angle are the exact ones", "[force][reference]") {
  for (const Coefficients& row : coefficients) {
    CAPTURE(row.theta);
    const auto shape = hertz_shape(of_angle(row.theta), unbounded);
    CHECK(shape.status == HertzStatus::regular);
    CHECK(shape.iterations <= 3);
    CHECK(shape.major_coefficient() == Approx(row.m).epsilon(1e-9));
    CHECK(shape.minor_coefficient() == Approx(row.n).epsilon(1e-9));
    CHECK(shape.stiffness_coefficient == Approx(row.c).epsilon(1e-7));
  }
}

TEST_CASE("hertz_shape: C at Goldsmith's curvature ratios is the exact one", "[force][reference]") {
  for (const Goldsmith& row : goldsmith) {
    CAPTURE(row.ratio);
    const auto shape = hertz_shape<double>({row.ratio, 1.0});
    CHECK(shape.stiffness_coefficient == Approx(row.c).epsilon(1e-9));
    CHECK(shape.axis_ratio == Approx(row.axis_ratio).epsilon(1e-9));
    CHECK(shape.major_coefficient() == Approx(row.m).epsilon(1e-9));
    CHECK(shape.minor_coefficient() == Approx(row.n).epsilon(1e-9));
  }
}

TEST_CASE("hertz_shape: one Newton step up to a curvature ratio of 100, few beyond", "[force]") {
  for (int i = 0; i <= 120; ++i) {
    const double ratio = std::pow(10.0, i / 20.0);
    CAPTURE(ratio);
    const int limit = ratio <= 100 ? 1 : 3;
    CHECK(hertz_shape<double>({1.0, ratio}).iterations <= limit);
    CHECK(hertz_shape<double>({ratio, 1.0}).iterations <= limit);
  }
}

TEST_CASE("hertz_ellipse: wheels on rails of the worked examples", "[force][reference]") {
  for (const Worked& row : worked) {
    CAPTURE(row.rail);
    const auto shape = hertz_shape(hertz_curvatures(1 / row.wheel, 0.0, 0.0, 1 / row.rail));
    const auto ellipse = hertz_ellipse(shape, steels, force);
    CHECK(ellipse.a * 1e3 == Approx(row.a).epsilon(1e-6));
    CHECK(ellipse.b * 1e3 == Approx(row.b).epsilon(1e-6));
    CHECK(hertz_approach(shape, steels, force) * 1e3 == Approx(row.approach).epsilon(1e-5));
    if (row.pressure == 0) continue;
    CHECK(maximum_pressure(ellipse, force) * 1e-6 == Approx(row.pressure).epsilon(1e-6));
    CHECK(hertz_stiffness(shape, steels) == Approx(row.stiffness).epsilon(1e-7));
  }
}

TEST_CASE("hertz_ellipse: exchanging the two directions exchanges the axes", "[force][symmetry]") {
  for (const double ratio : {1.0, 1.0001, 2.0, 33.0}) {
    CAPTURE(ratio);
    const auto along = hertz_shape<double>({1.2, 1.2 * ratio});
    const auto across = hertz_shape<double>({1.2 * ratio, 1.2});
    const auto first = hertz_ellipse(along, steels, force);
    const auto second = hertz_ellipse(across, steels, force);
    CHECK(along.rolling_is_major);
    CHECK(across.rolling_is_major == (ratio == 1.0));
    CHECK(first.a == Approx(second.b).epsilon(1e-15));
    CHECK(first.b == Approx(second.a).epsilon(1e-15));
    CHECK(first.a >= first.b);
    CHECK(hertz_stiffness(along, steels) == Approx(hertz_stiffness(across, steels)).epsilon(1e-15));
  }
}

TEST_CASE("hertz_ellipse: smooth where A passes B", "[force]") {
  const auto a = [](double x) {
    return hertz_ellipse(hertz_shape<double>({1.0, x}), steels, force).a;
  };
  const double before = wheelrail_test::central_difference(a, 1 - 4e-3, 1e-3);
  const double at = wheelrail_test::central_difference(a, 1.0, 1e-3);
  const double after = wheelrail_test::central_difference(a, 1 + 4e-3, 1e-3);
  CHECK(at > 0);
  CHECK(at == Approx((before + after) / 2).epsilon(1e-4));
}

TEST_CASE("hertz: elastic energy, force and approach hold together", "[force]") {
  // A Hertzian contact's force is 2/3 of the greatest pressure on the ellipse, and K d^1.5.
  for (const double ratio : {0.05, 0.4, 1.0, 7.0, 300.0}) {
    CAPTURE(ratio);
    const auto shape = hertz_shape<double>({1.0, ratio}, unbounded);
    const auto ellipse = hertz_ellipse(shape, steels, force);
    const double approach = hertz_approach(shape, steels, force);
    CHECK(hertz_stiffness(shape, steels) * std::pow(approach, 1.5) == Approx(force).epsilon(1e-14));
    CHECK(maximum_pressure(ellipse, force) * 2 / 3 * pi<double>() * ellipse.a * ellipse.b ==
          Approx(force).epsilon(1e-14));
    // approach = 3 F K(e) / (2 pi E* major): Johnson (4.26c), K(e) by another way.
    const double major = std::max(ellipse.a, ellipse.b);
    const double first = complete_elliptic(shape.axis_ratio).first;
    CHECK(approach ==
          Approx(3 * force * first / (2 * pi<double>() * steels.effective_modulus() * major))
              .epsilon(1e-14));
  }
}

TEST_CASE("hertz_shape: a lateral curvature below the bound is bounded and reported",
          "[force][bad-input]") {
  const auto bound = hertz_shape<double>({1.16, 0.25});
  CHECK(bound.status == HertzStatus::regular);
  for (const double lateral : {0.2499, 0.0, -3.0}) {
    CAPTURE(lateral);
    const auto shape = hertz_shape<double>({1.16, lateral});
    CHECK(shape.status == HertzStatus::lateral_curvature_bounded);
    CHECK(shape.axis_ratio == bound.axis_ratio);
    CHECK(shape.curvature_sum == bound.curvature_sum);
    CHECK_FALSE(shape.rolling_is_major);
  }
  const auto other = hertz_shape<double>({1.16, 0.3}, {.minimum_lateral_curvature = 0.5});
  CHECK(other.status == HertzStatus::lateral_curvature_bounded);
  CHECK(other.curvature_sum == 1.66);
  CHECK(std::string(name_of(other.status)) == "lateral_curvature_bounded");
}

TEST_CASE("hertz_shape: with a width, the bound is approached without a kink", "[force]") {
  const HertzOptions<double> options{.minimum_lateral_curvature = 0.25, .bound_width = 0.2};
  const auto sum = [&](double lateral) {
    return hertz_shape<double>({1.16, lateral}, options).curvature_sum - 1.16;
  };
  CHECK(sum(-3.0) == Approx(0.25));
  CHECK(sum(0.05) == Approx(0.25));
  CHECK(sum(0.25) == Approx(0.25 + 0.2 / 4));
  CHECK(sum(0.4501) == Approx(0.4501));
  // Slopes from 0 to 1, as a parabola has them.
  for (const double lateral : {0.0, 0.05, 0.1, 0.25, 0.4, 0.45, 0.5}) {
    CAPTURE(lateral);
    const double slope = (sum(lateral + 1e-7) - sum(lateral - 1e-7)) / 2e-7;
    CHECK(slope == Approx(std::clamp((lateral - 0.05) / 0.4, 0.0, 1.0)).margin(1e-6));
  }
  CHECK(hertz_shape<double>({1.16, 0.24}, options).status ==
        HertzStatus::lateral_curvature_bounded);
  CHECK_THROWS_AS(validate(HertzOptions<double>{.bound_width = -0.1}), std::invalid_argument);
}

TEST_CASE("hertz_shape: what is no contact gives a status and no number", "[force][bad-input]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const HertzCurvatures<double> bad :
       {HertzCurvatures<double>{nan, 1}, {1, nan}, {infinity, 1}, {1, infinity}}) {
    const auto shape = hertz_shape(bad);
    CHECK(shape.status == HertzStatus::not_finite);
    CHECK(std::isnan(hertz_stiffness(shape, steels)));
  }
  for (const double flat : {0.0, -1.0}) {
    const auto shape = hertz_shape<double>({flat, 1.0});
    CHECK(shape.status == HertzStatus::no_longitudinal_curvature);
    CHECK(std::isnan(hertz_ellipse(shape, steels, force).a));
  }
  CHECK_THROWS_WITH(validate(HertzOptions<double>{.minimum_lateral_curvature = 0}),
                    "Hertz: minimum lateral curvature is 0, but must be finite and > 0 [1/m]");
  CHECK_NOTHROW(validate(HertzOptions<double>{}));
}

TEST_CASE("hertz_ellipse: no force is an empty ellipse without NaN", "[force]") {
  const auto shape = hertz_shape<double>({1.16, 3.0});
  const auto ellipse = hertz_ellipse(shape, steels, 0.0);
  CHECK(ellipse.a == 0);
  CHECK(ellipse.b == 0);
  CHECK(hertz_approach(shape, steels, 0.0) == 0);
  CHECK(maximum_pressure(ellipse, 0.0) == 0);
  // The axes fall with the cube root of the force.
  CHECK(hertz_ellipse(shape, steels, 1e-6).a * 2000 ==
        Approx(hertz_ellipse(shape, steels, 8e3).a).epsilon(1e-14));
}

TEST_CASE("hertz: any scalar, no allocation", "[force][no-alloc]") {
  for (const double ratio : {1.0, 1.3, 33.0, 1e5, 1e12}) {
    CAPTURE(ratio);
    const auto shape = hertz_shape<double>({1.0, ratio});
    const auto more = hertz_shape<long double>({1.0L, static_cast<long double>(ratio)});
    const auto less = hertz_shape<float>({1.0F, static_cast<float>(ratio)});
    CHECK(shape.status == HertzStatus::regular);
    CHECK(shape.axis_ratio == Approx(static_cast<double>(more.axis_ratio)).epsilon(1e-14));
    CHECK(static_cast<double>(less.axis_ratio) == Approx(shape.axis_ratio).epsilon(5e-6));
    const auto strict = hertz_shape<StrictScalar>({StrictScalar(1), StrictScalar(ratio)});
    CHECK(strict.axis_ratio.as_double() == shape.axis_ratio);
    const auto ellipse = hertz_ellipse(strict, MaterialPair<StrictScalar>(), StrictScalar(force));
    CHECK(ellipse.a.as_double() == hertz_ellipse(shape, steels, force).a);
  }
  double sum = 0;
  CHECK(wheelrail_test::allocations_of([&] {
          const auto shape = hertz_shape<double>({1.16, 3.0});
          sum += hertz_ellipse(shape, steels, force).a + hertz_stiffness(shape, steels);
        }) == 0);
  CHECK(sum > 0);
}
