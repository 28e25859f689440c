#pragma once
// A vehicle's quantities from a CSV file: `quantity,value,unit,source`, `#` begins a comment.

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

namespace examples {

class VehicleData {
 public:
  // Throws std::invalid_argument with file and line.
  explicit VehicleData(const std::string& path) : path_(path) {
    std::ifstream file(path);
    if (!file) throw std::invalid_argument("vehicle: cannot open '" + path + "'");
    std::string line;
    bool has_header = false;
    for (int number = 1; std::getline(file, line); ++number) {
      if (!line.empty() && line.back() == '\r') line.pop_back();
      if (line.empty() || line.front() == '#') continue;
      const auto fail = [&](const std::string& why) {
        throw std::invalid_argument(path + ":" + std::to_string(number) + ": " + why);
      };
      if (!has_header) {
        if (!line.starts_with("quantity,value,unit")) {
          fail("the header must begin with 'quantity,value,unit'");
        }
        has_header = true;
        continue;
      }
      const auto first = line.find(',');
      const auto second = first == std::string::npos ? first : line.find(',', first + 1);
      if (second == std::string::npos) fail("the row must be quantity,value,unit");
      const std::string name = line.substr(0, first);
      const std::string text = line.substr(first + 1, second - first - 1);
      char* end = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      if (text.empty() || *end != '\0' || !std::isfinite(value)) {
        fail("the value of '" + name + "' is '" + text + "', but must be a finite number");
      }
      if (!values_.emplace(name, value).second) fail("'" + name + "' is given twice");
    }
    if (!has_header) throw std::invalid_argument(path + ": the file has no header");
  }

  [[nodiscard]] double operator[](const std::string& quantity) const {
    const auto found = values_.find(quantity);
    if (found == values_.end()) {
      throw std::invalid_argument(path_ + ": the vehicle lacks the quantity '" + quantity + "'");
    }
    return found->second;
  }

  // Masses, inertias, lengths: greater than zero.
  [[nodiscard]] double positive(const std::string& quantity) const {
    const double value = (*this)[quantity];
    if (!(value > 0)) {
      throw std::invalid_argument(path_ + ": '" + quantity + "' is " + std::to_string(value) +
                                  ", but must be > 0");
    }
    return value;
  }

 private:
  std::string path_;
  std::map<std::string, double> values_;
};

}  // namespace examples
