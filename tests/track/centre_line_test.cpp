#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>
#include <wheelrail/track/centre_line.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/numeric_difference.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;

namespace {

using Segment = TrackSegment<double>;
using Line = CentreLine<double>;

// A left curve after a right one, with a clothoid of changing sign between them.
std::vector<Segment> reverse_curve(Side first) {
  const Side second = first == Side::left ? Side::right : Side::left;
  const double sign = outboard_sign<double>(first);
  return {Segment::tangent(30),
          Segment::clothoid(50),
          Segment::arc(90, 250, first, sign * 0.1),
          Segment::clothoid(120),
          Segment::arc(60, 400, second, -sign * 0.06),
          Segment::clothoid(40),
          Segment::tangent(20)};
}

// The clothoid's end by Fresnel's series, for t in [0, 1]: (C(t), S(t)).
std::pair<long double, long double> fresnel(long double t) {
  const long double q = pi<long double>() / 2 * t * t;
  long double c = 0, s = 0, term = t;
  for (int n = 0; n < 40; ++n) {
    (n % 2 == 0 ? c : s) += term / (2 * n + 1) * (n % 4 < 2 ? 1 : -1);
    term *= q / (n + 1);
  }
  return {c, s};
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

std::string message_of(std::vector<Segment> segments,
                       const CentreLineOptions<double>& options = {}) {
  return message_of([&] { Line line(segments, options); });
}

}  // namespace

TEST_CASE("CentreLine: a clothoid of 200 m ends where Fresnel's integrals say",
          "[track][reference]") {
  // C(1) and S(1) as tabulated by Abramowitz and Stegun, 7.3, to more digits.
  CHECK(std::abs(fresnel(1).first - 0.779893400376822829474L) < 1e-17L);
  CHECK(std::abs(fresnel(1).second - 0.438259147390354766077L) < 1e-17L);
  const double length = 200.0;
  for (const double turn : {0.02, 0.3, pi<double>() / 2}) {
    for (const Side side : sides) {
      CAPTURE(turn, name_of(side));
      const double sign = outboard_sign<double>(side);
      const Line line({Segment::tangent(10), Segment::clothoid(length),
                       Segment::arc(1, length / (2 * turn), side)});
      for (const double part : {0.1, 0.5, 0.77, 1.0}) {
        // heading = turn part^2 = pi / 2 t^2
        const long double scale = std::sqrt(pi<long double>() / 2 / static_cast<long double>(turn));
        const auto [c, s] = fresnel(static_cast<long double>(part) / scale);
        const auto point = line.evaluate(10 + length * part);
        const double x = 10 + length * static_cast<double>(scale * c);
        const double y = sign * length * static_cast<double>(scale * s);
        CHECK(std::abs(point.position_track.x() - x) < 2e-13);
        CHECK(std::abs(point.position_track.y() - y) < 2e-13);
        CHECK(std::abs(point.heading - sign * turn * part * part) < 1e-15);
        CHECK(std::abs(point.curvature - sign * 2 * turn / length * part) < 1e-17);
      }
    }
  }
}

TEST_CASE("CentreLine: an arc is a circle and a tangent straight", "[track][reference]") {
  for (const double radius : {25.0, 300.0, 4000.0}) {
    const Line line({Segment::arc(500, radius, Side::left, 0.12)});
    CHECK(line.length() == 500.0);
    for (const double s : {0.0, 1.0, 120.0, 333.3, 500.0}) {
      CAPTURE(radius, s);
      const auto point = line.evaluate(s);
      CHECK(std::abs(point.position_track.x() - radius * std::sin(s / radius)) < 5e-13);
      CHECK(std::abs(point.position_track.y() - radius * (1 - std::cos(s / radius))) < 5e-13);
      CHECK(point.position_track.z() == 0.0);
      CHECK(std::abs(point.heading - s / radius) < 1e-14);
      CHECK(point.curvature == 1 / radius);
      CHECK(point.cant == 0.12);
      CHECK(std::abs(std::asin(point.sin_cant) - std::asin(0.08)) < 1e-15);
    }
  }
  const Line tangent({Segment::tangent(700)});
  for (const double s : {-5.0, 0.0, 123.4, 700.0, 710.0}) {
    CHECK((tangent.evaluate(s).position_track - Vector3<double>(s, 0, 0)).norm() < 3e-13);
    CHECK(tangent.evaluate(s).heading == 0.0);
  }
}

TEST_CASE("CentreLine: the path's derivative is the heading, whose derivative is the curvature",
          "[track]") {
  const Line line(reverse_curve(Side::right), {.cant_rounding = 0.0});
  double turned = 0.0;
  const int steps = 41000;  // every joint is a node
  for (int i = 0; i < steps; ++i) {
    const double h = line.length() / steps;
    turned += h * line.evaluate((i + 0.5) * h).curvature;
  }
  CHECK(std::abs(line.evaluate(line.length()).heading - turned) < 1e-12);
  CHECK(std::abs(line.evaluate(line.length()).heading -
                 (-(25.0 + 90.0 + 60.0) / 250 + (60.0 + 60.0 + 20.0) / 400)) < 1e-14);
  for (double s = 3.3; s < line.length() - 1; s += 7.7) {
    CAPTURE(s);
    const auto at = line.evaluate(s);
    const auto x = [&](double u) { return line.evaluate(u).position_track.x(); };
    const auto y = [&](double u) { return line.evaluate(u).position_track.y(); };
    const auto heading = [&](double u) { return line.evaluate(u).heading; };
    using wheelrail_test::central_difference;
    CHECK(std::abs(central_difference(x, s, 0.1) - std::cos(at.heading)) < 2e-11);
    CHECK(std::abs(central_difference(y, s, 0.1) - std::sin(at.heading)) < 2e-11);
    CHECK(std::abs(central_difference(heading, s, 0.1) - at.curvature) < 1e-13);
  }
}

TEST_CASE("CentreLine: position, heading, curvature and cant are continuous at the joints",
          "[track]") {
  for (const double rounding : {0.0, 4.0, 300.0}) {
    const Line line(reverse_curve(Side::left), {.cant_rounding = rounding});
    REQUIRE(line.segment_count() == 7);
    for (std::size_t i = 1; i < line.segment_count(); ++i) {
      const double s = line.segment_start(i);
      CAPTURE(rounding, s);
      const auto before = line.evaluate(std::nextafter(s, 0.0));
      const auto after = line.evaluate(s);
      CHECK((after.position_track - before.position_track).norm() < 5e-13);
      CHECK(std::abs(after.heading - before.heading) < 1e-15);
      CHECK(std::abs(after.curvature - before.curvature) < 1e-16);
      CHECK(std::abs(after.cant - before.cant) < 1e-15);
    }
  }
  const Line line(reverse_curve(Side::left), {.cant_rounding = 0.0});
  CHECK(line.length() == 410.0);
  CHECK(line.evaluate(15).cant == 0.0);
  CHECK(line.evaluate(55).cant == Approx(0.05));
  CHECK(line.evaluate(55).curvature == Approx(0.002));
  CHECK(line.evaluate(100).cant == 0.1);
  CHECK(line.evaluate(230).cant == Approx(0.02));
  CHECK(line.evaluate(320).cant == -0.06);
  // A ramp on a tangent goes on from where it ends.
  Segment ramp = Segment::tangent(20);
  ramp.cant_end = 0.02;
  const Line raised({ramp, Segment::clothoid(40), Segment::arc(50, 300, Side::left, 0.1)},
                    {.cant_rounding = 0.0});
  CHECK(raised.evaluate(10).cant == Approx(0.01));
  CHECK(raised.evaluate(20).cant == Approx(0.02));
  CHECK(raised.evaluate(40).cant == Approx(0.06));
}

TEST_CASE("CentreLine: the cant's corners are its mean over the rounding length", "[track]") {
  const std::vector<Segment> segments = reverse_curve(Side::left);
  const Line sharp(segments, {.cant_rounding = 0.0});
  // At 130 m the corners reach over their neighbours.
  for (const double rounding : {2.0, 4.0, 130.0}) {
    const Line line(segments, {.cant_rounding = rounding});
    double most = 0.0;
    for (double s = 25.0; s < 385.0; s += 0.9) {
      CAPTURE(rounding, s);
      double mean = 0.0;
      const int samples = 4000;
      for (int i = 0; i < samples; ++i) {
        mean += sharp.evaluate(s + rounding * ((i + 0.5) / samples - 0.5)).cant / samples;
      }
      CHECK(std::abs(line.evaluate(s).cant - mean) < 1e-7);
      most = std::max(most, std::abs(line.evaluate(s).cant - sharp.evaluate(s).cant));
    }
    if (rounding < 50.0) CHECK(most == Approx(rounding / 8 * 0.1 / 50).epsilon(0.3));
  }
}

TEST_CASE("CentreLine: a mirrored layout gives the mirrored line bit for bit",
          "[track][symmetry]") {
  const Line left(reverse_curve(Side::left)), right(reverse_curve(Side::right));
  for (double s = 0.0; s < left.length(); s += 3.1) {
    const auto a = left.evaluate(s), b = right.evaluate(s);
    CHECK(a.position_track.x() == b.position_track.x());
    CHECK(a.position_track.y() == -b.position_track.y());
    CHECK(a.heading == -b.heading);
    CHECK(a.curvature == -b.curvature);
    CHECK(a.cant == -b.cant);
    CHECK(a.sin_cant == -b.sin_cant);
  }
}

TEST_CASE("track_plane_axes: a rotation; positive cant lowers the left side into a left curve",
          "[track]") {
  const Matrix3<double> axes_track = track_plane_axes(0.3, 0.08);
  CHECK((axes_track.transpose() * axes_track - Matrix3<double>::Identity()).norm() < 1e-15);
  CHECK((cross(Vector3<double>(axes_track.col(0)), Vector3<double>(axes_track.col(1))) -
         axes_track.col(2))
            .norm() < 1e-15);
  CHECK(axes_track(2, 0) == 0.0);
  CHECK(axes_track(2, 1) == -0.08);
  const Vector3<double> left_track(-std::sin(0.3), std::cos(0.3), 0);
  CHECK(left_track.dot(axes_track.col(2)) == Approx(0.08));
}

TEST_CASE("CentreLine: no double on the way, no allocation, NaN in gives NaN",
          "[track][no-alloc]") {
  using wheelrail_test::StrictScalar;
  const auto strict = [](double x) { return StrictScalar(x); };
  const Line line({Segment::tangent(20), Segment::clothoid(40), Segment::arc(70, 300, Side::left)});
  using StrictSegment = TrackSegment<StrictScalar>;
  const CentreLine<StrictScalar> other({StrictSegment::tangent(strict(20)),
                                        StrictSegment::clothoid(strict(40)),
                                        StrictSegment::arc(strict(70), strict(300), Side::left)});
  CHECK(other.evaluate(strict(101.3)).position_track.y().as_double() ==
        line.evaluate(101.3).position_track.y());
  CHECK(std::isnan(line.evaluate(std::nan("")).position_track.x()));
  double sum = 0.0;
  CHECK(wheelrail_test::allocations_of([&] { sum = line.evaluate(77.0).heading; }) == 0);
  CHECK(sum > 0.1);
}

TEST_CASE("CentreLine: bad layouts are refused with segment and value", "[track][bad-input]") {
  using Catch::Matchers::ContainsSubstring;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto tangent = Segment::tangent(20);
  const auto clothoid = Segment::clothoid(40);
  const auto arc = Segment::arc(70, 300, Side::left, 0.1);
  CHECK(message_of({tangent, clothoid, arc, clothoid, tangent}).empty());
  CHECK_THAT(message_of({}), ContainsSubstring("at least one segment"));
  CHECK_THAT(message_of({tangent, Segment::arc(70, 300, Side::left)}),
             ContainsSubstring("segment 1 does not join segment 0") &&
                 ContainsSubstring("curvature starts at 0.003") &&
                 ContainsSubstring("ends at 0 1/m"));
  CHECK_THAT(message_of({arc, Segment::arc(70, 300, Side::left, 0.09)}),
             ContainsSubstring("segment 1 does not join") &&
                 ContainsSubstring("cant starts at 0.09 m") && ContainsSubstring("ends at 0.1 m"));
  CHECK(message_of({arc, arc}).empty());
  CHECK(message_of({tangent, Segment::arc(70, 300, Side::left)}, {.curvature_tolerance = 0.01})
            .empty());
  CHECK_THAT(message_of({clothoid, arc}), ContainsSubstring("segment 0 is a clothoid"));
  CHECK_THAT(message_of({tangent, clothoid}), ContainsSubstring("segment 1 is a clothoid"));
  CHECK_THAT(message_of({tangent, clothoid, clothoid, arc}),
             ContainsSubstring("segment 1 is a clothoid"));
  CHECK_THAT(message_of({tangent, Segment::clothoid(0), arc}),
             ContainsSubstring("segment 1: length is 0"));
  CHECK_THAT(message_of({Segment::tangent(-3)}), ContainsSubstring("segment 0: length is -3"));
  CHECK_THAT(message_of({Segment::tangent(nan)}), ContainsSubstring("length is nan"));
  CHECK_THAT(message_of({Segment::arc(10, 0, Side::left)}), ContainsSubstring("radius is 0"));
  CHECK_THAT(message_of({Segment::arc(10, -300, Side::left)}), ContainsSubstring("radius is -300"));
  CHECK_THAT(message_of({Segment::arc(10, 1.4, Side::left)}), ContainsSubstring("radius is 1.4"));
  CHECK_THAT(message_of({Segment::arc(10, nan, Side::left)}), ContainsSubstring("radius is nan"));
  CHECK_THAT(message_of({Segment::arc(1e5, 300, Side::left)}), ContainsSubstring("turn is 333.3"));
  CHECK_THAT(message_of({Segment::arc(10, 300, Side::left, 0.75)}),
             ContainsSubstring("cant is 0.75"));
  CHECK_THAT(message_of({Segment::tangent(10, nan)}), ContainsSubstring("cant is nan"));
  CHECK_THAT(message_of({tangent}, {.cant_base = 0.0}), ContainsSubstring("cant base is 0"));
  CHECK_THAT(message_of({tangent}, {.cant_rounding = -1.0}),
             ContainsSubstring("cant rounding is -1"));
  CHECK_THAT(message_of({tangent}, {.cant_tolerance = nan}),
             ContainsSubstring("joint tolerance is nan"));
}
