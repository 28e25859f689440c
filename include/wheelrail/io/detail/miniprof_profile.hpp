#pragma once
// MiniProf files, as io/profile_format.hpp describes them. May include: core, io.

#include <algorithm>
#include <string>
#include <wheelrail/io/detail/profile_text.hpp>

namespace wheelrail::detail {

// Which columns of a MiniProf file hold X and Y, and how many there are.
struct MiniprofColumns {
  std::size_t lateral = 0;
  std::size_t value = 1;
  std::size_t count = 2;
  bool and_more = true;  // "*"
};

[[nodiscard]] inline MiniprofColumns miniprof_columns(const ProfileText& text, std::size_t line,
                                                      std::string_view definition,
                                                      RawProfile& profile) {
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  MiniprofColumns columns{none, none, 0, false};
  for (const std::string_view name : split_at(definition, ',')) {
    const std::string letter = lower_case(name);
    if (columns.and_more || letter.empty()) {
      text.refuse(line, joined({"ColumnDef is ", shown(definition),
                                ", but must be names with commas between them, * the last"}));
    }
    if (letter == "*") {
      columns.and_more = true;
      continue;
    }
    if (letter == "x" || letter == "y") {
      auto& column = letter == "x" ? columns.lateral : columns.value;
      if (column != none) {
        text.refuse(line,
                    joined({"ColumnDef is ", shown(definition), ", but must name X and Y once"}));
      }
      column = columns.count;
    } else {
      profile.not_applied.push_back(joined({"column ", name}));
    }
    ++columns.count;
  }
  if (columns.lateral == none || columns.value == none) {
    text.refuse(line, joined({"ColumnDef is ", shown(definition), ", but must name X and Y"}));
  }
  return columns;
}

[[nodiscard]] inline RawProfile read_miniprof(const ProfileText& text, std::size_t maximum_points) {
  RawProfile profile;
  profile.units_per_metre = 1000.0;
  MiniprofColumns columns;
  double offset_lateral = 0, offset_value = 0, declared = -1;
  std::size_t declared_line = 0;
  for (const ProfileLine& line : text.lines()) {
    if (std::string_view("!\"%#").find(line.text.front()) != std::string_view::npos) {
      add_comment(profile, line.text);
      continue;
    }
    if (const auto key = split_key(line.text)) {
      if (!profile.lateral.empty()) {
        text.refuse(line.number, joined({"the key ", shown(key->first),
                                         " stands after points, but must stand before them"}));
      }
      const std::string name = lower_case(key->first);
      if (name.empty()) text.refuse(line.number, "the key is empty, but must be a name");
      const auto number = [&] {
        return text.number(line.number, key->second, std::string(key->first));
      };
      profile.header.emplace_back(key->first, key->second);
      if (name == "columndef") {
        columns = miniprof_columns(text, line.number, key->second, profile);
      } else if (name == "xoffset") {
        offset_lateral = number();
      } else if (name == "yoffset") {
        offset_value = number();
      } else if (name == "xypoints") {
        declared = number();
        declared_line = line.number;
        if (declared < 0 ||
            declared != static_cast<double>(static_cast<long long>(std::min(declared, 1e15)))) {
          text.refuse(line.number, joined({"XYPoints is ", shown(key->second),
                                           ", but must be a whole number >= 0"}));
        }
      } else if (name == "comment" && !key->second.empty()) {
        profile.comments.emplace_back(key->second);
      }
      continue;
    }
    const auto fields = split_fields(line.text);
    const bool enough =
        columns.and_more ? fields.size() >= columns.count : fields.size() == columns.count;
    if (!enough) {
      text.refuse(line.number,
                  joined({"there are ", std::to_string(fields.size()), " columns in ",
                          shown(line.text), ", but must be ", std::to_string(columns.count),
                          columns.and_more ? " or more" : "", " by ColumnDef"}));
    }
    const double lateral =
        text.number(line.number, fields[columns.lateral], "the lateral coordinate X");
    const double value = text.number(line.number, fields[columns.value], "the coordinate Y");
    text.add_point(profile, line.number, lateral + offset_lateral, value + offset_value,
                   maximum_points);
  }
  if (declared_line > 0 && declared != static_cast<double>(profile.lateral.size())) {
    text.refuse(text.last_line(),
                joined({"there are ", std::to_string(profile.lateral.size()),
                        " points, but must be as many as XYPoints in line ",
                        std::to_string(declared_line), " says, ", to_text(declared)}));
  }
  return profile;
}

}  // namespace wheelrail::detail
