#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/track/tangent_track.hpp>
#include <wheelrail/wheelset/kinematics.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

// The Manchester contact benchmark (Shackleton and Iwnicki 2008), case, right wheel: S1002 on
// UIC60 1:40, gauge 1435 mm, nominal radius 460 mm, flange backs 1360 mm apart; lateral shift to
// the right 0 to 10 mm with yaw to the right 0 to 24 mrad, 10 kN for each wheel, 2 m/s. Source:
// CONTACT, open source, revision 2707. Its axes: x forward, y right, z down, from the middle of the
// track; wheel points from the tread circle. [mm], [rad], speed of rotation [rad/s], spin [rad/mm].
//
// CONTACT computes an elastic patch, and reports its reference point, not the nearest point of
// rigid surfaces. The point is the mean over the patch, weighted with the square of the
// interpenetration of the undeformed surfaces: this the table tells (an integral over a strip of (p
// - x2/2R)2 makes it p^5/2 along the profile), it agrees to 0.002 mm up to a shift of 4.5 mm; p,
// p^3/2 and p^2 are 0.3 to 1.8 mm off. Creepages are those of the rail against the wheel, at the
// wheel's surface, over the mean of the forward speed and the rolling radius' circumferential
// speed.
struct Row {
  double shift, yaw, roll, drop, rotation;
  double x, y, z, contact_angle;       // of the contact, track axes
  double wheel_lateral, wheel_down;    // of the contact, wheel axes
  double longitudinal, lateral, spin;  // creepages
  double approach;
};
constexpr Row table[] = {
    {0.000, 0.000, 0.000, 0.1981, -4.3481181, 0.0000, 751.8726, 0.1252, -0.0290, 1.8726, -0.0729,
     -5.665E-05, 0.000, 6.302E-05, 1.596E-02},
    {0.5000, 1.200E-03, -2.304E-05, 0.1938, -4.3474134, -0.8614, 744.5026, 0.4289, -0.0568, -6.0075,
     0.2522, 4.948E-04, 1.202E-03, 1.233E-04, 1.948E-02},
    {1.000, 2.400E-03, -5.049E-05, 0.1839, -4.3465752, -1.7013, 741.9908, 0.5753, -0.0696, -9.0305,
     0.4288, 6.943E-04, 2.407E-03, 1.510E-04, 2.448E-02},
    {1.500, 3.600E-03, -8.103E-05, 0.1694, -4.3462440, -2.5385, 741.3771, 0.6189, -0.0753, -10.1558,
     0.5094, 7.903E-04, 3.612E-03, 1.633E-04, 2.489E-02},
    {2.000, 4.800E-03, -1.128E-04, 0.1529, -4.3459197, -3.3682, 740.9147, 0.6548, -0.0806, -11.1296,
     0.5853, 8.752E-04, 4.818E-03, 1.746E-04, 2.480E-02},
    {2.500, 6.000E-03, -1.457E-04, 0.1344, -4.3455627, -4.1890, 740.4620, 0.6926, -0.0862, -12.0933,
     0.6657, 9.607E-04, 6.025E-03, 1.866E-04, 2.461E-02},
    {3.000, 7.200E-03, -1.803E-04, 0.1143, -4.3451503, -4.9990, 739.9698, 0.7367, -0.0923, -13.0963,
     0.7553, 1.052E-03, 7.235E-03, 1.998E-04, 2.439E-02},
    {3.500, 8.400E-03, -2.168E-04, 0.0921, -4.3446688, -5.7956, 739.4071, 0.7908, -0.0994, -14.1700,
     0.8583, 1.154E-03, 8.447E-03, 2.150E-04, 2.410E-02},
    {4.000, 9.600E-03, -2.557E-04, 0.0676, -4.3440930, -6.5746, 738.7381, 0.8604, -0.1078, -15.3505,
     0.9806, 1.276E-03, 9.662E-03, 2.330E-04, 2.370E-02},
    {4.500, 1.080E-02, -2.977E-04, 0.0404, -4.3433715, -7.3279, 737.8905, 0.9567, -0.1185, -16.7104,
     1.1346, 1.430E-03, 1.088E-02, 2.559E-04, 2.310E-02},
    {5.000, 1.200E-02, -3.554E-04, 0.0015, -4.3353637, -6.9999, 727.0855, 3.0041, -0.2905, -28.0471,
     3.2592, 4.174E-03, 1.255E-02, 6.188E-04, 2.719E-02},
    {5.500, 1.320E-02, -4.777E-04, -0.0866, -4.3318864, -7.3700, 726.1169, 3.3006, -0.3363,
     -29.5701, 3.7315, 4.379E-03, 1.401E-02, 7.122E-04, 2.926E-02},
    {6.000, 1.440E-02, -6.272E-04, -0.1961, -4.3293718, -7.3822, 725.1371, 3.6882, -0.4176,
     -31.1222, 4.3352, 5.077E-03, 1.580E-02, 8.744E-04, 2.728E-02},
    {6.500, 1.560E-02, -4.376E-03, -3.0468, -4.2748834, 5.8010, 718.4931, 10.3654, -1.1591,
     -40.2622, 16.5234, 1.828E-02, 3.905E-02, 1.937E-03, 3.623E-02},
    {7.000, 1.680E-02, -6.393E-03, -4.5809, -4.2635629, 2.3584, 719.0445, 9.2525, -1.0634, -41.1389,
     18.3758, 1.949E-02, 3.457E-02, 1.838E-03, 3.563E-02},
    {7.500, 1.800E-02, -7.642E-03, -5.5298, -4.2575747, 0.5078, 719.4632, 8.5526, -1.0006, -41.8043,
     19.5093, 2.044E-02, 3.333E-02, 1.765E-03, 3.524E-02},
    {8.000, 1.920E-02, -8.606E-03, -6.2615, -4.2534857, -0.9036, 719.8316, 8.0092, -0.9501,
     -42.3894, 20.3791, 2.127E-02, 3.300E-02, 1.701E-03, 3.494E-02},
    {8.500, 2.040E-02, -9.408E-03, -6.8687, -4.2503245, -2.1179, 720.1709, 7.5561, -0.9065,
     -42.9279, 21.0991, 2.200E-02, 3.309E-02, 1.642E-03, 3.469E-02},
    {9.000, 2.160E-02, -1.010E-02, -7.3919, -4.2477561, -3.2265, 720.4903, 7.1643, -0.8676,
     -43.4346, 21.7187, 2.266E-02, 3.341E-02, 1.588E-03, 3.447E-02},
    {9.500, 2.280E-02, -1.071E-02, -7.8534, -4.2455665, -4.2731, 720.7950, 6.8178, -0.8321,
     -43.9174, 22.2644, 2.325E-02, 3.388E-02, 1.536E-03, 3.428E-02},
    {10.00, 2.400E-02, -1.126E-02, -8.2668, -4.2436375, -5.2821, 721.0880, 6.5066, -0.7992,
     -44.3815, 22.7530, 2.378E-02, 3.445E-02, 1.486E-03, 3.411E-02},
};

// The UIC60 head of the benchmark: see track/rigid_contact_test.cpp.
const TangentTrack<RailHead<double>>& benchmark_track() {
  static const TangentTrack<RailHead<double>> track(
      RailHead<double>({0.3, 0.08, 0.013, 0.072, 14.259720e-3, 0.05, 0.035}), {1.435, 0.025});
  return track;
}
const Wheelset<PiecewiseProfile<double>>& benchmark_wheelset() {
  static const Wheelset<PiecewiseProfile<double>> wheelset(s1002<double>(), 0.46, 1.5);
  return wheelset;
}

// What CONTACT's reference point is for the placement of a row, from the penetrations of our
// search.
struct Reference {
  double wheel_lateral, contact_angle, deepest;
  Vector3<double> rail_track, wheel_track, arm_track;
  double rolling_radius;
};

Reference reference_of(const Row& row) {
  const auto& wheelset = benchmark_wheelset();
  const auto& track = benchmark_track();
  const auto& wheel = wheelset.wheel(Side::right);
  const auto& rail = track.rail(Side::right);
  const auto at =
      WheelsetPosition<double>::of(-row.shift * 1e-3, 0.46 - row.drop * 1e-3, row.roll, -row.yaw);
  const auto frame = track.nearest_frame(Side::right, wheelset.wheel_track(Side::right, at));
  const auto placement = place_wheel(wheelset, track, Side::right, at);
  const auto found = find_contact(wheel, rail, placement);
  REQUIRE(found.status == SearchStatus::complete);
  REQUIRE(!found.patches.empty());
  Reference reference{};
  const auto foot_at = [&](double lateral) {
    const auto point = wheel.profile().evaluate(lateral);
    const auto locus = locus_point(wheel, placement, lateral, point);
    return std::tuple(point, locus, rail_foot(rail.profile(), locus.lateral, locus.up));
  };
  double weights = 0;
  for (const auto& patch : found.patches) {
    reference.deepest = std::max(reference.deepest, patch.penetration);
    const int strips = 2000;
    const double width = (patch.zone_upper - patch.zone_lower) / strips;
    for (int i = 0; i < strips; ++i) {
      const double lateral = patch.zone_lower + (i + 0.5) * width;
      const auto [point, locus, foot] = foot_at(lateral);
      const double weight = std::pow(std::max(0.0, foot.penetration), 2.5) * width *
                            std::sqrt(1 + point.slope * point.slope);
      weights += weight;
      reference.wheel_lateral += weight * lateral;
      reference.contact_angle +=
          weight * (std::atan2(-foot.normal_rail.x(), foot.normal_rail.y()) + frame.inclination);
    }
  }
  reference.wheel_lateral /= weights;
  reference.contact_angle /= weights;
  const auto [point, locus, foot] = foot_at(reference.wheel_lateral);
  reference.rail_track = frame.position_track(
      Vector3<double>(locus.along_rail, foot.lateral, rail.profile().evaluate(foot.lateral).value));
  reference.wheel_track =
      frame.position_track(Vector3<double>(locus.along_rail, locus.lateral, locus.up));
  reference.arm_track = reference.wheel_track - at.position_track;
  reference.rolling_radius = 0.46 + point.value;
  return reference;
}

// Of the rail against the wheel; lateral to the right and spin [1/mm] about an axis down: twice a
// change of sign.
struct ReferenceCreepage {
  double longitudinal, lateral, spin;
};

ReferenceCreepage creepage_of(const Row& row, const Reference& at) {
  const double forward = 2.0;
  const Vector3<double> rotation_track = -row.rotation * axle_direction(row.roll, -row.yaw);
  const Vector3<double> velocity_track =
      Vector3<double>(forward, 0, 0) + cross(rotation_track, at.arm_track);
  // The right rail's contact plane rises to the right.
  const double angle = at.contact_angle;
  const Vector3<double> lateral_track(0, std::cos(angle), -std::sin(angle));
  const Vector3<double> normal_track(0, std::sin(angle), std::cos(angle));
  const double speed = (forward - row.rotation * at.rolling_radius) / 2;
  return {-velocity_track.x() / speed, dot(velocity_track, lateral_track) / speed,
          dot(rotation_track, normal_track) / speed * 1e-3};
}

}  // namespace

TEST_CASE("find_contact: the Manchester benchmark's contact points, like with like",
          "[wheelset][reference]") {
  for (const Row& row : table) {
    CAPTURE(row.shift);
    const auto at = reference_of(row);
    // On the flange yaw makes the patch lie askew to the strips: it is not symmetric about them, as
    // the weights suppose. At 5 mm two zones make up one patch; at 6 mm the fillet conforms.
    const bool on_flange = row.shift > 6.2;
    const bool conforms = row.shift == 5.0 || row.shift == 6.0;
    const double lateral = on_flange ? 0.02 : (conforms ? 0.025 : 0.01);
    CHECK(std::abs(at.wheel_lateral * 1e3 - row.wheel_lateral) < lateral);
    CHECK(std::abs(-at.rail_track.y() * 1e3 - row.y) <
          (on_flange ? 0.02 : (conforms ? 0.02 : 2e-3)));
    CHECK(std::abs(at.rail_track.x() * 1e3 - row.x) <
          (on_flange ? 0.06 : (conforms ? 0.05 : 0.012)));
    CHECK(std::abs(-at.rail_track.z() * 1e3 - row.z) <
          (on_flange ? 0.045 : (conforms ? 5e-3 : 2e-4)));
    CHECK(std::abs(at.contact_angle + row.contact_angle) <
          (on_flange ? 3e-3 : (conforms ? 7e-4 : 1e-4)));
    CHECK(at.deepest * 1e3 == Approx(row.approach).epsilon(on_flange || conforms ? 0.013 : 4e-3));
  }
}

TEST_CASE("Wheelset: the Manchester benchmark's creepages, like with like",
          "[wheelset][reference]") {
  for (const Row& row : table) {
    CAPTURE(row.shift);
    const auto own = creepage_of(row, reference_of(row));
    // Rolling radii of 460 mm to some um make longitudinal creepages of some 1e-5.
    CHECK(own.longitudinal == Approx(row.longitudinal).epsilon(6e-3).margin(2e-5));
    CHECK(own.lateral == Approx(row.lateral).epsilon(3e-3).margin(1e-7));
    CHECK(own.spin == Approx(row.spin).epsilon(2e-3));
  }
}

TEST_CASE("the Manchester benchmark's table of differences", "[wheelset][reference]") {
  std::printf(
      "Manchester contact benchmark A-2.2, right wheel: differences from CONTACT, whose contact\n"
      "reference point is compared with the same mean over the zones of the search; all in its "
      "axes\n"
      "shift    wheel y       x       y       z    angle  approach  creep x   creep y      spin\n"
      " [mm]       [um]    [um]    [um]    [um]   [mrad]       [%%]   [1e-6]    [1e-6]   "
      "[1e-6/mm]\n");
  int rows = 0;
  for (const Row& row : table) {
    const auto at = reference_of(row);
    const auto creepage = creepage_of(row, at);
    std::printf(
        "%5.1f %10.1f %7.1f %7.1f %7.1f %8.3f %9.2f %8.1f %9.1f %9.3f\n", row.shift,
        1e3 * (at.wheel_lateral * 1e3 - row.wheel_lateral), 1e3 * (at.rail_track.x() * 1e3 - row.x),
        1e3 * (-at.rail_track.y() * 1e3 - row.y), 1e3 * (-at.rail_track.z() * 1e3 - row.z),
        1e3 * (-at.contact_angle - row.contact_angle), 1e2 * (at.deepest * 1e3 / row.approach - 1),
        1e6 * (creepage.longitudinal - row.longitudinal), 1e6 * (creepage.lateral - row.lateral),
        1e6 * (creepage.spin - row.spin));
    ++rows;
  }
  CHECK(rows == 21);
}

TEST_CASE("wheelset_kinematics: the Manchester benchmark's rigid contact is near the elastic one",
          "[wheelset][reference]") {
  for (const Row& row : table) {
    CAPTURE(row.shift);
    const auto at =
        wheelset_kinematics(benchmark_wheelset(), benchmark_track(), -row.shift * 1e-3, -row.yaw);
    REQUIRE(at.status == TouchStatus::touching);
    const auto& patch = at.wheel(Side::right).contact();
    const auto frame = benchmark_track().nearest_frame(Side::right, Vector3<double>::Zero());
    const double y = -frame.position_track(patch.position_rail).y() * 1e3;
    // Where the tread or the fillet conforms to the rail, the elastic patch is wide and lies
    // elsewhere than the nearest points: up to 2.5 mm.
    const bool conforms = row.shift < 1.2 || row.shift == 5.0;
    CHECK(std::abs(y - row.y) < (conforms ? 2.6 : 0.1));
    CHECK(std::abs(patch.contact_angle + row.contact_angle) < (conforms ? 0.011 : 6e-3));
    // The load lowers the wheelset, by the approach over the normal's upward part or less where the
    // other wheel, on its tread, is pressed down less.
    const double lowered = row.drop - (0.46 - at.height) * 1e3;
    CHECK(lowered > 0.5 * row.approach);
    CHECK(lowered < 1.25 * row.approach / std::pow(std::cos(row.contact_angle), 2));
  }
}
