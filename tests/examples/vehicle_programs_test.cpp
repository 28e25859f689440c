// bogie_on_tangent_track and vehicle_on_curved_track as a user meets them.

#include "../support/catch.hpp"
#include "run_program.hpp"

using namespace wheelrail_test;
using Catch::Matchers::Contains;

TEST_CASE("vehicle programs: --help has the options with their units", "[examples]") {
  for (const char* program : {"bogie_on_tangent_track", "vehicle_on_curved_track"}) {
    const auto result = run_program(program, {"--help"});
    CAPTURE(program);
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.output, Contains("--vehicle") && Contains("[m/s]") && Contains("[s]"));
  }
}

TEST_CASE("vehicle programs: a short run writes its tables and its summary", "[examples]") {
  for (const char* program : {"bogie_on_tangent_track", "vehicle_on_curved_track"}) {
    CAPTURE(program);
    TemporaryDirectory scratch;
    const auto result = run_program(program, {"--duration", "0.05", "--output", scratch / "run"});
    CAPTURE(result.error);
    REQUIRE(result.exit_code == 0);
    CHECK(result.error.empty());
    for (const char* key : {"status: finished", "steps: ", "contact_searches: ",
                            "constraint_violation: ", "seconds: ", "real_time_factor: "}) {
      CHECK_THAT(result.output, Contains(key));
    }
    const std::string series = read_text(scratch.path() / "run" / "time_series.csv");
    CHECK(series.starts_with("time,arc_length,wheelset1_lateral_shift,wheelset1_yaw"));
    CHECK(std::count(series.begin(), series.end(), '\n') == 52);
    CHECK(read_text(scratch.path() / "run" / "patches.csv").starts_with("time,side,patch,"));
    CHECK(read_text(scratch.path() / "run" / "summary.txt") == result.output);
  }
}

TEST_CASE("vehicle programs: bad input is one line and exit code 2", "[examples][bad-input]") {
  const auto refused = [](const char* program, const Strings& arguments, const char* why) {
    const auto result = run_program(program, arguments);
    CAPTURE(program, why, result.error);
    CHECK(result.exit_code == 2);
    CHECK(result.output.empty());
    CHECK(std::count(result.error.begin(), result.error.end(), '\n') == 1);
    CHECK_THAT(result.error, Contains(why));
  };
  TemporaryDirectory scratch;
  write_text(scratch.path() / "short.csv", "quantity,value,unit\nwheel radius,0.43,m\n");
  write_text(scratch.path() / "negative.csv",
             "quantity,value,unit\nwheel radius,0.43,m\nbogie wheelbase,-2.1,m\n");
  for (const char* program : {"bogie_on_tangent_track", "vehicle_on_curved_track"}) {
    refused(program, {"--duration", "0"}, "--duration is 0");
    refused(program, {"--speed", "-1"}, "--speed is -1");
    refused(program, {"--wheel", "round"}, "--wheel is 'round'");
    refused(program, {"--vehicle", scratch / "none.csv"}, "cannot open");
    refused(program, {"--vehicle", scratch / "short.csv"}, "lacks the quantity");
    refused(program, {"--gauge", "1.3"}, "gauge");
  }
  refused("bogie_on_tangent_track", {"--vehicle", scratch / "negative.csv"},
          "'bogie wheelbase' is -2.1");
  refused("vehicle_on_curved_track", {"--duration", "60"}, "the track is 824");
  refused("vehicle_on_curved_track", {"--radius", "0"}, "--radius is 0");
  refused("vehicle_on_curved_track", {"--transition", "nan"}, "--transition is 'nan'");
}
