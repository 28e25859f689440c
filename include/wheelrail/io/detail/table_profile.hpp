#pragma once
// Two columns of numbers, as io/profile_format.hpp describes them. May include: core, io.

#include <string>
#include <wheelrail/io/detail/profile_text.hpp>

namespace wheelrail::detail {

// The unit in the brackets of a column's name, if any.
[[nodiscard]] inline std::optional<double> table_unit(const ProfileText& text, std::size_t line,
                                                      std::string_view name) {
  const std::size_t open = name.find_first_of("[(");
  if (open == std::string_view::npos) return std::nullopt;
  const std::size_t close = name.find_first_of("])", open);
  const std::string unit = lower_case(trimmed(name.substr(
      open + 1, close == std::string_view::npos ? std::string_view::npos : close - open - 1)));
  if (unit == "m") return 1.0;
  if (unit == "mm") return 1000.0;
  text.refuse(line, joined({"a column's unit is ", shown(unit), ", but must be m or mm"}));
}

inline void read_table_header(const ProfileText& text, const ProfileLine& line,
                              RawProfile& profile) {
  std::vector<std::string_view> names = split_fields(line.text);
  const auto first = names.front();
  if (names.size() == 4 && line.text.find_first_of(",;") == std::string_view::npos) {
    // y [mm] z [mm]
    names = {line.text.substr(0, static_cast<std::size_t>(names[2].data() - first.data())),
             line.text.substr(static_cast<std::size_t>(names[2].data() - first.data()))};
  }
  if (names.size() != 2) {
    text.refuse(line.number, joined({"the header line has ", std::to_string(names.size()),
                                     " columns, but must have 2"}));
  }
  const auto bare = [](std::string_view name) {
    name = trimmed(name.substr(0, name.find_first_of("[(")));
    if (name.size() >= 2 && name.front() == '"' && name.back() == '"') {
      name = name.substr(1, name.size() - 2);
    }
    return lower_case(name);
  };
  const auto lateral_unit = table_unit(text, line.number, names[0]);
  const auto value_unit = table_unit(text, line.number, names[1]);
  if (lateral_unit && value_unit && *lateral_unit != *value_unit) {
    text.refuse(line.number, "the columns' units are m and mm, but must be the same");
  }
  profile.units_per_metre = lateral_unit ? lateral_unit : value_unit;
  profile.axes_stated = bare(names[0]) == "lateral" && bare(names[1]) == "value";
  profile.header.emplace_back("columns", std::string(line.text));
}

[[nodiscard]] inline RawProfile read_table(const ProfileText& text, std::size_t maximum_points) {
  RawProfile profile;
  bool may_be_header = true;
  for (const ProfileLine& line : text.lines()) {
    const std::string_view content = trimmed(line.text.substr(0, line.text.find_first_of("!#%")));
    if (content.empty()) {
      add_comment(profile, line.text);
      continue;
    }
    const std::string lower = lower_case(content);
    const bool has_name = is_letter(content.front()) || content.front() == '"';
    if (may_be_header && has_name && !lower.starts_with("nan") && !lower.starts_with("inf")) {
      read_table_header(text, {line.number, content}, profile);
      may_be_header = false;
      continue;
    }
    may_be_header = false;
    const auto fields = split_fields(content);
    if (fields.size() != 2) {
      text.refuse(line.number,
                  joined({"there are ", std::to_string(fields.size()), " columns in ",
                          shown(content), ", but must be 2 (of numbers without decimal commas)"}));
    }
    const double lateral = text.number(line.number, fields[0], "the lateral coordinate");
    const double value = text.number(line.number, fields[1], "the vertical coordinate");
    text.add_point(profile, line.number, lateral, value, maximum_points);
  }
  return profile;
}

}  // namespace wheelrail::detail
