#pragma once
// A joint in the centres of mass of its two bodies, such as that of a wheelset and its axleboxes.
// May include: core, numerics, dynamics, Eigen, std.

#include <array>
#include <wheelrail/dynamics/revolute_joint.hpp>
#include <wheelrail/numerics/semidefinite_cholesky.hpp>

namespace wheelrail::detail {

// One of the two bodies. The ground has neither force nor inverse mass.
template <Real T>
struct JointedBody {
  const BodyMotion<T>& motion;
  const Vector6<T>& inverse_mass;  // the diagonal of M^-1
  const Vector6<T>& force;         // g of (91)
};

// What JointGroupEquations::reaction gives for both sides of a joint with is_centred() that is a
// group of its own. The point's rows of Phi_q are those of I and of -I in the translations, the
// axis' rows have rotations alone, so that Phi_q M^-1 Phi_q^T falls apart: into a diagonal, the same
// three times, and two rows.
template <Real T>
[[nodiscard]] std::array<Vector6<T>, 2> centred_reactions(const RevoluteJoint<T>& joint,
                                                          const JointedBody<T>& a,
                                                          const JointedBody<T>& b, const T& alpha,
                                                          const T& beta) {
  const T twice_alpha = T(2) * alpha, beta_squared = beta * beta;
  const Vector3<T> pull = (a.force.template head<3>() * a.inverse_mass(0) -
                           b.force.template head<3>() * b.inverse_mass(0) +
                           twice_alpha * (a.motion.velocity_world - b.motion.velocity_world) +
                           beta_squared * (a.motion.position_world - b.motion.position_world)) *
                          T(T(1) / (a.inverse_mass(0) + b.inverse_mass(0)));

  const JointAxisEquations<T> e = joint.axis_equations(a.motion, b.motion);
  using Solver = SemidefiniteCholesky<T, 2, 2>;
  typename Solver::Vector sum = twice_alpha * e.residual_rate + beta_squared * e.residual - e.gamma;
  typename Solver::Matrix matrix = Solver::Matrix::Zero();
  for (std::size_t side = 0; side < 2; ++side) {
    const JointedBody<T>& body = side == 0 ? a : b;
    for (Eigen::Index i = 0; i < 2; ++i) {
      const Vector3<T> turn =
          body.inverse_mass.template tail<3>().cwiseProduct(e.gradients[side].col(i));
      sum(i) += dot(turn, Vector3<T>(body.force.template tail<3>()));
      for (Eigen::Index j = 0; j <= i; ++j) {
        matrix(i, j) += dot(turn, Vector3<T>(e.gradients[side].col(j)));
      }
    }
  }
  const typename Solver::Vector lambda = Solver(matrix).solve(sum);
  std::array<Vector6<T>, 2> reactions;
  reactions[0].template head<3>() = -pull;
  reactions[1].template head<3>() = pull;
  for (std::size_t side = 0; side < 2; ++side) {
    reactions[side].template tail<3>() =
        -(e.gradients[side].col(0) * lambda(0) + e.gradients[side].col(1) * lambda(1));
  }
  return reactions;
}

}  // namespace wheelrail::detail
