#include <algorithm>
#include <clocale>
#include <cmath>
#include <limits>
#include <string>
#include <wheelrail/io/profile_file.hpp>

#include "io/sample_profiles.hpp"
#include "support/catch.hpp"
#include "support/files.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using namespace wheelrail_test;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr auto wheel = ProfileKind::wheel;
constexpr auto rail = ProfileKind::rail;
constexpr double rounding = 1e-16;  // of coordinates of some 0.07 m, in mm and back

}  // namespace

TEST_CASE("write_profile, read_profile: what is written is read, bit for bit in metres", "[io]") {
  const TemporaryDirectory directory;
  const auto kind = GENERATE(wheel, rail);
  const auto format =
      GENERATE(ProfileFormat::simpack, ProfileFormat::miniprof, ProfileFormat::table);
  const auto unit = GENERATE(LengthUnit::metre, LengthUnit::millimetre);
  const auto points = points_of(kind, 100);
  const std::string path = directory / "profile.dat";
  write_profile(path, points, kind,
                {.format = format, .unit = unit, .comments = {"worn, 120 000 km", "a = b ! 5 %"}});
  const auto file = read_profile(path, kind);
  CAPTURE(read_text(path));
  CHECK(file.kind == kind);
  CHECK(file.format == format);
  CHECK(file.comments == Strings{"worn, 120 000 km", "a = b ! 5 %"});
  const bool in_metres = unit == LengthUnit::metre && format != ProfileFormat::miniprof;
  CHECK(distance_of(file.points.lateral, points.lateral) <= (in_metres ? 0 : rounding));
  CHECK(distance_of(file.points.value, points.value) <= (in_metres ? 0 : rounding));
  CHECK(file.units_per_metre.value == (in_metres ? 1 : 1000));
  CHECK(file.units_per_metre.basis == ReadingBasis::stated);
  CHECK(file.reversed == (format == ProfileFormat::simpack && kind == wheel));
  CHECK(file.not_applied.empty());
  CHECK(names_in(directory.path()) == Strings{"profile.dat"});  // nothing is left beside it
  if (format == ProfileFormat::table) {
    CHECK(file.value.basis == ReadingBasis::stated);
    CHECK(file.lateral.basis == ReadingBasis::stated);
  } else {
    CHECK(file.value.basis == ReadingBasis::detected);
    CHECK(file.lateral.basis == (kind == wheel ? ReadingBasis::detected : ReadingBasis::assumed));
  }
}

TEST_CASE("parse_profile: units, vertical sign and a wheel's orientation are detected", "[io]") {
  const auto kind = GENERATE(wheel, rail);
  const auto points = points_of(kind, 100);
  const double units = GENERATE(1.0, 1000.0);
  const double value_sign = GENERATE(1.0, -1.0);
  const double lateral_sign = GENERATE(1.0, -1.0);
  CAPTURE(units, value_sign, lateral_sign);
  auto text = rows(points, lateral_sign * units, value_sign * units);
  const auto file = parse_profile(text, "p.txt", kind);
  CHECK(file.format == ProfileFormat::table);
  CHECK(file.units_per_metre.value == units);
  CHECK(file.units_per_metre.basis == ReadingBasis::detected);
  CHECK(file.value.value == (value_sign > 0 ? ValueAxis::outward : ValueAxis::inward));
  CHECK(file.value.basis == ReadingBasis::detected);
  if (kind == wheel) {
    CHECK(file.lateral.value ==
          (lateral_sign > 0 ? LateralAxis::field_side : LateralAxis::gauge_side));
    CHECK(file.lateral.basis == ReadingBasis::detected);
    CHECK_FALSE(file.reversed);  // mirrored, but run through from the flange
    CHECK(distance_of(file.points.lateral, points.lateral) <= rounding);
    CHECK(distance_of(file.points.value, points.value) <= rounding);
  } else {
    // Nothing tells a rail's sides apart: the file's axis is taken, the option mirrors it.
    CHECK(file.lateral.value == LateralAxis::field_side);
    CHECK(file.lateral.basis == ReadingBasis::assumed);
    CHECK(file.reversed == (lateral_sign < 0));
    const auto forced = parse_profile(
        text, "p.txt", kind,
        {.lateral = lateral_sign > 0 ? LateralAxis::field_side : LateralAxis::gauge_side});
    CHECK(forced.lateral.basis == ReadingBasis::forced);
    CHECK_FALSE(forced.reversed);
    CHECK(distance_of(forced.points.lateral, points.lateral) <= rounding);
    CHECK(distance_of(forced.points.value, points.value) <= rounding);
  }
}

TEST_CASE("parse_profile: the detection holds with faces, inclination and noise", "[io]") {
  auto points = wheel_points(260);
  for (int i = 1; i <= 60; ++i) {  // a field face of 60 mm, a flange back of 40 mm
    points.lateral.push_back(0.06 + 1e-6 * i);
    points.value.push_back(points.value[260] - 1e-3 * i);
  }
  for (int i = 1; i <= 40; ++i) {
    points.lateral.insert(points.lateral.begin(), -0.0695);
    points.value.insert(points.value.begin(), points.value[0] - 1e-3);
  }
  for (std::size_t i = 0; i < points.size(); ++i) points.value[i] += i % 2 == 0 ? 2e-5 : -2e-5;
  points.value[200] -= 0.08;  // a spike
  const auto file = parse_profile(rows(points, -1e3, -1e3), "w", wheel);
  CHECK(file.value.value == ValueAxis::inward);
  CHECK(file.lateral.value == LateralAxis::gauge_side);
  auto inclined = rail_points();
  for (std::size_t i = 0; i < inclined.size(); ++i) {
    inclined.value[i] += inclined.lateral[i] / 20;
  }
  CHECK(parse_profile(rows(inclined, 1e3, -1e3), "r", rail).value.value == ValueAxis::inward);
}

TEST_CASE("parse_profile: what is not clear is refused, and read where an option says it",
          "[io][bad-input]") {
  ProfilePoints<double> cone, hump;
  for (int i = 0; i <= 40; ++i) {
    cone.lateral.push_back(1e-3 * i);
    cone.value.push_back(-5e-5 * i);
    hump.lateral.push_back(1e-3 * i);
    hump.value.push_back(i == 19 || i == 20 || i == 21 ? 1e-3 : 0);
  }
  const std::string text = rows(cone, 1, 1);
  CHECK_THROWS_WITH(parse_profile(text, "cone.txt", wheel),
                    Catch::Matchers::StartsWith("cone.txt:1: the points reach ") &&
                        ContainsSubstring("must be 1.5 times") && ContainsSubstring("option"));
  const auto file = parse_profile(
      text, "cone.txt", wheel, {.value = ValueAxis::outward, .lateral = LateralAxis::field_side});
  CHECK(file.points.lateral == cone.lateral);
  CHECK(file.value.basis == ReadingBasis::forced);
  CHECK_THROWS_WITH(parse_profile(rows(hump, 1, 1), "hump.txt", wheel),
                    ContainsSubstring("0.4 to 0.6") && ContainsSubstring("lateral axis"));
  CHECK(parse_profile(rows(hump, 1, 1), "h", wheel, {.lateral = LateralAxis::gauge_side}).reversed);
}

TEST_CASE("parse_profile: options go before what a file says", "[io]") {
  const auto points = wheel_points();
  const std::string text = profile_text(points, wheel, {.unit = LengthUnit::millimetre});
  CHECK_THROWS_WITH(parse_profile(text, "w.csv", wheel, {.unit = LengthUnit::metre}),
                    Catch::Matchers::StartsWith("w.csv:2: the profile is 129.5 m wide"));
  const auto file = parse_profile(text, "w.csv", wheel,
                                  {.unit = LengthUnit::millimetre,
                                   .value = ValueAxis::inward,
                                   .lateral = LateralAxis::gauge_side});
  CHECK(file.units_per_metre.basis == ReadingBasis::forced);
  CHECK(file.value.basis == ReadingBasis::forced);
  CHECK(file.points.lateral.back() == Approx(0.0695));
  CHECK(file.reversed);
  const auto one = parse_profile("XYPoints=4\n0 0\n10 10\n20 10\n40 10\n", "w", wheel,
                                 {.value = ValueAxis::inward});
  CHECK(one.format == ProfileFormat::miniprof);
  CHECK_THROWS_WITH(
      parse_profile("XYPoints=4\n0 0\n", "w", wheel, {.format = ProfileFormat::simpack}),
      ContainsSubstring("w:1: 'XYPoints=4' stands in no section"));
}

TEST_CASE("parse_profile: a SIMPACK file as its program writes it", "[io]") {
  auto points = wheel_points(90);
  std::reverse(points.lateral.begin(), points.lateral.end());
  std::reverse(points.value.begin(), points.value.end());
  const auto file = parse_profile(
      simpack_text(true,
                   "    file           = '-'\n    file.mtime     =  0\n"
                   "    point.dist.min = +0.0\n"
                   "    bound.y.min    = +1.0\n    bound.y.max    = +0.0\n"
                   "    mirror.y       =  0  ! 5: y mirror mode\n    inversion      =  1\n"
                   "    units.len      = 'm'\n    units.ang      = 'rad'\n"
                   "    units.len.f    = +1.0e+00\n    units.ang.f    = +1.0e+00\n",
                   rows(points, 1, 1, "\t")),
      "S1002.prw", wheel);
  CHECK(file.format == ProfileFormat::simpack);
  CHECK(file.reversed);
  CHECK(file.points.lateral == wheel_points(90).lateral);
  CHECK(file.points.value == wheel_points(90).value);
  CHECK(file.units_per_metre.basis == ReadingBasis::stated);
  CHECK(file.comments ==
        Strings{"***  Profile of a test   ***", "new! 100 %", "y  z  weight", "E n d"});
  CHECK(file.header[1] == std::pair<std::string, std::string>("type", "1"));
  CHECK(file.not_applied.empty());
}

TEST_CASE("parse_profile: SIMPACK's keys are applied in its order", "[io]") {
  const auto points = rail_points(60);
  const auto read = [](const std::string& keys, const std::string& lines) {
    return parse_profile(simpack_text(false, keys, lines), "r.prr", rail);
  };
  // The file holds what the keys undo: mm, shifted by (10, -3) mm, turned by 0.1 rad from y to z,
  // mirrored in both.
  const double cosine = std::cos(0.1), sine = std::sin(0.1);
  ProfilePoints<double> moved;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double y = -1e3 * points.lateral[i], z = 1e3 * points.value[i];
    moved.lateral.push_back(y * cosine + z * sine - 10);
    moved.value.push_back(-y * sine + z * cosine + 3);
  }
  const std::string keys =
      "shift.y = 10\nshift.z = -3\nmirror.y = 1\nmirror.z = 1\nunits.len.f = 1000\n";
  for (const char* angle : {"rotate = 0.1\n", "rotate = 100\nunits.ang.f = 1000\n",
                            "rotate = 5.729577951308232\nunits.ang = 'deg'\n"}) {
    const auto file = read(keys + angle, rows(moved, 1, 1));
    CHECK(distance_of(file.points.lateral, points.lateral) < 1e-15);
    CHECK(distance_of(file.points.value, points.value) < 1e-15);
    CHECK(file.value.value == ValueAxis::inward);
  }
  // Bounds: in the file's unit, after the shift, before the mirror.
  const auto cut =
      read("mirror.y = 1\nbound.y.min = -0.02\nbound.y.max = 0.03\n", rows(points, -1, 1));
  CHECK(cut.points.lateral.front() >= -0.03);
  CHECK(cut.points.lateral.front() < -0.028);
  CHECK(cut.points.lateral.back() <= 0.02);
  const auto clipped = read("bound.z.min = -0.01\nbound.z.max = 0.5\n", rows(points, 1, 1));
  CHECK(clipped.points.size() == points.size());
  CHECK(*std::min_element(clipped.points.value.begin(), clipped.points.value.end()) == -0.01);
  // What changes nothing here is said.
  const auto other = read("point.dist.min = 0.1\nunknown.key = 5\nunits.len = 'mm'\n",
                          rows(points, 1e3, 1e3, " ", " 0.5\n"));
  CHECK(other.not_applied == Strings{"point.dist.min", "unknown.key", "weights"});
  CHECK(other.units_per_metre.value == 1000);
  CHECK(other.units_per_metre.basis == ReadingBasis::stated);
  CHECK(read("", rows(points, 1e3, 1e3)).units_per_metre.basis == ReadingBasis::detected);
  CHECK(read("units.len.f = 100\n", rows(points, 1e2, 1e2)).units_per_metre.value == 100);
}

TEST_CASE("parse_profile: MiniProf columns, offsets and header", "[io]") {
  const auto points = rail_points(40);
  std::string lines;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::string fields[2];
    detail::append_number(fields[0], 1e3 * points.lateral[i] - 5);
    detail::append_number(fields[1], 1e3 * points.value[i] + 7);
    lines.append("1.5\t").append(fields[1]).append("\t0.1\t").append(fields[0]);
    lines.append("\tx\r\n");
  }
  const std::string head = "Date=29-06-2023\r\nProgramVer= 2.4\r\nComment=north = left\r\n";
  const auto file = parse_profile(
      head + "XOffset=5\r\nYoffset=-7\r\nXYPoints=41\r\nColumnDef=A,Y,C,X,*\r\n\r\n" + lines,
      "0001.ban", rail);
  CHECK(file.format == ProfileFormat::miniprof);
  CHECK(distance_of(file.points.lateral, points.lateral) < 1e-16);
  CHECK(distance_of(file.points.value, points.value) < 1e-16);
  CHECK(file.units_per_metre.value == 1000);
  CHECK(file.units_per_metre.basis == ReadingBasis::stated);
  CHECK(file.comments == Strings{"north = left"});
  CHECK(file.header[1] == std::pair<std::string, std::string>("ProgramVer", "2.4"));
  CHECK(file.not_applied == Strings{"column A", "column C"});
  // Without ColumnDef, without an empty line, with more columns than two.
  const auto plain = parse_profile(
      "Date=1\n\"quoted\n" + rows(wheel_points(20), 1e3, -1e3, ", ", ",0.0\n"), "w.whl", wheel);
  CHECK(plain.value.value == ValueAxis::inward);
  CHECK(distance_of(plain.points.lateral, wheel_points(20).lateral) < 1e-16);
}

TEST_CASE("parse_profile: tables with any separator, header, line end and byte order mark",
          "[io]") {
  const auto points = rail_points(20);
  const std::string separator = GENERATE(",", ";", "\t", "   ", " ; ", " , ");
  const std::string line_end = GENERATE("\n", "\r\n", "\r", "  \n\n", " # note\n");
  const std::string header =
      GENERATE("", "y;z\n", "\"y\",\"z\"\n", "Y Z\n", "# y, z of 1,5 mm\n! more\n\n");
  auto text = header + rows(points, 1, 1, separator, line_end);
  CAPTURE(text);
  const auto file = parse_profile("\xEF\xBB\xBF" + text, "r.csv", rail);
  CHECK(file.points.lateral == points.lateral);
  CHECK(file.points.value == points.value);
  text.erase(text.find_last_not_of(" \r\n#note") + 1);  // without the last line end
  CHECK(parse_profile(text, "r.csv", rail).points.value == points.value);
}

TEST_CASE("parse_profile: a table's header states unit and axes", "[io]") {
  const std::string lines = rows(rail_points(20), 1e3, -1e3);
  for (const std::string header :
       {"y [mm],z [mm]\n", "y[mm] z\n", "y [mm] z [mm]\n", "\"lateral\" (mm);\"height\"\n"}) {
    const auto file = parse_profile(header + lines, "r", rail);
    CHECK(file.units_per_metre.basis == ReadingBasis::stated);
    CHECK(file.value.basis == ReadingBasis::detected);
    CHECK(file.value.value == ValueAxis::inward);
    CHECK(distance_of(file.points.value, rail_points(20).value) < 1e-16);
  }
  const auto stated = parse_profile("Lateral;Value\n" + lines, "r", rail);
  CHECK(stated.value.basis == ReadingBasis::stated);
  CHECK(stated.value.value == ValueAxis::outward);  // as it says, though a rail looks otherwise
  CHECK(stated.units_per_metre.basis == ReadingBasis::detected);
}

TEST_CASE("parse_profile: points of float, long double and a strict scalar", "[io]") {
  const auto points = wheel_points();
  const std::string text = profile_text(points, wheel, {.unit = LengthUnit::millimetre});
  const auto reference = parse_profile(text, "w", wheel);
  const auto strict = parse_profile<StrictScalar>(text, "w", wheel);
  const auto single = parse_profile<float>(text, "w", wheel);
  const auto extended = parse_profile<long double>(text, "w", wheel);
  for (std::size_t i = 0; i < points.size(); ++i) {
    REQUIRE(strict.points.value[i].as_double() == reference.points.value[i]);
    REQUIRE(std::abs(static_cast<double>(single.points.value[i]) - points.value[i]) < 4e-9);
    REQUIRE(std::abs(static_cast<double>(extended.points.value[i]) - points.value[i]) < 1e-16);
  }
  const auto again = parse_profile<float>(profile_text(single.points, wheel), "w", wheel);
  CHECK(again.points.lateral == single.points.lateral);
  CHECK(again.points.value == single.points.value);
}

TEST_CASE("read_profile: dirty points are read as they are and mended apart", "[io]") {
  auto points = wheel_points(260);
  points.value[200] += 5e-3;
  points.lateral.insert(points.lateral.begin() + 50, points.lateral[50]);
  points.value.insert(points.value.begin() + 50, points.value[50]);
  const auto file = parse_profile(rows(points, 1e3, 1e3), "w.txt", wheel);
  CHECK(file.points.size() == points.size());
  const auto repair = repair_points(file.points);
  REQUIRE(repair.repaired.size() == 2);
  CHECK(repair.repaired[0].defect == PointDefect::duplicate);
  CHECK(repair.repaired[0].index == 51);
  CHECK(repair.repaired[1].defect == PointDefect::spike);
  CHECK(repair.repaired[1].index == 201);
}
