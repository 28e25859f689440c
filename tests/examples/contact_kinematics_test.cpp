// examples/contact_kinematics as a user runs it: its tables against known conicities, with profiles
// by name and from files, and what it says to bad input.

#include <cmath>
#include <random>
#include <wheelrail/wheelrail.hpp>

#include "../io/sample_profiles.hpp"
#include "../support/catch.hpp"
#include "../wheelset/en15302_profiles.hpp"
#include "run_program.hpp"

using namespace wheelrail;
using namespace wheelrail_test;
using Catch::Matchers::ContainsSubstring;

namespace {

const std::string program = "contact_kinematics";
const std::string rolling_header = "lateral_shift_mm,rolling_radius_difference_mm";
const std::string contact_header =
    "lateral_shift_mm,side,contact,wheel_lateral_mm,rail_lateral_mm,rolling_radius_mm,"
    "contact_angle_rad,gap_um,roll_rad,axle_height_mm,status";
const std::string conicity_header = "amplitude_mm,conicity";

// The pictures are drawn in one test only: they take longer than all the rest.
ProgramResult run_without_gnuplot(Strings arguments) {
  const char* path = std::getenv("PATH");
  const std::string old = path == nullptr ? "" : path;
  setenv("PATH", "/nowhere", 1);
  const auto result = run_program(program, arguments);
  setenv("PATH", old.c_str(), 1);
  return result;
}

// The two columns of a table; NaN where the second field is empty.
struct Table {
  std::vector<double> x, y;

  [[nodiscard]] double at(double where) const {
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (std::abs(x[i] - where) < 1e-6) return y[i];
    }
    FAIL("there is no row " << where);
    return 0;
  }
};

Table read_table(const std::string& path, const std::string& header) {
  const Strings lines = lines_of(read_text(path));
  REQUIRE(!lines.empty());
  REQUIRE(lines[0] == header);
  Table table;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const Strings fields = fields_of(lines[i]);
    REQUIRE(fields.size() == 2);
    table.x.push_back(std::stod(fields[0]));
    table.y.push_back(fields[1].empty() ? std::nan("") : std::stod(fields[1]));
  }
  return table;
}

struct Output {
  Table rolling, conicity;
  Strings contacts;
  std::string text;
};

// What a run writes that must be good.
Output output_of(Strings arguments) {
  const TemporaryDirectory scratch;
  arguments.insert(arguments.end(), {"--output", scratch / "run"});
  const auto result = run_without_gnuplot(arguments);
  INFO(result.error);
  REQUIRE(result.exit_code == 0);
  REQUIRE(result.error.empty());
  CHECK(names_in(scratch / "run") == Strings{"conicity.csv", "contact_lines.dat",
                                             "contact_points.csv",
                                             "rolling_radius_difference.csv"});
  return {read_table(scratch / "run/rolling_radius_difference.csv", rolling_header),
          read_table(scratch / "run/conicity.csv", conicity_header),
          lines_of(read_text(scratch / "run/contact_points.csv")), result.output};
}

void check_refused(const Strings& arguments, const Strings& words) {
  const TemporaryDirectory scratch;
  Strings all = arguments;
  if (std::find(all.begin(), all.end(), "--output") == all.end()) {
    all.insert(all.end(), {"--output", scratch / "run"});
  }
  const auto result = run_without_gnuplot(all);
  CAPTURE(arguments, result.exit_code, result.output, result.error);
  CHECK(refuses(result, program));
  for (const std::string& word : words) CHECK_THAT(result.error, ContainsSubstring(word));
  CHECK(names_in(scratch.path()).empty());
}

ProfilePoints<double> points_of(const en15302::Points& points) {
  ProfilePoints<double> of;
  for (const double value : points.values) {
    of.lateral.push_back((points.first + static_cast<double>(of.size()) * points.step) * 1e-3);
    of.value.push_back(value * 1e-3);
  }
  return of;
}

}  // namespace

TEST_CASE("contact_kinematics: --help says what there is, with units and signs", "[examples]") {
  const auto result = run_program(program, {"--help"});
  CHECK(result.exit_code == 0);
  CHECK(result.error.empty());
  for (const char* word : {"--wheel ",
                           "--right-wheel",
                           "--rail ",
                           "--right-rail",
                           "--nominal-radius",
                           "--right-nominal-radius",
                           "--profile-spacing",
                           "--gauge",
                           "--inclination",
                           "--track-profile",
                           "--no-roll",
                           "--lateral-shift",
                           "--noise",
                           "--repair",
                           "--output",
                           "[mm]",
                           "[m]",
                           "[um]",
                           "EN 15302",
                           "left less right",
                           "14 mm below",
                           "default 1.435)"}) {
    CHECK_THAT(result.output, ContainsSubstring(word));
  }
}

TEST_CASE("contact_kinematics: S1002 on 60E1 1:40 gives the known conicities",
          "[examples][reference]") {
  const Output output = output_of({});
  CHECK(output.conicity.at(2) == Approx(0.2213).margin(1e-4));
  CHECK(output.conicity.at(3) == Approx(0.1771).margin(1e-4));
  CHECK_THAT(output.text, ContainsSubstring("amplitude 2 mm: 0.2213"));
  CHECK_THAT(output.text, ContainsSubstring("-8 to 8 mm: touching"));
  CHECK_THAT(output.text, !ContainsSubstring("no conicity"));

  REQUIRE(output.conicity.x.size() == 61);
  CHECK(output.conicity.x.front() == 1);
  CHECK(output.conicity.x.back() == 7);
  REQUIRE(output.rolling.x.size() == 161);
  for (std::size_t i = 0; i < 161; ++i) {
    CHECK(output.rolling.x[i] == Approx(-8 + 0.1 * static_cast<double>(i)).margin(1e-9));
    CHECK(output.rolling.y[i] == Approx(-output.rolling.y[160 - i]).margin(2e-6));
  }
  CHECK(output.rolling.at(2) > 0);  // to the left, the left wheel runs on more
}

TEST_CASE("contact_kinematics: contact points belong to the differences", "[examples]") {
  const Output output = output_of({"--lateral-shift", "-7:0.5:7"});
  REQUIRE(!output.contacts.empty());
  CHECK(output.contacts[0] == contact_header);
  std::size_t first_contacts = 0;
  double left = 0;
  for (std::size_t i = 1; i < output.contacts.size(); ++i) {
    const Strings fields = fields_of(output.contacts[i]);
    REQUIRE(fields.size() == 11);
    CHECK(fields[10] == "touching");
    CHECK(std::abs(std::stod(fields[7])) <= 1.001);  // of the gap [um]
    const double lateral = std::stod(fields[3]), radius = std::stod(fields[5]);
    CHECK(radius ==
          Approx(460 + 1e3 * s1002<double>().evaluate(1e-3 * lateral).value).epsilon(1e-8));
    if (fields[2] != "0") continue;
    ++first_contacts;
    if (fields[1] == "left") {
      left = radius;
    } else {
      CHECK(output.rolling.at(std::stod(fields[0])) == Approx(left - radius).margin(1e-6));
    }
  }
  CHECK(first_contacts == 2 * 29);
}

TEST_CASE("contact_kinematics: an odd number of steps has its own shifts", "[examples]") {
  const Output output = output_of({"--lateral-shift", "-4:0.6:5"});
  REQUIRE(output.rolling.x.size() == 16);
  CHECK(output.rolling.x[7] == Approx(0.2));
  const Output fine = output_of({"--lateral-shift", "-8:0.2:8"});
  CHECK(output.rolling.at(0.8) == Approx(fine.rolling.at(0.8)).margin(1e-6));
  CHECK(output.rolling.at(-2.2) == Approx(fine.rolling.at(-2.2)).margin(1e-6));
  // Not as far as these amplitudes: said, and empty.
  CHECK(std::isnan(output.conicity.at(5)));
  CHECK(output.conicity.at(3) == Approx(0.1771).epsilon(0.03));
  CHECK_THAT(output.text, ContainsSubstring("no conicity at "));
  CHECK_THAT(output.text, ContainsSubstring("to 7 mm: out_of_range"));
}

TEST_CASE("contact_kinematics: sampled profiles give nearly what the profiles give",
          "[examples][reference]") {
  const TemporaryDirectory files;
  ProfileWriteOptions simpack;
  simpack.format = ProfileFormat::simpack;
  simpack.unit = LengthUnit::millimetre;
  write_profile(files / "wheel.prw", wheel_points(1000), ProfileKind::wheel, simpack);
  write_profile(files / "rail.csv", rail_points(1000), ProfileKind::rail);
  const Output named = output_of({});
  struct Noise {
    const char* level;
    double tolerance;
  };
  for (const Noise& noise : {Noise{"0", 0.01}, Noise{"1", 0.03}}) {
    CAPTURE(noise.level);
    const Output read = output_of(
        {"--wheel", files / "wheel.prw", "--rail", files / "rail.csv", "--noise", noise.level});
    for (const double amplitude : {2.0, 3.0, 4.0}) {
      CAPTURE(amplitude);
      CHECK(read.conicity.at(amplitude) ==
            Approx(named.conicity.at(amplitude)).epsilon(noise.tolerance));
    }
    CHECK_THAT(read.text, ContainsSubstring("SIMPACK, 1001 points"));
    CHECK_THAT(read.text, ContainsSubstring("unit: mm (stated in the file)"));
    CHECK_THAT(read.text, ContainsSubstring("value grows out of the body (detected)"));
    CHECK_THAT(read.text, ContainsSubstring("turned round"));
    CHECK_THAT(read.text, ContainsSubstring("table, 1001 points"));
  }
}

TEST_CASE("contact_kinematics: EN 15302 from files, rails laid by their origin, no roll",
          "[examples][reference]") {
  const TemporaryDirectory files;
  write_profile(files / "a.prr", points_of(en15302::rail_a), ProfileKind::rail,
                {.format = ProfileFormat::simpack});
  const char* names[] = {"a.csv", "b.csv"};
  const Strings track{"--rail", files / "a.prr", "--track-profile", "--no-roll"};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& of = en15302::cases[k];
    write_profile(files / names[k], points_of(*of.wheel), ProfileKind::wheel);
    Strings arguments{"--wheel", files / names[k]};
    arguments.insert(arguments.end(), track.begin(), track.end());
    const Output output = output_of(arguments);
    int compared = 0;
    for (const auto& row : of.conicity) {
      if (row.amplitude < 0.99 || 7.01 < row.amplitude) continue;
      CAPTURE(of.name, row.amplitude, row.reference);
      const double conicity = output.conicity.at(row.amplitude);
      CHECK(conicity >= row.lower);
      CHECK(conicity <= row.upper);
      ++compared;
    }
    CHECK(compared >= 55);
    CHECK_THAT(output.text, ContainsSubstring("laid by its origin: +0.0974 mm"));
  }
  // Other wheels on the right: mirrored, the difference is the same with both signs turned.
  Strings one{"--wheel",       files / "a.csv",          "--right-wheel",
              files / "b.csv", "--right-nominal-radius", "0.4601"};
  Strings other{"--wheel",          files / "b.csv", "--right-wheel",          files / "a.csv",
                "--nominal-radius", "0.4601",        "--right-nominal-radius", "0.46"};
  one.insert(one.end(), track.begin(), track.end());
  other.insert(other.end(), track.begin(), track.end());
  const Output as_is = output_of(one), mirrored = output_of(other);
  for (const double shift : {-6.0, -2.5, 0.0, 1.5, 4.0, 7.0}) {
    CAPTURE(shift);
    CHECK(as_is.rolling.at(shift) == Approx(-mirrored.rolling.at(-shift)).margin(1e-5));
  }
  CHECK(std::abs(as_is.rolling.at(0)) > 0.05);
  CHECK_THAT(as_is.text, ContainsSubstring("right wheel: "));
  CHECK_THAT(as_is.text, ContainsSubstring("nominal radius 460.1 mm"));
}

TEST_CASE("contact_kinematics: a rail of its own on the right", "[examples]") {
  const Output one = output_of({"--right-rail", "uic50", "--lateral-shift", "-5:0.5:5"});
  const Output other =
      output_of({"--rail", "uic50", "--right-rail", "60e1", "--lateral-shift", "-5:0.5:5"});
  const Output equal = output_of({"--lateral-shift", "-5:0.5:5"});
  for (const double shift : {-4.0, -1.0, 0.0, 2.0}) {
    CHECK(one.rolling.at(shift) == Approx(-other.rolling.at(-shift)).margin(1e-5));
  }
  CHECK(std::abs(one.rolling.at(2) - equal.rolling.at(2)) > 1e-3);
  CHECK_THAT(one.text, ContainsSubstring("right rail: uic50"));
}

TEST_CASE("contact_kinematics: bad points are refused, or dropped and listed",
          "[examples][bad-input]") {
  const TemporaryDirectory files;
  auto points = wheel_points(500);
  points.value[300] += 2e-3;
  write_profile(files / "spike.csv", points, ProfileKind::wheel);
  check_refused({"--wheel", files / "spike.csv"},
                {"--wheel: ", "spike.csv", "point 300", "spike", "--repair"});
  const Output repaired = output_of(
      {"--wheel", files / "spike.csv", "--repair", "--noise", "0", "--lateral-shift", "-5:0.1:5"});
  CHECK_THAT(repaired.text, ContainsSubstring("repaired: 1 of 501 points dropped, 500 kept"));
  CHECK_THAT(repaired.text, ContainsSubstring("point 300"));
  CHECK(repaired.conicity.at(2) == Approx(0.2213).epsilon(0.02));
}

TEST_CASE("contact_kinematics: noise is smoothed; without smoothing the failure is said",
          "[examples][random]") {
  const TemporaryDirectory files;
  std::mt19937 generator(7);
  std::normal_distribution<double> noise(0.0, 1e-5);
  auto wheel = wheel_points(1000), rail = rail_points(1000);
  for (double& value : wheel.value) value += noise(generator);
  for (double& value : rail.value) value += noise(generator);
  write_profile(files / "wheel.whl", wheel, ProfileKind::wheel,
                {.format = ProfileFormat::miniprof});
  write_profile(files / "rail.ban", rail, ProfileKind::rail, {.format = ProfileFormat::miniprof});
  const Strings names{"--wheel", files / "wheel.whl", "--rail", files / "rail.ban"};
  const Output smoothed = output_of(names);
  for (const auto& [amplitude, conicity] : {std::pair(2.0, 0.2213), std::pair(3.0, 0.1771)}) {
    CHECK(smoothed.conicity.at(amplitude) == Approx(conicity).epsilon(0.03));
  }
  CHECK_THAT(smoothed.text, ContainsSubstring("MiniProf, 1001 points"));
  CHECK_THAT(smoothed.text, ContainsSubstring("smoothed: noise level "));

  // A rail of a thousand waves has more contacts than a search returns.
  const TemporaryDirectory scratch;
  Strings rough = names;
  rough.insert(rough.end(),
               {"--noise", "0", "--lateral-shift", "-2:1:2", "--output", scratch / "run"});
  const auto result = run_without_gnuplot(rough);
  CHECK(result.exit_code == 3);
  CHECK(result.output.empty());
  CHECK_THAT(result.error, ContainsSubstring("contact_kinematics: lateral shift "));
  CHECK_THAT(result.error, ContainsSubstring("wheel: not_converged"));
  CHECK_THAT(result.error, ContainsSubstring("concave zones"));
  CHECK(names_in(scratch.path()).empty());
}

TEST_CASE("contact_kinematics: where the wheelset does not touch there is no value, said so",
          "[examples]") {
  const TemporaryDirectory files;
  // A wheel whose tread ends early.
  write_profile(files / "short.csv", sampled(s1002<double>(), -0.0695, 0.012, 600),
                ProfileKind::wheel);
  const Output output = output_of({"--wheel", files / "short.csv", "--noise", "0", "--no-roll"});
  CHECK(std::isnan(output.rolling.at(-8)));
  CHECK(std::isnan(output.rolling.at(8)));
  CHECK(!std::isnan(output.rolling.at(0)));
  CHECK(std::isnan(output.conicity.at(7)));
  CHECK_THAT(output.text, ContainsSubstring("profile_end"));
  CHECK_THAT(output.text, ContainsSubstring("to 7 mm: out_of_range"));
  bool has_status = false, has_other = false;
  for (const std::string& line : output.contacts) {
    has_status = has_status || line.ends_with(",left,,,,,,,,,profile_end");
    has_other = has_other || line.ends_with(",right,,,,,,,,,other_wheel_profile_end");
  }
  CHECK(has_status);
  CHECK(has_other);
}

TEST_CASE("contact_kinematics: bad input names option, value and rule, and writes nothing",
          "[examples][bad-input]") {
  const TemporaryDirectory files;
  write_text(files / "bad.csv", "1,2\n2,3\n");
  check_refused({"--wheel", files / "none.csv"},
                {"--wheel is ", "none.csv", "a file that is there"});
  check_refused({"--wheel", "s1003"}, {"--wheel is 's1003'", "s1002, s1002-convex"});
  check_refused({"--right-rail", "54e1"}, {"--right-rail is '54e1'", "uic50, 60e1"});
  check_refused({"--rail", files / "bad.csv"}, {"--rail: ", "bad.csv", "at least 4"});
  check_refused({"--rail", files.path().string()}, {"--rail: ", "regular"});
  for (const char* range : {"1", "1:2", "a:1:2", "-8:0.1:8:1", "-8:nan:8", "-8:0.1:8x", ""}) {
    check_refused({"--lateral-shift", range}, {"--lateral-shift is", "FROM:STEP:TO"});
  }
  check_refused({"--lateral-shift", "-8:0:8"}, {"STEP must be > 0"});
  check_refused({"--lateral-shift", "-8:0.3:8"}, {"whole number of STEPs"});
  check_refused({"--lateral-shift", "-8:0.0001:8"}, {"at most 10000"});
  check_refused({"--lateral-shift", "-200:1:8"}, {"between -100 and 100"});
  check_refused({"--lateral-shift", "2:0.1:8"}, {"FROM must be <= -1 mm", "amplitude"});
  check_refused({"--lateral-shift", "-0.5:0.1:0.5"}, {"FROM must be <= -1 mm", "amplitude"});
  check_refused({"--noise", "-1"}, {"--noise is -1", "between 0 and 1000"});
  check_refused({"--repair=maybe"}, {"--repair takes no value"});
  check_refused({"--gauge", "0"}, {"--gauge is 0", "> 0"});
  check_refused({"--gauge", "1.3"}, {"gauge", "does not fit"});
  check_refused({"--nominal-radius", "x"}, {"--nominal-radius is 'x'"});
  check_refused({"--track-profile", "--inclination", "0.025"}, {"--inclination is 0.025"});
  check_refused({"--colour", "red"}, {"unknown option --colour"});
  write_text(files / "file", "x");
  check_refused({"--output", files / "file"}, {"--output is ", "directory"});
}

TEST_CASE("contact_kinematics: the summary alone without --output", "[examples]") {
  const auto result = run_program(program, {"--lateral-shift", "-3:0.5:3"});
  CHECK(result.exit_code == 0);
  CHECK(result.error.empty());
  CHECK_THAT(result.output, ContainsSubstring("wheels: s1002"));
  CHECK_THAT(result.output, ContainsSubstring("lateral shifts: 13, from -3 to 3 mm"));
  CHECK_THAT(result.output, ContainsSubstring("amplitude 7 mm: none, out_of_range"));
}

TEST_CASE("contact_kinematics: the picture, or how to draw it later", "[examples]") {
  const TemporaryDirectory scratch;
  const Strings arguments{"--lateral-shift", "-5:0.5:5", "--output", scratch / "it's run"};
  const auto without = run_without_gnuplot(arguments);
  CHECK(without.exit_code == 0);
  CHECK_THAT(without.output, ContainsSubstring("there is no gnuplot; with it, draw by\n  cd "));
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) return;
  const auto with = run_program(program, arguments);
  CAPTURE(with.error);
  CHECK(with.exit_code == 0);
  CHECK(with.error.empty());
  for (const char* name : {"it's run/contact_kinematics.png", "it's run/contact_kinematics.svg"}) {
    CHECK(read_text(scratch / name).size() > 5000);
  }
}
