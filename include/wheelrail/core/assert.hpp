#pragma once
/// @file
/// The one assertion of the library, for slips of its own; off under NDEBUG. Data from outside is
/// checked by `require` (core/require.hpp) instead, always.

#include <cassert>

/// Ends the program unless @p condition holds; nothing under NDEBUG.
#define WHEELRAIL_ASSERT(condition) assert(condition)
