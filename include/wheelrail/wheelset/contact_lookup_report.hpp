#pragma once
/// @file
/// What a lookup in a table of contacts returns, and the report on how wrong the table is.
/// May include: core, numerics, profile, surface, contact.

#include <wheelrail/contact/patch.hpp>

namespace wheelrail {

/// How a lookup ended.
enum class LookupStatus {
  found,         ///< the wheel penetrates its rail
  not_touching,  ///< it does not: the contact is the one that is nearest when it is set down
  outside,       ///< lateral shift, roll or yaw are not in the table: nothing is extrapolated
  too_deep,      ///< the penetration is greater than the table's greatest
  no_contact,    ///< at a node of the cell the wheel could not be set down
  not_finite     ///< a NaN or an infinity went in
};

/// The status in words, for messages and tables.
[[nodiscard]] constexpr const char* name_of(LookupStatus status) {
  switch (status) {
    case LookupStatus::found:
      return "found";
    case LookupStatus::not_touching:
      return "not_touching";
    case LookupStatus::outside:
      return "outside";
    case LookupStatus::too_deep:
      return "too_deep";
    case LookupStatus::no_contact:
      return "no_contact";
    case LookupStatus::not_finite:
      return "not_finite";
  }
  return "unknown";
}

/// Contact geometry as a table holds it; the fields are those of Patch.
template <Real T>
struct LookupContact {
  T wheel_lateral = T(0) / T(0);                 ///< [m]
  T rail_lateral = T(0) / T(0);                  ///< [m]
  T contact_angle = T(0) / T(0);                 ///< positive on the flange, on both sides [rad]
  T rolling_radius = T(0) / T(0);                ///< [m]
  T wheel_longitudinal_curvature = T(0) / T(0);  ///< [1/m]
  T wheel_lateral_curvature = T(0) / T(0);       ///< [1/m]
  T rail_lateral_curvature = T(0) / T(0);        ///< [1/m]
};

/// What a lookup returns. Invariant: unless status is found or not_touching, all numbers are NaN.
template <Real T>
struct ContactLookupResult {
  LookupContact<T> contact;         ///< of the deepest patch, the only one
  T penetration = T(0) / T(0);      ///< normal to the contact, negative without contact [m]
  T touching_height = T(0) / T(0);  ///< of the axle's centre, at which the wheel touches [m]
  bool may_jump = false;            ///< the contact may be at another place: see contact_step
  bool may_have_several = false;    ///< there may be other patches, which the table leaves out
  LookupStatus status = LookupStatus::not_finite;  ///< what can be relied on

  /// Whether the pose lies in a cell whose error LookupReport lists as flagged.
  [[nodiscard]] bool is_flagged() const { return may_jump || may_have_several; }
};

/// The error of one quantity over many poses, in its unit.
template <Real T>
struct LookupError {
  T greatest = T(0);  ///< of the absolute errors
  T rms = T(0);       ///< root mean square
};

/// The errors against the online search over many poses.
template <Real T>
struct LookupErrors {
  LookupError<T> touching_height;  ///< [m]
  LookupError<T> penetration;      ///< [m]
  LookupError<T> wheel_lateral;    ///< [m]
  LookupError<T> contact_angle;    ///< [rad]
  LookupError<T> rolling_radius;   ///< [m]
  int poses = 0;                   ///< that were measured [-]
  int misplaced = 0;               ///< of these, contact more than contact_step from where it is
  int several = 0;                 ///< of these, the online search found more than one patch
};

/// What a table's measurement found: at poses drawn uniformly from the table's lateral shifts, rolls
/// and yaws, with penetrations drawn uniformly up to the greatest.
///
/// What it says of other poses: of n poses drawn alike, one more exceeds the greatest error with
/// probability 1/(n + 1). It is no bound.
template <Real T>
struct LookupReport {
  LookupErrors<T> plain;    ///< in cells without a flag
  LookupErrors<T> flagged;  ///< in cells with one
  int cells = 0;            ///< of the table [-]
  int jump_cells = 0;       ///< of these, flagged for a jump
  int several_cells = 0;    ///< of these, flagged for several patches, or for both
  int flagged_cells = 0;    ///< of these, flagged for either
  int void_cells = 0;       ///< of these, with a node where the wheel could not be set down
  int unmeasured = 0;       ///< poses that the online search found no contact for
  int refused = 0;          ///< poses that it did, and the table not: in void cells, or too deep
};

namespace detail {

/// Adds up errors against the online search.
template <Real T>
class LookupErrorSum {
 public:
  void add(const ContactLookupResult<T>& looked_up, const T& touching_height,
           const Patch<T>& online, std::size_t patches, const T& contact_step) {
    const LookupContact<T>& contact = looked_up.contact;
    add(errors_.touching_height, T(looked_up.touching_height - touching_height));
    add(errors_.penetration, T(looked_up.penetration - online.penetration));
    add(errors_.wheel_lateral, T(contact.wheel_lateral - online.wheel_lateral));
    add(errors_.contact_angle, T(contact.contact_angle - online.contact_angle));
    add(errors_.rolling_radius, T(contact.rolling_radius - online.rolling_radius));
    ++errors_.poses;
    if (contact_step < magnitude(T(contact.wheel_lateral - online.wheel_lateral))) {
      ++errors_.misplaced;
    }
    if (patches > 1) ++errors_.several;
  }

  [[nodiscard]] LookupErrors<T> result() const {
    using std::sqrt;
    LookupErrors<T> result = errors_;
    if (result.poses == 0) return result;
    for (LookupError<T>* error :
         {&result.touching_height, &result.penetration, &result.wheel_lateral,
          &result.contact_angle, &result.rolling_radius}) {
      error->rms = sqrt(T(error->rms / T(result.poses)));
    }
    return result;
  }

 private:
  // `rms` holds the sum of the squares until the result is made.
  static void add(LookupError<T>& error, const T& difference) {
    error.greatest = max(error.greatest, magnitude(difference));
    error.rms += difference * difference;
  }

  LookupErrors<T> errors_;
};

}  // namespace detail
}  // namespace wheelrail
