// examples/study as examples/study.sh runs it, but shorter: every file that the plots read.

#include <set>

#include "../support/catch.hpp"
#include "run_program.hpp"

using namespace wheelrail_test;
using Catch::Matchers::Contains;

namespace {

// The names that a gnuplot script puts behind data."/, with its variable `part` filled in.
std::set<std::string> files_read_by(const std::string& script) {
  std::set<std::string> names;
  const std::string text = read_text(script);
  // do for [part in "tread fillet"]
  Strings parts;
  const std::string list = "part in \"";
  if (const auto at = text.find(list); at != std::string::npos) {
    const auto begin = at + list.size();
    std::string word;
    for (const char c : text.substr(begin, text.find('"', begin) - begin) + " ") {
      if (c != ' ') {
        word += c;
      } else if (!word.empty()) {
        parts.push_back(word);
        word.clear();
      }
    }
  }
  const std::string mark = "data.\"/";
  for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1)) {
    const auto begin = at + mark.size();
    const auto end = text.find('"', begin);
    const std::string name = text.substr(begin, end - begin);
    const std::string variable = "\".part.\"";
    if (text.compare(end, variable.size(), variable) != 0) {
      names.insert(name);
      continue;
    }
    const auto rest = end + variable.size();
    for (const std::string& part : parts) {
      names.insert(name + part + text.substr(rest, text.find('"', rest) - rest));
    }
  }
  return names;
}

// The highest column that a plot of `file` uses is not looked for: the tables are rectangular.
void check_rectangular(const std::string& path) {
  const Strings lines = lines_of(read_text(path));
  CAPTURE(path);
  REQUIRE(lines.size() > 1);
  const std::size_t columns = fields_of(lines[0]).size();
  CHECK(columns > 3);
  std::size_t wrong = 0;
  for (const std::string& line : lines) wrong += fields_of(line).size() == columns ? 0U : 1U;
  CHECK(wrong == 0);
}

}  // namespace

TEST_CASE("study: writes all that the plots read and a report of three scenarios", "[examples]") {
  const TemporaryDirectory scratch;
  const auto result = run_program("study", {"--duration", "0.05", "--output", scratch / "study"});
  CAPTURE(result.error);
  REQUIRE(result.exit_code == 0);
  const Strings written = names_in(scratch / "study");

  std::set<std::string> read;
  std::size_t scripts = 0;
  const std::filesystem::path plots =
      std::filesystem::path(WHEELRAIL_SOURCE_DIR) / "examples/plots";
  for (const auto& entry : std::filesystem::directory_iterator(plots)) {
    if (entry.path().extension() != ".gp") continue;
    ++scripts;
    const auto names = files_read_by(entry.path().string());
    CAPTURE(entry.path().string());
    CHECK(!names.empty());
    read.insert(names.begin(), names.end());
    // The report shows the picture of each script.
    CHECK_THAT(result.output, Contains(entry.path().stem().string() + ".png)"));
  }
  CHECK(scripts >= 5);
  CHECK(read.size() >= 8);
  for (const std::string& name : read) {
    CAPTURE(name);
    CHECK(std::find(written.begin(), written.end(), name) != written.end());
    CHECK(lines_of(read_text(scratch / ("study/" + name))).size() > 1);
  }
  int tables = 0;
  for (const std::string& name : written) {
    CHECK(!name.ends_with(".part"));
    CHECK(name[0] != '.');
    if (!name.ends_with(".csv")) continue;
    ++tables;
    check_rectangular(scratch / ("study/" + name));
  }
  CHECK(tables >= 10);

  const std::string report = read_text(scratch / "study/report.md");
  CHECK(report == result.output);
  Strings rows;
  for (const std::string& line : lines_of(report)) {
    if (line.starts_with("| ")) rows.push_back(line);
  }
  REQUIRE(rows.size() == 4);
  CHECK_THAT(rows[0], Contains("scenario") && Contains("hunting wavelength [m]"));
  CHECK(rows[1].starts_with("| convex, minimum distance |"));
  CHECK(rows[2].starts_with("| convex, strips |"));
  CHECK(rows[3].starts_with("| real, strips |"));
  for (const std::string& row : rows) {
    CHECK(std::count(row.begin(), row.end(), '|') ==
          std::count(rows[0].begin(), rows[0].end(), '|'));
  }
}

TEST_CASE("study: bad input is refused in one line and leaves nothing", "[examples][bad-input]") {
  const TemporaryDirectory scratch;
  for (const char* duration : {"0", "-1", "nan", "1e6", "long"}) {
    const auto result =
        run_program("study", {"--output", scratch / "study", "--duration", duration});
    CAPTURE(duration, result.exit_code, result.output, result.error);
    CHECK(refuses(result, "study"));
    CHECK_THAT(result.error, Contains("--duration"));
    CHECK(names_in(scratch.path()).empty());
  }
  write_text(scratch / "file", "kept");
  const auto result = run_program("study", {"--output", scratch / "file", "--duration", "0.01"});
  CHECK(refuses(result, "study"));
  CHECK(read_text(scratch / "file") == "kept");
}

TEST_CASE("study: --help says what there is, with units", "[examples]") {
  const auto result = run_program("study", {"--help"});
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Contains("--output") && Contains("--duration") && Contains("[s]"));
}
