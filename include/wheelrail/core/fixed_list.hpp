#pragma once
/// @file
/// A list with a capacity known at compile time, so that results hold several patches without heap.
/// May include: core, std.

#include <array>
#include <cstddef>
#include <wheelrail/core/assert.hpp>

namespace wheelrail {

/// Up to @p Capacity elements in insertion order. Invariant: size() <= Capacity.
/// @note No allocation. @p Element must be default-constructible.
template <class Element, std::size_t Capacity>
class FixedList {
 public:
  [[nodiscard]] constexpr std::size_t size() const { return size_; }
  [[nodiscard]] constexpr bool empty() const { return size_ == 0; }
  [[nodiscard]] constexpr bool full() const { return size_ == Capacity; }
  [[nodiscard]] static constexpr std::size_t capacity() { return Capacity; }

  /// Appends @p element. @return false, and nothing changes, when the list is full.
  [[nodiscard]] constexpr bool push_back(const Element& element) {
    if (full()) return false;
    elements_[size_++] = element;
    return true;
  }

  constexpr void clear() { size_ = 0; }

  /// @pre index < size()
  [[nodiscard]] constexpr const Element& operator[](std::size_t index) const {
    WHEELRAIL_ASSERT(index < size_);
    return elements_[index];
  }
  [[nodiscard]] constexpr Element& operator[](std::size_t index) {
    WHEELRAIL_ASSERT(index < size_);
    return elements_[index];
  }

  [[nodiscard]] constexpr const Element* begin() const { return elements_.data(); }
  [[nodiscard]] constexpr const Element* end() const { return elements_.data() + size_; }
  [[nodiscard]] constexpr Element* begin() { return elements_.data(); }
  [[nodiscard]] constexpr Element* end() { return elements_.data() + size_; }

 private:
  std::array<Element, Capacity> elements_{};
  std::size_t size_ = 0;
};

}  // namespace wheelrail
