#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>
#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/track/nodal_track.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;

namespace {

using Head = RailHead<double>;
using Track = NodalTrack<Head>;
using Line = CentreLine<double>;
using Segment = TrackSegment<double>;

// Tangent, clothoid, arc of 300 m with cant, and back.
Line curve(Side turn, double cant = 0.1) {
  const double sign = outboard_sign<double>(turn);
  return Line({Segment::tangent(40), Segment::clothoid(60),
               Segment::arc(200, 300, turn, sign * cant), Segment::clothoid(60),
               Segment::tangent(40)});
}

// A point that a wheel's centre may be at, over the rail at an arc length.
Vector3<double> wheel_over(const Track& track, Side side, double s) {
  return track.frame(side, s).position_track(Vector3<double>(0, 0.012, 0.44));
}

// The residual of (36).
double along_rail(const RailFrame<double>& frame, const Vector3<double>& point_track) {
  return frame.axes_track.col(0).dot(frame.origin_track - point_track);
}

double distance(const RailFrame<double>& a, const RailFrame<double>& b) {
  return (a.origin_track - b.origin_track).norm() + (a.axes_track - b.axes_track).norm();
}

TrackIrregularities<double> rough(double length) {
  return generate_irregularities(IrregularitySpectrum<double>::high_disturbance(), length,
                                 {.seed = 5});
}

template <class Make>
std::string message_of(const Make& make) {
  try {
    make();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("NodalTrack: on a straight layout it is TangentTrack", "[track][reference]") {
  for (const TrackDimensions<double>& dimensions :
       {TrackDimensions<double>{}, TrackDimensions<double>{1.0, -0.025}}) {
    const TangentTrack<Head> tangent(uic50<double>(), dimensions);
    const Track track(uic50<double>(), Line({Segment::tangent(500.1)}), dimensions);
    CHECK(track.length() == 500.1);
    CHECK(track.head_distance() == tangent.head_distance());
    CHECK(track.dimensions().gauge == dimensions.gauge);
    for (const Side side : sides) {
      for (const double x : {0.0, 0.1, 3.0, 250.05, 333.33, 500.1}) {
        CAPTURE(name_of(side), x);
        const Vector3<double> point_track(x, outboard_sign<double>(side) * 0.74, 0.43);
        const auto expected = tangent.nearest_frame(side, point_track, 0.0);
        const auto frame = track.nearest_frame(side, point_track, x + 0.2);
        CHECK((frame.origin_track - expected.origin_track).norm() < 1e-12);
        CHECK((frame.axes_track - expected.axes_track).norm() < 1e-12);
        CHECK(frame.inclination == expected.inclination);
        CHECK(std::abs(frame.arc_length - expected.arc_length) < 1e-12);
        CHECK(frame.side == side);
      }
    }
  }
}

TEST_CASE("NodalTrack: on an arc with cant the rails are circles about its centre",
          "[track][reference]") {
  const double radius = 300.0, cant = 0.12, sine = cant / 1.5, cosine = std::sqrt(1 - sine * sine);
  for (const Side turn : sides) {
    const double sign = outboard_sign<double>(turn);
    const Track track(uic50<double>(), Line({Segment::arc(400, radius, turn, sign * cant)}));
    const TangentTrack<Head> tangent(uic50<double>());
    const Vector3<double> centre_track(0, sign * radius, 0);
    for (const Side side : sides) {
      // The profile's origin in the section of the canted track plane.
      const auto flat = tangent.nearest_frame(side, Vector3<double>::Zero());
      const double y = flat.origin_track.y(), z = flat.origin_track.z();
      const double inward = sign * (cosine * y + sign * sine * z);  // towards the centre
      for (double s = 0.0; s <= 400.0; s += 3.17) {
        CAPTURE(name_of(turn), name_of(side), s);
        const auto frame = track.frame(side, s);
        const Vector3<double> arm_track = frame.origin_track - centre_track;
        const double heading = sign * s / radius;
        CHECK(std::abs(arm_track.head<2>().norm() - (radius - inward)) < 1e-9);
        CHECK(std::abs(frame.origin_track.z() - (cosine * z - sign * sine * y)) < 1e-9);
        const Vector3<double> forward_track(std::cos(heading), std::sin(heading), 0);
        const double forward = outboard_sign<double>(side);
        CHECK((frame.axes_track.col(0) - forward * forward_track).norm() < 1e-9);
        CHECK(std::abs(frame.axes_track.col(0).dot(arm_track)) < 1e-9 * radius);
        // The frame, turned back by heading and cant, is that of the straight track.
        const Matrix3<double> axes_track = track_plane_axes(heading, sign * sine);
        CHECK((axes_track.transpose() * frame.axes_track - flat.axes_track).norm() < 1e-9);
        CHECK(frame.inclination == flat.inclination);
      }
    }
  }
}

TEST_CASE("NodalTrack: the gauge 14 mm below the heads is kept in a canted curve", "[track]") {
  const auto head = rail_60e1<double>();
  const double gauge = 1.44;
  const Track track(head, curve(Side::left), {gauge, 0.025});
  for (const double s : {20.0, 70.0, 150.3, 200.1}) {
    const auto centre = track.centre_line().evaluate(s);
    // Points of both heads in the plane across the centre line, in the track plane's axes.
    const double angle = std::asin(centre.cant / 1.5);
    const Vector3<double> flat_left_track(-std::sin(centre.heading), std::cos(centre.heading), 0);
    const Vector3<double> left_track =
        std::cos(angle) * flat_left_track - std::sin(angle) * Vector3<double>::UnitZ();
    const Vector3<double> up_track =
        std::sin(angle) * flat_left_track + std::cos(angle) * Vector3<double>::UnitZ();
    double inner[2] = {0, 0};
    for (const Side side : sides) {
      const auto frame = track.frame(side, s);
      double highest = -1.0, before_up = -1.0, before_out = 0.0;
      bool found = false;
      const int count = 40000;
      for (int i = 0; i <= count; ++i) {
        const double u = head.lower() + (head.upper() - head.lower()) * i / count;
        const Vector3<double> arm_track =
            frame.position_track(
                Vector3<double>(0, u, head.evaluate(std::min(u, head.upper())).value)) -
            centre.position_track;
        const double up = up_track.dot(arm_track);
        const double out = outboard_sign<double>(side) * left_track.dot(arm_track);
        highest = std::max(highest, up);
        if (!found && up >= -0.014) {
          inner[index_of(side)] =
              before_out + (out - before_out) * (-0.014 - before_up) / (up - before_up);
          found = true;
        }
        before_up = up;
        before_out = out;
      }
      CHECK(std::abs(highest) < 1e-8);
    }
    // On the ramps the section of the profile is not quite the track's: by its twist squared.
    CHECK(std::abs(inner[0] + inner[1] - gauge) < 1e-7);
  }
}

TEST_CASE("NodalTrack: a right curve mirrors a left one", "[track][symmetry]") {
  const Track left(uic50<double>(), curve(Side::left)), right(uic50<double>(), curve(Side::right));
  const Vector3<double> mirror(1, -1, 1);
  for (const Side side : sides) {
    const Side other = side == Side::left ? Side::right : Side::left;
    for (double s = 1.0; s < 400.0; s += 13.7) {
      const Vector3<double> point_track = wheel_over(left, side, s);
      const auto a = left.nearest_frame(side, point_track, s - 0.5);
      const auto b =
          right.nearest_frame(other, Vector3<double>(mirror.cwiseProduct(point_track)), s - 0.5);
      CHECK((mirror.cwiseProduct(a.origin_track) - b.origin_track).norm() < 1e-12);
      // The x axis runs along the other way, as it does on the other side.
      CHECK((-mirror.cwiseProduct(a.axes_track.col(0)) - b.axes_track.col(0)).norm() < 1e-14);
      CHECK((mirror.cwiseProduct(a.axes_track.col(1)) - b.axes_track.col(1)).norm() < 1e-14);
      CHECK((mirror.cwiseProduct(a.axes_track.col(2)) - b.axes_track.col(2)).norm() < 1e-14);
      CHECK(std::abs(a.arc_length - b.arc_length) < 1e-12);
    }
  }
}

TEST_CASE("NodalTrack: axes are rotations along the path, and twice continuous at the nodes",
          "[track]") {
  const Line line = curve(Side::left);
  const Track track(uic50<double>(), line, {}, rough(line.length()));
  for (const Side side : sides) {
    for (double s = 0.7; s < 399.0; s += 0.531) {
      const auto frame = track.frame(side, s);
      CHECK((frame.axes_track.transpose() * frame.axes_track - Matrix3<double>::Identity()).norm() <
            2e-15);
      CHECK(std::abs(frame.axes_track.determinant() - 1) < 2e-15);
      const double h = 1e-4;
      const Vector3<double> difference_track =
          track.frame(side, s + h).origin_track - track.frame(side, s - h).origin_track;
      CHECK((outboard_sign<double>(side) * difference_track.normalized() - frame.axes_track.col(0))
                .norm() < 1e-5);
    }
    // Second differences on both sides of a node differ by the third derivative's jump times h.
    for (const double node : {60.0, 150.25, 303.5}) {
      const auto second = [&](double middle, double h) {
        const auto a = track.frame(side, middle - h), b = track.frame(side, middle),
                   c = track.frame(side, middle + h);
        return std::pair<Vector3<double>, Matrix3<double>>(
            (a.origin_track - 2 * b.origin_track + c.origin_track) / (h * h),
            (a.axes_track - 2 * b.axes_track + c.axes_track) / (h * h));
      };
      const auto jump = [&](double h) {
        const auto before = second(node - h, h), after = second(node + h, h);
        return std::pair((after.first - before.first).norm(),
                         (after.second - before.second).norm());
      };
      const auto coarse = jump(0.02), fine = jump(0.005);
      CAPTURE(node, coarse.first, coarse.second);
      CHECK(fine.first < 0.35 * coarse.first + 1e-8);
      CHECK(fine.second < 0.35 * coarse.second + 1e-8);
    }
  }
}

TEST_CASE("NodalTrack: irregularities move the rails by what the table says", "[track]") {
  const std::vector<double> arc_lengths{0, 10, 20, 30, 40};
  const std::vector<Irregularity<double>> table{
      {}, {2e-3, 0, 0, 0}, {0, -3e-3, 0, 0}, {0, 0, 4e-3, 0}, {0, 0, 0, 6e-3}};
  const Line line({Segment::tangent(40)});
  const Track smooth(uic50<double>(), line);
  const Track track(uic50<double>(), line, {}, TrackIrregularities<double>(arc_lengths, table));
  for (const Side side : sides) {
    const double sign = outboard_sign<double>(side);
    const auto moved = [&](double s) {
      return Vector3<double>(track.frame(side, s).origin_track -
                             smooth.frame(side, s).origin_track);
    };
    CHECK((moved(10) - Vector3<double>(0, 2e-3, 0)).norm() < 1e-12);
    CHECK((moved(20) - Vector3<double>(0, 0, -3e-3)).norm() < 1e-12);
    CHECK((moved(30) - Vector3<double>(0, sign * 2e-3, 0)).norm() < 1e-12);
    // Cross-level: the track plane leans, the left rail goes down.
    const Vector3<double> origin_track = smooth.frame(side, 40).origin_track;
    const double angle = std::asin(6e-3 / 1.5);
    CHECK(std::abs(moved(40).z() - (origin_track.z() * (std::cos(angle) - 1) -
                                    origin_track.y() * std::sin(angle))) < 1e-12);
    CHECK(moved(40).z() * sign < -0.002);
    // The rail's direction follows its path.
    const double slope = track.frame(side, 15).axes_track(1, 0);
    CHECK(std::abs(slope) > 1e-4);
  }
}

TEST_CASE("NodalTrack: (36) holds to rounding, whatever the guess", "[track]") {
  const Line line = curve(Side::right);
  const Track track(uic50<double>(), line, {}, rough(line.length()));
  double worst = 0.0, spread = 0.0;
  for (const Side side : sides) {
    for (double s = 0.5; s < 400.0; s += 2.93) {
      const Vector3<double> point_track = wheel_over(track, side, s);
      for (const double off : {0.0, 0.01, -0.4, 3.0, -30.0, 200.0}) {
        const auto frame = track.nearest_frame(side, point_track, s + off);
        REQUIRE(frame.arc_length > 0.0);  // and no NaN, which std::max would pass over
        worst = std::max(worst, std::abs(along_rail(frame, point_track)));
        spread = std::max(spread, std::abs(frame.arc_length - s));
      }
      for (const double guess : {0.0, 400.0, -1e6, 1e300}) {
        const auto frame = track.nearest_frame(side, point_track, guess);
        REQUIRE(frame.arc_length > 0.0);
        spread = std::max(spread, std::abs(frame.arc_length - s));
      }
    }
  }
  CAPTURE(worst, spread);
  CHECK(worst < 2e-13);
  CHECK(spread < 4e-13);
}

TEST_CASE("NodalTrack: where Newton's method goes astray, the search around the guess finds it",
          "[track]") {
  // Three quarters of a circle: from most of it, the distance falls the wrong way.
  const Track track(uic50<double>(), Line({Segment::arc(1400, 300, Side::left)}));
  int wrong = 0;
  for (double s = 10.0; s < 1400.0; s += 33.3) {
    const Vector3<double> point_track = wheel_over(track, Side::left, s);
    for (double guess = 0.0; guess <= 1400.0; guess += 100.0) {
      const double found = track.nearest_frame(Side::left, point_track, guess).arc_length;
      if (!(std::abs(found - s) < 2e-12)) ++wrong;
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("NodalTrack: before its start and after its end all is NaN", "[track][bad-input]") {
  const Track track(uic50<double>(), curve(Side::left));
  const auto all_nan = [](const RailFrame<double>& frame) {
    return frame.origin_track.array().isNaN().all() && frame.axes_track.array().isNaN().all() &&
           std::isnan(frame.arc_length) && std::isnan(frame.inclination);
  };
  for (const Side side : sides) {
    const auto first = track.frame(side, 0.0), last = track.frame(side, track.length());
    const double forward = outboard_sign<double>(side);
    const auto beyond = [&](const RailFrame<double>& frame, double x) {
      return frame.position_track(Vector3<double>(forward * x, 0, 0.44));
    };
    CHECK(all_nan(track.nearest_frame(side, beyond(first, -1e-3), 0.0)));
    CHECK(all_nan(track.nearest_frame(side, beyond(first, -5.0), 3.0)));
    CHECK(all_nan(track.nearest_frame(side, beyond(last, 1e-3), 399.0)));
    CHECK(all_nan(track.nearest_frame(side, beyond(last, 20.0), 399.0)));
    CHECK(track.nearest_frame(side, beyond(first, 0.0), 1.0).arc_length < 1e-12);
    CHECK(track.nearest_frame(side, beyond(last, 0.0), 399.0).arc_length == Approx(400.0));
    CHECK(all_nan(track.frame(side, -1e-3)));
    CHECK(all_nan(track.frame(side, 400.001)));
    CHECK(all_nan(track.frame(side, std::nan(""))));
    CHECK(all_nan(track.nearest_frame(side, Vector3<double>(std::nan(""), 0, 0), 10.0)));
    CHECK(all_nan(track.nearest_frame(side, Vector3<double>(10, 0, 0), std::nan(""))));
  }
}

TEST_CASE("NodalTrack: queries do not allocate and compute nothing in double",
          "[track][no-alloc]") {
  using wheelrail_test::StrictScalar;
  const Line line({Segment::tangent(10), Segment::clothoid(20), Segment::arc(10, 300, Side::left)});
  const Track track(uic50<double>(), line);
  double sum = 0.0;
  CHECK(wheelrail_test::allocations_of([&] {
          for (double x = 0.1; x < 39.0; x += 0.1) {
            sum += track.nearest_frame(Side::left, Vector3<double>(x, 0.7, 0.4), x).arc_length;
          }
        }) == 0);
  CHECK(sum > 1000.0);
  using StrictSegment = TrackSegment<StrictScalar>;
  const auto strict = [](double x) { return StrictScalar(x); };
  const NodalTrack<RailHead<StrictScalar>> other(
      uic50<StrictScalar>(),
      CentreLine<StrictScalar>({StrictSegment::tangent(strict(10)),
                                StrictSegment::clothoid(strict(20)),
                                StrictSegment::arc(strict(10), strict(300), Side::left)}));
  const auto a = track.nearest_frame(Side::right, Vector3<double>(33.3, -0.7, 0.4), 33.0);
  const auto b = other.nearest_frame(
      Side::right, Vector3<StrictScalar>(strict(33.3), strict(-0.7), strict(0.4)), strict(33.0));
  CHECK(std::abs(a.arc_length - b.arc_length.as_double()) < 1e-13);
  CHECK(std::abs(a.axes_track(0, 1) - b.axes_track(0, 1).as_double()) < 1e-14);
}

TEST_CASE("NodalTrack: the same data give the same track bit for bit", "[track]") {
  const Line line = curve(Side::left);
  const Track a(uic50<double>(), line, {}, rough(400)), b(uic50<double>(), line, {}, rough(400));
  const Track plain(uic50<double>(), line);
  double roughness = 0.0;
  for (double s = 0.0; s < 400.0; s += 0.77) {
    CHECK(distance(a.frame(Side::left, s), b.frame(Side::left, s)) == 0.0);
    roughness = std::max(roughness, distance(a.frame(Side::left, s), plain.frame(Side::left, s)));
  }
  CHECK(roughness > 1e-3);
}

TEST_CASE("NodalTrack: bad data are refused with value and place", "[track][bad-input]") {
  using Catch::Matchers::ContainsSubstring;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto head = uic50<double>();
  const auto message = [&](const TrackDimensions<double>& dimensions,
                           const TrackIrregularities<double>& irregularities = {},
                           const NodalTrackOptions<double>& options = {}) {
    return message_of([&] { Track(head, curve(Side::left), dimensions, irregularities, options); });
  };
  CHECK(message({}).empty());
  CHECK_THAT(message({nan, 0.05}), ContainsSubstring("gauge is nan"));
  CHECK_THAT(message({1.435, 0.7}), ContainsSubstring("inclination is 0.7"));
  CHECK_THAT(message({}, {}, {.spacing = 0}), ContainsSubstring("spacing is 0"));
  CHECK_THAT(message({}, {}, {.spacing = 1e-5}),
             ContainsSubstring("spacing is 1e-05") && ContainsSubstring("400 m"));
  // Both kinds of track refuse heads that overlap, below the point where the gauge is measured.
  CHECK_THAT(message({0.001, 0.0}),
             ContainsSubstring("gauge is 0.001") && ContainsSubstring("overlap"));
  CHECK_THAT(message_of([&] {
               TangentTrack<Head>(head, {0.001, 0.0});
             }),
             ContainsSubstring("gauge is 0.001") && ContainsSubstring("overlap"));
  CHECK(message_of([&] { TangentTrack<Head>(head, {0.01, 0.0}); }).empty());
  const auto with = [](const Irregularity<double>& row) {
    return TrackIrregularities<double>({0, 100, 200}, {{}, row, {}});
  };
  CHECK_THAT(message({}, with({0, 0, -1.5, 0})), ContainsSubstring("at arc length") &&
                                                     ContainsSubstring("gauge is") &&
                                                     ContainsSubstring("overlap"));
  CHECK_THAT(
      message({}, with({0, 0, 0, 0.8})),
      ContainsSubstring("at arc length") && ContainsSubstring("cant with cross-level is 0.75"));
}
