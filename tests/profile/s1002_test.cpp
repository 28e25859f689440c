#include <wheelrail/profile/inspection.hpp>
#include <wheelrail/profile/s1002.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

namespace {

// lateral, F [mm], F' [-], F'' [1/mm]: an independent double-precision evaluation of the standard's
// sections (UIC 510-2); F was confirmed against the point list of the Manchester contact benchmark
// to 1.6e-6 mm. At a joint the section on the field side.
struct Sample {
  double lateral, value, slope, second;
};
constexpr Sample samples[] = {
    {60, -2.63567638, -0.066666667, 0},
    {32.15796, -0.779540370719, -0.066666667, 0},
    {32, -0.769062153888, -0.0660000489551, -0.00426763458293},
    {30, -0.646229901463, -0.0565867771601, -0.00500880729826},
    {22, -0.347508018343, -0.0207604108585, -0.00317532783362},
    {16, -0.264681687932, -0.00936102156896, -0.000680727604367},
    {14, -0.246834864503, -0.00872196174878, 2.76508596632e-05},
    {10, -0.2084008843, -0.0112709702497, 0.0011925615096},
    {4, -0.111090367971, -0.0224140962963, 0.00244788754635},
    {1, -0.0320477504225, -0.0305381645592, 0.00296312616921},
};

}  // namespace

TEST_CASE("s1002: value, slope and second derivative are the standard's", "[profile][reference]") {
  const auto profile = s1002<double>(S1002Form::standard);
  for (const Sample& sample : samples) {
    CAPTURE(sample.lateral);
    const auto point = profile.evaluate(sample.lateral * 1e-3);
    CHECK(point.value * 1e3 == Approx(sample.value).margin(2e-12).epsilon(2e-12));
    CHECK(point.slope == Approx(sample.slope).margin(2e-12).epsilon(2e-12));
    CHECK(point.second_derivative * 1e-3 == Approx(sample.second).margin(2e-13).epsilon(2e-12));
  }
}
