#pragma once
// Replaces the global operators new and delete of the test program and counts what they allocate.
// Replacements cannot be inline: include this in exactly one source of a program.

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace wheelrail_test {

inline std::atomic<long> allocation_counter{0};

// How many allocations there have been so far in this program.
[[nodiscard]] inline long allocations_so_far() {
  return allocation_counter.load();
}

// How many allocations a call of `action` makes.
template <class Action>
[[nodiscard]] long allocations_of(Action&& action) {
  const long before = allocations_so_far();
  action();
  return allocations_so_far() - before;
}

}  // namespace wheelrail_test

// Inlined into half of a pair, g++ takes malloc and free for a mismatch.
#if defined(__GNUC__)
#define WHEELRAIL_TEST_NOINLINE [[gnu::noinline]]
#else
#define WHEELRAIL_TEST_NOINLINE
#endif

WHEELRAIL_TEST_NOINLINE void* operator new(std::size_t size) {
  ++wheelrail_test::allocation_counter;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
WHEELRAIL_TEST_NOINLINE void* operator new(std::size_t size, std::align_val_t alignment) {
  ++wheelrail_test::allocation_counter;
  const std::size_t step = static_cast<std::size_t>(alignment);
  const std::size_t rounded = (size + step - 1) / step * step;
  if (void* memory = std::aligned_alloc(step, rounded == 0 ? step : rounded)) return memory;
  throw std::bad_alloc();
}
WHEELRAIL_TEST_NOINLINE void* operator new[](std::size_t size) {
  return operator new(size);
}
WHEELRAIL_TEST_NOINLINE void* operator new[](std::size_t size, std::align_val_t alignment) {
  return operator new(size, alignment);
}
// The ones that do not throw too: sanitizers bring their own, which do not call those above.
WHEELRAIL_TEST_NOINLINE void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++wheelrail_test::allocation_counter;
  return std::malloc(size == 0 ? 1 : size);
}
WHEELRAIL_TEST_NOINLINE void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  ++wheelrail_test::allocation_counter;
  return std::malloc(size == 0 ? 1 : size);
}
WHEELRAIL_TEST_NOINLINE void operator delete(void* memory) noexcept {
  std::free(memory);
}
WHEELRAIL_TEST_NOINLINE void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
WHEELRAIL_TEST_NOINLINE void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
WHEELRAIL_TEST_NOINLINE void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
WHEELRAIL_TEST_NOINLINE void operator delete[](void* memory) noexcept {
  std::free(memory);
}
WHEELRAIL_TEST_NOINLINE void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}
WHEELRAIL_TEST_NOINLINE void operator delete[](void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
WHEELRAIL_TEST_NOINLINE void operator delete[](void* memory, std::size_t,
                                               std::align_val_t) noexcept {
  std::free(memory);
}

#undef WHEELRAIL_TEST_NOINLINE
