#pragma once
// Joints that share bodies, whose Lagrange multipliers have to be solved for together. May include:
// core, numerics, dynamics, Eigen, std.

#include <array>
#include <cstddef>
#include <numeric>
#include <span>
#include <string>
#include <vector>
#include <wheelrail/core/fixed_list.hpp>
#include <wheelrail/dynamics/revolute_joint.hpp>
#include <wheelrail/numerics/semidefinite_cholesky.hpp>

namespace wheelrail::detail {

// Indices of joints.
template <std::size_t MaximumJoints>
using JointGroup = FixedList<std::size_t, MaximumJoints>;

// The connected components of the graph of bodies and joints, the ground left out, each in the
// order of the joints. Throws std::invalid_argument where one has more than MaximumJoints.
template <std::size_t MaximumJoints, Real T>
[[nodiscard]] std::vector<JointGroup<MaximumJoints>> joint_groups(
    std::span<const RevoluteJoint<T>> joints, std::size_t bodies) {
  std::vector<std::size_t> label(bodies);  // of each body: the least index that it is connected to
  std::iota(label.begin(), label.end(), std::size_t{0});
  const auto body_of = [](const RevoluteJoint<T>& joint) {  // one that is not the ground
    const auto [a, b] = joint.bodies();
    return static_cast<std::size_t>(a == ground_body ? b : a);
  };
  for (const RevoluteJoint<T>& joint : joints) {
    const auto [a, b] = joint.bodies();
    if (a == ground_body || b == ground_body) continue;
    const std::size_t one = label[static_cast<std::size_t>(a)];
    const std::size_t other = label[static_cast<std::size_t>(b)];
    for (std::size_t& l : label) {
      if (l == std::max(one, other)) l = std::min(one, other);
    }
  }
  std::vector<JointGroup<MaximumJoints>> of_label(bodies);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const std::size_t body = body_of(joints[i]);
    require(of_label[label[body]].push_back(i),
            std::string("joints[")
                .append(std::to_string(i))
                .append("] is connected to ")
                .append(std::to_string(MaximumJoints))
                .append(" joints before it, but must be to less: the system's MaximumJoints"));
  }
  std::erase_if(of_label, [](const auto& group) { return group.empty(); });
  return of_label;
}

// (91) of one group, reduced to the multipliers: with a = M^-1 (g - Phi_q^T lambda),
// (Phi_q M^-1 Phi_q^T) lambda = Phi_q M^-1 g - (gamma - 2 alpha Phi' - beta^2 Phi).
template <Real T, std::size_t MaximumJoints>
class JointGroupEquations {
 public:
  using Vector = typename SemidefiniteCholesky<T, 5 * static_cast<int>(MaximumJoints)>::Vector;
  using Rotation = Eigen::Matrix<T, 5, 3, Eigen::DontAlign>;
  using Jacobian = typename JointEquations<T>::Jacobian;

  // motions[int] -> BodyMotion, of the ground too.
  template <class Motions>
  JointGroupEquations(std::span<const RevoluteJoint<T>> joints, std::span<const std::size_t> group,
                      const Motions& motions)
      : size_(group.size()) {
    for (std::size_t i = 0; i < size_; ++i) {
      const RevoluteJoint<T>& joint = joints[group[i]];
      bodies_[i] = joint.bodies();
      equations_[i] = joint.equations(motions[bodies_[i][0]], motions[bodies_[i][1]]);
    }
  }

  // lambda [N, N m], from M^-1 and g: [int] -> Vector6.
  template <class Forces>
  [[nodiscard]] Vector multipliers(const Forces& inverse_masses, const Forces& forces,
                                   const T& alpha, const T& beta) const {
    if (size_ == 1) {  // as most are: sizes that the compiler knows
      return solve<SemidefiniteCholesky<T, 5, 5>>(1, inverse_masses, forces, alpha, beta);
    }
    return solve<SemidefiniteCholesky<T, 5 * static_cast<int>(MaximumJoints)>>(
        size_, inverse_masses, forces, alpha, beta);
  }

  // -Phi_q^T lambda of joint i on its side (0 is a, 1 is b), as RigidBody's generalized_force.
  [[nodiscard]] Vector6<T> reaction(std::size_t i, std::size_t side, const Vector& lambda) const {
    const Jacobian& jacobian = equations_[i].jacobians[side];
    Vector6<T> reaction;
    const Vector5<T> pull = -lambda.template segment<5>(row(i));
    reaction.template head<3>() = translation(jacobian).cwiseProduct(pull.template head<3>());
    reaction.template tail<3>() = rotation(jacobian).transpose().lazyProduct(pull);
    return reaction;
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const std::array<int, 2>& bodies(std::size_t i) const { return bodies_[i]; }

 private:
  // size == size_; a number that the compiler knows with a solver of known size.
  template <class Solver, class Forces>
  [[nodiscard]] typename Solver::Vector solve(std::size_t size, const Forces& inverse_masses,
                                              const Forces& forces, const T& alpha,
                                              const T& beta) const {
    const Eigen::Index rows = 5 * static_cast<Eigen::Index>(size);
    typename Solver::Matrix matrix = Solver::Matrix::Zero(rows, rows);
    typename Solver::Vector rhs(rows);
    const T twice_alpha = T(2) * alpha, beta_squared = beta * beta;
    for (std::size_t i = 0; i < size; ++i) {
      const JointEquations<T>& e = equations_[i];
      Vector5<T> sum = twice_alpha * e.residual_rate + beta_squared * e.residual - e.gamma;
      for (std::size_t side = 0; side < 2; ++side) {
        const int body = bodies_[i][side];
        if (body == ground_body) continue;
        const Vector6<T>& inverse_mass = inverse_masses[body];
        // Phi_q M^-1: of the translation its diagonal, then of the rotation.
        const Vector3<T> pull =
            translation(e.jacobians[side]).cwiseProduct(inverse_mass.template head<3>());
        const Rotation turn =
            rotation(e.jacobians[side]) * inverse_mass.template tail<3>().asDiagonal();
        sum.template head<3>() += pull.cwiseProduct(forces[body].template head<3>());
        sum += turn.lazyProduct(forces[body].template tail<3>());
        // The lower triangle of Phi_q M^-1 Phi_q^T by the pairs that share this body.
        for (std::size_t j = 0; j <= i; ++j) {
          for (std::size_t other = 0; other < 2; ++other) {
            if (bodies_[j][other] != body) continue;
            const Jacobian& jacobian = equations_[j].jacobians[other];
            auto block = matrix.template block<5, 5>(row(i), row(j));
            block += turn.lazyProduct(rotation(jacobian).transpose());
            block.diagonal().template head<3>() += pull.cwiseProduct(translation(jacobian));
          }
        }
      }
      rhs.template segment<5>(row(i)) = sum;
    }
    return Solver(matrix).solve(rhs);
  }

  // What of the columns of a translation is not zero: the diagonal of the point's rows.
  static auto translation(const Jacobian& jacobian) {
    return jacobian.template topLeftCorner<3, 3>().diagonal();
  }
  static auto rotation(const Jacobian& jacobian) { return jacobian.template rightCols<3>(); }

  static Eigen::Index row(std::size_t i) { return 5 * static_cast<Eigen::Index>(i); }

  std::array<JointEquations<T>, MaximumJoints> equations_;
  std::array<std::array<int, 2>, MaximumJoints> bodies_;
  std::size_t size_;
};

}  // namespace wheelrail::detail
