#pragma once
/// @file
/// A list with a capacity known at compile time, so that results hold several patches without heap.
/// May include: core, std.

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <wheelrail/core/assert.hpp>

namespace wheelrail {

/// Up to @p Capacity elements in insertion order. Invariant: size() <= Capacity.
/// @note No allocation. What is not in the list is neither constructed nor copied: an empty list
///   costs nothing, however large its elements. A list moved from keeps its moved-from elements.
template <class Element, std::size_t Capacity>
class FixedList {
 public:
  constexpr FixedList() : size_(0) {}
  /// The same elements.
  constexpr FixedList(const FixedList& other) : FixedList() { append(other); }
  /// Moves the elements one by one.
  constexpr FixedList(FixedList&& other) noexcept(std::is_nothrow_move_constructible_v<Element>)
      : FixedList() {
    append(std::move(other));
  }
  /// The same elements.
  constexpr FixedList& operator=(const FixedList& other) { return assign(other); }
  /// Moves the elements one by one.
  constexpr FixedList& operator=(FixedList&& other) noexcept(
      std::is_nothrow_move_constructible_v<Element>) {
    return assign(std::move(other));
  }
  constexpr ~FixedList() { clear(); }

  [[nodiscard]] constexpr std::size_t size() const { return size_; }       ///< number of elements
  [[nodiscard]] constexpr bool empty() const { return size_ == 0; }        ///< size() == 0
  [[nodiscard]] constexpr bool full() const { return size_ == Capacity; }  ///< size() == Capacity
  [[nodiscard]] static constexpr std::size_t capacity() { return Capacity; }  ///< most elements

  /// Appends @p element. @return false, and nothing changes, when the list is full.
  [[nodiscard]] constexpr bool push_back(const Element& element) {
    if (full()) return false;
    construct_back(element);
    return true;
  }

  /// Appends what @p make() returns, made in its place and not copied.
  /// @return false, and nothing is made, when the list is full.
  template <class Make>
  [[nodiscard]] bool push_back_made(const Make& make) {
    if (full()) return false;
    ::new (static_cast<void*>(elements_ + size_)) Element(make());
    ++size_;
    return true;
  }

  /// Destroys all elements.
  constexpr void clear() {
    if constexpr (!std::is_trivially_destructible_v<Element>) std::destroy(begin(), end());
    size_ = 0;
  }

  /// @pre index < size()
  [[nodiscard]] constexpr const Element& operator[](std::size_t index) const {
    WHEELRAIL_ASSERT(index < size_);
    return elements_[index];
  }
  /// @pre index < size()
  [[nodiscard]] constexpr Element& operator[](std::size_t index) {
    WHEELRAIL_ASSERT(index < size_);
    return elements_[index];
  }

  [[nodiscard]] constexpr const Element* begin() const { return elements_; }  ///< the first one
  /// Behind the last one.
  [[nodiscard]] constexpr const Element* end() const { return elements_ + size_; }
  [[nodiscard]] constexpr Element* begin() { return elements_; }        ///< the first one
  [[nodiscard]] constexpr Element* end() { return elements_ + size_; }  ///< behind the last one

 private:
  template <class Source>
  constexpr void construct_back(Source&& element) {
    if constexpr (std::is_trivial_v<Element>) {
      elements_[size_] = element;  // may be done in a constant expression, too
    } else {
      std::construct_at(elements_ + size_, std::forward<Source>(element));
    }
    ++size_;
  }

  constexpr void append(const FixedList& other) {
    for (const Element& element : other) construct_back(element);
  }
  constexpr void append(FixedList&& other) {
    for (Element& element : other) construct_back(std::move(element));
  }

  template <class Source>
  constexpr FixedList& assign(Source&& other) {
    if (this == &other) return *this;
    clear();
    append(std::forward<Source>(other));
    return *this;
  }

  union {  // so that only the first size_ elements live
    Element elements_[Capacity];
  };
  std::size_t size_ = 0;
};

}  // namespace wheelrail
