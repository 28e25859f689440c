// The Manchester benchmark's vehicle 1: its data, its carbody's modes, what examples/vehicle_modes
// prints of them, and that it runs.

#include "support/vehicle_modes.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "../support/catch.hpp"
#include "run_program.hpp"

using namespace examples;
using namespace wheelrail_test;
using Catch::Matchers::ContainsSubstring;

namespace {

std::string path_of(const std::string& name) {
  return std::string(WHEELRAIL_SOURCE_DIR) + "/examples/vehicles/" + name + ".csv";
}

const VehicleData& manchester() {
  static const VehicleData value(path_of("manchester_vehicle1"));
  return value;
}

const VehicleData& manchester_with_unconfirmed() {
  static const VehicleData value(path_of("manchester_vehicle1"), Unconfirmed::used);
  return value;
}

Vehicle built(const VehicleData& data) {
  return build_vehicle(data, VehicleKind::vehicle);
}

// All that a vehicle's data decide.
std::vector<double> numbers_of(const Vehicle& vehicle) {
  std::vector<double> all{vehicle.wheel_radius, vehicle.profile_spacing};
  const auto add = [&](const auto& vector) { all.insert(all.end(), vector.begin(), vector.end()); };
  for (const auto& body : vehicle.model.bodies) {
    const Eigen::Matrix<double, 6, 1> masses = mass_diagonal(body);
    add(masses);
  }
  for (const auto& position : vehicle.positions) add(position);
  for (const auto& element : vehicle.model.spring_dampers) {
    add(element.point_a);
    add(element.point_b);
    add(element.preload_a);
    add(element.series_stiffness_a);
    for (std::size_t i = 0; i < 3; ++i) {
      all.push_back(element.damper[i].force(1));
      for (int mm = 25; mm <= 65; mm += 5) all.push_back(element.spring[i].force(mm / 1000.0));
    }
  }
  for (const auto& spring : vehicle.model.torsion_springs) all.push_back(spring.stiffness);
  return all;
}

// Manchester's file with that value of a quantity.
VehicleData manchester_with(const TemporaryDirectory& scratch, const std::string& quantity,
                            const std::string& value) {
  std::string text = read_text(path_of("manchester_vehicle1"));
  const auto row = text.find("\n" + quantity + ",");
  REQUIRE(row != std::string::npos);
  const auto at = row + quantity.size() + 2;
  text.replace(at, text.find(',', at) - at, value);
  write_text(scratch.path() / "vehicle.csv", text);
  return VehicleData(scratch / "vehicle.csv");
}

// The lower root of (k_c - m_c s) (k_c + k_f - m_f s) = k_c^2, as a frequency: a mass on another.
double two_masses(double upper_stiffness, double upper_mass, double lower_stiffness,
                  double lower_mass) {
  const double sum =
      upper_stiffness / upper_mass + (upper_stiffness + lower_stiffness) / lower_mass;
  const double product = upper_stiffness * lower_stiffness / (upper_mass * lower_mass);
  return std::sqrt((sum - std::sqrt(sum * sum - 4 * product)) / 2) / (2 * wheelrail::pi<double>());
}

const ModeValues& of(const CarbodyModes& modes, CarbodyMode mode) {
  return modes[static_cast<std::size_t>(mode)];
}

}  // namespace

TEST_CASE("manchester vehicle 1: the bodies have the benchmark's masses", "[examples][reference]") {
  const Vehicle vehicle = built(manchester());
  REQUIRE(vehicle.model.bodies.size() == 11);
  double mass = 0, boxes = 0;
  for (std::size_t i = 0; i < vehicle.names.size(); ++i) {
    mass += vehicle.model.bodies[i].mass();
    if (vehicle.names[i].ends_with("axlebox")) boxes += vehicle.model.bodies[i].mass();
  }
  CHECK(mass == Approx(32000 + 2 * 2615 + 4 * 1813).epsilon(1e-14));
  CHECK(boxes == Approx(0.05 * 4 * 1813).epsilon(1e-14));
  CHECK(vehicle.profile_spacing == Approx(1.5).epsilon(1e-15));
  CHECK(vehicle.wheel_radius == 0.46);
  CHECK(vehicle.positions[0].x() - vehicle.positions[2].x() == Approx(2.56));
  CHECK(vehicle.positions[4].x() - vehicle.positions[9].x() == Approx(19));
  CHECK(built(VehicleData(path_of("metro_trailer"))).profile_spacing == 1.5);
}

TEST_CASE("manchester vehicle 1: how much of a wheelset its axleboxes are changes nothing",
          "[examples]") {
  // Both turn and move together but for the spin, so that any share moves alike.
  using namespace wheelrail;
  TemporaryDirectory scratch;
  const auto rates = [&](const std::string& share) {
    const Vehicle vehicle =
        built(manchester_with(scratch, "axlebox body share of the wheelset", share));
    const MultibodySystem<double> system(vehicle.model);
    Eigen::VectorXd y = Eigen::VectorXd::Zero(system.state_size());
    std::vector<Wrench<double>> wrenches(11);
    for (std::size_t i = 0; i < 11; ++i) {
      RigidBodyState<double> state;
      state.position_world = vehicle.positions[i];
      const bool is_frame = vehicle.names[i].ends_with("frame");
      if (is_frame) state.position_world += Vector3<double>(1e-3, 2e-3, -1e-3);
      if (vehicle.names[i].ends_with("wheelset")) {
        state.angular_velocity_body.y() = 40;
        wrenches[i] = {Vector3<double>(3e3, 5e3, 1e5), Vector3<double>(2e3, 400, 1e3)};
      }
      y.segment<13>(RigidBodyLayout::offset(static_cast<Eigen::Index>(i))) = pack(state);
    }
    return system.rate(y, wrenches);
  };
  const auto a = rates("0.05"), b = rates("0.4");
  for (const Eigen::Index wheelset : {0, 2, 5, 7}) {
    const auto accelerations = [&](const Eigen::VectorXd& rate) {
      return rate.segment<6>(13 * wheelset + RigidBodyLayout::velocity_world);
    };
    REQUIRE(accelerations(a).cwiseAbs().minCoeff() > 0.1);
    CHECK((accelerations(a) - accelerations(b)).norm() < 1e-11 * accelerations(a).norm());
  }
}

TEST_CASE("manchester vehicle 1: bump stop and torsion act as the table and the data say",
          "[examples]") {
  const Vehicle vehicle = built(manchester());
  const auto& elements = vehicle.model.spring_dampers;
  REQUIRE(elements.size() == 8 + 4 + 2);
  for (const std::size_t i : {10U, 13U}) {  // behind the two secondary springs of each bogie
    CAPTURE(i);
    const auto& stop = elements[i].spring[1];
    CHECK(stop.force(0.0249) == 0);
    CHECK(stop.force(0.040) == Approx(3730));
    CHECK(stop.force(-0.0575) == Approx(-(17170 + 29200) / 2.0));
    CHECK(stop.slope(0.07) == Approx((230000 - 29200) / 0.005));
    CHECK(elements[i].point_b.z() == Approx(0.65 - 1.8));
    CHECK(elements[i].point_a.z() == Approx(0.65 - 0.6));
    CHECK(elements[i].spring[0].slope(0) == 0);
  }
  REQUIRE(vehicle.model.torsion_springs.size() == 4);
  double stiffness = 0;
  for (const auto& spring : vehicle.model.torsion_springs) stiffness += spring.stiffness;
  CHECK(stiffness == 2 * 940000 + 4 * 10500);
  for (const auto& element : elements) CHECK(element.series_stiffness_a.isZero());
}

TEST_CASE("manchester vehicle 1: unconfirmed values are used when asked for only", "[examples]") {
  CHECK(manchester().left_out().size() == 6);
  CHECK(manchester_with_unconfirmed().left_out().empty());
  CHECK_THROWS_WITH(manchester()["traction rod stiffness"],
                    ContainsSubstring("which is unconfirmed"));
  const Vehicle vehicle = built(manchester_with_unconfirmed());
  const auto& elements = vehicle.model.spring_dampers;
  REQUIRE(elements.size() == 8 + 4 + 2 + 2);
  CHECK(elements[0].series_stiffness_a == wheelrail::Vector3<double>(0, 0, 1e6));
  CHECK(elements[8].series_stiffness_a == wheelrail::Vector3<double>(0, 6e6, 6e6));
  CHECK(elements[11].spring[0].slope(0) == 5e6);
  CHECK(elements[11].damper[0].slope(0) == 25e3);
  CHECK(wheelrail::MultibodySystem<double>(vehicle.model).state_size() == 11 * 13 + 8 + 2 * 4);
}

TEST_CASE("vehicle data: every row of the files has its unit and changes the vehicle",
          "[examples]") {
  TemporaryDirectory scratch;
  std::set<std::string> names;
  for (const std::string file : {"manchester_vehicle1", "metro_trailer"}) {
    std::string text = read_text(path_of(file));
    if (file == "metro_trailer") {  // what neither file has
      for (const char* row :
           {"primary damper series kx per box", "primary damper series ky per box",
            "secondary damper series kx per side"}) {
        text += std::string(row) + ",1000000,N/m,assumed\n";
      }
    }
    const auto changed = [&](const Strings& lines, std::size_t i, const std::string& to) {
      std::string all;
      for (std::size_t k = 0; k < lines.size(); ++k) all += (k == i ? to : lines[k]) + "\n";
      write_text(scratch.path() / "vehicle.csv", all);
      return numbers_of(built(VehicleData(scratch / "vehicle.csv", Unconfirmed::used)));
    };
    const Strings lines = lines_of(text);
    const auto before = changed(lines, 0, lines[0]);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (lines[i].starts_with("#") || lines[i].starts_with("quantity,")) continue;
      const Strings fields = fields_of(lines[i]);
      CAPTURE(lines[i]);
      const double value = std::stod(fields[1]);
      const std::string more = std::to_string(value == 0 ? 1 : 1.01 * value);
      CHECK(changed(lines, i, fields[0] + "," + more + "," + fields[2]) != before);
      const std::string where = std::string("vehicle.csv:")
                                    .append(std::to_string(i + 1))
                                    .append(": '")
                                    .append(fields[0])
                                    .append("'");
      CHECK_THROWS_WITH(
          changed(lines, i, fields[0] + "," + fields[1] + "," + fields[2] + "m,confirmed"),
          ContainsSubstring(where + ": unit is '" + fields[2] + "m', but must be '" + fields[2] +
                            "'"));
      CHECK_THROWS_WITH(changed(lines, i, fields[0] + "," + fields[1] + ",,unconfirmed"),
                        ContainsSubstring(where + ": unit is '', but"));
      CHECK_THROWS_WITH(changed(lines, i, fields[0] + "s," + fields[1] + "," + fields[2]),
                        ContainsSubstring("vehicle.csv:" + std::to_string(i + 1) + ": '" +
                                          fields[0] + "s' is no quantity of a vehicle"));
      names.insert(fields[0].substr(0, fields[0].find(" at ")));
    }
  }
  // So there is no quantity that may stand in a file but is not read.
  for (const auto& [name, rule] : vehicle_quantities()) {
    CAPTURE(name);
    CHECK(names.contains(name));
  }
}

TEST_CASE("vehicle data: what says nothing where it stands is refused", "[examples][bad-input]") {
  TemporaryDirectory scratch;
  const auto with = [&](const char* file, const std::string& rows) {
    write_text(scratch.path() / "vehicle.csv", read_text(path_of(file)) + rows);
    return VehicleData(scratch / "vehicle.csv");
  };
  const auto refused = [&](const char* file, const std::string& row, const std::string& why) {
    CAPTURE(row);
    CHECK_THROWS_WITH(with(file, row + "\n"),
                      ContainsSubstring("vehicle.csv:") && ContainsSubstring(why));
  };
  refused("metro_trailer", "flying mass,5,kg", ":41: 'flying mass' is no quantity of a vehicle");
  for (const char* name : {"lateral bump stop force 30 mm", "lateral bump stop force at 30 cm",
                           "lateral bump stop force at mm", "lateral bump stop force at nan mm",
                           "lateral bump stop force", "bump stop force at 30 mm", ""}) {
    refused("metro_trailer", std::string(name).append(",1,N"),
            std::string("'").append(name).append("' is no quantity of a vehicle"));
  }
  const std::string rod = "' says nothing without 'traction rod stiffness'";
  refused("metro_trailer", "traction rod damping,1,N s/m", ":41: 'traction rod damping" + rod);
  refused("metro_trailer", "traction rod height above rail,1,m", "height above rail" + rod);
  refused("metro_trailer", "lateral bump stop height above rail,1,m",
          "says nothing without 'lateral bump stop force'");
  refused("metro_trailer", "tread circle to flange back,0.07,m",
          "says nothing without 'wheel flange back to back'");
  refused("metro_trailer", "axlebox body share of the wheelset,0.1,-",
          "says nothing beside 'axlebox body share of the wheelset'");
  // Beside what is left out as unconfirmed, it may stand.
  const std::string unconfirmed = "traction rod stiffness,1,N/m,unconfirmed\n";
  CHECK(with("metro_trailer", unconfirmed + "traction rod damping,1,N s/m\n").left_out() ==
        Strings{"traction rod stiffness"});
  // The same place in other words.
  const VehicleData twice =
      with("manchester_vehicle1", "lateral bump stop force at 30.0 mm,600,N\n");
  CHECK_THROWS_WITH(built(twice),
                    ContainsSubstring("vehicle.csv:") && ContainsSubstring(" mm' is given twice"));
}

TEST_CASE("carbody_modes: frequencies and damping ratios are those by hand",
          "[examples][reference]") {
  // Both are exact for small motions; what is left is the rounding of differences, a 1e-9 of the
  // stiffest spring's share.
  for (const char* name : {"manchester_vehicle1", "metro_trailer"}) {
    const VehicleData data(path_of(name));
    const CarbodyModes modes = carbody_modes(built(data));
    const CarbodyModes by_hand = modes_by_hand(data).with_frames;
    for (std::size_t i = 0; i < modes.size(); ++i) {
      CAPTURE(name, carbody_mode_names[i]);
      CHECK(modes[i].undamped_frequency == Approx(by_hand[i].undamped_frequency).epsilon(1e-7));
      CHECK(modes[i].natural_frequency == Approx(by_hand[i].natural_frequency).epsilon(1e-7));
      CHECK(modes[i].damping_ratio == Approx(by_hand[i].damping_ratio).epsilon(1e-7));
    }
  }
}

TEST_CASE("carbody_modes: Manchester's bounce, pitch and sways by formulae of one line",
          "[examples][reference]") {
  const CarbodyModes modes = carbody_modes(built(manchester()));
  const double mass = 32000, primary = 8 * 1220e3, secondary = 4 * 430e3, frames = 2 * 2615;
  CHECK(of(modes, CarbodyMode::bounce).undamped_frequency ==
        Approx(two_masses(secondary, mass, primary, frames)).epsilon(1e-7));
  // Seen over a bogie, the inertia is Iyy / 9.5^2. This leaves out the longitudinal springs 0.97 m
  // below the centre of mass, 0.4 % of the stiffness, by which pitch and surge are coupled too, and
  // the weight, of which the same arm makes 0.2 %.
  CHECK(of(modes, CarbodyMode::pitch).undamped_frequency ==
        Approx(two_masses(secondary, 1970000 / (9.5 * 9.5), primary, frames)).epsilon(0.004));
  // Rigid frames: y over the springs, roll against springs, bars and weight.
  const double ky = 4 * 160e3, down = 1.8 - 0.8275;
  const double roll = secondary + 2 * 940e3 + 4 * 10.5e3 + ky * down * down - mass * 9.81 * down;
  const double a = ky / mass, b = roll / 56800, c = ky * down * ky * down / (mass * 56800);
  const double root = std::sqrt((a - b) * (a - b) / 4 + c);
  const CarbodyModes rigid = modes_by_hand(manchester()).rigid;
  const double turn = 2 * wheelrail::pi<double>();
  CHECK(of(rigid, CarbodyMode::lower_sway).undamped_frequency ==
        Approx(std::sqrt((a + b) / 2 - root) / turn).epsilon(1e-12));
  CHECK(of(rigid, CarbodyMode::upper_sway).undamped_frequency ==
        Approx(std::sqrt((a + b) / 2 + root) / turn).epsilon(1e-12));
  // Moving frames make everything softer.
  for (std::size_t i = 0; i < modes.size(); ++i) {
    CHECK(modes[i].undamped_frequency < rigid[i].undamped_frequency);
    CHECK(modes[i].undamped_frequency > 0.85 * rigid[i].undamped_frequency);
  }
  const auto& lower = of(modes, CarbodyMode::lower_sway);
  const auto& upper = of(modes, CarbodyMode::upper_sway);
  CHECK(lower.undamped_frequency < upper.undamped_frequency);
  CHECK(lower.rotation_centre < 0.8275);
  CHECK(upper.rotation_centre > 1.8);
}

TEST_CASE("carbody_modes: strong dampers end oscillations or lock the springs beside them",
          "[examples]") {
  TemporaryDirectory scratch;
  const std::string cy = "secondary cy per side";
  struct Damping {
    std::string quantity, value;
  };
  for (const auto& [quantity, value] :
       {Damping{cy, "64000"}, {cy, "96000"}, {cy, "320000"}, {"secondary cz per side", "400000"}}) {
    const VehicleData data = manchester_with(scratch, quantity, value);
    const CarbodyModes modes = carbody_modes(built(data));
    const CarbodyModes by_hand = modes_by_hand(data).with_frames;
    for (std::size_t i = 0; i < modes.size(); ++i) {
      CAPTURE(quantity, value, carbody_mode_names[i]);
      CHECK(modes[i].undamped_frequency == Approx(by_hand[i].undamped_frequency).epsilon(1e-7));
      CHECK(modes[i].natural_frequency == Approx(by_hand[i].natural_frequency).epsilon(1e-6));
      CHECK(modes[i].damping_ratio == Approx(by_hand[i].damping_ratio).epsilon(1e-6));
    }
  }
  // Yaw on rigid frames is one oscillator: c / (2 sqrt(k m)) with the arms of 9.5 m and 1 m.
  const auto yaw_ratio = [](double c) {
    return 4 * c * 90.25 / (2 * std::sqrt(4 * 160e3 * (90.25 + 1) * 1970000));
  };
  const auto threefold = manchester_with(scratch, cy, "96000");
  CHECK(of(modes_by_hand(threefold).rigid, CarbodyMode::yaw).damping_ratio ==
        Approx(yaw_ratio(96e3)).epsilon(1e-9));
  const CarbodyModes modes = carbody_modes(built(threefold));
  CHECK(yaw_ratio(96e3) > 1.5);
  CHECK(of(modes, CarbodyMode::yaw).damping_ratio > 1.5);
  CHECK(of(modes, CarbodyMode::upper_sway).damping_ratio > 1.5);
  // What still oscillates is the roll about the dampers.
  CHECK(of(modes, CarbodyMode::lower_sway).damping_ratio < 0.3);
  // Dampers that hardly give: carbody and frames bounce as one on the primary springs.
  const auto locked =
      carbody_modes(built(manchester_with(scratch, "secondary cz per side", "1e7")));
  CHECK(of(locked, CarbodyMode::bounce).natural_frequency ==
        Approx(std::sqrt(8 * 1220e3 / (32000 + 2 * 2615)) / (2 * wheelrail::pi<double>()))
            .epsilon(1e-3));
}

TEST_CASE("carbody_modes: a vehicle that springs do not hold is refused", "[examples][bad-input]") {
  TemporaryDirectory scratch;
  const auto refused = [&](const char* quantity, const char* value, const char* what) {
    const VehicleData data = manchester_with(scratch, quantity, value);
    CAPTURE(quantity, value);
    CHECK_THROWS_WITH(
        carbody_modes(built(data)),
        ContainsSubstring("the springs do not hold the vehicle") && ContainsSubstring(what));
    const auto result = run_program("vehicle_modes", {"--vehicle", scratch / "vehicle.csv"});
    CHECK(refuses(result, "vehicle_modes"));
    CHECK_THAT(result.error, ContainsSubstring("the springs do not hold the vehicle"));
  };
  refused("secondary kz per side", "0", "the carbody's z");
  refused("secondary kx per side", "0", "the carbody's x");
  refused("carbody mass", "32000000", "the carbody's x");  // which falls over on its springs
}

TEST_CASE("carbody_modes: unconfirmed dampers' springs and rods change what they hold",
          "[examples]") {
  const CarbodyModes before = carbody_modes(built(manchester()));
  const CarbodyModes after = carbody_modes(built(manchester_with_unconfirmed()));
  const CarbodyModes by_hand = modes_by_hand(manchester_with_unconfirmed()).with_frames;
  for (std::size_t i = 0; i < before.size(); ++i) {
    // Series springs are gone with the dampers; rods hold x, which pitch takes part in.
    CAPTURE(carbody_mode_names[i]);
    CHECK(after[i].undamped_frequency == Approx(by_hand[i].undamped_frequency).epsilon(1e-7));
    // Springs in series with the dampers make all modes faster; but rods make the carbody pitch about
    // where they hold it, 1.2 m below its centre, where its inertia is greater.
    if (i != static_cast<std::size_t>(CarbodyMode::pitch)) {
      CHECK(after[i].natural_frequency > 1.001 * before[i].natural_frequency);
    }
  }
  // Two rods in series with the frames' primary springs: 1e7 N/m and 6.4e5 N/m beside.
  CHECK(of(after, CarbodyMode::surge).undamped_frequency ==
        Approx(std::sqrt(1.064e7 / 32000) / (2 * wheelrail::pi<double>())).epsilon(0.03));
}

TEST_CASE("vehicle_modes: prints the modes, those by hand and what is unconfirmed", "[examples]") {
  const auto result = run_program("vehicle_modes", {});
  REQUIRE(result.exit_code == 0);
  CHECK(result.error.empty());
  CHECK_THAT(result.output, ContainsSubstring("mass: 44482 kg\n") &&
                                ContainsSubstring("- traction rod stiffness\n"));
  const CarbodyModes by_hand = modes_by_hand(manchester()).with_frames;
  int tables = 0;
  for (std::size_t i = 0; i < by_hand.size(); ++i) {
    tables = 0;
    for (const std::string& line : lines_of(result.output)) {
      if (!line.starts_with(std::string("| ") + carbody_mode_names[i] + " ")) continue;
      std::vector<std::string> cells;
      for (std::size_t begin = 1; begin < line.size();) {
        const auto end = line.find('|', begin);
        cells.push_back(line.substr(begin, end - begin));
        begin = end + 1;
      }
      if (++tables > 1) continue;
      REQUIRE(cells.size() == 9);
      CHECK(std::stod(cells[1]) == Approx(by_hand[i].undamped_frequency).margin(6e-5));
      CHECK(std::stod(cells[2]) == Approx(by_hand[i].undamped_frequency).margin(6e-5));
      CHECK(std::stod(cells[4]) == Approx(by_hand[i].natural_frequency).margin(6e-5));
      CHECK(std::stod(cells[6]) == Approx(by_hand[i].damping_ratio).margin(6e-5));
      CHECK(std::stod(cells[7]) == Approx(by_hand[i].damping_ratio).margin(6e-5));
    }
    CHECK(tables == 2);
  }
  const auto metro = run_program("vehicle_modes", {"--vehicle", path_of("metro_trailer")});
  CHECK(metro.exit_code == 0);
  CHECK_THAT(metro.output,
             ContainsSubstring("mass: 28640 kg") && !ContainsSubstring("unconfirmed"));
}

TEST_CASE("vehicle_modes: says where a mode is overdamped", "[examples]") {
  TemporaryDirectory scratch;
  manchester_with(scratch, "secondary cy per side", "96000");
  const auto result = run_program("vehicle_modes", {"--vehicle", scratch / "vehicle.csv"});
  CHECK(result.exit_code == 0);
  CHECK(result.error.empty());
  int rows = 0;
  for (const std::string& line : lines_of(result.output)) {
    CAPTURE(line);
    const bool is_first_table = std::count(line.begin(), line.end(), '|') == 10;
    if (!is_first_table || !(line.starts_with("| yaw") || line.starts_with("| upper sway")))
      continue;
    CHECK_THAT(line, ContainsSubstring("|  overdamped |   overdamped |"));
    ++rows;
  }
  CHECK(rows == 2);
  CHECK_THAT(result.output, !ContainsSubstring("nan"));
}

TEST_CASE("vehicle_modes: --help has the units, bad input is one line and exit code 2",
          "[examples][bad-input]") {
  const auto help = run_program("vehicle_modes", {"--help"});
  CHECK(help.exit_code == 0);
  CHECK_THAT(help.output, ContainsSubstring("--vehicle") && ContainsSubstring("[Hz]") &&
                              ContainsSubstring("[m]"));
  TemporaryDirectory scratch;
  write_text(scratch.path() / "short.csv", "quantity,value,unit\nwheel radius,0.43,m\n");
  for (const Strings& arguments :
       {Strings{"--vehicle", scratch / "none.csv"}, Strings{"--vehicle", scratch / "short.csv"},
        Strings{"--vehicle"}, Strings{"--speed", "1"}}) {
    CAPTURE(arguments.back());
    CHECK(refuses(run_program("vehicle_modes", arguments), "vehicle_modes"));
  }
}

TEST_CASE("manchester vehicle 1: it runs on its own wheels on the curve's approach", "[examples]") {
  const auto result = run_program(
      "vehicle_on_curved_track",
      {"--vehicle", path_of("manchester_vehicle1"), "--duration", "0.2", "--speed", "20"});
  CAPTURE(result.error, result.output);
  CHECK(result.exit_code == 0);
  CHECK(result.error.empty());
  CHECK_THAT(result.output, ContainsSubstring("status: finished"));
}
