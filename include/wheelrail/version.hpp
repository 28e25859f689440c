#pragma once
/// @file
/// The version of the library, MAJOR.MINOR.PATCH. The numbers stand here and nowhere else:
/// CMakeLists.txt reads them from this file. Includes nothing, so that it can be asked first.

/// The first number.
#define WHEELRAIL_VERSION_MAJOR 0
/// The second number.
#define WHEELRAIL_VERSION_MINOR 1
/// The third number.
#define WHEELRAIL_VERSION_PATCH 0

/// 1000000 MAJOR + 1000 MINOR + PATCH, for the preprocessor to compare.
#define WHEELRAIL_VERSION \
  (1000000 * WHEELRAIL_VERSION_MAJOR + 1000 * WHEELRAIL_VERSION_MINOR + WHEELRAIL_VERSION_PATCH)

#define WHEELRAIL_DETAIL_TEXT_OF(number) #number
#define WHEELRAIL_DETAIL_VERSION_TEXT(major, minor, patch) \
  WHEELRAIL_DETAIL_TEXT_OF(major)                          \
  "." WHEELRAIL_DETAIL_TEXT_OF(minor) "." WHEELRAIL_DETAIL_TEXT_OF(patch)

/// "MAJOR.MINOR.PATCH", as a literal.
#define WHEELRAIL_VERSION_STRING                                                  \
  WHEELRAIL_DETAIL_VERSION_TEXT(WHEELRAIL_VERSION_MAJOR, WHEELRAIL_VERSION_MINOR, \
                                WHEELRAIL_VERSION_PATCH)

namespace wheelrail {

/// Grows where a program that uses the library may have to be changed.
inline constexpr int version_major = WHEELRAIL_VERSION_MAJOR;
/// Grows where something is added; while the major version is 0, also where something is changed.
inline constexpr int version_minor = WHEELRAIL_VERSION_MINOR;
/// Grows where something is mended.
inline constexpr int version_patch = WHEELRAIL_VERSION_PATCH;
/// "MAJOR.MINOR.PATCH"
inline constexpr char version_string[] = WHEELRAIL_VERSION_STRING;

}  // namespace wheelrail
