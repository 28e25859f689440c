#pragma once
/// @file
/// Profiles as standards give them: polynomials and circular arcs, one after the other.
/// May include: core, numerics, profile.

#include <array>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>
#include <wheelrail/core/require.hpp>
#include <wheelrail/core/scalar_value.hpp>
#include <wheelrail/profile/profile.hpp>

namespace wheelrail {

namespace detail {
template <Profile P>
class ProfileLanes;
}

template <Real T>
class PiecewiseProfile;

/// One smooth piece over [lower, upper] [m]: a polynomial of degree up to 8 or a circular arc.
template <Real T>
class ProfilePiece {
 public:
  static constexpr int maximum_degree = 8;  ///< of a polynomial

  /// value = sum_k coefficients[k] x^k, x = (lateral - origin) / scale.
  /// @param coefficients [m], lowest order first, 1 to 9 of them.
  /// @throws std::invalid_argument on an empty interval, a scale <= 0, a bad number of
  ///   coefficients or one that is not finite.
  [[nodiscard]] static ProfilePiece polynomial(const T& lower, const T& upper, const T& origin,
                                               const T& scale, std::span<const T> coefficients) {
    ProfilePiece piece(lower, upper);
    detail::require_positive("polynomial piece: scale", scale, "[m]");
    detail::require_finite("polynomial piece: origin", origin);
    detail::require(
        !coefficients.empty() && coefficients.size() <= piece.coefficients_.size(),
        detail::joined({"polynomial piece: there are ", std::to_string(coefficients.size()),
                        " coefficients, but there must be 1 to 9"}));
    for (std::size_t k = 0; k < coefficients.size(); ++k) {
      detail::require_finite(detail::joined({"polynomial piece: coefficient ", std::to_string(k)}),
                             coefficients[k]);
      piece.coefficients_[k] = coefficients[k];
    }
    piece.degree_ = static_cast<int>(coefficients.size()) - 1;
    piece.origin_ = origin;
    piece.inverse_scale_ = T(1) / scale;
    return piece;
  }

  /// A straight line through (lateral, value) [m] with @p slope [-].
  [[nodiscard]] static ProfilePiece line(const T& lower, const T& upper, const T& lateral,
                                         const T& value, const T& slope) {
    const std::array<T, 2> coefficients{value, slope};
    return polynomial(lower, upper, lateral, T(1), coefficients);
  }

  /// value = centre_value + sqrt(radius^2 - (lateral - centre_lateral)^2), the body's convex arc,
  /// or with a minus sign, the concave one, where @p convex is false. All [m].
  /// @throws std::invalid_argument unless radius > 0 and the interval lies inside the circle.
  [[nodiscard]] static ProfilePiece arc(const T& lower, const T& upper, const T& centre_lateral,
                                        const T& centre_value, const T& radius, bool convex) {
    ProfilePiece piece(lower, upper);
    detail::require_positive("arc piece: radius", radius, "[m]");
    detail::require_finite("arc piece: centre value", centre_value);
    detail::require(centre_lateral - radius < lower, "arc piece: lower end", lower,
                    "greater than the centre less the radius [m]");
    detail::require(upper < centre_lateral + radius, "arc piece: upper end", upper,
                    "less than the centre plus the radius [m]");
    piece.is_arc_ = true;
    piece.origin_ = centre_lateral;
    piece.coefficients_[0] = centre_value;
    piece.coefficients_[1] = radius * radius;
    piece.sign_ = convex ? T(1) : T(-1);
    return piece;
  }

  /// The same piece in another scalar.
  template <Real U>
  [[nodiscard]] ProfilePiece<U> cast() const {
    ProfilePiece<U> piece(scalar_cast<U>(lower_), scalar_cast<U>(upper_));
    piece.origin_ = scalar_cast<U>(origin_);
    piece.inverse_scale_ = scalar_cast<U>(inverse_scale_);
    piece.sign_ = scalar_cast<U>(sign_);
    for (std::size_t k = 0; k < coefficients_.size(); ++k) {
      piece.coefficients_[k] = scalar_cast<U>(coefficients_[k]);
    }
    piece.degree_ = degree_;
    piece.is_arc_ = is_arc_;
    return piece;
  }

  [[nodiscard]] const T& lower() const { return lower_; }  ///< where it begins [m]
  [[nodiscard]] const T& upper() const { return upper_; }  ///< where it ends [m]

  /// @pre for an arc, @p lateral lies inside its circle.
  [[nodiscard]] ProfilePoint<T> evaluate(const T& lateral) const {
    using std::sqrt;
    if (is_arc_) {
      const T x = lateral - origin_;
      const T height = sqrt(T(coefficients_[1] - x * x));
      const T slope = -sign_ * x / height;
      // f'' = -sign R^2 / h^3 and 1 + f'^2 = R^2 / h^2
      return {coefficients_[0] + sign_ * height, slope, -sign_ * (T(1) + slope * slope) / height};
    }
    const T x = (lateral - origin_) * inverse_scale_;
    T value = coefficients_[static_cast<std::size_t>(degree_)];
    T slope = T(0);
    T half_second = T(0);
    for (int k = degree_ - 1; k >= 0; --k) {
      half_second = half_second * x + slope;
      slope = slope * x + value;
      value = value * x + coefficients_[static_cast<std::size_t>(k)];
    }
    return {value, slope * inverse_scale_, T(2) * half_second * inverse_scale_ * inverse_scale_};
  }

  /// As HasDerivativeBounds has it: an arc's derivatives grow away from its middle, a polynomial's
  /// Taylor series about the middle of the interval ends.
  /// @pre lower <= upper, for an arc both inside its circle.
  [[nodiscard]] DerivativeBounds<T> derivative_bounds(const T& lower, const T& upper) const {
    return is_arc_ ? arc_bounds(lower, upper) : polynomial_bounds(lower, upper);
  }

  /// As HasDerivativeBounds has it; an arc has one curvature.
  [[nodiscard]] CurvatureBounds<T> curvature_bounds(const T& lower, const T& upper) const {
    using std::sqrt;
    if (is_arc_) {
      const T own = sign_ / T(sqrt(coefficients_[1]));
      return {own, own};
    }
    const DerivativeBounds<T> bounds = polynomial_bounds(lower, upper);
    const T half_width = (upper - lower) / T(2);
    const T slope = detail::magnitude(evaluate(lower + half_width).slope);
    const T change = half_width * detail::max(detail::magnitude(bounds.least_second),
                                              detail::magnitude(bounds.greatest_second));
    const auto bent = [](const T& second, const T& at_slope) {
      const T squared_length = T(1) + at_slope * at_slope;
      return -second / (squared_length * T(sqrt(squared_length)));
    };
    const T steep = slope + change, flat = detail::max(T(0), T(slope - change));
    // What is divided by most is least where the profile is convex, greatest where it is concave.
    return {bent(bounds.greatest_second, bounds.greatest_second < T(0) ? steep : flat),
            bent(bounds.least_second, bounds.least_second < T(0) ? flat : steep)};
  }

 private:
  [[nodiscard]] DerivativeBounds<T> arc_bounds(const T& lower, const T& upper) const {
    using std::sqrt;
    const T left = lower - origin_, right = upper - origin_;
    const T far = detail::max(detail::magnitude(left), detail::magnitude(right));
    const T near = T(0) < left ? left : (right < T(0) ? T(-right) : T(0));
    const T& squared_radius = coefficients_[1];
    // |f''| = R^2 / h^3 and |f'''| = 3 R^2 |x| / h^5, h = sqrt(R^2 - x^2)
    const T far_squared = squared_radius - far * far;
    const T near_squared = squared_radius - near * near;
    const T most = squared_radius / (far_squared * T(sqrt(far_squared)));
    const T least = squared_radius / (near_squared * T(sqrt(near_squared)));
    const T third = T(3) * most * far / far_squared;
    return T(0) < sign_ ? DerivativeBounds<T>{-most, -least, third}
                        : DerivativeBounds<T>{least, most, third};
  }

  [[nodiscard]] DerivativeBounds<T> polynomial_bounds(const T& lower, const T& upper) const {
    const T middle = (lower + (upper - lower) / T(2) - origin_) * inverse_scale_;
    const T reach = (upper - lower) / T(2) * inverse_scale_;
    // Taylor's coefficients about the middle, by repeated synthetic division.
    auto taylor = coefficients_;
    for (int first = 0; first < degree_; ++first) {
      for (int k = degree_ - 1; k >= first; --k) {
        taylor[static_cast<std::size_t>(k)] += middle * taylor[static_cast<std::size_t>(k + 1)];
      }
    }
    T second_spread = T(0), third = T(0);
    for (int k = degree_; k >= 3; --k) {
      const T size = detail::magnitude(taylor[static_cast<std::size_t>(k)]);
      second_spread = (second_spread + T(k * (k - 1)) * size) * reach;
      third = third * reach + T(k * (k - 1) * (k - 2)) * size;
    }
    const T second = degree_ < 2 ? T(0) : T(T(2) * taylor[2]);
    const T unit = inverse_scale_ * inverse_scale_;
    return {(second - second_spread) * unit, (second + second_spread) * unit,
            third * unit * inverse_scale_};
  }

  ProfilePiece(const T& lower, const T& upper) : lower_(lower), upper_(upper) {
    detail::require_finite("profile piece: lower end", lower);
    detail::require_finite("profile piece: upper end", upper);
    detail::require(lower < upper, "profile piece: lower end", lower,
                    "less than its upper end, " + detail::to_text(upper) + " m");
  }

  friend class detail::ProfileLanes<PiecewiseProfile<T>>;
  template <Real U>
  friend class ProfilePiece;

  T lower_;
  T upper_;
  T origin_ = T(0);
  T inverse_scale_ = T(1);
  T sign_ = T(1);
  // A polynomial's coefficients, or an arc's centre value and squared radius.
  std::array<T, maximum_degree + 1> coefficients_{};
  int degree_ = 0;
  bool is_arc_ = false;
};

/// A profile of polynomials and arcs. Valid for good once constructed.
/// @note Evaluation does not allocate.
template <Real T>
class PiecewiseProfile {
 public:
  using Scalar = T;  ///< the numbers of its coordinates

  /// @param pieces from the flange (or gauge) side to the field side.
  /// @throws std::invalid_argument when there are none, or where piece i does not begin where piece
  ///   i-1 ends.
  explicit PiecewiseProfile(std::vector<ProfilePiece<T>> pieces) : pieces_(std::move(pieces)) {
    detail::require(!pieces_.empty(), "piecewise profile: there are no pieces");
    for (std::size_t i = 1; i < pieces_.size(); ++i) {
      detail::require(pieces_[i].lower() == pieces_[i - 1].upper(),
                      "piecewise profile: lower end of piece " + std::to_string(i),
                      pieces_[i].lower(),
                      "the upper end of piece " + std::to_string(i - 1) + ", " +
                          detail::to_text(pieces_[i - 1].upper()) + " m");
    }
  }

  /// The same profile in another scalar.
  template <Real U>
  [[nodiscard]] PiecewiseProfile<U> cast() const {
    std::vector<ProfilePiece<U>> pieces;
    pieces.reserve(pieces_.size());
    for (const auto& piece : pieces_) pieces.push_back(piece.template cast<U>());
    return PiecewiseProfile<U>(std::move(pieces));
  }

  [[nodiscard]] T lower() const { return pieces_.front().lower(); }  ///< where it begins [m]
  [[nodiscard]] T upper() const { return pieces_.back().upper(); }   ///< where it ends [m]
  /// Number of pieces.
  [[nodiscard]] int piece_count() const { return static_cast<int>(pieces_.size()); }
  /// Where piece @p i begins, or the last one ends [m]. @pre 0 <= i <= piece_count()
  [[nodiscard]] T joint(int i) const {
    return i < piece_count() ? pieces_[static_cast<std::size_t>(i)].lower() : upper();
  }

  /// @pre 0 <= i < piece_count()
  [[nodiscard]] const ProfilePiece<T>& piece(int i) const {
    return pieces_[static_cast<std::size_t>(i)];
  }

  /// @pre lower() <= lateral <= upper()
  [[nodiscard]] ProfilePoint<T> evaluate(const T& lateral) const {
    return evaluate(piece_of(*this, lateral), lateral);
  }
  /// @pre 0 <= piece < piece_count(), lateral in that piece
  [[nodiscard]] ProfilePoint<T> evaluate(int piece, const T& lateral) const {
    return pieces_[static_cast<std::size_t>(piece)].evaluate(lateral);
  }
  /// @pre 0 <= piece < piece_count(), lower <= upper in that piece
  [[nodiscard]] DerivativeBounds<T> derivative_bounds(int piece, const T& lower,
                                                      const T& upper) const {
    return pieces_[static_cast<std::size_t>(piece)].derivative_bounds(lower, upper);
  }
  /// @pre as for derivative_bounds
  [[nodiscard]] CurvatureBounds<T> curvature_bounds(int piece, const T& lower,
                                                    const T& upper) const {
    return pieces_[static_cast<std::size_t>(piece)].curvature_bounds(lower, upper);
  }

 private:
  std::vector<ProfilePiece<T>> pieces_;
};

}  // namespace wheelrail
