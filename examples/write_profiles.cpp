// Writes the files of profiles/: nominal profiles, sampled, and worn ones made from them. What each
// is, with its numbers, stands in profiles/README.md. The bytes are the same on every run.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>
#include <wheelrail/io/profile_file.hpp>

#include "support/arguments.hpp"
#include "support/output.hpp"
#include "support/profiles.hpp"

namespace {

using wheelrail::ProfileFormat;
using wheelrail::ProfileKind;
using Points = wheelrail::ProfilePoints<double>;

constexpr double mm = 1e-3;
constexpr double spacing = 0.5 * mm;
// Steps per millimetre of what coordinates are rounded to, and of those of "measured" files.
constexpr double fine = 1e6, coarse = 1e4;
constexpr double noise = 0.01 * mm;  // one standard deviation

// A point of an unworn profile.
struct Sample {
  double length;  // along the profile from lateral 0, in chords, positive to the field side [m]
  double lateral, value, slope;
};

// The samples from lateral 0 to `end`, without the first: each at the chord `spacing` from the one
// before, the last at `end` itself, half to one and a half times as far.
template <class P>
std::vector<Sample> samples_towards(const P& profile, double end) {
  const double sign = end < 0 ? -1 : 1;
  const auto chord = [&](const Sample& from, double to) {
    const double du = to - from.lateral, dv = profile.evaluate(to).value - from.value;
    return std::sqrt(du * du + dv * dv);
  };
  const auto sample = [&](double length, double u) {
    const auto point = profile.evaluate(u);
    return Sample{length, u, point.value, point.slope};
  };
  std::vector<Sample> samples{sample(0, 0)};
  while (1.5 * spacing < chord(samples.back(), end)) {
    const Sample last = samples.back();
    double near = last.lateral, far = sign * std::min(sign * last.lateral + spacing, sign * end);
    for (int i = 0; i < 60; ++i) {
      const double middle = near + (far - near) / 2;
      (chord(last, middle) < spacing ? near : far) = middle;
    }
    samples.push_back(sample(last.length + sign * spacing, far));
  }
  const Sample last = samples.back();
  samples.push_back(sample(last.length + sign * chord(last, end), end));
  samples.erase(samples.begin());
  return samples;
}

// From `lower` to `upper`, with a sample at lateral 0.
template <class P>
std::vector<Sample> samples_of(const P& profile, double lower, double upper) {
  std::vector<Sample> samples = samples_towards(profile, lower);
  std::reverse(samples.begin(), samples.end());
  const auto middle = profile.evaluate(0.0);
  samples.push_back({0, 0, middle.value, middle.slope});
  for (const Sample& sample : samples_towards(profile, upper)) samples.push_back(sample);
  return samples;
}

// A rail head between the ends of its corner arcs, less `margin` [m] on either side: the straight
// sides are left out.
std::vector<Sample> head_of(const examples::RailHead& rail, double margin = 0) {
  return samples_of(rail, rail.joint(1) + margin, rail.joint(rail.piece_count() - 1) - margin);
}

// Material that is gone: depth (1 - t^2)^3 across the profile, t = (length - centre) / half_length.
// It and its first two derivatives vanish at the ends.
struct Bump {
  double depth, centre, half_length;

  [[nodiscard]] double at(double length) const {
    const double t = (length - centre) / half_length;
    const double rest = 1 - t * t;
    return rest > 0 ? depth * rest * rest * rest : 0;
  }
};

// From 0 to 1 with two vanishing derivatives at both ends.
double ramp(double x) {
  if (!(x > 0)) return 0;
  return x < 1 ? x * x * x * (10 - 15 * x + 6 * x * x) : 1;
}

// How much of the flange's lateral shift a place of the unworn wheel takes part in: all of it on
// the face, none on the tip and on the tread.
double flange_share(double lateral) {
  const double from_tip = (lateral + 55 * mm) / (11 * mm);
  const double from_tread = (-20 * mm - lateral) / (16 * mm);
  return ramp(std::min(from_tip, from_tread));
}

struct Wear {
  std::vector<Bump> bumps;
  double flange_loss = 0;  // of the flange's thickness [m]
};

Points worn(const std::vector<Sample>& samples, const Wear& wear) {
  Points points;
  for (const Sample& sample : samples) {
    double depth = 0;
    for (const Bump& bump : wear.bumps) depth += bump.at(sample.length);
    const double cosine = 1 / std::sqrt(1 + sample.slope * sample.slope);
    points.lateral.push_back(sample.lateral + depth * sample.slope * cosine -
                             wear.flange_loss * flange_share(sample.lateral));
    points.value.push_back(sample.value - depth * cosine);
  }
  return points;
}

// With noise across the profile: of each point the sum of 12 uniform numbers less 6, times the
// standard deviation. (What std::normal_distribution gives is not the same everywhere.)
Points measured(const Points& points, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Points noisy = points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    double deviate = -6;
    for (int k = 0; k < 12; ++k) deviate += static_cast<double>(random() >> 11) * 0x1p-53;
    const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, points.size() - 1);
    const double du = points.lateral[after] - points.lateral[before];
    const double dv = points.value[after] - points.value[before];
    const double scale = noise * deviate / std::sqrt(du * du + dv * dv);
    noisy.lateral[i] -= scale * dv;
    noisy.value[i] += scale * du;
  }
  return noisy;
}

// What goes wrong in a measurement: a point 0.5 mm off the surface, and a point twice.
Points with_defects(Points points, std::size_t spike, std::size_t twice) {
  points.value[spike] += 0.5 * mm;
  const auto at = static_cast<std::ptrdiff_t>(twice);
  points.lateral.insert(points.lateral.begin() + at, points.lateral[twice]);
  points.value.insert(points.value.begin() + at, points.value[twice]);
  return points;
}

// To whole steps, as read from a file in mm.
Points rounded(Points points, double per_mm) {
  for (auto* coordinates : {&points.lateral, &points.value}) {
    // Without the sign of a zero.
    for (double& x : *coordinates)
      x = examples::plain(std::round(x * 1000 * per_mm) / per_mm / 1000);
  }
  return points;
}

struct File {
  std::string name, what;
  Points points;
};

std::vector<File> all_files() {
  const auto wheel = samples_of(wheelrail::s1002<double>(), -69.5 * mm, 60 * mm);
  const auto rail_60e1 = head_of(examples::rail_profile("60e1"));
  const auto rail_uic50 = head_of(examples::rail_profile("uic50"));
  const auto hollow = [](double depth) { return Bump{depth, 2 * mm, 28 * mm}; };
  const Bump crown{0.2 * mm, 0, 20 * mm};
  const Bump gauge_corner{0.6 * mm, -32 * mm, 9 * mm};

  const Points s1002 = worn(wheel, {}), head_60e1 = worn(rail_60e1, {});
  // An instrument does not see the steepest part of the corners, and a fit to noise is bad there.
  const auto seen = head_of(examples::rail_profile("60e1"), 0.1 * mm);
  const std::string wheel_name = "S1002 wheel", rail_name = "60E1 rail";
  const std::string uic50_name =
      "UIC50 (50E4) rail, nominal; ASSUMPTION: the depth of its corner, 14.1 mm, is that of 54E1";
  std::vector<File> files{
      {"s1002.prw", wheel_name + ", nominal", s1002},
      {"s1002.whl", wheel_name + ", nominal", s1002},
      {"s1002.csv", wheel_name + ", nominal", s1002},
      {"s1002_hollow_1mm.prw", wheel_name + ", tread hollow by 1 mm",
       worn(wheel, {.bumps = {hollow(1 * mm)}})},
      {"s1002_hollow_3mm.prw", wheel_name + ", tread hollow by 3 mm",
       worn(wheel, {.bumps = {hollow(3 * mm)}})},
      {"s1002_thin_flange.prw", wheel_name + ", flange thinner by 3 mm",
       worn(wheel, {.bumps = {}, .flange_loss = 3 * mm})},
      {"s1002_worn.csv", wheel_name + ", tread hollow by 2 mm and flange thinner by 3 mm",
       worn(wheel, {.bumps = {hollow(2 * mm)}, .flange_loss = 3 * mm})},
      {"60e1.prr", rail_name + ", nominal", head_60e1},
      {"60e1.rai", rail_name + ", nominal", head_60e1},
      {"60e1.csv", rail_name + ", nominal", head_60e1},
      {"uic50.prr", uic50_name, worn(rail_uic50, {})},
      {"uic50.csv", uic50_name, worn(rail_uic50, {})},
      {"60e1_flat_crown.prr", rail_name + ", crown worn by 0.2 mm",
       worn(rail_60e1, {.bumps = {crown}})},
      {"60e1_gauge_corner.prr", rail_name + ", gauge corner worn by 0.6 mm",
       worn(rail_60e1, {.bumps = {gauge_corner}})}};
  for (File& file : files) file.points = rounded(std::move(file.points), fine);

  files.push_back({"s1002_measured.whl", wheel_name + ", tread hollow by 1 mm, noise of 10 um",
                   measured(worn(wheel, {.bumps = {hollow(1 * mm)}}), 1)});
  files.push_back({"60e1_measured.rai",
                   rail_name + ", gauge corner worn by 0.6 mm, noise of 10 um, two bad points",
                   with_defects(measured(worn(seen, {.bumps = {gauge_corner}}), 2), 60, 100)});
  for (std::size_t i = files.size() - 2; i < files.size(); ++i) {
    files[i].points = rounded(std::move(files[i].points), coarse);
  }
  return files;
}

int write_all(const examples::Arguments& arguments) {
  const std::string output = arguments.text("--output");
  if (output.empty()) throw std::invalid_argument("--output must name a directory to write to");
  const std::vector<File> files = all_files();
  const auto directory = examples::prepare_directory(output);
  std::printf("file,points\n");
  for (const File& file : files) {
    const std::string extension = file.name.substr(file.name.rfind('.'));
    const bool is_simpack = extension == ".prw" || extension == ".prr";
    wheelrail::write_profile(
        directory / file.name, file.points,
        file.name.starts_with("s1002") ? ProfileKind::wheel : ProfileKind::rail,
        {.format = is_simpack            ? ProfileFormat::simpack
                   : extension == ".csv" ? ProfileFormat::table
                                         : ProfileFormat::miniprof,
         .unit = wheelrail::LengthUnit::millimetre,
         .comments = {file.what, "wheelrail: write_profiles; see README.md of this folder"}});
    std::printf("%s,%zu\n", file.name.c_str(), file.points.size());
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  examples::Arguments arguments(
      "Writes the files of profiles/ to a directory: nominal wheel and rail profiles, sampled, "
      "and\n"
      "worn ones made from them, as SIMPACK (.prw, .prr), MiniProf (.whl, .rai) and CSV files, "
      "all\n"
      "in mm. Files of the same names are replaced. Prints the files with their points as CSV.\n"
      "Exit code 0; 2 on bad input or where a file cannot be written.",
      {{"--output", "DIR", "", "directory, made if it is missing; has to be given"}});
  return examples::run(argc, argv, arguments, write_all);
}
