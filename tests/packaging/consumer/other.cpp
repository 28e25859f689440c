// The second file of the program.
#include "every_header.hpp"

const char* version_seen_by_the_other_file();

const char* version_seen_by_the_other_file() {
  return wheelrail::version_string;
}
