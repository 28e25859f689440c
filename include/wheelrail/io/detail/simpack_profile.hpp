#pragma once
// SIMPACK files, as io/profile_format.hpp describes them. May include: core, io.

#include <cmath>
#include <map>
#include <string>
#include <wheelrail/io/detail/profile_text.hpp>

namespace wheelrail::detail {

// What stands before a comment's mark; marks in quotes are text.
[[nodiscard]] inline std::string_view without_simpack_comment(std::string_view text) {
  bool in_quotes = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\'') in_quotes = !in_quotes;
    if (!in_quotes && (text[i] == '!' || text[i] == '%')) return trimmed(text.substr(0, i));
  }
  return text;
}

class SimpackReader {
 public:
  SimpackReader(const ProfileText& text, ProfileKind kind, bool unit_is_forced,
                std::size_t maximum_points)
      : text_(text), kind_(kind), maximum_points_(maximum_points) {
    for (const ProfileLine& line : text.lines()) read_line(line);
    if (section_ != Section::none) {
      text.refuse(text.last_line(), joined({"the file ends in the section ", section_name(),
                                            ", but must end it with ", section_name(), ".end"}));
    }
    if (!has_points_) text.refuse(text.last_line(), "there is no point.begin, but must be one");
    apply_keys();
    read_unit(unit_is_forced);
  }

  [[nodiscard]] RawProfile& profile() { return profile_; }

 private:
  enum class Section { none, header, spline, point };
  struct Entry {
    std::size_t line = 0;
    std::string value;
  };

  [[nodiscard]] const char* section_name() const {
    switch (section_) {
      case Section::header:
        return "header";
      case Section::spline:
        return "spline";
      case Section::point:
        return "point";
      default:
        return "no section";
    }
  }

  void read_line(const ProfileLine& line) {
    const std::string_view content = without_simpack_comment(line.text);
    if (content.empty()) {
      add_comment(profile_, line.text);
      return;
    }
    const std::string lower = lower_case(content);
    if (lower.ends_with(".begin") || lower.ends_with(".end")) {
      change_section(line.number, lower);
    } else if (section_ == Section::point) {
      read_point(line.number, content);
    } else {
      read_key(line.number, content);
    }
  }

  void change_section(std::size_t line, const std::string& word) {
    const auto go = [&](Section from, Section to) {
      if (section_ != from) {
        text_.refuse(line, joined({word, " stands in ", section_name(), ", but must not"}));
      }
      section_ = to;
    };
    const auto once = [&](bool& seen) {
      if (seen) text_.refuse(line, joined({"there is a second ", word, ", but must be one"}));
      seen = true;
    };
    if (word == "header.begin") {
      go(Section::none, Section::header);
      once(has_header_);
    } else if (word == "header.end") {
      go(Section::header, Section::none);
    } else if (word == "spline.begin") {
      go(Section::none, Section::spline);
      once(has_spline_);
    } else if (word == "spline.end") {
      go(Section::spline, Section::none);
    } else if (word == "point.begin") {
      go(Section::spline, Section::point);
      once(has_points_);
    } else if (word == "point.end") {
      go(Section::point, Section::spline);
    } else {
      text_.refuse(
          line, joined({"the section is ", shown(word), ", but must be header, spline or point"}));
    }
  }

  void read_point(std::size_t line, std::string_view content) {
    const auto fields = split_at_blanks(content);
    if (fields.size() != 2 && fields.size() != 3) {
      text_.refuse(line, joined({"there are ", std::to_string(fields.size()), " columns in ",
                                 shown(content), ", but must be y, z and perhaps a weight"}));
    }
    const double lateral = text_.number(line, fields[0], "the coordinate y");
    const double value = text_.number(line, fields[1], "the coordinate z");
    if (fields.size() == 3 && text_.number(line, fields[2], "the weight") != 1 && !has_weights_) {
      profile_.not_applied.emplace_back("weights");
      has_weights_ = true;
    }
    text_.add_point(profile_, line, lateral, value, maximum_points_);
  }

  void read_key(std::size_t line, std::string_view content) {
    const auto key = split_key(content);
    if (!key || key->first.empty() || section_ == Section::none) {
      text_.refuse(line, joined({shown(content), " stands in ", section_name(),
                                 ", but must be a key with its value in header or spline"}));
    }
    std::string_view value = key->second;
    if (value.size() >= 2 && value.front() == '\'' && value.back() == '\'') {
      value = trimmed(value.substr(1, value.size() - 2));
    }
    const std::string name =
        joined({section_ == Section::header ? "header." : "", lower_case(key->first)});
    if (!entries_.try_emplace(name, Entry{line, std::string(value)}).second) {
      text_.refuse(line, joined({"the key ", shown(key->first), " is given twice"}));
    }
    profile_.header.emplace_back(key->first, value);
    if (name == "comment" && !value.empty()) profile_.comments.emplace_back(value);
    static constexpr std::string_view known[] = {
        "header.version", "header.type", "file",        "file.mtime",  "comment",
        "type",           "shift.y",     "shift.z",     "rotate",      "bound.y.min",
        "bound.y.max",    "bound.z.min", "bound.z.max", "mirror.y",    "mirror.z",
        "inversion",      "units.len",   "units.ang",   "units.len.f", "units.ang.f"};
    bool is_known = false;
    for (const std::string_view other : known) is_known = is_known || name == other;
    const bool has_effect = name == "approx.smooth" || name == "point.dist.min"
                                ? text_.number(line, value, std::string(key->first)) != 0
                                : !is_known;
    if (has_effect) profile_.not_applied.emplace_back(key->first);
  }

  [[nodiscard]] double number(const std::string& key, double otherwise) const {
    const auto entry = entries_.find(key);
    if (entry == entries_.end()) return otherwise;
    return text_.number(entry->second.line, entry->second.value, key);
  }
  [[nodiscard]] bool flag(const std::string& key) const {
    const double value = number(key, 0);
    if (value != 0 && value != 1) refuse_key(key, "0 or 1");
    return value != 0;
  }
  [[nodiscard]] std::string word(const std::string& key) const {
    const auto entry = entries_.find(key);
    return entry == entries_.end() ? std::string() : lower_case(entry->second.value);
  }
  [[noreturn]] void refuse_key(const std::string& key, const std::string& rule) const {
    const Entry& entry = entries_.at(key);
    text_.refuse(entry.line, joined({key, " is ", shown(entry.value), ", but must be ", rule}));
  }

  void apply_keys() {
    if (entries_.contains("header.type")) {
      const bool is_wheel = flag("header.type");
      if (is_wheel != (kind_ == ProfileKind::wheel)) {
        refuse_key("header.type", kind_ == ProfileKind::wheel ? "1, a wheel's" : "0, a rail's");
      }
    }
    const double shift_lateral = number("shift.y", 0), shift_value = number("shift.z", 0);
    const double turn = rotation(), cosine = std::cos(turn), sine = std::sin(turn);
    const double lower = number("bound.y.min", 1), upper = number("bound.y.max", 0);
    const double lowest = number("bound.z.min", 1), highest = number("bound.z.max", 0);
    const double lateral_sign = flag("mirror.y") ? -1 : 1, value_sign = flag("mirror.z") ? -1 : 1;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < profile_.lateral.size(); ++i) {
      const double y = profile_.lateral[i] + shift_lateral;
      const double z = profile_.value[i] + shift_value;
      const double lateral = turn == 0 ? y : y * cosine - z * sine;
      double value = turn == 0 ? z : y * sine + z * cosine;
      if (lower < upper && (lateral < lower || lateral > upper)) continue;
      if (lowest < highest) value = value < lowest ? lowest : (value > highest ? highest : value);
      profile_.lateral[kept] = lateral_sign * lateral;
      profile_.value[kept] = value_sign * value;
      profile_.lines[kept++] = profile_.lines[i];
    }
    profile_.lateral.resize(kept);
    profile_.value.resize(kept);
    profile_.lines.resize(kept);
  }

  // [rad]
  [[nodiscard]] double rotation() const {
    const double angle = number("rotate", 0);
    if (angle == 0) return 0;
    const std::string unit = word("units.ang");
    constexpr double degrees = 57.295779513082320877;
    const double by_name = unit == "deg" ? degrees : 1;
    const double factor = number("units.ang.f", by_name);
    if (!(0 < factor)) refuse_key("units.ang.f", "> 0 [user/rad]");
    const bool has_name = unit == "rad" || unit == "deg";
    if (has_name && std::abs(factor - by_name) > 1e-3 * by_name) {
      refuse_key("units.ang.f", joined({"that of units.ang, ", shown(unit)}));
    }
    return angle / factor;
  }

  void read_unit(bool is_forced) {
    const std::string unit = word("units.len");
    const double by_name = unit == "m" ? 1 : (unit == "mm" ? 1000 : 0);
    const double factor = number("units.len.f", by_name);
    if (entries_.contains("units.len.f") && !(0 < factor)) {
      refuse_key("units.len.f", "> 0 [user/m]");
    }
    if (!is_forced && by_name > 0 && std::abs(factor - by_name) > 1e-9 * by_name) {
      refuse_key("units.len.f",
                 joined({"that of units.len, ", shown(unit), " (or the unit must be given)"}));
    }
    if (factor > 0) profile_.units_per_metre = factor;
  }

  const ProfileText& text_;
  ProfileKind kind_;
  std::size_t maximum_points_;
  RawProfile profile_;
  std::map<std::string, Entry> entries_;  // a header's keys begin with "header."
  Section section_ = Section::none;
  bool has_header_ = false, has_spline_ = false, has_points_ = false, has_weights_ = false;
};

}  // namespace wheelrail::detail
