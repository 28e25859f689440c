#pragma once
// One strip of a contact search, as it is, and as it may become while the wheel moves a little.
// May include: core, numerics, profile, surface, contact/placement.

#include <wheelrail/contact/placement.hpp>

namespace wheelrail::detail {

// A strip with its penetration and d penetration / d wheel_lateral.
template <Real T>
struct LocusStrip {
  T wheel_lateral = T(0);  // [m]
  T rail_lateral = T(0);   // of the foot [m]
  T penetration = T(0);    // [m]
  T slope = T(0);          // [-]
  T slope_rate = T(0);     // d slope / d wheel_lateral; as find_contact.hpp has it [1/m]
  Vector2<T> normal_rail{T(0), T(0)};  // out of the rail at the foot: (lateral, up)
  int piece = -1;                      // of the wheel's profile
  bool exists = false;   // false where the strip has no locus point, or the rail no foot for it
  bool is_exact = true;  // false: the wheel has moved since, but the slope kept its sign
  // Of one that is not exact: whether it penetrates.
  enum class Side { unknown, outside, inside } side = Side::unknown;

  // A strip that does not move has ranges of one value.
  [[nodiscard]] const T& least_penetration() const { return penetration; }
  [[nodiscard]] const T& greatest_penetration() const { return penetration; }
  [[nodiscard]] const T& least_slope() const { return slope; }
  [[nodiscard]] const T& greatest_slope() const { return slope; }
  [[nodiscard]] const T& least_foot() const { return rail_lateral; }
  [[nodiscard]] const T& greatest_foot() const { return rail_lateral; }
  static constexpr bool moves = false;
};

// What a zone keeps of its deepest strip.
template <Real T>
struct DeepestStrip {
  T wheel_lateral = T(0), penetration = T(0);  // [m]
  int piece = -1;
  bool is_exact = true;

  DeepestStrip() = default;
  DeepestStrip(const LocusStrip<T>& strip)  // not explicit, to be assigned as strips are
      : wheel_lateral(strip.wheel_lateral),
        penetration(strip.penetration),
        piece(strip.piece),
        is_exact(strip.is_exact) {}
};

// What a strip keeps within while the wheel moves.
template <Real T>
struct MovingStrip {
  T wheel_lateral = T(0);
  T penetration = T(0), penetration_change = T(0);  // [m]
  T slope = T(0), slope_change = T(0);              // [-]
  T foot = T(0), foot_change = T(0);                // [m]
  Vector2<T> normal_rail{T(0), T(0)};               // at the foot
  T normal_change = T(0);                           // of it, by its length
  bool exists = false;  // in all of its range, and nothing of it is unbounded

  [[nodiscard]] T least_penetration() const { return penetration - penetration_change; }
  [[nodiscard]] T greatest_penetration() const { return penetration + penetration_change; }
  [[nodiscard]] T least_slope() const { return slope - slope_change; }
  [[nodiscard]] T greatest_slope() const { return slope + slope_change; }
  [[nodiscard]] T least_foot() const { return foot - foot_change; }
  [[nodiscard]] T greatest_foot() const { return foot + foot_change; }
  static constexpr bool moves = true;
};

}  // namespace wheelrail::detail
