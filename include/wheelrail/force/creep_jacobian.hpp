#pragma once
/// @file
/// Polach's creep forces with their derivatives by the creepages and by the normal force, in closed
/// form: what an implicit integrator needs of (81)-(90), for less than dual numbers cost.
/// May include: core, force, Eigen.

#include <wheelrail/core/vector.hpp>
#include <wheelrail/force/polach.hpp>

namespace wheelrail {

/// What the ellipse does while the normal force changes.
enum class EllipseUnderLoad {
  grows,  ///< Hertz: both semi-axes with the cube root of the force, (75) and (76)
  held    ///< the ellipse is given, whatever the force
};

/// Creep forces and their slopes, in the contact frame. Rows: longitudinal and lateral force.
template <Real T>
struct CreepJacobian {
  CreepForce<T> force;  ///< polach_force, to rounding [N]
  /// Columns: by longitudinal, lateral creepage [N] and spin [N m].
  Eigen::Matrix<T, 2, 3, Eigen::DontAlign> by_creepage =
      Eigen::Matrix<T, 2, 3, Eigen::DontAlign>::Zero();
  Vector2<T> by_normal_force = Vector2<T>::Zero();  ///< at fixed creepages [-]
};

namespace detail {

// polach_saturation(s) and how far it lies above (1 + s)^-2, which is d(eps f)/d eps: the slope of
// the force along the creepage. Small excesses are a series' own, not differences.
template <Real T>
struct PolachSaturation {
  T value = T(0);   // q
  T slope = T(0);   // r = (1 + s)^-2
  T excess = T(0);  // q - r >= 0

  [[nodiscard]] static PolachSaturation of(const T& s) {
    using std::sqrt;
    const T inverse = T(1) / (T(1) + s);
    const T slope = inverse * inverse;
    if (square(T(s * s)) < epsilon<T>()) {
      const T fall = s * inverse;
      const T arc_fall = s * (T(1) / T(3) - s * (T(1) / T(5) - s / T(7)));
      return {T(1) - (fall + arc_fall) / T(2), slope, (fall - arc_fall) / T(2) + fall * inverse};
    }
    const T eps = sqrt(s);
    const T arc = arc_tangent(eps) / eps;
    return {(inverse + arc) / T(2), slope, (arc - inverse) / T(2) + (T(1) - inverse) * inverse};
  }
};

}  // namespace detail

/// The derivatives of polach_force.
///
/// With q = f / xi_C of (81) over that of Kalker's linear theory, d(eps q)/d eps = (1 + eps^2)^-2
/// exactly. A change of the creepages along themselves has this slope, one across them the secant
/// q; split like this, nothing cancels in full sliding, where the slopes vanish.
/// @return All zero where mu f_n = 0. On the kink of (86), |xi_y + a phi| = |xi_y|, the slopes are
///   those of its side with the spin. Where (xi_x, xi_y) vanishes, c_jj of (83) and with it the
///   slopes depend on the direction of approach; there c11 stands for it in the longitudinal force
///   and c22 in the lateral, as in polach_force: without creepages these are Kalker's -G a b c11,
///   -G a b c22 and -G (a b)^1.5 c23. Bounded everywhere; continuous elsewhere.
/// @note PolachContact::creepage_rounding is left out: near that kink, where it acts, the slopes are
///   those of the force without it.
/// @note No allocation. NaN in gives NaN. Symmetric in the creepages only where c11 = c22 and
///   phi = 0.
template <Real T>
[[nodiscard]] CreepJacobian<T> creep_jacobian(
    const Creepage<T>& creepage, const PolachContact<T>& contact,
    EllipseUnderLoad ellipse_under_load = EllipseUnderLoad::grows) {
  using std::exp;
  using std::sqrt;
  CreepJacobian<T> result;
  const T bound = contact.friction_coefficient * contact.normal_force;
  if (bound <= T(0)) return result;
  const T& a = contact.ellipse.a;
  const T& b = contact.ellipse.b;
  const T& xi_x = creepage.longitudinal;
  const T& xi_y = creepage.lateral;
  const T& spin = creepage.spin;

  // xi_yC of (86) with its sign, and by how much the spin moves it: `reach` spin.
  const T with_spin = xi_y + a * spin;
  const bool spun = !(detail::magnitude(with_spin) < detail::magnitude(xi_y));
  const T reach = spun ? a : T(0);
  const T lateral = spun ? with_spin : xi_y;
  const T combined_squared = xi_x * xi_x + lateral * lateral;
  const bool creeps = T(0) < combined_squared;
  const T inverse = creeps ? T(T(1) / sqrt(combined_squared)) : T(0);
  // The directions of (xi_x, xi_yC) and, over the same length, of xi_y and of a spin.
  const T n_x = xi_x * inverse;
  const T n_y = creeps ? T(lateral * inverse) : T(1);
  const T share_y = xi_y * inverse;
  const T share_spin = reach * spin * inverse;
  // n_x^2 + n_y (n_y - share_y), which is n_x^2 without spin.
  const T across = creeps ? T(n_x * n_x + n_y * share_spin) : T(1);

  const T patch_stiffness = contact.shear_modulus * a * b;
  const T scale = pi<T>() * patch_stiffness / (T(4) * bound);  // of (82), without c_jj xi_C
  const auto saturation = [&](const T& c_jj) {
    return detail::PolachSaturation<T>::of(T(detail::square(T(scale * c_jj)) * combined_squared));
  };
  // d ln a / d f_n = d ln b / d f_n.
  const T by_load = T(1) / contact.normal_force;
  const T growth = ellipse_under_load == EllipseUnderLoad::grows ? T(by_load / T(3)) : T(0);
  const T spin_load = n_y * share_spin * growth;  // d ln xi_C / d f_n

  auto& slopes = result.by_creepage;
  const T& c11 = contact.kalker.c11;
  const T& c22 = contact.kalker.c22;
  const T slip_squared = xi_x * xi_x + xi_y * xi_y;
  if (slip_squared == T(0)) {
    slopes(0, 0) = -patch_stiffness * c11 * saturation(c11).value * n_y * n_y;
    slopes(1, 1) = -patch_stiffness * c22 * saturation(c22).value * across;
    result.force = {slopes(0, 0) * xi_x, slopes(1, 1) * xi_y};  // 0, or too small to be squared
    result.by_normal_force = Vector2<T>(T(T(2) * growth * result.force.longitudinal),
                                        T(T(2) * growth * result.force.lateral));
  } else {
    const T inverse_slip = T(1) / sqrt(slip_squared);
    const T u_x = xi_x * inverse_slip;
    const T u_y = xi_y * inverse_slip;
    const T c_jj = sqrt(T(detail::square(T(c11 * u_x)) + detail::square(T(c22 * u_y))));  // (83)
    const auto q = saturation(c_jj);
    const T secant = patch_stiffness * c_jj * q.value;
    const T tangent = patch_stiffness * c_jj * q.slope;
    const T drop = patch_stiffness * c_jj * q.excess;
    // c_jj changes only as the slip turns: its derivative, times the slip.
    const T turn = patch_stiffness * q.slope * (c11 * c11 - c22 * c22) / c_jj * u_x * u_y;
    slopes(0, 0) = -(secant * n_y * n_y + tangent * n_x * n_x + turn * u_x * u_y);
    slopes(0, 1) = drop * n_x * n_y + turn * u_x * u_x;
    slopes(0, 2) = drop * n_x * n_y * reach;
    slopes(1, 0) = drop * n_x * share_y - turn * u_y * u_y;
    slopes(1, 1) = -(secant * across + tangent * n_y * share_y - turn * u_x * u_y);
    slopes(1, 2) = drop * n_y * share_y * reach;
    const T slip_load = T(2) * growth * tangent + drop * (by_load - spin_load);
    result.by_normal_force = Vector2<T>(T(-slip_load * xi_x), T(-slip_load * xi_y));
    result.force = {-secant * xi_x, -secant * xi_y};
  }

  // f_yS phi / xi_C of (87)-(90), as in polach_force.
  const T linear_spin = patch_stiffness * sqrt(T(a * b)) * contact.kalker.c23;
  const T spin_factor = T(1) + constant<T>(6.3L) * (T(1) - exp(T(-a / b)));  // K_S
  const T spin_scale = T(8) * linear_spin / (T(3) * a * bound * spin_factor);
  const T spin_eps = spin_scale * lateral;  // with the sign of lateral
  const T fall = T(1) / (T(1) + spin_eps * spin_eps);
  const T sign = lateral < T(0) ? T(-1) : T(1);
  const T spin_slope = linear_spin * fall * fall;
  const T spin_secant = spin_slope * n_y * sign;
  // By the lateral creepage that counts: the share of (87) grows, k_M falls.
  const T by_lateral = sign * spin *
                       (spin_slope * n_x * n_x * inverse -
                        T(4) * spin_secant * sign * (spin_eps * fall) * spin_scale);
  slopes(1, 0) += spin_secant * n_x * spin * inverse;
  slopes(1, 1) -= by_lateral;
  slopes(1, 2) -= spin_secant + reach * by_lateral;
  result.force.lateral = result.force.lateral - spin_secant * spin;
  const T spin_load_factor =
      T(3) * growth - T(4) * spin_eps * (spin_eps * fall) * (T(2) * growth - by_load);
  result.by_normal_force.y() -=
      spin_secant * spin * spin_load_factor + by_lateral * reach * spin * growth;
  return result;
}

}  // namespace wheelrail
