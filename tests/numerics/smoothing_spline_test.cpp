#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>
#include <wheelrail/core/vector.hpp>
#include <wheelrail/numerics/smoothing_spline.hpp>

#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::StrictScalar;

namespace {

constexpr SmoothingPenalty penalties[] = {SmoothingPenalty::second_derivative,
                                          SmoothingPenalty::third_derivative};

struct Data {
  std::vector<double> nodes, values, weights;
};

// Unequal widths, values of a sine with noise, weights within a factor of ten.
Data some_data(int count, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
  Data data;
  double x = -1;
  for (int i = 0; i < count; ++i) {
    data.nodes.push_back(x);
    data.values.push_back(std::sin(1.3 * x) + 0.2 * (uniform() - 0.5));
    data.weights.push_back(0.3 + 3 * uniform());
    x += 0.05 + 0.2 * uniform();
  }
  return data;
}

// The divided difference of g over nodes[first .. last], by its recursion.
template <class G>
double divided(const std::vector<double>& nodes, std::size_t first, std::size_t last, const G& g) {
  if (first == last) return g(first);
  return (divided(nodes, first + 1, last, g) - divided(nodes, first, last - 1, g)) /
         (nodes[last] - nodes[first]);
}

// f at the nodes by dense matrices: B-splines as divided differences of truncated powers, their
// products integrated by Simpson's rule.
std::vector<double> dense_solution(const Data& data, std::size_t m, double lambda) {
  const std::size_t n = data.nodes.size(), rows = n - m;
  const auto b_spline = [&](std::size_t k, double x) {
    return (data.nodes[k + m] - data.nodes[k]) * divided(data.nodes, k, k + m, [&](std::size_t i) {
             const double ahead = data.nodes[i] - x;
             return ahead > 0 ? std::pow(ahead, static_cast<double>(m - 1)) : 0.0;
           });
  };
  const auto index = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
  Eigen::MatrixXd q = Eigen::MatrixXd::Zero(index(n), index(rows));
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(index(rows), index(rows));
  for (std::size_t k = 0; k < rows; ++k) {
    for (std::size_t i = k; i <= k + m; ++i) {
      q(index(i), index(k)) =
          (m == 3 ? 2 : 1) * (data.nodes[k + m] - data.nodes[k]) *
          divided(data.nodes, k, k + m, [&](std::size_t j) { return j == i ? 1.0 : 0.0; });
    }
    for (std::size_t l = k; l < std::min(rows, k + m); ++l) {
      double sum = 0;
      for (std::size_t i = l; i < k + m; ++i) {
        constexpr int steps = 64;
        const double width = data.nodes[i + 1] - data.nodes[i];
        for (int s = 0; s <= steps; ++s) {
          const double x = data.nodes[i] + width * s / steps;
          const double share = s == 0 || s == steps ? 1 : (s % 2 == 1 ? 4 : 2);
          sum += share * width / (3 * steps) * b_spline(k, x) * b_spline(l, x);
        }
      }
      gram(index(k), index(l)) = gram(index(l), index(k)) = sum;
    }
  }
  const Eigen::VectorXd y =
      Eigen::Map<const Eigen::VectorXd>(data.values.data(), index(data.values.size()));
  const Eigen::VectorXd w =
      Eigen::Map<const Eigen::VectorXd>(data.weights.data(), index(data.weights.size()));
  // The least of |y - f|^2_W + lambda f^T Q R^-1 Q^T f, whatever R + lambda Q^T W^-1 Q is.
  const Eigen::MatrixXd penalty = q * gram.ldlt().solve(q.transpose());
  const Eigen::MatrixXd system = Eigen::MatrixXd(w.asDiagonal()) + lambda * penalty;
  const Eigen::VectorXd f = system.ldlt().solve(Eigen::VectorXd(w.asDiagonal() * y));
  return {f.data(), f.data() + f.size()};
}

template <class T>
std::vector<T> converted(const std::vector<double>& values) {
  std::vector<T> result;
  for (const double value : values) result.push_back(T(value));
  return result;
}

template <class Function>
std::string message_of(Function&& function) {
  try {
    function();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace

TEST_CASE("SmoothingProblem: agrees with a dense solve of the penalised least squares",
          "[numerics][reference]") {
  for (const SmoothingPenalty penalty : penalties) {
    for (const double lambda : {1e-6, 1e-3, 0.1, 10.0}) {
      for (const int count : {4, 5, 7, 30}) {
        const Data data = some_data(count, 7);
        const std::size_t m = penalty == SmoothingPenalty::second_derivative ? 2 : 3;
        const SmoothingProblem<double> problem(data.nodes, data.values, penalty, data.weights);
        const auto smoothed = problem.smoothed(lambda);
        const auto expected = dense_solution(data, m, lambda);
        for (std::size_t i = 0; i < expected.size(); ++i) {
          CAPTURE(m, lambda, count, i);
          // Simpson's rule is exact but for degree 4, to (1/64)^4; the conditions reach 1e6.
          CHECK(smoothed.fitted[i] == Approx(expected[i]).margin(2e-8).epsilon(0));
          CHECK(smoothed.fitted[i] + smoothed.residuals[i] ==
                Approx(data.values[i]).margin(1e-15).epsilon(0));
        }
      }
    }
  }
}

TEST_CASE("SmoothingSpline: a parameter of 0 is the natural spline through the values",
          "[numerics]") {
  const Data data = some_data(40, 3);
  const SmoothingSpline<double> spline(SmoothingProblem<double>(data.nodes, data.values), 0.0);
  const CubicSpline<double> natural(data.nodes, data.values, SplineEnd::natural);
  CHECK(spline.status() == SmoothingStatus::interpolating);
  CHECK(spline.weighted_rms() == 0);
  for (int i = 0; i <= 500; ++i) {
    const double x = data.nodes.front() + (data.nodes.back() - data.nodes.front()) * i / 500;
    const auto own = spline.evaluate(x), other = natural.evaluate(x);
    CHECK(own.value == Approx(other.value).margin(1e-14).epsilon(0));
    CHECK(own.slope == Approx(other.slope).margin(1e-12).epsilon(0));
    CHECK(own.second_derivative == Approx(other.second_derivative).margin(1e-11).epsilon(0));
  }
}

TEST_CASE("SmoothingSpline: polynomials below the penalised degree are kept", "[numerics]") {
  for (const SmoothingPenalty penalty : penalties) {
    const bool bends = penalty == SmoothingPenalty::third_derivative;
    Data data = some_data(50, 4);
    const auto parabola = [&](double x) { return 0.3 - 2 * x + (bends ? 1.5 * x * x : 0); };
    for (std::size_t i = 0; i < data.nodes.size(); ++i) data.values[i] = parabola(data.nodes[i]);
    const SmoothingProblem<double> problem(data.nodes, data.values, penalty, data.weights);
    for (const double lambda : {1e-3, 1.0, 1e3}) {
      const SmoothingSpline<double> spline(problem, lambda);
      for (double x = -1; x < data.nodes.back(); x += 0.01) {
        CAPTURE(bends, lambda, x);
        CHECK(spline.evaluate(x).value == Approx(parabola(x)).margin(1e-10).epsilon(0));
      }
    }
    const auto limit = problem.polynomial();
    for (std::size_t i = 0; i < data.nodes.size(); ++i) {
      CHECK(limit.fitted[i] == Approx(data.values[i]).margin(1e-12).epsilon(0));
    }
  }
}

TEST_CASE("SmoothingProblem: the limit of a great parameter is the least squares polynomial",
          "[numerics]") {
  for (const SmoothingPenalty penalty : penalties) {
    const Data data = some_data(40, 5);
    const SmoothingProblem<double> problem(data.nodes, data.values, penalty, data.weights);
    const auto limit = problem.polynomial();
    const auto near_limit = problem.smoothed(1e7);
    double bent = 0;
    for (std::size_t i = 0; i < data.nodes.size(); ++i) {
      CHECK(near_limit.fitted[i] == Approx(limit.fitted[i]).margin(2e-6).epsilon(0));
      bent = std::max(bent, std::abs(limit.residuals[i]));
    }
    CHECK(bent > 0.1);
    // Its residuals are orthogonal to 1, x and for m = 3 to x^2.
    for (int power = 0; power < (penalty == SmoothingPenalty::third_derivative ? 3 : 2); ++power) {
      double sum = 0;
      for (std::size_t i = 0; i < data.nodes.size(); ++i) {
        sum += data.weights[i] * limit.residuals[i] * std::pow(data.nodes[i], power);
      }
      CHECK(std::abs(sum) < 1e-10);
    }
  }
}

TEST_CASE("SmoothingProblem: a wave is damped to 1 / (1 + lambda h k^(2m))",
          "[numerics][reference]") {
  for (const SmoothingPenalty penalty : penalties) {
    const int m = penalty == SmoothingPenalty::second_derivative ? 2 : 3;
    const double h = 0.01, k = 4.0;
    std::vector<double> nodes, values;
    for (int i = -1000; i <= 1000; ++i) {
      nodes.push_back(h * i);
      values.push_back(std::cos(k * nodes.back()));
    }
    const SmoothingProblem<double> problem(nodes, values, penalty);
    // Halved; the ends are many wavelengths away, and (k h)^2 = 0.0016 is left out.
    const auto smoothed = problem.smoothed(1 / (h * std::pow(k, 2 * m)));
    for (std::size_t i = 900; i <= 1100; ++i) {
      CHECK(smoothed.fitted[i] == Approx(0.5 * values[i]).margin(1e-3).epsilon(0));
    }
  }
}

TEST_CASE("SmoothingSpline: the curve is C2 at its nodes", "[numerics]") {
  for (const SmoothingPenalty penalty : penalties) {
    const Data data = some_data(60, 6);
    const SmoothingProblem<double> problem(data.nodes, data.values, penalty, data.weights);
    const auto spline = SmoothingSpline<double>::with_noise(problem, 0.05);
    for (std::size_t i = 1; i + 1 < data.nodes.size(); ++i) {
      const double x = data.nodes[i], below = std::nextafter(x, -10.0);
      CAPTURE(i);
      const auto left = spline.evaluate(below), right = spline.evaluate(x);
      CHECK(left.value == Approx(right.value).margin(1e-14).epsilon(0));
      CHECK(left.slope == Approx(right.slope).margin(1e-12).epsilon(0));
      CHECK(left.second_derivative == Approx(right.second_derivative).margin(1e-10).epsilon(0));
      CHECK(right.value + spline.residuals()[i] == Approx(data.values[i]).margin(1e-14).epsilon(0));
    }
  }
}

TEST_CASE("SmoothingSpline: the deviation equals the noise level that is asked for", "[numerics]") {
  for (const SmoothingPenalty penalty : penalties) {
    const Data data = some_data(200, 8);
    const SmoothingProblem<double> problem(data.nodes, data.values, penalty, data.weights);
    double before = 0;
    for (const double noise : {1e-6, 1e-3, 0.03, 0.058, 0.2}) {
      CAPTURE(noise);
      const auto spline = SmoothingSpline<double>::with_noise(problem, noise);
      CHECK(spline.status() == SmoothingStatus::at_noise);
      CHECK(spline.weighted_rms() == Approx(noise).epsilon(1.1e-4));
      CHECK(spline.smoothing_parameter() > before);
      before = spline.smoothing_parameter();
    }
    const auto through = SmoothingSpline<double>::with_noise(problem, 0.0);
    CHECK(through.status() == SmoothingStatus::interpolating);
    CHECK(through.weighted_rms() == 0);
    const auto one = SmoothingSpline<double>::with_noise(problem, 100.0);
    CHECK(one.status() == SmoothingStatus::polynomial);
    CHECK(std::isinf(one.smoothing_parameter()));
    CHECK(one.weighted_rms() ==
          Approx(problem.weighted_rms(problem.polynomial().residuals)).epsilon(1e-12));
  }
}

TEST_CASE("SmoothingSpline: noise on a sine is taken away", "[numerics][random]") {
  // 12 uniform numbers have a variance of 1. The noise level of 1000 of them is known to 1/sqrt(2000);
  // the deviation that it lacks, or that the some 20 freedoms of the curve take, is made up by a bias:
  // sqrt(4/sqrt(2000) + 20/1000) = 0.33 of it where it is off by twice that.
  std::mt19937 random(9);
  std::vector<double> nodes, values;
  for (int i = 0; i < 1000; ++i) {
    nodes.push_back(0.01 * i);
    double sum = -6;
    for (int k = 0; k < 12; ++k) sum += static_cast<double>(random()) / 4294967296.0;
    values.push_back(std::sin(nodes.back()) + 0.01 * sum);
  }
  for (const SmoothingPenalty penalty : penalties) {
    const auto spline =
        SmoothingSpline<double>::with_noise(SmoothingProblem<double>(nodes, values, penalty), 0.01);
    double sum = 0;
    for (const double x : nodes) sum += std::pow(spline.evaluate(x).value - std::sin(x), 2);
    CHECK(std::sqrt(sum / 1000) < 0.33 * 0.01);
  }
}

TEST_CASE("SmoothingSpline: vectors are smoothed component by component", "[numerics]") {
  const Data data = some_data(40, 10);
  std::vector<Vector2<double>> points;
  for (const double value : data.values) points.emplace_back(value, 3 - 2 * value);
  for (const SmoothingPenalty penalty : penalties) {
    const SmoothingSpline<double, Vector2<double>> both(
        SmoothingProblem<double, Vector2<double>>(data.nodes, points, penalty, data.weights), 0.01);
    const SmoothingSpline<double> one(
        SmoothingProblem<double>(data.nodes, data.values, penalty, data.weights), 0.01);
    for (double x = -1; x < data.nodes.back(); x += 0.05) {
      CHECK(both.evaluate(x).value.x() == Approx(one.evaluate(x).value).margin(1e-14));
      CHECK(both.evaluate(x).value.y() == Approx(3 - 2 * one.evaluate(x).value).margin(1e-12));
    }
  }
}

TEST_CASE("SmoothingSpline: float and long double agree with double, a strict scalar exactly",
          "[numerics]") {
  const Data data = some_data(60, 11);
  for (const SmoothingPenalty penalty : penalties) {
    const auto fit = [&](auto zero) {
      using T = decltype(zero);
      const SmoothingProblem<T> problem(converted<T>(data.nodes), converted<T>(data.values),
                                        penalty, converted<T>(data.weights));
      return SmoothingSpline<T>::with_noise(problem, T(0.05));
    };
    const auto in_double = fit(0.0);
    const auto in_float = fit(0.0F);
    const auto in_long = fit(0.0L);
    const auto strict = fit(StrictScalar(0.0));
    CHECK(strict.smoothing_parameter().as_double() == in_double.smoothing_parameter());
    for (double x = -1; x < data.nodes.back(); x += 0.05) {
      const auto expected = in_double.evaluate(x);
      CHECK(strict.evaluate(StrictScalar(x)).value.as_double() == expected.value);
      // The float's parameter is found to a part in 10^4 too, but not in the same place.
      CHECK(static_cast<double>(in_float.evaluate(static_cast<float>(x)).value) ==
            Approx(expected.value).margin(1e-3).epsilon(0));
      CHECK(static_cast<double>(in_long.evaluate(static_cast<long double>(x)).value) ==
            Approx(expected.value).margin(1e-10).epsilon(0));
    }
  }
}

TEST_CASE("SmoothingSpline: bad data are named", "[numerics][bad-input]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using Problem = SmoothingProblem<double>;
  const std::vector<double> four{0, 1, 2, 3};
  const auto third = SmoothingPenalty::third_derivative;
  const auto second = SmoothingPenalty::second_derivative;
  CHECK(message_of([] {
          Problem({0, 1}, {0, 1});
        }) == "smoothing spline: there are 2 nodes and 2 values, but must be as many, at least 3");
  CHECK(message_of([&] {
          Problem({0, 1, 2}, {0, 1, 2}, third);
        }) == "smoothing spline: there are 3 nodes and 3 values, but must be as many, at least 4");
  CHECK(message_of([&] {
          Problem(four, {0, 1, 2});
        }) == "smoothing spline: there are 4 nodes and 3 values, but must be as many, at least 3");
  CHECK(message_of([&] {
          Problem(four, four, second, {1, 1});
        }) == "smoothing spline: there are 4 nodes and 2 weights, but must be as many, or none");
  CHECK(message_of([&] {
          Problem({0, 1, 1, 2}, four);
        }) == "smoothing spline: node 2 is 1, but must be greater than the node before");
  CHECK(message_of([&] {
          Problem({0, nan, 1, 2}, four);
        }) == "smoothing spline: node 1 is nan, but must be finite");
  CHECK(message_of([&] {
          Problem(four, {0, 1, 2, nan});
        }) == "smoothing spline: value 3 is nan, but must be finite (its square)");
  CHECK(message_of([&] {
          Problem(four, four, second, {1, 0, 1, 1});
        }) == "smoothing spline: weight 1 is 0, but must be finite and > 0 [-]");
  CHECK(message_of([&] { SmoothingSpline<double>(Problem(four, four), -1.0); }) ==
        "smoothing spline: smoothing parameter is -1, but must be finite and >= 0 "
        "[unit of w times x^(2m-1)]");
  CHECK(message_of([&] { (void)SmoothingSpline<double>::with_noise(Problem(four, four), nan); }) ==
        "smoothing spline: noise level is nan, but must be finite and >= 0 [unit of the values]");
}
