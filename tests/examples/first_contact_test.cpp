// examples/first_contact is the README's program, and its output is what the README shows.

#include "../support/catch.hpp"
#include "run_program.hpp"

using namespace wheelrail_test;
using Catch::Matchers::ContainsSubstring;

TEST_CASE("first_contact: prints a patch of each wheel and the force", "[examples]") {
  const auto result = run_program("first_contact", {});
  CHECK(result.exit_code == 0);
  CHECK(result.error.empty());
  const Strings lines = lines_of(result.output);
  REQUIRE(lines.size() == 3);
  CHECK(lines[0].starts_with("left wheel, "));
  CHECK(lines[1].starts_with("right wheel, "));
  CHECK(lines[2].starts_with("on the wheelset: "));
  CHECK_THAT(result.output, !ContainsSubstring("nan"));
}

TEST_CASE("first_contact: program and output stand in the README verbatim", "[examples]") {
  const std::string root = WHEELRAIL_SOURCE_DIR;
  const std::string readme = read_text(root + "/README.md");
  const std::string source = read_text(root + "/examples/first_contact.cpp");
  const auto result = run_program("first_contact", {});
  CHECK(lines_of(source).size() <= 25);
  REQUIRE(source.ends_with("\n"));
  REQUIRE(result.output.ends_with("\n"));
  CHECK_THAT(readme, ContainsSubstring("```cpp\n" + source + "```\n"));
  CHECK_THAT(readme, ContainsSubstring("```text\n" + result.output + "```\n"));
  // The program comes first: a reader sees what this is before anything else.
  const Strings lines = lines_of(readme);
  const auto begin = std::find(lines.begin(), lines.end(), "```cpp");
  CHECK(begin - lines.begin() < 15);
}
