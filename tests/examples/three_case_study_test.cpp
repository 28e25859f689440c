// examples/three_case_study as examples/study.sh runs it, but shorter: every file that the plots read.

#include <set>

#include "../support/catch.hpp"
#include "run_program.hpp"
#include "support/progress.hpp"

using namespace wheelrail_test;
using Catch::Matchers::ContainsSubstring;

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

// Short runs of all nine, twice each.
Strings short_study(const std::string& output, const std::string& threads) {
  return {"--wheelset-duration", "0.12", "--bogie-duration", "0.06",  "--vehicle-duration", "0.04",
          "--repetitions",       "2",    "--threads",        threads, "--output",           output};
}

}  // namespace

TEST_CASE("three_case_study: writes all that the plots read and a report of three cases",
          "[examples]") {
  const TemporaryDirectory scratch;
  const auto result = run_program("three_case_study", short_study(scratch / "study", "1"));
  CAPTURE(result.error);
  REQUIRE(result.exit_code == 0);
  const Strings written = names_in(scratch / "study");

  std::set<std::string> read;
  std::size_t scripts = 0;
  const std::filesystem::path plots =
      std::filesystem::path(WHEELRAIL_SOURCE_DIR) / "examples/plots";
  for (const auto& entry : std::filesystem::directory_iterator(plots)) {
    const std::string file = entry.path().filename().string();
    if (!file.starts_with("fig") || !file.ends_with(".gp")) continue;
    ++scripts;
    const auto names = files_read_by(entry.path().string());
    CAPTURE(entry.path().string());
    CHECK(!names.empty());
    read.insert(names.begin(), names.end());
    // The report shows the picture of each script.
    CHECK_THAT(result.output, ContainsSubstring(entry.path().stem().string() + ".png)"));
  }
  CHECK(scripts == 10);
  CHECK(read.size() >= 12);
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
  CHECK(tables == 18 + 9);  // of nine runs, and of the figures

  const std::string report = read_text(scratch / "study/report.md");
  CHECK(report == result.output);
  CHECK_THAT(report, ContainsSubstring(
                         "Every repetition gave the same motion and forces to the last bit."));
  // Tables are rectangular: a row has as many fields as the one before it.
  std::size_t rows = 0;
  std::ptrdiff_t columns = 0;
  for (const std::string& line : lines_of(report)) {
    const auto count = std::count(line.begin(), line.end(), '|');
    if (!line.starts_with("|")) {
      columns = 0;
      continue;
    }
    CAPTURE(line);
    CHECK((columns == 0 || columns == count));
    columns = count;
    ++rows;
  }
  // Table 3, its times, wheelset, bogie and vehicle, each with two lines of a head.
  CHECK(rows == 3 + 9 + 3 + 3 + 2 + 5 * 2);
  CHECK_THAT(report, ContainsSubstring("| wheelset, tangent track | 1.00 | ") &&
                         ContainsSubstring("1.00, 2.39, 2.41"));
  CHECK_THAT(report, ContainsSubstring("| bogie, tangent track | 1.00 | ") &&
                         ContainsSubstring("1.00, 2.37, 2.40"));
  CHECK_THAT(report, ContainsSubstring("| vehicle, curve | 1.00 | ") &&
                         ContainsSubstring("1.00, 2.11, 2.21"));
}

TEST_CASE("three_case_study: any number of threads gives the same tables", "[examples]") {
  const TemporaryDirectory scratch;
  REQUIRE(run_program("three_case_study", short_study(scratch / "one", "1")).exit_code == 0);
  REQUIRE(run_program("three_case_study", short_study(scratch / "three", "3")).exit_code == 0);
  const Strings names = names_in(scratch / "one");
  CHECK(names == names_in(scratch / "three"));
  for (const std::string& name : names) {
    if (name == "report.md") continue;  // it has the times
    CAPTURE(name);
    CHECK(read_text(scratch / ("one/" + name)) == read_text(scratch / ("three/" + name)));
  }
}

TEST_CASE("three_case_study: a log shows how far it is and what is left", "[examples]") {
  CHECK(examples::progress_text(0, 0.1) == "[....................]   0 %");
  CHECK(examples::progress_text(0.25, 30) == "[#####...............]  25 %, 1 min 30 s left");
  CHECK(examples::progress_text(1, 61.2) == "[####################] 100 %, 1 min 01 s in all");
  // On a terminal it stays within one line, whatever the name, and leaves nothing of the last one.
  CHECK(examples::bar_text("short") == "\rshort\033[K");
  CHECK(examples::bar_text(std::string(200, 'x')) ==
        std::string("\r").append(79, 'x').append("\033[K"));
  const TemporaryDirectory scratch;
  const auto result = run_program("three_case_study", short_study(scratch / "study", "2"));
  const Strings lines = lines_of(result.error);
  CHECK(lines.size() >= 3);
  CHECK(lines.size() <= 11);
  REQUIRE(!lines.empty());
  CHECK_THAT(lines.back(), ContainsSubstring("100 %") && ContainsSubstring(" in all"));
}

TEST_CASE("three_case_study: bad input is refused in one line and leaves nothing",
          "[examples][bad-input]") {
  const TemporaryDirectory scratch;
  const std::vector<Strings> bad{
      {"--wheelset-duration", "0"},  {"--bogie-duration", "-1"},   {"--vehicle-duration", "nan"},
      {"--vehicle-duration", "1e6"}, {"--vehicle-duration", "60"}, {"--repetitions", "0"},
      {"--repetitions", "1.5"},      {"--threads", "many"},        {"--threads", "1e9"}};
  for (const Strings& arguments : bad) {
    Strings all = arguments;
    all.insert(all.end(), {"--output", scratch / "study"});
    const auto result = run_program("three_case_study", all);
    CAPTURE(arguments, result.exit_code, result.output, result.error);
    CHECK(refuses(result, "three_case_study"));
    CHECK_THAT(result.error, ContainsSubstring(arguments[0]));
    CHECK(names_in(scratch.path()).empty());
  }
  write_text(scratch / "file", "kept");
  const auto result = run_program("three_case_study", {"--output", scratch / "file"});
  CHECK(refuses(result, "three_case_study"));
  CHECK(read_text(scratch / "file") == "kept");
}

TEST_CASE("three_case_study: --help says what there is, with units", "[examples]") {
  const auto result = run_program("three_case_study", {"--help"});
  CHECK(result.exit_code == 0);
  for (const char* option : {"--output", "--wheelset-duration", "--bogie-duration",
                             "--vehicle-duration", "--repetitions", "--threads", "[s]"}) {
    CHECK_THAT(result.output, ContainsSubstring(option));
  }
}
