#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>
#include <wheelrail/track/irregularities.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"

using namespace wheelrail;

namespace {

using Row = Irregularity<double>;
using Spectrum = IrregularitySpectrum<double>;
using Irregularities = TrackIrregularities<double>;

// The integral of A Wc^2 / ((W^2 + Wr^2) (W^2 + Wc^2)) over [lower, upper], by partial fractions.
double level_variance(double amplitude, const Spectrum& s, double lower, double upper) {
  const auto primitive = [](double w, double cutoff) { return std::atan(w / cutoff) / cutoff; };
  const double r = primitive(upper, s.cutoff_r) - primitive(lower, s.cutoff_r);
  const double c = primitive(upper, s.cutoff_c) - primitive(lower, s.cutoff_c);
  const double wc2 = s.cutoff_c * s.cutoff_c;
  return amplitude * wc2 / (wc2 - s.cutoff_r * s.cutoff_r) * (r - c);
}

// The same times W^2 / (W^2 + Ws^2), numerically.
double difference_variance(double amplitude, const Spectrum& s, double lower, double upper) {
  double sum = 0.0;
  const int steps = 100000;
  for (int i = 0; i < steps; ++i) {
    const double w = lower + (upper - lower) * (i + 0.5) / steps;
    const double w2 = w * w, wc2 = s.cutoff_c * s.cutoff_c;
    sum += amplitude * wc2 / (w2 + s.cutoff_r * s.cutoff_r) * w2 / (w2 + wc2) /
           (w2 + s.cutoff_s * s.cutoff_s) * (upper - lower) / steps;
  }
  return sum;
}

template <class Make>
std::string message_of(const Make& make) {
  try {
    make();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("TrackIrregularities: a table is met at its nodes and held outside", "[track]") {
  const std::vector<double> arc_lengths{10.0, 10.5, 12.0, 12.25};
  const std::vector<Row> table{{1e-3, 0.0, 2e-3, -1e-3},
                               {2e-3, 1e-3, 0.0, 0.0},
                               {0.0, -2e-3, 1e-3, 3e-3},
                               {-1e-3, 4e-3, -1e-3, 1e-3}};
  const Irregularities irregularities(arc_lengths, table);
  const auto check = [&](double s, const Row& row) {
    const Row at = irregularities.evaluate(s);
    CHECK(std::abs(at.lateral - row.lateral) < 1e-17);
    CHECK(std::abs(at.vertical - row.vertical) < 1e-17);
    CHECK(std::abs(at.gauge - row.gauge) < 1e-17);
    CHECK(std::abs(at.cross_level - row.cross_level) < 1e-17);
  };
  for (std::size_t i = 0; i < table.size(); ++i) check(arc_lengths[i], table[i]);
  check(-5.0, table.front());
  check(99.0, table.back());
  // The ends are met with slope 0.
  CHECK(std::abs(irregularities.evaluate(10.0 + 1e-5).lateral - 1e-3) < 1e-11);
  CHECK(std::abs(irregularities.evaluate(10.25).lateral - 1e-3) > 1e-5);
  CHECK(Irregularities().evaluate(1.5).lateral == 0.0);
  CHECK(Irregularities().evaluate(1e4).cross_level == 0.0);
}

TEST_CASE("IrregularitySpectrum: densities are those of the formula by hand",
          "[track][reference]") {
  // At W = 1 rad/m: 0.8246^2 / (1.00042436 * 1.67996516) = 0.404583...
  const double shape = 0.67996516 / (1.00042436 * 1.67996516);
  const auto density = Spectrum::low_disturbance().density(1.0);
  CHECK(density.lateral == Approx(2.119e-7 * shape));
  CHECK(density.vertical == Approx(4.032e-7 * shape));
  CHECK(density.gauge == Approx(0.532e-7 * shape / 1.191844));
  // The difference of heights over 1.5 m: 1.5^2 times A / 0.75^2 = 4 A.
  CHECK(density.cross_level == Approx(4 * 4.032e-7 * shape / 1.191844));
  const auto high = Spectrum::high_disturbance().density(1.0);
  CHECK(high.vertical / density.vertical == Approx(10.80 / 4.032));
  CHECK(high.cross_level / density.cross_level == Approx(10.80 / 4.032));
}

TEST_CASE("generate_irregularities: variances are the integrals of the spectra",
          "[track][reference]") {
  const Spectrum spectrum = Spectrum::low_disturbance();
  // A repetition of 2 pi / dW = 2000 / (1 / 3 - 1 / 100) m.
  const IrregularityOptions<double> options{.seed = 7, .ramp = 1.0, .lines = 2000};
  const double period = 2000.0 / (1.0 / 3 - 1.0 / 100);
  const auto irregularities = generate_irregularities(spectrum, period, options);
  Row sum, mean, cross;
  const int samples = 60000;
  for (int i = 0; i < samples; ++i) {
    const Row at = irregularities.evaluate(1.0 + (period - 1.0) * (i + 0.5) / samples);
    sum.lateral += at.lateral * at.lateral / samples;
    sum.vertical += at.vertical * at.vertical / samples;
    sum.gauge += at.gauge * at.gauge / samples;
    sum.cross_level += at.cross_level * at.cross_level / samples;
    mean.vertical += at.vertical / samples;
    cross.vertical += at.vertical * at.lateral / samples;
    cross.gauge += at.gauge * at.cross_level / samples;
  }
  const double lower = 2 * pi<double>() / 100, upper = 2 * pi<double>() / 3;
  CHECK(sum.lateral == Approx(level_variance(2.119e-7, spectrum, lower, upper)).epsilon(5e-3));
  CHECK(sum.vertical == Approx(level_variance(4.032e-7, spectrum, lower, upper)).epsilon(5e-3));
  CHECK(sum.gauge == Approx(difference_variance(0.532e-7, spectrum, lower, upper)).epsilon(5e-3));
  CHECK(sum.cross_level ==
        Approx(difference_variance(16.128e-7, spectrum, lower, upper)).epsilon(5e-3));
  INFO("standard deviations [mm]: "
       << 1e3 * std::sqrt(sum.lateral) << " " << 1e3 * std::sqrt(sum.vertical) << " "
       << 1e3 * std::sqrt(sum.gauge) << " " << 1e3 * std::sqrt(sum.cross_level));
  CHECK(std::abs(mean.vertical) < 0.01 * std::sqrt(sum.vertical));
  CHECK(std::abs(cross.vertical) < 0.15 * std::sqrt(sum.vertical * sum.lateral));
  CHECK(std::abs(cross.gauge) < 0.15 * std::sqrt(sum.gauge * sum.cross_level));
}

TEST_CASE("generate_irregularities: the measured density is the target's, band by band",
          "[track][reference]") {
  const Spectrum spectrum = Spectrum::low_disturbance();
  // The longest wavelength makes the lines harmonics 31, 32, ... of the length, where they repeat.
  const double longest = 3 + 3000 / 30.5;
  const double length = 1000.0 / (1.0 / 3 - 1.0 / longest);
  const auto irregularities = generate_irregularities(
      spectrum, length * (1 - 1e-12), {.seed = 3, .longest_wavelength = longest, .ramp = 1e-6});
  const int samples = 20000;
  const double spacing = length / samples;
  std::vector<double> values;
  for (int i = 0; i < samples; ++i) {
    values.push_back(irregularities.evaluate(spacing * (i + 0.5)).vertical);
  }
  const auto density = [&](int harmonic) {
    std::complex<double> sum = 0.0, phase = 1.0;
    const auto turn = std::polar(1.0, -2 * pi<double>() * harmonic / samples);
    for (const double y : values) {
      sum += y * phase * spacing;
      phase *= turn;
    }
    return std::norm(sum) / length / pi<double>();  // one-sided, per rad/m
  };
  for (const int from : {31, 60, 120, 240, 480, 900}) {
    CAPTURE(from);
    double measured = 0.0, target = 0.0;
    for (int k = from; k < from + 20; ++k) {
      measured += density(k);
      target += spectrum.density(2 * pi<double>() * k / length).vertical;
    }
    // The node at 0, where the track is smooth, disturbs the rest.
    CHECK(measured / target == Approx(1.0).epsilon(0.02));
  }
  CHECK(density(1045) < 0.01 * spectrum.density(2.2).vertical);
  CHECK(density(20) < 0.01 * spectrum.density(0.05).vertical);
}

TEST_CASE("generate_irregularities: the same seed gives the same track, another one another",
          "[track]") {
  const auto make = [](std::uint64_t seed) {
    return generate_irregularities(Spectrum::low_disturbance(), 200.0, {.seed = seed});
  };
  const auto a = make(42), b = make(42), c = make(43);
  double difference = 0.0;
  for (double s = 0.0; s < 200.0; s += 0.37) {
    const Row x = a.evaluate(s), y = b.evaluate(s);
    CHECK((x.lateral == y.lateral && x.vertical == y.vertical && x.gauge == y.gauge &&
           x.cross_level == y.cross_level));
    difference = std::max(difference, std::abs(x.vertical - c.evaluate(s).vertical));
  }
  CHECK(difference > 1e-3);
}

TEST_CASE("generate_irregularities: nothing before the start, all of it after the ramp",
          "[track]") {
  const auto spectrum = Spectrum::high_disturbance();
  const auto full = generate_irregularities(spectrum, 150.0, {.ramp = 1e-3});
  const auto late = generate_irregularities(spectrum, 150.0, {.start = 30.0, .ramp = 20.0});
  double largest = 0.0;
  for (double s = 0.0; s < 150.0; s += 0.1) {
    CAPTURE(s);
    const double whole = full.evaluate(s).vertical, part = late.evaluate(s).vertical;
    if (s < 29.0) CHECK(std::abs(part) < 1e-7);  // the spline dies out within nodes, 0.19 m
    if (s > 51.0) CHECK(std::abs(part - whole) < 1e-7);
    if (s > 2.0) CHECK(std::abs(part) < std::abs(whole) + 1e-6);
    if (s > 51.0) largest = std::max(largest, std::abs(whole));
  }
  CHECK(late.evaluate(0.0).vertical == 0.0);
  CHECK(late.evaluate(40.0).vertical / full.evaluate(40.0).vertical == Approx(0.5).epsilon(0.02));
  CHECK(largest > 1e-3);
}

TEST_CASE("TrackIrregularities: queries do not allocate", "[track][no-alloc]") {
  const auto some = generate_irregularities(Spectrum::low_disturbance(), 50.0);
  double sum = 0.0;
  CHECK(wheelrail_test::allocations_of([&] { sum = some.evaluate(33.0).vertical; }) == 0);
  CHECK(sum != 0.0);
}

TEST_CASE("TrackIrregularities: bad tables and options are refused with their values",
          "[track][bad-input]") {
  using Catch::Matchers::ContainsSubstring;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(message_of([] {
               Irregularities({0, 1, 2}, std::vector<Row>(2));
             }),
             ContainsSubstring("3 nodes and 2 values"));
  CHECK_THAT(message_of([] {
               Irregularities({0, 1, 1}, std::vector<Row>(3));
             }),
             ContainsSubstring("node 2 is 1"));
  CHECK_THAT(message_of([&] {
               Irregularities({0, 1, 2}, {Row{}, Row{0, 0, nan, 0}, Row{}});
             }),
             ContainsSubstring("value 1, component 2 is nan"));
  const auto message = [](double length, const IrregularityOptions<double>& options,
                          const Spectrum& spectrum = Spectrum::low_disturbance()) {
    return message_of([&] { (void)generate_irregularities(spectrum, length, options); });
  };
  CHECK(message(100, {}).empty());
  CHECK_THAT(message(0, {}), ContainsSubstring("length is 0"));
  CHECK_THAT(message(4000, {}),
             ContainsSubstring("length is 4000") && ContainsSubstring("at most 3092.7"));
  CHECK_THAT(message(100, {.shortest_wavelength = -1}),
             ContainsSubstring("shortest wavelength is -1"));
  CHECK_THAT(message(100, {.longest_wavelength = 2}), ContainsSubstring("longest wavelength is 2"));
  CHECK_THAT(message(100, {.start = nan}), ContainsSubstring("start is nan"));
  CHECK_THAT(message(100, {.ramp = 0}), ContainsSubstring("ramp is 0"));
  CHECK_THAT(message(100, {.lines = 0}), ContainsSubstring("lines is 0"));
  CHECK_THAT(message(100, {}, Spectrum{.vertical = -1e-7}),
             ContainsSubstring("amplitude is -1e-07"));
  CHECK_THAT(message(100, {}, Spectrum{.cutoff_s = 0.0}),
             ContainsSubstring("cutoff frequency is 0"));
}
