#pragma once
/// @file
/// The paper's simplified wheel profile (§2.2): every concave zone is cut away along the tangents
/// at its two ends, down to the point where these meet. What is left is a chain of convex curves
/// with a concave corner between neighbours. May include: core, numerics, profile.

#include <string>
#include <vector>
#include <wheelrail/core/require.hpp>
#include <wheelrail/profile/inspection.hpp>

namespace wheelrail {

/// @p P without its concave zones. A Profile itself.
/// Invariant: each corner lies inside the zone that it replaces, and the value nowhere exceeds that
/// of the original by more than rounding.
/// @note Evaluation does not allocate.
template <Profile P>
class ConvexModification {
 public:
  using Scalar = typename P::Scalar;
  using T = Scalar;

  /// A concave zone that was cut away, and the corner that replaced it.
  struct Corner {
    LateralInterval<T> zone;  ///< the concave interval [m]
    T lateral{};              ///< of the corner [m]
    T value{};                ///< of the corner [m]
  };

  /// @throws std::invalid_argument when the tangents at the ends of a concave zone do not meet
  ///   inside it, or lie outside the profile.
  explicit ConvexModification(P original) : original_(std::move(original)) {
    for (const auto& zone : concave_intervals(original_)) cut(zone);
    build_pieces();
  }

  [[nodiscard]] const P& original() const { return original_; }
  [[nodiscard]] const std::vector<Corner>& corners() const { return corners_; }

  [[nodiscard]] T lower() const { return original_.lower(); }
  [[nodiscard]] T upper() const { return original_.upper(); }
  [[nodiscard]] int piece_count() const { return static_cast<int>(pieces_.size()); }
  [[nodiscard]] T joint(int i) const {
    return i < piece_count() ? pieces_[static_cast<std::size_t>(i)].lower : upper();
  }
  [[nodiscard]] ProfilePoint<T> evaluate(const T& lateral) const {
    return evaluate(piece_of(*this, lateral), lateral);
  }
  [[nodiscard]] ProfilePoint<T> evaluate(int piece, const T& lateral) const {
    const Piece& at = pieces_[static_cast<std::size_t>(piece)];
    if (at.original_piece >= 0) return original_.evaluate(at.original_piece, lateral);
    return {at.value + at.slope * (lateral - at.lateral), at.slope, T(0)};
  }
  /// @pre as for evaluate, lower <= upper
  [[nodiscard]] DerivativeBounds<T> derivative_bounds(
      int piece, const T& lower, const T& upper) const requires HasDerivativeBounds<P> {
    const int original = pieces_[static_cast<std::size_t>(piece)].original_piece;
    return original < 0 ? DerivativeBounds<T>{}
                        : original_.derivative_bounds(original, lower, upper);
  }
  [[nodiscard]] CurvatureBounds<T> curvature_bounds(
      int piece, const T& lower, const T& upper) const requires HasDerivativeBounds<P> {
    const int original = pieces_[static_cast<std::size_t>(piece)].original_piece;
    return original < 0 ? CurvatureBounds<T>{} : original_.curvature_bounds(original, lower, upper);
  }

 private:
  // A piece of the original (original_piece >= 0) or a straight line through (lateral, value).
  struct Piece {
    T lower{};
    int original_piece = -1;
    T lateral{}, value{}, slope{};
  };

  // The original from outside the zone: the limit at its lower end from below, at its upper end
  // from above.
  [[nodiscard]] ProfilePoint<T> below(const T& lateral) const {
    const int piece = piece_of(original_, lateral);
    const bool at_joint = piece > 0 && original_.joint(piece) == lateral;
    return original_.evaluate(at_joint ? piece - 1 : piece, lateral);
  }

  void cut(const LateralInterval<T>& zone) {
    using std::sqrt;
    const ProfilePoint<T> left = below(zone.lower);
    const ProfilePoint<T> right = original_.evaluate(zone.upper);
    const T lateral =
        (right.value - left.value + left.slope * zone.lower - right.slope * zone.upper) /
        (left.slope - right.slope);
    detail::require(zone.lower < lateral && lateral < zone.upper,
                    "convex modification: the tangents at the ends of the concave zone [" +
                        detail::to_text(zone.lower) + ", " + detail::to_text(zone.upper) +
                        "] m do not meet inside it");
    const T value = left.value + left.slope * (lateral - zone.lower);
    // A convex corner inside the zone could stick out of the tangents: look at samples of it.
    const T tolerance = sqrt(epsilon<T>()) * (zone.upper - zone.lower);
    constexpr int samples = 256;
    for (int i = 1; i < samples; ++i) {
      const T at = zone.lower + (zone.upper - zone.lower) * T(i) / T(samples);
      const T tangent = at < lateral ? T(left.value + left.slope * (at - zone.lower))
                                     : T(right.value + right.slope * (at - zone.upper));
      detail::require(tangent <= original_.evaluate(at).value + tolerance,
                      "convex modification: at lateral " + detail::to_text(at) +
                          " m the tangents at the ends of the concave zone [" +
                          detail::to_text(zone.lower) + ", " + detail::to_text(zone.upper) +
                          "] m lie outside the profile");
    }
    corners_.push_back({zone, lateral, value});
  }

  void build_pieces() {
    std::size_t next = 0;
    T reached = original_.lower();
    for (int piece = 0; piece < original_.piece_count(); ++piece) {
      const T end = original_.joint(piece + 1);
      while (reached < end) {
        const bool corner_here = next < corners_.size() && corners_[next].zone.lower < end;
        if (!corner_here) {
          pieces_.push_back({reached, piece, T(0), T(0), T(0)});
          reached = end;
          break;
        }
        const Corner& corner = corners_[next++];
        if (reached < corner.zone.lower) pieces_.push_back({reached, piece, T(0), T(0), T(0)});
        const ProfilePoint<T> left = below(corner.zone.lower);
        const ProfilePoint<T> right = original_.evaluate(corner.zone.upper);
        pieces_.push_back({corner.zone.lower, -1, corner.zone.lower, left.value, left.slope});
        pieces_.push_back({corner.lateral, -1, corner.zone.upper, right.value, right.slope});
        reached = corner.zone.upper;
      }
    }
  }

  P original_;
  std::vector<Corner> corners_;
  std::vector<Piece> pieces_;
};

}  // namespace wheelrail
