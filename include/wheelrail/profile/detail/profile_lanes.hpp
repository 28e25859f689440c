#pragma once
// A profile evaluated in several lanes at once, in a piece of its own in each.
// May include: core, numerics, profile.

#include <array>
#include <wheelrail/core/detail/lanes.hpp>
#include <wheelrail/profile/piecewise_profile.hpp>

namespace wheelrail::detail {

// ProfilePoint of each lane.
template <Real T>
struct ProfilePointLanes {
  Lanes<T> value, slope, second_derivative;
};

// Any profile: lane by lane.
template <Profile P>
class ProfileLanes {
 public:
  using T = typename P::Scalar;

  explicit ProfileLanes(const P& profile) : profile_(profile) {}

  // The piece that a lane will be evaluated in. All lanes must be set.
  void set(int lane, int piece) { pieces_[static_cast<std::size_t>(lane)] = piece; }

  [[nodiscard]] ProfilePointLanes<T> evaluate(const Lanes<T>& lateral) const {
    ProfilePointLanes<T> result;
    for (int lane = 0; lane < lane_count; ++lane) {
      const ProfilePoint<T> point =
          profile_.evaluate(pieces_[static_cast<std::size_t>(lane)], lateral[lane]);
      result.value[lane] = point.value;
      result.slope[lane] = point.slope;
      result.second_derivative[lane] = point.second_derivative;
    }
    return result;
  }

 private:
  const P& profile_;
  std::array<int, lane_count> pieces_{};
};

// Polynomials and arcs: both formulas for all lanes, where there is a lane of each.
template <Real T>
class ProfileLanes<PiecewiseProfile<T>> {
 public:
  explicit ProfileLanes(const PiecewiseProfile<T>& profile) : profile_(profile) {}

  void set(int lane, int piece) {
    const ProfilePiece<T>& one = profile_.piece(piece);
    for (std::size_t k = 0; k < terms; ++k) coefficients_[k][lane] = one.coefficients_[k];
    origin_[lane] = one.origin_;
    inverse_scale_[lane] = one.inverse_scale_;
    arc_sign_[lane] = one.sign_;
    is_arc_[lane] = T(one.is_arc_ ? 1 : 0);
  }

  // As ProfilePiece::evaluate has it; the terms above a polynomial's degree are zero.
  [[nodiscard]] ProfilePointLanes<T> evaluate(const Lanes<T>& lateral) const {
    const Lanes<T> x = (lateral - origin_) * inverse_scale_;
    Lanes<T> value = coefficients_[terms - 1];
    Lanes<T> slope = Lanes<T>::Zero(), half_second = Lanes<T>::Zero();
    for (std::size_t k = terms - 1; k-- > 0;) {
      half_second = half_second * x + slope;
      slope = slope * x + value;
      value = value * x + coefficients_[k];
    }
    ProfilePointLanes<T> result{value, slope * inverse_scale_,
                                T(2) * half_second * inverse_scale_ * inverse_scale_};
    if (!any<T>(is_arc_)) return result;
    const Lanes<T> from_centre = lateral - origin_;
    const Lanes<T> height = (coefficients_[1] - from_centre * from_centre).sqrt();
    const Lanes<T> arc_slope = -arc_sign_ * from_centre / height;
    result.value = choose<T>(is_arc_, coefficients_[0] + arc_sign_ * height, result.value);
    result.slope = choose<T>(is_arc_, arc_slope, result.slope);
    result.second_derivative = choose<T>(
        is_arc_, -arc_sign_ * (T(1) + arc_slope * arc_slope) / height, result.second_derivative);
    return result;
  }

 private:
  static constexpr std::size_t terms = ProfilePiece<T>::maximum_degree + 1;

  const PiecewiseProfile<T>& profile_;
  std::array<Lanes<T>, terms> coefficients_;
  Lanes<T> origin_, inverse_scale_, arc_sign_, is_arc_;
};

}  // namespace wheelrail::detail
