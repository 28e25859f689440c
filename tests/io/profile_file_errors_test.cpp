#include <filesystem>
#include <limits>
#include <string>
#include <wheelrail/io/profile_file.hpp>

#include "io/sample_profiles.hpp"
#include "support/catch.hpp"
#include "support/files.hpp"

using namespace wheelrail;
using namespace wheelrail_test;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr auto wheel = ProfileKind::wheel;
constexpr auto rail = ProfileKind::rail;

std::string error_of(const std::string& text, ProfileKind kind = rail,
                     const std::string& name = "f", const ProfileReadOptions& options = {}) {
  try {
    (void)parse_profile(text, name, kind, options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("parse_profile: a table's error names file, line and reason", "[io][bad-input]") {
  const std::string good = rows(rail_points(20), 1e3, 1e3);  // 21 lines
  REQUIRE(error_of(good).empty());
  struct Case {
    std::string line, error;
  };
  for (const Case& c : {
           Case{"1 2 3",
                "f:22: there are 3 columns in '1 2 3', but must be 2 (of numbers without "
                "decimal commas)"},
           Case{"5",
                "f:22: there are 1 columns in '5', but must be 2 (of numbers without decimal "
                "commas)"},
           Case{"1,5;2,5",
                "f:22: the lateral coordinate is '1,5', but must have a decimal point, "
                "not a decimal comma"},
           Case{"1,5 2,5",
                "f:22: there are 3 columns in '1,5 2,5', but must be 2 (of numbers "
                "without decimal commas)"},
           Case{"1,5,2,5",
                "f:22: there are 4 columns in '1,5,2,5', but must be 2 (of numbers "
                "without decimal commas)"},
           Case{"1 nan", "f:22: the vertical coordinate is 'nan', but must be finite"},
           Case{"-inf 1", "f:22: the lateral coordinate is '-inf', but must be finite"},
           Case{"NaN 1", "f:22: the lateral coordinate is 'NaN', but must be finite"},
           Case{"1 1e400",
                "f:22: the vertical coordinate is '1e400', but must be in double's "
                "range"},
           Case{"1 1e300",
                "f:22: the point is at (1, 1e+300), but must be nearer to the origin "
                "than 1e9"},
           Case{"-1e300 1",
                "f:22: the point is at (-1e+300, 1), but must be nearer to the origin "
                "than 1e9"},
           Case{"1 0x10", "f:22: the vertical coordinate is '0x10', but must be a number"},
           Case{"1 1.0D+01", "f:22: the vertical coordinate is '1.0D+01', but must be a number"},
           Case{"1 +-5", "f:22: the vertical coordinate is '+-5', but must be a number"},
           Case{"1 -", "f:22: the vertical coordinate is '-', but must be a number"},
           Case{";", "f:22: the lateral coordinate is '', but must be a number"},
           Case{"y z", "f:22: the lateral coordinate is 'y', but must be a number"},
           Case{std::string("1 \0002", 4), "f:22: a byte is 0, but must be text"},
           Case{"1 \xC3\xA9", "f:22: the vertical coordinate is '\?\?', but must be a number"},
           Case{std::string("1 ").append(std::string(500, '7')).append("x"),
                "f:22: the vertical coordinate is '" + std::string(40, '7') +
                    "...', but must be in double's range"},
       }) {
    CHECK(error_of(good + c.line) == c.error);
    CHECK(error_of(good + c.line + "\r\n1 2\r\n") == c.error);
  }
  CHECK(error_of("1,5;2,5\n" + good).substr(0, 42) == "f:1: the lateral coordinate is '1,5', but ");
  CHECK(error_of("nan nan\n" + good) == "f:1: the lateral coordinate is 'nan', but must be finite");
  CHECK(error_of("a b\nc d\n" + good) ==
        "f:2: the lateral coordinate is 'c', but must be a number");
  CHECK(error_of("a b c\n" + good) == "f:1: the header line has 3 columns, but must have 2");
  CHECK(error_of("a [cm],b\n" + good) == "f:1: a column's unit is 'cm', but must be m or mm");
  CHECK(error_of("a [m],b [mm]\n" + good) ==
        "f:1: the columns' units are m and mm, but must be the same");
  CHECK(error_of("a [m],b\n" + good).substr(0, 29) == "f:2: the profile is 72 m wide");
}

TEST_CASE("parse_profile: too little and too much is refused", "[io][bad-input]") {
  CHECK(error_of("") == "f:1: there are 0 points, but must be at least 4");
  CHECK(error_of("\n\n# nothing\n") == "f:3: there are 0 points, but must be at least 4");
  CHECK(error_of("1 2\n3 4\n5 6\n") == "f:3: there are 3 points, but must be at least 4");
  CHECK(error_of("1 2\n1 3\n1 4\n1 5\n").substr(0, 41) ==
        "f:1: the profile is 0 m wide and 3 m high");
  CHECK(error_of("0 0\n1e-9 0\n2e-9 0\n3e-9 0\n").substr(0, 25) == "f:1: the profile is 3e-09");
  const std::string good = rows(rail_points(20), 1e3, 1e3);
  CHECK(error_of(good, rail, "f", {.maximum_points = 20}) ==
        "f:21: there are more points, but must be at most 20");
  CHECK(error_of(good, rail, "f", {.maximum_points = 21}).empty());
  CHECK(error_of(good, rail, "f", {.maximum_bytes = 100}).substr(0, 14) == "f:1: there are");
  CHECK(error_of(good, rail, "f", {.maximum_bytes = good.size()}).empty());
}

TEST_CASE("parse_profile: a SIMPACK file's error names file, line and reason", "[io][bad-input]") {
  const std::string lines = rows(rail_points(20), 1, 1);
  const auto with = [&](const std::string& keys) {
    return error_of(simpack_text(false, keys, lines));
  };
  REQUIRE(with("").empty());
  CHECK(with("mirror.y = 2\n") == "f:10: mirror.y is '2', but must be 0 or 1");
  CHECK(with("mirror.z = -1\n") == "f:10: mirror.z is '-1', but must be 0 or 1");
  CHECK(with("shift.y = 1e400\n") == "f:10: shift.y is '1e400', but must be in double's range");
  CHECK(with("shift.z = \n") == "f:10: shift.z is '', but must be a number");
  CHECK(with("shift.z = 0,5\n") ==
        "f:10: shift.z is '0,5', but must have a decimal point, not a decimal comma");
  CHECK(with("units.len.f = 0\n") == "f:10: units.len.f is '0', but must be > 0 [user/m]");
  CHECK(with("units.len.f = -1000\n") == "f:10: units.len.f is '-1000', but must be > 0 [user/m]");
  CHECK(
      with("units.len = 'mm'\nunits.len.f = 1\n") ==
      "f:11: units.len.f is '1', but must be that of units.len, 'mm' (or the unit must be given)");
  CHECK(with("rotate = 1\nunits.ang.f = 0\n") ==
        "f:11: units.ang.f is '0', but must be > 0 [user/rad]");
  CHECK(with("rotate = 1\nunits.ang = 'deg'\nunits.ang.f = 1\n") ==
        "f:12: units.ang.f is '1', but must be that of units.ang, 'deg'");
  CHECK(with("shift.y = 1\nshift.y = 1\n") == "f:11: the key 'shift.y' is given twice");
  CHECK(with("nonsense\n") ==
        "f:10: 'nonsense' stands in spline, but must be a key with its value in header or spline");
  CHECK(with("header.begin\n") == "f:10: header.begin stands in spline, but must not");
  CHECK(with("slope.begin\n") ==
        "f:10: the section is 'slope.begin', but must be header, spline or point");
  CHECK(with("bound.y.min = 5\nbound.y.max = 6\n") ==
        "f:37: there are 0 points, but must be at least 4");

  const std::string good = simpack_text(false, "", lines);
  CHECK(error_of(good, wheel) == "f:5: header.type is '0', but must be 1, a wheel's");
  CHECK(error_of(simpack_text(true, "", lines)) ==
        "f:5: header.type is '1', but must be 0, a rail's");
  CHECK(error_of(good.substr(0, good.find("-0.0"))) ==
        "f:11: the file ends in the section point, but must end it with point.end");
  CHECK(error_of(good.substr(0, good.find("  spline.end"))) ==
        "f:33: the file ends in the section spline, but must end it with spline.end");
  CHECK(error_of(good + good) == "f:38: there is a second header.begin, but must be one");
  CHECK(error_of("spline.begin\nspline.end\n") == "f:2: there is no point.begin, but must be one");
  CHECK(error_of("spline.begin\npoint.begin\n1\n") ==
        "f:3: there are 1 columns in '1', but must be y, z and perhaps a weight");
  CHECK(error_of("spline.begin\npoint.begin\n1 2 x\n") ==
        "f:3: the weight is 'x', but must be a number");
  CHECK(error_of("spline.begin\npoint.begin\n1 = 2\n").substr(0, 20) == "f:3: the coordinate ");
}

TEST_CASE("parse_profile: a MiniProf file's error names file, line and reason", "[io][bad-input]") {
  const std::string lines = rows(rail_points(20), 1e3, 1e3);
  const auto with = [&](const std::string& head) { return error_of(head + "\n" + lines); };
  REQUIRE(with("XYPoints=21\n").empty());
  CHECK(with("XYPoints=-5\n") == "f:1: XYPoints is '-5', but must be a whole number >= 0");
  CHECK(with("XYPoints=2.5\n") == "f:1: XYPoints is '2.5', but must be a whole number >= 0");
  CHECK(with("XYPoints=1e999\n") == "f:1: XYPoints is '1e999', but must be in double's range");
  CHECK(with("XYPoints=20\n") ==
        "f:23: there are 21 points, but must be as many as XYPoints in line 1 says, 20");
  CHECK(with("XYPoints=1e300\n") == "f:1: XYPoints is '1e300', but must be a whole number >= 0");
  CHECK(with("ColumnDef=X,Z\n") == "f:1: ColumnDef is 'X,Z', but must name X and Y");
  CHECK(with("ColumnDef=X,X,Y\n") == "f:1: ColumnDef is 'X,X,Y', but must name X and Y once");
  CHECK(with("ColumnDef=X,*,Y\n").substr(0, 53) ==
        "f:1: ColumnDef is 'X,*,Y', but must be names with com");
  CHECK(with("ColumnDef=\n").substr(0, 35) == "f:1: ColumnDef is '', but must be n");
  CHECK(with("ColumnDef=X,Y,A\n") ==
        "f:3: there are 2 columns in '-36.5 -24.300000000000008', but must be 3 by ColumnDef");
  CHECK(with("XOffset=a\n") == "f:1: XOffset is 'a', but must be a number");
  CHECK(with("=5\n") == "f:1: the key is empty, but must be a name");
  CHECK(error_of("A=1\n" + lines + "B=2\n") ==
        "f:23: the key 'B' stands after points, but must stand before them");
  CHECK(error_of("A=1\n1,5 2,5\n").substr(0, 42) == "f:2: the coordinate Y is '5 2', but must b");
}

TEST_CASE("read_profile: missing files, directories, pipes and the other kind's files",
          "[io][bad-input]") {
  const TemporaryDirectory directory;
  const auto error_of_path = [](const std::string& path, ProfileKind kind,
                                const ProfileReadOptions& options = {}) -> std::string {
    try {
      (void)read_profile(path, kind, options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  CHECK(error_of_path(directory / "none.prw", wheel) ==
        (directory / "none.prw") + ":1: there is no such file");
  CHECK(error_of_path(directory.path().string(), wheel) ==
        directory.path().string() + ":1: it is no regular file, but must be one");
  CHECK(error_of_path("/dev/zero", wheel) == "/dev/zero:1: it is no regular file, but must be one");
  write_text(directory / "empty.csv", "");
  CHECK(error_of_path(directory / "empty.csv", rail) ==
        (directory / "empty.csv") + ":1: there are 0 points, but must be at least 4");
  write_text(directory / "big.csv", std::string(1000, '\n'));
  CHECK(error_of_path(directory / "big.csv", rail, {.maximum_bytes = 999}) ==
        (directory / "big.csv") + ":1: there are 1000 bytes, but there must be at most 999");
  write_text(directory / "w.prw", profile_text(wheel_points(), wheel));
  CHECK(error_of_path(directory / "w.prw", wheel).empty());
  CHECK(error_of_path(directory / "w.prw", rail) ==
        (directory / "w.prw") + ":1: the extension is the other kind's, but a rail is asked for");
  for (const std::string name : {"a.PRR", "a.ban", "a.rai"}) {
    write_text(directory / name, profile_text(rail_points(), rail));
    CHECK(error_of_path(directory / name, rail).empty());
    CHECK_FALSE(error_of_path(directory / name, wheel).empty());
  }
}

TEST_CASE("write_profile, profile_text: refuse what could not be read back", "[io][bad-input]") {
  const TemporaryDirectory directory;
  auto points = wheel_points();
  CHECK_THROWS_WITH(write_profile(directory / "w.prr", points, wheel),
                    ContainsSubstring("w.prr: the extension is the other kind's"));
  CHECK_THROWS_AS(write_profile(directory / "none/w.prw", points, wheel), std::runtime_error);
  CHECK_THROWS_AS(write_profile(directory.path(), points, wheel), std::runtime_error);
  for (const std::string comment : {"", "***", "two\nlines", "a\rb", "a\x01"}) {
    CHECK_THROWS_WITH(profile_text(points, wheel, {.comments = {comment}}),
                      ContainsSubstring("but must be one line with a letter or digit"));
  }
  CHECK_THROWS_WITH(profile_text(ProfilePoints<double>{{1, 2, 3}, {1, 2, 3}}, wheel),
                    ContainsSubstring("there are 3 laterals and 3 values"));
  CHECK_THROWS_WITH(profile_text(ProfilePoints<double>{{1, 2, 3, 4}, {1, 2, 3}}, wheel),
                    ContainsSubstring("there are 4 laterals and 3 values"));
  points.value[5] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(write_profile(directory / "w.prw", points, wheel),
                    "profile file: value of point 5 is nan, but must be finite");
  CHECK(std::filesystem::is_empty(directory.path()));
}
