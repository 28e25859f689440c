#include <limits>
#include <stdexcept>
#include <wheelrail/dynamics/multibody_model.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

using V3 = Vector3<double>;

MultibodyModel<double> good() {
  MultibodyModel<double> model;
  for (int i = 0; i < 3; ++i) model.bodies.emplace_back(2.0, V3(1, 1, 1));
  model.joints.emplace_back(0, V3(0, 0, 0), V3(0, 1, 0), 1, V3(0, 0, 1), V3(0, 1, 0));
  SpringDamper<double> spring;
  spring.b = 2;
  model.spring_dampers.push_back(spring);
  model.torsion_springs.push_back({.a = 1, .b = 2, .stiffness = 1});
  return model;
}

template <class Spoil>
std::string message_after(Spoil&& spoil) {
  MultibodyModel<double> model = good();
  spoil(model);
  try {
    static_cast<void>(detail::require_valid(model, 3));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "(nothing was thrown)";
}

}  // namespace

TEST_CASE("MultibodyModel: what does not fit together is refused by name",
          "[dynamics][multibody_model][bad-input]") {
  using Catch::Matchers::ContainsSubstring;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(message_after([](auto&) {}), ContainsSubstring("nothing was thrown"));
  CHECK_THAT(message_after([](auto& m) { m.bodies.clear(); }),
             ContainsSubstring("number of bodies is 0"));
  CHECK_THAT(message_after([](auto& m) { m.bodies.push_back(m.bodies[0]); }),
             ContainsSubstring("number of bodies is 4") && ContainsSubstring("from 1 to 3"));
  CHECK_THAT(message_after([](auto& m) { m.bodies.resize(1, m.bodies[0]); }),
             ContainsSubstring("joints[0].b is 1"));
  CHECK_THAT(message_after([](auto& m) { m.spring_dampers[0].a = 3; }),
             ContainsSubstring("spring_dampers[0].a is 3"));
  CHECK_THAT(message_after([](auto& m) { m.torsion_springs[0].stiffness = -1; }),
             ContainsSubstring("torsion_springs[0].stiffness is -1"));
  CHECK_THAT(message_after([&](auto& m) { m.gravity_world.z() = nan; }),
             ContainsSubstring("gravity_world.z"));
  CHECK_THAT(message_after([](auto& m) { m.baumgarte_alpha = -5; }),
             ContainsSubstring("baumgarte_alpha is -5"));
  CHECK_THAT(message_after([](auto& m) { m.baumgarte_beta = -5; }),
             ContainsSubstring("baumgarte_beta is -5"));
}
