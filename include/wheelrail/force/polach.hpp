#pragma once
/// @file
/// The creep forces of an elliptical contact by O. Polach, A Fast Wheel-Rail Forces Calculation
/// Computer Code, Vehicle System Dynamics Supplement 33 (1999): (81)-(90) of the paper, with c_jj
/// as Polach has it (the paper prints subscript y twice in (83)). Two forms are not the paper's but
/// equal to it. In (88), with delta of (89), |k_M| = (2/3) eps / (1 + eps^2)^2 exactly, so that
/// (87) is Kalker's spin force over (1 + eps^2)^2; as printed it cancels all digits of a small
/// spin. And f/xi_C of (81) is written without the division. May include: core, force.

#include <wheelrail/force/creepage.hpp>
#include <wheelrail/force/hertz.hpp>
#include <wheelrail/force/kalker.hpp>
#include <wheelrail/numerics/detail/arc_tangent.hpp>

namespace wheelrail {

/// What a contact brings to its creep forces besides the creepages.
template <Real T>
struct PolachContact {
  HertzEllipse<T> ellipse;        ///< of normal_force
  KalkerCoefficients<T> kalker;   ///< of the ellipse
  T shear_modulus = T(0);         ///< G [Pa], > 0: MaterialPair::shear_modulus
  T friction_coefficient = T(0);  ///< mu [-], >= 0
  T normal_force = T(0);          ///< f_n [N], >= 0
  /// [-], >= 0: |xi_yC| of (86) is the greater of |xi_y| and |xi_y + a phi|, with a corner where they
  /// are equal. It is rounded off where they differ by no more than this; 0: it is not.
  T creepage_rounding = T(0);
};

/// On the wheel, in the contact frame of creepage.hpp [N]; the rail takes the opposite.
template <Real T>
struct CreepForce {
  T longitudinal = T(0);  ///< along x of that frame [N]
  T lateral = T(0);       ///< along y of that frame [N]
};

namespace detail {

// |xi_yC| of (86) from xi_y and xi_y + a phi. Rounded off, magnitudes and their maximum are hyperbolas.
template <Real T>
[[nodiscard]] T polach_lateral_creepage(const T& one, const T& other, const T& rounding) {
  using std::sqrt;
  if (!(T(0) < rounding)) return max(magnitude(other), magnitude(one));
  const T squared = rounding * rounding;
  const T a = sqrt(T(one * one + squared)), b = sqrt(T(other * other + squared));
  return (a + b + sqrt(T((a - b) * (a - b) + squared))) / T(2);
}

// (1 / (1 + s) + atan(sqrt s) / sqrt s) / 2, s = eps^2: f / xi_C of (81) over that of Kalker's
// linear theory. 1 at s = 0, where its series keeps square roots of zero away from derivatives.
template <Real T>
[[nodiscard]] T polach_saturation(const T& s) {
  using std::sqrt;
  if (square(T(s * s)) < epsilon<T>()) {
    const T arc = T(1) - s * (T(1) / T(3) - s * (T(1) / T(5) - s / T(7)));
    return (T(1) / (T(1) + s) + arc) / T(2);
  }
  const T eps = sqrt(s);
  return (T(1) / (T(1) + s) + arc_tangent(eps) / eps) / T(2);
}

}  // namespace detail

/// Polach's forces: f_x = -f xi_x / xi_C and f_y = -(f xi_y + f_yS phi) / xi_C.
///
/// The signs are those of the force on the wheel and have Kalker's linear theory as their limit, as
/// long as longitudinal creepage does not meet lateral creepage or spin:
/// f_x -> -G a b c11 xi_x, f_y -> -G a b (c22 xi_y + sqrt(a b) c23 phi). Read literally, the paper
/// gives the force on the rail. The moment about the normal is neglected, as in the paper.
/// @return [N], of magnitude <= mu f_n; exactly 0 where mu f_n = 0. Continuous; with a kink
///   where |xi_y| = |xi_y + a phi|, unless creepage_rounding > 0. Where (xi_x, xi_y)
///   vanishes, c_jj of (83) and with it the derivative depends on the direction of approach; there
///   c11 stands for it in f_x and c22 in f_y, so that automatic derivatives are Kalker's.
/// @note No allocation. NaN in gives NaN in what depends on it.
template <Real T>
[[nodiscard]] CreepForce<T> polach_force(const Creepage<T>& creepage,
                                         const PolachContact<T>& contact) {
  using std::exp;
  using std::sqrt;
  const T bound = contact.friction_coefficient * contact.normal_force;
  if (bound <= T(0)) return {};
  const T& a = contact.ellipse.a;
  const T& b = contact.ellipse.b;
  const T& xi_x = creepage.longitudinal;
  const T& xi_y = creepage.lateral;
  // |xi_yC| of (86), and (84), (85) squared.
  const T lateral =
      detail::polach_lateral_creepage(xi_y, T(xi_y + a * creepage.spin), contact.creepage_rounding);
  const T slip_squared = xi_x * xi_x + xi_y * xi_y;
  const T combined_squared = xi_x * xi_x + lateral * lateral;

  const T patch_stiffness = contact.shear_modulus * a * b;
  const auto slip_force = [&](const T& c_jj) {  // f / xi_C of (81), with eps of (82)
    const T stiffness = patch_stiffness * c_jj;
    const T scale = pi<T>() * stiffness / (T(4) * bound);
    return T(stiffness * detail::polach_saturation(T(scale * scale * combined_squared)));
  };

  const T linear_spin = patch_stiffness * sqrt(T(a * b)) * contact.kalker.c23;
  const T spin_factor = T(1) + constant<T>(6.3L) * (T(1) - exp(T(-a / b)));  // K_S
  const T spin_eps =                                                         // (90)
      T(8) * linear_spin * lateral / (T(3) * a * bound * spin_factor);
  // Where xi_C = 0, so is the spin, and any share will do; 1 is the limit of pure spin.
  const T share = T(0) < combined_squared ? T(lateral / sqrt(combined_squared)) : T(1);
  const T spin_force =  // f_yS / xi_C
      linear_spin * share / detail::square(T(T(1) + spin_eps * spin_eps));

  const T& c11 = contact.kalker.c11;
  const T& c22 = contact.kalker.c22;
  if (slip_squared == T(0)) {
    return {-slip_force(c11) * xi_x, -(slip_force(c22) * xi_y + spin_force * creepage.spin)};
  }
  const T c_jj = sqrt(
      T((detail::square(T(c11 * xi_x)) + detail::square(T(c22 * xi_y))) / slip_squared));  // (83)
  const T slip = slip_force(c_jj);
  return {-slip * xi_x, -(slip * xi_y + spin_force * creepage.spin)};
}

}  // namespace wheelrail
