// examples/contact_search as a user runs it: its CSV against the library and against brute force,
// and what it says to bad input.

#include <cstdio>
#include <limits>
#include <wheelrail/wheelrail.hpp>

#include "../support/brute_force_contact.hpp"
#include "../support/catch.hpp"
#include "run_program.hpp"

using namespace wheelrail;
using namespace wheelrail_test;
using Catch::Matchers::ContainsSubstring;

namespace {

const std::string header =
    "pose,side,patch,wheel_lateral,rail_lateral,wheel_angle,longitudinal,penetration,lower,upper,"
    "contact_angle,rolling_radius";
const std::string poses_header = "lateral_shift,height,roll,yaw\n";

struct Pose {
  double lateral_shift, height, roll, yaw;
};

std::string number(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

std::string csv_of(const std::vector<Pose>& poses) {
  std::string text = poses_header;
  for (const Pose& p : poses) {
    text += number(p.lateral_shift) + "," + number(p.height) + "," + number(p.roll) + "," +
            number(p.yaw) + "\n";
  }
  return text;
}

struct Row {
  std::size_t pose, patch;
  std::string side;
  std::array<double, 9> values;  // from wheel_lateral on
};

// The rows of a run that must have been good.
std::vector<Row> rows_of(const ProgramResult& result) {
  INFO(result.error);
  REQUIRE(result.exit_code == 0);
  REQUIRE(result.error.empty());
  REQUIRE(result.output.ends_with("\n"));
  const Strings lines = lines_of(result.output);
  REQUIRE(!lines.empty());
  REQUIRE(lines[0] == header);
  std::vector<Row> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const Strings fields = fields_of(lines[i]);
    REQUIRE(fields.size() == 12);
    Row row{std::stoul(fields[0]), std::stoul(fields[2]), fields[1], {}};
    for (std::size_t k = 0; k < 9; ++k) row.values[k] = std::stod(fields[k + 3]);
    rows.push_back(row);
  }
  return rows;
}

std::array<double, 9> values_of(const Patch<double>& p) {
  return {p.wheel_lateral, p.rail_lateral, p.wheel_angle,   p.longitudinal,  p.penetration,
          p.zone_lower,    p.zone_upper,   p.contact_angle, p.rolling_radius};
}

// Tread, fillet, flange, yaw and roll, two zones, and no contact, both ways.
const std::vector<Pose>& poses() {
  static const std::vector<Pose> all{
      {0, 0.4297, 0, 0},          {0.002, 0.42971, 2.5e-5, 0.001},   {-0.003, 0.4297, 0, -0.01},
      {0.0055, 0.4298, 0, 0},     {0.006, 0.4297, 0, 0.03},          {-0.006, 0.4297, 0, 0.03},
      {0.0065, 0.4298, 0, -0.01}, {0.01, 0.4345, 0, 0.03},           {-0.01, 0.435, 0.001, -0.03},
      {0.005, 0.4298, 0, 0},      {0.008, 0.432, -0.00195, -0.0103}, {0, 0.44, 0, 0}};
  return all;
}

ProgramResult search(Strings arguments, const std::string& input) {
  arguments.insert(arguments.end(), {"--poses", "-"});
  return run_program("contact_search", arguments, input);
}

void check_refused(const ProgramResult& result, const std::string& why) {
  CAPTURE(result.exit_code, result.output, result.error);
  CHECK(refuses(result, "contact_search"));
  CHECK_THAT(result.error, ContainsSubstring(why));
}

}  // namespace

TEST_CASE("contact_search: --help says what there is, with units", "[examples]") {
  for (const char* option : {"--help", "-h"}) {
    const auto result = run_program("contact_search", {option});
    CHECK(result.exit_code == 0);
    CHECK(result.error.empty());
    for (const char* name :
         {"--wheel", "--rail", "--nominal-radius", "--profile-spacing", "--gauge", "--inclination",
          "--method", "--poses", "--lateral-shift", "--height", "--roll", "--yaw", "[m]", "[rad]",
          "default 0.43)", "default 1.5)", "default 1.435)", "default 0.05)"}) {
      CHECK_THAT(result.output, ContainsSubstring(name));
    }
  }
}

TEST_CASE("contact_search: the rows are what the library returns, to 12 digits",
          "[examples][reference]") {
  struct Setting {
    Strings arguments;
    double nominal_radius, profile_spacing, gauge, inclination;
    bool is_60e1;
  };
  const Setting settings[] = {{{}, 0.43, 1.5, 1.435, 0.05, false},
                              {{"--rail", "60e1", "--nominal-radius=0.4301", "--profile-spacing",
                                "1.501", "--gauge", "1.436", "--inclination", "0.025"},
                               0.4301,
                               1.501,
                               1.436,
                               0.025,
                               true}};
  std::size_t most = 0;
  for (const Setting& at : settings) {
    const Wheelset wheelset(s1002<double>(), at.nominal_radius, at.profile_spacing);
    const TangentTrack track(at.is_60e1 ? rail_60e1<double>() : uic50<double>(),
                             {.gauge = at.gauge, .inclination = at.inclination});
    const auto result = search(at.arguments, csv_of(poses()));
    const auto rows = rows_of(result);
    std::size_t next = 0;
    for (std::size_t i = 0; i < poses().size(); ++i) {
      const Pose& p = poses()[i];
      const auto position = WheelsetPosition<double>::of(p.lateral_shift, p.height, p.roll, p.yaw);
      for (const Side side : sides) {
        const auto found = find_contact(wheelset.wheel(side), track.rail(side),
                                        place_wheel(wheelset, track, side, position));
        most = std::max(most, found.patches.size());
        for (std::size_t k = 0; k < found.patches.size(); ++k, ++next) {
          CAPTURE(i, name_of(side), k);
          REQUIRE(next < rows.size());
          CHECK(rows[next].pose == i);
          CHECK(rows[next].side == (side == Side::left ? "left" : "right"));
          CHECK(rows[next].patch == k);
          const auto expected = values_of(found.patches[k]);
          for (std::size_t c = 0; c < 9; ++c) {
            CAPTURE(c);
            // Half a unit of the twelfth digit, and another compilation's rounding.
            CHECK(std::abs(rows[next].values[c] - expected[c]) <=
                  5.1e-12 * std::abs(expected[c]) + 1e-15);
          }
        }
      }
    }
    CHECK(next == rows.size());
    CHECK(next >= 14);

    // Numbers are printed with 12 digits: never more, and fewer only where they end in zeros.
    int full = 0, all = 0;
    const Strings lines = lines_of(result.output);
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const Strings fields = fields_of(lines[i]);
      for (std::size_t k = 3; k < fields.size(); ++k) {
        std::string digits;
        for (const char c : fields[k].substr(0, fields[k].find('e'))) {
          if (c >= '0' && c <= '9' && (c != '0' || !digits.empty())) digits += c;
        }
        REQUIRE(digits.size() <= 12);
        CHECK(fields[k] != "-0");
        if (digits.empty()) continue;  // zero
        ++all;
        full += digits.size() == 12 ? 1 : 0;
      }
    }
    CHECK(full * 10 > all * 8);
  }
  CHECK(most == 2);
}

TEST_CASE("contact_search: poses by file, by standard input and by values give the same rows",
          "[examples]") {
  const TemporaryDirectory scratch;
  const std::string text = csv_of(poses());
  write_text(scratch / "poses.csv", text);
  const auto by_input = search({}, text);
  const auto by_file = run_program("contact_search", {"--poses", scratch / "poses.csv"});
  REQUIRE(rows_of(by_input).size() > 14);
  CHECK(by_file.exit_code == 0);
  CHECK(by_file.output == by_input.output);
  // Each pose alone, by values: the same rows with another number in front.
  Strings alone{header};
  for (std::size_t i = 0; i < poses().size(); ++i) {
    const Pose& p = poses()[i];
    const auto result = run_program("contact_search", {"--lateral-shift", number(p.lateral_shift),
                                                       "--height=" + number(p.height), "--roll",
                                                       number(p.roll), "--yaw", number(p.yaw)});
    REQUIRE(result.exit_code == 0);
    const Strings lines = lines_of(result.output);
    for (std::size_t k = 1; k < lines.size(); ++k) {
      alone.push_back(std::to_string(i) + lines[k].substr(lines[k].find(',')));
    }
  }
  CHECK(alone == lines_of(by_input.output));
}

TEST_CASE("contact_search: line ends of other systems and a missing last one are accepted",
          "[examples]") {
  const std::string text = csv_of(poses());
  const auto expected = search({}, text);
  REQUIRE(expected.exit_code == 0);
  std::string crlf;
  for (const char c : text) {
    if (c == '\n') crlf += '\r';
    crlf += c;
  }
  for (const std::string& variant :
       {crlf, text.substr(0, text.size() - 1), crlf.substr(0, crlf.size() - 2), text + "\n\n"}) {
    const auto result = search({}, variant);
    CHECK(result.exit_code == 0);
    CHECK(result.error.empty());
    CHECK(result.output == expected.output);
  }
}

TEST_CASE("contact_search: both sides mirror each other", "[examples][symmetry]") {
  std::vector<Pose> mirrored = poses();
  for (Pose& p : mirrored) p = {-p.lateral_shift, p.height, -p.roll, -p.yaw};
  const auto rows = rows_of(search({}, csv_of(poses())));
  const auto others = rows_of(search({}, csv_of(mirrored)));
  REQUIRE(rows.size() == others.size());
  int right = 0;
  for (const Row& row : rows) {
    const std::string other_side = row.side == "left" ? "right" : "left";
    right += row.side == "right" ? 1 : 0;
    const auto other = std::find_if(others.begin(), others.end(), [&](const Row& r) {
      return r.pose == row.pose && r.patch == row.patch && r.side == other_side;
    });
    REQUIRE(other != others.end());
    auto expected = row.values;
    expected[2] = 0.0 - expected[2];  // right-handed about an axis that is mirrored
    CHECK(other->values == expected);
  }
  CHECK(right > 5);
}

TEST_CASE("contact_search: both methods agree on the convex profile", "[examples][reference]") {
  const std::vector<Pose> at{{0, 0.4297, 0, 0},         {0.003, 0.4297, 0, 0.01},
                             {-0.004, 0.4297, 0, 0.03}, {0.0067, 0.4302, 0, -0.02},
                             {-0.01, 0.4345, 0, 0.03},  {0.002, 0.42971, 2.5e-5, -0.03}};
  const auto strips = rows_of(search({"--wheel", "s1002-convex"}, csv_of(at)));
  const auto distance =
      rows_of(search({"--wheel", "s1002-convex", "--method", "minimum-distance"}, csv_of(at)));
  REQUIRE(strips.size() == distance.size());
  CHECK(strips.size() >= 8);
  int on_flange = 0;
  for (std::size_t i = 0; i < strips.size(); ++i) {
    const auto& a = strips[i].values;
    const auto& b = distance[i].values;
    CAPTURE(i, a[0], b[0], a[4], b[4]);
    CHECK(strips[i].pose == distance[i].pose);
    CHECK(strips[i].side == distance[i].side);
    CHECK(strips[i].patch == distance[i].patch);
    on_flange += a[0] < -0.03 ? 1 : 0;
    for (const std::size_t c : {0U, 1U, 2U, 3U, 7U, 8U}) CHECK(std::abs(a[c] - b[c]) < 1e-10);
    CHECK(std::abs(a[4] - b[4]) < 1e-14);
    CHECK(a[5] <= a[0]);
    CHECK(a[0] <= a[6]);
    CHECK(std::isnan(b[5]));  // not known by this method
    CHECK(std::isnan(b[6]));
  }
  CHECK(on_flange >= 1);
}

TEST_CASE("contact_search: a patch that the minimum distance method misses is said",
          "[examples][regression]") {
  // On the tread it is right on the real wheel too; beside the fillet it finds one patch of two,
  // and in the fillet a shallower point than the deepest.
  const auto good = search({"--method", "minimum-distance"}, csv_of({{0.002, 0.4297, 0, 0.01}}));
  CHECK(rows_of(good).size() == 2);
  for (const double lateral_shift : {0.005, 0.0065}) {
    const auto result =
        search({"--method", "minimum-distance"}, csv_of({{lateral_shift, 0.4298, 0, 0}}));
    CAPTURE(lateral_shift, result.output, result.error);
    CHECK(result.exit_code == 3);
    CHECK(lines_of(result.error).size() == 1);
    CHECK_THAT(result.error,
               ContainsSubstring("pose 0, left wheel") && ContainsSubstring("convex"));
  }
}

TEST_CASE("contact_search: the rows are the zones of a brute-force search",
          "[examples][reference]") {
  int zones = 0, deep_rows = 0, in_fillet = 0, on_flange = 0, yawed = 0;
  for (const bool is_60e1 : {false, true}) {
    const auto head = is_60e1 ? rail_60e1<double>() : uic50<double>();
    const auto profile = s1002<double>();
    const ArcRail rail(head.dimensions());
    const TangentTrack track(head);
    const auto rows = rows_of(search({"--rail", is_60e1 ? "60e1" : "uic50"}, csv_of(poses())));
    for (const Row& row : rows) deep_rows += row.values[4] > 1e-7 ? 1 : 0;
    for (std::size_t i = 0; i < poses().size(); ++i) {
      const Pose& p = poses()[i];
      for (const Side side : sides) {
        const auto origin_track = track.nearest_frame(side, Vector3<double>::Zero()).origin_track;
        const BruteForceContact oracle(
            profile, 0.43, rail, {std::abs(origin_track.y()), origin_track.z(), std::atan(0.05)},
            side, {p.lateral_shift, p.height, p.roll, p.yaw});
        const auto expected = oracle.zones();
        REQUIRE(expected.saddle > 1e-9);  // no pose where two zones may be one
        for (const Zone& zone : expected.zones) {
          if (!(zone.penetration > 1e-7)) continue;
          CAPTURE(is_60e1, i, name_of(side), zone.lateral, zone.penetration);
          ++zones;
          const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& r) {
            return r.pose == i && r.side == name_of(side) &&
                   std::abs(r.values[4] - zone.penetration) < 1e-9 &&
                   std::abs(r.values[0] - zone.lateral) < 10e-6;
          });
          CHECK(row != rows.end());
          in_fillet += -38.43e-3 <= zone.lateral && zone.lateral < -26e-3 ? 1 : 0;
          on_flange += zone.lateral < -38.43e-3 ? 1 : 0;
          yawed += std::abs(p.yaw) >= 0.03 ? 1 : 0;
        }
      }
    }
  }
  CHECK(deep_rows == zones);  // none is invented
  CAPTURE(zones, in_fillet, on_flange, yawed);
  CHECK(zones > 28);
  CHECK(in_fillet >= 4);
  CHECK(on_flange >= 2);
  CHECK(yawed >= 6);
}

TEST_CASE("contact_search: bad options are refused in one line", "[examples][bad-input]") {
  struct Case {
    Strings arguments;
    const char* why;
  };
  const Case cases[] = {
      {{}, "--height"},
      {{"--height", "0.43", "--nominal-radius", "-0.43"}, "--nominal-radius is -0.43"},
      {{"--height", "0.43", "--nominal-radius", "0"}, "--nominal-radius"},
      {{"--height", "0.43", "--nominal-radius", "1e-3"}, "radius"},
      {{"--height", "0.43", "--profile-spacing", "-1"}, "--profile-spacing"},
      {{"--height", "0.43", "--gauge", "1.39"}, "gauge is 1.39"},
      {{"--height", "0.43", "--gauge", "1.6"}, "gauge is 1.6"},
      {{"--height", "0.43", "--gauge", "-1.435"}, "--gauge"},
      {{"--height", "0.43", "--inclination", "2"}, "inclination is 2"},
      {{"--height", "0.43", "--wheel", "s1003"}, "s1002, s1002-convex"},
      {{"--height", "0.43", "--rail", "s1002"}, "uic50, 60e1"},
      {{"--height", "0.43", "--method", "newton"}, "strip, minimum-distance"},
      {{"--height", "0.43", "--wheels", "s1002"}, "unknown option --wheels"},
      {{"--height", "0.43", "left"}, "unknown option left"},
      {{"--height"}, "--height: its value is missing"},
      {{"--height", "0.43", "--poses"}, "--poses: its value is missing"},
      {{"--height", "0.43", "--height", "0.43"}, "twice"},
      {{"--height", "nan"}, "--height is 'nan'"},
      {{"--height", "0.43", "--yaw", "inf"}, "--yaw is 'inf'"},
      {{"--height", "0.43", "--roll", "1e999"}, "--roll"},
      {{"--height", "0.43m"}, "--height is '0.43m'"},
      {{"--height="}, "--height is ''"},
      {{"--height", "0.43", "--wheel", "two\nlines"}, "--wheel"},
      {{"--poses", "-", "--height", "0.43"}, "--poses excludes"},
      {{"--poses", "-", "--yaw", "0"}, "--poses excludes"},
      {{"--poses", "/nonexistent/poses.csv"}, "/nonexistent/poses.csv"},
  };
  for (const Case& at : cases) {
    check_refused(run_program("contact_search", at.arguments, poses_header + "0,0.43,0,0\n"),
                  at.why);
  }
  const TemporaryDirectory scratch;
  check_refused(run_program("contact_search", {"--poses", scratch.path().string()}),
                scratch.path().string());
}

TEST_CASE("contact_search: a bad pose row is refused with its file and line",
          "[examples][bad-input]") {
  const std::string good = "0,0.4297,0,0\n";
  struct Case {
    std::string text;
    int line;
  };
  const Case cases[] = {
      {"", 1},
      {"\n", 1},
      {good, 1},
      {"height,lateral_shift,roll,yaw\n" + good, 1},
      {"lateral_shift,height,roll,yaw,speed\n" + good, 1},
      {poses_header, 2},
      {poses_header + "\n\n", 4},
      {poses_header + good + "\n" + good, 3},
      {poses_header + good + "0,0.43,0\n" + good, 3},
      {poses_header + good + "0,0.43,0,\n" + good, 3},
      {poses_header + good + good + "0,0.43,0,0,0", 4},
      {poses_header + "0,0.43,0,0,\n", 2},
      {poses_header + "0,,0,0\n", 2},
      {poses_header + "0, ,0,0\n", 2},
      {poses_header + "0;0.43;0;0\n", 2},
      {poses_header + "0,0.43,0,nan\n", 2},
      {poses_header + good + "-inf,0.43,0,0\n", 3},
      {poses_header + "0,1e400,0,0\n", 2},
      {poses_header + "0,0.43,zero,0\n", 2},
      {poses_header + "0,0.43 m,0,0\n", 2},
      {poses_header + std::string("0,0.43\0001,0,0\n", 13), 2},
      {poses_header + "0,0.43,0,0\r\n0,0.43,0\r\n", 3},
  };
  const TemporaryDirectory scratch;
  const std::string path = scratch / "bad poses.csv";
  for (const Case& at : cases) {
    CAPTURE(at.text);
    const std::string line = std::string(":").append(std::to_string(at.line)).append(": ");
    write_text(path, at.text);
    check_refused(run_program("contact_search", {"--poses", path}), path + line);
    check_refused(search({}, at.text), std::string("standard input").append(line));
  }
}

TEST_CASE("contact_search: a full disk is no success", "[examples][bad-input]") {
  if (!std::filesystem::exists("/dev/full")) return;
  std::string command(1, '\'');
  command.append(WHEELRAIL_EXAMPLES_DIR).append("/contact_search' --height 0.4297 >/dev/full 2>&1");
  const int status = std::system(command.c_str());
  CHECK(WEXITSTATUS(status) != 0);
}
