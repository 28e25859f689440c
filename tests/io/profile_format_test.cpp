#include <wheelrail/io/profile_format.hpp>

#include "support/catch.hpp"
#include "support/strict_scalar.hpp"

using namespace wheelrail;

TEST_CASE("ProfileReadOptions, ProfileWriteOptions: nothing is forced, limits are set", "[io]") {
  const ProfileReadOptions reading;
  CHECK_FALSE(reading.format.has_value());
  CHECK_FALSE(reading.unit.has_value());
  CHECK_FALSE(reading.value.has_value());
  CHECK_FALSE(reading.lateral.has_value());
  CHECK(reading.maximum_bytes == 8388608);
  CHECK(reading.maximum_points == 100000);
  const ProfileWriteOptions writing;
  CHECK(writing.format == ProfileFormat::table);
  CHECK(writing.unit == LengthUnit::metre);
}

TEST_CASE("ProfileFile: of any scalar", "[io]") {
  const ProfileFile<wheelrail_test::StrictScalar> file;
  CHECK(file.points.size() == 0);
  CHECK(file.units_per_metre.value == wheelrail_test::StrictScalar(0));
}
