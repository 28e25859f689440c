#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>
#include <wheelrail/core/vector.hpp>
#include <wheelrail/numerics/cubic_spline.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/numeric_difference.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;

namespace {

using Nodes = std::vector<double>;

Nodes values_of(double (*f)(double), const Nodes& nodes) {
  Nodes values;
  for (const double x : nodes) values.push_back(f(x));
  return values;
}

Nodes equal_nodes(double lower, double upper, int intervals) {
  Nodes nodes;
  for (int i = 0; i <= intervals; ++i) nodes.push_back(lower + (upper - lower) * i / intervals);
  return nodes;
}

const Nodes uneven{-1.0, -0.7, 0.2, 0.25, 1.5, 2.0, 4.0};

double cubic(double x) {
  return 2.0 - 3.0 * x + 0.5 * x * x - 0.25 * x * x * x;
}
double cubic_slope(double x) {
  return -3.0 + x - 0.75 * x * x;
}
double wave(double x) {
  return std::sin(x);
}

template <class Spline>
void check_cubic(const Spline& spline) {
  for (double x = -1.5; x < 4.5; x += 0.09) {
    CAPTURE(x);
    const auto at = spline.evaluate(x);
    CHECK(std::abs(at.value - cubic(x)) < 1e-13 * 20);
    CHECK(std::abs(at.slope - cubic_slope(x)) < 1e-13 * 20);
    CHECK(std::abs(at.second_derivative - (1.0 - 1.5 * x)) < 1e-12);
  }
}

double worst_error(const CubicSpline<double>& spline) {
  double worst = 0.0;
  for (double x = spline.lower(); x < spline.upper(); x += 1e-3) {
    worst = std::max(worst, std::abs(spline.evaluate(x).value - wave(x)));
  }
  return worst;
}

template <class Make>
std::string message_of(const Make& make) {
  try {
    make();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("CubicSpline: cubics come back exactly, not-a-knot and clamped, outside too",
          "[numerics][cubic_spline]") {
  for (const Nodes& nodes : {uneven, equal_nodes(-1.0, 4.0, 9), equal_nodes(-1.0, 4.0, 3)}) {
    const Nodes values = values_of(cubic, nodes);
    check_cubic(CubicSpline<double>(nodes, values));
    check_cubic(CubicSpline<double>(nodes, values, cubic_slope(-1.0), cubic_slope(4.0)));
  }
  check_cubic(CubicSpline<double>({-1, 0.5, 4}, values_of(cubic, {-1, 0.5, 4}), cubic_slope(-1.0),
                                  cubic_slope(4.0)));
}

TEST_CASE("CubicSpline: a natural spline is straight beyond its ends' curvature",
          "[numerics][cubic_spline]") {
  for (const Nodes& nodes : {uneven, equal_nodes(-1.0, 4.0, 9)}) {
    const CubicSpline<double> spline(nodes, values_of(wave, nodes), SplineEnd::natural);
    CHECK(spline.evaluate(-1.0).second_derivative == 0.0);
    CHECK(std::abs(spline.evaluate(4.0).second_derivative) < 1e-15);
    CHECK(std::abs(spline.evaluate(2.0).second_derivative) > 0.1);
  }
  // Three nodes, by hand: m1 = 3 (chord difference) / (2 h) with h = 1: 1.5 * (-1 - 1) = -3.
  const CubicSpline<double> hat({0, 1, 2}, {0, 1, 0}, SplineEnd::natural);
  CHECK(hat.evaluate(1.0).second_derivative == Approx(-3.0));
  CHECK(hat.evaluate(0.5).value == Approx(0.6875));
}

TEST_CASE("CubicSpline: nodes are met, value and two derivatives are continuous there",
          "[numerics][cubic_spline]") {
  for (const Nodes& nodes : {uneven, equal_nodes(-1.0, 4.0, 40)}) {
    const Nodes values = values_of(wave, nodes);
    for (const auto& spline : {CubicSpline<double>(nodes, values),
                               CubicSpline<double>(nodes, values, SplineEnd::natural),
                               CubicSpline<double>(nodes, values, std::cos(-1.0), std::cos(4.0))}) {
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        CHECK(std::abs(spline.evaluate(nodes[i]).value - values[i]) < 1e-15);
        const auto before = spline.evaluate(std::nextafter(nodes[i], -9.0));
        const auto after = spline.evaluate(std::nextafter(nodes[i], 9.0));
        CHECK(std::abs(before.value - after.value) < 1e-14);
        CHECK(std::abs(before.slope - after.slope) < 1e-13);
        CHECK(std::abs(before.second_derivative - after.second_derivative) < 1e-12);
      }
      const auto value = [&](double x) { return spline.evaluate(x).value; };
      const auto slope = [&](double x) { return spline.evaluate(x).slope; };
      for (const double x : {-0.93, 0.1, 0.231, 1.21, 3.06}) {
        const auto at = spline.evaluate(x);
        CHECK(std::abs(at.slope - wheelrail_test::central_difference(value, x, 1e-3)) < 1e-11);
        CHECK(std::abs(at.second_derivative - wheelrail_test::central_difference(slope, x, 1e-3)) <
              1e-11);
      }
    }
  }
}

TEST_CASE("CubicSpline: the error falls with the fourth power of the spacing",
          "[numerics][cubic_spline]") {
  double before = 0.0;
  for (const int intervals : {20, 40, 80}) {
    const Nodes nodes = equal_nodes(0.0, 6.0, intervals);
    const double error =
        worst_error(CubicSpline<double>(nodes, values_of(wave, nodes), 1.0, std::cos(6.0)));
    if (before > 0.0) CHECK(before / error == Approx(16.0).epsilon(0.05));
    before = error;
  }
  CHECK(before < 1.01 * std::pow(6.0 / 80, 4) / 384);  // de Boor: 1/384 h^4 |f''''| per interval
}

TEST_CASE("CubicSpline: equally spaced nodes, nearly equal ones and a search agree",
          "[numerics][cubic_spline]") {
  using wheelrail_test::StrictScalar;
  // StrictScalar has no division into an interval: it always searches.
  Nodes jittered = equal_nodes(0.0, 7.0, 700);
  for (std::size_t i = 1; i + 1 < jittered.size(); ++i) jittered[i] += i % 3 == 0 ? 4e-6 : -4e-6;
  for (const Nodes& nodes : {equal_nodes(0.0, 7.0, 700), equal_nodes(-3.0, 0.1, 31), jittered}) {
    const Nodes values = values_of(wave, nodes);
    const CubicSpline<double> fast(nodes, values);
    std::vector<StrictScalar> strict_nodes, strict_values;
    for (const double x : nodes) strict_nodes.emplace_back(x);
    for (const double y : values) strict_values.emplace_back(y);
    const CubicSpline<StrictScalar> strict(strict_nodes, strict_values);
    Nodes points{-100.0, 100.0};
    for (const double x : nodes) {
      for (const double y : {x, std::nextafter(x, -9.0), std::nextafter(x, 9.0), x + 0.003}) {
        points.push_back(y);
      }
    }
    for (const double x : points) {
      const auto a = fast.evaluate(x);
      const auto b = strict.evaluate(StrictScalar(x));
      if (a.value == b.value.as_double() && a.slope == b.slope.as_double() &&
          a.second_derivative == b.second_derivative.as_double()) {
        continue;
      }
      FAIL_CHECK("differs at " << x);
    }
  }
}

TEST_CASE("CubicSpline: vectors are interpolated component by component",
          "[numerics][cubic_spline]") {
  const Nodes nodes = equal_nodes(0.0, 3.0, 12);
  std::vector<Vector3<double>> points;
  Nodes first, third;
  for (const double x : nodes) {
    points.emplace_back(std::sin(x), x, std::exp(x));
    first.push_back(std::sin(x));
    third.push_back(std::exp(x));
  }
  const CubicSpline<double, Vector3<double>> spline(nodes, points);
  const CubicSpline<double> a(nodes, first), c(nodes, third);
  for (const double x : {0.1, 1.49, 2.9}) {
    const auto at = spline.evaluate(x);
    CHECK(std::abs(at.value.x() - a.evaluate(x).value) < 1e-15);
    CHECK(std::abs(at.value.y() - x) < 1e-15);
    CHECK(std::abs(at.slope.y() - 1.0) < 1e-14);
    CHECK(std::abs(at.value.z() - c.evaluate(x).value) < 1e-14);
    CHECK(std::abs(at.second_derivative.z() - c.evaluate(x).second_derivative) < 1e-13);
  }
}

TEST_CASE("CubicSpline: the first columns alone are those of the whole, bit for bit",
          "[numerics][cubic_spline]") {
  using Node = Eigen::Matrix<double, 2, 3, Eigen::DontAlign>;
  std::vector<Node> values;
  for (const double x : uneven) {
    Node node;
    node << cubic(x), wave(x), x * x, wave(2 * x), -x, cubic(-x);
    values.push_back(node);
  }
  const CubicSpline<double, Node> spline(uneven, values);
  for (const double x : {-2.0, -1.0, -0.8, 0.2, 0.21, 3.0, 4.0, 5.0}) {
    const auto whole = spline.evaluate(x);
    const auto all = spline.evaluate_columns<3>(x);
    const auto two = spline.evaluate_columns<2>(x);
    CHECK(all.value == whole.value);
    CHECK(all.slope == whole.slope);
    CHECK(two.value == whole.value.leftCols<2>());
    CHECK(two.slope == whole.slope.leftCols<2>());
  }
}

TEST_CASE("CubicSpline: queries do not allocate and pass NaN on",
          "[numerics][cubic_spline][no-alloc]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const CubicSpline<double> equal(equal_nodes(0, 1, 9), Nodes(10, 1.0));
  const CubicSpline<double> search(uneven, Nodes(7, 1.0));
  double sum = 0.0;
  CHECK(wheelrail_test::allocations_of([&] {
          for (double x = -1.0; x < 2.0; x += 0.01) {
            sum += equal.evaluate(x).value + search.evaluate(x).value;
          }
        }) == 0);
  CHECK(sum == Approx(600.0).epsilon(0.01));
  CHECK(std::isnan(equal.evaluate(nan).value));
  CHECK(std::isnan(search.evaluate(nan).slope + search.evaluate(nan).value));
}

TEST_CASE("CubicSpline: bad data is refused with its place",
          "[numerics][cubic_spline][bad-input]") {
  using Catch::Matchers::ContainsSubstring;
  using Spline = CubicSpline<double>;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto message = [](const Nodes& nodes, const Nodes& values) {
    return message_of([&] { Spline(nodes, values); });
  };
  CHECK(message({0, 1, 2, 3}, {1, 2, 3, 4}).empty());
  CHECK_THAT(message({0, 1, 2, 3}, {1, 2, 3}), ContainsSubstring("4 nodes and 3 values"));
  CHECK_THAT(message({0, 1, 2}, {1, 2, 3}), ContainsSubstring("at least 4"));
  CHECK_THAT(message({}, {}), ContainsSubstring("0 nodes"));
  CHECK_THAT(message({0, 1, 1, 3}, {1, 2, 3, 4}),
             ContainsSubstring("node 2 is 1") && ContainsSubstring("greater"));
  CHECK_THAT(message({0, 1, nan, 3}, {1, 2, 3, 4}), ContainsSubstring("node 2 is nan"));
  CHECK_THAT(message({0, 1, 2, 3}, {1, nan, 3, 4}), ContainsSubstring("value 1 is nan"));
  CHECK_THAT(message_of([] {
               Spline({0, 1}, {1, 2}, SplineEnd::natural);
             }),
             ContainsSubstring("at least 3"));
  CHECK_THAT(message_of([&] {
               Spline({0, 1, 2}, {1, 2, 3}, 0.0, nan);
             }),
             ContainsSubstring("slope at the end is nan"));
  std::vector<Vector3<double>> points(4, Vector3<double>::Zero());
  points[3].y() = nan;
  CHECK_THAT(message_of([&] {
               CubicSpline<double, Vector3<double>>({0, 1, 2, 3}, points);
             }),
             ContainsSubstring("value 3, component 1 is nan"));
}
