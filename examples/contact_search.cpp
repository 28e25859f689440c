// Finds the contact patches of a wheelset on a tangent track for given poses, and prints them as
// CSV.

#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "support/arguments.hpp"
#include "support/output.hpp"
#include "support/profiles.hpp"

namespace {

using wheelrail::Side;

struct Pose {
  double lateral_shift, height, roll, yaw;
};

// Reads the poses of a CSV stream. Throws with `name` and the line number.
std::vector<Pose> read_poses(std::istream& in, const std::string& name) {
  const std::string header = "lateral_shift,height,roll,yaw";
  std::vector<Pose> poses;
  std::string line;
  int number = 0;
  const auto fail = [&](const std::string& why) {
    throw std::invalid_argument(name + ":" + std::to_string(number) + ": " + why);
  };
  bool has_header = false;
  int blank = 0;  // the first empty line since the header: they may only end the file
  while (std::getline(in, line)) {
    ++number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (!has_header) {
      if (line != header) fail("the header is '" + line + "', but must be '" + header + "'");
      has_header = true;
      continue;
    }
    if (line.empty()) {
      if (blank == 0) blank = number;
      continue;
    }
    if (blank != 0) {
      number = blank;
      fail("a pose row is missing: the line is empty, and more rows follow");
    }
    double values[4];
    std::size_t begin = 0;
    for (int column = 0; column < 4; ++column) {
      if (begin > line.size()) {
        fail("the row has " + std::to_string(column) + " values, but must have 4: " + header);
      }
      const std::size_t comma = std::min(line.find(',', begin), line.size());
      const std::string field = line.substr(begin, comma - begin);
      char* end = nullptr;
      values[column] = std::strtod(field.c_str(), &end);
      const bool has_digits = end != field.c_str();
      while (*end == ' ') ++end;
      // A zero byte inside the field is not its end.
      const bool whole = end == field.c_str() + field.size();
      if (!has_digits || !whole || !std::isfinite(values[column])) {
        fail("value " + std::to_string(column + 1) + " is '" + field +
             "', but must be a finite number");
      }
      begin = comma + 1;
    }
    if (begin <= line.size()) fail("the row has more than 4 values: " + header);
    for (const int column : {2, 3}) {
      if (std::abs(values[column]) > 1.5) {
        fail(std::string(column == 2 ? "roll" : "yaw") + " is beyond 1.5 rad");
      }
    }
    poses.push_back({values[0], values[1], values[2], values[3]});
  }
  if (in.bad()) throw std::invalid_argument(name + ": cannot be read");
  if (!has_header) {
    number = 1;
    fail("the header is missing: " + header);
  }
  if (poses.empty()) {
    ++number;
    fail("a pose row is missing: the file has only its header");
  }
  return poses;
}

std::vector<Pose> poses_of(const examples::Arguments& arguments) {
  const bool by_value = arguments.given("--lateral-shift") || arguments.given("--height") ||
                        arguments.given("--roll") || arguments.given("--yaw");
  if (!arguments.given("--poses")) {
    if (!arguments.given("--height")) {
      throw std::invalid_argument(
          "give either --poses FILE, or --height and what differs from 0 of "
          "--lateral-shift, --roll and --yaw");
    }
    return {{arguments.number("--lateral-shift"), arguments.number("--height"),
             arguments.within("--roll", -1.5, 1.5), arguments.within("--yaw", -1.5, 1.5)}};
  }
  if (by_value) {
    throw std::invalid_argument("--poses excludes --lateral-shift, --height, --roll and --yaw");
  }
  const std::string path = arguments.text("--poses");
  if (path == "-") return read_poses(std::cin, "standard input");
  std::ifstream file(path);
  if (!file) throw std::invalid_argument("--poses: cannot open '" + path + "'");
  return read_poses(file, path);
}

template <class WheelProfile>
int search(const examples::Arguments& arguments, const WheelProfile& profile) {
  const wheelrail::Wheelset wheelset(profile, arguments.positive("--nominal-radius"),
                                     arguments.positive("--profile-spacing"));
  const wheelrail::TangentTrack track(
      examples::rail_profile(arguments.choice("--rail", examples::rail_names)),
      {.gauge = arguments.positive("--gauge"), .inclination = arguments.number("--inclination")});
  wheelrail::require_fit(wheelset, track);
  const std::string method = arguments.choice("--method", examples::method_names);
  const std::vector<Pose> poses = poses_of(arguments);

  std::printf(
      "pose,side,patch,wheel_lateral,rail_lateral,wheel_angle,longitudinal,penetration,lower,"
      "upper,contact_angle,rolling_radius\n");
  const bool check = method == "minimum-distance" && !wheelrail::concave_intervals(profile).empty();
  int exit_code = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Pose& pose = poses[i];
    const auto position = wheelrail::WheelsetPosition<double>::of(pose.lateral_shift, pose.height,
                                                                  pose.roll, pose.yaw);
    for (const Side side : wheelrail::sides) {
      const auto placement = wheelrail::place_wheel(wheelset, track, side, position);
      const auto found = examples::with_search(method, profile, [&](const auto& find) {
        return find(wheelset.wheel(side), track.rail(side), placement);
      });
      if (found.status != wheelrail::SearchStatus::complete) {
        std::fprintf(stderr, "contact_search: pose %zu, %s wheel: %s\n", i, name_of(side),
                     name_of(found.status));
        exit_code = 3;
      } else if (check &&
                 !examples::same_patches(
                     found.patches,
                     find_contact(wheelset.wheel(side), track.rail(side), placement).patches)) {
        std::fprintf(stderr,
                     "contact_search: pose %zu, %s wheel: the minimum distance method missed a "
                     "patch: it needs a convex wheel\n",
                     i, name_of(side));
        exit_code = 3;
      }
      for (std::size_t k = 0; k < found.patches.size(); ++k) {
        const auto& patch = found.patches[k];
        std::string row = examples::format("%zu,%s,%zu", i, name_of(side), k);
        examples::append_fields(row, 12,
                                {patch.wheel_lateral, patch.rail_lateral, patch.wheel_angle,
                                 patch.longitudinal, patch.penetration, patch.zone_lower,
                                 patch.zone_upper, patch.contact_angle, patch.rolling_radius});
        std::printf("%s\n", row.c_str());
      }
    }
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  examples::Arguments arguments(
      "Finds all contact patches of a wheelset on a tangent track and prints them as CSV.\n"
      "Units are m and rad. Track frame: x forward, y left, z up, the rails' highest points at\n"
      "z = 0. Roll lifts the left wheel, yaw turns to the left. Lateral coordinates of profiles\n"
      "grow towards the field side. `lower` and `upper` bound the zone of overlap in\n"
      "wheel_lateral; nan with --method minimum-distance, which does not know them.\n"
      "Exit code 0; 2 on bad input, 3 when a search failed (said on standard error).",
      {{"--wheel", "NAME", "s1002", "wheel profile: s1002 or s1002-convex"},
       {"--rail", "NAME", "uic50", "rail profile: uic50 (an assumed 50E4 head) or 60e1"},
       {"--nominal-radius", "M", "0.43", "wheel radius at the tread circle [m]"},
       {"--profile-spacing", "M", "1.5", "distance of the wheels' tread circles [m]"},
       {"--gauge", "M", "1.435", "track gauge, 14 mm below the rails' highest points [m]"},
       {"--inclination", "SLOPE", "0.05", "rail inclination towards the track's middle [-]"},
       {"--method", "NAME", "strip", "strip or minimum-distance"},
       {"--poses", "FILE", "", "CSV with the header lateral_shift,height,roll,yaw; - is stdin"},
       {"--lateral-shift", "M", "0", "of the axle's centre, to the left [m]"},
       {"--height", "M", "", "of the axle's centre above the rails' highest points [m]"},
       {"--roll", "RAD", "0", "of the axle, lifting the left wheel [rad]"},
       {"--yaw", "RAD", "0", "of the axle, to the left [rad]"}});
  return examples::run(argc, argv, arguments, [](const examples::Arguments& given) {
    return examples::with_wheel_profile(
        given.choice("--wheel", examples::wheel_names),
        [&](const auto& profile) { return search(given, profile); });
  });
}
