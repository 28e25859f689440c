#pragma once
/// @file
/// The paper's simplified wheel profile (§2.2): every concave zone is cut away along the tangents
/// at its two ends, down to the point where these meet. What is left is a chain of convex curves
/// with a concave corner between neighbours. May include: core, numerics, profile.
///
/// The noise of a measured wheel makes several concave zones of one, with slivers between them that
/// are convex by less than the noise. Cut one by one they leave the tread where it was, hollow but
/// for waves. So zones between which the profile is convex by less than a sliver are one.

#include <string>
#include <vector>
#include <wheelrail/core/require.hpp>
#include <wheelrail/profile/inspection.hpp>
#include <wheelrail/profile/value_profile.hpp>

namespace wheelrail {

namespace detail {

/// What a profile says of its own noise [m]; 0 of one that does not.
template <Profile P>
[[nodiscard]] typename P::Scalar noise_of(const P& profile) {
  if constexpr (requires { profile.report().noise; }) {
    return profile.report().noise;
  } else {
    return typename P::Scalar(0);
  }
}

}  // namespace detail

/// @p P without its concave zones. A Profile itself.
/// Invariant: each corner lies inside the zone that it replaces, and the value nowhere exceeds that
/// of the original by more than rounding.
/// @note Evaluation does not allocate.
template <Profile P>
class ConvexModification {
 public:
  using Scalar = typename P::Scalar;  ///< the numbers of its coordinates
  using T = Scalar;                   ///< the same, short

  /// A concave zone that was cut away, and the corner that replaced it.
  struct Corner {
    LateralInterval<T> zone;  ///< the concave interval, slivers in it included [m]
    T lateral = T(0);         ///< of the corner [m]
    T value = T(0);           ///< of the corner [m]
  };

  /// With the noise of the profile as the height of a sliver: 0 for an analytic one.
  /// @throws std::invalid_argument when the tangents at the ends of a concave zone do not meet
  ///   inside it, or lie outside the profile.
  explicit ConvexModification(P original)
      : original_(std::move(original)), sliver_height_(detail::noise_of(original_)) {
    build(sliver_height_);
  }
  /// @param sliver_height concave zones are one where all between them is convex and stands off the
  ///   straight line from one to the other by less than this, >= 0, and where the tangents at the
  ///   outer ends lie inside all of it [m].
  /// @throws std::invalid_argument as above, and unless sliver_height is finite and >= 0.
  ConvexModification(P original, const T& sliver_height)
      : original_(std::move(original)), sliver_height_(sliver_height) {
    detail::require_not_negative("convex modification: sliver height", sliver_height, "[m]");
    build(sliver_height);
  }

  /// The same in another scalar. @throws std::invalid_argument as the constructor does.
  template <Real U>
  [[nodiscard]] auto cast() const requires CastsTo<P, U> {
    auto original = original_.template cast<U>();
    return ConvexModification<decltype(original)>(std::move(original),
                                                  scalar_cast<U>(sliver_height_));
  }

  [[nodiscard]] const P& original() const { return original_; }  ///< with its concave zones
  /// In lateral order.
  [[nodiscard]] const std::vector<Corner>& corners() const { return corners_; }

  /// @name Of the concept Profile
  /// @{

  /// As Profile says it: lengths in m, pieces and joints from 0.
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
  /// @}

 private:
  // A piece of the original (original_piece >= 0) or a straight line through (lateral, value).
  struct Piece {
    T lower = T(0);
    int original_piece = -1;
    T lateral = T(0), value = T(0), slope = T(0);
  };

  // The original from outside the zone: the limit at its lower end from below, at its upper end
  // from above.
  [[nodiscard]] ProfilePoint<T> below(const T& lateral) const {
    const int piece = piece_of(original_, lateral);
    const bool at_joint = piece > 0 && original_.joint(piece) == lateral;
    return original_.evaluate(at_joint ? piece - 1 : piece, lateral);
  }

  void build(const T& sliver_height) {
    const auto zones = concave_intervals(original_);
    for (std::size_t first = 0; first < zones.size();) {
      const std::size_t last = last_joined(zones, first, sliver_height);
      cut({zones[first].lower, zones[last].upper});
      first = last + 1;
    }
    build_pieces();
  }

  // The last of the zones that are one with a first. The outer tangents lie under all that is
  // between them where the slope is nowhere below that at the lower end, nowhere above that at the
  // upper.
  [[nodiscard]] std::size_t last_joined(const std::vector<LateralInterval<T>>& zones,
                                        std::size_t first, const T& sliver_height) const {
    const T least = below(zones[first].lower).slope;
    T greatest = original_.evaluate(zones[first].upper).slope;
    std::size_t last = first;
    for (std::size_t i = first + 1; i < zones.size(); ++i) {
      if (!is_sliver(zones[i - 1].upper, zones[i].lower, sliver_height)) break;
      if (below(zones[i].lower).slope < least) break;
      const T upper = original_.evaluate(zones[i].upper).slope;
      if (upper < greatest) continue;
      greatest = upper;
      last = i;
    }
    return last;
  }

  // Whether what is convex between two places stands off their straight line by less than a height:
  // no farther than the corner of the tangents at its ends.
  [[nodiscard]] bool is_sliver(const T& lower, const T& upper, const T& height) const {
    using std::sqrt;
    const ProfilePoint<T> left = original_.evaluate(lower), right = below(upper);
    const T width = upper - lower;
    const T slope = (right.value - left.value) / width;
    const T rise = left.slope - slope, fall = slope - right.slope;
    if (!(T(0) < rise) || !(T(0) < fall)) return T(0) < height;
    return width * (rise * fall / (rise + fall)) < height * T(sqrt(T(T(1) + slope * slope)));
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
  T sliver_height_ = T(0);
  std::vector<Corner> corners_;
  std::vector<Piece> pieces_;
};

}  // namespace wheelrail
