#pragma once
/// @file
/// Hertz's elliptical contact, computed instead of tabulated: (67)-(69), (75)-(77) of the paper,
/// whose coefficients m, n and C follow from the axis ratio that solves
/// (E/g^2 - K)/(K - E) = B/(g^2 D) = ratio of the relative curvatures (K. L. Johnson, Contact
/// Mechanics, ch. 4). May include: core, numerics.

#include <wheelrail/core/require.hpp>
#include <wheelrail/core/scalar_value.hpp>
#include <wheelrail/force/material.hpp>
#include <wheelrail/numerics/elliptic_integral.hpp>

namespace wheelrail {

/// The relative curvatures of two bodies whose principal directions are aligned [1/m].
template <Real T>
struct HertzCurvatures {
  T longitudinal = T(0);  ///< A of (68): half the sum of both bodies' curvatures along the rolling
  T lateral = T(0);       ///< B of (69): half the sum of those across
};

/// (68) and (69) from the curvatures of the two bodies [1/m], positive where a body is convex.
template <Real T>
[[nodiscard]] HertzCurvatures<T> hertz_curvatures(const T& wheel_longitudinal,
                                                  const T& rail_longitudinal,
                                                  const T& wheel_lateral, const T& rail_lateral) {
  return {(wheel_longitudinal + rail_longitudinal) / T(2), (wheel_lateral + rail_lateral) / T(2)};
}

/// Where Hertz's theory is held off its singularity.
template <Real T>
struct HertzOptions {
  /// B is taken as max(B, this) [1/m], > 0. A CHOICE of this library: where fillet and gauge corner
  /// conform, B falls to zero or below and Hertz is singular. 0.25 1/m is a radius of 2 m.
  T minimum_lateral_curvature = constant<T>(0.25L);
  /// Where |B - minimum_lateral_curvature| < bound_width [1/m], a parabola passes from one to the
  /// other without a kink. Where 0, max(B, minimum) has its kink.
  T bound_width = T(0);
};

/// @throws std::invalid_argument unless the bound is finite and > 0, and its width finite and >= 0.
template <Real T>
void validate(const HertzOptions<T>& options) {
  detail::require_positive("Hertz: minimum lateral curvature", options.minimum_lateral_curvature,
                           "[1/m]");
  detail::require_not_negative("Hertz: bound width", options.bound_width, "[1/m]");
}

/// How the shape of a contact came about.
enum class HertzStatus {
  regular,                    ///< the curvatures were taken as they are
  lateral_curvature_bounded,  ///< B was below HertzOptions::minimum_lateral_curvature
  no_longitudinal_curvature,  ///< A <= 0: there is no Hertzian contact; the numbers are NaN
  iteration_limit,            ///< the axis ratio did not converge; the last iterate
  not_finite                  ///< A or B is NaN or infinite; the numbers are NaN
};

/// The status in words, for messages and tables.
[[nodiscard]] constexpr const char* name_of(HertzStatus status) {
  switch (status) {
    case HertzStatus::regular:
      return "regular";
    case HertzStatus::lateral_curvature_bounded:
      return "lateral_curvature_bounded";
    case HertzStatus::no_longitudinal_curvature:
      return "no_longitudinal_curvature";
    case HertzStatus::iteration_limit:
      return "iteration_limit";
    case HertzStatus::not_finite:
      return "not_finite";
  }
  return "unknown";
}

namespace detail {

// The cube root of x >= 0, to ln x / 3 rounding units; 0 of 0, where its slope is infinite.
template <Real T>
[[nodiscard]] T cube_root(const T& x) {
  using std::exp;
  using std::log;
  return x == T(0) ? T(0) : T(exp(T(log(x) / T(3))));
}

// Near ln g for ln ratio: odd, with the slope -2/3 at 0. The fit, through Chebyshev's nodes, is good to
// 6e-9 up to a ratio of 100, beyond any wheel on a rail, and to 0.02 up to 1e6; it saves steps and
// decides nothing.
template <Real T>
[[nodiscard]] T log_axis_ratio_start(const T& log_ratio) {
  const T s = log_ratio * log_ratio;
  return constant<T>(-2.0L / 3.0L) * log_ratio *
         (T(1) + s * (constant<T>(0.100726192L) +
                      s * (constant<T>(0.00255885389L) + s * constant<T>(1.27582432e-5L)))) /
         (T(1) + s * (constant<T>(0.105355819L) +
                      s * (constant<T>(0.00285371961L) + s * constant<T>(1.55538714e-5L))));
}

}  // namespace detail

/// What the curvatures alone decide. Invariants, to rounding: 0 < axis_ratio <= 1;
/// rolling_is_major == (A <= bounded B).
template <Real T>
struct HertzShape {
  T axis_ratio = T(0);             ///< minor over major axis g [-]
  T major_cubed = T(0);            ///< m^3 [-]
  T stiffness_coefficient = T(0);  ///< C of (67) [-], 1/pi for a circle
  T curvature_sum = T(0);          ///< A + B, B bounded [1/m]
  bool rolling_is_major = true;    ///< the ellipse's major axis lies along the rolling
  int iterations = 0;              ///< Newton steps
  HertzStatus status = HertzStatus::not_finite;  ///< what the curvatures allowed

  /// m of (75) [-]
  [[nodiscard]] T major_coefficient() const { return detail::cube_root(major_cubed); }
  /// n of (76) [-]
  [[nodiscard]] T minor_coefficient() const { return axis_ratio * major_coefficient(); }
};

/// The semi-axes of a contact [m]: a along the rolling, b across. Both are 0 without a force.
template <Real T>
struct HertzEllipse {
  T a = T(0);  ///< along the rolling [m]
  T b = T(0);  ///< across it [m]
};

/// The shape of the contact, by Newton's method for ln g on the logarithm of the curvature ratio:
/// nearly a straight line, so that from its fit one step reaches rounding in double.
/// @param curvatures [1/m]; longitudinal > 0, which a wheel on a rail always has.
/// @return see HertzStatus. Smooth in the curvatures, also where A = B; a kink at the bound of B
///   unless HertzOptions::bound_width > 0.
/// @note No allocation. Differentiable: dual numbers take one Newton step more, from the root of their
///   values.
template <Real T>
[[nodiscard]] HertzShape<T> hertz_shape(const HertzCurvatures<T>& curvatures,
                                        const HertzOptions<T>& options = {}) {
  using std::exp;
  using std::log;
  using std::sqrt;
  constexpr int maximum_iterations = 20;
  HertzShape<T> shape;
  const T& a = curvatures.longitudinal;
  const bool finite = is_finite(a) && is_finite(curvatures.lateral);
  if (!finite || a <= T(0)) {
    const T not_a_number = T(0) / T(0);
    shape.axis_ratio = shape.major_cubed = not_a_number;
    shape.stiffness_coefficient = shape.curvature_sum = not_a_number;
    if (finite) shape.status = HertzStatus::no_longitudinal_curvature;
    return shape;
  }
  const bool bounded = curvatures.lateral < options.minimum_lateral_curvature;
  T b = bounded ? options.minimum_lateral_curvature : curvatures.lateral;
  const T& width = options.bound_width;
  if (b < options.minimum_lateral_curvature + width) {
    // Of the parabola's abscissa, from 0 to 2 width.
    const T past =
        detail::max(T(curvatures.lateral - options.minimum_lateral_curvature + width), T(0));
    b = options.minimum_lateral_curvature + past * past / (T(4) * width);
  }
  shape.status = bounded ? HertzStatus::lateral_curvature_bounded : HertzStatus::regular;
  shape.curvature_sum = a + b;
  shape.rolling_is_major = a <= b;
  const T ratio = shape.rolling_is_major ? T(b / a) : T(a / b);
  const T log_ratio = log(ratio);
  T x = detail::log_axis_ratio_start(log_ratio);
  int steps = 1;  // at least
  if constexpr (has_derivatives<T>) {
    const auto found =
        hertz_shape(HertzCurvatures<ValueOf<T>>{value_of(a), value_of(b)},
                    HertzOptions<ValueOf<T>>{value_of(options.minimum_lateral_curvature)});
    x = T(ValueOf<T>(log(found.axis_ratio)));
    steps = ScalarTraits<T>::lifting_steps;
  }
  T g = T(0);
  T first = T(0);
  T second = T(0);
  bool converged = false;
  while (!converged && shape.iterations < maximum_iterations) {
    g = exp(x);
    const CompleteElliptic<T> integrals = complete_elliptic(g);
    // What B/(g^2 D) is too large by, as a factor, and its logarithm to third order.
    const T excess = integrals.b / (integrals.d * g * g * ratio);
    const T residual = T(2) * (excess - T(1)) / (excess + T(1));
    const T slope = T(-3) - (integrals.c - integrals.d) * (T(1) / integrals.b + T(1) / integrals.d);
    const T step = -residual / slope;
    x = x + step;
    ++shape.iterations;
    // Newton's method squares its error, and so do the integrals carried over the last step by
    // their slopes: what is left is the square of the step.
    converged = step * step <= epsilon<T>() && steps <= shape.iterations;
    first = integrals.first - integrals.b * step;
    second = integrals.second + g * g * integrals.d * step;
    g = g + g * step;
  }
  if (!converged) shape.status = HertzStatus::iteration_limit;
  shape.axis_ratio = g;
  shape.major_cubed = T(2) * second / (pi<T>() * g * g);
  // 3 sqrt(3) / (8 pi) (2 pi m / (3 K))^1.5 with this m.
  shape.stiffness_coefficient = sqrt(T(second / first)) / (T(2) * g * first);
  return shape;
}

/// K of (67) [N/m^1.5]: the normal force of an elastic approach d is K d^1.5.
template <Real T>
[[nodiscard]] T hertz_stiffness(const HertzShape<T>& shape, const MaterialPair<T>& materials) {
  using std::sqrt;
  return T(4) * shape.stiffness_coefficient /
         (T(3) * materials.compliance() * sqrt(shape.curvature_sum));
}

/// The contact ellipse: (75) and (76), m and n changing places where A > B.
/// @param normal_force [N] >= 0. @return the semi-axes [m]; 0 for no force.
template <Real T>
[[nodiscard]] HertzEllipse<T> hertz_ellipse(const HertzShape<T>& shape,
                                            const MaterialPair<T>& materials,
                                            const T& normal_force) {
  const T major = detail::cube_root(T(T(3) * pi<T>() * materials.compliance() * normal_force *
                                      shape.major_cubed / (T(4) * shape.curvature_sum)));
  const T minor = shape.axis_ratio * major;
  return shape.rolling_is_major ? HertzEllipse<T>{major, minor} : HertzEllipse<T>{minor, major};
}

/// The elastic approach of the two bodies [m] under @p normal_force [N] >= 0: (F/K)^(2/3).
template <Real T>
[[nodiscard]] T hertz_approach(const HertzShape<T>& shape, const MaterialPair<T>& materials,
                               const T& normal_force) {
  return detail::square(detail::cube_root(T(normal_force / hertz_stiffness(shape, materials))));
}

/// The pressure in the middle of the ellipse [Pa]: 3 F / (2 pi a b); 0 without a force.
template <Real T>
[[nodiscard]] T maximum_pressure(const HertzEllipse<T>& ellipse, const T& normal_force) {
  if (normal_force == T(0)) return T(0);
  return T(3) * normal_force / (T(2) * pi<T>() * ellipse.a * ellipse.b);
}

}  // namespace wheelrail
