#include <Eigen/LU>
#include <limits>
#include <string>
#include <wheelrail/contact/find_contact.hpp>
#include <wheelrail/profile/convex_modification.hpp>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/track/tangent_track.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

using Track = TangentTrack<RailHead<double>>;

template <class R>
std::string message_of(const R& profile, const TrackDimensions<double>& dimensions) {
  try {
    const TangentTrack<R> track(profile, dimensions);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

// Contact of a centred wheelset, the penetration tending to 0.
template <class P>
double central_contact(const P& profile) {
  const Track track(uic50<double>());
  const Wheel<P> wheel(profile, 0.43);
  double height = 0.43;
  Patch<double> patch;
  for (int i = 0; i < 10; ++i) {
    const Vector3<double> wheel_track(0, 0.75, height);
    const auto placement = place_wheel(track.nearest_frame(Side::left, wheel_track), wheel_track,
                                       Vector3<double>(Vector3<double>::UnitY()));
    const auto result =
        find_contact(wheel, track.rail(Side::left), placement, {.penetration_threshold = -0.01});
    REQUIRE(result.patches.size() == 1);
    patch = result.patches[0];
    height += patch.penetration - 1e-10;
  }
  return patch.wheel_lateral;
}

}  // namespace

TEST_CASE("TangentTrack: the heads' tops lie at z = 0 and the gauge 14 mm below them",
          "[track][reference]") {
  for (const auto& head : {uic50<double>(), rail_60e1<double>()}) {
    for (const double inclination : {0.0, 0.025, 0.05, -0.05}) {
      for (const double gauge : {1.435, 1.0}) {
        CAPTURE(inclination, gauge);
        const Track track(head, {gauge, inclination});
        double inner[2] = {0, 0};
        for (const Side side : sides) {
          const auto frame = track.nearest_frame(side, Vector3<double>::Zero());
          const double s = outboard_sign<double>(side);
          // Dense points of the head, with every piece's slope below 20: 1 um of spacing.
          double highest = -1.0;
          Vector3<double> before = Vector3<double>::Zero();
          bool found = false;
          const int count = 80000;
          for (int i = 0; i <= count; ++i) {
            const double u = head.lower() + (head.upper() - head.lower()) * i / count;
            const Vector3<double> p = frame.position_track(
                Vector3<double>(0, u, head.evaluate(std::min(u, head.upper())).value));
            highest = std::max(highest, p.z());
            if (!found && p.z() >= -0.014) {
              const double part = (-0.014 - before.z()) / (p.z() - before.z());
              inner[index_of(side)] = s * (before.y() + part * (p.y() - before.y()));
              found = true;
            }
            before = p;
          }
          CHECK(highest < 1e-15);
          CHECK(highest > -1e-11);
          // z leans inwards by the inclination.
          const Vector3<double> z_track =
              frame.direction_track(Vector3<double>(Vector3<double>::UnitZ()));
          CHECK(std::abs(-s * z_track.y() / z_track.z() - inclination) < 1e-15);
          CHECK(std::abs(frame.inclination - std::atan(inclination)) < 1e-15);
        }
        CHECK(std::abs(inner[0] + inner[1] - gauge) < 1e-8);
        CHECK(inner[0] == inner[1]);
      }
    }
  }
}

TEST_CASE("TangentTrack: frames are right-handed, mirrored and move along", "[track][symmetry]") {
  const Track track(rail_60e1<double>(), {1.435, 0.025});
  const auto left = track.nearest_frame(Side::left, Vector3<double>(12.5, 3.0, -1.0));
  const auto right = track.nearest_frame(Side::right, Vector3<double>(12.5, 3.0, -1.0));
  for (const auto& frame : {left, right}) {
    CHECK((frame.axes_track.transpose() * frame.axes_track - Matrix3<double>::Identity()).norm() <
          1e-15);
    CHECK(std::abs(frame.axes_track.determinant() - 1) < 1e-15);
    CHECK(frame.origin_track.x() == 12.5);
  }
  CHECK(left.side == Side::left);
  CHECK(right.side == Side::right);
  CHECK(left.axes_track(0, 0) == 1.0);
  CHECK(right.axes_track(0, 0) == -1.0);
  CHECK(left.origin_track.y() == -right.origin_track.y());
  CHECK(left.origin_track.y() > 0);
  CHECK(left.origin_track.z() == right.origin_track.z());
  CHECK(left.axes_track(1, 1) == -right.axes_track(1, 1));
  CHECK(left.axes_track(2, 1) == right.axes_track(2, 1));
  CHECK(left.axes_track(1, 2) == -right.axes_track(1, 2));
  CHECK(left.axes_track(2, 2) == right.axes_track(2, 2));
}

TEST_CASE("TangentTrack: bad data is refused with its value", "[track][bad-input]") {
  using Catch::Matchers::ContainsSubstring;
  const auto head = uic50<double>();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(message_of(head, {0.0, 0.05}), ContainsSubstring("gauge is 0"));
  CHECK_THAT(message_of(head, {-1.435, 0.05}), ContainsSubstring("gauge is -1.435"));
  CHECK_THAT(message_of(head, {nan, 0.05}), ContainsSubstring("gauge is nan"));
  CHECK_THAT(message_of(head, {1.435, 0.6}), ContainsSubstring("inclination is 0.6"));
  CHECK_THAT(message_of(head, {1.435, -0.5}), ContainsSubstring("inclination is -0.5"));
  CHECK_THAT(message_of(head, {1.435, nan}), ContainsSubstring("inclination is nan"));
  const PiecewiseProfile<double> crown(
      {ProfilePiece<double>::arc(-0.03, 0.03, 0.0, -0.3, 0.3, true)});
  CHECK_THAT(message_of(crown, {1.435, 0.0}),
             ContainsSubstring("0.014 m") && ContainsSubstring("ends 0.0015"));
  CHECK(message_of(head, {1.435, 0.05}).empty());
}

TEST_CASE("TangentTrack: a centred S1002 touches the UIC50 1:20 where it is known to",
          "[track][reference]") {
  // Wheel lateral [m]: rigid contact of S1002 on UIC50 1:20, gauge 1435, nominal radius 0.43,
  // spacing 1.5, from an independent computation on point lists, 12.157 and 12.204 mm.
  const double real = central_contact(s1002<double>());
  CHECK(std::abs(real - 12.157e-3) < 2e-6);
  CHECK(std::abs(central_contact(ConvexModification(s1002<double>())) - 12.204e-3) < 2e-6);
  // The same by bisection on the R80 arc: centre (7.342338107, -80.122556702) mm, corner's centre
  // (22.016219594, -14.749189020) mm, slope of section B's polynomial; inclination atan(1/20).
  CHECK(std::abs(real - 12.158207259e-3) < 2e-9);
}

TEST_CASE("TangentTrack: rails of their own on either side, each half the gauge from the middle",
          "[track][symmetry]") {
  const TrackDimensions<double> laid{1.435, 0.025};
  const auto uic60 = rail_60e1<double>(), small = uic50<double>();
  const Track mixed(uic60, small, laid), swapped(small, uic60, laid);
  const Track of_uic60(uic60, laid), of_small(small, laid);
  const Vector3<double> origin_track = Vector3<double>::Zero();
  const auto same = [&](const Track& a, const Track& b, Side side) {
    const auto one = a.nearest_frame(side, origin_track),
               other = b.nearest_frame(side, origin_track);
    return one.origin_track == other.origin_track && one.axes_track == other.axes_track;
  };
  CHECK(same(mixed, of_uic60, Side::left));
  CHECK(same(mixed, of_small, Side::right));
  CHECK(same(swapped, of_small, Side::left));
  CHECK_FALSE(same(mixed, of_small, Side::left));
  CHECK(mixed.rail(Side::left).checksum() == of_uic60.rail(Side::left).checksum());
  CHECK(mixed.rail(Side::right).checksum() == of_small.rail(Side::left).checksum());
  CHECK(mixed.head_distance() ==
        Approx((of_uic60.head_distance() + of_small.head_distance()) / 2).epsilon(1e-15));
}
