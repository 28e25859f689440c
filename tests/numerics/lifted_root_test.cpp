#include <Eigen/Core>
#include <cmath>
#include <unsupported/Eigen/AutoDiff>
#include <wheelrail/numerics/lifted_root.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

using Dual = Eigen::AutoDiffScalar<Eigen::Vector2d>;
using SecondOrder = Eigen::AutoDiffScalar<Eigen::Matrix<Dual, 2, 1>>;

// x^2 + b x - c, whose positive root has derivatives in closed form.
template <class T>
auto quadratic(const T& b, const T& c) {
  return [b, c](const T& x) { return ValueAndSlope<T>{T(x * x + b * x - c), T(T(2) * x + b)}; };
}

}  // namespace

TEST_CASE("lifted_root: has the derivatives of the root and its value", "[numerics][autodiff]") {
  const Dual b(3.0, 2, 0), c(4.0, 2, 1);  // root 1
  const Dual x = lifted_root<Dual>(1.0, quadratic(b, c));
  CHECK(x.value() == 1.0);
  // x' = -x / (2 x + b) by b, 1 / (2 x + b) by c.
  CHECK(x.derivatives()(0) == Approx(-0.2).epsilon(1e-15));
  CHECK(x.derivatives()(1) == Approx(0.2).epsilon(1e-15));
}

TEST_CASE("lifted_root: second derivatives of nested dual numbers", "[numerics][autodiff]") {
  SecondOrder b(Dual(3.0, 2, 0), 2, 0), c(Dual(4.0, 2, 1), 2, 1);
  const SecondOrder x = lifted_root<SecondOrder>(1.0, quadratic(b, c));
  CHECK(x.value().value() == 1.0);
  CHECK(x.derivatives()(1).value() == Approx(0.2).epsilon(1e-15));
  // d2 x / d c2 = -2 / (2 x + b)^3, and d2 x / d b d c = -(2 x' + 1) / (2 x + b)^2, x' = -0.2.
  CHECK(x.derivatives()(1).derivatives()(1) == Approx(-2.0 / 125).epsilon(1e-14));
  CHECK(x.derivatives()(1).derivatives()(0) == Approx(-0.6 / 25).epsilon(1e-14));
  CHECK(x.derivatives()(0).derivatives()(1) == Approx(-0.6 / 25).epsilon(1e-14));
}

TEST_CASE("lifted_root: without derivatives it is the root, and f is not called", "[numerics]") {
  int calls = 0;
  const double x = lifted_root<double>(0.3, [&](double) {
    ++calls;
    return ValueAndSlope<double>{};
  });
  CHECK(x == 0.3);
  CHECK(calls == 0);
}

TEST_CASE("lifted_root: a double root has no derivatives", "[numerics][autodiff]") {
  const Dual b(0.0, 2, 0), c(0.0, 2, 1);
  CHECK(!std::isfinite(lifted_root<Dual>(0.0, quadratic(b, c)).derivatives()(1)));
}
