#include "vehicle_modes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <initializer_list>
#include <stdexcept>
#include <wheelrail/dynamics/multibody_system.hpp>

namespace examples {

namespace detail {

double share_in(const Eigen::VectorXcd& x, const Eigen::VectorXcd& y,
                const Eigen::VectorXd& masses) {
  const Eigen::VectorXcd momentum = masses.asDiagonal() * y;
  const double size = masses.dot(x.cwiseAbs2()) * masses.dot(y.cwiseAbs2());
  return size > 0 ? std::norm(x.dot(momentum)) / size : 0.0;
}

std::vector<DampedValues> follow(const std::vector<Eigen::VectorXcd>& modes,
                                 const std::vector<Motion>& motions,
                                 const Eigen::VectorXd& masses) {
  struct Pair {
    double share;
    std::size_t mode, motion;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    for (std::size_t k = 0; k < motions.size(); ++k) {
      pairs.push_back({share_in(modes[i], motions[k].shape, masses), i, k});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.share > b.share; });
  std::vector<std::vector<std::complex<double>>> eigenvalues(modes.size());  // two of each
  std::vector<bool> is_taken(motions.size(), false);
  for (const bool oscillates : {true, false}) {
    for (const Pair& pair : pairs) {
      const std::complex<double> value = motions[pair.motion].eigenvalue;
      auto& own = eigenvalues[pair.mode];
      if ((value.imag() != 0) != oscillates || is_taken[pair.motion] || own.size() == 2) continue;
      own.push_back(value);
      if (oscillates) own.push_back(std::conj(value));
      is_taken[pair.motion] = true;
    }
  }
  std::vector<DampedValues> result(modes.size());
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const auto& own = eigenvalues[i];
    if (own.size() < 2) continue;
    const double size = std::sqrt((own[0] * own[1]).real());
    result[i] = {size / (2 * wheelrail::pi<double>()), -(own[0] + own[1]).real() / 2 / size};
  }
  return result;
}

std::array<std::size_t, 6> identify(const std::vector<Eigen::VectorXcd>& modes,
                                    const Eigen::VectorXd& masses) {
  const auto share = [&](std::size_t mode, std::initializer_list<Eigen::Index> coordinates) {
    const Eigen::VectorXd energy = masses.cwiseProduct(modes[mode].cwiseAbs2());
    double sum = 0;
    for (const Eigen::Index i : coordinates) sum += energy(i);
    return sum / energy.sum();
  };
  const auto greatest = [&](std::initializer_list<Eigen::Index> coordinates, const auto& counts) {
    std::size_t best = modes.size();
    for (std::size_t mode = 0; mode < modes.size(); ++mode) {
      const bool is_better =
          best == modes.size() || share(best, coordinates) < share(mode, coordinates);
      if (counts(modes[mode]) && is_better) best = mode;
    }
    return best;
  };
  const auto any = [](const auto&) { return true; };
  // A point at the height h over the centre of mass moves sideways by y - h roll.
  const auto centre = [](const auto& shape) { return (shape(1) * std::conj(shape(3))).real(); };
  const std::array<std::size_t, 6> found{
      greatest({2}, any),
      greatest({4}, any),
      greatest({1, 3}, [&](const auto& mode) { return centre(mode) < 0; }),
      greatest({1, 3}, [&](const auto& mode) { return centre(mode) > 0; }),
      greatest({5}, any),
      greatest({0}, any)};
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t k = 0; k <= i; ++k) {
      if (found[i] == modes.size() || (k < i && found[i] == found[k])) {
        throw std::runtime_error(std::string("no mode can be told to be the carbody's ") +
                                 carbody_mode_names[i]);
      }
    }
  }
  return found;
}

void require_oscillations(const std::vector<wheelrail::Eigenmode<double>>& modes,
                          const Eigen::VectorXd& masses,
                          const std::vector<std::string>& coordinates) {
  for (const auto& mode : modes) {
    const bool oscillates =
        mode.frequency > 1e-4 * modes.back().frequency && std::abs(mode.damping_ratio) < 0.01;
    if (oscillates) continue;
    Eigen::Index greatest = 0;
    masses.cwiseProduct(mode.shape.cwiseAbs2()).maxCoeff(&greatest);
    throw std::runtime_error("the springs do not hold the vehicle: without dampers " +
                             coordinates[static_cast<std::size_t>(greatest)] +
                             " does not oscillate, so that there are no modes");
  }
}

}  // namespace detail

CarbodyModes carbody_modes(const Vehicle& vehicle) {
  using namespace wheelrail;
  const MultibodySystem<double> system(vehicle.model);
  Eigen::VectorXd standing = Eigen::VectorXd::Zero(system.state_size());
  std::vector<int> bodies{static_cast<int>(vehicle.names.size()) - 1};  // the carbody is the last
  for (std::size_t i = 0; i < vehicle.names.size(); ++i) {
    RigidBodyState<double> state;
    state.position_world = vehicle.positions[i];
    standing.segment<13>(RigidBodyLayout::offset(static_cast<Eigen::Index>(i))) = pack(state);
    if (vehicle.names[i].ends_with("bogie frame")) bodies.push_back(static_cast<int>(i));
  }
  std::vector<BodyDisplacement> coordinates;
  std::vector<std::string> coordinate_names;
  Eigen::VectorXd masses(static_cast<Eigen::Index>(6 * bodies.size()));
  for (const int body : bodies) {
    masses.segment<6>(static_cast<Eigen::Index>(coordinates.size())) =
        mass_diagonal(vehicle.model.bodies[static_cast<std::size_t>(body)]);
    const char* directions[] = {"x", "y", "z", "roll", "pitch", "yaw"};
    for (int i = 0; i < 6; ++i) {
      coordinates.push_back({body, static_cast<Displacement>(i)});
      coordinate_names.push_back("the " + vehicle.names[static_cast<std::size_t>(body)] + "'s " +
                                 directions[i]);
    }
  }
  const std::vector<Wrench<double>> none(system.body_count());
  const auto damped =
      linearize(system, standing, coordinates, [&](const Eigen::VectorXd&) { return none; });
  if (!(damped.residual < 1e-6)) throw std::runtime_error("the vehicle is not at rest");
  const auto undamped_modes = eigenmodes(undamped(damped)).modes;
  detail::require_oscillations(undamped_modes, masses, coordinate_names);
  std::vector<Eigen::VectorXcd> shapes;
  for (const auto& mode : undamped_modes) shapes.push_back(mode.shape);
  std::vector<detail::Motion> motions;
  for (const auto& mode : eigenmodes(damped).modes) {
    motions.push_back({mode.eigenvalue, mode.shape});
  }
  const auto values = detail::follow(shapes, motions, masses);
  const auto identified = detail::identify(shapes, masses);
  CarbodyModes result;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const std::size_t mode = identified[i];
    const bool sways = i == static_cast<std::size_t>(CarbodyMode::lower_sway) ||
                       i == static_cast<std::size_t>(CarbodyMode::upper_sway);
    const double centre = (shapes[mode](1) / shapes[mode](3)).real();
    result[i] = {undamped_modes[mode].frequency, values[mode].frequency, values[mode].damping_ratio,
                 sways ? vehicle.positions.back().z() + centre : 0.0};
  }
  return result;
}

namespace detail {

// M q'' + C q' + K q = 0 with a diagonal M.
struct SmallSystem {
  Eigen::MatrixXd mass, damping, stiffness;

  explicit SmallSystem(std::initializer_list<double> masses)
      : mass(Eigen::VectorXd::Map(masses.begin(), static_cast<Eigen::Index>(masses.size()))
                 .asDiagonal()),
        damping(Eigen::MatrixXd::Zero(mass.rows(), mass.rows())),
        stiffness(damping) {}

  // A spring and a damper whose elongation is this combination of the coordinates.
  void add(double k, double c, std::initializer_list<double> elongation) {
    const auto e =
        Eigen::VectorXd::Map(elongation.begin(), static_cast<Eigen::Index>(elongation.size()));
    stiffness += k * e * e.transpose();
    damping += c * e * e.transpose();
  }
  // The potential energy k q_i q_j; k q_i^2 / 2 for i = j.
  void add_energy(double k, Eigen::Index i, Eigen::Index j) {
    stiffness(i, j) += k;
    if (i != j) stiffness(j, i) += k;
  }

  // Held but for its first n coordinates.
  [[nodiscard]] SmallSystem first(Eigen::Index n) const {
    SmallSystem part({});
    part.mass = mass.topLeftCorner(n, n);
    part.damping = damping.topLeftCorner(n, n);
    part.stiffness = stiffness.topLeftCorner(n, n);
    return part;
  }

  // Its mode in which the coordinate has the greatest share of the kinetic energy.
  [[nodiscard]] ModeValues mode_of(Eigen::Index coordinate) const {
    return mode_where([&](const auto& shape) { return std::abs(shape(coordinate)); });
  }

  // Of those modes in which the first two coordinates have this sign to each other, the one in which
  // they have the greatest share of the kinetic energy.
  [[nodiscard]] ModeValues mode_of_two(double sign) const {
    return mode_where([&](const auto& shape) {
      const double energy = mass(0, 0) * shape(0) * shape(0) + mass(1, 1) * shape(1) * shape(1);
      return sign * shape(0) * shape(1) > 0 ? energy : 0.0;
    });
  }

 private:
  // @param measure of shapes that have the kinetic energy 1.
  template <class Measure>
  [[nodiscard]] ModeValues mode_where(const Measure& measure) const {
    const Eigen::Index n = mass.rows();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> undamped(stiffness, mass);
    Eigen::Index mode = 0;
    std::vector<Eigen::VectorXcd> shapes;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::VectorXd shape = undamped.eigenvectors().col(i);
      if (measure(undamped.eigenvectors().col(mode)) < measure(shape)) mode = i;
      shapes.emplace_back(shape.cast<std::complex<double>>());
    }
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    matrix.topRightCorner(n, n).setIdentity();
    matrix.bottomLeftCorner(n, n) = -mass.inverse() * stiffness;
    matrix.bottomRightCorner(n, n) = -mass.inverse() * damping;
    const Eigen::EigenSolver<Eigen::MatrixXd> damped(matrix);
    std::vector<Motion> motions;
    for (Eigen::Index i = 0; i < 2 * n; ++i) {
      const std::complex<double> value = damped.eigenvalues()(i);
      if (value.imag() >= 0) motions.push_back({value, damped.eigenvectors().col(i).head(n)});
    }
    const auto values = follow(shapes, motions, mass.diagonal())[static_cast<std::size_t>(mode)];
    return {std::sqrt(undamped.eigenvalues()(mode)) / (2 * wheelrail::pi<double>()),
            values.frequency, values.damping_ratio, 0};
  }
};

}  // namespace detail

ModesByHand modes_by_hand(const VehicleData& data) {
  const auto optional = [&](const char* name) { return data.has(name) ? data[name] : 0.0; };
  struct Suspension {
    std::array<double, 3> k, c;  // of the whole vehicle
  };
  const auto suspension = [&](const std::string& name, const std::string& per, double count) {
    Suspension s;
    const char* axes[] = {"x", "y", "z"};
    for (std::size_t i = 0; i < 3; ++i) {
      s.k[i] = count * data[name + " k" + axes[i] + " " + per];
      s.c[i] = count * data[name + " c" + axes[i] + " " + per];
    }
    return s;
  };
  const Suspension primary = suspension("primary", "per box", 8);
  const Suspension secondary = suspension("secondary", "per side", 4);
  const double bar = 2 * optional("anti-roll bar stiffness per bogie") +
                     4 * optional("secondary bending stiffness per side");
  const double half_spacing = data["bogie spacing"] / 2, square = half_spacing * half_spacing;
  const double reach1 = data["primary lateral semi-distance"];
  const double reach2 = data["secondary lateral semi-distance"];
  const double frame_height = data["bogie frame centre of mass height"];
  const double spring_height = data["secondary height above rail"];
  const double half_base = data["bogie wheelbase"] / 2;
  const double carbody_height = data["carbody centre of mass height"];
  const double down = carbody_height - spring_height;        // from the carbody to the springs
  const double up = spring_height - frame_height;            // from the frame to them
  const double lower = frame_height - data["wheel radius"];  // from the frame to the axles
  const double mass = data["carbody mass"], frames = 2 * data["bogie frame mass"];
  const double frames_roll = 2 * data["bogie frame Ixx"];
  const double weight = 9.81 * mass, total = weight + 9.81 * frames;

  // z of the carbody and of the frames.
  detail::SmallSystem bounce({mass, frames});
  bounce.add(secondary.k[2], secondary.c[2], {1, -1});
  bounce.add(primary.k[2], primary.c[2], {0, 1});

  // x and pitch of the carbody; x, z and pitch of the frames, of which z is the opposite at the rear.
  // The carbody's pitch counts as the way down of its place over the front bogie.
  detail::SmallSystem vertical(
      {mass, data["carbody Iyy"] / square, frames, frames, 2 * data["bogie frame Iyy"]});
  vertical.add(secondary.k[0], secondary.c[0], {1, -down / half_spacing, -1, 0, -up});
  vertical.add(secondary.k[2], secondary.c[2], {0, 1, 0, -1, 0});
  vertical.add(primary.k[0], primary.c[0], {0, 0, 1, 0, -lower});
  vertical.add(primary.k[2], primary.c[2], {0, 0, 0, 1, 0});
  vertical.add(primary.k[2], primary.c[2], {0, 0, 0, 0, half_base});
  if (data.has("traction rod stiffness")) {
    const double rod = data["traction rod height above rail"];
    vertical.add(2 * data["traction rod stiffness"], 2 * data["traction rod damping"],
                 {1, (rod - carbody_height) / half_spacing, -1, 0, frame_height - rod});
  }
  vertical.add_energy(-weight * down / square, 1, 1);
  vertical.add_energy(-weight, 0, 4);
  vertical.add_energy(weight * down / half_spacing, 1, 4);
  vertical.add_energy(weight - total, 2, 4);
  vertical.add_energy(weight * up + total * lower, 4, 4);

  // y and roll of the frames, which all lateral motions share: coordinates i and i + 1.
  const auto add_frames = [&](detail::SmallSystem& s, Eigen::Index i) {
    s.add_energy(total - weight, i, i + 1);
    s.add_energy(weight * up + total * lower, i + 1, i + 1);
  };
  // y and roll of the carbody and of the frames.
  detail::SmallSystem sway({mass, data["carbody Ixx"], frames, frames_roll});
  sway.add(secondary.k[1], secondary.c[1], {1, down, -1, up});
  sway.add(secondary.k[2], secondary.c[2], {0, reach2, 0, -reach2});
  sway.add(bar, 0, {0, 1, 0, -1});
  sway.add(primary.k[1], primary.c[1], {0, 0, 1, lower});
  sway.add(primary.k[2], primary.c[2], {0, 0, 0, reach1});
  sway.add_energy(-weight * down, 1, 1);
  sway.add_energy(weight, 0, 3);
  sway.add_energy(weight * down, 1, 3);
  add_frames(sway, 2);

  // Yaw of the carbody; y, roll and yaw of the frames, of which y and roll are the opposite at the
  // rear. The carbody's yaw counts as the way aside of its place over the front bogie.
  detail::SmallSystem yaw(
      {data["carbody Izz"] / square, frames, frames_roll, 2 * data["bogie frame Izz"]});
  yaw.add(secondary.k[1], secondary.c[1], {1, -1, up, 0});
  yaw.add(secondary.k[0], secondary.c[0], {reach2 / half_spacing, 0, 0, -reach2});
  yaw.add(secondary.k[2], secondary.c[2], {0, 0, reach2, 0});
  yaw.add(bar, 0, {0, 0, 1, 0});
  yaw.add(primary.k[1], primary.c[1], {0, 1, lower, 0});
  yaw.add(primary.k[1], primary.c[1], {0, 0, 0, half_base});
  yaw.add(primary.k[0], primary.c[0], {0, 0, 0, reach1});
  yaw.add(primary.k[2], primary.c[2], {0, 0, reach1, 0});
  yaw.add_energy(weight, 0, 2);
  add_frames(yaw, 1);

  const auto forms = [&](bool frames_held) -> CarbodyModes {
    const auto part = [&](const detail::SmallSystem& s, Eigen::Index carbody_coordinates) {
      return frames_held ? s.first(carbody_coordinates) : s;
    };
    const auto z = part(bounce, 1), xz = part(vertical, 2), y = part(sway, 2), psi = part(yaw, 1);
    return {z.mode_of(0),     xz.mode_of(1),  y.mode_of_two(-1),
            y.mode_of_two(1), psi.mode_of(0), xz.mode_of(0)};
  };
  return {forms(false), forms(true)};
}

}  // namespace examples
