#include <wheelrail/profile/rail_head.hpp>
#include <wheelrail/profile/s1002.hpp>
#include <wheelrail/track/tangent_track.hpp>
#include <wheelrail/wheelset/fit.hpp>

#include "support/catch.hpp"

using namespace wheelrail;
using Catch::Matchers::ContainsSubstring;

TEST_CASE("flange_face: S1002's flange is 32.5 mm thick 10 mm above the tread", "[wheelset]") {
  // UIC 510-2: flange back at -70 mm, so the face at -37.5 mm.
  CHECK(flange_face(s1002<double>()) == Approx(-0.0375).margin(5e-6));
}

TEST_CASE("flange_face: a profile without a flange is refused", "[wheelset][bad-input]") {
  using Piece = ProfilePiece<double>;
  const PiecewiseProfile<double> cone({Piece::line(-0.07, 0.06, 0.0, 0.0, -0.025)});
  CHECK_THROWS_WITH(flange_face(cone), ContainsSubstring("no flange"));
}

TEST_CASE("require_fit: only gauges between flanges and treads pass", "[wheelset][bad-input]") {
  const Wheelset wheelset(s1002<double>(), 0.43, 1.5);
  const auto laid_to = [](double gauge) { return TangentTrack(uic50<double>(), {.gauge = gauge}); };
  CHECK_NOTHROW(require_fit(wheelset, laid_to(1.435)));
  CHECK_NOTHROW(require_fit(wheelset, laid_to(1.426)));
  CHECK_THROWS_WITH(require_fit(wheelset, laid_to(1.42)), ContainsSubstring("gauge is 1.42") &&
                                                              ContainsSubstring("1.425") &&
                                                              ContainsSubstring("does not fit"));
  CHECK_THROWS_WITH(require_fit(wheelset, laid_to(1.6)),
                    ContainsSubstring("gauge is 1.6") && ContainsSubstring("does not fit"));
  CHECK_NOTHROW(require_fit(wheelset, laid_to(1.5)));
}
