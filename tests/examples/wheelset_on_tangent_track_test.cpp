// examples/wheelset_on_tangent_track as a user runs it: its files and summary, and bad input.

#include <cmath>
#include <map>
#include <tuple>

#include "../support/catch.hpp"
#include "run_program.hpp"

using namespace wheelrail_test;
using Catch::Matchers::ContainsSubstring;

namespace {

const std::string program = "wheelset_on_tangent_track";

// The `key: value` lines.
std::map<std::string, std::string> summary_of(const std::string& text) {
  std::map<std::string, std::string> summary;
  for (const std::string& line : lines_of(text)) {
    const auto colon = line.find(": ");
    REQUIRE(colon != std::string::npos);
    REQUIRE(summary.emplace(line.substr(0, colon), line.substr(colon + 2)).second);
  }
  return summary;
}

struct Table {
  Strings columns;
  std::vector<Strings> rows;

  [[nodiscard]] const std::string& text(std::size_t row, const std::string& column) const {
    const auto found = std::find(columns.begin(), columns.end(), column);
    REQUIRE(found != columns.end());
    return rows.at(row).at(static_cast<std::size_t>(found - columns.begin()));
  }
  [[nodiscard]] double number(std::size_t row, const std::string& column) const {
    return std::stod(text(row, column));
  }
};

Table table_of(const std::string& path) {
  const Strings lines = lines_of(read_text(path));
  REQUIRE(!lines.empty());
  Table table{fields_of(lines[0]), {}};
  for (std::size_t i = 1; i < lines.size(); ++i) {
    table.rows.push_back(fields_of(lines[i]));
    REQUIRE(table.rows.back().size() == table.columns.size());
    for (const std::string& field : table.rows.back()) {
      REQUIRE(field != "-0");
      REQUIRE(field != "-nan");
    }
  }
  return table;
}

// A row each millisecond from 0 to the duration, and for each of its patches a row of the other.
void check_tables(const Table& series, const Table& patches, double duration) {
  const auto count = static_cast<std::size_t>(std::ceil(duration / 1e-3 - 1e-9)) + 1;
  REQUIRE(series.rows.size() == count);
  std::size_t next = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double time = i + 1 == count ? duration : 1e-3 * static_cast<double>(i);
    CAPTURE(i, next);
    CHECK(std::abs(series.number(i, "time") - time) < 1e-12);
    for (const char* name : {"left", "right"}) {
      const std::string side = name;
      double force = 0, deepest = -1;
      const int expected = std::stoi(series.text(i, side + "_patches"));
      for (int k = 0; k < expected; ++k, ++next) {
        REQUIRE(next < patches.rows.size());
        CHECK(patches.text(next, "time") == series.text(i, "time"));
        CHECK(patches.text(next, "side") == side);
        CHECK(patches.text(next, "patch") == std::to_string(k));
        force += patches.number(next, "normal_force");
        deepest = std::max(deepest, patches.number(next, "penetration"));
      }
      CHECK(series.number(i, side + "_normal_force") == Approx(force).epsilon(1e-8));
      if (expected > 0) {
        CHECK(series.number(i, side + "_penetration") == Approx(deepest).epsilon(1e-8));
      } else {
        CHECK(series.text(i, side + "_penetration") == "nan");
      }
    }
  }
  CHECK(next == patches.rows.size());
}

}  // namespace

TEST_CASE("wheelset_on_tangent_track: --help says what there is, with units", "[examples]") {
  const auto result = run_program(program, {"--help"});
  CHECK(result.exit_code == 0);
  CHECK(result.error.empty());
  for (const char* text :
       {"--wheel", "--method", "--speed", "--duration", "--lateral-shift", "--output", "--mass",
        "--roll-inertia", "--spin-inertia", "[m/s]", "[s]", "[m]", "[rad]", "[kg]", "[kg m2]"}) {
    CHECK_THAT(result.output, ContainsSubstring(text));
  }
}

TEST_CASE("wheelset_on_tangent_track: the summary and the tables are of one run", "[examples]") {
  for (const char* wheel : {"s1002", "s1002-convex"}) {
    for (const char* method : {"strip", "minimum-distance"}) {
      CAPTURE(wheel, method);
      const TemporaryDirectory scratch;
      const std::string output = scratch / "made/on/the way";
      const auto result = run_program(program, {"--wheel", wheel, "--method", method, "--duration",
                                                "0.05", "--output", output});
      REQUIRE(result.exit_code == 0);
      CHECK(result.error.empty());
      CHECK(names_in(output) == Strings{"patches.csv", "summary.txt", "time_series.csv"});
      CHECK(read_text(output + "/summary.txt") == result.output);

      auto summary = summary_of(result.output);
      for (const char* key : {"hunting_wavelength_m", "steps", "contact_searches", "seconds",
                              "real_time_factor", "failed_searches"}) {
        CAPTURE(key);
        CHECK(summary.count(key) == 1);
      }
      CHECK(summary["wheel"] == wheel);
      CHECK(summary["method"] == method);
      CHECK(summary["status"] == "finished");
      CHECK(std::stod(summary["simulated_s"]) == 0.05);
      CHECK(summary["hunting_wavelength_m"] == "nan");  // half a metre is no wave
      CHECK(std::stod(summary["seconds"]) > 0);
      CHECK(std::stod(summary["real_time_factor"]) ==
            Approx(0.05 / std::stod(summary["seconds"])).epsilon(1e-3));
      CHECK(std::stoi(summary["steps"]) >= 50);
      // Two wheels, six stages and more for each step that was tried.
      const int tried = std::stoi(summary["steps"]) + std::stoi(summary["rejected_steps"]);
      CHECK(std::stoi(summary["contact_searches"]) >= 2 * 6 * tried);
      CHECK(std::stoi(summary["contact_searches"]) <= 2 * 7 * tried + 8);
      CHECK(summary["failed_searches"] == "0");

      CHECK(read_text(output + "/time_series.csv").starts_with("time,lateral_shift,yaw,"));
      const Table series = table_of(output + "/time_series.csv");
      check_tables(series, table_of(output + "/patches.csv"), 0.05);
      CHECK(series.number(0, "lateral_shift") == 0.002);
      CHECK(series.number(0, "velocity_x") == 10);
      const std::size_t last = series.rows.size() - 1;
      CHECK(series.number(last, "longitudinal") == Approx(0.5).epsilon(1e-3));
      CHECK(std::stod(summary["final_speed_m_s"]) ==
            Approx(series.number(last, "velocity_x")).epsilon(1e-8));
      double greatest = 0, force = 0;
      for (std::size_t i = 0; i <= last; ++i) {
        greatest = std::max(greatest, std::abs(series.number(i, "lateral_shift")));
        force += (series.number(i, "left_force_z") + series.number(i, "right_force_z")) /
                 static_cast<double>(last + 1);
      }
      CHECK(std::stod(summary["greatest_lateral_shift_m"]) == Approx(greatest).epsilon(1e-5));
      CHECK(force == Approx(9810).epsilon(0.2));  // the weight, while it settles
    }
  }
}

TEST_CASE("wheelset_on_tangent_track: rows come every ms, the last at the end", "[examples]") {
  for (const char* duration : {"0.0105", "0.0004", "0.01"}) {
    CAPTURE(duration);
    const TemporaryDirectory scratch;
    const auto result = run_program(
        program, {"--duration", duration, "--speed=20", "--output", scratch.path().string()});
    REQUIRE(result.exit_code == 0);
    check_tables(table_of(scratch / "time_series.csv"), table_of(scratch / "patches.csv"),
                 std::stod(duration));
  }
}

TEST_CASE("wheelset_on_tangent_track: options reach the run", "[examples]") {
  const auto final_row = [](const Strings& options) {
    const TemporaryDirectory scratch;
    Strings arguments{"--duration", "0.02", "--output", scratch.path().string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    REQUIRE(run_program(program, arguments).exit_code == 0);
    return lines_of(read_text(scratch / "time_series.csv")).back();
  };
  const std::string plain = final_row({});
  CHECK(final_row({}) == plain);
  CHECK(final_row({"--mass", "1000", "--wheel", "s1002"}) == plain);
  for (const Strings& options :
       {Strings{"--mass", "1100"}, Strings{"--roll-inertia", "650"},
        Strings{"--spin-inertia", "90"}, Strings{"--speed", "11"},
        Strings{"--lateral-shift", "0.001"}, Strings{"--yaw", "0.001"},
        Strings{"--friction", "0.1"}, Strings{"--restitution", "0.5"}, Strings{"--rail", "60e1"},
        Strings{"--gauge", "1.436"}, Strings{"--inclination", "0.025"},
        Strings{"--nominal-radius", "0.45"}, Strings{"--wheel", "s1002-convex"}}) {
    CAPTURE(options[0]);
    CHECK(final_row(options) != plain);
  }
}

TEST_CASE("wheelset_on_tangent_track: nothing is written without --output", "[examples]") {
  const auto result = run_program(program, {"--duration", "0.01"});
  CHECK(result.exit_code == 0);
  CHECK(summary_of(result.output)["status"] == "finished");
}

TEST_CASE("wheelset_on_tangent_track: bad input is refused in one line and leaves nothing",
          "[examples][bad-input]") {
  struct Case {
    Strings arguments;
    const char* why;
  };
  const Case cases[] = {
      {{"--duration", "0"}, "--duration is 0"},
      {{"--duration", "-1"}, "--duration is -1"},
      {{"--duration", "nan"}, "--duration is 'nan'"},
      {{"--duration", "inf"}, "--duration is 'inf'"},
      {{"--duration", "1e6"}, "--duration is 1e6"},
      {{"--speed", "0"}, "--speed is 0"},
      {{"--speed", "-10"}, "--speed is -10"},
      {{"--speed", "fast"}, "--speed is 'fast'"},
      {{"--mass", "-1000"}, "--mass is -1000"},
      {{"--mass", "0"}, "--mass is 0"},
      {{"--roll-inertia", "-600"}, "--roll-inertia"},
      {{"--spin-inertia", "nan"}, "--spin-inertia"},
      // A body whose moments break the triangle inequality does not exist.
      {{"--spin-inertia", "5000"},
       "--spin-inertia is 5000, but must be at most twice --roll-inertia"},
      {{"--roll-inertia", "30"}, "at most twice --roll-inertia, which is 30"},
      {{"--nominal-radius", "-0.43"}, "--nominal-radius is -0.43"},
      {{"--gauge", "1.39"}, "gauge is 1.39"},
      {{"--lateral-shift", "nan"}, "--lateral-shift"},
      {{"--lateral-shift", "0.5"}, "--lateral-shift is 0.5 m, but must leave each wheel over"},
      // Set down on the flange tips: no start of a run.
      {{"--lateral-shift", "0.02"}, "--lateral-shift is 0.02 m, but must keep the flanges beside"},
      {{"--lateral-shift", "0.02"}, "the left one"},
      {{"--lateral-shift", "-0.02"}, "the right one"},
      {{"--lateral-shift", "0.007"}, "at most 16 mm"},
      {{"--yaw", "2"}, "--yaw is 2, but must be between -0.1 and 0.1"},
      {{"--yaw", "-0.11"}, "--yaw is -0.11"},
      {{"--friction", "-0.1"}, "friction"},
      {{"--restitution", "1.5"}, "restitution"},
      {{"--tolerance", "0"}, "--tolerance"},
      {{"--maximum-step", "-1"}, "--maximum-step"},
      {{"--wheel", "s1003"}, "s1002, s1002-convex"},
      {{"--rail", "uic54"}, "uic50, 60e1"},
      {{"--method", "newton"}, "strip, minimum-distance"},
      {{"--radius", "0.43"}, "unknown option --radius"},
      {{"--duration", "0.05", "--speed"}, "--speed: its value is missing"},
      {{"--speed", "10", "--speed", "20"}, "twice"},
  };
  for (const Case& at : cases) {
    const TemporaryDirectory scratch;
    Strings arguments{"--output", scratch / "made/run"};
    arguments.insert(arguments.end(), at.arguments.begin(), at.arguments.end());
    const auto result = run_program(program, arguments);
    CAPTURE(arguments, result.exit_code, result.output, result.error);
    CHECK(refuses(result, program));
    CHECK_THAT(result.error, ContainsSubstring(at.why));
    CHECK(names_in(scratch.path()).empty());
  }
}

TEST_CASE("wheelset_on_tangent_track: an output that is no directory is refused",
          "[examples][bad-input]") {
  const TemporaryDirectory scratch;
  write_text(scratch / "file", "kept");
  for (const std::string& output : {scratch / "file", scratch / "file/run"}) {
    const auto result = run_program(program, {"--duration", "0.01", "--output", output});
    CAPTURE(output, result.exit_code, result.output, result.error);
    CHECK(refuses(result, program));
    CHECK_THAT(result.error, ContainsSubstring("--output"));
    CHECK(names_in(scratch.path()) == Strings{"file"});
    CHECK(read_text(scratch / "file") == "kept");
  }
}

TEST_CASE("wheelset_on_tangent_track: a second run replaces the files of the first", "[examples]") {
  const TemporaryDirectory scratch;
  for (const char* duration : {"0.02", "0.01"}) {
    const auto result =
        run_program(program, {"--duration", duration, "--output", scratch.path().string()});
    REQUIRE(result.exit_code == 0);
    CHECK(names_in(scratch.path()) == Strings{"patches.csv", "summary.txt", "time_series.csv"});
    CHECK(read_text(scratch / "summary.txt") == result.output);
  }
  CHECK(table_of(scratch / "time_series.csv").rows.size() == 11);
}

// The minimum distance method needs convex bodies. On the real wheel it misses one of two patches
// where the wheel touches in fillet and tread at once, and does not converge under a large yaw,
// where it does on the convex wheel. Either must be said.
TEST_CASE("wheelset_on_tangent_track: minimum distance in the real fillet claims no success",
          "[examples][bad-input]") {
  const auto run = [](const char* wheel, const char* lateral_shift, const char* yaw,
                      const std::string& output) {
    return run_program(program,
                       {"--wheel", wheel, "--method", "minimum-distance", "--lateral-shift",
                        lateral_shift, "--yaw", yaw, "--duration", "0.1", "--output", output});
  };
  for (const auto& [lateral_shift, yaw, converges] :
       {std::tuple{"0.0055", "0", true}, std::tuple{"0.006", "0", true},
        std::tuple{"0.003", "0.1", false}}) {
    const TemporaryDirectory scratch;
    const auto result = run("s1002", lateral_shift, yaw, scratch / "run");
    CAPTURE(lateral_shift, yaw, result.exit_code, result.error);
    CHECK(result.exit_code == 3);
    CHECK(result.error.starts_with(program + ": "));
    CHECK_THAT(result.error, ContainsSubstring("missed a patch: it needs a convex wheel"));
    CHECK((result.error.find("did not converge") != std::string::npos) == !converges);
    CHECK((summary_of(result.output)["failed_searches"] == "0") == converges);
    CHECK(names_in(scratch / "run") == Strings{"patches.csv", "summary.txt", "time_series.csv"});

    const auto convex = run("s1002-convex", lateral_shift, yaw, scratch / "convex");
    CAPTURE(convex.error);
    CHECK(convex.exit_code == 0);
    CHECK(convex.error.empty());
  }
}

TEST_CASE("wheelset_on_tangent_track: a run that stops early says so", "[examples][bad-input]") {
  const auto result = run_program(program, {"--duration", "0.05", "--maximum-step", "1e-300"});
  CHECK(result.exit_code == 3);
  CHECK_THAT(result.error, ContainsSubstring("the run stopped at 0 s"));
  CHECK(summary_of(result.output)["status"] == "step_too_small");
}
