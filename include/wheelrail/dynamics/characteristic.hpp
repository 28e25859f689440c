#pragma once
/// @file
/// A force over a displacement (spring, bump stop) or over a velocity (damper): a straight line, or
/// a table as data sheets give it. May include: core, std.

#include <algorithm>
#include <span>
#include <string>
#include <vector>
#include <wheelrail/core/require.hpp>

namespace wheelrail {

/// One row of a table.
template <Real T>
struct CharacteristicPoint {
  T x = T(0);      ///< displacement [m] or velocity [m/s]
  T force = T(0);  ///< [N]
};

/// A force that nowhere falls as x grows, piecewise linear; zero by default.
template <Real T>
class Characteristic {
 public:
  /// No force at all.
  Characteristic() = default;

  /// force = slope x. @param slope [N/m] or [N s/m], >= 0.
  /// @throws std::invalid_argument naming @p name and its value.
  [[nodiscard]] static Characteristic linear(const T& slope, const std::string& name = "slope") {
    detail::require_not_negative(name, slope, "[N/m] or [N s/m]");
    Characteristic c;
    c.first_.slope = slope;
    return c;
  }

  /// Straight between @p points, and straight on beyond the first and the last.
  /// @param points two or more, x strictly increasing, force not decreasing: a stretch of constant
  ///   force is the dead zone of a bump stop.
  /// @param name of the table, for the message.
  /// @throws std::invalid_argument naming the first row that breaks a rule, with its values.
  [[nodiscard]] static Characteristic table(std::span<const CharacteristicPoint<T>> points,
                                            const std::string& name = "points") {
    using detail::magnitude;
    detail::require(2 <= points.size(), std::string(name)
                                            .append(" has ")
                                            .append(std::to_string(points.size()))
                                            .append(" rows, but must have 2 or more"));
    const auto named = [&name](std::size_t i) {
      return std::string(name).append("[").append(std::to_string(i)).append("]");
    };
    Characteristic c;
    std::vector<Segment> segments;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& [x, force] = points[i];
      const std::string row = named(i);
      detail::require_finite(row + ".x", x);
      detail::require_finite(row + ".force", force);
      if (i == 0) continue;
      const auto& [x0, force0] = points[i - 1];
      const std::string before = named(i - 1);
      detail::require(x0 < x, row + ".x", x,
                      std::string("> ").append(before).append(".x, ").append(detail::to_text(x0)));
      detail::require(
          !(force < force0), row + ".force", force,
          std::string(">= ").append(before).append(".force, ").append(detail::to_text(force0)));
      const bool from_left = !(magnitude(x) < magnitude(x0));
      segments.push_back({x0, force0, from_left ? x0 : x, from_left ? force0 : force, T(0),
                          (force - force0) / (x - x0)});
    }
    // Energies that join from segment to segment, then all less the energy at zero.
    for (std::size_t i = 1; i < segments.size(); ++i) {
      const T& joint = segments[i].begin;
      segments[i].energy += segments[i - 1].energy_at(joint) - segments[i].energy_at(joint);
    }
    c.first_ = segments.front();
    c.rest_.assign(segments.begin() + 1, segments.end());
    const T at_zero = c.energy(T(0));
    c.first_.energy -= at_zero;
    for (Segment& segment : c.rest_) segment.energy -= at_zero;
    return c;
  }

  /// The same in both directions: force(-x) = -force(x), from the table of one.
  /// @param points as for `table`, x >= 0 and force >= 0; (0, 0) is added unless it is the first.
  /// @throws std::invalid_argument as `table` does; a row counts as it does in @p points.
  [[nodiscard]] static Characteristic odd_table(std::span<const CharacteristicPoint<T>> points,
                                                const std::string& name = "points") {
    static_cast<void>(table(points, name));
    const auto& first = points.front();
    detail::require_not_negative(name + "[0].x", first.x, "in a table of one direction");
    detail::require_not_negative(name + "[0].force", first.force, "in a table of one direction");
    const bool has_zero = first.x == T(0);
    detail::require(!has_zero || first.force == T(0), name + "[0].force", first.force,
                    "0 where x is 0, in a table of one direction");
    std::vector<CharacteristicPoint<T>> both;
    for (std::size_t i = points.size(); 0 < i; --i) {
      both.push_back({-points[i - 1].x, -points[i - 1].force});
    }
    if (!has_zero) both.push_back({});
    both.insert(both.end(), points.begin() + (has_zero ? 1 : 0), points.end());
    if (has_zero) both[points.size() - 1] = {};  // not minus zero
    return table(both, name);
  }

  /// The force [N] at @p x.
  [[nodiscard]] T force(const T& x) const { return segment_at(x).force_at(x); }

  /// The slope at @p x [N/m] or [N s/m], >= 0; at a row of the table the one to its right.
  [[nodiscard]] T slope(const T& x) const { return segment_at(x).slope; }

  /// The integral of the force from 0 to @p x: a spring's energy [J].
  [[nodiscard]] T energy(const T& x) const { return segment_at(x).energy_at(x); }

  /// The x at which the force is @p force. @pre is_strictly_increasing()
  [[nodiscard]] T argument(const T& force) const {
    const Segment& s =
        find([&force](const Segment& segment) { return force < segment.begin_force; });
    return s.x + (force - s.force) / s.slope;
  }

  /// Whether each force belongs to one x only.
  [[nodiscard]] bool is_strictly_increasing() const {
    return T(0) < first_.slope &&
           std::all_of(rest_.begin(), rest_.end(), [](const Segment& s) { return T(0) < s.slope; });
  }

 private:
  /// The straight line through the end (x, force) of the stretch that is nearer to zero, so that an
  /// odd table gives odd forces bit for bit between its rows.
  struct Segment {
    T begin = T(0),
      begin_force = T(0);  ///< the left end; the first segment reaches to minus infinity
    T x = T(0), force = T(0), energy = T(0), slope = T(0);

    [[nodiscard]] T force_at(const T& at) const { return force + slope * (at - x); }
    [[nodiscard]] T energy_at(const T& at) const {
      const T d = at - x;
      return energy + d * (force + slope * d / T(2));
    }
  };

  /// The last segment that does not begin beyond what is looked for.
  template <class IsBeyond>
  [[nodiscard]] const Segment& find(const IsBeyond& is_beyond) const {
    if (rest_.empty() || is_beyond(rest_.front())) return first_;
    const auto end = std::partition_point(rest_.begin(), rest_.end(),
                                          [&](const Segment& s) { return !is_beyond(s); });
    return *(end - 1);
  }
  [[nodiscard]] const Segment& segment_at(const T& x) const {
    return find([&x](const Segment& segment) { return x < segment.begin; });
  }

  Segment first_;
  std::vector<Segment> rest_;
};

}  // namespace wheelrail
