#include <Eigen/Core>
#include <type_traits>
#include <unsupported/Eigen/AutoDiff>
#include <wheelrail/core/scalar_value.hpp>

#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::StrictScalar;

namespace {

using Dual = Eigen::AutoDiffScalar<Eigen::Vector2d>;
using SecondOrder = Eigen::AutoDiffScalar<Eigen::Matrix<Dual, 2, 1>>;

// The members of ceres::Jet.
struct JetLike {
  float a{};
  Eigen::Vector3f v = Eigen::Vector3f::Zero();
};

}  // namespace

TEST_CASE("ValueOf: plain scalars are their own values, dual numbers have one inside", "[core]") {
  STATIC_REQUIRE(std::is_same_v<ValueOf<float>, float>);
  STATIC_REQUIRE(std::is_same_v<ValueOf<long double>, long double>);
  STATIC_REQUIRE(std::is_same_v<ValueOf<StrictScalar>, StrictScalar>);
  STATIC_REQUIRE(std::is_same_v<ValueOf<Dual>, double>);
  STATIC_REQUIRE(std::is_same_v<ValueOf<SecondOrder>, double>);
  STATIC_REQUIRE(std::is_same_v<ValueOf<JetLike>, float>);
  STATIC_REQUIRE(!has_derivatives<double>);
  STATIC_REQUIRE(!has_derivatives<StrictScalar>);
  STATIC_REQUIRE(has_derivatives<Dual>);
  STATIC_REQUIRE(ScalarTraits<double>::lifting_steps == 0);
  STATIC_REQUIRE(ScalarTraits<Dual>::lifting_steps == 1);
  STATIC_REQUIRE(ScalarTraits<SecondOrder>::lifting_steps == 2);
  STATIC_REQUIRE(ScalarTraits<JetLike>::lifting_steps == 1);
}

TEST_CASE("value_of: drops derivatives of any order", "[core][autodiff]") {
  CHECK(value_of(1.5) == 1.5);
  CHECK(value_of(StrictScalar(1.5)).as_double() == 1.5);
  CHECK(value_of(Dual(1.5, 2, 0)) == 1.5);
  CHECK(value_of(SecondOrder(Dual(1.5, 2, 0), 2, 1)) == 1.5);
  CHECK(ScalarTraits<JetLike>::value({2.5F}) == 2.5F);
}

TEST_CASE("scalar_cast: makes constants of plain scalars and values of dual ones", "[core]") {
  const Dual dual(1.5, 2, 1);
  CHECK(scalar_cast<double>(dual) == 1.5);
  CHECK(scalar_cast<float>(dual) == 1.5F);
  CHECK(scalar_cast<Dual>(dual).derivatives()(1) == 1);  // the same type: as it is
  const Dual made = scalar_cast<Dual>(1.5F);
  CHECK(made.value() == 1.5);
  CHECK(made.derivatives().isZero());
  const SecondOrder twice = scalar_cast<SecondOrder>(1.5);
  CHECK(twice.value().value() == 1.5);
  CHECK(scalar_cast<StrictScalar>(1.5).as_double() == 1.5);
  CHECK(scalar_cast<float>(1.1) == 1.1F);
  CHECK(scalar_cast<long double>(0.1F) == static_cast<long double>(0.1F));
}
