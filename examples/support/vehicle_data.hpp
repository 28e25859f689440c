#pragma once
// A vehicle's quantities from a CSV file: `quantity,value,unit,source`, `#` begins a comment. A
// source that begins with "unconfirmed" marks a value that is left out unless it is asked for.
// Quantities and units must be those listed here.

#include <map>
#include <optional>
#include <string>
#include <vector>
#include <wheelrail/dynamics/characteristic.hpp>

namespace examples {

struct QuantityRule {
  std::string unit;
  std::string with{};     // it says something beside this quantity alone; "": always
  std::string without{};  // it says nothing beside this one
};

// What a vehicle may have. "lateral bump stop force" is a table: see VehicleData::table.
[[nodiscard]] const std::map<std::string, QuantityRule>& vehicle_quantities();

enum class Unconfirmed { left_out, used };

class VehicleData {
 public:
  // Throws std::invalid_argument with file and line, as do the others; what is lacking has no line.
  explicit VehicleData(const std::string& path, Unconfirmed unconfirmed = Unconfirmed::left_out);

  // In the unit that vehicle_quantities has for it.
  [[nodiscard]] double operator[](const std::string& quantity) const {
    return used_row(quantity).value;
  }

  [[nodiscard]] bool has(const std::string& quantity) const { return find(quantity) != nullptr; }

  // Masses, inertias, lengths: greater than zero.
  [[nodiscard]] double positive(const std::string& quantity) const;

  // The rows "<name> at <x> mm" of a table, by x [m].
  [[nodiscard]] std::vector<wheelrail::CharacteristicPoint<double>> table(
      const std::string& name) const;

  // The quantities that are unconfirmed and left out, in alphabetical order.
  [[nodiscard]] std::vector<std::string> left_out() const;

 private:
  struct Row {
    double value = 0;
    int line = 0;
    bool is_used = true;
  };

  static constexpr const char* table_name = "lateral bump stop force";

  [[noreturn]] void fail(int line, const std::string& why) const;

  void add(const std::string& line, int number, bool with_unconfirmed);

  // x [mm] of a table's row.
  [[nodiscard]] static std::optional<double> place_in_table(const std::string& name);

  // That of a name as a row has it, or null.
  [[nodiscard]] static const QuantityRule* rule_of(const std::string& name);

  // Used or left out.
  [[nodiscard]] bool is_in_file(const std::string& quantity) const;

  // Throws std::logic_error for what no file may have: its reader or the list above is wrong.
  [[nodiscard]] const Row* find(const std::string& quantity) const;

  [[nodiscard]] const Row& used_row(const std::string& quantity) const;

  std::string path_;
  std::map<std::string, Row> rows_;
};

}  // namespace examples
