#pragma once
/// @file
/// A rail profile turned inwards by the track's inclination: its highest point, and the point at
/// which the gauge is measured. May include: core, numerics, profile, surface.

#include <wheelrail/core/require.hpp>
#include <wheelrail/numerics/lifted_root.hpp>
#include <wheelrail/profile/profile.hpp>

namespace wheelrail {

namespace detail {

/// Depth below the highest points at which the gauge is measured [m].
template <Real T>
[[nodiscard]] constexpr T gauge_depth() {
  return constant<T>(0.014L);
}

/// A profile turned inwards about its origin: coordinates in the track's section, origin kept.
template <Profile R>
struct InclinedProfile {
  using T = typename R::Scalar;
  const R& profile;
  T sine = T(0);
  T cosine = T(0);

  [[nodiscard]] T outboard(const T& u, const ProfilePoint<T>& point) const {
    return cosine * u - sine * point.value;
  }
  [[nodiscard]] T up(const T& u, const ProfilePoint<T>& point) const {
    return sine * u + cosine * point.value;
  }

  /// Lateral coordinate of the highest point; an end of the profile where that is highest.
  [[nodiscard]] T highest() const {
    T best = profile.lower();
    T best_up = up(best, profile.evaluate(best));
    const auto offer = [&](const T& u) {
      const T height = up(u, profile.evaluate(u));
      if (best_up < height) {
        best_up = height;
        best = u;
      }
    };
    for (int piece = 0; piece < profile.piece_count(); ++piece) {
      const T lower = profile.joint(piece), upper = profile.joint(piece + 1);
      const auto rise = [&](const T& u) {
        return T(sine + cosine * profile.evaluate(piece, u).slope);
      };
      const int samples = 64;
      T left = lower, rise_left = rise(lower);
      for (int i = 1; i <= samples; ++i) {
        const T right = i == samples ? upper : T(lower + (upper - lower) * T(i) / T(samples));
        const T rise_right = rise(right);
        if (T(0) < rise_left && !(T(0) < rise_right)) {
          offer(lifted_root<T>(
              value_of(bracketed_root<T>(rise, left, right, rise_left, rise_right).position),
              [&](const T& u) {
                const ProfilePoint<T> point = profile.evaluate(piece, u);
                return ValueAndSlope<T>{sine + cosine * point.slope,
                                        cosine * point.second_derivative};
              }));
        }
        offer(right);
        left = right;
        rise_left = rise_right;
      }
    }
    return best;
  }

  /// Lateral coordinate of the point on the gauge side that lies @p depth below the highest point.
  /// @throws std::invalid_argument when the profile ends before.
  [[nodiscard]] T gauge_point(const T& top, const T& depth) const {
    const T level = up(top, profile.evaluate(top)) - depth;
    const T lowest = up(profile.lower(), profile.evaluate(profile.lower()));
    require(lowest < level, "rail profile: its gauge side ends " +
                                to_text(T(level + depth - lowest)) +
                                " m below the highest point, but must reach at least " +
                                to_text(depth) + " m, where the gauge is measured");
    const auto above = [&](const T& u) { return T(up(u, profile.evaluate(u)) - level); };
    return lifted_root<T>(
        value_of(bracketed_root<T>(above, profile.lower(), top, T(lowest - level), depth).position),
        [&](const T& u) {
          const ProfilePoint<T> point = profile.evaluate(u);
          return ValueAndSlope<T>{up(u, point) - level, sine + cosine * point.slope};
        });
  }
};

}  // namespace detail

}  // namespace wheelrail
