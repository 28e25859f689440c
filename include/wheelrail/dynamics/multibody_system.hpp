#pragma once
/// @file
/// Constrained systems of rigid bodies: (91)-(94) of §5 by their structure. M is diagonal in
/// rigid_body.hpp's accelerations, so the accelerations without joints come first, then Lagrange
/// multipliers for each group of joints that share bodies (a wheelset with its axlebox, say), never
/// a system of the size of the vehicle.
///
/// Closed loops make constraints redundant (a planar four-bar linkage: 20 of rank 17): multipliers
/// of redundant rows are zero (numerics/semidefinite_cholesky.hpp), the motion is unique all the
/// same. May include: core, numerics, dynamics, Eigen, std.

#include <array>
#include <span>
#include <utility>
#include <vector>
#include <wheelrail/dynamics/detail/body_array.hpp>
#include <wheelrail/dynamics/detail/centred_joint.hpp>
#include <wheelrail/dynamics/detail/joint_group.hpp>
#include <wheelrail/dynamics/multibody_model.hpp>
#include <wheelrail/dynamics/rigid_body_vector.hpp>
#include <wheelrail/numerics/ode.hpp>

namespace wheelrail {

/// How far a state is from its constraints: the greatest |Phi| [m, -] and |dPhi/dt| [m/s, 1/s].
template <Real T>
struct ConstraintViolation {
  T residual = T(0);       ///< the greatest |Phi| [m, -]
  T residual_rate = T(0);  ///< the greatest |dPhi/dt| [m/s, 1/s]
};

/// The state is a column: thirteen numbers per body (RigidBodyLayout), then the elongations of the
/// series springs [m] (SpringDamper), in the order of the elements and of x, y, z.
/// @tparam MaximumBodies most bodies of a system. @tparam MaximumJoints most joints of a group.
/// @note Evaluations allocate nothing for states of fixed size; they may run in parallel. All have
/// the precondition y.size() == state_size().
template <Real T, std::size_t MaximumBodies = 16, std::size_t MaximumJoints = 8>
class MultibodySystem {
 public:
  /// @throws std::invalid_argument naming what is out of its range, or does not fit.
  explicit MultibodySystem(MultibodyModel<T> model)
      : model_(detail::require_valid(std::move(model), MaximumBodies)),
        groups_(detail::joint_groups<MaximumJoints>(
            std::span<const RevoluteJoint<T>>(model_.joints), model_.bodies.size())),
        inverse_masses_(
            Vector6<T>::Zero(), count(),
            [this](int i) { return Vector6<T>(mass_diagonal(body(i)).cwiseInverse()); }),
        state_size_(RigidBodyLayout::offset(static_cast<Eigen::Index>(model_.bodies.size()))) {
    series_offsets_.push_back(state_size_);
    for (const SpringDamper<T>& element : model_.spring_dampers) {
      for (Eigen::Index i = 0; i < 3; ++i) {
        if (T(0) < element.series_stiffness_a(i)) ++state_size_;
      }
      series_offsets_.push_back(state_size_);
    }
  }

  [[nodiscard]] const MultibodyModel<T>& model() const { return model_; }  ///< as it was given
  /// Without the ground.
  [[nodiscard]] std::size_t body_count() const { return model_.bodies.size(); }
  [[nodiscard]] Eigen::Index state_size() const { return state_size_; }  ///< numbers in the state

  /// dy/dt: the right-hand side of an integrator.
  /// @param external_wrenches on each body, without gravity, joints and elements: contact, say.
  /// @return NaN at the bodies that what is not finite reaches.
  /// @pre external_wrenches.size() == body_count()
  template <StateVector State>
  [[nodiscard]] State rate(const State& y, std::span<const Wrench<T>> external_wrenches) const {
    const Motions motions = motions_of(y);
    State result(y.size());
    Forces forces = without_joints(
        y, motions, external_wrenches,
        [&result](Eigen::Index row, const T& elongation_rate) { result(row) = elongation_rate; });
    add_reactions(motions, forces);
    using Layout = RigidBodyLayout;
    for (int i = 0; i < count(); ++i) {  // as `derivative`, but in place
      const Eigen::Index row = Layout::offset(i);
      result.template segment<3>(row + Layout::position_world) =
          y.template segment<3>(row + Layout::velocity_world);
      result.template segment<4>(row + Layout::orientation) =
          euler_parameter_rate<T>(y.template segment<4>(row + Layout::orientation),
                                  y.template segment<3>(row + Layout::angular_velocity_body));
      result.template segment<6>(row + Layout::velocity_world) =
          forces[i].cwiseProduct(inverse_masses_[i]);
    }
    return result;
  }

  /// What the joint @p joint does to its second body, b, about b's centre of mass (the world's
  /// origin for the ground). Not unique where constraints are redundant.
  /// @pre joint < model().joints.size(), and as for `rate`.
  template <StateVector State>
  [[nodiscard]] Wrench<T> reaction_on_b(const State& y,
                                        std::span<const Wrench<T>> external_wrenches,
                                        std::size_t joint) const {
    WHEELRAIL_ASSERT(joint < model_.joints.size());
    const Motions motions = motions_of(y);
    const Forces forces =
        without_joints(y, motions, external_wrenches, [](Eigen::Index, const T&) {});
    for (const Group& group : groups_) {
      for (std::size_t i = 0; i < group.size(); ++i) {
        if (group[i] != joint) continue;
        const GroupEquations equations(model_.joints, {group.begin(), group.size()}, motions);
        const Vector6<T> on_b = equations.reaction(i, 1, multipliers(equations, forces));
        const BodyMotion<T>& b = motions[equations.bodies(i)[1]];
        return {on_b.template head<3>(), b.body_to_world * on_b.template tail<3>()};
      }
    }
    return {};
  }

  /// Of all joints in the state @p y.
  template <StateVector State>
  [[nodiscard]] ConstraintViolation<T> constraint_violation(const State& y) const {
    const Motions motions = motions_of(y);
    ConstraintViolation<T> greatest;
    const auto take = [](T& most, const Vector5<T>& values) {
      for (Eigen::Index i = 0; i < values.size(); ++i) {
        const T size = detail::magnitude(values(i));
        if (most < size || !is_finite(size)) most = size;
      }
    };
    for (const RevoluteJoint<T>& joint : model_.joints) {
      const auto [a, b] = joint.bodies();
      const JointEquations<T> e = joint.equations(motions[a], motions[b]);
      take(greatest.residual, e.residual);
      take(greatest.residual_rate, e.residual_rate);
    }
    return greatest;
  }

  /// Of all bodies [J].
  template <StateVector State>
  [[nodiscard]] T kinetic_energy(const State& y) const {
    T energy = T(0);
    for (int i = 0; i < count(); ++i) {
      energy += wheelrail::kinetic_energy(body(i), unpack_rigid_body(y, i));
    }
    return energy;
  }

  /// Of gravity (zero at the world's origin), springs, series springs and torsion springs [J].
  template <StateVector State>
  [[nodiscard]] T potential_energy(const State& y) const {
    const Motions motions = motions_of(y);
    T energy =
        sum_over_elements(y, motions, [](const auto&... of) { return stored_energy(of...); });
    for (int i = 0; i < count(); ++i) {
      energy -= body(i).mass() * model_.gravity_world.dot(motions[i].position_world);
    }
    return energy;
  }

  /// By which dampers lessen the sum of both energies [W].
  template <StateVector State>
  [[nodiscard]] T dissipated_power(const State& y) const {
    return sum_over_elements(y, motions_of(y),
                             [](const auto&... of) { return wheelrail::dissipated_power(of...); });
  }

 private:
  using Motions = detail::BodyArray<BodyMotion<T>, MaximumBodies>;
  using Forces = detail::BodyArray<Vector6<T>, MaximumBodies>;
  using Group = detail::JointGroup<MaximumJoints>;
  using GroupEquations = detail::JointGroupEquations<T, MaximumJoints>;

  [[nodiscard]] int count() const { return static_cast<int>(body_count()); }
  [[nodiscard]] const RigidBody<T>& body(int i) const {
    return model_.bodies[static_cast<std::size_t>(i)];
  }

  template <class State>
  [[nodiscard]] Motions motions_of(const State& y) const {
    WHEELRAIL_ASSERT(y.size() == state_size_);
    return Motions(BodyMotion<T>{}, count(),
                   [&y](int i) { return body_motion(unpack_rigid_body(y, i)); });
  }

  [[nodiscard]] auto multipliers(const GroupEquations& equations, const Forces& forces) const {
    return equations.multipliers(inverse_masses_, forces, model_.baumgarte_alpha,
                                 model_.baumgarte_beta);
  }

  /// Adds to @p forces what the joints do to each body.
  void add_reactions(const Motions& motions, Forces& forces) const {
    for (const Group& group : groups_) {
      const RevoluteJoint<T>& first = model_.joints[group[0]];
      if (group.size() == 1 && first.is_centred()) {
        const auto [a, b] = first.bodies();
        const auto reactions =
            detail::centred_reactions<T>(first, {motions[a], inverse_masses_[a], forces[a]},
                                         {motions[b], inverse_masses_[b], forces[b]},
                                         model_.baumgarte_alpha, model_.baumgarte_beta);
        forces[a] += reactions[0];
        forces[b] += reactions[1];
        continue;
      }
      const GroupEquations equations(model_.joints, {group.begin(), group.size()}, motions);
      const auto lambda = multipliers(equations, forces);
      for (std::size_t i = 0; i < equations.size(); ++i) {
        for (std::size_t side = 0; side < 2; ++side) {
          const int body = equations.bodies(i)[side];
          if (body != ground_body) forces[body] += equations.reaction(i, side, lambda);
        }
      }
    }
  }

  /// Whether an element has series springs.
  [[nodiscard]] bool has_series(std::size_t element) const {
    return series_offsets_[element] < series_offsets_[element + 1];
  }

  /// The elongations of an element's series springs, in its a's axes; zero without [m].
  template <class State>
  [[nodiscard]] Vector3<T> elongation_a(const State& y, std::size_t element) const {
    Vector3<T> elongation_a = Vector3<T>::Zero();
    if (!has_series(element)) return elongation_a;
    const Vector3<T>& stiffness_a = model_.spring_dampers[element].series_stiffness_a;
    Eigen::Index row = series_offsets_[element];
    for (Eigen::Index i = 0; i < 3; ++i) {
      if (T(0) < stiffness_a(i)) elongation_a(i) = y(row++);
    }
    return elongation_a;
  }

  /// The sum of @p term(element, motion of a, motion of b[, elongation]).
  template <class State, class Term>
  [[nodiscard]] T sum_over_elements(const State& y, const Motions& motions,
                                    const Term& term) const {
    T sum = T(0);
    for (std::size_t i = 0; i < model_.spring_dampers.size(); ++i) {
      const SpringDamper<T>& e = model_.spring_dampers[i];
      sum += term(e, motions[e.a], motions[e.b], elongation_a(y, i));
    }
    for (const TorsionSpring<T>& e : model_.torsion_springs) {
      sum += term(e, motions[e.a], motions[e.b]);
    }
    return sum;
  }

  /// g of (91) of each body. @param take_rate is told the row and the rate of each series spring.
  template <class State, class TakeRate>
  [[nodiscard]] Forces without_joints(const State& y, const Motions& motions,
                                      std::span<const Wrench<T>> external_wrenches,
                                      const TakeRate& take_rate) const {
    WHEELRAIL_ASSERT(external_wrenches.size() == body_count());
    detail::BodyArray<Wrench<T>, MaximumBodies> wrenches(Wrench<T>{}, count(), [&](int i) {
      const Wrench<T>& external = external_wrenches[static_cast<std::size_t>(i)];
      return Wrench<T>{external.force_world + body(i).mass() * model_.gravity_world,
                       external.moment_world};
    });
    for (std::size_t i = 0; i < model_.spring_dampers.size(); ++i) {
      const SpringDamper<T>& e = model_.spring_dampers[i];
      const BodyMotion<T>& a = motions[e.a];
      const BodyMotion<T>& b = motions[e.b];
      const SpringDamperAction<T> act = action(e, a, b, elongation_a(y, i));
      const Vector3<T>& force_world = act.force_b_world;
      const Vector3<T> arm_a_world = act.point_world - a.position_world;
      const Vector3<T> arm_b_world = act.point_world - b.position_world;
      wrenches[e.a].force_world -= force_world;
      wrenches[e.a].moment_world -= cross(arm_a_world, force_world);
      wrenches[e.b].force_world += force_world;
      wrenches[e.b].moment_world += cross(arm_b_world, force_world);
      if (!has_series(i)) continue;
      Eigen::Index row = series_offsets_[i];
      for (Eigen::Index k = 0; k < 3; ++k) {
        if (T(0) < e.series_stiffness_a(k)) take_rate(row++, act.elongation_rate_a(k));
      }
    }
    for (const TorsionSpring<T>& e : model_.torsion_springs) {
      const Vector3<T> moment_world = moment_b_world(e, motions[e.a], motions[e.b]);
      wrenches[e.a].moment_world -= moment_world;
      wrenches[e.b].moment_world += moment_world;
    }
    return Forces(Vector6<T>::Zero(), count(), [&](int i) {
      const Vector3<T> spin_body = y.template segment<3>(RigidBodyLayout::offset(i) +
                                                         RigidBodyLayout::angular_velocity_body);
      return generalized_force(body(i), motions[i].body_to_world, spin_body, wrenches[i]);
    });
  }

  MultibodyModel<T> model_;
  std::vector<Group> groups_;
  Forces inverse_masses_;                     ///< the diagonal of M^-1; zero for the ground
  std::vector<Eigen::Index> series_offsets_;  ///< of each element's, and where the last end
  Eigen::Index state_size_;
};

}  // namespace wheelrail
