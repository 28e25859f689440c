#include <Eigen/Core>
#include <type_traits>
#include <unsupported/Eigen/AutoDiff>
#include <wheelrail/profile/convex_modification.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/profile/spline_profile.hpp>
#include <wheelrail/profile/value_profile.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

using Dual = Eigen::AutoDiffScalar<Eigen::Vector2d>;

// A user's own profile, which knows no casts: a parabola.
template <class T>
struct Parabola {
  using Scalar = T;
  T bend{};
  T lower() const { return T(-0.02); }
  T upper() const { return T(0.02); }
  int piece_count() const { return 1; }
  T joint(int i) const { return i == 0 ? lower() : upper(); }
  ProfilePoint<T> evaluate(const T& u) const { return evaluate(0, u); }
  ProfilePoint<T> evaluate(int, const T& u) const {
    return {T(bend * u * u / T(2)), T(bend * u), bend};
  }
};

// Both give the same bits over all of the first.
template <class P, class Q>
void check_same(const P& one, const Q& other) {
  REQUIRE(one.piece_count() == other.piece_count());
  for (int piece = 0; piece < one.piece_count(); ++piece) {
    for (int i = 0; i <= 10; ++i) {
      const double lower = one.joint(piece), upper = one.joint(piece + 1);
      const double u = i == 10 ? upper : lower + (upper - lower) * i / 10;
      const auto a = one.evaluate(piece, u), b = other.evaluate(piece, u);
      CHECK(a.value == b.value);
      CHECK(a.slope == b.slope);
      CHECK(a.second_derivative == b.second_derivative);
    }
  }
}

}  // namespace

TEST_CASE("value_profile: of plain scalars is the profile itself", "[profile]") {
  STATIC_REQUIRE(std::is_same_v<ValueProfile<PiecewiseProfile<double>>, PiecewiseProfile<double>>);
  STATIC_REQUIRE(std::is_same_v<ValueProfile<Parabola<float>>, Parabola<float>>);
}

TEST_CASE("value_profile: profiles of dual numbers have those of their values", "[profile]") {
  STATIC_REQUIRE(std::is_same_v<ValueProfile<PiecewiseProfile<Dual>>, PiecewiseProfile<double>>);
  check_same(value_profile(s1002<Dual>()), s1002<double>());
  check_same(value_profile(rail_60e1<Dual>()), rail_60e1<double>());
  using Convex = ConvexModification<PiecewiseProfile<Dual>>;
  check_same(value_profile(Convex(s1002<Dual>())),
             ConvexModification<PiecewiseProfile<double>>(s1002<double>()));
  std::vector<double> laterals, values;
  for (int i = -20; i <= 20; ++i) {
    laterals.push_back(1e-3 * i);
    values.push_back(-5 * laterals.back() * laterals.back());
  }
  const SplineProfile<double> spline(laterals, values, {.noise = 0});
  const auto dual = spline.cast<Dual>();
  check_same(value_profile(dual), spline);
  CHECK(dual.report().polynomial_count == spline.report().polynomial_count);
  // Cast to dual numbers it is a constant profile, whose slope is the derivative of its value.
  const auto point = dual.evaluate(Dual(0.0123, 2, 1));
  CHECK(point.value.derivatives()(0) == 0);
  CHECK(point.value.derivatives()(1) == Approx(value_of(point.slope)).epsilon(1e-14));
  const auto foot = dual.closest_point(Dual(0.0123, 2, 0), Dual(0.001, 2, 1));
  CHECK(foot.penetration.derivatives()(0) == Approx(-value_of(foot.normal_rail.x())));
  CHECK(foot.penetration.derivatives()(1) == Approx(-value_of(foot.normal_rail.y())));
}

TEST_CASE("value_profile: a profile that cannot be cast is evaluated in its own scalar",
          "[profile]") {
  const Parabola<Dual> profile{Dual(-3.0, 2, 0)};
  STATIC_REQUIRE(std::is_same_v<ValueProfile<Parabola<Dual>>, ProfileValues<Parabola<Dual>>>);
  check_same(value_profile(profile), Parabola<double>{-3.0});
}
