// An outside program of two files that both include every public header: a function or variable
// that lacks `inline` is then there twice. Without arguments it prints the library's version; with
// one it constructs something that the library refuses, and shows what is said.
#include <cstdio>
#include <cstring>
#include <exception>

#include "every_header.hpp"

const char* version_seen_by_the_other_file();

namespace {

void refuse(const char* what) {
  using namespace wheelrail;
  if (std::strcmp(what, "value") == 0) {
    const MaterialPair<double> pair({-1.0, 0.3}, steel<double>());
  } else if (std::strcmp(what, "points") == 0) {
    const auto repair = repair_points(ProfilePoints<double>{{0, 1, 2}, {0, 0, 0}});
  } else if (std::strcmp(what, "text") == 0) {
    const auto file = parse_profile("0 0\n1 x\n", "a_table.txt", ProfileKind::wheel);
  } else if (std::strcmp(what, "file") == 0) {
    const ProfilePoints<double> points{{0, 1, 2, 3}, {0, 0, 0, 0}};
    write_profile("no_such_folder/a_table.txt", points, ProfileKind::wheel);
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 1) {
    std::printf("%s\n", wheelrail::version_string);
    // The same variable in both files, not a copy in each.
    return wheelrail::version_string == version_seen_by_the_other_file() ? 0 : 1;
  }
#if defined(__cpp_exceptions)
  try {
    refuse(arguments[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
#else
  refuse(arguments[1]);
#endif
  return 0;
}
