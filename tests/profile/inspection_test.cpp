#include <vector>
#include <wheelrail/profile/inspection.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>

#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::StrictScalar;

namespace {

// A wave [m] over [0, length]: concave on every second half wave, in closed form.
struct Wave {
  using Scalar = double;
  double length = 0.1;
  double amplitude = 1e-5;
  double frequency = 200 * 3.14159265358979323846;  // ten waves
  [[nodiscard]] double lower() const { return 0; }
  [[nodiscard]] double upper() const { return length; }
  [[nodiscard]] int piece_count() const { return 1; }
  [[nodiscard]] double joint(int i) const { return i == 0 ? 0 : length; }
  [[nodiscard]] ProfilePoint<double> evaluate(double lateral) const {
    const double value = amplitude * std::sin(frequency * lateral);
    return {value, amplitude * frequency * std::cos(frequency * lateral),
            -frequency * frequency * value};
  }
  [[nodiscard]] ProfilePoint<double> evaluate(int, double lateral) const {
    return evaluate(lateral);
  }
};

}  // namespace

TEST_CASE("inspect_joints: the inner joints, flange side less field side", "[profile]") {
  using Piece = ProfilePiece<double>;
  const PiecewiseProfile<double> profile({Piece::line(-1, 0, 0, 1, 2), Piece::line(0, 1, 0, 3, 5),
                                          Piece::arc(1, 2, 1.5, 0, 0.75, true)});
  const auto joints = inspect_joints(profile);
  REQUIRE(joints.size() == 2);
  CHECK(joints[0].lateral == 0);
  CHECK(joints[0].value_jump == -2);
  CHECK(joints[0].slope_jump == -3);
  CHECK(joints[0].curvature_jump == 0);
  CHECK(joints[1].lateral == 1);
  CHECK(joints[1].value_jump == Approx(8 - std::sqrt(0.3125)));
  CHECK(joints[1].curvature_jump == Approx(-1 / 0.75));
}

TEST_CASE("inspect_joints: one piece has none", "[profile]") {
  CHECK(inspect_joints(Wave{}).empty());
}

TEST_CASE("concave_intervals: S1002 is concave in one zone, from fillet to tread",
          "[profile][reference]") {
  for (const S1002Form form : {S1002Form::closed, S1002Form::standard}) {
    const auto zones = concave_intervals(s1002<double>(form));
    REQUIRE(zones.size() == 1);
    // [mm]: the end of the R13 fillet and the tread's inflection, from the standard's numbers.
    CHECK(zones[0].lower * 1e3 == Approx(-38.426669071).margin(1e-9).epsilon(0));
    CHECK(zones[0].upper * 1e3 == Approx(14.0828242553).margin(1e-9).epsilon(0));
  }
}

TEST_CASE("concave_intervals: a convex rail head has none", "[profile]") {
  CHECK(concave_intervals(rail_60e1<double>()).empty());
  CHECK(concave_intervals(uic50<double>()).empty());
}

TEST_CASE("concave_intervals: every second half wave of a wave", "[profile]") {
  const Wave wave;
  const auto zones = concave_intervals(wave);
  REQUIRE(zones.size() == 10);
  const double half_wave = 0.1 / 20;
  for (std::size_t i = 0; i < zones.size(); ++i) {
    CAPTURE(i);
    const double lower = half_wave * static_cast<double>(2 * i + 1);
    CHECK(zones[i].lower == Approx(lower).margin(1e-15));
    CHECK(zones[i].upper == Approx(lower + half_wave).margin(1e-15));
    CHECK(wave.evaluate((zones[i].lower + zones[i].upper) / 2).second_derivative > 0);
  }
}

TEST_CASE("concave_intervals: inflections between samples do not depend on their number",
          "[profile]") {
  const auto profile = s1002<double>();
  for (const int samples : {1, 2, 3, 17, 1000}) {
    CAPTURE(samples);
    const auto zones = concave_intervals(profile, samples);
    REQUIRE(zones.size() == 1);
    CHECK(zones[0].upper * 1e3 == Approx(14.0828242553).margin(1e-9).epsilon(0));
  }
}

TEST_CASE("concave_intervals: zones that meet at a joint are one, others stay apart", "[profile]") {
  using Piece = ProfilePiece<double>;
  const auto bowl = [](double lower, double upper) {
    return Piece::polynomial(lower, upper, 0, 1, std::vector<double>{0, 0, 1});
  };
  const auto joined = concave_intervals(PiecewiseProfile<double>({bowl(-1, 0), bowl(0, 1)}));
  REQUIRE(joined.size() == 1);
  CHECK(joined[0].lower == -1);
  CHECK(joined[0].upper == 1);
  const auto apart = concave_intervals(
      PiecewiseProfile<double>({bowl(-1, 0), Piece::line(0, 0.5, 0, 0, 0), bowl(0.5, 1)}));
  REQUIRE(apart.size() == 2);
  CHECK(apart[0].upper == 0);
  CHECK(apart[1].lower == 0.5);
}

TEST_CASE("concave_intervals: an inflection at an end of its piece", "[profile]") {
  using Piece = ProfilePiece<double>;
  // x^3 is concave where x > 0, -x^3 where x < 0.
  const std::vector<double> cube{0, 0, 0, 1}, minus_cube{0, 0, 0, -1};
  const auto rising =
      concave_intervals(PiecewiseProfile<double>({Piece::polynomial(0, 1, 0, 1, cube)}));
  REQUIRE(rising.size() == 1);
  CHECK(rising[0].lower == 0);
  CHECK(rising[0].upper == 1);
  const auto falling =
      concave_intervals(PiecewiseProfile<double>({Piece::polynomial(-1, 0, 0, 1, minus_cube)}));
  REQUIRE(falling.size() == 1);
  CHECK(falling[0].lower == -1);
  CHECK(falling[0].upper == 0);
}

TEST_CASE(
    "concave_intervals, inspect_joints: bit for bit the same for a scalar that converts to "
    "nothing",
    "[profile]") {
  const auto profile = s1002<double>();
  const auto strict = s1002<StrictScalar>();
  const auto zones = concave_intervals(profile);
  const auto strict_zones = concave_intervals(strict);
  REQUIRE(strict_zones.size() == zones.size());
  for (std::size_t i = 0; i < zones.size(); ++i) {
    CHECK(strict_zones[i].lower.as_double() == zones[i].lower);
    CHECK(strict_zones[i].upper.as_double() == zones[i].upper);
  }
  const auto joints = inspect_joints(profile);
  const auto strict_joints = inspect_joints(strict);
  REQUIRE(strict_joints.size() == joints.size());
  for (std::size_t i = 0; i < joints.size(); ++i) {
    CHECK(strict_joints[i].value_jump.as_double() == joints[i].value_jump);
    CHECK(strict_joints[i].slope_jump.as_double() == joints[i].slope_jump);
    CHECK(strict_joints[i].curvature_jump.as_double() == joints[i].curvature_jump);
  }
}
