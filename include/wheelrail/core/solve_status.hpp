#pragma once
/// @file
/// How an iteration ended. Queries never throw: numerical failure is one of these.

namespace wheelrail {

/// How an iteration for one or more unknowns ended.
enum class SolveStatus {
  converged,        ///< the tolerance was met
  iteration_limit,  ///< the cap on iterations was reached first
  no_bracket,       ///< the function has the same sign at both ends of the interval
  not_finite        ///< a NaN or an infinity went in or came up
};

/// The status in words, for messages and tables.
[[nodiscard]] constexpr const char* name_of(SolveStatus status) {
  switch (status) {
    case SolveStatus::converged:
      return "converged";
    case SolveStatus::iteration_limit:
      return "iteration_limit";
    case SolveStatus::no_bracket:
      return "no_bracket";
    case SolveStatus::not_finite:
      return "not_finite";
  }
  return "unknown";
}

}  // namespace wheelrail
