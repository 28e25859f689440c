#pragma once
/// @file
/// Symmetric positive semi-definite systems A x = b of at most a fixed size, without heap: the
/// equations for Lagrange multipliers, where redundant constraints make A singular.
/// May include: core, Eigen, std.

#include <Eigen/Core>
#include <array>
#include <limits>
#include <utility>
#include <wheelrail/core/assert.hpp>
#include <wheelrail/core/scalar.hpp>

namespace wheelrail {

/// Cholesky's factorisation with diagonal pivoting of A scaled to a unit diagonal (N. J. Higham,
/// Accuracy and Stability of Numerical Algorithms, 2nd ed. (2002), 10.3). With A = J J^T a pivot is
/// the squared sine of the angle between a row of J and the span of the rows taken before it; the
/// scaling makes that independent of the rows' units. The factorisation stops at the first pivot
/// <= sqrt(epsilon<T>()), halfway in digits between rounding and one: the rows that are left,
/// within 1.2e-4 rad (double) of the others' span, count as redundant.
/// @note No allocation.
template <Real T, int MaximumSize>
class SemidefiniteCholesky {
 public:
  using Matrix =
      Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, MaximumSize, MaximumSize>;
  using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1, Eigen::ColMajor, MaximumSize, 1>;

  /// @param a symmetric, square; of any size up to MaximumSize. Only its lower triangle is read.
  explicit SemidefiniteCholesky(const Matrix& a) : factor_(a), scale_(a.rows()) {
    using std::sqrt;
    WHEELRAIL_ASSERT(a.rows() == a.cols());
    const Eigen::Index n = a.rows();
    for (Eigen::Index i = 0; i < n; ++i) {
      order_[static_cast<std::size_t>(i)] = i;
      finite_ = finite_ && wheelrail::is_finite(a(i, i));
      scale_(i) = T(0) < a(i, i) ? T(T(1) / sqrt(a(i, i))) : T(0);
    }
    for (Eigen::Index j = 0; j < n; ++j) {
      for (Eigen::Index i = j; i < n; ++i) {
        factor_(i, j) = scale_(i) * a(i, j) * scale_(j);
        factor_(j, i) = factor_(i, j);
      }
    }
    const T smallest = sqrt(epsilon<T>());
    while (finite_ && rank_ < n && take_pivot(smallest)) ++rank_;
  }

  /// How many rows are independent of each other.
  [[nodiscard]] Eigen::Index rank() const { return rank_; }

  /// x with A x = b in the independent rows and zero in the redundant ones: a solution of the whole
  /// where b is consistent. NaN where A or b is not finite.
  [[nodiscard]] Vector solve(const Vector& b) const {
    WHEELRAIL_ASSERT(b.size() == factor_.rows());
    const Eigen::Index n = b.size();
    Vector x = Vector::Constant(n, finite_ ? T(0) : T(std::numeric_limits<double>::quiet_NaN()));
    if (!finite_) return x;
    Vector z(rank_);
    for (Eigen::Index i = 0; i < rank_; ++i) {
      T sum = scale_(place(i)) * b(place(i));
      for (Eigen::Index j = 0; j < i; ++j) sum -= factor_(i, j) * z(j);
      z(i) = sum / factor_(i, i);
    }
    for (Eigen::Index i = rank_ - 1; 0 <= i; --i) {
      for (Eigen::Index j = i + 1; j < rank_; ++j) z(i) -= factor_(j, i) * z(j);
      z(i) /= factor_(i, i);
      x(place(i)) = scale_(place(i)) * z(i);
    }
    return x;
  }

 private:
  /// Where the row that is now at @p i stands in A.
  [[nodiscard]] Eigen::Index place(Eigen::Index i) const {
    return order_[static_cast<std::size_t>(i)];
  }

  /// Column rank_ of the factor. @return false, and nothing changes, where all that is left is at
  /// most @p smallest.
  bool take_pivot(const T& smallest) {
    using std::sqrt;
    const Eigen::Index k = rank_, n = factor_.rows();
    Eigen::Index pivot = k;
    for (Eigen::Index i = k + 1; i < n; ++i) {
      if (factor_(pivot, pivot) < factor_(i, i)) pivot = i;
    }
    if (factor_(pivot, pivot) <= smallest) return false;
    if (pivot != k) {  // both triangles of what is left, and the rows of the factor
      factor_.row(k).swap(factor_.row(pivot));
      factor_.col(k).swap(factor_.col(pivot));
      std::swap(order_[static_cast<std::size_t>(k)], order_[static_cast<std::size_t>(pivot)]);
    }
    factor_(k, k) = sqrt(factor_(k, k));
    for (Eigen::Index i = k + 1; i < n; ++i) factor_(i, k) /= factor_(k, k);
    for (Eigen::Index j = k + 1; j < n; ++j) {
      for (Eigen::Index i = k + 1; i < n; ++i) factor_(i, j) -= factor_(i, k) * factor_(j, k);
    }
    return true;
  }

  Matrix factor_;  ///< L in the lower triangle of the first rank_ columns
  Vector scale_;
  std::array<Eigen::Index, static_cast<std::size_t>(MaximumSize)> order_{};
  Eigen::Index rank_ = 0;
  bool finite_ = true;
};

}  // namespace wheelrail
