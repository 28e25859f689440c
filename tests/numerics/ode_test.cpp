#include <wheelrail/numerics/dormand_prince.hpp>
#include <wheelrail/numerics/ode.hpp>

#include "support/catch.hpp"

using namespace wheelrail;
using Column = Eigen::Matrix<double, 2, 1>;

namespace {
struct Decay {
  Column operator()(double, const Column& y) const { return -y; }
};
struct NoRate {
  int operator()(double, const Column&) const { return 0; }
};
}  // namespace

TEST_CASE("StateVector, RightHandSide: columns of a real scalar and their rates", "[numerics]") {
  STATIC_REQUIRE(StateVector<Column>);
  STATIC_REQUIRE(StateVector<Eigen::VectorXd>);
  STATIC_REQUIRE_FALSE(StateVector<Eigen::MatrixXd>);
  STATIC_REQUIRE_FALSE(StateVector<Eigen::VectorXi>);
  STATIC_REQUIRE_FALSE(StateVector<double>);
  STATIC_REQUIRE(RightHandSide<Decay, Column>);
  STATIC_REQUIRE_FALSE(RightHandSide<NoRate, Column>);
}

TEST_CASE("DormandPrinceOptions: each option out of its range is named", "[numerics][bad-input]") {
  using Catch::Matchers::ContainsSubstring;
  using Options = DormandPrinceOptions<double>;
  const auto with = [](const Options& options) { return DormandPrince<Column>(options); };
  CHECK_THROWS_WITH(with({.relative_tolerance = -1e-3}),
                    ContainsSubstring("relative_tolerance is -0.001"));
  CHECK_THROWS_WITH(with({.absolute_tolerance = 0}), ContainsSubstring("absolute_tolerance is 0"));
  CHECK_THROWS_WITH(with({.maximum_step = -1}), ContainsSubstring("maximum_step is -1"));
  CHECK_THROWS_WITH(with({.initial_step = std::nan("")}), ContainsSubstring("initial_step is"));
  CHECK_THROWS_WITH(with({.maximum_steps = 0}), ContainsSubstring("maximum_steps is 0"));
  CHECK_NOTHROW(with({}));
}

TEST_CASE("name_of: every step status has its name", "[numerics]") {
  CHECK(std::string(name_of(StepStatus::stepped)) == "stepped");
  CHECK(std::string(name_of(StepStatus::step_too_small)) == "step_too_small");
  CHECK(std::string(name_of(StepStatus::not_finite)) == "not_finite");
  CHECK(std::string(name_of(StepStatus::step_limit)) == "step_limit");
}
