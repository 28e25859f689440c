// examples/hosts/simbody_wheelset against the embedded integrator: another implementation of rigid
// bodies and of Runge-Kutta steps. A moment or an angular velocity of the wrong sign, or in the
// wrong frame, takes them apart by millimetres.

#include "host_program.hpp"

using namespace wheelrail_test;
using Catch::Matchers::ContainsSubstring;

namespace {
const std::string program = "simbody_wheelset";
}

TEST_CASE("simbody_wheelset: within 1 um of the embedded integrator for 10 s", "[examples]") {
  const auto result = run_host(program, "accuracy", {});
  INFO(result.program.output);
  CHECK(result.program.exit_code == 0);
  CHECK_THAT(result.program.output, ContainsSubstring("within_bound: yes\n"));
  REQUIRE(result.rows.size() == 1);
  CHECK(result.rows[0].setting == 1e-9);
  CHECK(result.rows[0].bound == 1e-6);
  CHECK(result.rows[0].difference < 1e-9);  // 9e-12 when this was written
  check_differences(result, 10);
  check_hunting(result);
}

TEST_CASE("simbody_wheelset: a loose accuracy breaks the bound, and the program says so",
          "[examples]") {
  const auto result = run_host(program, "accuracy", {"--accuracy", "1e-3", "--duration", "5"});
  INFO(result.program.output);
  CHECK(result.program.exit_code == 3);
  CHECK_THAT(result.program.output, ContainsSubstring("within_bound: no\n"));
  REQUIRE(result.rows.size() == 1);
  CHECK(result.rows[0].difference > 1e-6);
  CHECK(result.rows[0].difference < 1e-3);
  check_differences(result, 5);
}

TEST_CASE("simbody_wheelset: --help says what there is, bad input is refused",
          "[examples][bad-input]") {
  const auto help = run_program("hosts/" + program, {"--help"});
  CHECK(help.exit_code == 0);
  for (const char* text :
       {"--duration", "--accuracy", "--embedded-tolerance", "--output", "within 1 um", "[s]"}) {
    CHECK_THAT(help.output, ContainsSubstring(text));
  }
  check_refused(program, {"--duration", "11"}, "--duration is 11");
  check_refused(program, {"--duration", "0.015"}, "must be a multiple of 0.01 s");
  check_refused(program, {"--accuracy", "0"}, "--accuracy is 0");
  check_refused(program, {"--embedded-tolerance", "nan"}, "--embedded-tolerance");
  check_refused(program, {"--step", "1e-4"}, "unknown option --step");
}
