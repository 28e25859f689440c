#pragma once
/// @file
/// From one contact point to its forces: Hertz, the normal force and Polach's creep forces in one
/// call, (63)-(90), for the patches of anyone's search. May include: core, numerics, force.

#include <wheelrail/force/creepage.hpp>
#include <wheelrail/force/hertz.hpp>
#include <wheelrail/force/kalker.hpp>
#include <wheelrail/force/material.hpp>
#include <wheelrail/force/normal_force.hpp>
#include <wheelrail/force/polach.hpp>

namespace wheelrail {

/// What a contact's forces depend on. Velocities are those of the wheel's material point against
/// the rail, in the right-handed contact frame: x forward, y to the left, z from the rail into the
/// wheel.
template <Real T>
struct ContactKinematics {
  T penetration = T(0);             ///< [m], positive in contact
  HertzCurvatures<T> curvatures{};  ///< (68), (69) [1/m]
  T longitudinal_velocity = T(0);   ///< [m/s]
  T lateral_velocity = T(0);        ///< [m/s]
  T normal_velocity = T(0);         ///< [m/s]; the penetration grows at minus this rate: (65)
  T spin_velocity = T(0);           ///< about z [rad/s]
  T forward_speed = T(0);           ///< of the wheelset along the rail, signed [m/s]
  T speed = T(0);                   ///< of the wheelset's centre [m/s]
};

/// The forces of one contact, on the wheel, in the contact frame.
template <Real T>
struct ContactForce {
  T normal = T(0);                                  ///< f_n [N], >= 0, along z
  CreepForce<T> creep{};                            ///< [N], along x and y
  Creepage<T> creepage{};                           ///< of the wheel against the rail
  HertzEllipse<T> ellipse{};                        ///< [m]
  T stiffness = T(0);                               ///< K of (67) [N/m^1.5]
  HertzStatus hertz_status = HertzStatus::regular;  ///< how the ellipse came about
};

/// Materials, friction and the options of each part of the force law; Table 1 of the paper.
template <Real T>
struct ContactForceOptions {
  Material<T> wheel = steel<T>();               ///< of the wheel
  Material<T> rail = steel<T>();                ///< of the rail
  T friction_coefficient = constant<T>(0.25L);  ///< mu [-], >= 0
  NormalForceOptions<T> normal{};               ///< of the normal force
  HertzOptions<T> hertz{};                      ///< of the contact ellipse
  CreepageOptions<T> creepage{};                ///< of the creepages
  /// K [N/m^1.5] in place of (67) where > 0. With (67) the stiffness follows the curvatures at the
  /// contact point, and the normal force has no potential; with a constant one it has.
  T constant_stiffness = T(0);
  /// Of PolachContact [-], >= 0; 0: (86) as it stands.
  T creepage_rounding = T(0);
};

/// The same options without the kinks that the force law has of its own: the bound of B is approached
/// over its own width, and |xi_yC| is rounded off over 1e-4, a tenth of a usual creepage. Both
/// CHOICES. What is left is the point where no creepage but spin is: see polach_force.
template <Real T>
[[nodiscard]] ContactForceOptions<T> without_kinks(ContactForceOptions<T> options = {}) {
  options.hertz.bound_width = options.hertz.minimum_lateral_curvature;
  options.creepage_rounding = constant<T>(1e-4L);
  return options;
}

/// The force law with all that does not change from contact to contact. Valid for good once
/// constructed. @note Queries do not allocate.
template <Real T>
class ContactForceModel {
 public:
  /// @throws std::invalid_argument where an option is out of its range.
  explicit ContactForceModel(const ContactForceOptions<T>& options = {})
      : options_(options),
        materials_(options.wheel, options.rail),
        kalker_(materials_.poisson_ratio()) {
    detail::require_not_negative("friction coefficient", options_.friction_coefficient, "[-]");
    detail::require_not_negative("constant stiffness", options_.constant_stiffness, "[N/m^1.5]");
    detail::require_not_negative("creepage rounding", options_.creepage_rounding, "[-]");
    validate(options_.normal);
    validate(options_.hertz);
    validate(options_.creepage);
  }

  /// As they were given.
  [[nodiscard]] const ContactForceOptions<T>& options() const { return options_; }
  /// Of wheel and rail.
  [[nodiscard]] const MaterialPair<T>& materials() const { return materials_; }
  /// For the materials' Poisson's ratio.
  [[nodiscard]] const KalkerTable<T>& kalker() const { return kalker_; }

  /// The forces of one contact. NaN in gives NaN; see hertz_status.
  [[nodiscard]] ContactForce<T> operator()(const ContactKinematics<T>& contact) const {
    ContactForce<T> force;
    const HertzShape<T> shape = hertz_shape(contact.curvatures, options_.hertz);
    force.hertz_status = shape.status;
    force.stiffness = T(0) < options_.constant_stiffness ? options_.constant_stiffness
                                                         : hertz_stiffness(shape, materials_);
    force.normal = normal_force(force.stiffness, contact.penetration, T(-contact.normal_velocity),
                                options_.normal);
    force.ellipse = hertz_ellipse(shape, materials_, force.normal);
    force.creepage =
        creepage(contact.longitudinal_velocity, contact.lateral_velocity, contact.spin_velocity,
                 contact.forward_speed, contact.speed, options_.creepage);
    force.creep =
        polach_force(force.creepage,
                     PolachContact<T>{force.ellipse, kalker_.at(force.ellipse.a, force.ellipse.b),
                                      materials_.shear_modulus(), options_.friction_coefficient,
                                      force.normal, options_.creepage_rounding});
    return force;
  }

 private:
  ContactForceOptions<T> options_;
  MaterialPair<T> materials_;
  KalkerTable<T> kalker_;
};

}  // namespace wheelrail
