#pragma once
/// @file
/// Smoothing splines: of all curves f the one with the least
///   sum_i w_i |y_i - f(x_i)|^2 + lambda integral |f^(m)(x)|^2 dx,
/// where m = 2 penalises the second derivative, C. H. Reinsch, Smoothing by spline functions,
/// Numerische Mathematik 10 (1967) 177-183, and m = 3 its change, I. J. Schoenberg, Spline functions
/// and the problem of graduation, Proceedings of the National Academy of Sciences 52 (1964) 947-950.
/// C. de Boor, A Practical Guide to Splines, chapter XIV. May include: core, numerics, std.

#include <array>
#include <string>
#include <utility>
#include <vector>
#include <wheelrail/core/require.hpp>
#include <wheelrail/numerics/bracketed_root.hpp>
#include <wheelrail/numerics/cubic_spline.hpp>

namespace wheelrail {

namespace detail {

template <Real T, class Value>
[[nodiscard]] T squared_norm(const Value& value) {
  if constexpr (Real<Value>) {
    return value * value;
  } else {
    T sum = T(0);
    for (Eigen::Index k = 0; k < value.size(); ++k) sum += value.coeff(k) * value.coeff(k);
    return sum;
  }
}

}  // namespace detail

/// What is kept small, in the mean square.
enum class SmoothingPenalty {
  second_derivative,  ///< m = 2; f'' is 0 at both ends, whatever the data say
  third_derivative    ///< m = 3; beyond the data f'' would stay as it is at the end
};

/// What a smoothing spline does to its data.
template <Real T, class Value = T>
struct SmoothedValues {
  std::vector<Value> fitted;     ///< f(x_i) [unit of the values]
  std::vector<Value> residuals;  ///< y_i - f(x_i) [unit of the values]
  /// f^(m) = sum_k penalized[k] N_k(x), N_k the B-spline of degree m - 1 over the nodes k to k + m:
  /// for m = 2 the second derivatives at the inner nodes [unit of the values / x^m].
  std::vector<Value> penalized;
};

/// The data of a smoothing spline, to be smoothed with any parameter in O(n) each: a system with m
/// diagonals on either side of the main one. Valid for good once constructed.
template <Real T, class Value = T>
class SmoothingProblem {
 public:
  /// @param nodes x_i, at least m + 1, finite and strictly increasing. @param values y_i, one per node,
  ///   finite. @param weights w_i, one per node, finite and > 0, as 1 / variance; none: all are 1.
  /// @throws std::invalid_argument naming the first node, value or weight that breaks this.
  SmoothingProblem(std::vector<T> nodes, std::vector<Value> values,
                   SmoothingPenalty penalty = SmoothingPenalty::second_derivative,
                   std::vector<T> weights = {})
      : nodes_(std::move(nodes)),
        values_(std::move(values)),
        weights_(std::move(weights)),
        order_(penalty == SmoothingPenalty::second_derivative ? 2 : 3) {
    const std::size_t n = nodes_.size();
    const std::string least = std::to_string(order_ + 1);
    const auto counts = [&](std::size_t others, const char* what) {
      return detail::joined({"smoothing spline: there are ", std::to_string(n), " nodes and ",
                             std::to_string(others), what});
    };
    detail::require(
        n > order_ && values_.size() == n,
        detail::joined({counts(values_.size(), " values, but must be as many, at least "), least}));
    detail::require(weights_.empty() || weights_.size() == n,
                    counts(weights_.size(), " weights, but must be as many, or none"));
    for (std::size_t i = 0; i < n; ++i) {
      const auto name = [i](const char* what) {
        return detail::joined({"smoothing spline: ", what, " ", std::to_string(i)});
      };
      if (!is_finite(nodes_[i])) detail::require_finite(name("node"), nodes_[i]);
      if (i > 0 && !(nodes_[i - 1] < nodes_[i])) {
        detail::require(false, name("node"), nodes_[i], "greater than the node before");
      }
      const T size = detail::squared_norm<T>(values_[i]);
      if (!is_finite(size)) detail::require(false, name("value"), size, "finite (its square)");
      if (!weights_.empty() && !(is_finite(weights_[i]) && T(0) < weights_[i])) {
        detail::require_positive(name("weight"), weights_[i], "[-]");
      }
    }
    for (std::size_t k = 0; k + order_ < n; ++k) differences_.push_back(difference_at(k));
    gram_ = gram();
  }

  [[nodiscard]] const std::vector<T>& nodes() const { return nodes_; }        ///< x_i
  [[nodiscard]] const std::vector<Value>& values() const { return values_; }  ///< y_i
  /// w_i; 1 where none were given.
  [[nodiscard]] T weight(std::size_t i) const { return weights_.empty() ? T(1) : weights_[i]; }

  /// @param smoothing_parameter lambda >= 0; 0 interpolates.
  /// @note O(n). The system is positive definite: L D L^T without pivots.
  [[nodiscard]] SmoothedValues<T, Value> smoothed(const T& smoothing_parameter) const {
    const std::size_t n = nodes_.size(), m = order_, rows = n - m;
    const Value zero = T(0) * values_.front();
    const std::vector<Difference>& difference = differences_;
    // (R + lambda Q^T W^-1 Q) p = Q^T y for the coefficients p of f^(m), as L D L^T.
    std::vector<Band> lower = gram_;
    std::vector<Value> p(rows, zero);
    for (std::size_t k = 0; k < rows; ++k) {
      for (std::size_t j = 0; j <= m; ++j) p[k] += difference[k][j] * values_[k + j];
      // lower[k][d] couples k with k - d.
      for (std::size_t d = 0; d <= m && d <= k; ++d) {
        T sum = T(0);
        for (std::size_t j = 0; j + d <= m; ++j) {
          sum += difference[k][j] * difference[k - d][j + d] / weight(k + j);
        }
        lower[k][d] += smoothing_parameter * sum;
      }
      for (std::size_t d = m; d > 0; --d) {
        if (k < d) continue;
        // From what couples k with k - d goes what both share with earlier rows.
        for (std::size_t e = d + 1; e <= m && e <= k; ++e) {
          lower[k][d] -= lower[k][e] * lower[k - e][0] * lower[k - d][e - d];
        }
        lower[k][d] = lower[k][d] / lower[k - d][0];
      }
      for (std::size_t d = 1; d <= m && d <= k; ++d) {
        lower[k][0] -= lower[k][d] * lower[k][d] * lower[k - d][0];
        p[k] -= lower[k][d] * p[k - d];
      }
    }
    for (std::size_t k = rows; k-- > 0;) {
      p[k] = (T(1) / lower[k][0]) * p[k];
      for (std::size_t d = 1; d <= m && k + d < rows; ++d) p[k] -= lower[k + d][d] * p[k + d];
    }
    // y - f = lambda W^-1 Q p
    SmoothedValues<T, Value> result{values_, std::vector<Value>(n, zero), std::move(p)};
    for (std::size_t k = 0; k < rows; ++k) {
      for (std::size_t j = 0; j <= m; ++j) {
        result.residuals[k + j] +=
            (smoothing_parameter * difference[k][j] / weight(k + j)) * result.penalized[k];
      }
    }
    for (std::size_t i = 0; i < n; ++i) result.fitted[i] -= result.residuals[i];
    return result;
  }

  /// The limit of an infinite parameter: the polynomial of degree m - 1 of least weighted squares.
  [[nodiscard]] SmoothedValues<T, Value> polynomial() const {
    const std::size_t n = nodes_.size();
    const Value zero = T(0) * values_.front();
    const T middle = nodes_.front() + (nodes_.back() - nodes_.front()) / T(2);
    const T scale = (nodes_.back() - nodes_.front()) / T(2);
    SmoothedValues<T, Value> result{std::vector<Value>(n, zero), values_,
                                    std::vector<Value>(n - order_, zero)};
    // Polynomials that are orthogonal on the nodes, by their recurrence: the one before, and that
    // of the degree. (Two vectors make g++ 12 warn of their memory where this is inlined.)
    std::vector<std::array<T, 2>> orthogonal(n, std::array<T, 2>{T(0), T(1)});
    T norm_before = T(1);
    for (std::size_t degree = 0; degree < order_; ++degree) {
      T norm = T(0), moment = T(0);
      Value product = zero;
      for (std::size_t i = 0; i < n; ++i) {
        const T x = (nodes_[i] - middle) / scale;
        const T& now = orthogonal[i][1];
        norm += weight(i) * now * now;
        moment += weight(i) * now * now * x;
        product += (weight(i) * now) * result.residuals[i];
      }
      for (std::size_t i = 0; i < n; ++i) {
        auto& [before, now] = orthogonal[i];
        const Value part = (now / norm) * product;
        result.fitted[i] += part;
        result.residuals[i] -= part;
        const T x = (nodes_[i] - middle) / scale;
        const T next =
            (x - moment / norm) * now - (degree == 0 ? T(0) : T(norm / norm_before)) * before;
        before = now;
        now = next;
      }
      norm_before = norm;
    }
    return result;
  }

  /// w h^(2m-1) with the mean weight and width h: a wave sin(k x) over nodes h apart is damped to
  /// 1 / (1 + (lambda h / w) k^(2m)), so that here the shortest waves begin to go.
  [[nodiscard]] T natural_parameter() const {
    T weights = T(0), count = T(0);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      weights += weight(i);
      count += T(1);
    }
    const T width = (nodes_.back() - nodes_.front()) / (count - T(1));
    T parameter = weights / count * width;
    for (std::size_t i = 1; i < order_; ++i) parameter *= width * width;
    return parameter;
  }

  /// sqrt(sum w_i |r_i|^2 / sum w_i) [unit of the values].
  [[nodiscard]] T weighted_rms(const std::vector<Value>& residuals) const {
    using std::sqrt;
    T sum = T(0), weights = T(0);
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      sum += weight(i) * detail::squared_norm<T>(residuals[i]);
      weights += weight(i);
    }
    return sqrt(T(sum / weights));
  }

  /// The C2 cubic spline of smoothed values: with m = 2 it is the minimizing curve itself, with m = 3
  /// the not-a-knot spline through that curve's points.
  [[nodiscard]] CubicSpline<T, Value> spline(const SmoothedValues<T, Value>& smoothed) const {
    if (order_ == 3) return CubicSpline<T, Value>(nodes_, smoothed.fitted);
    std::vector<Value> second(nodes_.size(), Value(T(0) * values_.front()));
    for (std::size_t k = 0; k < smoothed.penalized.size(); ++k) {
      second[k + 1] = smoothed.penalized[k];
    }
    return CubicSpline<T, Value>::natural_with(nodes_, smoothed.fitted, second);
  }

 private:
  static constexpr std::size_t greatest_order = 3;
  using Difference = std::array<T, greatest_order + 1>;
  using Band = std::array<T, greatest_order + 1>;

  // Row k of Q^T: (m-1)! (x_(k+m) - x_k) times the divided difference, the integral of N_k f^(m).
  [[nodiscard]] Difference difference_at(std::size_t k) const {
    Difference row;
    row.fill(T(0));
    const T factor = (nodes_[k + order_] - nodes_[k]) * (order_ == 3 ? T(2) : T(1));
    for (std::size_t j = 0; j <= order_; ++j) {
      T product = factor;
      for (std::size_t l = 0; l <= order_; ++l) {
        if (l != j) product /= nodes_[k + j] - nodes_[k + l];
      }
      row[j] = product;
    }
    return row;
  }

  // R: row k holds the integrals of N_k N_(k-d), d = 0 to m - 1.
  [[nodiscard]] std::vector<Band> gram() const {
    using std::sqrt;
    const std::size_t n = nodes_.size(), m = order_, rows = n - m;
    Band none;
    none.fill(T(0));
    std::vector<Band> integrals(rows, none);
    // Gauss' three points integrate the products of degree 4 at most exactly.
    const T reach = sqrt(T(T(3) / T(5)));
    const std::array<T, 3> places{-reach, T(0), reach};
    const std::array<T, 3> shares{T(5) / T(18), T(4) / T(9), T(5) / T(18)};
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const T width = nodes_[i + 1] - nodes_[i];
      for (std::size_t g = 0; g < places.size(); ++g) {
        const T x = nodes_[i] + width * (T(1) + places[g]) / T(2);
        // The B-splines i - m + 1 to i that are not 0 there, those that exist.
        const std::array<T, greatest_order> own = b_splines(i, x);
        for (std::size_t j = 0; j < m; ++j) {
          if (i + j + 1 < m || rows <= i + j + 1 - m) continue;
          const std::size_t k = i + j + 1 - m;
          for (std::size_t d = 0; d <= j && d <= k; ++d) {
            integrals[k][d] += width * shares[g] * own[j] * own[j - d];
          }
        }
      }
    }
    return integrals;
  }

  // At x between nodes i and i + 1: the value of B-spline i - m + 1 + j for j = 0 to m - 1, by the
  // recurrence of Cox and de Boor; 0 for those that would need nodes beyond the ends.
  [[nodiscard]] std::array<T, greatest_order> b_splines(std::size_t i, const T& x) const {
    std::array<T, greatest_order> values;
    values.fill(T(0));
    values[order_ - 1] = T(1);
    for (std::size_t degree = 1; degree < order_; ++degree) {
      for (std::size_t j = order_ - 1 - degree; j < order_; ++j) {
        // The B-spline of this degree over the nodes first to first + degree + 1.
        if (i + j + 1 < order_) continue;
        const std::size_t first = i + j + 1 - order_;
        if (nodes_.size() <= first + degree + 1) {
          values[j] = T(0);
          continue;
        }
        const T rising = (x - nodes_[first]) / (nodes_[first + degree] - nodes_[first]);
        T value = rising * values[j];
        if (j + 1 < order_) {
          value += (nodes_[first + degree + 1] - x) /
                   (nodes_[first + degree + 1] - nodes_[first + 1]) * values[j + 1];
        }
        values[j] = value;
      }
    }
    return values;
  }

  std::vector<T> nodes_;
  std::vector<Value> values_;
  std::vector<T> weights_;
  std::size_t order_;
  std::vector<Difference> differences_;  // Q^T
  std::vector<Band> gram_;               // R
};

/// How the smoothing parameter came about.
enum class SmoothingStatus {
  given,          ///< it was given
  at_noise,       ///< the deviation equals the noise level
  interpolating,  ///< the noise level is 0 or below rounding: the spline goes through the values
  polynomial  ///< even one polynomial of degree m - 1 deviates by no more than that: it is the fit
};

/// A smoothing spline and its parameter. Valid for good once constructed.
/// @note Queries do not allocate.
template <Real T, class Value = T>
class SmoothingSpline {
 public:
  /// With a given parameter. @param smoothing_parameter lambda [unit of w times x^(2m-1)].
  /// @throws std::invalid_argument unless it is finite and >= 0.
  SmoothingSpline(const SmoothingProblem<T, Value>& problem, const T& smoothing_parameter)
      : SmoothingSpline(problem, checked(smoothing_parameter),
                        problem.smoothed(smoothing_parameter), SmoothingStatus::given) {
    if (smoothing_parameter == T(0)) status_ = SmoothingStatus::interpolating;
  }

  /// The spline whose deviation from the data equals @p noise: the smoothest one that follows the
  /// data that closely (Reinsch's choice).
  /// @param noise the level that the deviation is brought to, to a part in 10^4 [unit of the values].
  /// @param deviation callable: SmoothedValues -> T, continuous, growing with the smoothing where
  ///   it is near the noise level.
  /// @throws std::invalid_argument unless noise is finite and >= 0.
  template <class Deviation>
  [[nodiscard]] static SmoothingSpline with_noise(const SmoothingProblem<T, Value>& problem,
                                                  const T& noise, Deviation&& deviation) {
    using std::exp;
    using std::log;
    detail::require_not_negative("smoothing spline: noise level", noise, "[unit of the values]");
    const auto with = [&](const T& lambda, SmoothingStatus status) {
      return SmoothingSpline(problem, lambda, problem.smoothed(lambda), status);
    };
    if (noise == T(0)) return with(T(0), SmoothingStatus::interpolating);
    if (!(noise < T(deviation(problem.polynomial())))) {
      return SmoothingSpline(problem, T(1) / T(0), problem.polynomial(),
                             SmoothingStatus::polynomial);
    }
    const auto excess = [&](const T& log_lambda) {
      return T(deviation(problem.smoothed(T(exp(log_lambda))))) / noise - T(1);
    };
    // From where the shortest waves begin to go, until the noise level is between two steps.
    const T step = log(T(32));
    T lower = log(problem.natural_parameter()), upper = lower;
    T at_lower = excess(lower), at_upper = at_lower;
    constexpr int maximum_steps = 100;
    for (int i = 0; i < maximum_steps && !(at_lower < T(0)); ++i) {
      upper = lower;
      at_upper = at_lower;
      lower -= step;
      at_lower = excess(lower);
    }
    for (int i = 0; i < maximum_steps && !(T(0) < at_upper); ++i) {
      lower = upper;
      at_lower = at_upper;
      upper += step;
      at_upper = excess(upper);
    }
    const auto root = bracketed_root<T>(
        [&](const T& log_lambda) { return excess(log_lambda); }, lower, upper, at_lower, at_upper,
        {.residual_tolerance = constant<T>(1e-4L), .maximum_iterations = 60});
    if (root.status == SolveStatus::no_bracket || root.status == SolveStatus::not_finite) {
      return at_lower < T(0) ? SmoothingSpline(problem, T(1) / T(0), problem.polynomial(),
                                               SmoothingStatus::polynomial)
                             : with(T(0), SmoothingStatus::interpolating);
    }
    return with(T(exp(root.position)), SmoothingStatus::at_noise);
  }

  /// The same with the weighted root mean square of the residuals as the deviation.
  [[nodiscard]] static SmoothingSpline with_noise(const SmoothingProblem<T, Value>& problem,
                                                  const T& noise) {
    return with_noise(problem, noise, [&](const SmoothedValues<T, Value>& values) {
      return problem.weighted_rms(values.residuals);
    });
  }

  [[nodiscard]] const CubicSpline<T, Value>& spline() const { return spline_; }  ///< the fit itself
  /// As CubicSpline has it. Outside the nodes the outermost cubics go on.
  [[nodiscard]] SplinePoint<Value> evaluate(const T& x) const { return spline_.evaluate(x); }
  /// y_i - f(x_i) [unit of the values].
  [[nodiscard]] const std::vector<Value>& residuals() const { return residuals_; }
  /// lambda [unit of w times x^(2m-1)]; infinite where the fit is one polynomial.
  [[nodiscard]] const T& smoothing_parameter() const { return smoothing_parameter_; }
  /// Of the residuals [unit of the values].
  [[nodiscard]] const T& weighted_rms() const { return weighted_rms_; }
  [[nodiscard]] SmoothingStatus status() const { return status_; }  ///< how lambda came about

 private:
  SmoothingSpline(const SmoothingProblem<T, Value>& problem, const T& smoothing_parameter,
                  SmoothedValues<T, Value>&& values, SmoothingStatus status)
      : spline_(problem.spline(values)),
        residuals_(std::move(values.residuals)),
        smoothing_parameter_(smoothing_parameter),
        weighted_rms_(problem.weighted_rms(residuals_)),
        status_(status) {}

  [[nodiscard]] static const T& checked(const T& smoothing_parameter) {
    detail::require_not_negative("smoothing spline: smoothing parameter", smoothing_parameter,
                                 "[unit of w times x^(2m-1)]");
    return smoothing_parameter;
  }

  CubicSpline<T, Value> spline_;
  std::vector<Value> residuals_;
  T smoothing_parameter_;
  T weighted_rms_;
  SmoothingStatus status_;
};

}  // namespace wheelrail
