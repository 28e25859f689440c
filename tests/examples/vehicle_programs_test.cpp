// bogie_on_tangent_track and vehicle_on_curved_track as a user meets them.

#include "../support/catch.hpp"
#include "run_program.hpp"

using namespace wheelrail_test;
using Catch::Matchers::ContainsSubstring;

TEST_CASE("vehicle programs: --help has the options with their units", "[examples]") {
  for (const char* program : {"bogie_on_tangent_track", "vehicle_on_curved_track"}) {
    const auto result = run_program(program, {"--help"});
    CAPTURE(program);
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.output, ContainsSubstring("--vehicle") && ContainsSubstring("[m/s]") &&
                                  ContainsSubstring("[s]"));
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
      CHECK_THAT(result.output, ContainsSubstring(key));
    }
    const std::string series = read_text(scratch.path() / "run" / "time_series.csv");
    CHECK(series.starts_with("time,arc_length,wheelset1_lateral_shift,wheelset1_yaw"));
    // Reports every 1 ms on the tangent, every 5 ms in the curve, and a header.
    const bool is_bogie = std::string(program) == "bogie_on_tangent_track";
    CHECK(std::count(series.begin(), series.end(), '\n') == (is_bogie ? 52 : 12));
    CHECK(read_text(scratch.path() / "run" / "patches.csv").starts_with("time,side,patch,"));
    CHECK(read_text(scratch.path() / "run" / "summary.txt") == result.output);
  }
}

TEST_CASE("vehicle programs: the summary begins with the vehicle and what its data leave out",
          "[examples]") {
  const std::string vehicles = std::string(WHEELRAIL_SOURCE_DIR) + "/examples/vehicles/";
  const auto head = [](const char* program, Strings arguments) {
    arguments.insert(arguments.end(), {"--duration", "0.01"});
    const Strings lines = lines_of(run_program(program, arguments).output);
    REQUIRE(lines.size() > 2);
    return lines[0] + "\n" + lines[1];
  };
  const std::string manchester = vehicles + "manchester_vehicle1.csv";
  TemporaryDirectory scratch;
  write_text(scratch.path() / "one.csv", read_text(vehicles + "metro_trailer.csv") +
                                             "traction rod stiffness,1000,N/m,unconfirmed\n");
  for (const char* program : {"bogie_on_tangent_track", "vehicle_on_curved_track"}) {
    CAPTURE(program);
    CHECK(head(program, {}) == "vehicle: " + vehicles + "metro_trailer.csv\nwheel: s1002");
    CHECK(head(program, {"--vehicle", manchester}) ==
          "vehicle: " + manchester + "\nleft_out: 6 unconfirmed quantities");
    CHECK(head(program, {"--vehicle", manchester, "--unconfirmed", "yes"}) ==
          "vehicle: " + manchester + "\nwheel: s1002");
    CHECK_THAT(head(program, {"--vehicle", scratch / "one.csv"}),
               ContainsSubstring("left_out: 1 unconfirmed quantity"));
  }
}

TEST_CASE("vehicle programs: bad input is one line and exit code 2", "[examples][bad-input]") {
  TemporaryDirectory scratch;
  const auto refused = [&](const char* program, Strings arguments, const char* why) {
    arguments.insert(arguments.end(), {"--output", scratch / "run"});
    const auto result = run_program(program, arguments);
    CAPTURE(program, why, result.error);
    CHECK(result.exit_code == 2);
    CHECK(result.output.empty());
    CHECK(std::count(result.error.begin(), result.error.end(), '\n') == 1);
    CHECK_THAT(result.error, ContainsSubstring(why));
    CHECK_FALSE(std::filesystem::exists(scratch / "run"));
  };
  write_text(scratch.path() / "short.csv", "quantity,value,unit\nwheel radius,0.43,m\n");
  write_text(scratch.path() / "negative.csv",
             "quantity,value,unit\nwheel radius,0.43,m\nbogie wheelbase,-2.1,m\n");
  // A vehicle's file with one row changed.
  const auto changed = [&](const char* file, const std::string& row, const std::string& to) {
    std::string text = read_text(std::string(WHEELRAIL_SOURCE_DIR) + "/examples/vehicles/" + file);
    REQUIRE(text.find("\n" + row) != std::string::npos);
    write_text(scratch.path() / "changed.csv", text.replace(text.find(row), row.size(), to));
    return scratch / "changed.csv";
  };
  for (const char* program : {"bogie_on_tangent_track", "vehicle_on_curved_track"}) {
    const auto refused_row = [&](const char* row, const char* to, const char* why) {
      refused(program, {"--vehicle", changed("manchester_vehicle1.csv", row, to)}, why);
    };
    refused_row("carbody mass,32000,kg,", "carbody mass,32,t,",
                "changed.csv:6: 'carbody mass': unit is 't', but must be 'kg'");
    refused_row("wheel radius,0.46,m,", "wheel radius,460,mm,",
                "'wheel radius': unit is 'mm', but must be 'm'");
    refused_row("anti-roll bar", "anti roll bar",
                "'anti roll bar stiffness per bogie' is no quantity of a vehicle");
    refused(program, {"--vehicle", scratch.path().string()}, "is not a readable file");
    const std::string light =
        changed("metro_trailer.csv", "wheelset mass,1000,", "wheelset mass,-1000,");
    refused(program, {"--duration", "0"}, "--duration is 0");
    refused(program, {"--speed", "-1"}, "--speed is -1");
    refused(program, {"--wheel", "round"}, "--wheel is 'round'");
    refused(program, {"--vehicle", scratch / "none.csv"}, "cannot open");
    refused(program, {"--vehicle", scratch / "short.csv"}, "lacks the quantity");
    refused(program, {"--gauge", "1.3"}, "the wheelset does not fit");
    refused(program, {"--gauge", "0.001", "--inclination", "0"}, "or the rails overlap");
    refused(program, {"--vehicle", light}, "'wheelset mass' is -1000");
    refused(program, {"--lateral-shift", "0.007"}, "--lateral-shift is 0.007");
  }
  refused("bogie_on_tangent_track", {"--vehicle", scratch / "negative.csv"},
          "'bogie wheelbase' is -2.1");
  // The table falls from 600 N to 500 N.
  refused("vehicle_on_curved_track",
          {"--vehicle", changed("manchester_vehicle1.csv", "lateral bump stop force at 35 mm,1760,",
                                "lateral bump stop force at 35 mm,500,")},
          "lateral bump stop force[2].force is 500, but must be >= lateral bump stop force[1]");
  refused("vehicle_on_curved_track", {"--duration", "60"}, "the track is 824");
  refused("vehicle_on_curved_track", {"--approach", "17"}, "start on straight and level track");
  refused("vehicle_on_curved_track", {"--radius", "0"}, "--radius is 0");
  refused("vehicle_on_curved_track", {"--transition", "nan"}, "--transition is 'nan'");
}

TEST_CASE("vehicle programs: a derailment ends the run and what was computed is kept",
          "[examples]") {
  TemporaryDirectory scratch;
  const auto result =
      run_program("vehicle_on_curved_track",
                  {"--speed", "60", "--radius", "100", "--approach", "20", "--transition", "30",
                   "--cant", "0", "--duration", "5", "--output", scratch / "run"});
  CAPTURE(result.output, result.error);
  CHECK(result.exit_code == 3);
  CHECK(std::count(result.error.begin(), result.error.end(), '\n') == 1);
  CHECK_THAT(
      result.error,
      ContainsSubstring("vehicle_on_curved_track: the front leading wheelset's left wheel left its "
                        "rail at 0.") &&
          ContainsSubstring(" m along the track"));
  CHECK_THAT(result.output,
             ContainsSubstring("derailment: the front leading wheelset's left wheel"));
  CHECK(read_text(scratch.path() / "run" / "summary.txt") == result.output);
  const Strings rows = lines_of(read_text(scratch.path() / "run" / "time_series.csv"));
  REQUIRE(rows.size() > 40);  // a header and at least 0.2 s
  // The last row is the instant at which the wheel was seen off its rail.
  const std::string time = fields_of(rows.back()).front();
  CHECK_THAT(result.output, ContainsSubstring("simulated_s: " + time + "\n"));
  CHECK(read_text(scratch.path() / "run" / "patches.csv").size() > 1000);
}
