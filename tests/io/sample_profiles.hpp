#pragma once
// Wheel and rail as points, and as files in all formats.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>
#include <wheelrail/io/profile_file.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>

namespace wheelrail_test {

// A profile at equal lateral steps, clear of its steep ends.
template <class P>
[[nodiscard]] wheelrail::ProfilePoints<double> sampled(const P& profile, double lower, double upper,
                                                       int steps) {
  wheelrail::ProfilePoints<double> points;
  for (int i = 0; i <= steps; ++i) {
    const double u = lower + (upper - lower) * i / steps;
    points.lateral.push_back(u);
    points.value.push_back(profile.evaluate(u).value);
  }
  return points;
}

[[nodiscard]] inline wheelrail::ProfilePoints<double> wheel_points(int steps = 130) {
  return sampled(wheelrail::s1002<double>(), -0.0695, 0.06, steps);
}

// A rail that is not symmetric: its gauge side goes deeper.
[[nodiscard]] inline wheelrail::ProfilePoints<double> rail_points(int steps = 70) {
  return sampled(wheelrail::rail_60e1<double>(), -0.0365, 0.0355, steps);
}

[[nodiscard]] inline wheelrail::ProfilePoints<double> points_of(wheelrail::ProfileKind kind,
                                                                int steps) {
  return kind == wheelrail::ProfileKind::wheel ? wheel_points(steps) : rail_points(steps);
}

// Lines "x<separator>y" of the points, lateral and value multiplied by the factors.
[[nodiscard]] inline std::string rows(const wheelrail::ProfilePoints<double>& points,
                                      double lateral_factor, double value_factor,
                                      const std::string& separator = " ",
                                      const std::string& line_end = "\n") {
  std::string text;
  for (std::size_t i = 0; i < points.size(); ++i) {
    wheelrail::detail::append_number(text, lateral_factor * points.lateral[i]);
    text += separator;
    wheelrail::detail::append_number(text, value_factor * points.value[i]);
    text += line_end;
  }
  return text;
}

// A SIMPACK file as that program writes them, with `keys` in the section spline.
[[nodiscard]] inline std::string simpack_text(bool is_wheel, const std::string& keys,
                                              const std::string& lines) {
  std::string text =
      "! ****************************\n"
      "! ***  Profile of a test   ***\n"
      "  header.begin\n"
      "    version       =  1          ! Version flag\n"
      "    type          =  ";
  text.append(is_wheel ? "1" : "0");
  text.append(
      "          ! 0=rail profile, 1=wheel profile\n"
      "  header.end\n"
      "  spline.begin\n"
      "    approx.smooth  = +0.000000000000000e+00\n"
      "    comment        = 'new! 100 %'  ! Comment\n");
  text.append(keys);
  text.append("    point.begin\n      ! y  z  weight\n");
  text.append(lines);
  text.append("    point.end\n  spline.end\n! E n d\n");
  return text;
}

// The greatest distance of two lists [m], or infinity where they are not equally long.
[[nodiscard]] inline double distance_of(const std::vector<double>& a,
                                        const std::vector<double>& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double greatest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    greatest = std::max(greatest, std::abs(a[i] - b[i]));
  }
  return greatest;
}

}  // namespace wheelrail_test
