#pragma once
/// @file
/// The interpolating cubic spline through values at given nodes, with continuous second derivative:
/// C. de Boor, A Practical Guide to Splines, chapter IV. May include: core, numerics, std.

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>
#include <wheelrail/core/require.hpp>

namespace wheelrail {

/// What closes the spline at its ends. A clamped one has a constructor of its own.
enum class SplineEnd {
  natural,    ///< the second derivative is 0: at least 3 nodes
  not_a_knot  ///< the outer two intervals share one cubic, so cubics are exact: at least 4 nodes
};

/// A spline's value and derivatives, all from one evaluation.
template <class Value>
struct SplinePoint {
  Value value;              ///< [unit of the values]
  Value slope;              ///< d value / d x
  Value second_derivative;  ///< d2 value / d x2
};

/// The first columns of a spline's matrix, and their derivatives.
template <Real T, int rows, int columns>
struct SplineColumns {
  Eigen::Matrix<T, rows, columns, Eigen::DontAlign> value;  ///< [unit of the values]
  Eigen::Matrix<T, rows, columns, Eigen::DontAlign> slope;  ///< d value / d x
};

/// A C2 spline of scalars, or of fixed-size Eigen matrices component by component. Valid for good
/// once constructed. @note Queries do not allocate. Differentiable in x and in the values.
template <Real T, class Value = T>
class CubicSpline {
 public:
  /// @param nodes finite and strictly increasing. @param values one per node, finite.
  /// @throws std::invalid_argument naming the first node or value that breaks this.
  CubicSpline(std::vector<T> nodes, std::vector<Value> values,
              SplineEnd end = SplineEnd::not_a_knot)
      : CubicSpline(std::move(nodes), std::move(values), end == SplineEnd::natural ? 3 : 4) {
    if (end == SplineEnd::natural) {
      const Value zero = T(0) * values_.front();
      solve({zero, T(0), T(0)}, {zero, T(0), T(0)});
    } else {
      const std::size_t n = nodes_.size();
      const T first = width(0) / width(1);
      const T last = width(n - 2) / width(n - 3);
      const Value zero = T(0) * values_.front();
      solve({zero, T(1) + first, -first}, {zero, T(1) + last, -last});
    }
  }

  /// Clamped: with given slopes at both ends; at least 3 nodes.
  CubicSpline(std::vector<T> nodes, std::vector<Value> values, const Value& slope_start,
              const Value& slope_end)
      : CubicSpline(std::move(nodes), std::move(values), 3) {
    require_finite_value("slope at the start", slope_start);
    require_finite_value("slope at the end", slope_end);
    const std::size_t n = nodes_.size();
    const T half = T(1) / T(2);
    solve({Value((T(3) / width(0)) * (chord(0) - slope_start)), -half, T(0)},
          {Value((T(3) / width(n - 2)) * (slope_end - chord(n - 2))), -half, T(0)});
  }

  /// The natural spline whose second derivatives at the nodes are known, as a smoothing spline's are;
  /// no system is solved, so nothing is lost to rounding.
  /// @param second_derivatives one per node, finite. @pre They are those of the natural spline through
  ///   the values: otherwise the slope jumps at the nodes.
  [[nodiscard]] static CubicSpline natural_with(std::vector<T> nodes, std::vector<Value> values,
                                                const std::vector<Value>& second_derivatives) {
    CubicSpline spline(std::move(nodes), std::move(values), 3);
    const std::size_t n = spline.nodes_.size();
    detail::require(n == second_derivatives.size(),
                    detail::joined({"cubic spline: there are ", std::to_string(n), " nodes and ",
                                    std::to_string(second_derivatives.size()),
                                    " second derivatives, but must be as many"}));
    for (std::size_t i = 0; i < n; ++i) {
      require_finite_value("second derivative", i, second_derivatives[i]);
    }
    spline.make_cubics(second_derivatives);
    return spline;
  }

  [[nodiscard]] const std::vector<T>& nodes() const { return nodes_; }  ///< [unit of x]
  [[nodiscard]] const T& lower() const { return nodes_.front(); }       ///< the first node
  [[nodiscard]] const T& upper() const { return nodes_.back(); }        ///< the last node

  /// At @p x; outside [lower(), upper()] the outermost cubics go on. NaN in, NaN out.
  [[nodiscard]] SplinePoint<Value> evaluate(const T& x) const {
    const std::size_t i = interval(x);
    const Cubic& c = cubics_[i];
    const T t = x - nodes_[i];
    return {Value(c.a + t * (c.b + t * (c.c + t * c.d))),
            Value(c.b + t * (T(2) * c.c + (T(3) * t) * c.d)), Value(T(2) * c.c + (T(6) * t) * c.d)};
  }

  /// The same without second derivatives, of the first @p columns of a matrix alone: in loops that
  /// need no more, every third instruction is saved.
  template <int columns>
  [[nodiscard, gnu::always_inline]] auto evaluate_columns(const T& x) const {
    const std::size_t i = interval(x);
    const Cubic& cubic = cubics_[i];
    const auto a = cubic.a.template leftCols<columns>(), b = cubic.b.template leftCols<columns>();
    const auto c = cubic.c.template leftCols<columns>(), d = cubic.d.template leftCols<columns>();
    const T t = x - nodes_[i];
    return SplineColumns<T, Value::RowsAtCompileTime, columns>{a + t * (b + t * (c + t * d)),
                                                               b + t * (T(2) * c + (T(3) * t) * d)};
  }

 private:
  // The outermost second derivative from its neighbours': m0 = constant + first m1 + second m2.
  struct EndRelation {
    Value constant;
    T first, second;
  };

  // a + b t + c t^2 + d t^3 over an interval, t from its lower node.
  struct Cubic {
    Value a, b, c, d;
  };

  CubicSpline(std::vector<T>&& nodes, std::vector<Value>&& values, int least)
      : nodes_(std::move(nodes)), values_(std::move(values)) {
    const std::size_t n = nodes_.size();
    detail::require(n >= static_cast<std::size_t>(least) && n == values_.size(),
                    "cubic spline: there are " + std::to_string(n) + " nodes and " +
                        std::to_string(values_.size()) + " values, but must be as many, at least " +
                        std::to_string(least));
    for (std::size_t i = 0; i < n; ++i) {
      const std::string name = "cubic spline: node " + std::to_string(i);
      detail::require_finite(name, nodes_[i]);
      detail::require(i == 0 || nodes_[i - 1] < nodes_[i], name, nodes_[i],
                      "greater than the node before");
      require_finite_value("value", i, values_[i]);
    }
    // Equal spacing up to rounding: the interval then follows from a division.
    const T mean = (upper() - lower()) / T(static_cast<double>(n - 1));
    is_uniform_ = true;
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const T off = nodes_[i] - (lower() + T(static_cast<double>(i)) * mean);
      is_uniform_ = is_uniform_ && T(1000) * detail::magnitude(off) <= mean;
    }
    inverse_spacing_ = T(1) / mean;
  }

  // The name is put together for the error only.
  static void require_finite_value(const char* name, std::size_t i, const Value& value) {
    bool finite = true;
    if constexpr (Real<Value>) {
      finite = is_finite(value);
    } else {
      for (Eigen::Index k = 0; k < value.size(); ++k) finite = finite && is_finite(value.coeff(k));
    }
    if (!finite) require_finite_value(detail::joined({name, " ", std::to_string(i)}), value);
  }

  static void require_finite_value(const std::string& name, const Value& value) {
    const std::string what = "cubic spline: " + name;
    if constexpr (Real<Value>) {
      detail::require_finite(what, value);
    } else {
      for (Eigen::Index k = 0; k < value.size(); ++k) {
        detail::require_finite(what + ", component " + std::to_string(k), value.coeff(k));
      }
    }
  }

  [[nodiscard]] T width(std::size_t i) const { return nodes_[i + 1] - nodes_[i]; }
  [[nodiscard]] Value chord(std::size_t i) const {
    return (T(1) / width(i)) * (values_[i + 1] - values_[i]);
  }

  // h(i-1) m(i-1) + 2 (h(i-1) + h(i)) m(i) + h(i) m(i+1) = 6 (chord(i) - chord(i-1)) for every
  // inner node, the outermost m eliminated. Diagonally dominant: no pivots are needed.
  void solve(const EndRelation& start, const EndRelation& end) {
    const std::size_t n = nodes_.size();
    std::vector<T> upper_diagonal(n);
    std::vector<Value> m(n, Value(T(0) * values_.front()));
    for (std::size_t i = 1; i + 1 < n; ++i) {
      T before = width(i - 1), after = width(i);
      T diagonal = T(2) * (before + after);
      Value right = T(6) * (chord(i) - chord(i - 1));
      const T h_before = before, h_after = after;
      if (i == 1) {
        right -= h_before * start.constant;
        diagonal += h_before * start.first;
        after += h_before * start.second;
        before = T(0);
      }
      if (i + 2 == n) {
        right -= h_after * end.constant;
        diagonal += h_after * end.first;
        before += h_after * end.second;
        after = T(0);
      }
      const T pivot = diagonal - before * upper_diagonal[i - 1];
      upper_diagonal[i] = after / pivot;
      m[i] = (T(1) / pivot) * (right - before * m[i - 1]);
    }
    for (std::size_t i = n - 2; i-- > 1;) m[i] -= upper_diagonal[i] * m[i + 1];
    m[0] = start.constant + start.first * m[1] + start.second * m[2];
    m[n - 1] = end.constant + end.first * m[n - 2] + end.second * m[n - 3];
    make_cubics(m);
  }

  // From the second derivatives m at the nodes.
  void make_cubics(const std::vector<Value>& m) {
    const std::size_t n = nodes_.size();
    cubics_.reserve(n - 1);
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const T h = width(i);
      cubics_.push_back({values_[i], Value(chord(i) - (h / T(6)) * (T(2) * m[i] + m[i + 1])),
                         Value(m[i] / T(2)), Value((T(1) / (T(6) * h)) * (m[i + 1] - m[i]))});
    }
    values_.clear();
    values_.shrink_to_fit();
  }

  // The interval that holds x, the right one at a node; an outermost one for x outside and for NaN.
  [[nodiscard]] std::size_t interval(const T& x) const {
    const std::size_t last = nodes_.size() - 2;
    if constexpr (std::is_floating_point_v<T>) {
      if (is_uniform_) {
        const T position = (x - lower()) * inverse_spacing_;
        // Through signed numbers, which processors convert in one instruction.
        using Signed = std::ptrdiff_t;
        std::size_t i = 0;
        if (T(0) < position) {
          i = position < T(static_cast<Signed>(last))
                  ? static_cast<std::size_t>(static_cast<Signed>(position))
                  : last;
        }
        // One off at most, by rounding of the nodes.
        if (i > 0 && x < nodes_[i]) --i;
        if (i < last && nodes_[i + 1] <= x) ++i;
        return i;
      }
    }
    std::size_t low = 0, high = last + 1;
    while (low + 1 < high) {
      const std::size_t middle = low + (high - low) / 2;
      (x < nodes_[middle] ? high : low) = middle;
    }
    return low;
  }

  std::vector<T> nodes_;
  std::vector<Value> values_;  // while the spline is solved for
  std::vector<Cubic> cubics_;
  bool is_uniform_ = false;
  T inverse_spacing_ = T(0);
};

}  // namespace wheelrail
