#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "support/catch.hpp"

// The rules of the house, checked on the headers themselves: data flow one way, streams stay in
// io/, no header is long, each public one has its test.

namespace {

namespace fs = std::filesystem;

// What each layer may include besides itself.
const std::map<std::string, std::set<std::string>> may_include{
    {"core", {}},
    {"numerics", {"core"}},
    {"profile", {"core", "numerics"}},
    {"surface", {"core", "numerics", "profile"}},
    {"contact", {"core", "numerics", "profile", "surface"}},
    {"force", {"core", "numerics"}},
    {"track", {"core", "numerics", "profile", "surface"}},
    {"wheelset", {"core", "numerics", "profile", "surface", "contact", "force", "track"}},
    {"dynamics", {"core", "numerics"}},
    {"io", {"core", "numerics", "profile"}},
};
constexpr std::size_t maximum_lines = 600;
const std::set<std::string> stream_headers{"iostream", "fstream", "sstream", "ostream",
                                           "istream",  "iomanip", "ios"};

// What an #include line names, without its brackets or quotes; empty for any other line.
std::string included_by(std::string_view line) {
  const auto skip = [&line] {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  };
  skip();
  if (line.empty() || line.front() != '#') return {};
  line.remove_prefix(1);
  skip();
  if (!line.starts_with("include")) return {};
  line.remove_prefix(std::string_view("include").size());
  skip();
  if (line.empty()) return {};
  const bool quoted = line.front() == '"';
  line.remove_prefix(1);
  const std::string name(line.substr(0, line.find(quoted ? '"' : '>')));
  // A name in quotes is found beside the header: that escapes these rules.
  return quoted ? "\"" + name : name;
}

// The rule that an include breaks, or nothing. A layer is "" for headers outside the layers.
std::string broken_rule(const std::string& layer, const std::string& included) {
  if (included.empty()) return {};
  if (included.front() == '"') return "names what it includes from wheelrail/, in <>";
  if (stream_headers.contains(included)) {
    return layer == "io" ? std::string() : "leaves streams to io/";
  }
  const std::string root = "wheelrail/";
  if (!included.starts_with(root)) return {};
  const std::string path = included.substr(root.size());
  const auto slash = path.find('/');
  const std::string other = slash == std::string::npos ? "" : path.substr(0, slash);
  if (layer.empty()) {
    return other == "io" || other == "dynamics" ? "leaves io/ and dynamics/ to who asks for them"
                                                : "";
  }
  if (other == layer) return {};
  const auto rule = may_include.find(layer);
  if (rule == may_include.end()) return "lies in a layer of the table";
  return rule->second.contains(other) ? "" : "includes its own layer and those below it";
}

struct Header {
  fs::path path;  // from include/wheelrail
  std::string layer;
  std::vector<std::string> lines;
};

const fs::path source_directory = WHEELRAIL_SOURCE_DIR;

std::vector<Header> all_headers() {
  std::vector<Header> headers;
  const fs::path root = source_directory / "include" / "wheelrail";
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file()) continue;
    Header header;
    header.path = entry.path().lexically_relative(root);
    if (header.path.has_parent_path()) header.layer = header.path.begin()->string();
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) header.lines.push_back(line);
    headers.push_back(std::move(header));
  }
  return headers;
}

bool is_internal(const Header& header) {
  return std::any_of(header.path.begin(), header.path.end(),
                     [](const fs::path& part) { return part == "detail"; });
}

}  // namespace

TEST_CASE("include direction: the rules refuse what they are made for", "[core]") {
  CHECK(included_by("#include <wheelrail/core/scalar.hpp>") == "wheelrail/core/scalar.hpp");
  CHECK(included_by("  #  include   <vector>  // why") == "vector");
  CHECK(included_by("#include \"scalar.hpp\"") == "\"scalar.hpp");
  CHECK(included_by("// #include <vector>").empty());
  CHECK(included_by("#pragma once").empty());
  CHECK(included_by("").empty());

  CHECK(broken_rule("profile", "wheelrail/core/scalar.hpp").empty());
  CHECK(broken_rule("profile", "wheelrail/profile/s1002.hpp").empty());
  CHECK(broken_rule("profile", "vector").empty());
  CHECK(broken_rule("profile", "Eigen/Core").empty());
  CHECK(broken_rule("io", "fstream").empty());
  CHECK(broken_rule("", "wheelrail/contact/search.hpp").empty());

  CHECK_FALSE(broken_rule("core", "wheelrail/profile/s1002.hpp").empty());
  CHECK_FALSE(broken_rule("numerics", "wheelrail/profile/profile.hpp").empty());
  CHECK_FALSE(broken_rule("force", "wheelrail/contact/search.hpp").empty());
  CHECK_FALSE(broken_rule("dynamics", "wheelrail/track/track.hpp").empty());
  CHECK_FALSE(broken_rule("wheelset", "wheelrail/dynamics/body.hpp").empty());
  CHECK_FALSE(broken_rule("wheelset", "wheelrail/wheelrail.hpp").empty());
  CHECK_FALSE(broken_rule("contact", "iostream").empty());
  CHECK_FALSE(broken_rule("contact", "\"result.hpp").empty());
  CHECK_FALSE(broken_rule("attic", "wheelrail/core/scalar.hpp").empty());
  CHECK_FALSE(broken_rule("", "wheelrail/io/profile_file.hpp").empty());
}

TEST_CASE("include direction: no header includes what lies above it", "[core]") {
  const auto headers = all_headers();
  REQUIRE(headers.size() >= 14);
  int includes = 0;
  for (const Header& header : headers) {
    CHECK((header.layer.empty() || may_include.contains(header.layer)));
    for (const std::string& line : header.lines) {
      const std::string included = included_by(line);
      const std::string rule = broken_rule(header.layer, included);
      includes += included.empty() ? 0 : 1;
      if (rule.empty()) continue;
      FAIL_CHECK(header.path.string() << ": " << line << "\nA header here " << rule << ".");
    }
  }
  CHECK(includes > 30);
}

TEST_CASE("include direction: no header has more than 600 lines", "[core]") {
  for (const Header& header : all_headers()) {
    CAPTURE(header.path.string());
    CHECK(header.lines.size() <= maximum_lines);
  }
}

TEST_CASE("include direction: every public header of a layer has a test of its name", "[core]") {
  for (const Header& header : all_headers()) {
    if (header.layer.empty() || is_internal(header)) continue;
    const std::string name = header.path.stem().string() + "_test.cpp";
    const fs::path test = source_directory / "tests" / header.path.parent_path() / name;
    CAPTURE(header.path.string(), test.string());
    CHECK(fs::exists(test));
  }
}
