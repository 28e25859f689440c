#include "vehicle_data.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace examples {

const std::map<std::string, QuantityRule>& vehicle_quantities() {
  static const auto all = [] {
    const std::string share = "axlebox body share of the wheelset", rod = "traction rod stiffness";
    const std::string boxes = "axlebox body mass (both boxes of one wheelset)";
    std::map<std::string, QuantityRule> rules{
        {"carbody mass", {"kg"}},
        {"carbody centre of mass height", {"m"}},
        {"bogie frame mass", {"kg"}},
        {"bogie frame centre of mass height", {"m"}},
        {"wheelset mass", {"kg"}},
        {boxes, {"kg", "", share}},
        {share, {"-"}},
        {"wheel radius", {"m"}},
        {"wheel flange back to back", {"m"}},
        {"tread circle to flange back", {"m", "wheel flange back to back"}},
        {"bogie wheelbase", {"m"}},
        {"bogie spacing", {"m"}},
        {"primary lateral semi-distance", {"m"}},
        {"secondary lateral semi-distance", {"m"}},
        {"secondary height above rail", {"m"}},
        {"secondary bending stiffness per side", {"N m/rad"}},
        {"anti-roll bar stiffness per bogie", {"N m/rad"}},
        {"lateral bump stop force", {"N"}},
        {"lateral bump stop height above rail", {"m", "lateral bump stop force"}},
        {rod, {"N/m"}},
        {"traction rod damping", {"N s/m", rod}},
        {"traction rod height above rail", {"m", rod}}};
    for (const std::string axis : {"x", "y", "z"}) {
      for (const std::string body : {"carbody", "bogie frame", "wheelset"}) {
        rules[body + " I" + axis + axis] = {"kg m2"};
      }
      rules["axlebox body I" + axis + axis] = {"kg m2", boxes, share};
      for (const std::string name : {"primary", "secondary"}) {
        const std::string per = axis + (name == "primary" ? " per box" : " per side");
        rules[name + " k" + per] = {"N/m"};
        rules[name + " c" + per] = {"N s/m"};
        rules[name + " damper series k" + per] = {"N/m"};
      }
    }
    return rules;
  }();
  return all;
}

VehicleData::VehicleData(const std::string& path, Unconfirmed unconfirmed) : path_(path) {
  std::ifstream file(path);
  if (!file) throw std::invalid_argument("vehicle: cannot open '" + path + "'");
  std::string line;
  bool has_header = false;
  for (int number = 1; std::getline(file, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line.front() == '#') continue;
    if (!has_header) {
      if (!line.starts_with("quantity,value,unit")) {
        fail(number, "the header must begin with 'quantity,value,unit'");
      }
      has_header = true;
      continue;
    }
    add(line, number, unconfirmed == Unconfirmed::used);
  }
  if (file.bad()) throw std::invalid_argument("vehicle: '" + path + "' is not a readable file");
  if (!has_header) throw std::invalid_argument(path + ": the file has no header");
  for (const auto& [name, row] : rows_) {
    const QuantityRule& rule = *rule_of(name);
    if (!rule.with.empty() && !is_in_file(rule.with)) {
      fail(row.line, "'" + name + "' says nothing without '" + rule.with + "'");
    }
    if (!rule.without.empty() && row.is_used && has(rule.without)) {
      fail(row.line, "'" + name + "' says nothing beside '" + rule.without + "'");
    }
  }
}

double VehicleData::positive(const std::string& quantity) const {
  const Row& row = used_row(quantity);
  if (!(row.value > 0)) {
    fail(row.line, "'" + quantity + "' is " + std::to_string(row.value) + ", but must be > 0");
  }
  return row.value;
}

std::vector<wheelrail::CharacteristicPoint<double>> VehicleData::table(
    const std::string& name) const {
  const std::string begin = name + " at ";
  std::map<double, double> points_by_place;
  for (auto row = rows_.lower_bound(begin); row != rows_.end() && row->first.starts_with(begin);
       ++row) {
    if (!row->second.is_used) continue;
    if (!points_by_place.emplace(*place_in_table(row->first), row->second.value).second) {
      fail(row->second.line, "'" + row->first + "' is given twice");
    }
  }
  std::vector<wheelrail::CharacteristicPoint<double>> points;
  for (const auto& [x, force] : points_by_place) points.push_back({x / 1000, force});
  return points;
}

std::vector<std::string> VehicleData::left_out() const {
  std::vector<std::string> names;
  for (const auto& [name, row] : rows_) {
    if (!row.is_used) names.push_back(name);
  }
  return names;
}

void VehicleData::fail(int line, const std::string& why) const {
  throw std::invalid_argument(path_ + ":" + std::to_string(line) + ": " + why);
}

void VehicleData::add(const std::string& line, int number, bool with_unconfirmed) {
  const auto first = line.find(',');
  const auto second = first == std::string::npos ? first : line.find(',', first + 1);
  if (second == std::string::npos) fail(number, "the row must be quantity,value,unit");
  const auto third = std::min(line.find(',', second + 1), line.size());
  const std::string name = line.substr(0, first);
  const std::string text = line.substr(first + 1, second - first - 1);
  const std::string unit = line.substr(second + 1, third - second - 1);
  const QuantityRule* rule = rule_of(name);
  if (rule == nullptr) fail(number, "'" + name + "' is no quantity of a vehicle");
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value)) {
    fail(number, "the value of '" + name + "' is '" + text + "', but must be a finite number");
  }
  if (unit != rule->unit) {
    fail(number, "'" + name + "': unit is '" + unit + "', but must be '" + rule->unit + "'");
  }
  const bool is_unconfirmed = std::string_view(line).substr(third).starts_with(",unconfirmed");
  const Row row{value, number, !is_unconfirmed || with_unconfirmed};
  if (!rows_.emplace(name, row).second) fail(number, "'" + name + "' is given twice");
}

std::optional<double> VehicleData::place_in_table(const std::string& name) {
  const std::string begin = std::string(table_name) + " at ";
  if (!name.starts_with(begin)) return {};
  const std::string text = name.substr(begin.size());
  char* end = nullptr;
  const double x = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || std::string_view(end) != " mm" || !std::isfinite(x)) return {};
  return x;
}

const QuantityRule* VehicleData::rule_of(const std::string& name) {
  if (name == table_name) return nullptr;
  const auto found = vehicle_quantities().find(place_in_table(name) ? table_name : name);
  return found == vehicle_quantities().end() ? nullptr : &found->second;
}

bool VehicleData::is_in_file(const std::string& quantity) const {
  if (quantity != table_name) return rows_.contains(quantity);
  const auto row = rows_.lower_bound(quantity);
  return row != rows_.end() && row->first.starts_with(quantity);
}

const VehicleData::Row* VehicleData::find(const std::string& quantity) const {
  if (rule_of(quantity) == nullptr) {
    throw std::logic_error("vehicle_quantities() lacks '" + quantity + "'");
  }
  const auto found = rows_.find(quantity);
  return found == rows_.end() || !found->second.is_used ? nullptr : &found->second;
}

const VehicleData::Row& VehicleData::used_row(const std::string& quantity) const {
  const Row* row = find(quantity);
  if (row == nullptr) {
    throw std::invalid_argument(path_ + ": the vehicle lacks the quantity '" + quantity + "'" +
                                (rows_.contains(quantity) ? ", which is unconfirmed" : ""));
  }
  return *row;
}

}  // namespace examples
