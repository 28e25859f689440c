#pragma once
/// @file
/// What the track's rails are off their design geometry, over its arc length: from a table, or
/// generated from power spectral densities. May include: core, numerics, profile, surface.

#include <array>
#include <cstdint>
#include <random>
#include <vector>
#include <wheelrail/core/vector.hpp>
#include <wheelrail/numerics/cubic_spline.hpp>

namespace wheelrail {

/// Deviations from the design geometry at one arc length [m], in the axes of the track plane.
template <Real T>
struct Irregularity {
  T lateral = T(0);      ///< of both rails, to the left (alignment)
  T vertical = T(0);     ///< of both rails, up (longitudinal level)
  T gauge = T(0);        ///< widening; half of it moves each rail outwards
  T cross_level = T(0);  ///< added to the cant, so positive where it lifts the right rail
};

/// Interpolated with continuous second derivatives. Outside its table the nearest end's values
/// hold, which it meets with slope 0. Valid for good once constructed. @note Queries do not
/// allocate.
template <Real T>
class TrackIrregularities {
 public:
  /// None.
  TrackIrregularities()
      : TrackIrregularities({T(0), T(1), T(2)}, std::vector<Irregularity<T>>(3)) {}

  /// @param arc_lengths [m], finite, strictly increasing, at least 3. @param table one row for
  /// each.
  /// @throws std::invalid_argument naming the first number that breaks this; columns are counted in
  ///   the order of Irregularity.
  TrackIrregularities(std::vector<T> arc_lengths, const std::vector<Irregularity<T>>& table)
      : spline_(std::move(arc_lengths), columns(table), Vector4<T>(Vector4<T>::Zero()),
                Vector4<T>(Vector4<T>::Zero())) {}

  /// At @p arc_length [m].
  [[nodiscard]] Irregularity<T> evaluate(const T& arc_length) const {
    const T within = detail::clamp(arc_length, spline_.lower(), spline_.upper());
    const Vector4<T> value = spline_.evaluate(within).value;
    return {value(0), value(1), value(2), value(3)};
  }

 private:
  [[nodiscard]] static std::vector<Vector4<T>> columns(const std::vector<Irregularity<T>>& table) {
    std::vector<Vector4<T>> values;
    values.reserve(table.size());
    for (const auto& row : table) {
      values.emplace_back(row.lateral, row.vertical, row.gauge, row.cross_level);
    }
    return values;
  }

  CubicSpline<T, Vector4<T>> spline_;
};

/// One-sided power spectral densities over the angular spatial frequency W [rad/m]; the variance is
/// their integral over W from 0. The form of ERRI B176 RP1 (1989), for alignment and level
///
///     S(W) = A Wc^2 / ((W^2 + Wr^2) (W^2 + Wc^2)),
///
/// and for gauge and cross-level the same times W^2 / (W^2 + Ws^2). As printed by H. Claus and
/// W. Schiehlen, Modeling and simulation of railway bogie structural vibrations, Vehicle System
/// Dynamics 29 (1998) supplement, 538-552, where the cross-level is an angle, the difference of the
/// rails' heights over 2 b = 1.5 m; in metres it has the amplitude 4 A of the level. B176 states no
/// gauge; its amplitude is that of the same spectra in W. Zhai, Vehicle-Track Coupled Dynamics,
/// Springer 2020.
template <Real T>
struct IrregularitySpectrum {
  T lateral = T(0);      ///< A of the alignment [m rad]
  T vertical = T(0);     ///< A of the longitudinal level [m rad]
  T gauge = T(0);        ///< A of the gauge [m rad]
  T cross_level = T(0);  ///< A of the cross-level, four times that of the level [m rad]
  T cutoff_c = constant<T>(0.8246L);  ///< Wc [rad/m]
  T cutoff_r = constant<T>(0.0206L);  ///< Wr [rad/m]
  T cutoff_s = constant<T>(0.4380L);  ///< Ws [rad/m]

  /// Good track: the lower level.
  [[nodiscard]] static IrregularitySpectrum low_disturbance() {
    return {constant<T>(2.119e-7L), constant<T>(4.032e-7L), constant<T>(0.532e-7L),
            constant<T>(16.128e-7L)};
  }
  /// Ordinary track: the upper level.
  [[nodiscard]] static IrregularitySpectrum high_disturbance() {
    return {constant<T>(6.125e-7L), constant<T>(10.80e-7L), constant<T>(1.032e-7L),
            constant<T>(43.20e-7L)};
  }

  /// The four densities [m2/(rad/m)] at @p frequency [rad/m].
  [[nodiscard]] Irregularity<T> density(const T& frequency) const {
    using detail::square;
    const T w2 = square(frequency);
    const T shape = square(cutoff_c) / ((w2 + square(cutoff_r)) * (w2 + square(cutoff_c)));
    const T difference = shape * w2 / (w2 + square(cutoff_s));
    return {lateral * shape, vertical * shape, gauge * difference, cross_level * difference};
  }
};

/// Of random irregularities: their phases, wavelengths and ramp.
template <Real T>
struct IrregularityOptions {
  std::uint64_t seed = 1;         ///< of the random phases
  T shortest_wavelength = T(3);   ///< [m], > 0
  T longest_wavelength = T(100);  ///< [m], > shortest
  T start = T(0);                 ///< no irregularities before this arc length [m]
  T ramp = T(20);                 ///< they grow to full size over this length [m], > 0
  /// Cosines in each sum, 1 to 1000000. The sum repeats after lines 2 pi / (highest - lowest
  /// frequency), which the track must not reach.
  int lines = 1000;
};

/// Irregularities over [0, @p length] as sums of cosines of equally spaced frequencies, the middles
/// of bands of width dW, with phases that are random, equal in distribution and independent:
///
///     y(s) = w(s) sum_k sqrt(2 S(W_k) dW) cos(W_k s + phase_k)
///
/// (M. Shinozuka, C.-M. Jan, Digital simulation of random processes, J. Sound Vib. 25 (1972)
/// 111-128); w is 0 up to `start` and rises over `ramp` as 10 t^3 - 15 t^4 + 6 t^5. Phases are the
/// upper 53 bits of std::mt19937_64, in the order of Irregularity, line by line: the same on every
/// machine. Sampled 16 times per shortest wavelength.
/// @throws std::invalid_argument naming what is out of range.
template <Real T>
[[nodiscard]] TrackIrregularities<T> generate_irregularities(
    const IrregularitySpectrum<T>& spectrum, const T& length,
    const IrregularityOptions<T>& options = {}) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const std::string name = "irregularities: ";
  detail::require_positive(name + "length", length, "[m]");
  detail::require_positive(name + "shortest wavelength", options.shortest_wavelength, "[m]");
  detail::require(is_finite(options.longest_wavelength) &&
                      options.shortest_wavelength < options.longest_wavelength,
                  name + "longest wavelength", options.longest_wavelength,
                  "finite and greater than the shortest [m]");
  detail::require_not_negative(name + "start", options.start, "[m]");
  detail::require_positive(name + "ramp", options.ramp, "[m]");
  detail::require(
      0 < options.lines && options.lines <= 1000000,
      name + "lines is " + std::to_string(options.lines) + ", but must be between 1 and 1000000");
  for (const T& amplitude :
       {spectrum.lateral, spectrum.vertical, spectrum.gauge, spectrum.cross_level}) {
    detail::require_not_negative(name + "amplitude", amplitude, "[m rad]");
  }
  for (const T& cutoff : {spectrum.cutoff_c, spectrum.cutoff_r, spectrum.cutoff_s}) {
    detail::require_positive(name + "cutoff frequency", cutoff, "[rad/m]");
  }
  const T lowest = T(2) * pi<T>() / options.longest_wavelength;
  const T step = (T(2) * pi<T>() / options.shortest_wavelength - lowest) / T(options.lines);
  const T period = T(2) * pi<T>() / step;
  detail::require(length <= period, name + "length", length,
                  "at most " + detail::to_text(period) + " m, where " +
                      std::to_string(options.lines) + " lines begin to repeat");

  const T spacing = options.shortest_wavelength / T(16);
  std::vector<T> arc_lengths{T(0), spacing, T(2) * spacing};
  while (arc_lengths.back() < length) {
    arc_lengths.push_back(T(static_cast<double>(arc_lengths.size())) * spacing);
  }
  std::vector<Irregularity<T>> table(arc_lengths.size());
  std::mt19937_64 engine(options.seed);
  const auto uniform = [&] { return T(static_cast<double>(engine() >> 11U) * 0x1p-53); };
  const std::array<T Irregularity<T>::*, 4> channels{
      &Irregularity<T>::lateral, &Irregularity<T>::vertical, &Irregularity<T>::gauge,
      &Irregularity<T>::cross_level};
  for (int k = 0; k < options.lines; ++k) {
    const T frequency = lowest + (T(k) + constant<T>(0.5L)) * step;
    const Irregularity<T> density = spectrum.density(frequency);
    // Along the table the cosine turns by a constant angle: one rotation a sample.
    const T turn_cos = cos(T(frequency * spacing)), turn_sin = sin(T(frequency * spacing));
    for (const auto channel : channels) {
      const T amplitude = sqrt(T(T(2) * density.*channel * step));
      const T phase = T(2) * pi<T>() * uniform();
      T x = amplitude * cos(phase), y = amplitude * sin(phase);
      for (Irregularity<T>& row : table) {
        row.*channel += x;
        const T turned = x * turn_cos - y * turn_sin;
        y = x * turn_sin + y * turn_cos;
        x = turned;
      }
    }
  }
  for (std::size_t i = 0; i < table.size(); ++i) {
    const T t = detail::clamp(T((arc_lengths[i] - options.start) / options.ramp), T(0), T(1));
    const T window = t * t * t * (T(10) + t * (T(6) * t - T(15)));
    for (const auto channel : channels) table[i].*channel *= window;
  }
  return TrackIrregularities<T>(std::move(arc_lengths), table);
}

}  // namespace wheelrail
