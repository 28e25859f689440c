// Rigid contact kinematics of a wheelset on a straight track, of profiles by name or from files:
// contact points, rolling radius difference and equivalent conicity as CSV, and their picture.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/arguments.hpp"
#include "support/gnuplot.hpp"
#include "support/kinematics_output.hpp"
#include "support/kinematics_profiles.hpp"
#include "support/output.hpp"

namespace {

using examples::AnyWheel;
using examples::format;
using wheelrail::Side;
using wheelrail::TouchStatus;

// FROM, FROM + STEP ... TO [mm].
struct Shifts {
  double from = 0, step = 0, to = 0;
  int steps = 0;
};

Shifts shifts_of(const examples::Arguments& arguments) {
  const std::string name = "--lateral-shift", text = arguments.text(name);
  const auto refuse = [&](const std::string& rule) {
    throw std::invalid_argument(
        std::string(name).append(" is '").append(text).append("', but ").append(rule));
  };
  double values[3] = {0, 0, 0};
  const char* at = text.c_str();
  for (int i = 0; i < 3; ++i) {
    char* end = nullptr;
    values[i] = std::strtod(at, &end);
    const bool ends_well = i < 2 ? *end == ':' : end == text.c_str() + text.size();
    if (end == at || !ends_well || !std::isfinite(values[i])) {
      refuse("must be FROM:STEP:TO, three finite numbers in mm");
    }
    at = end + 1;
  }
  const auto [from, step, to] = values;
  if (!(step > 0)) refuse("STEP must be > 0");
  if (from < -100 || 100 < to) refuse("FROM and TO must be between -100 and 100 mm");
  if (!(from <= -1) || !(1 <= to)) {
    refuse("FROM must be <= -1 mm and TO >= 1 mm: the least amplitude of a conicity is 1 mm");
  }
  const double count = (to - from) / step;
  if (count > 10000) refuse("there must be at most 10000 steps");
  const double whole = std::round(count);
  if (whole < 1 || std::abs(count - whole) > 1e-6) {
    refuse("TO - FROM must be a whole number of STEPs");
  }
  return {from, step, to, static_cast<int>(whole)};
}

// The range of a table that has all these shifts: its own are counted from the middle.
wheelrail::KinematicsRange<double> range_of(const Shifts& shifts) {
  const int half_count = shifts.steps % 2 == 0 ? shifts.steps / 2 : shifts.steps;
  const double half_width = (shifts.to - shifts.from) / 2e3;
  wheelrail::KinematicsRange<double> range;
  range.lower = 1e-3 * shifts.from;
  range.upper = 1e-3 * shifts.to;
  range.step = half_width / half_count;
  return range;
}

std::vector<examples::ShiftRow> rows_of(const Shifts& shifts,
                                        const wheelrail::KinematicsTable<double>& table) {
  std::vector<examples::ShiftRow> rows;
  std::size_t k = 0;
  for (int i = 0; i <= shifts.steps; ++i) {
    // Free of the rounding of the steps: -0.3 and 0, not -0.30000000000000004 and 1e-17.
    const double shift = std::round(1e9 * (shifts.from + i * shifts.step)) * 1e-9;
    const auto distance = [&](std::size_t j) {
      return std::abs(table.shifts[j].lateral_shift - 1e-3 * (shifts.from + i * shifts.step));
    };
    while (k + 1 < table.shifts.size() && distance(k + 1) <= distance(k)) ++k;
    rows.push_back({shift, table.shifts[k]});
  }
  return rows;
}

// Where a rail is concave, and whether searches on it are proved: a note, or none.
std::vector<std::string> concave_notes(const wheelrail::Rail<examples::AnyRail>& rail) {
  if (rail.is_proved_convex()) return {};
  const auto zones = wheelrail::concave_intervals(rail.profile());
  std::string note = "not proved to be convex, so that no contact is proved to be the only one";
  if (!zones.empty()) {
    note.append(format("; concave zones: %zu, the first from %.4g to %.4g mm", zones.size(),
                       1e3 * zones.front().lower, 1e3 * zones.front().upper));
  }
  return {note};
}

template <class P>
void describe(std::string& text, const char* what, const examples::LoadedProfile<P>& loaded,
              const std::string& more, const std::vector<std::string>& notes = {}) {
  text.append(what).append(": ").append(loaded.name).append(more).append("\n");
  for (const std::string& note : loaded.notes) text.append("  ").append(note).append("\n");
  for (const std::string& note : notes) text.append("  ").append(note).append("\n");
}

wheelrail::RollingRadiusDifference<double> curve_of(const wheelrail::KinematicsTable<double>& table,
                                                    const std::vector<examples::ShiftRow>& rows) {
  try {
    return wheelrail::RollingRadiusDifference<double>::of(table);
  } catch (const std::invalid_argument&) {
    const auto& middle =
        *std::min_element(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
          return std::abs(a.lateral_shift_mm) < std::abs(b.lateral_shift_mm);
        });
    throw std::invalid_argument(format(
        "no two lateral shifts next to 0 have both wheels touching (at %g mm: left wheel %s, "
        "right wheel %s), but they must: profiles, --profile-spacing and --gauge must fit",
        middle.lateral_shift_mm, name_of(middle.kinematics.wheels[0].status),
        name_of(middle.kinematics.wheels[1].status)));
  }
}

// The last part of a path, for the picture.
std::string short_name(const std::string& name) {
  return name.substr(name.find_last_of('/') + 1);
}

int run(const examples::Arguments& arguments) {
  const Shifts shifts = shifts_of(arguments);
  const bool no_roll = arguments.given("--no-roll");
  const bool by_origin = arguments.given("--track-profile");
  if (by_origin && arguments.given("--inclination") && arguments.number("--inclination") != 0) {
    throw std::invalid_argument(
        std::string("--inclination is ")
            .append(arguments.text("--inclination"))
            .append(", but must be 0 with --track-profile: these rails are inclined already"));
  }
  const double inclination = by_origin ? 0.0 : arguments.number("--inclination");
  const bool own_wheel = arguments.given("--right-wheel"),
             own_rail = arguments.given("--right-rail");
  const double left_radius = arguments.positive("--nominal-radius");
  const double right_radius = arguments.given("--right-nominal-radius")
                                  ? arguments.positive("--right-nominal-radius")
                                  : left_radius;
  const double spacing = arguments.positive("--profile-spacing");
  const double gauge = arguments.positive("--gauge");
  // Before anything long.
  static_cast<void>(examples::FileOptions::of(arguments, "wheel"));
  static_cast<void>(examples::FileOptions::of(arguments, "rail"));
  if (arguments.given("--output") && arguments.text("--output").empty()) {
    throw std::invalid_argument("--output is '', but must be a directory's name");
  }

  const auto left_wheel = examples::load_wheel(arguments, "--wheel");
  const auto right_wheel =
      own_wheel ? examples::load_wheel(arguments, "--right-wheel") : left_wheel;
  const auto left_rail = examples::load_rail(arguments, "--rail");
  const auto right_rail = own_rail ? examples::load_rail(arguments, "--right-rail") : left_rail;

  const examples::AnyWheelset wheelset(
      wheelrail::Wheel<AnyWheel>(left_wheel.profile, left_radius),
      wheelrail::Wheel<AnyWheel>(right_wheel.profile, right_radius), spacing);
  const examples::LaidTrack track(left_rail.profile, right_rail.profile,
                                  {.gauge = gauge, .inclination = inclination}, by_origin);
  wheelrail::require_fit(wheelset, track);

  const auto table =
      wheelrail::kinematics_table(wheelset, track, range_of(shifts), {.with_roll = !no_roll});
  int failures = 0;
  for (const auto& at : table.shifts) {
    for (const Side side : wheelrail::sides) {
      const TouchStatus status = at.wheel(side).status;
      const bool has_failed = status == TouchStatus::not_converged ||
                              status == TouchStatus::not_finite ||
                              (side == Side::left && at.status == TouchStatus::not_converged &&
                               status == TouchStatus::touching &&
                               at.wheel(Side::right).status == TouchStatus::touching);
      if (has_failed && failures++ < 10) {
        std::fprintf(stderr, "contact_kinematics: lateral shift %g mm, %s wheel: %s\n",
                     1e3 * at.lateral_shift, name_of(side),
                     name_of(status == TouchStatus::touching ? at.status : status));
      }
    }
  }
  if (failures > 0) {
    std::fprintf(stderr, "contact_kinematics: %d failures, nothing written\n", failures);
    for (const Side side : wheelrail::sides) {
      for (const std::string& note : concave_notes(track.rail(side))) {
        std::fprintf(stderr, "contact_kinematics: %s rail: %s (a higher --noise smooths more)\n",
                     name_of(side), note.c_str());
      }
    }
    return 3;
  }

  const auto rows = rows_of(shifts, table);
  const auto curve = curve_of(table, rows);
  std::vector<examples::ConicityRow> conicities;
  for (int i = 10; i <= 70; ++i) {
    conicities.push_back({i / 10.0, wheelrail::equivalent_conicity(curve, i * 1e-4)});
  }

  std::string summary;
  const auto radius = [](double value) { return format(", nominal radius %.7g mm", 1e3 * value); };
  const auto laid = [&](Side side) {
    std::string text = by_origin ? format(", laid by its origin: %+.4f mm to the field side",
                                          examples::plain(1e3 * track.offset(side)))
                                 : std::string();
    return text;
  };
  describe(summary, own_wheel ? "left wheel" : "wheels", left_wheel,
           radius(left_radius)
               .append(own_wheel || left_radius == right_radius
                           ? ""
                           : format(" (right %.7g mm)", 1e3 * right_radius)));
  if (own_wheel) describe(summary, "right wheel", right_wheel, radius(right_radius));
  describe(summary, own_rail ? "left rail" : "rails", left_rail, laid(Side::left),
           concave_notes(track.rail(Side::left)));
  if (own_rail)
    describe(summary, "right rail", right_rail, laid(Side::right),
             concave_notes(track.rail(Side::right)));
  summary.append(format("track: gauge %.7g mm, inclination %g; tread circles %.7g mm apart; %s\n",
                        1e3 * gauge, inclination, 1e3 * spacing,
                        no_roll ? "no roll" : "with roll"));
  summary.append(examples::kinematics_summary(rows, table, conicities));

  if (!arguments.given("--output")) {
    std::printf("%s", summary.c_str());
    return 0;
  }
  const std::string rolling = examples::rolling_radius_csv(rows);
  const std::string contacts = examples::contact_points_csv(rows);
  const std::string conicity = examples::conicity_csv(conicities);
  const std::string picture = examples::picture_data(wheelset, track, rows);
  const auto directory = examples::prepare_directory(arguments.text("--output"));
  examples::write_file(directory / "rolling_radius_difference.csv", rolling);
  examples::write_file(directory / "contact_points.csv", contacts);
  examples::write_file(directory / "conicity.csv", conicity);
  examples::write_file(directory / "contact_lines.dat", picture);
  std::printf("%s", summary.c_str());
  std::printf("tables: rolling_radius_difference.csv, contact_points.csv, conicity.csv in %s\n",
              directory.string().c_str());
  std::fflush(stdout);
  const std::string title =
      short_name(left_wheel.name)
          .append(own_wheel ? std::string(" / ").append(short_name(right_wheel.name)) : "")
          .append(" on ")
          .append(short_name(left_rail.name))
          .append(own_rail ? std::string(" / ").append(short_name(right_rail.name)) : "")
          .append(format(", gauge %.7g mm", 1e3 * gauge))
          .append(no_roll ? ", no roll" : "");
  const auto drawing = examples::draw(directory, "contact_kinematics", title);
  switch (drawing.status) {
    case examples::DrawStatus::drawn:
      std::printf("picture: contact_kinematics.png and .svg there\n");
      return 0;
    case examples::DrawStatus::no_gnuplot:
      std::printf("picture: not drawn, there is no gnuplot; with it, draw by\n  %s\n",
                  drawing.command.c_str());
      return 0;
    case examples::DrawStatus::failed:
      break;
  }
  std::fprintf(stderr, "contact_kinematics: gnuplot failed; the tables are written; it was\n  %s\n",
               drawing.command.c_str());
  return 3;
}

}  // namespace

int main(int argc, char** argv) {
  examples::Arguments arguments(
      "Sets a wheelset down on a straight track, both rigid, for a range of lateral shifts:\n"
      "contact points, rolling radius difference, equivalent conicity (EN 15302, by integration).\n"
      "\n"
      "Signs: the shift is positive to the left, the difference is left less right radius. EN "
      "15302\n"
      "and UIC 519 list right less left over a shift to the right: minus this one at minus the\n"
      "shift; where both sides are equal, the same table.\n"
      "\n"
      "Profiles: s1002, s1002-convex, uic50 (an assumed 50E4 head), 60e1, or a file: SIMPACK "
      "(prw,\n"
      "prr), MiniProf (whl, ban, rai) or two columns, lateral and value. Lateral 0 of a wheel is "
      "its\n"
      "tread circle. Unit and axes are detected where the file does not state them, and printed;\n"
      "a rail's lateral axis cannot be detected: without --rail-lateral it grows to the field "
      "side.\n"
      "Points with spikes, overhanging ends, duplicates or steps back are refused unless\n"
      "--repair drops them, which is printed. Points are smoothed by --noise.\n"
      "\n"
      "--output DIR writes there, after all was computed:\n"
      "  rolling_radius_difference.csv  lateral_shift_mm,rolling_radius_difference_mm\n"
      "  contact_points.csv             all contact points of each shift and side, with the "
      "status\n"
      "  conicity.csv                   amplitude_mm,conicity: 1 to 7 mm in steps of 0.1\n"
      "  contact_lines.dat              what the picture needs besides\n"
      "  contact_kinematics.png, .svg   the picture, by gnuplot where it is there\n"
      "A field is empty where there is no value; the summary says why. no_contact: the wheel is "
      "not\n"
      "over the rail; profile_end: it stands on an end of a profile; other_wheel_...: the other "
      "one\n"
      "does; out_of_range: the shifts with contact do not reach as far as the amplitude;\n"
      "no_equilibrium, not_restoring: the wheelset is not centred.\n"
      "Conicity comes from these shifts and from more near jumps of a contact point: EN 15302 has\n"
      "steps of 0.1 mm or less.\n"
      "\n"
      "Exit code 0; 2 on bad input, 3 when a contact did not converge or gnuplot failed.",
      {{"--wheel", "NAME|FILE", "s1002", "wheel profile, of the left wheel or both"},
       {"--right-wheel", "NAME|FILE", "", "of the right wheel, if another"},
       {"--rail", "NAME|FILE", "60e1", "rail profile, of the left rail or both"},
       {"--right-rail", "NAME|FILE", "", "of the right rail, if another"},
       {"--nominal-radius", "M", "0.46", "wheel radius at the tread circle [m]"},
       {"--right-nominal-radius", "M", "", "of the right wheel, if another [m]"},
       {"--profile-spacing", "M", "1.5", "lateral distance of the tread circles [m]"},
       {"--gauge", "M", "1.435", "track gauge, 14 mm below the rails' highest points [m]"},
       {"--inclination", "SLOPE", "0.025",
        "of the rails towards the track's middle [-]; 0 for profiles that are inclined already"},
       {"--track-profile", "", "",
        "rails as they are laid, inclined already (inclination 0), with the gauge 14 mm "
        "below\n"
        "                               height 0 of the file, not below the highest point"},
       {"--no-roll", "", "", "the axle stays level, as in EN 15302 and UIC 519"},
       {"--lateral-shift", "FROM:STEP:TO", "-8:0.1:8", "of the axle, to the left [mm]"},
       {"--noise", "UM", "estimate",
        "noise level of a file's points, one standard deviation [um]; 0 interpolates"},
       {"--repair", "", "", "drop bad points of files"},
       {"--unit", "NAME", "detect", "of all files: mm, m or detect"},
       {"--wheel-lateral", "NAME", "detect",
        "lateral of wheel files grows to: field, gauge, detect"},
       {"--rail-lateral", "NAME", "detect", "the same of rail files"},
       {"--wheel-value", "NAME", "detect", "value of wheel files grows: outward, inward, detect"},
       {"--rail-value", "NAME", "detect", "the same of rail files"},
       {"--output", "DIR", "",
        "where tables and picture go; without it only a summary is printed"}});
  return examples::run(argc, argv, arguments,
                       [](const examples::Arguments& given) { return run(given); });
}
