#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <wheelrail/numerics/semidefinite_cholesky.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;

namespace {

using Solver = SemidefiniteCholesky<double, 12>;

class Random {
 public:
  double operator()() { return uniform_(engine_); }
  Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index columns) {
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [this] { return (*this)(); });
  }

 private:
  std::mt19937_64 engine_{20240701};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

}  // namespace

TEST_CASE("SemidefiniteCholesky: regular systems as Eigen solves them, in any units",
          "[numerics][semidefinite_cholesky][random]") {
  Random random;
  for (int n = 1; n <= 12; ++n) {
    for (int repeat = 0; repeat < 20; ++repeat) {
      const Eigen::MatrixXd j = random.matrix(n, n + 3);
      Eigen::VectorXd units(n);
      for (Eigen::Index i = 0; i < n; ++i) units(i) = std::pow(10.0, 6 * random());
      const Eigen::MatrixXd a = units.asDiagonal() * (j * j.transpose()) * units.asDiagonal();
      const Eigen::VectorXd x = units.cwiseInverse().asDiagonal() * random.matrix(n, 1);
      Solver::Matrix lower = a.triangularView<Eigen::Lower>();
      const Solver solver(lower);
      CHECK(solver.rank() == n);
      const Eigen::VectorXd error = units.asDiagonal() * (solver.solve(a * x) - x);
      CHECK(error.cwiseAbs().maxCoeff() < 1e-11);
    }
  }
}

TEST_CASE("SemidefiniteCholesky: finds the rank, and solves what is consistent",
          "[numerics][semidefinite_cholesky][random]") {
  Random random;
  for (int rank = 0; rank <= 6; ++rank) {
    for (int repeat = 0; repeat < 20; ++repeat) {
      const Eigen::MatrixXd j = random.matrix(10, 6).leftCols(rank) * random.matrix(rank, 8);
      const Eigen::MatrixXd a = j * j.transpose();
      const Solver solver{Solver::Matrix(a)};
      CHECK(solver.rank() == rank);
      const Eigen::VectorXd b = a * random.matrix(10, 1);
      const Eigen::VectorXd x = solver.solve(b);
      CHECK((a * x - b).norm() < 1e-9);
      CHECK((x.array() != 0.0).count() == rank);
    }
  }
}

TEST_CASE("SemidefiniteCholesky: a size known when compiled changes nothing, nor does pivoting",
          "[numerics][semidefinite_cholesky][random]") {
  using Known = SemidefiniteCholesky<double, 5, 5>;
  Random random;
  int regular = 0, pivoted = 0, singular = 0;
  for (int repeat = 0; repeat < 300; ++repeat) {
    // Rows ever closer to the span of the others, at last within it.
    Eigen::MatrixXd j = random.matrix(5, 8);
    const double off = repeat % 3 == 2 ? 0.0 : std::pow(10.0, -4.5 * std::abs(random()));
    for (Eigen::Index i = 3; i < 5; ++i) {
      j.row(i) = random.matrix(1, 3) * j.topRows(3) + off * j.row(i);
    }
    const Eigen::MatrixXd a = j * j.transpose();
    const Eigen::VectorXd b = a * random.matrix(5, 1);
    const Known known{Known::Matrix(a)};
    const Solver solver{Solver::Matrix(a)};
    CHECK(known.rank() == solver.rank());
    CHECK(known.solve(b) == solver.solve(b));
    const Eigen::VectorXd scale = a.diagonal().cwiseSqrt().cwiseInverse();
    const double determinant = (scale.asDiagonal() * a * scale.asDiagonal()).determinant();
    const bool is_far = std::sqrt(epsilon<double>()) < determinant;
    if (off == 0) CHECK(solver.rank() == 3);
    if (is_far) CHECK(solver.rank() == 5);
    if (solver.rank() == 5) CHECK((a * solver.solve(b) - b).norm() < 1e-12 * a.norm());
    ++(off == 0 ? singular : is_far ? regular : pivoted);
  }
  CHECK(std::min({regular, pivoted, singular}) > 30);
}

TEST_CASE("SemidefiniteCholesky: NaN comes back, nothing is allocated",
          "[numerics][semidefinite_cholesky][no-alloc]") {
  Solver::Matrix a = Solver::Matrix::Identity(3, 3);
  const Solver::Vector b = Solver::Vector::Ones(3);
  CHECK(wheelrail_test::allocations_of([&] { CHECK(Solver(a).solve(b) == b); }) == 0);
  a(1, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(is_finite(Solver(a).solve(b)(0)));
  a(1, 1) = std::numeric_limits<double>::infinity();
  CHECK_FALSE(is_finite(Solver(a).solve(b)(0)));
  CHECK(Solver(Solver::Matrix(0, 0)).solve(Solver::Vector(0)).size() == 0);
}

TEST_CASE("SemidefiniteCholesky: any scalar", "[numerics][semidefinite_cholesky]") {
  using T = wheelrail_test::StrictScalar;
  using S = SemidefiniteCholesky<T, 2>;
  S::Matrix a(2, 2);
  a << T(4), T(2), T(2), T(3);
  S::Vector b(2);
  b << T(8), T(8);
  const S::Vector x = S(a).solve(b);
  CHECK(x(0).as_double() == Approx(1.0).epsilon(1e-15));
  CHECK(x(1).as_double() == Approx(2.0).epsilon(1e-15));
}
