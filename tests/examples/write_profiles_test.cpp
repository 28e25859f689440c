// examples/write_profiles as a user runs it, and the files of profiles/ that it wrote: what
// profiles/README.md says of them.

#include <array>
#include <cmath>
#include <wheelrail/io/profile_file.hpp>
#include <wheelrail/wheelrail.hpp>

#include "../support/catch.hpp"
#include "run_program.hpp"

using namespace wheelrail;
using namespace wheelrail_test;
using Catch::Matchers::ContainsSubstring;

namespace {

using Spline = SplineProfile<double>;
using Points = ProfilePoints<double>;
using Strings = wheelrail_test::Strings;

const std::filesystem::path profiles = std::filesystem::path(WHEELRAIL_SOURCE_DIR) / "profiles";
const Strings wheel_names{"s1002.prw",
                          "s1002.whl",
                          "s1002.csv",
                          "s1002_hollow_1mm.prw",
                          "s1002_hollow_3mm.prw",
                          "s1002_worn.csv",
                          "s1002_measured.whl",
                          "s1002_thin_flange.prw"};
const Strings rail_names{
    "60e1.prr",  "60e1.rai",  "60e1.csv",         "60e1_flat_crown.prr", "60e1_gauge_corner.prr",
    "uic50.prr", "uic50.csv", "60e1_measured.rai"};

bool is_wheel(const std::string& name) {
  return name.starts_with("s1002");
}
bool is_measured(const std::string& name) {
  return name.find("measured") != std::string::npos;
}

ProfileFile<double> file_of(const std::string& name) {
  return read_profile(profiles / name, is_wheel(name) ? ProfileKind::wheel : ProfileKind::rail);
}
Points points_of(const std::string& name) {
  return file_of(name).points;
}

// Through the points, or where there is noise, at the level that README.md gives.
Spline spline_of(const std::string& name) {
  const Points points = repair_points(points_of(name)).points;
  return Spline(points.lateral, points.value, {.noise = is_measured(name) ? 1e-5 : 0.0});
}

// How far each point lies from that of the unworn file with the same number.
std::vector<double> removed(const std::string& worn, const std::string& unworn) {
  const Points a = points_of(worn), b = points_of(unworn);
  REQUIRE(a.size() == b.size());
  std::vector<double> distances;
  for (std::size_t i = 0; i < a.size(); ++i) {
    distances.push_back(std::hypot(a.lateral[i] - b.lateral[i], a.value[i] - b.value[i]));
  }
  return distances;
}

}  // namespace

TEST_CASE("write_profiles: writes the files of profiles/, byte for byte", "[examples]") {
  const TemporaryDirectory scratch;
  const std::string output = scratch / "new";
  // The second run replaces the files of the first.
  for (int run = 0; run < 2; ++run) {
    const auto result = run_program("write_profiles", {"--output", output});
    INFO(result.error);
    REQUIRE(result.exit_code == 0);
    CHECK(result.error.empty());
    Strings names = names_in(output);
    REQUIRE(names.size() == wheel_names.size() + rail_names.size());
    const Strings lines = lines_of(result.output);
    REQUIRE(lines.size() == names.size() + 1);
    CHECK(lines[0] == "file,points");
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const Strings fields = fields_of(lines[i]);
      REQUIRE(fields.size() == 2);
      CHECK(points_of(fields[0]).size() == std::stoul(fields[1]));
    }
    for (const std::string& name : names) {
      CAPTURE(name);
      // No CHECK on the texts themselves: it would print them.
      const bool is_same =
          read_text(std::filesystem::path(output) / name) == read_text(profiles / name);
      CHECK(is_same);
    }
    names.insert(names.begin(), "README.md");
    std::sort(names.begin(), names.end());
    CHECK(names == names_in(profiles));
  }
}

TEST_CASE("profiles/: README.md has a row for each file, with its number of points", "[examples]") {
  const std::string page = read_text(profiles / "README.md");
  const std::string table = page.substr(0, page.find("## How they are made"));
  for (const Strings* names : {&wheel_names, &rail_names}) {
    for (const std::string& name : *names) {
      CAPTURE(name);
      const std::string start = std::string("| `").append(name).append("` |");
      const auto at = table.find(start);
      REQUIRE(at != std::string::npos);
      CHECK(table.find(start, at + 1) == std::string::npos);
      const std::string row = table.substr(at, table.find('\n', at) - at);
      CHECK_THAT(row, ContainsSubstring("| " + std::to_string(points_of(name).size()) + " |"));
    }
  }
}

TEST_CASE("profiles/: every file reads back, in mm, as it was written and without defects",
          "[examples]") {
  for (const Strings* names : {&wheel_names, &rail_names}) {
    for (const std::string& name : *names) {
      CAPTURE(name);
      const auto file = file_of(name);
      CHECK(file.units_per_metre.value == 1000);
      CHECK(file.value.value == (name.ends_with(".prr") ? ValueAxis::inward : ValueAxis::outward));
      CHECK(file.lateral.value == LateralAxis::field_side);
      CHECK(file.not_applied.empty());
      REQUIRE(!file.comments.empty());
      CHECK_THAT(file.comments[0], ContainsSubstring(is_wheel(name) ? "S1002 wheel" : " rail, "));
      CHECK((file.comments[0].find("ASSUMPTION") != std::string::npos) ==
            name.starts_with("uic50"));
      // Short decimal numbers: steps of 1e-6 mm, where measured of 1e-4 mm.
      const double step = is_measured(name) ? 1e-7 : 1e-9;
      for (std::size_t i = 0; i < file.points.size(); ++i) {
        for (const double x : {file.points.lateral[i], file.points.value[i]}) {
          CHECK(std::abs(x / step - std::round(x / step)) < 1e-6);
        }
      }
      const auto text = read_text(profiles / name);
      const bool is_same =
          profile_text(
              file.points, file.kind,
              {.format = file.format, .unit = LengthUnit::millimetre, .comments = file.comments}) ==
          text;
      CHECK(is_same);

      const auto findings = diagnose_points(file.points);
      if (name != "60e1_measured.rai") {
        CHECK(findings.empty());
        continue;
      }
      REQUIRE(findings.size() == 2);
      CHECK(findings[0].defect == PointDefect::spike);
      CHECK(findings[0].index == 60);
      CHECK(std::abs(findings[0].measure - 0.5e-3) < 0.1e-3);
      CHECK(findings[1].defect == PointDefect::duplicate);
      CHECK(findings[1].index == 101);
      CHECK(findings[1].measure == 0);
    }
  }
}

TEST_CASE("profiles/: nominal points lie on the profile within their rounding, 0.5 mm apart",
          "[examples][reference]") {
  const auto check = [](const std::string& name, const auto& profile, double lower, double upper) {
    CAPTURE(name);
    const Points points = points_of(name);
    CHECK(points.lateral.front() == lower);
    CHECK(points.lateral.back() == upper);
    bool has_origin = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double u = points.lateral[i];
      CAPTURE(i, u);
      const auto at = profile.evaluate(u);
      has_origin = has_origin || (u == 0 && points.value[i] == 0);
      // Half a step of either coordinate, and beside an end the change of the slope.
      const double across = std::abs(points.value[i] - at.value) / std::hypot(1, at.slope);
      CHECK(across < 0.71e-9);
      if (i == 0) continue;
      const double chord =
          std::hypot(u - points.lateral[i - 1], points.value[i] - points.value[i - 1]);
      const bool is_end = i == 1 || i + 1 == points.size();
      CHECK(chord > (is_end ? 0.25e-3 : 0.499998e-3));
      CHECK(chord < (is_end ? 0.75e-3 : 0.500002e-3));
    }
    CHECK(has_origin);
  };
  for (const char* name : {"s1002.prw", "s1002.whl", "s1002.csv"}) {
    check(name, s1002<double>(), -0.0695, 0.06);
  }
  for (const char* name : {"60e1.prr", "60e1.rai", "60e1.csv"}) {
    check(name, rail_60e1<double>(), -0.036, 0.036);
  }
  CHECK(points_of("uic50.csv").value == points_of("uic50.prr").value);
  for (const char* name : {"uic50.prr", "uic50.csv"}) check(name, uic50<double>(), -0.035, 0.035);
  for (const char* end : {"whl", "csv"}) {
    CHECK(points_of(std::string("s1002.").append(end)).value == points_of("s1002.prw").value);
  }
  for (const char* end : {"rai", "csv"}) {
    CHECK(points_of(std::string("60e1.").append(end)).value == points_of("60e1.prr").value);
  }
}

TEST_CASE("profiles/: worn files have lost what README.md says, where it says, and nothing else",
          "[examples][reference]") {
  struct Bump {
    const char *worn, *unworn;
    double depth, centre, half_length;  // along the unworn profile from lateral 0
  };
  const Bump bumps[] = {{"s1002_hollow_1mm.prw", "s1002.prw", 1e-3, 2e-3, 28e-3},
                        {"s1002_hollow_3mm.prw", "s1002.prw", 3e-3, 2e-3, 28e-3},
                        {"60e1_flat_crown.prr", "60e1.prr", 0.2e-3, 0, 20e-3},
                        {"60e1_gauge_corner.prr", "60e1.prr", 0.6e-3, -32e-3, 9e-3}};
  for (const Bump& bump : bumps) {
    CAPTURE(bump.worn);
    const auto depths = removed(bump.worn, bump.unworn);
    const auto& lateral = points_of(bump.unworn).lateral;
    const auto origin = std::find(lateral.begin(), lateral.end(), 0.0) - lateral.begin();
    int inside = 0;
    for (std::size_t i = 1; i + 1 < depths.size(); ++i) {
      const double length = 0.5e-3 * static_cast<double>(static_cast<std::ptrdiff_t>(i) - origin);
      const double t = (length - bump.centre) / bump.half_length;
      const double expected = t * t < 1 ? bump.depth * std::pow(1 - t * t, 3) : 0;
      CAPTURE(i, length);
      CHECK(std::abs(depths[i] - expected) < 1.5e-9);
      if (expected > 0 && t * t < 1 - 1e-9) ++inside;
    }
    CHECK(inside == static_cast<int>(std::round(bump.half_length / 0.25e-3)) - 1);
    CHECK(std::abs(*std::max_element(depths.begin(), depths.end()) - bump.depth) < 1.5e-9);
  }

  const double face = flange_face(spline_of("s1002.prw"));
  CHECK(std::abs(face - -0.0375) < 1e-6);  // 32.5 mm from the flange back
  for (const char* name : {"s1002_thin_flange.prw", "s1002_worn.csv"}) {
    CHECK(std::abs(flange_face(spline_of(name)) - (face - 3e-3)) < 1e-6);
  }
  const auto thinner = removed("s1002_thin_flange.prw", "s1002.prw");
  const auto both = removed("s1002_worn.csv", "s1002_thin_flange.prw");
  const auto& lateral = points_of("s1002.prw").lateral;
  for (std::size_t i = 0; i < lateral.size(); ++i) {
    CAPTURE(lateral[i]);
    const bool is_face = -0.044 < lateral[i] && lateral[i] < -0.036;
    const bool is_flange = -0.055 < lateral[i] && lateral[i] < -0.020;
    CHECK(thinner[i] < (is_flange ? 3.000002e-3 : 1e-12));
    if (is_face) CHECK(std::abs(thinner[i] - 3e-3) < 2e-9);
    CHECK(both[i] < 2.000002e-3);
  }
  CHECK(std::abs(*std::max_element(both.begin(), both.end()) - 2e-3) < 2e-9);

  // Wear takes away and never adds.
  const auto wheel = s1002<double>();
  for (const std::string& name : wheel_names) {
    const Points points = points_of(name);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto at = wheel.evaluate(points.lateral[i]);
      const double outside = (points.value[i] - at.value) / std::hypot(1, at.slope);
      CAPTURE(name, i);
      CHECK(outside < (is_measured(name) ? 4e-5 : 1e-9));
    }
  }
  const auto head = rail_60e1<double>();
  for (const char* name : {"60e1_flat_crown.prr", "60e1_gauge_corner.prr"}) {
    const Points points = points_of(name);
    for (std::size_t i = 0; i < points.size(); ++i) {
      CHECK(head.closest_point(points.lateral[i], points.value[i]).penetration > -1e-9);
    }
  }
}

TEST_CASE("profiles/: the noise of measured files is 10 um", "[examples][random]") {
  const auto check = [](const Points& points, const Spline& truth) {
    double sum = 0, mean = 0, count = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double u = points.lateral[i];
      if (u < truth.lower() || truth.upper() < u) continue;
      const auto at = truth.evaluate(u);
      const double across = (points.value[i] - at.value) / std::hypot(1, at.slope);
      sum += across * across;
      mean += across;
      count += 1;
    }
    CAPTURE(count);
    CHECK(count > 160);
    // Three standard deviations of a sample's.
    CHECK(std::abs(std::sqrt(sum / count) - 1e-5) < 1e-5 * 3 / std::sqrt(2 * count));
    CHECK(std::abs(mean / count) < 1e-5 * 3 / std::sqrt(count));
  };
  check(points_of("s1002_measured.whl"), spline_of("s1002_hollow_1mm.prw"));
  check(repair_points(points_of("60e1_measured.rai")).points, spline_of("60e1_gauge_corner.prr"));
}

TEST_CASE("profiles/: searches on all pairs are complete and proved", "[examples]") {
  int searches = 0, several = 0;
  // The other files hold the same points.
  const auto is_copy = [](const std::string& name) {
    return name == "s1002.whl" || name == "s1002.csv" || name == "60e1.rai" || name == "60e1.csv" ||
           name == "uic50.csv";
  };
  for (const std::string& wheel_name : wheel_names) {
    if (is_copy(wheel_name)) continue;
    const Wheelset wheelset(spline_of(wheel_name), 0.46, 1.5);
    for (const std::string& rail_name : rail_names) {
      if (is_copy(rail_name)) continue;
      CAPTURE(wheel_name, rail_name);
      const TangentTrack track(spline_of(rail_name), {.gauge = 1.435, .inclination = 0.025});
      require_fit(wheelset, track);
      CHECK(track.rail(Side::left).is_proved_convex());
      for (int i = -7; i <= 7; ++i) {
        for (const double yaw : {0.0, 0.01}) {
          const double shift = 1e-3 * i;
          const auto down = touching_position(wheelset, track, shift, yaw, {.gap = -1e-4});
          CAPTURE(shift, yaw);
          REQUIRE(down.status == SolveStatus::converged);
          for (const Side side : sides) {
            const auto found = find_contact(wheelset.wheel(side), track.rail(side),
                                            place_wheel(wheelset, track, side, down.position));
            CHECK(found.status == SearchStatus::complete);
            CHECK(found.is_proved);
            CHECK(!found.patches.empty());
            ++searches;
            if (found.patches.size() > 1) ++several;
          }
        }
      }
    }
  }
  CHECK(searches == 30 * 60);
  CHECK(several > 20);
}

TEST_CASE("profiles/: the equivalent conicities of README.md", "[examples][regression]") {
  struct Row {
    const char* wheel;
    double on_60e1, on_flat_crown;
  };
  // At an amplitude of 3 mm; the table of README.md.
  const Row rows[] = {{"s1002.prw", 0.177, 0.211},
                      {"s1002_thin_flange.prw", 0.177, 0.211},
                      {"s1002_hollow_1mm.prw", 0.374, 0.370},
                      {"s1002_worn.csv", 0.458, 0.454},
                      {"s1002_hollow_3mm.prw", 0.507, 0.504},
                      {"s1002_measured.whl", 0.372, 0.368}};
  const std::string readme = read_text(profiles / "README.md");
  for (const Row& row : rows) {
    const Wheelset wheelset(spline_of(row.wheel), 0.46, 1.5);
    const std::array<std::pair<const char*, double>, 2> expected{
        {{"60e1.prr", row.on_60e1}, {"60e1_flat_crown.prr", row.on_flat_crown}}};
    std::string text = std::string("| `").append(row.wheel).append("` |");
    for (const auto& [rail, conicity] : expected) {
      CAPTURE(row.wheel, rail);
      const TangentTrack track(spline_of(rail), {.gauge = 1.435, .inclination = 0.025});
      const auto table = kinematics_table(wheelset, track);
      const auto found = equivalent_conicity(RollingRadiusDifference<double>::of(table), 3e-3);
      CHECK(found.status == ConicityStatus::found);
      CHECK(std::abs(found.conicity - conicity) < 0.001);
      char number[16];
      std::snprintf(number, sizeof number, " %.3f |", conicity);
      text += number;
    }
    CHECK_THAT(readme, ContainsSubstring(text));
  }
}

TEST_CASE("write_profiles: --help, and what it refuses", "[examples][bad-input]") {
  const auto help = run_program("write_profiles", {"--help"});
  CHECK(help.exit_code == 0);
  CHECK(help.error.empty());
  CHECK_THAT(help.output, ContainsSubstring("--output DIR"));

  const TemporaryDirectory scratch;
  write_text(scratch / "file", "text");
  struct Case {
    Strings arguments;
    const char* why;
  };
  const Case cases[] = {{{}, "--output must name a directory"},
                        {{"--output="}, "--output must name a directory"},
                        {{"--output"}, "--output: its value is missing"},
                        {{"--output", scratch / "file"}, "must be a directory"},
                        {{"--output", scratch / "file/below"}, "must be a directory"},
                        {{"--output", scratch / "a", "--spacing", "1"}, "unknown option --spacing"},
                        {{"--output", scratch / "a", "b"}, "unknown option b"}};
  for (const Case& at : cases) {
    const auto result = run_program("write_profiles", at.arguments);
    CAPTURE(at.why, result.exit_code, result.output, result.error);
    CHECK(refuses(result, "write_profiles"));
    CHECK_THAT(result.error, ContainsSubstring(at.why));
  }
  CHECK(names_in(scratch.path()) == Strings{"file"});

  // A directory stands where a file is to be written.
  std::filesystem::create_directories(scratch / "b/60e1.rai");
  const auto result = run_program("write_profiles", {"--output", scratch / "b"});
  CHECK(result.exit_code == 2);
  CHECK_THAT(result.error, ContainsSubstring("60e1.rai: cannot be written"));
}
