#pragma once
/// @file
/// Nodes of Gauss-Legendre quadrature. May include: core, std.

#include <array>
#include <wheelrail/core/scalar.hpp>

namespace wheelrail::detail {

/// A pair of abscissae, +abscissa and -abscissa on [-1, 1], and the weight of each.
template <Real T>
struct QuadratureNode {
  T abscissa = T(0), weight = T(0);
};

/// Eight points: exact for polynomials up to degree 15.
template <Real T>
inline constexpr std::array<QuadratureNode<T>, 4> gauss_legendre_8{
    {{constant<T>(0.183434642495649804939476L), constant<T>(0.362683783378361982965150L)},
     {constant<T>(0.525532409916328985817739L), constant<T>(0.313706645877887287337962L)},
     {constant<T>(0.796666477413626739591554L), constant<T>(0.222381034453374470544356L)},
     {constant<T>(0.960289856497536231683561L), constant<T>(0.101228536290376259152531L)}}};

}  // namespace wheelrail::detail
