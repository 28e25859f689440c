#pragma once
// Text of profile files: lines, fields and numbers, errors with file and line. Files are read in
// double, whatever scalar their points become. May include: core, io.

#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>
#include <wheelrail/core/require.hpp>
#include <wheelrail/io/profile_format.hpp>

namespace wheelrail::detail {

// What a format's reader makes of a text: the file's own units and axes.
struct RawProfile {
  std::vector<double> lateral{};
  std::vector<double> value{};
  std::vector<std::size_t> lines{};         // that the points stand on, from 1
  std::optional<double> units_per_metre{};  // as stated
  bool axes_stated = false;                 // the library's own
  std::vector<std::string> comments{};
  std::vector<std::pair<std::string, std::string>> header{};
  std::vector<std::string> not_applied{};
};

struct ProfileLine {
  std::size_t number = 0;  // from 1
  std::string_view text;   // without white space around it
};

[[nodiscard]] constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}
[[nodiscard]] constexpr bool is_digit(char c) {
  return '0' <= c && c <= '9';
}
[[nodiscard]] constexpr bool is_letter(char c) {
  return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z');
}

[[nodiscard]] inline std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

[[nodiscard]] inline std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if ('A' <= c && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

// A piece of the file for a message: short, printable, in quotes.
[[nodiscard]] inline std::string shown(std::string_view text) {
  std::string quote(1, '\'');
  for (const char c : text.substr(0, 40)) quote.push_back(' ' <= c && c <= '~' ? c : '?');
  return quote.append(text.size() > 40 ? "...'" : "'");
}

// A named text and its lines.
class ProfileText {
 public:
  // Line ends are LF, CR LF or CR. @throws where a byte is no text or there are too many.
  ProfileText(std::string name, std::string_view text, std::size_t maximum_bytes)
      : name_(std::move(name)) {
    if (text.size() > maximum_bytes) {
      refuse(1, joined({"there are ", std::to_string(text.size()),
                        " bytes, but there must be at most ", std::to_string(maximum_bytes)}));
    }
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    for (std::size_t begin = 0, number = 1; begin < text.size(); ++number) {
      std::size_t end = begin;
      for (; end < text.size() && text[end] != '\n' && text[end] != '\r'; ++end) {
        const auto byte = static_cast<unsigned char>(text[end]);
        if ((byte < 0x20 && byte != '\t') || byte == 0x7F) {
          refuse(number, "a byte is " + std::to_string(byte) + ", but must be text");
        }
      }
      const std::string_view line = trimmed(text.substr(begin, end - begin));
      if (!line.empty()) lines_.push_back({number, line});
      last_line_ = number;
      begin = end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
    }
  }

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::vector<ProfileLine>& lines() const { return lines_; }
  [[nodiscard]] std::size_t last_line() const { return last_line_; }

  [[noreturn]] void refuse(std::size_t line, const std::string& reason) const {
    throw_or_abort(joined({name_, ":", std::to_string(line), ": ", reason}));
  }

  // @p field as a finite number; refuses all else.
  [[nodiscard]] double number(std::size_t line, std::string_view field,
                              const std::string& what) const {
    std::string_view digits = field;
    if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
    double value = 0;
    const char* const end = digits.data() + digits.size();
    const auto result = std::from_chars(digits.data(), end, value);
    if (result.ec == std::errc::result_out_of_range) {
      refuse(line, joined({what, " is ", shown(field), ", but must be in double's range"}));
    }
    if (result.ec == std::errc() && result.ptr != end && *result.ptr == ',') {
      refuse(line, joined({what, " is ", shown(field),
                           ", but must have a decimal point, not a decimal comma"}));
    }
    if (result.ec != std::errc() || result.ptr != end) {
      refuse(line, joined({what, " is ", shown(field), ", but must be a number"}));
    }
    if (!is_finite(value)) {
      refuse(line, joined({what, " is ", shown(field), ", but must be finite"}));
    }
    return value;
  }

  void add_point(RawProfile& profile, std::size_t line, double lateral, double value,
                 std::size_t maximum_points) const {
    if (profile.lateral.size() >= maximum_points) {
      refuse(line, joined({"there are more points, but must be at most ",
                           std::to_string(maximum_points)}));
    }
    profile.lateral.push_back(lateral);
    profile.value.push_back(value);
    profile.lines.push_back(line);
  }

 private:
  std::string name_;
  std::vector<ProfileLine> lines_;  // but the empty ones
  std::size_t last_line_ = 1;
};

// Keeps a comment line that says something, without its mark: rulers of stars do not.
inline void add_comment(RawProfile& profile, std::string_view line) {
  line.remove_prefix(1);
  line = trimmed(line);
  for (const char c : line) {
    if (is_letter(c) || is_digit(c) || static_cast<unsigned char>(c) >= 0x80) {
      profile.comments.emplace_back(line);
      return;
    }
  }
}

[[nodiscard]] inline std::vector<std::string_view> split_at(std::string_view text, char separator) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t end = text.find(separator);
    fields.push_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return fields;
    text.remove_prefix(end + 1);
  }
}

[[nodiscard]] inline std::vector<std::string_view> split_at_blanks(std::string_view text) {
  std::vector<std::string_view> fields;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    std::size_t end = 0;
    while (end < text.size() && !is_blank(text[end])) ++end;
    fields.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return fields;
}

// Fields between semicolons, else commas, else white space.
[[nodiscard]] inline std::vector<std::string_view> split_fields(std::string_view text) {
  if (text.find(';') != std::string_view::npos) return split_at(text, ';');
  if (text.find(',') != std::string_view::npos) return split_at(text, ',');
  return split_at_blanks(text);
}

// "key = value" or "key=value": the two, or nothing where there is no key.
[[nodiscard]] inline std::optional<std::pair<std::string_view, std::string_view>> split_key(
    std::string_view text) {
  const std::size_t sign = text.find('=');
  if (sign == std::string_view::npos) return std::nullopt;
  return std::pair{trimmed(text.substr(0, sign)), trimmed(text.substr(sign + 1))};
}

}  // namespace wheelrail::detail
