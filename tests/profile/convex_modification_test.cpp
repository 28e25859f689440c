#include <algorithm>
#include <vector>
#include <wheelrail/profile/convex_modification.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::StrictScalar;
using Piece = ProfilePiece<double>;
using Piecewise = PiecewiseProfile<double>;

namespace {

constexpr int grid = 2000;

template <class P>
double grid_lateral(const P& profile, int i) {
  return i == grid ? profile.upper()
                   : profile.lower() + (profile.upper() - profile.lower()) * i / grid;
}

// What must hold for every modified profile: contiguous pieces of the original or straight lines,
// convex inside the pieces and nowhere outside the original; `jump` [m] and `bend` [-] are what
// the original's own joints may leave.
template <class P>
void check_modified(const ConvexModification<P>& modified, double jump, double bend) {
  const P& original = modified.original();
  CHECK(modified.lower() == original.lower());
  CHECK(modified.upper() == original.upper());
  CHECK(modified.joint(0) == original.lower());
  CHECK(modified.joint(modified.piece_count()) == original.upper());
  for (int piece = 0; piece < modified.piece_count(); ++piece) {
    const double lower = modified.joint(piece), upper = modified.joint(piece + 1);
    CAPTURE(piece, lower, upper);
    CHECK(lower < upper);
    for (int i = 0; i <= 50; ++i) {
      const double u = i == 50 ? upper : lower + (upper - lower) * i / 50;
      CHECK(modified.evaluate(piece, u).second_derivative <= 1e-9);
    }
  }
  for (const auto& joint : inspect_joints(modified)) {
    CAPTURE(joint.lateral);
    CHECK(std::abs(joint.value_jump) <= jump);
    const bool corner =
        std::any_of(modified.corners().begin(), modified.corners().end(),
                    [&](const auto& each) { return each.lateral == joint.lateral; });
    // Convex at a joint (the slope falls) but for the corners, which are concave.
    if (corner) {
      CHECK(joint.slope_jump < -1e-3);
    } else {
      CHECK(joint.slope_jump >= -bend);
    }
  }
  for (int i = 0; i <= grid; ++i) {
    const double u = grid_lateral(modified, i);
    const double removed = original.evaluate(u).value - modified.evaluate(u).value;
    CAPTURE(u);
    CHECK(removed >= -jump);
    const bool cut =
        std::any_of(modified.corners().begin(), modified.corners().end(),
                    [&](const auto& each) { return each.zone.lower <= u && u <= each.zone.upper; });
    if (!cut) CHECK(removed == 0);
  }
}

// Two straight lines through (0, 0) of the slopes
// -1 and 0, joined by a fillet of 10 mm.
Piecewise filleted() {
  const double radius = 0.01;
  const double angle = 3.14159265358979323846 / 4;
  // The fillet's centre lies one radius over both lines.
  const double centre = radius * std::tan(angle / 2);
  const double start = centre - radius * std::sin(angle);
  return Piecewise({Piece::line(-0.05, start, 0, 0, -1),
                    Piece::arc(start, centre, centre, radius, radius, false),
                    Piece::line(centre, 0.05, 0, 0, 0)});
}

}  // namespace

TEST_CASE("ConvexModification: S1002's corner is where the paper's is", "[profile][reference]") {
  for (const S1002Form form : {S1002Form::closed, S1002Form::standard}) {
    const ConvexModification modified(s1002<double>(form));
    REQUIRE(modified.corners().size() == 1);
    const auto& corner = modified.corners()[0];
    // [mm]: the tangent of the inflection and the flange face's line meet here.
    CHECK(corner.lateral * 1e3 == Approx(-34.122025969).margin(2e-9).epsilon(0));
    CHECK(corner.value * 1e3 == Approx(0.172828421).margin(2e-9).epsilon(0));
    CHECK(corner.zone.lower * 1e3 == Approx(-38.426669071).margin(1e-9).epsilon(0));
    CHECK(corner.zone.upper * 1e3 == Approx(14.0828242553).margin(1e-9).epsilon(0));
  }
}

TEST_CASE("ConvexModification: at most 5.957 mm of S1002 are removed, at the corner",
          "[profile][reference]") {
  const ConvexModification modified(s1002<double>(S1002Form::standard));
  const double at_corner = modified.original().evaluate(modified.corners()[0].lateral).value -
                           modified.corners()[0].value;
  double largest = 0;
  for (int i = 0; i <= grid; ++i) {
    const double u = grid_lateral(modified, i);
    largest = std::max(largest, modified.original().evaluate(u).value - modified.evaluate(u).value);
  }
  // Section C at -34.122025969 mm in rational arithmetic, less the corner's 0.172828421 mm.
  CHECK(at_corner * 1e3 == Approx(5.957375185).margin(3e-9).epsilon(0));
  CHECK(largest <= at_corner);
  CHECK(largest > 0.99 * at_corner);
}

TEST_CASE("ConvexModification: S1002 becomes convex pieces with one concave corner", "[profile]") {
  // The standard's own joints jump by 6.4e-8 mm and 5.8e-9.
  check_modified(ConvexModification(s1002<double>()), 7e-11, 7e-9);
}

TEST_CASE("ConvexModification: S1002 keeps flange and tread and gains two lines", "[profile]") {
  const ConvexModification modified(s1002<double>());
  // H, G, F, E, two lines, the rest of B, A.
  REQUIRE(modified.piece_count() == 8);
  const double slopes[] = {modified.evaluate(4, -0.036).slope, modified.evaluate(5, 0.0).slope};
  CHECK(slopes[0] == Approx(-2.747477419).epsilon(1e-11));
  CHECK(slopes[1] == Approx(-0.0087208157).margin(1e-10));
  CHECK(modified.evaluate(modified.corners()[0].lateral).slope == slopes[1]);
}

TEST_CASE("ConvexModification: a fillet between two lines is cut down to where they meet",
          "[profile]") {
  const ConvexModification modified(filleted());
  REQUIRE(modified.corners().size() == 1);
  CHECK(modified.corners()[0].lateral == Approx(0).margin(1e-16));
  CHECK(modified.corners()[0].value == Approx(0).margin(1e-16));
  CHECK(modified.piece_count() == 4);
  check_modified(modified, 1e-16, 1e-13);
  for (const double u : {-0.05, -0.03, -0.002, 0.0, 0.001, 0.04}) {
    CHECK(modified.evaluate(u).value == Approx(u < 0 ? -u : 0).margin(1e-16));
  }
}

TEST_CASE("ConvexModification: a dent inside a piece, in closed form", "[profile]") {
  // -x^4 + 2 a^2 x^2 is concave for |x| < a / sqrt(3); the tangents there meet at (0, -a^4 / 3).
  const double a = 0.5;
  const std::vector<double> coefficients{0, 0, 2 * a * a, 0, -1};
  const ConvexModification modified(Piecewise({Piece::polynomial(-1, 1, 0, 1, coefficients)}));
  REQUIRE(modified.corners().size() == 1);
  CHECK(modified.corners()[0].zone.lower == Approx(-a / std::sqrt(3.0)).epsilon(1e-14));
  CHECK(modified.corners()[0].zone.upper == Approx(a / std::sqrt(3.0)).epsilon(1e-14));
  CHECK(modified.corners()[0].lateral == Approx(0).margin(1e-15));
  CHECK(modified.corners()[0].value == Approx(-a * a * a * a / 3).epsilon(1e-14));
  CHECK(modified.piece_count() == 4);
  check_modified(modified, 1e-15, 1e-14);
}

TEST_CASE("ConvexModification: two zones give two corners, also when the profile begins in one",
          "[profile]") {
  const auto bowl = [](double lower, double upper, double centre) {
    return Piece::polynomial(lower, upper, centre, 1, std::vector<double>{0, 0, 1});
  };
  const std::vector<double> cap{1, 2, -2};
  const Piecewise profile({bowl(-2, 0, -1), Piece::polynomial(0, 1, 0, 1, cap), bowl(1, 3, 2)});
  const ConvexModification modified(profile);
  REQUIRE(modified.corners().size() == 2);
  CHECK(modified.corners()[0].zone.lower == -2);
  CHECK(modified.corners()[0].lateral == Approx(-1));
  CHECK(modified.corners()[0].value == Approx(-1));
  CHECK(modified.corners()[1].zone.lower == 1);
  CHECK(modified.corners()[1].zone.upper == 3);
  CHECK(modified.corners()[1].lateral == Approx(2));
  CHECK(modified.corners()[1].value == Approx(-1));
  check_modified(modified, 1e-14, 1e-14);
}

TEST_CASE("ConvexModification: zones with a convex sliver between them are one, in closed form",
          "[profile]") {
  // Two bowls of width 1 and second derivative 2, between them a cap of width w and second
  // derivative -2 k: the slope goes from 0 to 2, down to 2 - 2 k w and up by 2 again. The tangents
  // at the cap's ends meet k w^2 / 2 above its chord, across that by less.
  const auto profile = [](double k, double w) {
    const double slope = 2 - 2 * k * w, value = 1 + 2 * w - k * w * w;
    return Piecewise(
        {Piece::polynomial(0, 1, 0, 1, std::vector<double>{0, 0, 1}),
         Piece::polynomial(1, 1 + w, 1, 1, std::vector<double>{1, 2, -k}),
         Piece::polynomial(1 + w, 2 + w, 1 + w, 1, std::vector<double>{value, slope, 1})});
  };
  const double k = 3, w = 0.1, chord = 2 - k * w;
  const double height = k * w * w / 2 / std::sqrt(1 + chord * chord);
  const Piecewise original = profile(k, w);
  for (const double sliver : {0.0, 0.99 * height}) {
    const ConvexModification<Piecewise> apart(original, sliver);
    REQUIRE(apart.corners().size() == 2);
    CHECK(apart.corners()[0].zone.upper == Approx(1));
    CHECK(apart.corners()[1].zone.lower == Approx(1 + w));
  }
  const ConvexModification<Piecewise> joined(original, 1.01 * height);
  REQUIRE(joined.corners().size() == 1);
  CHECK(joined.corners()[0].zone.lower == 0);
  CHECK(joined.corners()[0].zone.upper == 2 + w);
  // The tangent at the lower end is 0; the other one is `rise` high with the slope `last` there.
  const double last = 4 - 2 * k * w, rise = 1 + 2 * w - k * w * w + (2 - 2 * k * w) + 1;
  CHECK(joined.corners()[0].value == Approx(0).margin(1e-14));
  CHECK(joined.corners()[0].lateral == Approx(2 + w - rise / last));
  check_modified(joined, 1e-14, 1e-14);
  // Where the second zone ends less steep than the first its tangent would cut through this: two.
  const Piecewise steps = profile(12, 0.1);
  CHECK(ConvexModification<Piecewise>(steps, 1.0).corners().size() == 2);
  check_modified(ConvexModification<Piecewise>(steps, 1.0), 1e-14, 1e-14);
  CHECK_THROWS_WITH(
      ConvexModification<Piecewise>(original, -1e-6),
      "convex modification: sliver height is -1e-06, but must be finite and >= 0 [m]");
}

TEST_CASE("ConvexModification: a convex profile stays as it is", "[profile]") {
  const auto rail = rail_60e1<double>();
  const ConvexModification modified(rail);
  CHECK(modified.corners().empty());
  CHECK(modified.piece_count() == rail.piece_count());
  for (int i = 0; i <= grid; ++i) {
    const double u = grid_lateral(rail, i);
    CHECK(modified.evaluate(u).value == rail.evaluate(u).value);
    CHECK(modified.evaluate(u).slope == rail.evaluate(u).slope);
  }
}

TEST_CASE("ConvexModification: tangents that do not meet inside their zone are refused",
          "[profile][bad-input]") {
  // Two bowls with a step between them; the tangents are y = 0 and y = a + b (x - 2).
  const auto stepped = [](double step, double slope) {
    return Piecewise({Piece::polynomial(0, 1, 0, 1, std::vector<double>{0, 0, 1}),
                      Piece::polynomial(1, 2, 1, 1, std::vector<double>{step, slope, 1})});
  };
  const std::string message =
      "convex modification: the tangents at the ends of the concave zone [0, 2] m do not meet "
      "inside it";
  CHECK_THROWS_AS(ConvexModification(stepped(11, 0)), std::invalid_argument);
  CHECK_THROWS_WITH(ConvexModification(stepped(11, 0)), message);
  // Parallel ones never meet.
  CHECK_THROWS_WITH(ConvexModification(stepped(1, -2)), message);
  CHECK_NOTHROW(ConvexModification(stepped(1, 2)));
}

TEST_CASE("ConvexModification: bit for bit the same for a scalar that converts to nothing",
          "[profile]") {
  const ConvexModification modified(s1002<double>());
  const ConvexModification strict(s1002<StrictScalar>());
  REQUIRE(strict.corners().size() == 1);
  CHECK(strict.corners()[0].lateral.as_double() == modified.corners()[0].lateral);
  CHECK(strict.corners()[0].value.as_double() == modified.corners()[0].value);
  int different = 0;
  for (int i = 0; i <= grid; ++i) {
    const double u = grid_lateral(modified, i);
    const auto expected = modified.evaluate(u);
    const auto point = strict.evaluate(StrictScalar(u));
    different += point.value.as_double() == expected.value &&
                         point.slope.as_double() == expected.slope &&
                         point.second_derivative.as_double() == expected.second_derivative
                     ? 0
                     : 1;
  }
  CHECK(different == 0);
}

TEST_CASE("ConvexModification: evaluation does not allocate", "[profile][no-alloc]") {
  const ConvexModification modified(s1002<double>());
  double sum = 0;
  CHECK(wheelrail_test::allocations_of([&] {
          for (int i = 0; i <= grid; ++i) sum += modified.evaluate(grid_lateral(modified, i)).value;
        }) == 0);
  CHECK(sum > 0);
}

TEST_CASE("ConvexModification: a convex corner inside a concave zone is refused",
          "[profile][bad-input]") {
  const std::array<double, 4> cubic{1, 2, -4, 2};
  const std::array<double, 3> parabola{1, -2, 1};  // (x - 2)^2 about x = 1
  const PiecewiseProfile<double> profile(
      {Piece::polynomial(0, 1, 0, 1, cubic), Piece::polynomial(1, 3, 1, 1, parabola)});
  CHECK_THROWS_WITH(ConvexModification(profile),
                    Catch::Matchers::ContainsSubstring("outside the profile"));
}
