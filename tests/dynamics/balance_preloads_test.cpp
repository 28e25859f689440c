#include <limits>
#include <stdexcept>
#include <vector>
#include <wheelrail/dynamics/balance_preloads.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

using V3 = Vector3<double>;
using Load = Wrench<double>;
using System = MultibodySystem<double>;
using enum Displacement;

// A car on two springs per side, over a frame that rests on four to the ground.
MultibodyModel<double> car_on_frame() {
  MultibodyModel<double> model;
  model.bodies.emplace_back(2000.0, V3(1200, 1100, 2200));
  model.bodies.emplace_back(20000.0, V3(32e3, 40e3, 40e3));
  const auto add = [&model](int a, int b, double x, double y) {
    SpringDamper<double> s;
    s.a = a;
    s.b = b;
    s.point_a = s.point_b = V3(x, y, 0);
    s.spring.fill(Characteristic<double>::linear(3e5));
    model.spring_dampers.push_back(s);
  };
  for (const double x : {1.05, -1.05}) {
    for (const double y : {0.95, -0.95}) add(ground_body, 0, x, y);
  }
  for (const double x : {0.5, -0.5}) {
    for (const double y : {0.9, -0.9}) add(0, 1, x, y);
  }
  return model;
}

Eigen::VectorXd at_rest() {
  Eigen::VectorXd y(26);
  y << pack(RigidBodyState<double>{}), pack(RigidBodyState<double>{});
  return y;
}

const std::vector<PreloadComponent> vertical{{0}, {1}, {2}, {3}, {4}, {5}, {6}, {7}};
const std::vector<BodyDisplacement> carried{{0, z}, {0, roll}, {0, pitch},
                                            {1, z}, {1, roll}, {1, pitch}};

}  // namespace

TEST_CASE("balance_preloads: springs that stand symmetrically share the weight equally",
          "[dynamics][balance_preloads][reference]") {
  const System system(car_on_frame());
  const std::vector<Load> none(2);
  const auto balance = balance_preloads<double>(system, at_rest(), vertical, carried, none);
  CHECK(balance.status == SolveStatus::converged);
  for (std::size_t i = 0; i < 8; ++i) {
    const V3& preload = balance.model.spring_dampers[i].preload_a;
    CHECK(preload.z() == Approx((i < 4 ? 22000 : 20000) * 9.81 / 4).epsilon(1e-9));
    CHECK(preload.head<2>() == Eigen::Vector2d::Zero());
  }
  const Eigen::VectorXd rate = System(balance.model).rate(at_rest(), none);
  CHECK(rate.cwiseAbs().maxCoeff() < 1e-8);
}

TEST_CASE("balance_preloads: a load off the middle tilts the preloads",
          "[dynamics][balance_preloads]") {
  const System system(car_on_frame());
  std::vector<Load> loads(2);
  loads[1] = {V3(0, 0, -1000), V3(300, -500, 0)};
  const auto balance = balance_preloads<double>(system, at_rest(), vertical, carried, loads);
  CHECK(balance.status == SolveStatus::converged);
  double force = 0, roll_moment = 0, pitch_moment = 0;
  for (std::size_t i = 4; i < 8; ++i) {
    const auto& s = balance.model.spring_dampers[i];
    force += s.preload_a.z();
    roll_moment += s.preload_a.z() * s.point_b.y();
    pitch_moment -= s.preload_a.z() * s.point_b.x();
  }
  CHECK(force == Approx(20000 * 9.81 + 1000));
  CHECK(roll_moment == Approx(-300));
  CHECK(pitch_moment == Approx(500));
}

TEST_CASE("balance_preloads: what vertical springs cannot hold is reported",
          "[dynamics][balance_preloads][bad-input]") {
  using Catch::Matchers::ContainsSubstring;
  const System system(car_on_frame());
  std::vector<Load> sideways(2);
  sideways[1].force_world.y() = 2000;
  const std::vector<BodyDisplacement> lateral{{1, Displacement::y}};
  const auto failed = balance_preloads<double>(system, at_rest(), vertical, lateral, sideways);
  CHECK(failed.status == SolveStatus::iteration_limit);
  CHECK(failed.residual == Approx(0.1));
  std::vector<Load> broken(2);
  broken[1].force_world.z() = std::numeric_limits<double>::quiet_NaN();
  CHECK(balance_preloads<double>(system, at_rest(), vertical, carried, broken).status ==
        SolveStatus::not_finite);

  const auto with = [&](const std::vector<PreloadComponent>& preloads,
                        const std::vector<BodyDisplacement>& coordinates) {
    return balance_preloads<double>(system, at_rest(), preloads, coordinates, sideways);
  };
  CHECK_THROWS_WITH(with({{8}}, carried), ContainsSubstring("preloads[0].spring_damper is 8"));
  CHECK_THROWS_WITH(with({{0}, {1, 3}}, carried), ContainsSubstring("preloads[1].axis is 3"));
  CHECK_THROWS_WITH(with(vertical, {{2, z}}), ContainsSubstring("coordinates[0].body is 2"));
}

TEMPLATE_TEST_CASE("balance_preloads: other scalars", "[dynamics][balance_preloads]", long double) {
  using T = TestType;
  MultibodyModel<T> model;
  model.bodies.emplace_back(T(2), Vector3<T>(T(1), T(1), T(1)));
  SpringDamper<T> spring;
  spring.b = 0;
  model.spring_dampers.push_back(spring);
  const std::vector<Wrench<T>> none(1);
  const std::vector<PreloadComponent> one{{0}};
  const std::vector<BodyDisplacement> height{{0, z}};
  const auto balance =
      balance_preloads<T>(MultibodySystem<T>(model), pack(RigidBodyState<T>{}), one, height, none);
  CHECK(balance.status == SolveStatus::converged);
  CHECK(static_cast<double>(balance.model.spring_dampers[0].preload_a.z()) ==
        Approx(19.62).epsilon(1e-5));
}
