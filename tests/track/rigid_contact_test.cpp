#include <wheelrail/contact/find_contact.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/track/tangent_track.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

// S1002 on UIC60 1:40, gauge 1435 mm, nominal radius 460 mm, flange backs 1360 mm apart; both
// wheels touch, roll solved for. Source: CONTACT, open source version of 2025-07-23, kinematic
// contact points, stated accuracy 1e-3 mm, and 0.01 to 0.1 mm where nearly conformal.
// Axes there: y to the right, z down; rail points from the highest point of the inclined head.
// [mm], roll [rad] (right wheel down). The wheelset moves to the right.
struct Row {
  double shift, roll, drop, left_rail, left_wheel, right_rail, right_wheel;
};
constexpr Row table[] = {
    {0, 0, 0.182129352, 7.2792581, -3.25329964, -7.2792581, 3.25329964},
    {0.5, -2.41939958e-05, 0.175038556, 5.91665404, -5.12702985, -18.5306188, -8.50920009},
    {1, -5.41040773e-05, 0.161754488, 5.01089086, -6.54654706, -18.8627659, -9.35512061},
    {1.5, -8.46532612e-05, 0.146630302, 4.3517512, -7.71973443, -19.2279503, -10.234376},
    {2, -0.000116208997, 0.129731564, 3.8518146, -8.73418173, -19.6235509, -11.1445151},
    {2.5, -0.000149104879, 0.111038249, 3.46582794, -9.63529575, -20.0614168, -12.0975419},
    {3, -0.000183678413, 0.0904655814, 3.16667095, -10.4503521, -20.552342, -13.1044069},
    {3.5, -0.000220313979, 0.0678543701, 2.93646345, -11.197408, -21.1154769, -14.1844401},
    {4, -0.000259497571, 0.0429418531, 2.76261423, -11.8892784, -21.7831699, -15.370217},
    {4.5, -0.000301929836, 0.0152830995, 2.63582504, -12.535584, -22.6220223, -16.7286686},
    {5, -0.000369570193, -0.0317187904, 2.54110948, -13.1614134, -33.9760428, -28.6147139},
    {5.5, -0.000496612688, -0.124023552, 2.46533342, -13.7956377, -34.4481805, -29.6458589},
    {6, -0.000650988113, -0.23728677, 2.42035569, -14.4116542, -35.4716308, -31.2412562},
    {6.5, -0.00425216842, -2.9761858, 1.83905529, -17.1552472, -42.1335378, -40.1210686},
    {7, -0.00641177431, -4.62013154, 1.83675023, -18.6591108, -41.5408826, -41.0619056},
    {7.5, -0.00768598851, -5.5890345, 1.99673433, -19.5917097, -41.1110434, -41.7442123},
    {8, -0.00866311565, -6.33098091, 2.21270259, -20.3309818, -40.7357794, -42.3395501},
    {8.5, -0.00947392451, -6.94557322, 2.45998498, -20.9619891, -40.3910969, -42.8861398},
    {9, -0.0101739982, -7.47515007, 2.72781515, -21.5211725, -40.0667105, -43.4001461},
    {9.5, -0.0107931853, -7.94245037, 3.01025044, -22.028265, -39.7571524, -43.8903099},
    {10, -0.0113497322, -8.36137632, 3.30361035, -22.4953786, -39.4590836, -44.36198},
};

using Track = TangentTrack<RailHead<double>>;
using Wheel1002 = Wheel<PiecewiseProfile<double>>;

// The UIC60 head of these point lists: 72 mm wide, its corner meets the side 14.259737 mm deep
// (36.000001 mm and 14.259738 mm in the fit), so that the crown's arc ends 10.5 mm from the axis.
RailHead<double> uic60() {
  return RailHead<double>({0.3, 0.08, 0.013, 0.072, 14.259720e-3, 0.05, 0.035});
}

Patch<double> deepest(const Wheel1002& wheel, const Track& track, Side side, double shift,
                      double height, double roll) {
  const double s = outboard_sign<double>(side);
  const Vector3<double> axle_track(0, s * std::cos(roll), s * std::sin(roll));
  const Vector3<double> wheel_track = Vector3<double>(0, shift, height) + 0.75 * axle_track;
  const auto result =
      find_contact(wheel, track.rail(side),
                   place_wheel(track.nearest_frame(side, wheel_track), wheel_track, axle_track),
                   {.penetration_threshold = -0.1});
  REQUIRE(result.status == SearchStatus::complete);
  REQUIRE(!result.patches.empty());
  Patch<double> best = result.patches[0];
  for (const auto& patch : result.patches) {
    if (best.penetration < patch.penetration) best = patch;
  }
  return best;
}

// Height and roll at which both wheels' penetrations vanish: Newton with the exact rates, halved
// where it does not improve.
struct Touching {
  double height, roll;
  Patch<double> left, right;
};
Touching touching(const Wheel1002& wheel, const Track& track, double shift) {
  double height = wheel.nominal_radius(), roll = 0.0;
  Touching at{height, roll, {}, {}};
  for (int i = 0; i < 60; ++i) {
    at = {height, roll, deepest(wheel, track, Side::left, shift, height, roll),
          deepest(wheel, track, Side::right, shift, height, roll)};
    // A rise dh and a turn dr about the axle's middle move the contact point p by
    // dh e_z + dr e_x x (p - middle); the penetration falls by its part along the normal.
    double rates[2][2];
    const Patch<double>* patches[2] = {&at.left, &at.right};
    for (const Side side : sides) {
      const auto frame = track.nearest_frame(side, Vector3<double>::Zero());
      const auto& patch = *patches[index_of(side)];
      const Vector3<double> p_track = frame.position_track(patch.position_rail);
      const Vector3<double> n_track = frame.direction_track(patch.normal_rail);
      rates[index_of(side)][0] = -n_track.z();
      rates[index_of(side)][1] =
          n_track.y() * (p_track.z() - height) - n_track.z() * (p_track.y() - shift);
    }
    const double determinant = rates[0][0] * rates[1][1] - rates[0][1] * rates[1][0];
    const double l = at.left.penetration, r = at.right.penetration;
    const double largest = std::max(std::abs(l), std::abs(r));
    if (largest < 1e-12) break;
    const double factor = i < 30 ? 1.0 : 0.5;
    height -= factor * (l * rates[1][1] - r * rates[0][1]) / determinant;
    roll -= factor * (rates[0][0] * r - rates[1][0] * l) / determinant;
  }
  return at;
}

}  // namespace

TEST_CASE("find_contact: rigid contact points are those of CONTACT", "[track][reference]") {
  const Wheel1002 wheel(s1002<double>(), 0.46);
  const Track track(uic60(), {1.435, 0.025});
  const auto frame = track.nearest_frame(Side::left, Vector3<double>::Zero());
  // The crown's arc ends 10.5 mm from the axis.
  CHECK(std::abs(track.rail(Side::left).profile().joint(4) - 10.5e-3) < 1e-6);
  // The source's origin of rail points, from the middle of the track (ycp_tr - ycp_r, both sides),
  // [m]. That the crown's arc is highest there to 6 um is the step of its point list.
  constexpr double centre = 760.532560e-3;
  CHECK(std::abs(frame.position_track(Vector3<double>(0, 0, -0.3)).y() - centre) < 1e-5);
  double worst[4] = {0, 0, 0, 0};
  for (const Row& row : table) {
    CAPTURE(row.shift);
    const auto at = touching(wheel, track, -row.shift * 1e-3);
    REQUIRE(std::abs(at.left.penetration) < 1e-11);
    REQUIRE(std::abs(at.right.penetration) < 1e-11);
    const auto rail_y = [&](Side side, const Patch<double>& patch) {
      const auto here = track.nearest_frame(side, Vector3<double>::Zero());
      return (std::abs(here.position_track(patch.position_rail).y()) - centre) * 1e3;
    };
    // To the right positive there; towards the field side here.
    const double errors[4] = {rail_y(Side::left, at.left) + row.left_rail,
                              at.left.wheel_lateral * 1e3 + row.left_wheel,
                              rail_y(Side::right, at.right) - row.right_rail,
                              at.right.wheel_lateral * 1e3 - row.right_wheel};
    for (int i = 0; i < 4; ++i) {
      worst[i] = std::max(worst[i], std::abs(errors[i]));
      CAPTURE(i, errors[i]);
      CHECK(std::abs(errors[i]) < 2.5e-3);
    }
    CHECK(std::abs(at.roll - row.roll) < 1e-6);
    CHECK(std::abs((at.height - 0.46) * 1e3 + row.drop) < 1e-3);
  }
  // On the left, at the tread, all rows are held to a tenth of the stated accuracy.
  CHECK(worst[0] < 3e-4);
  CHECK(worst[1] < 3e-4);
}
