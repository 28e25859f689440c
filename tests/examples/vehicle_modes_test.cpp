// The Manchester benchmark's vehicle 1: its data, its carbody's modes, what examples/vehicle_modes
// prints of them, and that it runs.

#include "support/vehicle_modes.hpp"

#include <cmath>
#include <vector>

#include "../support/catch.hpp"
#include "run_program.hpp"

using namespace examples;
using namespace wheelrail_test;
using Catch::Matchers::Contains;

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
    std::string text = read_text(path_of("manchester_vehicle1"));
    const std::string row = "axlebox body share of the wheelset,";
    const auto at = text.find(row) + row.size();
    text.replace(at, text.find(',', at) - at, share);
    write_text(scratch.path() / "vehicle.csv", text);
    const Vehicle vehicle = built(VehicleData(scratch / "vehicle.csv"));
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
  CHECK_THROWS_WITH(manchester()["traction rod stiffness"], Contains("which is unconfirmed"));
  const Vehicle vehicle = built(manchester_with_unconfirmed());
  const auto& elements = vehicle.model.spring_dampers;
  REQUIRE(elements.size() == 8 + 4 + 2 + 2);
  CHECK(elements[0].series_stiffness_a == wheelrail::Vector3<double>(0, 0, 1e6));
  CHECK(elements[8].series_stiffness_a == wheelrail::Vector3<double>(0, 6e6, 6e6));
  CHECK(elements[11].spring[0].slope(0) == 5e6);
  CHECK(elements[11].damper[0].slope(0) == 25e3);
  CHECK(wheelrail::MultibodySystem<double>(vehicle.model).state_size() == 11 * 13 + 8 + 2 * 4);

  TemporaryDirectory scratch;
  write_text(scratch.path() / "odd.csv",
             "quantity,value,unit\nstop at 5 mm,1,N\nstop at 10 cm,2,N\n");
  CHECK_THROWS_WITH(VehicleData(scratch / "odd.csv").table("stop"), Contains("'stop at 10 cm'"));
  write_text(scratch.path() / "twice.csv",
             "quantity,value,unit,source\na,1,m,unconfirmed\na,2,m,confirmed\n");
  CHECK_THROWS_WITH(VehicleData(scratch / "twice.csv"), Contains("given twice"));
}

TEST_CASE("carbody_modes: frequencies and damping ratios are the closed forms'",
          "[examples][reference]") {
  // Both are exact for small motions; what is left is the rounding of differences, a 1e-9 of the
  // stiffest spring's share.
  for (const char* name : {"manchester_vehicle1", "metro_trailer"}) {
    const VehicleData data(path_of(name));
    const CarbodyModes modes = carbody_modes(built(data));
    const CarbodyModes forms = closed_forms(data).with_frames;
    for (std::size_t i = 0; i < modes.size(); ++i) {
      CAPTURE(name, carbody_mode_names[i]);
      CHECK(modes[i].undamped_frequency == Approx(forms[i].undamped_frequency).epsilon(1e-7));
      CHECK(modes[i].natural_frequency == Approx(forms[i].natural_frequency).epsilon(1e-7));
      CHECK(modes[i].damping_ratio == Approx(forms[i].damping_ratio).epsilon(1e-7));
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
  const CarbodyModes rigid = closed_forms(manchester()).rigid;
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

TEST_CASE("carbody_modes: unconfirmed dampers' springs and rods change what they hold",
          "[examples]") {
  const CarbodyModes before = carbody_modes(built(manchester()));
  const CarbodyModes after = carbody_modes(built(manchester_with_unconfirmed()));
  const CarbodyModes forms = closed_forms(manchester_with_unconfirmed()).with_frames;
  for (std::size_t i = 0; i < before.size(); ++i) {
    // Series springs are gone with the dampers; rods hold x, which pitch takes part in.
    CAPTURE(carbody_mode_names[i]);
    CHECK(after[i].undamped_frequency == Approx(forms[i].undamped_frequency).epsilon(1e-7));
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

TEST_CASE("vehicle_modes: prints the modes, their closed forms and what is unconfirmed",
          "[examples]") {
  const auto result = run_program("vehicle_modes", {});
  REQUIRE(result.exit_code == 0);
  CHECK(result.error.empty());
  CHECK_THAT(result.output, Contains("mass: 44482 kg\n") && Contains("- traction rod stiffness\n"));
  const CarbodyModes forms = closed_forms(manchester()).with_frames;
  int tables = 0;
  for (std::size_t i = 0; i < forms.size(); ++i) {
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
      CHECK(std::stod(cells[1]) == Approx(forms[i].undamped_frequency).margin(6e-5));
      CHECK(std::stod(cells[2]) == Approx(forms[i].undamped_frequency).margin(6e-5));
      CHECK(std::stod(cells[4]) == Approx(forms[i].natural_frequency).margin(6e-5));
      CHECK(std::stod(cells[6]) == Approx(forms[i].damping_ratio).margin(6e-5));
      CHECK(std::stod(cells[7]) == Approx(forms[i].damping_ratio).margin(6e-5));
    }
    CHECK(tables == 2);
  }
  const auto metro = run_program("vehicle_modes", {"--vehicle", path_of("metro_trailer")});
  CHECK(metro.exit_code == 0);
  CHECK_THAT(metro.output, Contains("mass: 28640 kg") && !Contains("unconfirmed"));
}

TEST_CASE("vehicle_modes: --help has the units, bad input is one line and exit code 2",
          "[examples][bad-input]") {
  const auto help = run_program("vehicle_modes", {"--help"});
  CHECK(help.exit_code == 0);
  CHECK_THAT(help.output, Contains("--vehicle") && Contains("[Hz]") && Contains("[m]"));
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
  CHECK_THAT(result.output, Contains("status: finished"));
}
