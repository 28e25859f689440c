// examples/hosts/dart_wheelset against the embedded integrator: another implementation of rigid
// bodies, with steps of first order.

#include "host_program.hpp"

using namespace wheelrail_test;
using Catch::Matchers::ContainsSubstring;

namespace {
const std::string program = "dart_wheelset";
}

TEST_CASE("dart_wheelset: converges to the embedded integrator with the step, for 10 s",
          "[examples]") {
  const auto result = run_host(program, "step", {});
  INFO(result.program.output);
  CHECK(result.program.exit_code == 0);
  CHECK_THAT(result.program.output, ContainsSubstring("within_bound: yes\n"));
  REQUIRE(result.rows.size() == 3);
  double step = 1e-4;
  for (std::size_t k = 0; k < 3; ++k, step /= 2) {
    CAPTURE(k);
    CHECK(result.rows[k].setting == Approx(step));
    CHECK(result.rows[k].bound == Approx(0.02 * step));
    CHECK(result.rows[k].difference > 0.01 * step);  // no better than its order
    if (k == 0) continue;
    // First order: half the step, half the difference; and what is left without it.
    CHECK(std::abs(result.rows[k].ratio - 2) < 0.05);
    CHECK(result.rows[k].extrapolated < 1e-7);
  }
  check_differences(result, 10);
  check_hunting(result);
}

TEST_CASE("dart_wheelset: other steps are within the bound too", "[examples]") {
  const auto result = run_host(program, "step", {"--step", "4e-4", "--duration", "2"});
  INFO(result.program.output);
  CHECK(result.program.exit_code == 0);
  REQUIRE(result.rows.size() == 3);
  CHECK(result.rows[0].setting == Approx(4e-4));
  CHECK(result.rows[2].setting == Approx(1e-4));
  check_differences(result, 2);
}

TEST_CASE("dart_wheelset: --help says what there is, bad input is refused",
          "[examples][bad-input]") {
  const auto help = run_program("hosts/" + program, {"--help"});
  CHECK(help.exit_code == 0);
  for (const char* text : {"--duration", "--step", "--embedded-tolerance", "--output",
                           "0.02 m/s times the step", "[s]"}) {
    CHECK_THAT(help.output, ContainsSubstring(text));
  }
  check_refused(program, {"--duration", "11"}, "--duration is 11");
  check_refused(program, {"--step", "3e-4"}, "--step is 3e-4, but must go into 0.01 s");
  check_refused(program, {"--step", "1e-3"},
                "--step is 1e-3, but must be between 5e-05 and 0.0004");
  check_refused(program, {"--step", "-1e-4"}, "--step");
  check_refused(program, {"--accuracy", "1e-4"}, "unknown option --accuracy");
}
