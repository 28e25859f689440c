#include <array>
#include <limits>
#include <random>
#include <wheelrail/contact/find_contact.hpp>
#include <wheelrail/profile/convex_modification.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/track/tangent_track.hpp>

#include "support/allocation_counter.hpp"
#include "support/brute_force_contact.hpp"
#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::ArcRail;
using wheelrail_test::BruteForceContact;
using wheelrail_test::BruteForceResult;
using wheelrail_test::WheelsetPose;
using wheelrail_test::Zone;

namespace {

template <class T>
Vector3<T> vector_of(const WheelsetPose::Point& p) {
  return Vector3<T>(T(p[0]), T(p[1]), T(p[2]));
}

template <class T, class Track>
WheelPlacement<T> place(const Track& track, Side side, const WheelsetPose& pose) {
  const Vector3<T> wheel_track = vector_of<T>(pose.wheel_origin(side));
  return place_wheel(track.nearest_frame(side, wheel_track), wheel_track,
                     vector_of<T>(pose.axle_outwards(side)));
}

// Lowers or lifts the wheelset until the deepest point of one wheel has the given penetration.
template <class P, class Track>
void set_penetration(WheelsetPose& pose, const Wheel<P>& wheel, const Track& track, Side side,
                     double penetration) {
  pose.height = wheel.nominal_radius();
  for (int i = 0; i < 12; ++i) {
    const auto result = find_contact(wheel, track.rail(side), place<double>(track, side, pose),
                                     {.penetration_threshold = -0.2});
    REQUIRE(!result.patches.empty());
    const Patch<double>* deepest = &result.patches[0];
    for (const auto& patch : result.patches) {
      if (deepest->penetration < patch.penetration) deepest = &patch;
    }
    pose.height += (deepest->penetration - penetration) / std::cos(deepest->contact_angle);
  }
}

struct Tally {
  int poses = 0, zones[4] = {}, rivals = 0, ambiguous = 0, in_fillet = 0, on_flange = 0;
  double worst_penetration = 0, worst_position = 0;
};

// One pose, one wheel: the patches must be the zones of the brute force.
template <class P>
void compare_with_brute_force(const Wheel<P>& wheel, const RailHead<double>& head, Side side,
                              const WheelsetPose& pose, Tally& tally, double level = 0.0) {
  CAPTURE(name_of(side), pose.lateral_shift, pose.height, pose.roll, pose.yaw, level);
  const TangentTrack<RailHead<double>> track(head);
  const ArcRail rail(head.dimensions());
  const auto origin_track = track.nearest_frame(side, Vector3<double>::Zero()).origin_track;
  const BruteForceContact<P> oracle(wheel.profile(), wheel.nominal_radius(), rail,
                                    {std::abs(origin_track.y()), origin_track.z(), std::atan(0.05)},
                                    side, pose, level);
  const BruteForceResult expected = oracle.zones();
  const auto result = find_contact(wheel, track.rail(side), place<double>(track, side, pose),
                                   {.penetration_threshold = level});
  ++tally.poses;
  CHECK(result.status == SearchStatus::complete);
  for (std::size_t i = 1; i < result.patches.size(); ++i) {
    CHECK(result.patches[i - 1].zone_upper <= result.patches[i].zone_lower);
  }
  if (expected.saddle < 1e-9) {
    ++tally.ambiguous;
    return;
  }
  std::size_t deep_zones = 0, deep_patches = 0;
  for (const Zone& zone : expected.zones) {
    CAPTURE(zone.lateral, zone.penetration, zone.lower, zone.upper);
    const Patch<double>* match = nullptr;
    for (const auto& patch : result.patches) {
      if (patch.zone_lower < zone.upper + 1e-6 && zone.lower - 1e-6 < patch.zone_upper) {
        match = &patch;
      }
    }
    const bool deep = zone.penetration > 1e-7;
    deep_zones += deep ? 1U : 0U;
    if (deep) CHECK(match != nullptr);
    if (match == nullptr) continue;
    const double penetration_error = std::abs(match->penetration - level - zone.penetration);
    tally.worst_penetration = std::max(tally.worst_penetration, penetration_error);
    CHECK(penetration_error < 1e-9);
    if (zone.has_rival) {
      ++tally.rivals;
      continue;
    }
    const double position_error = std::abs(match->wheel_lateral - zone.lateral);
    tally.worst_position = std::max(tally.worst_position, position_error);
    CHECK(position_error < 1e-5);
    // The oracle's angle starts from the wheelset's own vertical, yaw times roll away.
    CHECK(std::abs(match->wheel_angle - zone.angle) < 1e-5 + 1.01 * std::abs(pose.yaw * pose.roll));
    // Strips of a yawed wheel reach a little deeper than the locus: its zone lies inside theirs.
    CHECK(match->zone_lower > zone.lower - 2e-5);
    CHECK(match->zone_upper < zone.upper + 2e-5);
    if (pose.yaw == 0.0) {
      CHECK(match->zone_lower < zone.lower + 2e-5);
      CHECK(match->zone_upper > zone.upper - 2e-5);
    }
    if (deep && zone.lateral < -38.43e-3) ++tally.on_flange;
    if (deep && -38.43e-3 <= zone.lateral && zone.lateral < -26e-3) ++tally.in_fillet;
  }
  for (const auto& patch : result.patches) {
    if (patch.penetration - level > 1e-7) ++deep_patches;
  }
  CHECK(deep_patches == deep_zones);
  ++tally.zones[std::min<std::size_t>(deep_zones, 3)];
}

// Random poses: a half anywhere, a half near the change from tread to flange, where the wheel's
// bottom, 0.43 m under the axle, is about 6 mm from the middle.
template <class P>
Tally random_poses(const P& profile, int count, unsigned seed) {
  Tally tally;
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const std::array<RailHead<double>, 2> heads{uic50<double>(), rail_60e1<double>()};
  const Wheel<P> wheel(profile, 0.43);
  for (int i = 0; i < count; ++i) {
    const RailHead<double>& head = heads[static_cast<std::size_t>(i % 2)];
    const Side side = i % 4 < 2 ? Side::left : Side::right;
    WheelsetPose pose;
    pose.yaw = 0.03 * uniform(generator);
    pose.roll = 0.01 * uniform(generator);
    const double shift = uniform(generator);
    pose.lateral_shift =
        i % 8 < 4 ? 0.01 * shift
                  : outboard_sign<double>(side) * (0.006 + 0.0008 * shift) - 0.43 * pose.roll;
    // 0.2 um to 0.5 mm, evenly in the logarithm.
    const double penetration = 2e-7 * std::pow(2500.0, (uniform(generator) + 1.0) / 2.0);
    const TangentTrack<RailHead<double>> track(head);
    set_penetration(pose, wheel, track, side, penetration);
    compare_with_brute_force(wheel, head, side, pose, tally);
  }
  INFO("poses " << tally.poses << ", with 0/1/2/3 zones " << tally.zones[0] << "/" << tally.zones[1]
                << "/" << tally.zones[2] << "/" << tally.zones[3] << ", fillet " << tally.in_fillet
                << ", flange " << tally.on_flange << ", rivals " << tally.rivals << ", ambiguous "
                << tally.ambiguous << ", worst penetration error " << tally.worst_penetration
                << ", worst position error " << tally.worst_position);
  CHECK(tally.poses == count);
  CHECK(tally.ambiguous * 50 < count);
  return tally;
}

// A smooth profile of a user's own: one piece, no closed-form foot.
class Parabola {
 public:
  using Scalar = double;
  Parabola(double slope, double half_second) : slope_(slope), half_second_(half_second) {}
  [[nodiscard]] double lower() const { return -0.04; }
  [[nodiscard]] double upper() const { return 0.04; }
  [[nodiscard]] int piece_count() const { return 1; }
  [[nodiscard]] double joint(int i) const { return i == 0 ? lower() : upper(); }
  [[nodiscard]] ProfilePoint<double> evaluate(double u) const {
    return {slope_ * u + half_second_ * u * u, slope_ + 2 * half_second_ * u, 2 * half_second_};
  }
  [[nodiscard]] ProfilePoint<double> evaluate(int, double u) const { return evaluate(u); }

 private:
  double slope_, half_second_;
};

// A corrugated wheel: crests `wavelength` apart, one of them at 0.
class Ripples {
 public:
  using Scalar = double;
  static constexpr double wavelength = 4e-3, amplitude = 10e-6;
  [[nodiscard]] double lower() const { return -0.041; }
  [[nodiscard]] double upper() const { return 0.041; }
  [[nodiscard]] int piece_count() const { return 1; }
  [[nodiscard]] double joint(int i) const { return i == 0 ? lower() : upper(); }
  [[nodiscard]] ProfilePoint<double> evaluate(double u) const {
    const double k = 2 * pi<double>() / wavelength;
    return {amplitude * std::cos(k * u), -amplitude * k * std::sin(k * u),
            -amplitude * k * k * std::cos(k * u)};
  }
  [[nodiscard]] ProfilePoint<double> evaluate(int, double u) const { return evaluate(u); }
};

PiecewiseProfile<double> cone(double slope) {
  return PiecewiseProfile<double>({ProfilePiece<double>::line(-0.05, 0.05, 0.0, 0.0, slope)});
}

PiecewiseProfile<double> single_arc(double radius, double lower, double upper) {
  return PiecewiseProfile<double>(
      {ProfilePiece<double>::arc(lower, upper, 0.0, -radius, radius, true)});
}

// A rail of any lean whose profile's origin is at (0, 0.75, 0) on the left or mirrored.
RailFrame<double> frame_at(Side side, double lean) {
  const double s = outboard_sign<double>(side);
  RailFrame<double> frame;
  frame.side = side;
  frame.origin_track = Vector3<double>(0, s * 0.75, 0);
  frame.axes_track << s, 0, 0, 0, s * std::cos(lean), -s * std::sin(lean), 0, std::sin(lean),
      std::cos(lean);
  frame.inclination = lean;
  return frame;
}

WheelPlacement<double> level_placement(double height) {
  WheelPlacement<double> placement;
  placement.position_rail = Vector3<double>(0, 0, height);
  return placement;
}

}  // namespace

TEST_CASE("find_contact: a cone on an arc rail gives the closed form", "[contact][reference]") {
  constexpr double radius = 0.3, nominal = 0.46;
  int checked = 0;
  for (const Side side : sides) {
    for (const double slope : {-0.05, -0.025, 0.05}) {
      for (const double lean : {0.0, 0.05}) {
        for (const double roll : {-0.006, 0.0, 0.004}) {
          for (const double yaw : {-0.02, 0.0, 0.015}) {
            const auto frame = frame_at(side, lean);
            const Wheel wheel(cone(slope), nominal);
            const Rail rail(single_arc(radius, -0.06, 0.06));
            // The outline of a cone is a straight line through the projections of two points: at
            // wheel angle s with sin s = slope tan(yaw), turned by the yaw, then by the roll.
            WheelPlacement<double> placement;
            placement.side = side;
            placement.position_rail = Vector3<double>(0, 0.002, nominal - 50e-6);
            placement.sin_yaw = std::sin(yaw);
            placement.cos_yaw = std::cos(yaw);
            placement.tan_yaw = placement.sin_yaw / placement.cos_yaw;
            placement.sin_roll = std::sin(roll);
            placement.cos_roll = std::cos(roll);
            placement.inclination = frame.inclination;
            const double angle = std::asin(slope * std::tan(yaw));
            const auto outline = [&](double u) {
              const double r = nominal + slope * u;
              const double y = -r * std::sin(angle) * std::sin(yaw) + u * std::cos(yaw);
              const double z = -r * std::cos(angle);
              return std::array<double, 2>{
                  0.002 + std::cos(roll) * y - std::sin(roll) * z,
                  nominal - 50e-6 + std::sin(roll) * y + std::cos(roll) * z};
            };
            const auto p = outline(0.0), q = outline(1.0);
            const double dy = q[0] - p[0], dz = q[1] - p[1], length = std::hypot(dy, dz);
            // The circle's centre is at (0, -radius): its foot on the line and its distance.
            const double u = (-p[0] * dy + (-radius - p[1]) * dz) / (length * length);
            const double distance = (p[1] + radius) * dy / length - p[0] * dz / length;
            const auto result = find_contact(wheel, rail, placement);
            CAPTURE(slope, lean, roll, yaw, u, radius - distance);
            REQUIRE(result.status == SearchStatus::complete);
            if (radius - distance < 0 || std::abs(u) > 0.05) {
              CHECK(result.patches.empty());
              continue;
            }
            ++checked;
            REQUIRE(result.patches.size() == 1);
            const auto& patch = result.patches[0];
            CHECK(std::abs(patch.penetration - (radius - distance)) < 1e-15);
            CHECK(std::abs(patch.wheel_lateral - u) < 1e-12);
            CHECK(std::abs(patch.rail_lateral + radius * dz / length) < 1e-12);
            CHECK(std::abs(std::abs(patch.wheel_angle) - std::abs(angle)) < 1e-14);
            const double offset = (u * (1 + slope * slope) + slope * nominal) * std::sin(yaw);
            CHECK(std::abs(std::abs(patch.longitudinal) - std::abs(offset)) < 1e-12);
            CHECK(std::abs(patch.contact_angle - (std::atan2(dz, dy) + lean)) < 1e-13);
            CHECK(patch.rolling_radius == Approx(nominal + slope * u));
            CHECK(patch.rail_lateral_curvature == Approx(1 / radius));
          }
        }
      }
    }
  }
  CHECK(checked > 60);
}

TEST_CASE("find_contact: a cone without roll touches where the rail's slope is its own",
          "[contact][reference]") {
  for (const Side side : sides) {
    for (const double shift : {-0.006, 0.0, 0.005}) {
      const Wheel wheel(cone(-0.05), 0.46);
      const Rail rail(single_arc(0.3, -0.06, 0.06));
      const auto frame = frame_at(side, 0.0);
      const double s = outboard_sign<double>(side);
      const Vector3<double> wheel_track(0.3, s * (0.75 + shift), 0.4595);
      const auto placement = place_wheel(frame, wheel_track, Vector3<double>(0, s, 0));
      const auto result = find_contact(wheel, rail, placement, {.penetration_threshold = -0.01});
      REQUIRE(result.patches.size() == 1);
      // The lower outline rises outwards with slope 0.05: so does the rail, on its gauge side.
      CHECK(std::abs(result.patches[0].rail_lateral + 0.3 * std::sin(std::atan(0.05))) < 1e-12);
      CHECK(result.patches[0].contact_angle == Approx(std::atan(0.05)));
    }
  }
}

TEST_CASE("find_contact: finds what brute force finds on the real profile", "[contact][random]") {
  const Tally tally = random_poses(s1002<double>(), 640, 20240501U);
  CHECK(tally.zones[1] > 300);
  CHECK(tally.zones[2] >= 10);
  CHECK(tally.zones[3] >= 2);
  CHECK(tally.in_fillet > 30);
  CHECK(tally.on_flange > 30);
}

TEST_CASE("find_contact: finds what brute force finds on the convex profile", "[contact][random]") {
  const Tally tally = random_poses(ConvexModification(s1002<double>()), 320, 20240502U);
  CHECK(tally.zones[1] > 150);
  CHECK(tally.zones[2] >= 4);
  CHECK(tally.on_flange > 15);
}

TEST_CASE("find_contact: finds what brute force finds in ten thousand poses",
          "[contact][random][.][slow]") {
  const Tally real = random_poses(s1002<double>(), 8000, 1U);
  CHECK(real.zones[2] > 200);
  CHECK(real.zones[3] > 20);
  const Tally convex = random_poses(ConvexModification(s1002<double>()), 2000, 2U);
  CHECK(convex.zones[2] > 20);
}

TEST_CASE("find_contact: flange, fillet and two zones are those of brute force",
          "[contact][reference]") {
  // Shift and roll of the wheelset; what the left wheel then does at a depth of 0.1 mm.
  struct Case {
    double lateral_shift, roll, yaw;
  };
  const Case cases[] = {{8e-3, 0, 0},         {10e-3, 0, 0.03},     {7e-3, 0, -0.03},
                        {5.5e-3, 0, 0},       {5.8e-3, 0, 0.02},    {6.0e-3, 0, 0},
                        {6.2e-3, 0, 0},       {6.2e-3, 0, 0.02},    {6.3e-3, 0, -0.01},
                        {6.4e-3, 1e-4, 0.01}, {-10e-3, 0.002, 0.03}};
  Tally tally;
  const Wheel wheel(s1002<double>(), 0.43);
  for (const Case& at : cases) {
    for (const Side side : sides) {
      WheelsetPose pose{at.lateral_shift, 0.43, at.roll, at.yaw};
      if (side == Side::right) pose = pose.mirrored();
      const TangentTrack<RailHead<double>> track(uic50<double>());
      set_penetration(pose, wheel, track, side, 1e-4);
      compare_with_brute_force(wheel, uic50<double>(), side, pose, tally);
    }
  }
  CHECK(tally.on_flange >= 6);
  CHECK(tally.in_fillet >= 4);
  CHECK(tally.zones[2] + tally.zones[3] >= 2);
}

TEST_CASE("find_contact: a shallow zone beside a rail's joint is not missed",
          "[contact][regression]") {
  // Where the foot passes from the R13 to the R80 arc under the fillet, the penetration's second
  // derivative changes its sign: a maximum of less than a micrometre above the saddle beside it.
  struct Case {
    double lateral_shift, yaw, roll, height, level;
    bool is_60e1;
  };
  const Case cases[] = {
      {0.0053419198753710652, 0.0038314578382338958, -0.0010877441038571179, 0.43023305968268172,
       -5.3841237638456441e-05, true},
      {0.0056584143799133582, 0.013564036447602887, -0.002181553626784898, 0.43107258796034997,
       6.8026278008168761e-05, false},
      {0.0084876205599767954, -0.010296843842654913, -0.00793907870712777, 0.43542362179226229,
       -3.7602111123167041e-05, false},
      {0.0048376413412072198, -0.022547366715435398, 0.00031185264405636737, 0.42917106515216619,
       -1.65142985233558e-05, true},
      {0.0042017624197515473, 0.0035255179331478612, 0.0013794714418444221, 0.42836151980354209,
       1.2916222503163433e-05, true},
  };
  Tally tally;
  const Wheel wheel(s1002<double>(), 0.43);
  for (const Case& at : cases) {
    const WheelsetPose pose{at.lateral_shift, at.height, at.roll, at.yaw};
    const auto head = at.is_60e1 ? rail_60e1<double>() : uic50<double>();
    compare_with_brute_force(wheel, head, Side::left, pose, tally, at.level);
    compare_with_brute_force(wheel, head, Side::right, pose.mirrored(), tally, at.level);
  }
  CHECK(tally.zones[2] + tally.zones[3] == tally.poses);
}

TEST_CASE("find_contact: wheels apart give an empty, complete result", "[contact]") {
  const Wheel wheel(s1002<double>(), 0.43);
  const TangentTrack<RailHead<double>> track(uic50<double>());
  for (const Side side : sides) {
    WheelsetPose pose{0.001, 0.43, 0.0, 0.01};
    set_penetration(pose, wheel, track, side, -20e-6);
    const auto placement = place<double>(track, side, pose);
    const auto none = find_contact(wheel, track.rail(side), placement);
    CHECK(none.patches.empty());
    CHECK(none.status == SearchStatus::complete);
    CHECK(none.is_proved);
    const auto near =
        find_contact(wheel, track.rail(side), placement, {.penetration_threshold = -50e-6});
    REQUIRE(near.patches.size() == 1);
    CHECK(near.status == SearchStatus::complete);
    CHECK(std::abs(near.patches[0].penetration - (-20e-6)) < 1e-12);
    CHECK(find_contact(wheel, track.rail(side), placement, {.penetration_threshold = -19e-6})
              .patches.empty());
    WheelsetPose far = pose;
    far.height = 100.0;
    const auto away = find_contact(wheel, track.rail(side), place<double>(track, side, far));
    CHECK(away.patches.empty());
    CHECK(away.status == SearchStatus::complete);
  }
}

TEST_CASE("find_contact: NaN and infinity give not_finite", "[contact][bad-input]") {
  const Wheel wheel(s1002<double>(), 0.43);
  const Rail rail(uic50<double>());
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (int field = 0; field < 8; ++field) {
      CAPTURE(bad, field);
      WheelPlacement<double> placement = level_placement(0.4299);
      SearchOptions<double> options;
      if (field < 3) placement.position_rail(field) = bad;
      if (field == 3) placement.sin_yaw = bad;
      if (field == 4) placement.cos_yaw = bad;
      placement.tan_yaw = placement.sin_yaw / placement.cos_yaw;
      if (field == 5) placement.sin_roll = bad;
      if (field == 6) placement.cos_roll = bad;
      if (field == 7) options.penetration_threshold = bad;
      const auto result = find_contact(wheel, rail, placement, options);
      CHECK(result.status == SearchStatus::not_finite);
      CHECK(result.patches.empty());
    }
  }
  CHECK(find_contact(wheel, rail, level_placement(0.4299)).patches.size() == 1);
}

TEST_CASE("find_contact: more zones than fit are reported, the first ones returned", "[contact]") {
  const Wheel wheel(Ripples{}, 0.43);
  const Rail rail(single_arc(10.0, -0.06, 0.06));
  // Crest n is n^2 (4 mm)^2 / 20 m = n^2 0.8 um further from the rail than that at 0.
  const auto three = find_contact(wheel, rail, level_placement(0.43 + 8e-6));
  REQUIRE(three.patches.size() == 3);
  CHECK(three.status == SearchStatus::complete);
  for (std::size_t i = 0; i < 3; ++i) {
    const double crest = (static_cast<double>(i) - 1.0) * Ripples::wavelength;
    CHECK(std::abs(three.patches[i].wheel_lateral - crest) < 2e-5);
    // Tilted against the crest by crest / 10 m, and 1 / (amplitude k^2) its radius: to second
    // order.
    const double k = 2 * pi<double>() / Ripples::wavelength;
    const double gain = crest * crest / 100 / (2 * Ripples::amplitude * k * k);
    CHECK(std::abs(three.patches[i].penetration - (2e-6 - crest * crest / 20 + gain)) < 1e-10);
  }
  const Rail flat(single_arc(1e4, -0.06, 0.06));
  const auto many = find_contact(wheel, flat, level_placement(0.43));
  CHECK(many.status == SearchStatus::too_many_patches);
  REQUIRE(many.patches.size() == ContactResult<double>::maximum_patches);
  for (std::size_t i = 0; i < many.patches.size(); ++i) {
    CHECK(std::abs(many.patches[i].wheel_lateral + 0.04 - static_cast<double>(i) * 4e-3) < 2e-5);
  }
}

TEST_CASE("find_contact: the mirrored wheelset has mirrored patches, bit for bit",
          "[contact][symmetry]") {
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Wheel wheel(s1002<double>(), 0.43);
  const TangentTrack<RailHead<double>> track(rail_60e1<double>());
  std::size_t patches = 0;
  for (int i = 0; i < 100; ++i) {
    WheelsetPose pose{0.01 * uniform(generator), 0.43, 0.01 * uniform(generator),
                      0.03 * uniform(generator)};
    set_penetration(pose, wheel, track, Side::left, 2e-4);
    const auto left =
        find_contact(wheel, track.rail(Side::left), place<double>(track, Side::left, pose));
    const auto right = find_contact(wheel, track.rail(Side::right),
                                    place<double>(track, Side::right, pose.mirrored()));
    REQUIRE(left.patches.size() == right.patches.size());
    CHECK(left.evaluations == right.evaluations);
    for (std::size_t k = 0; k < left.patches.size(); ++k) {
      ++patches;
      const auto& a = left.patches[k];
      const auto& b = right.patches[k];
      CHECK(a.wheel_lateral == b.wheel_lateral);
      CHECK(a.rail_lateral == b.rail_lateral);
      CHECK(a.wheel_angle == -b.wheel_angle);
      CHECK(a.longitudinal == b.longitudinal);
      CHECK(a.penetration == b.penetration);
      CHECK(a.zone_lower == b.zone_lower);
      CHECK(a.zone_upper == b.zone_upper);
      CHECK(a.zone_is_cut == b.zone_is_cut);
      CHECK(a.contact_angle == b.contact_angle);
      CHECK(a.rolling_radius == b.rolling_radius);
      CHECK(a.wheel_longitudinal_curvature == b.wheel_longitudinal_curvature);
      CHECK(a.wheel_lateral_curvature == b.wheel_lateral_curvature);
      CHECK(a.rail_lateral_curvature == b.rail_lateral_curvature);
      CHECK(a.position_rail.tail(2) == b.position_rail.tail(2));
      CHECK(a.position_rail.x() == -b.position_rail.x());
      CHECK(a.normal_rail == b.normal_rail);
    }
  }
  CHECK(patches >= 100);
}

TEST_CASE("find_contact: does not allocate", "[contact][no-alloc]") {
  const Wheel wheel(s1002<double>(), 0.43);
  const TangentTrack<RailHead<double>> track(uic50<double>());
  for (const double shift : {0.0, 6.3e-3, 9e-3}) {
    WheelsetPose pose{shift, 0.43, 0.0, 0.01};
    set_penetration(pose, wheel, track, Side::left, 1e-4);
    const auto placement = place<double>(track, Side::left, pose);
    std::size_t patches = 0;
    const long allocations = wheelrail_test::allocations_of(
        [&] { patches = find_contact(wheel, track.rail(Side::left), placement).patches.size(); });
    CHECK(allocations == 0);
    CHECK(patches > 0);
  }
  CHECK(wheelrail_test::allocations_of([] { return std::vector<double>(3).size(); }) >= 0);
}

namespace {

template <class T>
ContactResult<T> contact_in(const WheelsetPose& pose, Side side) {
  const Wheel<PiecewiseProfile<T>> wheel(s1002<T>(), constant<T>(0.43L));
  const TangentTrack<RailHead<T>> track(uic50<T>());
  return find_contact(wheel, track.rail(side), place<T>(track, side, pose));
}

}  // namespace

TEST_CASE("find_contact: float, long double and a strict scalar agree with double", "[contact]") {
  using wheelrail_test::StrictScalar;
  const Wheel wheel(s1002<double>(), 0.43);
  const TangentTrack<RailHead<double>> track(uic50<double>());
  for (const WheelsetPose& start :
       {WheelsetPose{0, 0.43, 0, 0.01}, WheelsetPose{0.003, 0.43, -0.001, -0.02},
        WheelsetPose{0.008, 0.43, 0, 0.01}, WheelsetPose{-0.008, 0.43, 0, 0.03}}) {
    for (const Side side : sides) {
      WheelsetPose pose = start;
      set_penetration(pose, wheel, track, side, 1e-4);
      CAPTURE(pose.lateral_shift, name_of(side));
      const auto expected = contact_in<double>(pose, side);
      const auto wide = contact_in<long double>(pose, side);
      const auto narrow = contact_in<float>(pose, side);
      const auto strict = contact_in<StrictScalar>(pose, side);
      REQUIRE(expected.patches.size() == 1);
      REQUIRE(wide.patches.size() == 1);
      REQUIRE(narrow.patches.size() == 1);
      REQUIRE(strict.patches.size() == 1);
      CHECK(narrow.status == SearchStatus::complete);
      const auto& patch = expected.patches[0];
      CHECK(std::abs(static_cast<double>(wide.patches[0].penetration) - patch.penetration) < 1e-15);
      CHECK(std::abs(static_cast<double>(wide.patches[0].wheel_lateral) - patch.wheel_lateral) <
            1e-12);
      // A length of 1 m is held to 6e-8 m by a float; a slope error of 1e-6 over a relative
      // curvature of 2 /m or more moves the deepest point by up to 0.5 um and more.
      CHECK(std::abs(static_cast<double>(narrow.patches[0].penetration) - patch.penetration) <
            5e-7);
      CHECK(std::abs(static_cast<double>(narrow.patches[0].wheel_lateral) - patch.wheel_lateral) <
            2e-5);
      CHECK(strict.patches[0].penetration.as_double() == patch.penetration);
      CHECK(strict.patches[0].wheel_lateral.as_double() == patch.wheel_lateral);
      CHECK(strict.patches[0].contact_angle.as_double() == patch.contact_angle);
      CHECK(strict.evaluations == expected.evaluations);
    }
  }
}

TEST_CASE("find_contact: a user's own profiles serve as wheel and rail", "[contact]") {
  static_assert(Profile<Parabola> && !HasClosestPoint<Parabola>);
  // Osculating parabolas f = -u^2 / (2 R), F = -0.03 u - u^2 / (2 r): by hand, without roll and
  // yaw, from the condition that the slopes are equal and the chord is normal.
  const double rail_radius = 0.3, wheel_radius = 0.5;
  const Parabola wheel_profile(-0.03, -0.5 / wheel_radius);
  const Parabola rail_profile(0.0, -0.5 / rail_radius);
  const Wheel wheel(wheel_profile, 0.43);
  const Rail rail(rail_profile);
  const auto placement = level_placement(0.43);
  const auto result = find_contact(wheel, rail, placement, {.penetration_threshold = -1e-3});
  REQUIRE(result.status == SearchStatus::complete);
  REQUIRE(result.patches.size() == 1);
  const auto& patch = result.patches[0];
  const double wheel_slope = -wheel_profile.evaluate(patch.wheel_lateral).slope;
  const double rail_slope = rail_profile.evaluate(patch.rail_lateral).slope;
  CHECK(std::abs(wheel_slope - (rail_slope)) < 1e-12);
  const double dy = patch.wheel_lateral - patch.rail_lateral;
  const double dz = -wheel_profile.evaluate(patch.wheel_lateral).value -
                    rail_profile.evaluate(patch.rail_lateral).value;
  CHECK(std::abs(dy + dz * rail_slope) < 1e-12);
  CHECK(std::abs(patch.penetration - (-dz * std::sqrt(1 + rail_slope * rail_slope))) < 1e-13);
  // To first order the slopes -(−0.03 − u/r) and −u/R are equal at u = −0.03 / (1/r + 1/R).
  CHECK(patch.wheel_lateral == Approx(-0.03 / (1 / wheel_radius + 1 / rail_radius)).epsilon(0.01));
}

TEST_CASE("find_contact: a rail profile cut short gives zone_is_cut", "[contact]") {
  // A cylinder on an arc at 0.1 mm depth: the zone is 2 sqrt(2 R d) = 15.5 mm wide.
  const Wheel wheel(cone(0.0), 0.43);
  const auto placement = level_placement(0.43 - 1e-4);
  const double half = std::sqrt(2 * 0.3 * 1e-4);
  const auto whole = find_contact(wheel, Rail(single_arc(0.3, -0.03, 0.03)), placement);
  REQUIRE(whole.patches.size() == 1);
  CHECK(!whole.patches[0].zone_is_cut);
  CHECK(whole.patches[0].zone_upper == Approx(half).epsilon(1e-3));
  CHECK(whole.patches[0].zone_lower == Approx(-half).epsilon(1e-3));
  const auto right_cut = find_contact(wheel, Rail(single_arc(0.3, -0.03, 0.004)), placement);
  REQUIRE(right_cut.patches.size() == 1);
  CHECK(right_cut.patches[0].zone_is_cut);
  CHECK(std::abs(right_cut.patches[0].zone_upper - 0.004) < 0.501e-3);
  CHECK(right_cut.patches[0].zone_lower == Approx(-half).epsilon(1e-3));
  const auto left_cut = find_contact(wheel, Rail(single_arc(0.3, -0.004, 0.03)), placement);
  REQUIRE(left_cut.patches.size() == 1);
  CHECK(left_cut.patches[0].zone_is_cut);
  CHECK(std::abs(left_cut.patches[0].zone_lower + 0.004) < 0.501e-3);
  CHECK(std::abs(left_cut.patches[0].wheel_lateral) < 1e-12);
  // A wheel cut short is cut exactly at its end.
  const PiecewiseProfile<double> narrow({ProfilePiece<double>::line(-0.003, 0.05, 0, 0, 0)});
  const auto wheel_cut =
      find_contact(Wheel(narrow, 0.43), Rail(single_arc(0.3, -0.03, 0.03)), placement);
  REQUIRE(wheel_cut.patches.size() == 1);
  CHECK(wheel_cut.patches[0].zone_is_cut);
  CHECK(wheel_cut.patches[0].zone_lower == -0.003);
}

TEST_CASE("find_contact: deeper than it is meant for is a status", "[contact][bad-input]") {
  const Wheel wheel(s1002<double>(), 0.43);
  const TangentTrack track(uic50<double>());
  const auto find = [&](double height, const SearchOptions<double>& options) {
    const Vector3<double> wheel_track(0, 0.75, height);
    return find_contact(wheel, track.rail(Side::left),
                        place_wheel(track.nearest_frame(Side::left, wheel_track), wheel_track,
                                    Vector3<double>(0, 1, 0)),
                        options);
  };
  CHECK(find(0.4290, {}).status == SearchStatus::complete);
  CHECK(find(0.40, {}).status == SearchStatus::too_deep);
  CHECK_FALSE(find(0.40, {}).patches.empty());
  CHECK(find(0.4290, {.maximum_penetration = 0.1e-3}).status == SearchStatus::too_deep);
}

namespace {

struct Walked : RailHead<double> {
  using RailHead<double>::RailHead;
  using RailHead<double>::evaluate;
  // The field side's face, which no wheel reaches, passes for concave.
  [[nodiscard]] ProfilePoint<double> evaluate(int piece, const double& u) const {
    auto point = RailHead<double>::evaluate(piece, u);
    if (piece == 6) point.second_derivative = 1e-9;
    return point;
  }
};

}  // namespace

// The same answers as a walk over every strip, with a fraction of the evaluations.
TEST_CASE("find_contact: what the bound leaves out does not change the result",
          "[contact][random]") {
  const RailHead<double> head = uic50<double>();
  // A rail whose profile is not taken for convex is walked over strip by strip.
  const Rail<RailHead<double>> bounded(head);
  REQUIRE(bounded.is_convex());
  const Rail<Walked> walked{Walked(head.dimensions())};
  REQUIRE_FALSE(walked.is_convex());
  const Wheel wheel(s1002<double>(), 0.43);
  const TangentTrack track(head);
  std::mt19937 random(11);
  const auto between = [&random](double lower, double upper) {
    return lower + (upper - lower) * (static_cast<double>(random()) / 4294967296.0);
  };
  long with_bound = 0, without = 0;
  int touching = 0, several = 0, provable = 0;
  for (int i = 0; i < 4000; ++i) {
    const double height = between(0.4294, 0.4306);
    const double lateral = 0.75 + between(-0.008, 0.008);
    const Vector3<double> wheel_track(0, lateral, height);
    const double yaw = between(-0.03, 0.03), roll = between(-0.01, 0.01);
    const Vector3<double> axle_track(-std::sin(yaw) * std::cos(roll),
                                     std::cos(yaw) * std::cos(roll), std::sin(roll));
    const auto placement =
        place_wheel(track.nearest_frame(Side::left, wheel_track), wheel_track, axle_track);
    const auto a = find_contact(wheel, bounded, placement);
    const auto b = find_contact(wheel, walked, placement);
    // Beyond some 19 mrad the fillet's locus bends too much for the proof.
    provable += std::abs(yaw) < 0.018;
    if (std::abs(yaw) < 0.018) CHECK(a.is_proved);
    CHECK_FALSE(b.is_proved);
    with_bound += a.evaluations;
    without += b.evaluations;
    CAPTURE(i, wheel_track.y(), wheel_track.z(), yaw, roll);
    REQUIRE(a.patches.size() == b.patches.size());
    touching += !a.patches.empty();
    several += a.patches.size() > 1;
    for (std::size_t k = 0; k < a.patches.size(); ++k) {
      CHECK(a.patches[k].penetration == Approx(b.patches[k].penetration).margin(1e-14));
      CHECK(a.patches[k].zone_lower == Approx(b.patches[k].zone_lower).margin(1e-11));
      CHECK(a.patches[k].zone_upper == Approx(b.patches[k].zone_upper).margin(1e-11));
    }
  }
  CHECK(touching > 800);
  CHECK(several > 20);
  CHECK(provable > 2000);
  CHECK(with_bound < 4000 * 28);  // 25 strips a search
  CHECK(8 * with_bound < without);
}

namespace {

// Equal to the last bit.
void check_same(const ContactResult<double>& a, const ContactResult<double>& b) {
  REQUIRE(a.patches.size() == b.patches.size());
  CHECK(a.status == b.status);
  CHECK(a.is_proved == b.is_proved);
  for (std::size_t k = 0; k < a.patches.size(); ++k) {
    CHECK(a.patches[k].wheel_lateral == b.patches[k].wheel_lateral);
    CHECK(a.patches[k].rail_lateral == b.patches[k].rail_lateral);
    CHECK(a.patches[k].penetration == b.patches[k].penetration);
    CHECK(a.patches[k].zone_lower == b.patches[k].zone_lower);
    CHECK(a.patches[k].zone_upper == b.patches[k].zone_upper);
    CHECK(a.patches[k].position_rail == b.patches[k].position_rail);
  }
}

}  // namespace

TEST_CASE("find_contact: a memory changes no bit of the result, whatever it was used for",
          "[contact][random]") {
  const TangentTrack track(uic50<double>()), other_track(rail_60e1<double>());
  const Wheel real(s1002<double>(), 0.43);
  std::mt19937 random(17);
  const auto between = [&random](double lower, double upper) {
    return lower + (upper - lower) * (static_cast<double>(random()) / 4294967296.0);
  };
  SearchMemory<double> memory(real);
  SearchMemory<double> brief_memory(real);
  long cold_evaluations = 0, warm_evaluations = 0, brief_evaluations = 0;
  int touching = 0, several = 0;
  double lateral = 0, height = 0, yaw = 0, roll = 0;
  for (int i = 0; i < 3000; ++i) {
    // Runs of small steps, and jumps between them and between the rails.
    if (i % 20 == 0) {
      lateral = 0.75 + between(-0.008, 0.008);
      height = between(0.4294, 0.4302);
      yaw = between(-0.02, 0.02);
      roll = between(-0.003, 0.003);
    }
    lateral += between(-1e-5, 1e-5);
    height += between(-1e-6, 1e-6);
    const auto& on = i / 200 % 2 == 0 ? track : other_track;
    const Vector3<double> wheel_track(0, lateral, height);
    const Vector3<double> axle_track(-std::sin(yaw) * std::cos(roll),
                                     std::cos(yaw) * std::cos(roll), std::sin(roll));
    const auto placement =
        place_wheel(on.nearest_frame(Side::left, wheel_track), wheel_track, axle_track);
    const auto cold = find_contact(real, on.rail(Side::left), placement);
    const auto warm = find_contact(real, on.rail(Side::left), placement, memory);
    CAPTURE(i, lateral, height, yaw, roll);
    check_same(cold, warm);
    const auto brief =
        find_contact(real, on.rail(Side::left), placement, brief_memory, {.zone_ends = false});
    REQUIRE(brief.patches.size() == cold.patches.size());
    for (std::size_t k = 0; k < brief.patches.size(); ++k) {
      CHECK(brief.patches[k].wheel_lateral == cold.patches[k].wheel_lateral);
      CHECK(brief.patches[k].penetration == cold.patches[k].penetration);
      CHECK(brief.patches[k].zone_is_cut == cold.patches[k].zone_is_cut);
      CHECK(std::isnan(brief.patches[k].zone_lower));
      CHECK(std::isnan(brief.patches[k].zone_upper));
    }
    brief_evaluations += brief.evaluations;
    cold_evaluations += cold.evaluations;
    warm_evaluations += warm.evaluations;
    touching += !cold.patches.empty();
    several += cold.patches.size() > 1;
  }
  CHECK(touching > 1000);
  CHECK(several > 5);
  UNSCOPED_INFO(cold_evaluations << ' ' << warm_evaluations << ' ' << brief_evaluations);
  CHECK(20 * warm_evaluations < 17 * cold_evaluations);
  CHECK(10 * brief_evaluations < 6 * cold_evaluations);
}

TEST_CASE("find_contact: in single precision a memory changes rounding only", "[contact][random]") {
  const TangentTrack track(uic50<float>());
  const Wheel real(s1002<float>(), 0.43F);
  SearchMemory<float> memory(real);
  std::mt19937_64 generator(5U);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  double lateral = 0, height = 0, yaw = 0, roll = 0;
  int touching = 0, warm = 0, cold = 0;
  for (int i = 0; i < 6000; ++i) {
    if (i % 20 == 0) {
      lateral = 0.75 + 0.008 * uniform(generator);
      height = 0.4298 + 4e-4 * uniform(generator);
      yaw = 0.02 * uniform(generator);
      roll = 0.003 * uniform(generator);
    }
    lateral += 1e-5 * uniform(generator);
    height += 1e-6 * uniform(generator);
    const WheelsetPose::Point at{0.0, lateral, height};
    const WheelsetPose::Point axle{-std::sin(yaw) * std::cos(roll), std::cos(yaw) * std::cos(roll),
                                   std::sin(roll)};
    const Vector3<float> wheel_track = vector_of<float>(at);
    const auto placement = place_wheel(track.nearest_frame(Side::left, wheel_track), wheel_track,
                                       vector_of<float>(axle));
    const auto expected = find_contact(real, track.rail(Side::left), placement);
    const auto found = find_contact(real, track.rail(Side::left), placement, memory);
    CAPTURE(i, lateral, height, yaw, roll);
    CHECK(found.status == expected.status);
    CHECK(found.is_proved == expected.is_proved);
    REQUIRE(found.patches.size() == expected.patches.size());
    for (std::size_t k = 0; k < found.patches.size(); ++k) {
      CHECK(std::abs(found.patches[k].penetration - expected.patches[k].penetration) <=
            2 * epsilon<float>() * 0.43F);
      ++touching;
    }
    cold += expected.evaluations;
    warm += found.evaluations;
  }
  CHECK(touching > 2000);
  CHECK(warm < cold);
}

TEST_CASE("find_contact: over a rail's convex corner the deepest point is that of both arcs",
          "[contact][reference]") {
  // Two arcs that meet at lateral 0 with slopes 0.05 and -0.05: inside both, a point is as deep as in
  // the nearer one. The last wheel is more hollow than they are curved: only the corner touches it.
  constexpr double radius = 0.3, nominal = 0.43;
  const double centre = radius * std::sin(std::atan(0.05));
  const double down = -radius * std::cos(std::atan(0.05));
  using Piece = ProfilePiece<double>;
  const Rail rail(PiecewiseProfile<double>({Piece::arc(-0.12, 0.0, centre, down, radius, true),
                                            Piece::arc(0.0, 0.12, -centre, down, radius, true)}));
  REQUIRE(rail.is_proved_convex());
  const std::array<PiecewiseProfile<double>, 3> profiles{
      cone(-0.05), cone(0.025),
      PiecewiseProfile<double>({Piece::arc(-0.03, 0.03, 0.0, 0.27, 0.27, false)})};
  std::mt19937_64 generator(20261123U);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const auto& profile : profiles) {
    int at_corner = 0, over_lateral_zero = 0, elsewhere = 0;
    const Wheel wheel(profile, nominal);
    SearchMemory<double> memory(wheel);
    for (int i = 0; i < 200; ++i) {
      WheelPlacement<double> placement;
      const double roll = 0.1 * uniform(generator);
      // Every fourth wheel stands with its lateral 0 over the corner.
      const double shift = i % 4 == 0 ? -nominal * std::sin(roll) : 0.01 * uniform(generator);
      placement.sin_roll = std::sin(roll);
      placement.cos_roll = std::cos(roll);
      const auto depths = [&](double u, double height) {
        const double r = nominal + profile.evaluate(u).value;
        const double y = shift + std::cos(roll) * u + std::sin(roll) * r;
        const double z = height + std::sin(roll) * u - std::cos(roll) * r;
        return std::array<double, 2>{radius - std::hypot(y - centre, z - down),
                                     radius - std::hypot(y + centre, z - down)};
      };
      const auto depth = [&](double u, double height) {
        const auto [left, right] = depths(u, height);
        return std::min(left, right);
      };
      const auto deepest = [&](double height) {
        double lower = profile.lower(), upper = profile.upper();
        for (int k = 0; k < 120; ++k) {
          const double third = (upper - lower) / 3;
          const bool is_left = depth(lower + third, height) > depth(upper - third, height);
          (is_left ? upper : lower) = is_left ? upper - third : lower + third;
        }
        return lower;
      };
      double height = nominal;
      const double wanted = 1e-6 * std::pow(500.0, (uniform(generator) + 1) / 2);
      for (int k = 0; k < 12; ++k) height += depth(deepest(height), height) - wanted;
      placement.position_rail = Vector3<double>(0, shift, height);
      const double u = deepest(height);
      const bool end_touches =
          0 < depth(profile.lower(), height) || 0 < depth(profile.upper(), height);
      if (end_touches) continue;
      const auto result = find_contact(wheel, rail, placement, memory);
      CAPTURE(roll, shift, height, u, depth(u, height));
      REQUIRE(result.status == SearchStatus::complete);
      CHECK(result.is_proved);
      REQUIRE(result.patches.size() == 1);
      const Patch<double>& patch = result.patches[0];
      CHECK(std::abs(patch.penetration - depth(u, height)) < 1e-13);
      const auto [left, right] = depths(u, height);
      const bool is_at_corner = std::abs(left - right) < 1e-13;
      CHECK(std::abs(patch.wheel_lateral - u) < (is_at_corner ? 1e-12 : 1e-8));
      ++(is_at_corner ? at_corner : elsewhere);
      over_lateral_zero += is_at_corner && std::abs(u) < 1e-9 ? 1 : 0;
      // What a memory keeps of a corner holds for small motions only.
      for (int k = 0; k < 4; ++k) {
        placement.position_rail.y() += 4e-5 * uniform(generator);
        check_same(find_contact(wheel, rail, placement),
                   find_contact(wheel, rail, placement, memory));
      }
    }
    CHECK(at_corner > 40);
    CHECK(over_lateral_zero > 10);
    CHECK((elsewhere > 60) == (&profile != &profiles.back()));
  }
}

TEST_CASE("find_contact: zones between two strips are found and counted", "[contact][reference]") {
  // Chebyshev's T8 as a ripple of five crests on a cylinder, all between two strips 5 mm apart.
  const double crest = 20e-6;
  const std::array<double, 9> t8{crest,        0, -32 * crest, 0, 160 * crest, 0,
                                 -256 * crest, 0, 128 * crest};
  using Piece = ProfilePiece<double>;
  const PiecewiseProfile<double> profile({Piece::line(-0.03, -0.002, 0, -0.001, 0),
                                          Piece::polynomial(-0.002, 0.002, 0, 0.002, t8),
                                          Piece::line(0.002, 0.03, 0, -0.001, 0)});
  const Wheel coarse(profile, 0.43, 5e-3), fine(profile, 0.43, 2e-5);
  const Rail rail(uic50<double>());
  std::array<int, 6> counts{};
  for (int i = 0; i < 600; ++i) {
    // From clear of the rail to all crests joined; a little roll makes the crests uneven.
    WheelPlacement<double> placement;
    const double roll = 1e-3 * (i % 7 - 3), yaw = 0.01 * (i % 3 - 1);
    placement.position_rail = {0, 1e-4 * (i % 5), 0.43 + crest - 0.1e-6 * i + 1e-6};
    placement.sin_roll = std::sin(roll);
    placement.cos_roll = std::cos(roll);
    placement.sin_yaw = std::sin(yaw);
    placement.cos_yaw = std::cos(yaw);
    placement.tan_yaw = std::tan(yaw);
    const auto found = find_contact(coarse, rail, placement);
    const auto all = find_contact(fine, rail, placement);
    CAPTURE(i, found.evaluations, all.evaluations);
    CHECK(found.status == SearchStatus::complete);
    CHECK(found.is_proved);
    REQUIRE(found.patches.size() == all.patches.size());
    ++counts[std::min<std::size_t>(found.patches.size(), 5)];
    for (std::size_t k = 0; k < all.patches.size(); ++k) {
      CHECK(found.patches[k].penetration == Approx(all.patches[k].penetration).margin(1e-13));
      CHECK(found.patches[k].wheel_lateral == Approx(all.patches[k].wheel_lateral).margin(1e-8));
    }
  }
  for (const int count : counts) CHECK(count > 2);
}

TEST_CASE("find_contact: what is not proved is not called so", "[contact]") {
  const TangentTrack track(uic50<double>());
  const Wheel wheel(s1002<double>(), 0.43);
  const auto at = [&](double lateral, double height, double yaw) {
    const Vector3<double> wheel_track(0, lateral, height);
    const Vector3<double> axle_track(-std::sin(yaw), std::cos(yaw), 0);
    return place_wheel(track.nearest_frame(Side::left, wheel_track), wheel_track, axle_track);
  };
  const auto& rail = track.rail(Side::left);
  CHECK(find_contact(wheel, rail, at(0.752, 0.4297, 0.01)).is_proved);
  // In the fillet, which conforms to the rail's corner, division is needed.
  const auto divided = at(0.7565, 0.4300, 0.005);
  const auto all = find_contact(wheel, rail, divided);
  CHECK(all.is_proved);
  CHECK_FALSE(find_contact(wheel, rail, divided, {.maximum_evaluations = 1}).is_proved);
  // Not a number: nothing was searched.
  CHECK_FALSE(find_contact(wheel, rail, at(std::nan(""), 0.43, 0)).is_proved);
}

TEST_CASE("find_contact: no iteration fails, also at 50 mrad of yaw", "[contact][random]") {
  long searches = 0, patches = 0, failures = 0;
  const auto count = [&](const auto& profile, const RailHead<double>& head) {
    const Wheel wheel(profile, 0.43);
    const TangentTrack track(head);
    std::mt19937 random(5);
    const auto between = [&random](double lower, double upper) {
      return lower + (upper - lower) * (static_cast<double>(random()) / 4294967296.0);
    };
    for (int i = 0; i < 20000; ++i) {
      const double yaw = between(-0.05, 0.05), roll = between(-0.01, 0.01);
      const double lateral_shift = between(-0.012, 0.012), height = between(0.4285, 0.4345);
      const Vector3<double> axle_track(-std::sin(yaw) * std::cos(roll),
                                       std::cos(yaw) * std::cos(roll), std::sin(roll));
      const Vector3<double> wheel_track =
          Vector3<double>(0, lateral_shift, height) + 0.75 * axle_track;
      const auto found = find_contact(
          wheel, track.rail(Side::left),
          place_wheel(track.nearest_frame(Side::left, wheel_track), wheel_track, axle_track));
      ++searches;
      patches += static_cast<long>(found.patches.size());
      failures += found.status == SearchStatus::not_converged;
    }
  };
  count(s1002<double>(), uic50<double>());
  count(s1002<double>(), rail_60e1<double>());
  count(ConvexModification(s1002<double>()), uic50<double>());
  CHECK(failures == 0);
  CHECK(patches > searches / 4);
}
