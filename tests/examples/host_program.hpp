#pragma once
// What the programs of examples/hosts print and write.

#include <cmath>

#include "../support/catch.hpp"
#include "run_program.hpp"

namespace wheelrail_test {

// One run of the host, as the program's table has it.
struct HostRow {
  double setting, difference, bound, ratio, extrapolated;
};

struct HostResult {
  ProgramResult program;
  std::vector<HostRow> rows;
  std::vector<std::vector<double>> series;  // of comparison.csv: time, embedded, each run
};

// Runs examples/hosts/`name` with --output, for tables that must be there.
[[nodiscard]] inline HostResult run_host(const std::string& name, const std::string& setting_name,
                                         Strings arguments) {
  const auto numbers = [](const std::string& line) {
    std::vector<double> values;
    for (const std::string& field : fields_of(line)) values.push_back(std::stod(field));
    return values;
  };
  const TemporaryDirectory scratch;
  arguments.insert(arguments.end(), {"--output", scratch.path().string()});
  HostResult result{run_program("hosts/" + name, arguments), {}, {}};
  INFO(result.program.output);
  INFO(result.program.error);
  CHECK(result.program.error.empty());
  CHECK(names_in(scratch.path()) == Strings{"comparison.csv", "summary.txt"});
  CHECK(read_text(scratch / "summary.txt") == result.program.output);

  bool in_table = false;
  for (const std::string& line : lines_of(result.program.output)) {
    if (line.starts_with("within_bound: ")) in_table = false;
    if (in_table) {
      const auto values = numbers(line);
      REQUIRE(values.size() == 6);
      result.rows.push_back({values[0], values[1], values[2], values[3], values[4]});
    }
    if (line.starts_with(setting_name + ",greatest_difference_m,")) in_table = true;
  }
  const Strings lines = lines_of(read_text(scratch / "comparison.csv"));
  REQUIRE(lines.size() > 1);
  REQUIRE(lines[0].starts_with("time,embedded," + setting_name + "_"));
  for (std::size_t i = 1; i < lines.size(); ++i) {
    result.series.push_back(numbers(lines[i]));
    REQUIRE(result.series.back().size() == 2 + result.rows.size());
  }
  return result;
}

// The printed differences are those of the lateral shifts that were written, every 10 ms.
inline void check_differences(const HostResult& result, double duration) {
  const auto count = static_cast<std::size_t>(std::lround(duration / 0.01)) + 1;
  REQUIRE(result.series.size() == count);
  for (std::size_t k = 0; k < result.rows.size(); ++k) {
    double greatest = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const auto& row = result.series[i];
      CHECK(std::abs(row[0] - 0.01 * static_cast<double>(i)) < 1e-9);
      greatest = std::max(greatest, std::abs(row[2 + k] - row[1]));
    }
    CHECK(result.rows[k].difference == Approx(greatest).epsilon(2e-3).margin(1e-15));
    CHECK((result.rows[k].difference <= result.rows[k].bound) == (result.program.exit_code == 0));
  }
}

// In 10 s the wheelset hunts: it starts 2 mm to the left, and passes the middle of the track five
// times and more, by more than 1.5 mm to each side.
inline void check_hunting(const HostResult& result) {
  int passages = 0;
  double least = 0, greatest = 0;
  for (std::size_t i = 1; i < result.series.size(); ++i) {
    const double before = result.series[i - 1][2], now = result.series[i][2];
    passages += (before < 0) != (now < 0) ? 1 : 0;
    least = std::min(least, now);
    greatest = std::max(greatest, now);
  }
  CHECK(std::abs(result.series[0][2] - 0.002) < 1e-15);
  CHECK(passages >= 5);
  CHECK(least < -0.0015);
  CHECK(greatest > 0.0015);
}

// Bad input is refused in one line, and nothing is written.
inline void check_refused(const std::string& name, Strings arguments, const std::string& why) {
  const TemporaryDirectory scratch;
  arguments.insert(arguments.end(), {"--output", scratch / "made/run"});
  const auto result = run_program("hosts/" + name, arguments);
  CAPTURE(arguments, result.exit_code, result.output, result.error);
  CHECK(refuses(result, name));
  CHECK_THAT(result.error, Catch::Matchers::ContainsSubstring(why));
  CHECK(names_in(scratch.path()).empty());
}

}  // namespace wheelrail_test
