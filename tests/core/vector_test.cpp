#include <random>
#include <wheelrail/core/vector.hpp>

#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::StrictScalar;

TEST_CASE("vectors: unaligned, so that a struct that holds them needs no care", "[core]") {
  STATIC_REQUIRE(alignof(Vector2<double>) == alignof(double));
  STATIC_REQUIRE(alignof(Vector3<double>) == alignof(double));
  STATIC_REQUIRE(alignof(Vector4<double>) == alignof(double));
  STATIC_REQUIRE(alignof(Matrix3<double>) == alignof(double));
  STATIC_REQUIRE(sizeof(Vector4<float>) == 4 * sizeof(float));
}

TEST_CASE("cross: the axes of a right-handed frame", "[core]") {
  const Vector3<double> x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  CHECK(cross(x, y) == z);
  CHECK(cross(y, z) == x);
  CHECK(cross(z, x) == y);
  CHECK(cross(y, x) == -z);
}

TEST_CASE("cross: square to both, as long as the parallelogram is large", "[core][random]") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> component(-1.0, 1.0);
  const auto draw = [&] {
    const double x = component(random), y = component(random), z = component(random);
    return Vector3<double>(x, y, z);
  };
  int skew = 0;
  for (int i = 0; i < 200; ++i) {
    const Vector3<double> a = draw(), b = draw();
    const Vector3<double> product = cross(a, b);
    CHECK(std::abs(product.dot(a)) < 1e-15);
    CHECK(std::abs(product.dot(b)) < 1e-15);
    CHECK(product.squaredNorm() ==
          Approx(a.squaredNorm() * b.squaredNorm() - a.dot(b) * a.dot(b)).margin(1e-15));
    skew += product.norm() > 0.1 ? 1 : 0;
  }
  CHECK(skew > 150);
}

TEST_CASE("cross: the same for a scalar that converts to nothing", "[core]") {
  const auto strict = [](double x, double y, double z) {
    return Vector3<StrictScalar>(StrictScalar(x), StrictScalar(y), StrictScalar(z));
  };
  const auto product = cross(strict(1, 2, 3), strict(-4, 5, 7));
  const auto expected = cross(Vector3<double>(1, 2, 3), Vector3<double>(-4, 5, 7));
  for (int i = 0; i < 3; ++i) CHECK(product[i].as_double() == expected[i]);
}

TEST_CASE("dot: the sum of the products, for a scalar that converts to nothing too", "[core]") {
  CHECK(dot(Vector3<double>(1, 2, 3), Vector3<double>(-4, 5, 7)) == 27);
  const Vector3<StrictScalar> a(StrictScalar(1), StrictScalar(2), StrictScalar(3));
  CHECK(dot(a, a).as_double() == 14);
}
