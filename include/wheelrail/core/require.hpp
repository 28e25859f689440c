#pragma once
/// @file
/// Checks of data from outside, at construction: an error names the thing, its value and the rule
/// that it broke. The one place that throws; without exceptions (-fno-exceptions) the same message
/// is printed and the program ended. May include: core, std.

#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <wheelrail/core/scalar.hpp>

namespace wheelrail::detail {

/// The parts one after the other. Messages are put together with this where sums of strings make a
/// compiler warn falsely of what it inlines.
[[nodiscard]] inline std::string joined(std::initializer_list<std::string_view> parts) {
  std::string text;
  for (const std::string_view part : parts) text.append(part);
  return text;
}

/// @p value for an error message; scalars that are no floating-point type have no text.
template <Real T>
[[nodiscard]] inline std::string to_text(const T& value) {
  if constexpr (std::is_floating_point_v<T>) {
    char text[40];
    std::snprintf(text, sizeof text, "%.9Lg", static_cast<long double>(value));
    return text;
  } else {
    return "(a value without text)";
  }
}

/// Refuses what a construction was given; all errors of the library end here.
/// @throws Error with @p message. Where the program is compiled without exceptions, prints the
///   message as one line to stderr and aborts. One program is to be compiled either way as a whole:
///   of an inline function the linker keeps one.
template <class Error = std::invalid_argument>
[[noreturn]] inline void throw_or_abort(const std::string& message) {
#if defined(__cpp_exceptions)
  throw Error(message);
#else
  std::fputs(message.c_str(), stderr);
  std::fputc('\n', stderr);
  std::abort();
#endif
}

/// @throws std::invalid_argument "<name> is <value>, but must be <rule>" unless @p holds.
template <Real T>
inline void require(bool holds, const std::string& name, const T& value, const std::string& rule) {
  if (!holds) {
    throw_or_abort(joined({name, " is ", to_text(value), ", but must be ", rule}));
  }
}

/// @throws std::invalid_argument with @p message unless @p holds.
inline void require(bool holds, const std::string& message) {
  if (!holds) throw_or_abort(message);
}

/// @throws std::invalid_argument unless @p value is finite.
template <Real T>
inline void require_finite(const std::string& name, const T& value) {
  require(is_finite(value), name, value, "finite");
}

/// @throws std::invalid_argument unless @p value is finite and > 0.
template <Real T>
inline void require_positive(const std::string& name, const T& value, const std::string& unit) {
  require(is_finite(value) && T(0) < value, name, value, "finite and > 0 " + unit);
}

/// @throws std::invalid_argument unless @p value is finite and >= 0.
template <Real T>
inline void require_not_negative(const std::string& name, const T& value, const std::string& unit) {
  require(is_finite(value) && !(value < T(0)), name, value, "finite and >= 0 " + unit);
}

}  // namespace wheelrail::detail
