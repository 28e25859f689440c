#pragma once
// Files of the examples: made whole or not at all.

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <wheelrail/io/detail/whole_file.hpp>

namespace examples {

// A line of text as printf makes it.
[[gnu::format(printf, 1, 2)]] [[nodiscard]] inline std::string format(const char* pattern, ...) {
  char text[4096];
  std::va_list values;
  va_start(values, pattern);
  std::vsnprintf(text, sizeof text, pattern, values);
  va_end(values);
  return text;
}

// Zero and NaN without their signs, for tables: 0 and nan, never -0 or -nan.
[[nodiscard]] inline double plain(double x) {
  return std::isnan(x) ? std::nan("") : x + 0.0;
}

// Appends ",value" for each value, plain, with that many significant digits.
inline void append_fields(std::string& text, int digits, std::initializer_list<double> values) {
  for (const double value : values) text += format(",%.*g", digits, plain(value));
}

// Makes the directory and checks that it can be written to, before a long run.
inline std::filesystem::path prepare_directory(const std::string& name) {
  std::error_code error;
  std::filesystem::create_directories(name, error);
  const std::filesystem::path probe = std::filesystem::path(name) / ".wheelrail-probe";
  const bool writable = !error && std::ofstream(probe).good();
  std::filesystem::remove(probe, error);
  if (!writable) {
    throw std::invalid_argument("--output is '" + name +
                                "', but must be a directory that can be made and written to");
  }
  return name;
}

// A reader never sees half a file.
inline void write_file(const std::filesystem::path& path, const std::string& text) {
  if (!wheelrail::detail::write_whole_file(path, text)) {
    throw std::runtime_error("cannot write " + path.string());
  }
}

}  // namespace examples
