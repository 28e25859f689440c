#include <limits>
#include <random>
#include <wheelrail/contact/rail_foot.hpp>
#include <wheelrail/profile/rail_head.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

// A rail head without its closed form, counting its evaluations.
class PlainHead {
 public:
  using Scalar = double;
  explicit PlainHead(const RailHead<double>& head) : head_(head) {}
  [[nodiscard]] double lower() const { return head_.lower(); }
  [[nodiscard]] double upper() const { return head_.upper(); }
  [[nodiscard]] int piece_count() const { return head_.piece_count(); }
  [[nodiscard]] double joint(int i) const { return head_.joint(i); }
  [[nodiscard]] ProfilePoint<double> evaluate(double u) const {
    ++evaluations;
    return head_.evaluate(u);
  }
  [[nodiscard]] ProfilePoint<double> evaluate(int piece, double u) const {
    ++evaluations;
    return head_.evaluate(piece, u);
  }
  mutable int evaluations = 0;

 private:
  RailHead<double> head_;
};

static_assert(HasClosestPoint<RailHead<double>> && !HasClosestPoint<PlainHead>);

}  // namespace

TEST_CASE("rail_foot: Newton's method finds the closed form's foot", "[contact][random]") {
  std::mt19937_64 generator(17);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int compared = 0, per_piece[7] = {}, most = 0;
  double worst_lateral = 0, worst_penetration = 0;
  for (const auto& head : {rail_60e1<double>(), uic50<double>()}) {
    for (int i = 0; i < 4000; ++i) {
      // A point of the surface, moved along the normal by up to 1 mm in and 5 mm out.
      const double u = uniform(generator) * (head.upper() - 1e-5);
      const double shift =
          i % 2 == 0 ? 1e-3 * uniform(generator) : 5e-3 * std::abs(uniform(generator));
      const auto at = head.evaluate(u);
      const double length = std::sqrt(1 + at.slope * at.slope);
      const double y = u - shift * at.slope / length, z = at.value + shift / length;
      const PlainHead plain(head);
      const auto newton = rail_foot(plain, y, z);
      const auto closed = rail_foot(head, y, z);
      CAPTURE(u, shift, newton.lateral, closed.lateral);
      REQUIRE(std::abs(closed.lateral - u) < 1e-12);
      REQUIRE(std::abs(closed.penetration + shift) < 1e-14);
      const double lateral_error = std::abs(newton.lateral - u);
      const double penetration_error = std::abs(newton.penetration + shift);
      worst_lateral = std::max(worst_lateral, lateral_error);
      worst_penetration = std::max(worst_penetration, penetration_error);
      CHECK(lateral_error < 1e-12);
      CHECK(penetration_error < 1e-13);
      CHECK((newton.normal_rail - closed.normal_rail).norm() < 1e-9);
      most = std::max(most, plain.evaluations);
      ++compared;
      ++per_piece[piece_of(head, u)];
    }
  }
  INFO("worst lateral " << worst_lateral << ", penetration " << worst_penetration
                        << ", most evaluations " << most);
  CHECK(compared == 8000);
  // The header promises at most 60 iterations; two ends and the result are evaluated too.
  CHECK(most <= 63);
  for (const int count : per_piece) CHECK(count > 50);
}

TEST_CASE("rail_foot: beyond the ends the rail goes on along its tangent", "[contact]") {
  const PiecewiseProfile<double> arc(
      {ProfilePiece<double>::arc(-0.02, 0.03, 0.0, -0.3, 0.3, true)});
  for (const double end : {-0.02, 0.03}) {
    const auto at = arc.evaluate(end);
    const double length = std::sqrt(1 + at.slope * at.slope);
    const double beyond = end < 0 ? -0.004 : 0.004;
    // 4 mm along the tangent, then 0.2 mm into the rail.
    const double y = end + beyond / length + 2e-4 * at.slope / length;
    const double z = at.value + beyond * at.slope / length - 2e-4 / length;
    const auto foot = rail_foot(arc, y, z);
    CHECK(std::abs(foot.lateral - (end + beyond / length)) < 1e-15);
    CHECK(std::abs(foot.penetration - 2e-4) < 1e-15);
    CHECK(std::abs(foot.normal_rail.x() + at.slope / length) < 1e-15);
    CHECK(std::abs(foot.normal_rail.y() - 1 / length) < 1e-15);
  }
}

TEST_CASE("rail_foot: over a circular arc the penetration is R less the distance",
          "[contact][reference]") {
  const PiecewiseProfile<double> arc({ProfilePiece<double>::arc(-0.2, 0.2, 0.0, -0.3, 0.3, true)});
  int checked = 0;
  for (const double y : {-0.1, -0.02, 0.0, 0.05}) {
    for (const double z : {-0.1, -0.02, -1e-4, 0.0, 1e-4, 0.1}) {
      const double distance = std::hypot(y, z + 0.3);
      const auto foot = rail_foot(arc, y, z);
      CHECK(std::abs(foot.penetration - (0.3 - distance)) < 1e-15);
      CHECK(std::abs(foot.lateral - 0.3 * y / distance) < 1e-14);
      ++checked;
    }
  }
  CHECK(checked == 24);
}

TEST_CASE("rail_foot: is finite for every finite point within reach", "[contact][random]") {
  std::mt19937_64 generator(18);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const PlainHead plain(rail_60e1<double>());
  int failed = 0, most = 0;
  for (int i = 0; i < 20000; ++i) {
    plain.evaluations = 0;
    const double y = 0.2 * uniform(generator);
    const double z = i % 2 == 0 ? 0.5 * std::abs(uniform(generator)) : 0.01 * uniform(generator);
    const auto foot = rail_foot(plain, y, z);
    if (!is_finite(foot.penetration) || !is_finite(foot.lateral)) ++failed;
    most = std::max(most, plain.evaluations);
  }
  CHECK(failed == 0);
  CHECK(most <= 63);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  plain.evaluations = 0;
  CHECK(!is_finite(rail_foot(plain, nan, 0.0).penetration));
  CHECK(!is_finite(rail_foot(plain, 0.0, nan).penetration));
  CHECK(plain.evaluations <= 126);
}
