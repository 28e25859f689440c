#pragma once
// A vehicle's quantities from a CSV file: `quantity,value,unit,source`, `#` begins a comment. A
// source that begins with "unconfirmed" marks a value that is left out unless it is asked for.

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>
#include <wheelrail/dynamics/characteristic.hpp>

namespace examples {

enum class Unconfirmed { left_out, used };

class VehicleData {
 public:
  // Throws std::invalid_argument with file and line.
  explicit VehicleData(const std::string& path, Unconfirmed unconfirmed = Unconfirmed::left_out)
      : path_(path) {
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
      if (values_.contains(name) || left_out_.contains(name)) fail("'" + name + "' is given twice");
      const auto third = line.find(',', second + 1);
      const bool is_unconfirmed =
          third != std::string::npos &&
          std::string_view(line).substr(third + 1).starts_with("unconfirmed");
      const bool is_used = !is_unconfirmed || unconfirmed == Unconfirmed::used;
      (is_used ? values_ : left_out_).emplace(name, value);
    }
    if (!has_header) throw std::invalid_argument(path + ": the file has no header");
  }

  [[nodiscard]] double operator[](const std::string& quantity) const {
    const auto found = values_.find(quantity);
    if (found == values_.end()) {
      throw std::invalid_argument(path_ + ": the vehicle lacks the quantity '" + quantity + "'" +
                                  (left_out_.contains(quantity) ? ", which is unconfirmed" : ""));
    }
    return found->second;
  }

  [[nodiscard]] bool has(const std::string& quantity) const { return values_.contains(quantity); }

  // Masses, inertias, lengths: greater than zero.
  [[nodiscard]] double positive(const std::string& quantity) const {
    const double value = (*this)[quantity];
    if (!(value > 0)) {
      throw std::invalid_argument(path_ + ": '" + quantity + "' is " + std::to_string(value) +
                                  ", but must be > 0");
    }
    return value;
  }

  // The rows "<name> at <x> mm" of a table, by x [m].
  [[nodiscard]] std::vector<wheelrail::CharacteristicPoint<double>> table(
      const std::string& name) const {
    const std::string begin = name + " at ";
    std::map<double, double> rows;
    for (auto row = values_.lower_bound(begin);
         row != values_.end() && row->first.starts_with(begin); ++row) {
      const std::string text = row->first.substr(begin.size());
      char* end = nullptr;
      const double x = std::strtod(text.c_str(), &end);
      if (end == text.c_str() || std::string(end) != " mm" ||
          !rows.emplace(x, row->second).second) {
        throw std::invalid_argument(path_ + ": '" + row->first +
                                    "' must end with its own number and ' mm'");
      }
    }
    std::vector<wheelrail::CharacteristicPoint<double>> points;
    for (const auto& [x, force] : rows) points.push_back({x / 1000, force});
    return points;
  }

  // The quantities that are unconfirmed and left out, in alphabetical order.
  [[nodiscard]] std::vector<std::string> left_out() const {
    std::vector<std::string> names;
    for (const auto& [name, value] : left_out_) names.push_back(name);
    return names;
  }

 private:
  std::string path_;
  std::map<std::string, double> values_, left_out_;
};

}  // namespace examples
