#include <string>
#include <wheelrail/version.hpp>

#include "support/catch.hpp"

// That CMake's and pkg-config's version is this one is what packaging_test.sh checks.
TEST_CASE("version: macros, constants and text agree", "[packaging]") {
  STATIC_REQUIRE(wheelrail::version_major == WHEELRAIL_VERSION_MAJOR);
  STATIC_REQUIRE(wheelrail::version_minor == WHEELRAIL_VERSION_MINOR);
  STATIC_REQUIRE(wheelrail::version_patch == WHEELRAIL_VERSION_PATCH);
  const std::string text = std::to_string(wheelrail::version_major)
                               .append(".")
                               .append(std::to_string(wheelrail::version_minor))
                               .append(".")
                               .append(std::to_string(wheelrail::version_patch));
  CHECK(text == wheelrail::version_string);
  CHECK(text == WHEELRAIL_VERSION_STRING);
}

#if WHEELRAIL_VERSION < 1000 || WHEELRAIL_VERSION < 1000000 * WHEELRAIL_VERSION_MAJOR
#error "the preprocessor cannot compare versions"
#endif

TEST_CASE("version: versions are ordered as numbers of three digits", "[packaging]") {
  STATIC_REQUIRE(WHEELRAIL_VERSION ==
                 (wheelrail::version_major * 1000 + wheelrail::version_minor) * 1000 +
                     wheelrail::version_patch);
  STATIC_REQUIRE(wheelrail::version_minor < 1000);
  STATIC_REQUIRE(wheelrail::version_patch < 1000);
}
