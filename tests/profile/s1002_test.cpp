#include <array>
#include <wheelrail/profile/inspection.hpp>
#include <wheelrail/profile/s1002.hpp>

#include "support/allocation_counter.hpp"
#include "support/catch.hpp"
#include "support/numeric_difference.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;
using wheelrail_test::central_difference;
using wheelrail_test::StrictScalar;

namespace {

// lateral, F [mm], F' [-], F'' [1/mm], F''/(1+F'^2)^1.5 [1/mm]: an independent double-precision
// evaluation of the standard's sections (UIC 510-2); F was confirmed against the point list of the
// Manchester contact benchmark to 1.6e-6 mm. At a joint the section on the field side. Section C,
// -35 to -27 mm, in rational arithmetic: in powers of the lateral coordinate its sum cancels, and
// double precision would lose up to 3.4e-11 mm.
struct Sample {
  long double lateral;
  double value, slope, second, bend;
};
constexpr Sample samples[] = {
    {60.0L, -2.63567638, -0.066666667, 0, 0},
    {55.0L, -2.302343045, -0.066666667, 0, 0},
    {50.0L, -1.96900971, -0.066666667, 0, 0},
    {45.0L, -1.635676375, -0.066666667, 0, 0},
    {40.0L, -1.30234304, -0.066666667, 0, 0},
    {35.0L, -0.969009705, -0.066666667, 0, 0},
    {32.15796L, -0.779540370719, -0.066666667, 0, 0},
    {32.0L, -0.769062153888, -0.0660000489551, -0.00426763458293, -0.00423990088212},
    {30.0L, -0.646229901463, -0.0565867771601, -0.00500880729826, -0.00498484545557},
    {28.0L, -0.543205261987, -0.0464207460812, -0.00506400877237, -0.00504768421233},
    {25.0L, -0.425937324349, -0.0321177943986, -0.00435350229739, -0.00434677467233},
    {22.0L, -0.347508018343, -0.0207604108585, -0.00317532783362, -0.00317327611501},
    {20.0L, -0.311764595256, -0.0152709500375, -0.00231257963502, -0.00231177092377},
    {18.0L, -0.285277868938, -0.0114976087917, -0.00146773765985, -0.00146744666655},
    {16.0L, -0.264681687932, -0.00936102156896, -0.000680727604367, -0.000680638137229},
    {15.0L, -0.255599388363, -0.00886436544312, -0.000316019423766, -0.000315982179648},
    {14.0828242553L, -0.247557191221, -0.00872081565022, 8.727326045e-15, 8.72633053555e-15},
    {14.0L, -0.246834864503, -0.00872196174878, 2.76508596632e-05, 2.76477047533e-05},
    {13.0L, -0.238044479407, -0.00891251214595, 0.000349876957474, 0.000349835274015},
    {12.1568L, -0.230374388837, -0.00931616317137, 0.000605061029731, 0.000604982267592},
    {12.0L, -0.228905988093, -0.00941463554698, 0.00065087976771, 0.00065079324085},
    {10.0L, -0.2084008843, -0.0112709702497, 0.0011925615096, 0.00119233430051},
    {8.0L, -0.183149364781, -0.0141372627065, 0.00166294044111, 0.00166244202724},
    {6.0L, -0.151265181636, -0.0178845540107, 0.00207610745998, 0.00207511177099},
    {5.0L, -0.132310507057, -0.0200564645613, 0.00226615782734, 0.00226479113158},
    {4.0L, -0.111090367971, -0.0224140962963, 0.00244788754635, 0.0024460440065},
    {2.0L, -0.0611324144768, -0.0276592775805, 0.00279441026767, 0.00279120659636},
    {1.0L, -0.0320477504225, -0.0305381645592, 0.00296312616921, 0.00295898596986},
    {0.0L, 0, -0.03358537058, 0.003131363248, 0.0031260725493},
    {-1.0L, 0.0351792305559, -0.0368013585988, 0.00330100297456, 0.00329430828891},
    {-2.0L, 0.073659737762, -0.0401884714307, 0.00347392860178, 0.00346552937908},
    {-5.0L, 0.210667848204, -0.0514288704811, 0.00403209747784, 0.00401615328788},
    {-8.0L, 0.384044256354, -0.0644873375738, 0.00469732551693, 0.00466817553427},
    {-10.0L, 0.522759001023, -0.0744081273551, 0.00524007250628, 0.00519685371096},
    {-12.0L, 0.682473653859, -0.0855270123935, 0.00590234248889, 0.00583816733573},
    {-15.0L, 0.967430152252, -0.105106786037, 0.00723199826547, 0.00711378957665},
    {-18.0L, 1.31794323324, -0.129546032998, 0.00919315493943, 0.00896649465162},
    {-20.0L, 1.59656302645, -0.149686350646, 0.011033527654, 0.0106728228594},
    {-22.0L, 1.91951752233, -0.174081814169, 0.0134778658548, 0.0128876207796},
    {-24.0L, 2.29665085612, -0.204133139886, 0.016726923507, 0.0157333289867},
    {-25.0L, 2.50946962723, -0.221838135648, 0.0187299409246, 0.0174277545859},
    {-26.0L, 2.74104336383, -0.24169314272, 0.021033457497, 0.0193164064461},
    {-27.0L, 2.99360619631865, -0.263928291992162, 0.023628591281376, 0.0213584792617031},
    {-28.0L, 3.27008590732749, -0.289936885614592, 0.029090510055424, 0.0257732575872189},
    {-29.0L, 3.5760502005301, -0.323674728857578, 0.039183448300232, 0.0337440804611117},
    {-30.0L, 3.92157127, -0.36979253, 0.0537152454, 0.0443202413657215},
    {-31.0L, 4.321091707416, -0.432243453474178, 0.071672205742768, 0.0554326422343005},
    {-32.0L, 4.79250542218291, -0.514029279265792, 0.092354487512576, 0.0649711979683695},
    {-33.0L, 5.35655241534825, -0.618081951105962, 0.116511491481624, 0.0717124850432568},
    {-34.0L, 6.03766279610714, -0.749280513455488, 0.147477249802432, 0.0755866131380196},
    {-35.0L, 6.8673854296875, -0.91760343728125, 0.1923058148, 0.0769235587634141},
    {-36.0L, 7.89211665629, -1.14443167, 0.270020498817, 0.0769230769231},
    {-37.0L, 9.19408644165, -1.48779145162, 0.443127648676, 0.0769230769231},
    {-38.0L, 10.9677173989, -2.15201293149, 1.02790601861, 0.0769230769231},
    {-38.426669071L, 11.9997381389, -2.74747742096, 1.92265603012, 0.0769230769231},
    {-39.0L, 13.574951922, -2.747477419, 0, 0},
    {-39.764473993L, 15.6753269552, -2.747477419, 0, 0},
    {-41.0L, 18.4112059541, -1.83352231435, -0.4554799198, -0.05},
    {-43.0L, 21.4022818167, -1.2379950345, -0.201524597977, -0.05},
    {-45.0L, 23.5377056654, -0.92216063881, -0.125852393257, -0.05},
    {-47.0L, 25.1568446828, -0.708147449661, -0.0919911848368, -0.05},
    {-49.0L, 26.4030314891, -0.544072632162, -0.0737708964644, -0.05},
    {-49.662510381L, 26.747613965, -0.496620893564, -0.0695949253523, -0.05},
    {-52.0L, 27.6189500386, -0.258198889747, -0.0918040496879, -0.0833333333333},
    {-55.0L, 28, 0, -0.0833333333333, -0.0833333333333},
    {-58.0L, 27.6189500386, 0.258198889747, -0.0918040496879, -0.0833333333333},
    {-60.0L, 26.9087121146, 0.458349248514, -0.110928221489, -0.0833333333333},
    {-62.0L, 25.7467943448, 0.71818484646, -0.155516718632, -0.0833333333333},
    {-62.764705882L, 25.1492809863, 0.848668424725, -0.188018938068, -0.0833333333333},
    {-64.0L, 24.0106360482, 1.00059506105, -0.13809526253, -0.0487804878049},
    {-66.0L, 21.6847843626, 1.35629164527, -0.233407683835, -0.0487804878049},
    {-68.0L, 18.3510201683, 2.09471251317, -0.610050543076, -0.0487804878049},
    {-69.0L, 15.8438146223, 3.08322071866, -1.66118398336, -0.0487804878049},
    {-69.9L, 11.5416341436, 10.0871507993, -50.8069073708, -0.0487804878049},
};

// lateral [mm], jump of F [mm], slope on the field side [-], jump of the slope [-],
// F''/(1+F'^2)^1.5 on the field side and on the flange side [1/mm]; jumps are the flange side less
// the field side. The same source: residuals of the standard's rounded coefficients.
struct JointRow {
  const char* name;
  long double lateral;
  double value_jump, slope, slope_jump, bend_field, bend_flange;
};
constexpr JointRow joint_rows[] = {
    {"G/H", -62.764705882L, 4.079e-10, 0.848668424725, 2.751e-11, -0.0833333333, -0.0487804878},
    {"F/G", -49.662510381L, -6.390e-08, -0.496620893564, 2.320e-11, -0.05, -0.0833333333},
    {"E/F", -39.764473993L, 2.957e-08, -2.747477419, -5.806e-09, 0, -0.05},
    {"D/E", -38.426669071L, 2.040e-09, -2.74747742096, 1.960e-09, 0.0769230769, 0},
    {"C/D", -35.0L, 1.183e-04, -0.917603437289, -7.718e-06, 0.0769235588, 0.0769230769},
    {"B/C", -26.0L, -3.655e-05, -0.24169314272, 3.217e-06, 0.0193164064, 0.0193159635},
    {"A/B", 32.15796L, 2.842e-10, -0.066666667, 3.655e-09, 0, -0.00414397506},
};

template <class T>
T metres(long double millimetres) {
  return constant<T>(millimetres * 1e-3L);
}

// The lateral coordinates [mm] of an even grid over the profile.
constexpr int grid = 1300;
long double grid_lateral(int i) {
  return -69.99L + (60.0L + 69.99L) * i / grid;
}

}  // namespace

TEST_CASE("s1002: value, slope, second derivative and curvature are the standard's",
          "[profile][reference]") {
  const auto profile = s1002<double>(S1002Form::standard);
  for (const Sample& sample : samples) {
    CAPTURE(sample.lateral);
    const auto point = profile.evaluate(metres<double>(sample.lateral));
    CHECK(point.value * 1e3 == Approx(sample.value).margin(2e-12).epsilon(6e-12));
    CHECK(point.slope == Approx(sample.slope).margin(2e-12).epsilon(6e-12));
    CHECK(point.second_derivative * 1e-3 == Approx(sample.second).margin(2e-13).epsilon(6e-12));
    CHECK(-curvature(point) * 1e-3 == Approx(sample.bend).margin(2e-13).epsilon(6e-12));
  }
}

TEST_CASE("s1002: the standard form jumps at its joints as the standard's numbers do",
          "[profile][reference]") {
  const auto profile = s1002<double>(S1002Form::standard);
  const auto joints = inspect_joints(profile);
  REQUIRE(joints.size() == std::size(joint_rows));
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const JointRow& row = joint_rows[i];
    CAPTURE(row.name);
    CHECK(joints[i].lateral == metres<double>(row.lateral));
    CHECK(joints[i].value_jump * 1e3 == Approx(row.value_jump).margin(2e-12).epsilon(5e-4));
    CHECK(joints[i].slope_jump == Approx(row.slope_jump).margin(2e-12).epsilon(5e-4));
    CHECK(profile.evaluate(joints[i].lateral).slope == Approx(row.slope).epsilon(1e-11));
    CHECK(joints[i].curvature_jump * 1e-3 ==
          Approx(row.bend_field - row.bend_flange).margin(1e-10).epsilon(1e-6));
  }
}

TEST_CASE("s1002: the closed form is C1 at the joints of section C", "[profile]") {
  const auto joints = inspect_joints(s1002<double>());
  for (const auto& joint : joints) {
    CAPTURE(joint.lateral);
    // What is left elsewhere is the standard's: at most 6.4e-8 mm and 6e-9.
    CHECK(std::abs(joint.value_jump) < 7e-11);
    CHECK(std::abs(joint.slope_jump) < 7e-9);
  }
  // What the rounding of the cubic leaves: 8.3e-15 m and 7.3e-12.
  for (const std::size_t i : {4U, 5U}) {
    CHECK(std::abs(joints[i].value_jump) < 1e-14);
    CHECK(std::abs(joints[i].slope_jump) < 1e-11);
  }
}

TEST_CASE("s1002: closed and standard form differ in section C only, by 0.12 um", "[profile]") {
  const auto closed = s1002<double>();
  const auto standard = s1002<double>(S1002Form::standard);
  double largest = 0;
  double largest_second = 0;
  for (int i = 0; i <= grid; ++i) {
    const double lateral = metres<double>(grid_lateral(i));
    CAPTURE(lateral);
    const auto a = closed.evaluate(lateral);
    const auto b = standard.evaluate(lateral);
    if (lateral < -0.035 || lateral >= -0.026) {
      CHECK(a.value == b.value);
      CHECK(a.slope == b.slope);
      CHECK(a.second_derivative == b.second_derivative);
    }
    largest = std::max(largest, std::abs(a.value - b.value));
    largest_second = std::max(largest_second, std::abs(a.second_derivative - b.second_derivative));
  }
  CHECK(largest <= 1.2e-7);
  CHECK(largest > 1.1e-7);
  CHECK(largest_second < 2.95e-3);
}

TEST_CASE("s1002: zero on the tread circle; the flange's top is 28 mm high at -55 mm",
          "[profile][reference]") {
  const auto profile = s1002<double>();
  CHECK(profile.evaluate(0.0).value == Approx(0).margin(1e-17));
  CHECK(profile.evaluate(-0.055).value == Approx(0.028).epsilon(1e-15));
  CHECK(profile.evaluate(-0.055).slope == Approx(0).margin(1e-14));
  CHECK(profile.upper() == 0.06);
  // It ends just short of the vertical tangent at -70 mm.
  CHECK(profile.lower() > -0.07);
  CHECK(profile.lower() < -0.0699);
  CHECK(is_finite(profile.evaluate(profile.lower()).second_derivative));
}

TEST_CASE("s1002: derivatives agree with differences in every piece", "[profile]") {
  const auto profile = s1002<double>();
  for (int piece = 0; piece < profile.piece_count(); ++piece) {
    const auto value = [&](double u) { return profile.evaluate(piece, u).value; };
    const auto slope = [&](double u) { return profile.evaluate(piece, u).slope; };
    const double lower = profile.joint(piece), upper = profile.joint(piece + 1);
    for (int i = 2; i <= 18; ++i) {
      const double u = lower + (upper - lower) * i / 20;
      CAPTURE(piece, u);
      const auto point = profile.evaluate(piece, u);
      CHECK(point.slope == Approx(central_difference(value, u, 1e-5)).epsilon(1e-8).margin(1e-10));
      CHECK(point.second_derivative ==
            Approx(central_difference(slope, u, 1e-5)).epsilon(1e-7).margin(1e-8));
    }
  }
}

TEST_CASE("s1002: float and double differ from long double by rounding", "[profile]") {
  const auto exact = s1002<long double>();
  const auto in_double = s1002<double>();
  const auto in_float = s1002<float>();
  const auto wide = [](auto x) { return static_cast<long double>(x); };
  for (int i = 0; i <= grid; ++i) {
    const long double lateral = grid_lateral(i);
    // Beyond -69.5 mm the slope is so steep that rounding the lateral coordinate shows.
    if (lateral < -69.5L) continue;
    CAPTURE(lateral);
    const auto truth = exact.evaluate(metres<long double>(lateral));
    const auto as_double = in_double.evaluate(metres<double>(lateral));
    const auto as_float = in_float.evaluate(metres<float>(lateral));
    CHECK(std::abs(wide(as_double.value) - truth.value) < 1e-16L);
    CHECK(std::abs(wide(as_double.slope) - truth.slope) < 2e-14L);
    CHECK(std::abs(wide(as_float.value) - truth.value) < 5e-8L);
    CHECK(std::abs(wide(as_float.slope) - truth.slope) < 4e-6L * (1 + truth.slope * truth.slope));
  }
}

TEST_CASE("s1002: bit for bit the same for a scalar that converts to nothing", "[profile]") {
  for (const S1002Form form : {S1002Form::closed, S1002Form::standard}) {
    const auto profile = s1002<double>(form);
    const auto strict = s1002<StrictScalar>(form);
    int different = 0;
    for (int i = 0; i <= grid; ++i) {
      const double lateral = metres<double>(grid_lateral(i));
      const auto expected = profile.evaluate(lateral);
      const auto point = strict.evaluate(StrictScalar(lateral));
      different += point.value.as_double() == expected.value &&
                           point.slope.as_double() == expected.slope &&
                           point.second_derivative.as_double() == expected.second_derivative
                       ? 0
                       : 1;
    }
    CHECK(different == 0);
  }
}

TEST_CASE("s1002: evaluation does not allocate", "[profile][no-alloc]") {
  const auto profile = s1002<double>();
  double sum = 0;
  CHECK(wheelrail_test::allocations_of([&] {
          for (int i = 0; i <= grid; ++i) {
            sum += profile.evaluate(metres<double>(grid_lateral(i))).value;
          }
        }) == 0);
  CHECK(sum > 0);
}
