#pragma once
// One value for each body of a system and one for the ground, by index as `ground_body` has it.
// May include: core, dynamics, std.

#include <cstddef>
#include <wheelrail/core/assert.hpp>
#include <wheelrail/core/fixed_list.hpp>
#include <wheelrail/dynamics/body_motion.hpp>

namespace wheelrail::detail {

template <class Value, std::size_t MaximumBodies>
class BodyArray {
 public:
  // The ground's, and of_body(i) for each of @p count bodies. @pre count <= MaximumBodies
  template <class OfBody>
  BodyArray(const Value& ground, int count, const OfBody& of_body) {
    WHEELRAIL_ASSERT(0 <= count && static_cast<std::size_t>(count) <= MaximumBodies);
    static_cast<void>(values_.push_back(ground));
    for (int i = 0; i < count; ++i) {
      static_cast<void>(values_.push_back_made([&of_body, i] { return of_body(i); }));
    }
  }

  [[nodiscard]] Value& operator[](int body) { return values_[place(body)]; }
  [[nodiscard]] const Value& operator[](int body) const { return values_[place(body)]; }

 private:
  static_assert(ground_body == -1);
  static constexpr std::size_t place(int body) { return static_cast<std::size_t>(body + 1); }

  FixedList<Value, MaximumBodies + 1> values_;
};

}  // namespace wheelrail::detail
