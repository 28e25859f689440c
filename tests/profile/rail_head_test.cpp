#include <algorithm>
#include <limits>
#include <random>
#include <vector>
#include <wheelrail/profile/inspection.hpp>
#include <wheelrail/profile/rail_head.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::StrictScalar;

namespace {

// All in mm: the joints crown-shoulder, shoulder-corner and corner-side, and the centres of the
// shoulder (R80) and corner (R13) arcs; the crown's (R300) is (0, -300). Each row is one set of
// tangent arcs R300, R80, R13 with sides 1:20, computed apart from this library from two numbers.
struct HeadRow {
  const char* name;  // and what the row was computed from
  double lateral[3], up[3];
  double shoulder_lateral, shoulder_up, corner_lateral, corner_up;
};
constexpr HeadRow rows[] = {
    {"60E1: half widths 10.228 and 26.0265 of its joints, GENSYS documentation",
     {10.228, 26.0265, 35.999810822},
     {-0.174404001, -2.302524061, -14.299958024},
     7.500533333,
     -80.127896268,
     23.016030417,
     -14.949147045},
    {"UIC60 21-52: joints at 10.5 and 26, fitted to CAD and a point list",
     {10.5, 26.0, 36.010030405},
     {-0.183806308, -2.255975174, -14.262093773},
     7.7,
     -80.134791292,
     23.02625,
     -14.911282793},
    {"UIC60 of SIMPACK and the Manchester benchmark: joint at 10.5, width 72, fit to 3e-7 mm",
     {10.5, 25.98802439, 36.000000832},
     {-0.183806308, -2.253162111, -14.259737833},
     7.7,
     -80.134791292,
     23.016220427,
     -14.908926853},
    {"54E1: half widths 10.012 and 24.8635 of its joints",
     {10.012, 24.8635, 35.000058322},
     {-0.167113452, -2.064867923, -14.100052218},
     7.342133333,
     -80.122549864,
     22.016277917,
     -14.749241238},
    {"UIC50 (50E4): width 70, depth 14.1 assumed to be that of 54E1",
     {10.012279237, 24.863390629, 35.0},
     {-0.167122776, -2.064804246, -14.1},
     7.342338107,
     -80.122556702,
     22.016219594,
     -14.749189020},
};

// R300, R80, R13, sides 1:20 kept to 35 mm; width and depth in m.
RailHeadDimensions<double> dimensions(double width, double depth) {
  return {0.3, 0.08, 0.013, width, depth, 0.05, 0.035};
}

// Joints and centres of a head against a row, to `margin` mm.
void check_row(const RailHead<double>& rail, const HeadRow& row, double margin) {
  CAPTURE(row.name);
  const double radii[] = {300, 80, 13};
  const double centre_lateral[] = {0, row.shoulder_lateral, row.corner_lateral};
  const double centre_up[] = {-300, row.shoulder_up, row.corner_up};
  for (int arc = 0; arc < 3; ++arc) {
    CAPTURE(arc);
    const double end = rail.joint(4 + arc);
    const auto point = rail.evaluate(3 + arc, end);
    CHECK(end * 1e3 == Approx(row.lateral[arc]).margin(margin).epsilon(0));
    CHECK(point.value * 1e3 == Approx(row.up[arc]).margin(margin).epsilon(0));
    // The centre lies one radius inwards along the normal, (-slope, 1) / length.
    const double radius = 1e3 / curvature(point);
    const double length = std::hypot(1.0, point.slope);
    CHECK(radius == Approx(radii[arc]).epsilon(1e-11));
    CHECK(end * 1e3 + radius * point.slope / length ==
          Approx(centre_lateral[arc]).margin(margin).epsilon(0));
    CHECK(point.value * 1e3 - radius / length == Approx(centre_up[arc]).margin(margin).epsilon(0));
  }
}

// The nearest point of a head by search: dense samples, then a golden section around the best.
struct Nearest {
  double distance, lateral;
};
Nearest nearest_by_search(const RailHead<double>& rail, double lateral, double up) {
  const auto distance = [&](int piece, double u) {
    return std::hypot(u - lateral, rail.evaluate(piece, u).value - up);
  };
  constexpr int samples = 400;
  Nearest nearest{std::numeric_limits<double>::infinity(), 0};
  for (int piece = 0; piece < rail.piece_count(); ++piece) {
    const double lower = rail.joint(piece), width = rail.joint(piece + 1) - lower;
    int best = 0;
    double best_distance = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= samples; ++i) {
      const double d = distance(piece, lower + width * i / samples);
      if (d < best_distance) {
        best = i;
        best_distance = d;
      }
    }
    double a = lower + width * std::max(best - 1, 0) / samples;
    double b = lower + width * std::min(best + 1, samples) / samples;
    const double golden = (std::sqrt(5.0) - 1) / 2;
    for (int i = 0; i < 80; ++i) {
      const double inner = golden * (b - a);
      (distance(piece, b - inner) < distance(piece, a + inner) ? b : a) =
          distance(piece, b - inner) < distance(piece, a + inner) ? a + inner : b - inner;
    }
    const double d = distance(piece, (a + b) / 2);
    if (d < nearest.distance) nearest = {d, (a + b) / 2};
  }
  return nearest;
}

}  // namespace

TEST_CASE("RailHead: joints and centres follow from width and depth", "[profile][reference]") {
  for (const HeadRow& row : rows) {
    const RailHead<double> rail(dimensions(2e-3 * row.lateral[2], -1e-3 * row.up[2]));
    // The rows have nine decimals; the joints amplify what is rounded off width and depth.
    check_row(rail, row, 2e-8);
  }
}

TEST_CASE("rail_60e1: the confirmed half widths; a head 72 mm wide", "[profile][reference]") {
  const auto rail = rail_60e1<double>();
  // The half widths, rounded to 1e-4 mm, close to a head that is 72.000 mm wide to 4e-4 mm.
  check_row(rail, rows[0], 1e-3);
  CHECK(rail.dimensions().width == 0.072);
  CHECK(rail.joint(6) == 0.036);
  CHECK(rail.evaluate(rail.joint(6)).value == Approx(-0.0143).epsilon(1e-14));
}

TEST_CASE("rail_60e1: at most 0.04 mm from the UIC60 of the Manchester benchmark",
          "[profile][reference]") {
  const auto rail = rail_60e1<double>();
  const RailHead<double> benchmark(dimensions(2e-3 * rows[2].lateral[2], -1e-3 * rows[2].up[2]));
  double largest = 0;
  for (int i = -340; i <= 340; ++i) {
    const double lateral = i * 1e-4;
    const double up = rail.evaluate(lateral).value;
    largest = std::max(largest, std::abs(benchmark.closest_point(lateral, up).penetration));
  }
  // The corner arc lies 0.0402 mm lower: along the normal at its beginning, 13.4 deg, 0.0392 mm.
  CHECK(largest < 39.2e-6);
  CHECK(largest > 39.0e-6);
}

TEST_CASE("uic50: the head of the assumed width and depth", "[profile][reference]") {
  check_row(uic50<double>(), rows[4], 2e-9);
}

TEST_CASE("uic50: 0.05 mm of doubt in its depth moves it by less than 0.02 mm near its top",
          "[profile]") {
  const auto rail = uic50<double>();
  for (const double depth : {0.01405, 0.01415}) {
    const RailHead<double> other(dimensions(0.07, depth));
    double largest = 0;
    for (int i = -150; i <= 150; ++i) {
      const double lateral = i * 1e-4;
      largest =
          std::max(largest, std::abs(other.evaluate(lateral).value - rail.evaluate(lateral).value));
    }
    CAPTURE(depth, largest);
    CHECK(largest < 20e-6);
    CHECK(largest > 10e-6);
  }
}

TEST_CASE("RailHead: the top is the origin, the sides end at their depth", "[profile]") {
  const auto rail = rail_60e1<double>();
  CHECK(rail.evaluate(0.0).value == Approx(0).margin(1e-16));
  CHECK(rail.evaluate(0.0).slope == 0);
  CHECK(rail.piece_count() == 7);
  CHECK(rail.evaluate(rail.upper()).value == Approx(-0.035).epsilon(1e-14));
  CHECK(rail.upper() == Approx(0.036 + 0.05 * (0.035 - 0.0143)).epsilon(1e-15));
  CHECK(rail.evaluate(rail.upper()).slope == Approx(-20).epsilon(1e-15));
}

TEST_CASE("RailHead: value and joints are symmetric to the bit", "[profile][symmetry]") {
  const auto rail = uic50<double>();
  for (int i = 0; i <= 7; ++i) CHECK(rail.joint(i) == -rail.joint(7 - i));
  for (int i = 0; i <= 200; ++i) {
    const double lateral = rail.upper() * i / 200;
    const int piece = piece_of(rail, lateral);
    const auto right = rail.evaluate(piece, lateral);
    const auto left = rail.evaluate(6 - piece, -lateral);
    CHECK(left.value == right.value);
    CHECK(left.slope == -right.slope);
    CHECK(left.second_derivative == right.second_derivative);
  }
}

TEST_CASE("RailHead: pieces are tangent at the joints", "[profile]") {
  for (const HeadRow& row : rows) {
    const RailHead<double> rail(dimensions(2e-3 * row.lateral[2], -1e-3 * row.up[2]));
    const auto joints = inspect_joints(rail);
    REQUIRE(joints.size() == 6);
    for (const auto& joint : joints) {
      CAPTURE(row.name, joint.lateral);
      CHECK(std::abs(joint.value_jump) < 2e-15);
      // Slopes up to 20, of an angle that is good to rounding: 1 + 20^2 of it.
      CHECK(std::abs(joint.slope_jump) < 1e-11);
    }
  }
}

TEST_CASE("RailHead::closest_point: the foot, the depth and the normal of a point on the surface",
          "[profile]") {
  const auto rail = rail_60e1<double>();
  for (int i = -100; i <= 100; ++i) {
    const double lateral = rail.upper() * i / 100;
    CAPTURE(lateral);
    const auto point = rail.evaluate(lateral);
    const auto closest = rail.closest_point(lateral, point.value);
    const double length = std::hypot(1.0, point.slope);
    CHECK(closest.lateral == Approx(lateral).margin(1e-15));
    CHECK(std::abs(closest.penetration) < 2e-15);
    CHECK(closest.normal_rail.x() == Approx(-point.slope / length).margin(1e-13));
    CHECK(closest.normal_rail.y() == Approx(1 / length).margin(1e-13));
    CHECK(closest.normal_rail.norm() == Approx(1).epsilon(1e-15));
  }
}

TEST_CASE("RailHead::closest_point: agrees with a search over the whole head",
          "[profile][random]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (const auto& rail : {rail_60e1<double>(), uic50<double>()}) {
    int above = 0, below = 0;
    int in_piece[7] = {};
    for (int i = 0; i < 3000; ++i) {
      // From a point of the head, a distance along its normal: to 20 mm outside, to 12 mm inside.
      const int piece = static_cast<int>(7 * part(random));
      const double start = rail.joint(piece), end = rail.joint(piece + 1);
      const double on_head = start + (end - start) * part(random);
      const double outwards = -0.012 + 0.032 * part(random);
      const auto head = rail.evaluate(piece, on_head);
      const double length = std::hypot(1.0, head.slope);
      const double lateral = on_head - outwards * head.slope / length;
      const double up = head.value + outwards / length;
      CAPTURE(lateral, up);
      const auto closest = rail.closest_point(lateral, up);
      const auto expected = nearest_by_search(rail, lateral, up);
      CHECK(std::abs(closest.penetration) == Approx(expected.distance).margin(1e-14));
      CHECK(closest.lateral == Approx(expected.lateral).margin(2e-8));
      // Positive under the surface.
      CHECK(closest.penetration == Approx(-outwards).margin(1e-14));
      (closest.penetration > 0 ? below : above) += 1;
      in_piece[piece_of(rail, closest.lateral)] += 1;
      // The foot lies one depth away along the normal, on the head.
      CHECK(lateral + closest.penetration * closest.normal_rail.x() ==
            Approx(closest.lateral).margin(1e-14));
      if (rail.lower() <= closest.lateral && closest.lateral <= rail.upper()) {
        CHECK(up + closest.penetration * closest.normal_rail.y() ==
              Approx(rail.evaluate(closest.lateral).value).margin(1e-12));
      }
    }
    CHECK(above > 1500);
    CHECK(below > 800);
    for (const int count : in_piece) CHECK(count > 300);
  }
}

TEST_CASE("RailHead::closest_point: mirrors to the bit", "[profile][symmetry][random]") {
  const auto rail = rail_60e1<double>();
  std::mt19937 random(11);
  std::uniform_real_distribution<double> lateral_of(0.0, 0.05), up_of(-0.03, 0.02);
  for (int i = 0; i < 500; ++i) {
    const double lateral = lateral_of(random), up = up_of(random);
    const auto right = rail.closest_point(lateral, up);
    const auto left = rail.closest_point(-lateral, up);
    CHECK(left.lateral == -right.lateral);
    CHECK(left.penetration == right.penetration);
    CHECK(left.normal_rail.x() == -right.normal_rail.x());
    CHECK(left.normal_rail.y() == right.normal_rail.y());
  }
}

TEST_CASE("RailHead::closest_point: the sides go on straight below their depth", "[profile]") {
  const auto rail = rail_60e1<double>();
  const auto closest = rail.closest_point(0.05, -0.05);
  CHECK(closest.lateral > rail.upper());
  const double length = std::hypot(20.0, 1.0);
  CHECK(closest.normal_rail.x() == Approx(20 / length).epsilon(1e-15));
  CHECK(closest.normal_rail.y() == Approx(1 / length).epsilon(1e-15));
  // The distance from the line through (36, -14.3) mm of slope -20.
  CHECK(-closest.penetration ==
        Approx((20 * (0.05 - 0.036) + (-0.05 + 0.0143)) / length).epsilon(1e-13));
}

TEST_CASE("RailHead::closest_point: NaN in gives NaN", "[profile][bad-input]") {
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  const auto rail = rail_60e1<double>();
  CHECK_FALSE(is_finite(rail.closest_point(not_a_number, 0.0).penetration));
  CHECK_FALSE(is_finite(rail.closest_point(0.0, not_a_number).penetration));
}

TEST_CASE("RailHead: bad dimensions are refused with name, value and rule",
          "[profile][bad-input]") {
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto build = [](double crown, double shoulder, double corner, double width, double depth,
                        double side_slope, double side_depth) {
    return RailHead<double>({crown, shoulder, corner, width, depth, side_slope, side_depth});
  };
  CHECK_NOTHROW(build(0.3, 0.08, 0.013, 0.072, 0.0143, 0.05, 0.035));
  CHECK_THROWS_AS(build(0.3, 0.08, 0, 0.072, 0.0143, 0.05, 0.035), std::invalid_argument);
  CHECK_THROWS_WITH(build(0.3, 0.08, 0, 0.072, 0.0143, 0.05, 0.035),
                    "rail head: corner radius is 0, but must be finite and > 0 [m]");
  CHECK_THROWS_WITH(
      build(0.3, 0.01, 0.013, 0.072, 0.0143, 0.05, 0.035),
      "rail head: shoulder radius is 0.01, but must be greater than the corner radius [m]");
  CHECK_THROWS_WITH(build(0.08, 0.08, 0.013, 0.072, 0.0143, 0.05, 0.035),
                    "rail head: crown radius is 0.08, but must be finite and greater than the "
                    "shoulder radius [m]");
  CHECK_THROWS_WITH(build(infinity, 0.08, 0.013, 0.072, 0.0143, 0.05, 0.035),
                    "rail head: crown radius is inf, but must be finite and greater than the "
                    "shoulder radius [m]");
  CHECK_THROWS_WITH(build(0.3, 0.08, 0.013, -0.072, 0.0143, 0.05, 0.035),
                    "rail head: width is -0.072, but must be finite and > 0 [m]");
  CHECK_THROWS_WITH(build(0.3, 0.08, 0.013, 0.072, not_a_number, 0.05, 0.035),
                    "rail head: depth is nan, but must be finite and > 0 [m]");
  CHECK_THROWS_WITH(build(0.3, 0.08, 0.013, 0.072, 0.0143, 0, 0.035),
                    "rail head: side slope is 0, but must be finite and > 0 [-]");
  CHECK_THROWS_WITH(
      build(0.3, 0.08, 0.013, 0.072, 0.0143, 0.05, 0.0143),
      "rail head: side depth is 0.0143, but must be finite and greater than the depth [m]");
}

TEST_CASE("RailHead: dimensions that no tangent arcs fit are refused", "[profile][bad-input]") {
  const auto refused = [](double width, double depth) {
    try {
      const RailHead<double> rail(dimensions(width, depth));
      return std::string("accepted");
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
  };
  CHECK(refused(0.072, 0.0143) == "accepted");
  CHECK(refused(0.072, 0.030) ==
        "rail head: no tangent arcs of the crown, shoulder and corner radii (0.3, 0.08, 0.013 m) "
        "reach the width 0.072 m at the depth 0.03 m");
  CHECK(refused(0.072, 0.012) != "accepted");
  CHECK(refused(0.2, 0.0143) != "accepted");
  CHECK(refused(0.02, 0.0143) != "accepted");
  CHECK(refused(0.072, 0.6) != "accepted");
}

TEMPLATE_TEST_CASE("RailHead: as exact as the scalar is", "[profile]", float, double) {
  using T = TestType;
  const auto rail = rail_60e1<T>();
  const auto exact = rail_60e1<long double>();
  const auto wide = [](const T& x) { return static_cast<long double>(x); };
  // Heights are differences of radii of 0.3 m; joints amplify that by the ratio of the links.
  const auto tolerance = wide(epsilon<T>()) * 2;
  for (int i = 1; i < 7; ++i) {
    CHECK(std::abs(wide(rail.joint(i)) - exact.joint(i)) < tolerance * 4);
  }
  for (int i = -35; i <= 35; ++i) {
    const T lateral = T(i) * constant<T>(1e-3L);
    const long double same = wide(lateral);
    CAPTURE(i);
    CHECK(std::abs(wide(rail.evaluate(lateral).value) - exact.evaluate(same).value) <
          tolerance * 4);
    CHECK(std::abs(wide(rail.closest_point(lateral, T(0)).penetration) -
                   exact.closest_point(same, 0).penetration) < tolerance);
  }
}

TEST_CASE("RailHead: bit for bit the same for a scalar that converts to nothing", "[profile]") {
  const auto rail = uic50<double>();
  const auto strict = uic50<StrictScalar>();
  for (int i = 0; i <= 7; ++i) CHECK(strict.joint(i).as_double() == rail.joint(i));
  for (int i = -40; i <= 40; ++i) {
    const double lateral = i * 0.9e-3;
    const auto expected = rail.closest_point(lateral, -1e-3);
    const auto closest = strict.closest_point(StrictScalar(lateral), StrictScalar(-1e-3));
    CHECK(closest.lateral.as_double() == expected.lateral);
    CHECK(closest.penetration.as_double() == expected.penetration);
    CHECK(closest.normal_rail.x().as_double() == expected.normal_rail.x());
    CHECK(closest.normal_rail.y().as_double() == expected.normal_rail.y());
    if (lateral < rail.lower() || lateral > rail.upper()) continue;
    CHECK(strict.evaluate(StrictScalar(lateral)).value.as_double() == rail.evaluate(lateral).value);
  }
}

TEST_CASE("RailHead: evaluate and closest_point do not allocate", "[profile][no-alloc]") {
  const auto rail = rail_60e1<double>();
  double sum = 0;
  CHECK(wheelrail_test::allocations_of([&] {
          for (int i = -35; i <= 35; ++i) {
            sum += rail.evaluate(i * 1e-3).value + rail.closest_point(i * 1e-3, 1e-3).penetration;
          }
        }) == 0);
  CHECK(sum < 0);
}

TEST_CASE("RailHead: the nearest points of several lanes are those of one after the other",
          "[profile]") {
  const auto rail = wheelrail::uic50<double>();
  using Lanes = wheelrail::detail::Lanes<double>;
  int sides = 0;
  for (int step = 0; step < 200; ++step) {
    Lanes lateral, up;
    for (int lane = 0; lane < wheelrail::detail::lane_count; ++lane) {
      // From side to side; above the head, and below its top where it is flat.
      lateral[lane] = -0.045 + 0.09 * ((step * 7 + lane * 31) % 211) / 210;
      up[lane] = -0.03 + 0.05 * ((step * 5 + lane * 13) % 97) / 96;
    }
    const auto feet = rail.closest_points(lateral, up);
    for (int lane = 0; lane < wheelrail::detail::lane_count; ++lane) {
      const auto foot = rail.closest_point(lateral[lane], up[lane]);
      sides += foot.curvature == 0 ? 1 : 0;
      CHECK(std::abs(feet.lateral[lane] - foot.lateral) < 1e-15);
      CHECK(std::abs(feet.penetration[lane] - foot.penetration) < 1e-15);
      CHECK(std::abs(feet.normal_lateral[lane] - foot.normal_rail.x()) < 1e-15);
      CHECK(std::abs(feet.normal_up[lane] - foot.normal_rail.y()) < 1e-15);
      CHECK(feet.curvature[lane] == foot.curvature);
    }
  }
  CHECK(sides > 100);
}
