#pragma once
/// @file
/// Left and right. Both sides are computed by the same code in a frame whose lateral axis points to
/// the field side; `Side` says how that frame lies in the track.
/// May include: core, std.

#include <array>
#include <wheelrail/core/scalar.hpp>

namespace wheelrail {

/// Seen in the direction of travel (+x of the track frame).
enum class Side { left, right };

/// Both sides in the order in which results are listed.
inline constexpr std::array<Side, 2> sides{Side::left, Side::right};

/// +1 on the left, -1 on the right: the track's y component of the direction to the field side.
template <Real T>
[[nodiscard]] constexpr T outboard_sign(Side side) {
  return side == Side::left ? T(1) : T(-1);
}

/// The name used in tables: "left" or "right".
[[nodiscard]] constexpr const char* name_of(Side side) {
  return side == Side::left ? "left" : "right";
}

/// 0 on the left, 1 on the right, to index arrays ordered as `sides`.
[[nodiscard]] constexpr std::size_t index_of(Side side) {
  return side == Side::left ? 0U : 1U;
}

}  // namespace wheelrail
