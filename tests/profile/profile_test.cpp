#include <limits>
#include <wheelrail/profile/convex_modification.hpp>
#include <wheelrail/profile/profile.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>

#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::StrictScalar;

namespace {

// A circle of radius 0.5 m in two pieces, cut at 0.1 m: what a user's own profile may look like.
struct Circle {
  using Scalar = double;
  double sign = 1;
  [[nodiscard]] double lower() const { return -0.3; }
  [[nodiscard]] double upper() const { return 0.4; }
  [[nodiscard]] int piece_count() const { return 2; }
  [[nodiscard]] double joint(int i) const { return i == 0 ? -0.3 : i == 1 ? 0.1 : 0.4; }
  [[nodiscard]] ProfilePoint<double> evaluate(double lateral) const {
    const double height = std::sqrt(0.25 - lateral * lateral);
    return {sign * height, -sign * lateral / height, -sign * 0.25 / (height * height * height)};
  }
  [[nodiscard]] ProfilePoint<double> evaluate(int, double lateral) const {
    return evaluate(lateral);
  }
};

struct WithoutPieces {
  using Scalar = double;
  [[nodiscard]] double lower() const { return 0; }
  [[nodiscard]] double upper() const { return 1; }
  [[nodiscard]] ProfilePoint<double> evaluate(double) const { return {}; }
};

struct WithBareNumbers : Circle {
  [[nodiscard]] double evaluate(double) const { return 0; }
};

}  // namespace

TEST_CASE("Profile: every profile of the library and a user's own satisfy the concept",
          "[profile]") {
  STATIC_REQUIRE(Profile<PiecewiseProfile<float>>);
  STATIC_REQUIRE(Profile<PiecewiseProfile<double>>);
  STATIC_REQUIRE(Profile<PiecewiseProfile<long double>>);
  STATIC_REQUIRE(Profile<PiecewiseProfile<StrictScalar>>);
  STATIC_REQUIRE(Profile<RailHead<float>>);
  STATIC_REQUIRE(Profile<RailHead<double>>);
  STATIC_REQUIRE(Profile<RailHead<StrictScalar>>);
  STATIC_REQUIRE(Profile<ConvexModification<PiecewiseProfile<double>>>);
  STATIC_REQUIRE(Profile<ConvexModification<PiecewiseProfile<StrictScalar>>>);
  STATIC_REQUIRE(Profile<ConvexModification<Circle>>);
  STATIC_REQUIRE(Profile<Circle>);
}

TEST_CASE("Profile: refuses what has no pieces or returns bare numbers", "[profile]") {
  STATIC_REQUIRE_FALSE(Profile<WithoutPieces>);
  STATIC_REQUIRE_FALSE(Profile<WithBareNumbers>);
  STATIC_REQUIRE_FALSE(Profile<double>);
}

TEST_CASE("HasClosestPoint: rail heads have one in closed form, piecewise profiles do not",
          "[profile]") {
  STATIC_REQUIRE(HasClosestPoint<RailHead<double>>);
  STATIC_REQUIRE(HasClosestPoint<RailHead<StrictScalar>>);
  STATIC_REQUIRE_FALSE(HasClosestPoint<PiecewiseProfile<double>>);
}

TEST_CASE("curvature: positive where the body is convex, one over the radius everywhere",
          "[profile]") {
  for (const double lateral : {-0.3, -0.1, 0.0, 0.25, 0.4}) {
    CHECK(curvature(Circle{}.evaluate(lateral)) == Approx(2.0).epsilon(1e-14));
    CHECK(curvature(Circle{-1}.evaluate(lateral)) == Approx(-2.0).epsilon(1e-14));
  }
  CHECK(curvature(ProfilePoint<double>{1, 3, 0}) == 0);
}

TEST_CASE("piece_of: inside a piece that piece, at a joint the one on its field side",
          "[profile]") {
  const Circle circle;
  CHECK(piece_of(circle, -0.3) == 0);
  CHECK(piece_of(circle, 0.0) == 0);
  CHECK(piece_of(circle, std::nextafter(0.1, 0.0)) == 0);
  CHECK(piece_of(circle, 0.1) == 1);
  CHECK(piece_of(circle, 0.2) == 1);
  CHECK(piece_of(circle, 0.4) == 1);
}

TEST_CASE("piece_of: among many pieces as among few", "[profile]") {
  for (const int count : {15, 16, 17, 18, 33, 100, 1001}) {
    std::vector<ProfilePiece<double>> pieces;
    for (int i = 0; i < count; ++i) {
      pieces.push_back(ProfilePiece<double>::line(i * i, (i + 1) * (i + 1), 0.0, 0.0, 1.0));
    }
    const PiecewiseProfile<double> profile(std::move(pieces));
    bool all = piece_of(profile, -1.0) == 0 && piece_of(profile, profile.upper()) == count - 1;
    for (int i = 0; i < count; ++i) {
      all = all && piece_of(profile, profile.joint(i)) == i &&
            piece_of(profile, profile.joint(i) + 0.5) == i &&
            (i == 0 || piece_of(profile, std::nextafter(profile.joint(i), 0.0)) == i - 1);
    }
    CAPTURE(count);
    CHECK(all);
  }
}

TEST_CASE("piece_of: each of S1002's pieces begins at its joint", "[profile]") {
  const auto profile = s1002<double>();
  REQUIRE(profile.piece_count() == 8);
  CHECK(profile.joint(0) == profile.lower());
  CHECK(profile.joint(8) == profile.upper());
  for (int piece = 0; piece < 8; ++piece) {
    CHECK(profile.joint(piece) < profile.joint(piece + 1));
    CHECK(piece_of(profile, profile.joint(piece)) == piece);
    CHECK(piece_of(profile, std::nextafter(profile.joint(piece + 1), -1.0)) == piece);
  }
}

TEST_CASE("piece_of: outside the profile the nearest end's piece; a valid one for NaN",
          "[profile][bad-input]") {
  const auto profile = s1002<double>();
  CHECK(piece_of(profile, -1.0) == 0);
  CHECK(piece_of(profile, 1.0) == 7);
  const int piece = piece_of(profile, std::numeric_limits<double>::quiet_NaN());
  CHECK(piece >= 0);
  CHECK(piece < 8);
  CHECK_FALSE(is_finite(profile.evaluate(std::numeric_limits<double>::quiet_NaN()).value));
}
