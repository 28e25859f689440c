#include "host_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "../support/arguments.hpp"
#include "../support/output.hpp"
#include "../support/parallel.hpp"

namespace examples {

namespace {

constexpr double interval = 0.01;  // of the comparison [s]

[[nodiscard]] bool is_whole(double x) {
  return std::abs(x - std::round(x)) <= 1e-9 * x;
}

// The duration in intervals. The bounds are those of 10 s: differences grow.
[[nodiscard]] int intervals_in(const Arguments& given) {
  const double count = given.within("--duration", interval, 10) / interval;
  if (!is_whole(count)) {
    throw std::invalid_argument("--duration is " + given.text("--duration") +
                                ", but must be a multiple of 0.01 s");
  }
  return static_cast<int>(std::round(count));
}

[[nodiscard]] double setting_in(const Arguments& given, const Host& host) {
  const double setting = given.within(host.option, host.least, host.greatest);
  if (host.is_step && !is_whole(interval / setting)) {
    throw std::invalid_argument(host.option + " is " + given.text(host.option) +
                                ", but must go into 0.01 s a whole number of times");
  }
  return setting;
}

[[nodiscard]] double greatest_difference(const std::vector<double>& a,
                                         const std::vector<double>& b) {
  double greatest = a.size() == b.size() ? 0 : HUGE_VAL;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const double difference = std::abs(a[i] - b[i]);
    greatest = difference <= greatest ? greatest : difference;  // a NaN stays
  }
  return greatest;
}

// A first-order method's limit for step 0, from a run and one with half its step.
[[nodiscard]] std::vector<double> extrapolated(const std::vector<double>& whole,
                                               const std::vector<double>& half) {
  std::vector<double> limit;
  for (std::size_t i = 0; i < std::min(whole.size(), half.size()); ++i) {
    limit.push_back(2 * half[i] - whole[i]);
  }
  return limit;
}

int compare(const Host& host, const Arguments& given) {
  const int count = intervals_in(given);
  const double first_setting = setting_in(given, host);
  const double tolerance = given.within("--embedded-tolerance", 1e-13, 1e-2);
  std::filesystem::path output;
  if (given.given("--output")) output = prepare_directory(given.text("--output"));

  const std::vector<double> embedded = embedded_lateral_shifts(interval, count, tolerance);
  const WheelsetBody wheelset = wheelset_at_start();
  std::vector<std::vector<double>> runs;
  const std::string setting_name = host.option.substr(2);
  std::string table =
      setting_name + ",greatest_difference_m,bound_m,ratio,extrapolated_difference_m,seconds\n";
  std::string columns = "time,embedded";
  bool good = true;
  double setting = first_setting, before = 0;
  for (int k = 0; k < (host.is_step ? 3 : 1); ++k, setting /= 2) {
    const double begin = thread_seconds();
    runs.push_back(host.lateral_shifts(wheelset, interval, count, setting));
    const double seconds = thread_seconds() - begin;
    const double difference = greatest_difference(runs.back(), embedded);
    good = good && difference <= host.bound(setting);
    double ratio = std::nan(""), limit = std::nan("");
    if (k > 0) {
      ratio = before / difference;
      limit = greatest_difference(extrapolated(runs[runs.size() - 2], runs.back()), embedded);
    }
    before = difference;
    table += format("%g", setting);
    append_fields(table, 4, {difference, host.bound(setting), ratio, limit, seconds});
    table += "\n";
    columns += format(",%s_%g", setting_name.c_str(), setting);
  }

  std::string summary = format("host: %s\nembedded_tolerance: %g\n", host.name.c_str(), tolerance);
  summary += "time_s,embedded_mm,host_mm,difference_um\n";
  std::string series = columns + "\n";
  const std::vector<double>& finest = runs.back();
  for (std::size_t i = 0; i < embedded.size(); ++i) {
    const double time = interval * static_cast<double>(i);
    if (i % 100 == 0 || i + 1 == embedded.size()) {
      summary += format("%.2f,%.6f,%.6f,%.6f\n", time, 1e3 * embedded[i], 1e3 * finest[i],
                        1e6 * plain(finest[i] - embedded[i]));
    }
    series += format("%.2f", time);
    append_fields(series, 15, {embedded[i]});
    for (const auto& run : runs) append_fields(series, 15, {run[i]});
    series += "\n";
  }
  summary += table;
  summary += format("within_bound: %s\n", good ? "yes" : "no");
  if (!output.empty()) {
    write_file(output / "comparison.csv", series);
    write_file(output / "summary.txt", summary);
  }
  std::fputs(summary.c_str(), stdout);
  return good ? 0 : 3;
}

}  // namespace

int compare_with_embedded_run(int argc, char** argv, const Host& host) {
  const Arguments arguments(
      host.summary + "\nExit code 0; 2 on bad input, 3 when a run failed or the bound is broken.",
      {{"--duration", "S", "10", "of the run [s], a multiple of 0.01, at most 10"},
       {host.option, host.placeholder, host.default_value, host.help},
       {"--embedded-tolerance", "TOL", "1e-10",
        "relative and absolute tolerance of the embedded integrator [-], 1e-13 to 0.01"},
       {"--output", "DIR", "",
        "gets comparison.csv (lateral shifts every 10 ms [m]) and summary.txt; made if need be"}});
  const std::string path = argc > 0 ? argv[0] : host.name;
  return run(argc, argv, arguments, [&](const Arguments& given) {
    try {
      return compare(host, given);
    } catch (const std::invalid_argument&) {
      throw;  // bad input
    } catch (const std::exception& error) {
      std::string line =
          path.substr(path.find_last_of('/') + 1) + ": the run failed: " + error.what();
      std::replace(line.begin(), line.end(), '\n', ' ');
      std::fprintf(stderr, "%s\n", line.c_str());
      return 3;
    }
  });
}

}  // namespace examples
