#pragma once
/// @file
/// Equivalent conicity after EN 15302 and UIC 519: the slope of the cone on which a free wheelset
/// would hunt with the wavelength that it has on these wheels and rails.
/// May include: all but dynamics and io.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>
#include <wheelrail/numerics/bracketed_root.hpp>
#include <wheelrail/numerics/detail/gauss_legendre.hpp>
#include <wheelrail/wheelset/kinematics_table.hpp>

namespace wheelrail {

/// Rolling radius difference over lateral shift, straight between the given points. Valid for good
/// once constructed.
///
/// Sign: D(s) = left wheel less right wheel, the shift s positive to the left. EN 15302 and UIC 519
/// list Delta r(y) = r_R - r_L, y positive to the right: D(s) = -Delta r(-s). Both grow where the
/// wheelset is centred, and are one function where both sides are equal.
template <Real T>
class RollingRadiusDifference {
 public:
  /// @param shifts [m], strictly increasing, at least two. @param differences [m], one for each
  ///   shift.
  /// @throws std::invalid_argument naming the first value that breaks this.
  RollingRadiusDifference(std::vector<T> shifts, std::vector<T> differences)
      : shifts_(std::move(shifts)), differences_(std::move(differences)) {
    const std::size_t n = shifts_.size();
    detail::require(n >= 2 && n == differences_.size(),
                    "rolling radius difference: there are " + std::to_string(n) + " shifts and " +
                        std::to_string(differences_.size()) +
                        " differences, but must be as many, at least 2");
    integrals_.push_back(T(0));
    for (std::size_t i = 0; i < n; ++i) {
      const std::string name = "rolling radius difference: shift " + std::to_string(i);
      detail::require_finite(name, shifts_[i]);
      detail::require_finite("rolling radius difference: value " + std::to_string(i),
                             differences_[i]);
      if (i == 0) continue;
      detail::require(shifts_[i - 1] < shifts_[i], name, shifts_[i], "greater than the one before");
      integrals_.push_back(integrals_.back() + (differences_[i - 1] + differences_[i]) *
                                                   (shifts_[i] - shifts_[i - 1]) / T(2));
    }
  }

  /// Of the unbroken run of touching shifts about the one nearest to 0.
  /// @throws std::invalid_argument where fewer than two shifts are touching there.
  [[nodiscard]] static RollingRadiusDifference of(const KinematicsTable<T>& table) {
    std::vector<T> shifts, differences;
    bool is_past = false;  // 0, or the last touching shift before it
    for (const WheelsetKinematics<T>& at : table.shifts) {
      if (at.status == TouchStatus::touching) {
        shifts.push_back(at.lateral_shift);
        differences.push_back(at.rolling_radius_difference());
        is_past = is_past || !(at.lateral_shift < T(0));
      } else if (is_past) {
        break;
      } else {
        shifts.clear();
        differences.clear();
      }
    }
    return RollingRadiusDifference(std::move(shifts), std::move(differences));
  }

  [[nodiscard]] const T& lower() const { return shifts_.front(); }        ///< [m]
  [[nodiscard]] const T& upper() const { return shifts_.back(); }         ///< [m]
  [[nodiscard]] const std::vector<T>& shifts() const { return shifts_; }  ///< [m]

  /// The difference [m] at a shift [m] within lower() and upper().
  [[nodiscard]] T at(const T& shift) const {
    const std::size_t i = interval(shift);
    return differences_[i] + slope(i) * (shift - shifts_[i]);
  }

  /// Its integral from lower() to a shift [m] within lower() and upper() [m2].
  [[nodiscard]] T integral(const T& shift) const {
    const std::size_t i = interval(shift);
    const T x = shift - shifts_[i];
    return integrals_[i] + x * (differences_[i] + slope(i) * x / T(2));
  }

 private:
  [[nodiscard]] std::size_t interval(const T& shift) const {
    const auto above = std::upper_bound(shifts_.begin() + 1, shifts_.end() - 1, shift);
    return static_cast<std::size_t>(above - shifts_.begin()) - 1;
  }
  [[nodiscard]] T slope(std::size_t i) const {
    return (differences_[i + 1] - differences_[i]) / (shifts_[i + 1] - shifts_[i]);
  }

  std::vector<T> shifts_;
  std::vector<T> differences_;
  std::vector<T> integrals_;  // from lower() [m2]
};

/// How a conicity was looked for.
enum class ConicityStatus {
  found,           ///< there is a motion of this amplitude, and its conicity
  out_of_range,    ///< the rolling radius difference is not known as far as this amplitude reaches
  no_equilibrium,  ///< the difference does not pass 0 upwards: the wheelset is not centred
  not_restoring,  ///< between the turning points the wheelset is driven outwards: it does not cross
  not_converged,  ///< the iteration for the middle of the motion did not converge
  not_finite      ///< the amplitude is no positive number
};

/// The status in words, for messages and tables.
[[nodiscard]] constexpr const char* name_of(ConicityStatus status) {
  switch (status) {
    case ConicityStatus::found:
      return "found";
    case ConicityStatus::out_of_range:
      return "out_of_range";
    case ConicityStatus::no_equilibrium:
      return "no_equilibrium";
    case ConicityStatus::not_restoring:
      return "not_restoring";
    case ConicityStatus::not_converged:
      return "not_converged";
    case ConicityStatus::not_finite:
      return "not_finite";
  }
  return "unknown";
}

/// Equivalent conicity at one amplitude. Invariant: where status == found, greatest_shift -
/// least_shift is twice the amplitude; elsewhere the conicities are NaN.
template <Real T>
struct EquivalentConicity {
  T conicity = T(0) / T(0);           ///< tan gamma_e by integration of the motion [-]
  T linear_regression = T(0) / T(0);  ///< half the slope of the straight line of least squares [-]
  T least_shift = T(0);               ///< right turning point [m]
  T greatest_shift = T(0);            ///< left turning point [m]
  ConicityStatus status = ConicityStatus::not_finite;  ///< whether there is one
};

/// When a rolling radius difference counts as none.
template <Real T>
struct ConicityOptions {
  /// Where the difference's integral varies by at most negligible amplitude^2 between the turning
  /// points, the conicity is 0 [-]. (On a cone it varies by conicity amplitude^2.)
  T negligible = constant<T>(1e-6L);
};

namespace detail {

/// A motion from a turning point to the middle. Its depth at a shift, of the potential in which it
/// swings: the integral of the rolling radius difference from there to a turning point on the left,
/// or minus that from a turning point on the right.
template <Real T>
struct HalfMotion {
  T duration = T(0);        ///< integral of dy / sqrt(2 depth) [-]
  T tilt = T(0);            ///< integral of the difference times (shift - middle) [m3]
  T greatest_depth = T(0);  ///< where it was looked at [m2]
  T least_depth = T(0);     ///< the same, or 0 [m2]
  bool is_deep = true;      ///< whether all of that is > 0: nowhere is the wheelset driven past it
};

/// The half of a motion of an amplitude [m] from the turning point on a side to the middle [m]. All
/// lengths are counted from the turning point and all depths added up from there: near it the
/// depth is small, and a difference of integrals over the whole curve would be all rounding.
///
/// With the shift a cosine of an angle all is smooth between neighbouring shifts of the curve:
/// eight points there, over an eighth of a right angle at most.
template <Real T>
[[nodiscard]] HalfMotion<T> half_motion(const RollingRadiusDifference<T>& curve, Side side,
                                        const T& middle, const T& amplitude) {
  using std::asin;
  using std::sin;
  using std::sqrt;
  const T outwards = outboard_sign<T>(side);
  const std::vector<T>& shifts = curve.shifts();
  HalfMotion<T> half;
  T angle = T(0), distance = T(0), depth = T(0);
  const T turning_shift = middle + outwards * amplitude;
  T difference = outwards * curve.at(turning_shift);
  // Up to the angle whose distance from the turning point is `end`, where the difference is `last`.
  const auto add_until = [&](const T& end, const T& end_angle, const T& last) {
    const T width = end - distance;
    int parts = 1;
    while (pi<T>() / T(2) * T(parts) < T(8) * (end_angle - angle) && parts < 16) ++parts;
    const T half_angle = (end_angle - angle) / T(2 * parts);
    for (int i = 0; i < parts; ++i) {
      const T centre = angle + half_angle * T(2 * i + 1);
      for (const QuadratureNode<T>& node : gauss_legendre_8<T>) {
        for (const T& offset : {node.abscissa, T(-node.abscissa)}) {
          const T at = centre + half_angle * offset;
          // 1 - cos at, without its rounding.
          const T inwards = T(2) * amplitude * square(T(sin(T(at / T(2))))) - distance;
          const T own =
              depth + inwards * (difference + (last - difference) * (inwards / width) / T(2));
          half.greatest_depth = max(half.greatest_depth, own);
          half.least_depth = min(half.least_depth, own);
          half.is_deep = half.is_deep && T(0) < own;
          if (!half.is_deep) continue;
          half.duration +=
              node.weight * half_angle * amplitude * T(sin(at)) / T(sqrt(T(T(2) * own)));
        }
      }
    }
    // Of two straight lines' product, by Simpson's rule.
    const T from = amplitude - distance, to = amplitude - end;
    half.tilt += width / T(6) * (difference * from + (difference + last) * (from + to) + last * to);
    depth += width * (difference + last) / T(2);
    distance = end;
    angle = end_angle;
    difference = last;
  };
  const bool is_left = side == Side::left;
  const std::size_t n = shifts.size();
  for (std::size_t i = 0; i < n; ++i) {
    const T& shift = shifts[is_left ? n - 1 - i : i];
    const T end = outwards * (turning_shift - shift);
    if (!(distance < end)) continue;
    if (!(end < amplitude)) break;
    add_until(end, T(T(2) * T(asin(T(sqrt(T(end / (T(2) * amplitude))))))),
              T(outwards * curve.at(shift)));
  }
  add_until(amplitude, T(pi<T>() / T(2)), T(outwards * curve.at(middle)));
  half.is_deep = half.is_deep && T(0) < depth;
  half.greatest_depth = max(half.greatest_depth, depth);
  half.least_depth = min(half.least_depth, depth);
  return half;
}

}  // namespace detail

/// The equivalent conicity at an amplitude of the lateral motion.
///
/// By integration: a free wheelset moves as y'' = -D(y) / (e r0), D the rolling radius difference;
/// between turning points y_max - y_min = 2 amplitude where S = integral of D is equal it takes
/// half a wavelength, integral of dy / sqrt(2 (S(y_max) - S(y)) / (e r0)), and tan gamma_e = (pi /
/// wavelength)^2 2 e r0, in which e and r0 cancel. By linear regression: over the same turning
/// points, every shift weighted alike. Source: EN 15302 and UIC 519.
/// @param amplitude [m], > 0.
/// @return status found, and 0 where the difference vanishes; see ConicityStatus. Where several
///   centres have that amplitude, one of them is taken.
/// @note Does not allocate.
template <Real T>
[[nodiscard]] EquivalentConicity<T> equivalent_conicity(const RollingRadiusDifference<T>& curve,
                                                        const T& amplitude,
                                                        const ConicityOptions<T>& options = {}) {
  using std::sqrt;
  EquivalentConicity<T> result;
  if (!is_finite(amplitude) || !(T(0) < amplitude)) return result;
  result.status = ConicityStatus::out_of_range;
  const T first = curve.lower() + amplitude, last = curve.upper() - amplitude;
  if (last < first) return result;
  const auto work = [&](const T& middle) {
    return T(curve.integral(T(middle + amplitude)) - curve.integral(T(middle - amplitude)));
  };
  const T negligible = options.negligible * amplitude * amplitude;
  // Right of the centre work > 0, left of it work < 0. The range's middle comes first: it is the
  // centre where both sides are equal.
  T middle = first + (last - first) / T(2);
  if (negligible < detail::magnitude(work(middle))) {
    const T at_first = work(first), at_last = work(last);
    if (T(0) < at_first || at_last < T(0)) {
      bool rises = false;  // through 0
      for (std::size_t i = 1; i < curve.shifts().size(); ++i) {
        rises = rises ||
                (!(T(0) < curve.at(curve.shifts()[i - 1])) && T(0) < curve.at(curve.shifts()[i]));
      }
      if (!rises) result.status = ConicityStatus::no_equilibrium;
      return result;
    }
    const auto root = bracketed_root<T>(work, first, last, at_first, at_last);
    if (root.status != SolveStatus::converged) {
      result.status = ConicityStatus::not_converged;
      return result;
    }
    middle = root.position;
  }
  result.least_shift = middle - amplitude;
  result.greatest_shift = middle + amplitude;
  const auto left = detail::half_motion(curve, Side::left, middle, amplitude);
  const auto right = detail::half_motion(curve, Side::right, middle, amplitude);
  const T greatest_depth = detail::max(left.greatest_depth, right.greatest_depth);
  const T least_depth = detail::min(left.least_depth, right.least_depth);
  if (greatest_depth - least_depth <= negligible) {
    result.conicity = T(0);
  } else if (left.is_deep && right.is_deep) {
    result.conicity = detail::square(T(pi<T>() / (left.duration + right.duration))) / T(2);
  } else {
    result.status = ConicityStatus::not_restoring;
    return result;
  }
  // The line's slope is the integral of D (y - middle) over 2/3 amplitude^3.
  result.linear_regression =
      T(3) * (left.tilt + right.tilt) / (T(4) * amplitude * amplitude * amplitude);
  result.status = ConicityStatus::found;
  return result;
}

/// The wavelength [m] of a wheelset's hunting on a cone: Klingel, 2 pi sqrt(r0 e / (2 conicity)).
/// @param radius of the wheels, the mean of both [m]. @param contact_distance e: between the
///   contact points of both wheels, 1.5 m in EN 15302 [m].
template <Real T>
[[nodiscard]] T hunting_wavelength(const T& conicity, const T& radius, const T& contact_distance) {
  using std::sqrt;
  return T(2) * pi<T>() * T(sqrt(T(radius * contact_distance / (T(2) * conicity))));
}

/// What EN 15302 allows a conicity to differ from its reference by [-]: 0.05, half the reference
/// where that is less, but not less than 0.01. Near a step of the reference it allows more: what an
/// error of the amplitude makes of it, which its annexes list case by case.
/// @param reference tan gamma_e of the standard [-].
template <Real T>
[[nodiscard]] T conicity_tolerance(const T& reference) {
  return detail::min(constant<T>(0.05L), detail::max(constant<T>(0.01L), T(reference / T(2))));
}

}  // namespace wheelrail
