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
  T least_shift{};                    ///< right turning point [m]
  T greatest_shift{};                 ///< left turning point [m]
  ConicityStatus status = ConicityStatus::not_finite;
};

/// When a rolling radius difference counts as none.
template <Real T>
struct ConicityOptions {
  /// Where the difference's integral varies by at most negligible amplitude^2 between the turning
  /// points, the conicity is 0 [-]. (On a cone it varies by conicity amplitude^2.)
  T negligible = constant<T>(1e-6L);
};

namespace detail {

/// The sum of function(shift) (shift by angle) over the angle from -pi/2 to pi/2, for shift =
/// middle + amplitude sin(angle): by eight points between neighbouring shifts of the curve, where
/// all is smooth, over an eighth of a right angle at most.
template <Real T, class Function>
[[nodiscard]] T integral_over_motion(const RollingRadiusDifference<T>& curve, const T& middle,
                                     const T& amplitude, Function&& function) {
  using std::asin;
  using std::cos;
  using std::sin;
  const T right_angle = pi<T>() / T(2);
  T sum = T(0);
  T from = -right_angle;
  const auto add_until = [&](const T& to) {
    int parts = 1;
    while (right_angle * T(parts) < T(8) * (to - from) && parts < 16) ++parts;
    const T half_width = (to - from) / T(2 * parts);
    for (int i = 0; i < parts; ++i) {
      const T centre = from + half_width * T(2 * i + 1);
      for (const QuadratureNode<T>& node : gauss_legendre_8<T>) {
        for (const T& offset : {node.abscissa, T(-node.abscissa)}) {
          const T angle = centre + half_width * offset;
          sum += node.weight * half_width * amplitude * T(cos(angle)) *
                 function(T(middle + amplitude * T(sin(angle))));
        }
      }
    }
    from = to;
  };
  // A corner so near to a turning point that rounding hides what is beyond is passed over.
  const T last = T(1) - T(1 << 18) * epsilon<T>();
  for (const T& shift : curve.shifts()) {
    const T sine = (shift - middle) / amplitude;
    if (-last < sine && sine < last) add_until(T(asin(sine)));
  }
  add_until(right_angle);
  return sum;
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
  const T top = curve.integral(result.greatest_shift);

  T greatest_depth = T(0), least_depth = top - curve.integral(middle);  // of S(y_max) - S(y)
  const T half_wave = detail::integral_over_motion(curve, middle, amplitude, [&](const T& shift) {
    const T depth = top - curve.integral(shift);
    greatest_depth = detail::max(greatest_depth, depth);
    least_depth = detail::min(least_depth, depth);
    return T(0) < depth ? T(T(1) / sqrt(T(T(2) * depth))) : T(0);
  });
  if (greatest_depth - detail::min(least_depth, T(0)) <= negligible) {
    result.conicity = T(0);
  } else if (T(0) < least_depth) {
    result.conicity = detail::square(T(pi<T>() / half_wave)) / T(2);
  } else {
    result.status = ConicityStatus::not_restoring;
    return result;
  }
  // The line's slope is the integral of D (y - middle) over 2/3 amplitude^3.
  const T tilt = detail::integral_over_motion(curve, middle, amplitude, [&](const T& shift) {
    return T(curve.at(shift) * (shift - middle));
  });
  result.linear_regression = T(3) * tilt / (T(4) * amplitude * amplitude * amplitude);
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
