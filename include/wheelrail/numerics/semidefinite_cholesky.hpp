#pragma once
/// @file
/// Symmetric positive semi-definite systems A x = b of at most a fixed size, without heap: the
/// equations for Lagrange multipliers, where redundant constraints make A singular.
/// May include: core, Eigen, std.

#include <Eigen/Core>
#include <array>
#include <limits>
#include <type_traits>
#include <utility>
#include <wheelrail/core/assert.hpp>
#include <wheelrail/core/scalar.hpp>

namespace wheelrail {

/// Cholesky's factorisation P A P^T = L D L^T without square roots, with diagonal pivoting of A as if
/// scaled to a unit diagonal (N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed.
/// (2002), 10.3). With A = J J^T a scaled pivot is the squared sine of the angle between a row of J
/// and the span of the rows taken before it; the scaling makes that independent of the rows' units.
/// The factorisation stops at the first scaled pivot <= sqrt(epsilon<T>()), halfway in digits between
/// rounding and one: the rows that are left, within 1.2e-4 rad (double) of the others' span, count
/// as redundant.
///
/// Without pivoting comes first. No scaled pivot exceeds one, so that their product, which is the
/// determinant of the scaled A, is at most the least of them in any order: where it is above the
/// bound, all rows are independent by the rule above, and pivoting would only cost.
/// @tparam Size of all systems, where it is known: MaximumSize.
/// @note No allocation.
template <Real T, int MaximumSize, int Size = Eigen::Dynamic>
class SemidefiniteCholesky {
 public:
  /// A.
  using Matrix = Eigen::Matrix<T, Size, Size, Eigen::ColMajor, MaximumSize, MaximumSize>;
  /// b and x.
  using Vector = Eigen::Matrix<T, Size, 1, Eigen::ColMajor, MaximumSize, 1>;

  /// @param a symmetric, square; of any size up to MaximumSize. Only its lower triangle is read.
  explicit SemidefiniteCholesky(const Matrix& a) : factor_(a), inverses_(a.rows()) {
    using std::sqrt;
    WHEELRAIL_ASSERT(a.rows() == a.cols());
    start(a);
    const T smallest = sqrt(epsilon<T>());
    if (!finite_ || take_all_in_order(smallest)) return;
    factor_ = a;
    start(a);
    while (rank_ < a.rows() && take_pivot(smallest)) ++rank_;
  }

  /// How many rows are independent of each other.
  [[nodiscard]] Eigen::Index rank() const { return rank_; }

  /// x with A x = b in the independent rows and zero in the redundant ones: a solution of the whole
  /// where b is consistent. NaN where A or b is not finite.
  [[nodiscard]] Vector solve(const Vector& b) const {
    WHEELRAIL_ASSERT(b.size() == factor_.rows());
    Vector x =
        Vector::Constant(b.size(), finite_ ? T(0) : T(std::numeric_limits<double>::quiet_NaN()));
    if (!finite_) return x;
    Vector z(b.size());
    const auto substitute = [&](auto count) {
      for_each(count, [&](auto at) {
        const Eigen::Index i = at;
        z(i) = b(place(i));
      });
      for_each(count, [&](auto at) {
        const Eigen::Index j = at;
        const T z_j = z(j);
        for (Eigen::Index i = j + 1; i < count; ++i) z(i) -= factor_(i, j) * z_j;
      });
      for_each(count, [&](auto at) {
        const Eigen::Index j = count - 1 - at;
        T z_j = z(j) * inverses_(j);
        for (Eigen::Index i = j + 1; i < count; ++i) z_j -= factor_(i, j) * z(i);
        z(j) = z_j;
        x(place(j)) = z_j;
      });
    };
    if (rank_ == b.size()) {
      substitute(count_of(b));
    } else {
      substitute(rank_);
    }
    return x;
  }

 private:
  template <Eigen::Index value>
  using Constant = std::integral_constant<Eigen::Index, value>;

  /// The number of @p rows, as a type where it is known: loops over it are unrolled.
  [[nodiscard]] static auto count_of(const Vector& rows) {
    if constexpr (Size == Eigen::Dynamic) {
      return rows.size();
    } else {
      return Constant<Size>{};
    }
  }

  static void for_each(Eigen::Index count, const auto& act) {
    for (Eigen::Index i = 0; i < count; ++i) act(i);
  }
  template <Eigen::Index count>
  static void for_each(Constant<count>, const auto& act) {
    [&act]<Eigen::Index... i>(std::integer_sequence<Eigen::Index, i...>) {
      (act(Constant<i>{}), ...);
    }
    (std::make_integer_sequence<Eigen::Index, count>{});
  }

  /// Where the row that is now at @p i stands in A.
  [[nodiscard]] Eigen::Index place(Eigen::Index i) const {
    return order_[static_cast<std::size_t>(i)];
  }

  /// Nothing is factorised yet.
  void start(const Matrix& a) {
    rank_ = 0;
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      const T& diagonal = a(i, i);
      order_[static_cast<std::size_t>(i)] = i;
      finite_ = finite_ && wheelrail::is_finite(diagonal);
      inverses_(i) = T(0) < diagonal ? T(T(1) / diagonal) : T(0);
    }
  }

  /// All columns without pivoting. @return false, and all has to be started again, unless the
  /// product of the scaled pivots stays above @p smallest.
  bool take_all_in_order(const T& smallest) {
    T product = T(1);
    bool regular = true;
    for_each(count_of(inverses_), [&](auto at) {
      const Eigen::Index k = at;
      product *= factor_(k, k) * inverses_(k);
      regular = regular && smallest < product;
      if (regular) eliminate(at);
    });
    if (regular) rank_ = factor_.rows();
    return regular;
  }

  /// Column rank_ of the factor. @return false, and nothing changes, where all that is left is at
  /// most @p smallest.
  bool take_pivot(const T& smallest) {
    const Eigen::Index k = rank_, n = factor_.rows();
    Eigen::Index pivot = k;
    T greatest = factor_(k, k) * inverses_(k);
    for (Eigen::Index i = k + 1; i < n; ++i) {
      const T scaled = factor_(i, i) * inverses_(i);
      if (!(greatest < scaled)) continue;
      greatest = scaled;
      pivot = i;
    }
    if (greatest <= smallest) return false;
    if (pivot != k) swap(k, pivot);
    eliminate(k);
    return true;
  }

  /// Divides the @p column by its pivot and takes its part out of the columns behind.
  void eliminate(auto column) {
    const Eigen::Index k = column;
    const Eigen::Index n = factor_.rows();
    const T inverse = T(1) / factor_(k, k);
    inverses_(k) = inverse;
    for (Eigen::Index j = k + 1; j < n; ++j) {
      const T l = factor_(j, k) * inverse;
      for (Eigen::Index i = j; i < n; ++i) factor_(i, j) -= factor_(i, k) * l;
      factor_(j, k) = l;
    }
  }

  /// Rows and columns @p k < @p other, in the lower triangle alone.
  void swap(Eigen::Index k, Eigen::Index other) {
    using std::swap;
    for (Eigen::Index j = 0; j < k; ++j) swap(factor_(k, j), factor_(other, j));
    swap(factor_(k, k), factor_(other, other));
    for (Eigen::Index i = k + 1; i < other; ++i) swap(factor_(i, k), factor_(other, i));
    for (Eigen::Index i = other + 1; i < factor_.rows(); ++i)
      swap(factor_(i, k), factor_(i, other));
    swap(inverses_(k), inverses_(other));
    swap(order_[static_cast<std::size_t>(k)], order_[static_cast<std::size_t>(other)]);
  }

  Matrix factor_;    ///< L below the diagonal of the first rank_ columns
  Vector inverses_;  ///< of D in the first rank_ rows, of A's diagonal (zero for zero) in the rest
  std::array<Eigen::Index, static_cast<std::size_t>(MaximumSize)> order_;
  Eigen::Index rank_ = 0;
  bool finite_ = true;
};

}  // namespace wheelrail
