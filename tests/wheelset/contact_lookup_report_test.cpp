#include <cmath>
#include <string>
#include <wheelrail/wheelset/contact_lookup_report.hpp>

#include "support/catch.hpp"

using namespace wheelrail;

TEST_CASE("LookupErrors: greatest and root mean square of known differences", "[wheelset]") {
  detail::LookupErrorSum<double> sum;
  CHECK(sum.result().poses == 0);
  for (const double off : {-3e-6, 1e-6}) {
    ContactLookupResult<double> looked_up;
    looked_up.contact.wheel_lateral = 0.01 + 1000 * off;  // 3 and 1 mm
    looked_up.contact.contact_angle = 0.1;
    looked_up.contact.rolling_radius = 0.46;
    looked_up.penetration = 1e-4 + off;
    looked_up.touching_height = 0.46;
    Patch<double> online;
    online.wheel_lateral = 0.01;
    online.contact_angle = 0.1;
    online.rolling_radius = 0.46;
    online.penetration = 1e-4;
    sum.add(looked_up, 0.46, online, off < 0 ? 2 : 1, 2e-3);
  }
  const auto errors = sum.result();
  CHECK(errors.poses == 2);
  CHECK(errors.misplaced == 1);
  CHECK(errors.several == 1);
  CHECK(errors.penetration.greatest == Approx(3e-6));
  CHECK(errors.penetration.rms == Approx(std::sqrt(5.0) * 1e-6));
  CHECK(errors.touching_height.greatest == 0);
}

TEST_CASE("LookupStatus: each has a name of its own", "[wheelset]") {
  CHECK(std::string(name_of(LookupStatus::found)) == "found");
  CHECK(std::string(name_of(LookupStatus::outside)) == "outside");
  CHECK(std::string(name_of(LookupStatus::not_finite)) == "not_finite");
}
