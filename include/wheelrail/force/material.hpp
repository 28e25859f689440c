#pragma once
/// @file
/// What a wheel and a rail are made of, and the combined constants that the contact laws use:
/// h of (70) and the shear modulus and Poisson ratio of unlike materials. May include: core.

#include <string>
#include <wheelrail/core/require.hpp>
#include <wheelrail/core/scalar.hpp>

namespace wheelrail {

/// A linear elastic, isotropic material.
template <Real T>
struct Material {
  T young_modulus = T(0);  ///< [Pa], > 0
  T poisson_ratio = T(0);  ///< [-], in [0, 0.5)
};

/// Steel as in Table 1 of the paper: 206 GPa, 0.296.
template <Real T>
[[nodiscard]] Material<T> steel() {
  return {constant<T>(206e9L), constant<T>(0.296L)};
}

/// G = E / (2 (1 + nu)) [Pa].
template <Real T>
[[nodiscard]] T shear_modulus(const Material<T>& material) {
  return material.young_modulus / (T(2) * (T(1) + material.poisson_ratio));
}

/// A wheel's and a rail's material with what follows from both. Valid for good once constructed.
template <Real T>
class MaterialPair {
 public:
  /// Steel on steel: Table 1 of the paper.
  MaterialPair() : MaterialPair(steel<T>(), steel<T>()) {}

  /// @throws std::invalid_argument unless both moduli are finite and > 0 and both Poisson ratios
  ///   lie in [0, 0.5).
  MaterialPair(const Material<T>& wheel, const Material<T>& rail) {
    validate("wheel material", wheel);
    validate("rail material", rail);
    compliance_ = compliance_of(wheel) + compliance_of(rail);
    const T wheel_part = T(1) / wheelrail::shear_modulus(wheel);
    const T rail_part = T(1) / wheelrail::shear_modulus(rail);
    shear_modulus_ = T(2) / (wheel_part + rail_part);
    poisson_ratio_ = (wheel.poisson_ratio * wheel_part + rail.poisson_ratio * rail_part) /
                     (wheel_part + rail_part);
  }

  /// h_w + h_r [1/Pa], h = (1 - nu^2) / (pi E): (70).
  [[nodiscard]] T compliance() const { return compliance_; }
  /// E* [Pa]: 1/E* = (1 - nu_w^2)/E_w + (1 - nu_r^2)/E_r = pi (h_w + h_r).
  [[nodiscard]] T effective_modulus() const { return T(1) / (pi<T>() * compliance_); }
  /// G [Pa]: 1/G = (1/G_w + 1/G_r) / 2 (Kalker 1990).
  [[nodiscard]] T shear_modulus() const { return shear_modulus_; }
  /// nu [-]: nu/G = (nu_w/G_w + nu_r/G_r) / 2 (Kalker 1990).
  [[nodiscard]] T poisson_ratio() const { return poisson_ratio_; }

 private:
  static void validate(const char* name, const Material<T>& material) {
    detail::require_positive(std::string(name) + ": Young's modulus", material.young_modulus,
                             "[Pa]");
    detail::require(!(material.poisson_ratio < T(0)) && material.poisson_ratio < constant<T>(0.5L),
                    std::string(name) + ": Poisson's ratio", material.poisson_ratio,
                    "in [0, 0.5) [-]");
  }
  [[nodiscard]] static T compliance_of(const Material<T>& material) {
    return (T(1) - material.poisson_ratio * material.poisson_ratio) /
           (pi<T>() * material.young_modulus);
  }

  T compliance_ = T(0);
  T shear_modulus_ = T(0);
  T poisson_ratio_ = T(0);
};

}  // namespace wheelrail
