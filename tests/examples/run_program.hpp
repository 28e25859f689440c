#pragma once
// Runs the built examples as a user does and returns what they say. POSIX only.

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "support/files.hpp"

namespace wheelrail_test {

// The lines of a text, without their ends; what follows the last end counts if it is not empty.
[[nodiscard]] inline Strings lines_of(const std::string& text) {
  Strings lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

[[nodiscard]] inline Strings fields_of(const std::string& row) {
  Strings fields;
  for (std::size_t begin = 0; begin <= row.size();) {
    const std::size_t end = std::min(row.find(',', begin), row.size());
    fields.push_back(row.substr(begin, end - begin));
    begin = end + 1;
  }
  return fields;
}

struct ProgramResult {
  int exit_code = -1;  // 128 + signal when it was killed
  std::string output;  // standard output
  std::string error;   // standard error
};

// Runs the example `name` with these arguments and this standard input.
[[nodiscard]] inline ProgramResult run_program(const std::string& name, const Strings& arguments,
                                               const std::string& input = "") {
  const auto quoted = [](const std::string& word) {
    std::string text(1, '\'');
    for (const char c : word) {
      if (c == '\'') text += "'\\'";
      text += c;
    }
    text += '\'';
    return text;
  };
  const TemporaryDirectory scratch;
  write_text(scratch / "in", input);
  std::string command = quoted(std::string(WHEELRAIL_EXAMPLES_DIR) + "/" + name);
  const auto add = [&](const char* before, const std::string& word) {
    command.append(before).append(quoted(word));
  };
  for (const std::string& argument : arguments) add(" ", argument);
  add(" <", scratch / "in");
  add(" >", scratch / "out");
  add(" 2>", scratch / "err");
  const int status = std::system(command.c_str());
  ProgramResult result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.output = read_text(scratch / "out");
  result.error = read_text(scratch / "err");
  return result;
}

// A program refuses bad input as it should: exit code 2, nothing on standard output, and one line
// on standard error that begins with the program's name.
[[nodiscard]] inline bool refuses(const ProgramResult& result, const std::string& name) {
  return result.exit_code == 2 && result.output.empty() && result.error.starts_with(name + ": ") &&
         result.error.size() > name.size() + 12 &&
         result.error.find('\n') == result.error.size() - 1;
}

}  // namespace wheelrail_test
