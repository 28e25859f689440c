#pragma once
/// @file
/// Inspection of profiles: how well the pieces meet at their joints, and where the body is concave.
/// For construction and reports, not for the hot path: these functions allocate.
/// May include: core, numerics, profile.

#include <vector>
#include <wheelrail/core/scalar_value.hpp>
#include <wheelrail/numerics/bracketed_root.hpp>
#include <wheelrail/profile/profile.hpp>

namespace wheelrail {

/// Jumps at an inner joint: the limit from the flange (lower) side less that from the field side.
template <Real T>
struct ProfileJoint {
  T lateral = T(0);         ///< [m]
  T value_jump = T(0);      ///< [m]
  T slope_jump = T(0);      ///< [-]; negative where the corner is concave
  T curvature_jump = T(0);  ///< [1/m], curvature positive where convex
};

/// The inner joints of @p profile from the lower end to the upper.
template <Profile P>
[[nodiscard]] std::vector<ProfileJoint<typename P::Scalar>> inspect_joints(const P& profile) {
  std::vector<ProfileJoint<typename P::Scalar>> joints;
  for (int piece = 1; piece < profile.piece_count(); ++piece) {
    const auto lateral = profile.joint(piece);
    const auto below = profile.evaluate(piece - 1, lateral);
    const auto above = profile.evaluate(piece, lateral);
    joints.push_back({lateral, below.value - above.value, below.slope - above.slope,
                      curvature(below) - curvature(above)});
  }
  return joints;
}

/// An interval of the lateral coordinate [m].
template <Real T>
struct LateralInterval {
  T lower = T(0);  ///< [m]
  T upper = T(0);  ///< [m]
};

/// Where the body is concave (second derivative > 0), from the lower end to the upper; intervals
/// that meet at a joint are one. Inside a piece the second derivative is sampled at
/// @p samples_per_piece + 1 points and its sign changes are solved for to rounding: a concave dent
/// narrower than a sample spacing can go unseen.
/// @param samples_per_piece at least 1.
template <Profile P>
[[nodiscard]] std::vector<LateralInterval<typename P::Scalar>> concave_intervals(
    const P& profile, int samples_per_piece = 256) {
  using T = typename P::Scalar;
  std::vector<LateralInterval<T>> intervals;
  const auto add = [&intervals](const T& lower, const T& upper) {
    if (!intervals.empty() && intervals.back().upper == lower) {
      intervals.back().upper = upper;
    } else {
      intervals.push_back({lower, upper});
    }
  };
  for (int piece = 0; piece < profile.piece_count(); ++piece) {
    const T lower = profile.joint(piece);
    const T upper = profile.joint(piece + 1);
    const auto second = [&](const T& u) { return profile.evaluate(piece, u).second_derivative; };
    T left = lower;
    T second_left = second(left);
    for (int i = 1; i <= samples_per_piece; ++i) {
      const T right =
          i == samples_per_piece ? upper : T(lower + (upper - lower) * T(i) / T(samples_per_piece));
      const T second_right = second(right);
      const bool concave_left = T(0) < second_left;
      const bool concave_right = T(0) < second_right;
      if (concave_left && concave_right) {
        add(left, right);
      } else if (concave_left != concave_right) {
        // A tangent there does not turn with its point: the root needs no derivatives.
        const T inflection =
            T(value_of(bracketed_root<T>(second, left, right, second_left, second_right).position));
        if (concave_left && left < inflection) add(left, inflection);
        if (concave_right && inflection < right) add(inflection, right);
      }
      left = right;
      second_left = second_right;
    }
  }
  return intervals;
}

}  // namespace wheelrail
