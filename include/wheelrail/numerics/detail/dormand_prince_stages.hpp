#pragma once
/// @file
/// The coefficients of the Dormand-Prince pair 5(4), as the weighted sums of its stages that
/// numerics/dormand_prince.hpp is made of. Table 5.2 of E. Hairer, S. P. Norsett, G. Wanner,
/// Solving Ordinary Differential Equations I, 2nd ed. (1993), II.5; dense output: their contd5.
/// May include: core, Eigen, std.

#include <array>
#include <wheelrail/core/scalar.hpp>

namespace wheelrail::detail {

/// The seven derivatives of one step, k_1 first; f(t, y) and, last, f(t + h, y_new).
template <class State>
using DormandPrinceStages = std::array<State, 7>;

/// Every ratio is rounded once, from long double.
template <Real T>
[[nodiscard]] constexpr T ratio_of(long double numerator, long double denominator) {
  return constant<T>(numerator / denominator);
}

/// Where stage @p index (0 to 6) stands in the step [-].
template <Real T>
[[nodiscard]] T dormand_prince_node(std::size_t index) {
  const T nodes[] = {
      T(0), ratio_of<T>(1, 5), ratio_of<T>(3, 10), ratio_of<T>(4, 5), ratio_of<T>(8, 9), T(1),
      T(1)};
  return nodes[index];
}

/// Where stage @p index (1 to 6) of a step @p h from @p y is evaluated, by the stages before; for
/// stage 6 that is the end of the step itself, of order 5.
template <class State>
[[nodiscard]] State dormand_prince_point(const State& y, const typename State::Scalar& h,
                                         const DormandPrinceStages<State>& k, std::size_t index) {
  constexpr auto c = ratio_of<typename State::Scalar>;
  switch (index) {
    case 1:
      return y + h * (c(1, 5) * k[0]);
    case 2:
      return y + h * (c(3, 40) * k[0] + c(9, 40) * k[1]);
    case 3:
      return y + h * (c(44, 45) * k[0] + c(-56, 15) * k[1] + c(32, 9) * k[2]);
    case 4:
      return y + h * (c(19372, 6561) * k[0] + c(-25360, 2187) * k[1] + c(64448, 6561) * k[2] +
                      c(-212, 729) * k[3]);
    case 5:
      return y + h * (c(9017, 3168) * k[0] + c(-355, 33) * k[1] + c(46732, 5247) * k[2] +
                      c(49, 176) * k[3] + c(-5103, 18656) * k[4]);
    default:
      return y + h * (c(35, 384) * k[0] + c(500, 1113) * k[2] + c(125, 192) * k[3] +
                      c(-2187, 6784) * k[4] + c(11, 84) * k[5]);
  }
}

/// The estimate of the error, over the step: the difference of the orders 5 and 4.
template <class State>
[[nodiscard]] State dormand_prince_error(const DormandPrinceStages<State>& k) {
  constexpr auto c = ratio_of<typename State::Scalar>;
  return c(71, 57600) * k[0] + c(-71, 16695) * k[2] + c(71, 1920) * k[3] +
         c(-17253, 339200) * k[4] + c(22, 525) * k[5] + c(-1, 40) * k[6];
}

/// What the dense output of order 4 needs beyond the states and derivatives at both ends, over the
/// step: the coefficient of s^2 (1 - s)^2.
template <class State>
[[nodiscard]] State dormand_prince_dense(const DormandPrinceStages<State>& k) {
  constexpr auto c = ratio_of<typename State::Scalar>;
  return c(-12715105075.0L, 11282082432.0L) * k[0] + c(87487479700.0L, 32700410799.0L) * k[2] +
         c(-10690763975.0L, 1880347072.0L) * k[3] + c(701980252875.0L, 199316789632.0L) * k[4] +
         c(-1453857185.0L, 822651844.0L) * k[5] + c(69997945.0L, 29380423.0L) * k[6];
}

}  // namespace wheelrail::detail
