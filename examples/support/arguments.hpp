#pragma once
// The command line of the examples: options with defaults, units and --help, and errors that name
// the option, the value and the rule. `--name value` and `--name=value` both work.

#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace examples {

struct Option {
  std::string name;           // with its dashes
  std::string placeholder;    // what the value is, e.g. "M/S"; empty: it has none
  std::string default_value;  // empty: none
  std::string help;           // with the unit
};

class Arguments {
 public:
  Arguments(std::string summary, std::vector<Option> options)
      : summary_(std::move(summary)), options_(std::move(options)) {}

  // Throws std::invalid_argument. Returns false when --help was asked for and printed.
  [[nodiscard]] bool parse(int argc, char** argv) {
    for (int i = 1; i < argc; ++i) {
      std::string name = argv[i];
      if (name == "--help" || name == "-h") {
        print_help(argv[0]);
        return false;
      }
      std::string value;
      const auto equals = name.find('=');
      const bool has_value = name.starts_with("--") && equals != std::string::npos;
      if (has_value) {
        value = name.substr(equals + 1);
        name.resize(equals);
      }
      const Option* option = find(name);
      if (option == nullptr) {
        throw std::invalid_argument("unknown option " + name + " (--help lists the options)");
      }
      if (option->placeholder.empty()) {
        if (has_value) throw std::invalid_argument(name + " takes no value");
      } else if (!has_value) {
        if (i + 1 >= argc) throw std::invalid_argument(name + ": its value is missing");
        value = argv[++i];
      }
      if (!given_.emplace(name, value).second) {
        throw std::invalid_argument(name + " is given twice");
      }
    }
    return true;
  }

  [[nodiscard]] bool given(const std::string& name) const { return given_.contains(name); }

  [[nodiscard]] std::string text(const std::string& name) const {
    const auto found = given_.find(name);
    return found != given_.end() ? found->second : find(name)->default_value;
  }

  [[nodiscard]] double number(const std::string& name) const {
    const std::string value = text(name);
    char* end = nullptr;
    const double number = std::strtod(value.c_str(), &end);
    if (value.empty() || *end != '\0' || !std::isfinite(number)) {
      throw std::invalid_argument(name + " is '" + value + "', but must be a finite number");
    }
    return number;
  }

  [[nodiscard]] double positive(const std::string& name) const {
    const double value = number(name);
    if (!(value > 0)) {
      throw std::invalid_argument(name + " is " + text(name) + ", but must be > 0");
    }
    return value;
  }

  [[nodiscard]] double within(const std::string& name, double lower, double upper) const {
    const double value = number(name);
    if (value < lower || upper < value) {
      char rule[80];
      std::snprintf(rule, sizeof rule, ", but must be between %g and %g", lower, upper);
      throw std::invalid_argument(name + " is " + text(name) + rule);
    }
    return value;
  }

  [[nodiscard]] int whole(const std::string& name, int lower, int upper) const {
    const double value = number(name);
    if (value != std::floor(value) || value < lower || upper < value) {
      throw std::invalid_argument(name + " is " + text(name) +
                                  ", but must be a whole number from " + std::to_string(lower) +
                                  " to " + std::to_string(upper));
    }
    return static_cast<int>(value);
  }

  // One of the given words.
  [[nodiscard]] std::string choice(const std::string& name,
                                   const std::vector<std::string>& words) const {
    const std::string value = text(name);
    std::string list;
    for (const std::string& word : words) {
      if (word == value) return value;
      list += (list.empty() ? "" : ", ") + word;
    }
    throw std::invalid_argument(name + " is '" + value + "', but must be one of " + list);
  }

 private:
  [[nodiscard]] const Option* find(const std::string& name) const {
    for (const Option& option : options_) {
      if (option.name == name) return &option;
    }
    return nullptr;
  }

  void print_help(const std::string& path) const {
    const std::string program = path.substr(path.find_last_of('/') + 1);
    std::printf("usage: %s [options]\n\n%s\n\noptions:\n", program.c_str(), summary_.c_str());
    for (const Option& option : options_) {
      const std::string left =
          option.placeholder.empty() ? option.name : option.name + " " + option.placeholder;
      std::printf("  %-28s %s", left.c_str(), option.help.c_str());
      if (!option.default_value.empty()) std::printf(" (default %s)", option.default_value.c_str());
      std::printf("\n");
    }
    std::printf("  %-28s print this\n", "--help");
  }

  std::string summary_;
  std::vector<Option> options_;
  std::map<std::string, std::string> given_;
};

// Runs an example's body: bad input is one line on standard error and exit code 2.
template <class Body>
[[nodiscard]] int run(int argc, char** argv, Arguments arguments, Body&& body) {
  const std::string path = argc > 0 ? argv[0] : "example";
  try {
    if (!arguments.parse(argc, argv)) return 0;
    const int exit_code = body(arguments);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      throw std::runtime_error("cannot write to standard output");
    }
    return exit_code;
  } catch (const std::exception& error) {
    std::string line = path.substr(path.find_last_of('/') + 1) + ": " + error.what();
    // Names and values may hold line breaks; the message may not.
    for (char& c : line) {
      if (std::iscntrl(static_cast<unsigned char>(c)) != 0) c = '?';
    }
    std::fprintf(stderr, "%s\n", line.c_str());
    return 2;
  }
}

}  // namespace examples
