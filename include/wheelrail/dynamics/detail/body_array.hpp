#pragma once
// One value for each body of a system and one for the ground, by index as `ground_body` has it.
// May include: core, dynamics, std.

#include <array>
#include <cstddef>
#include <wheelrail/dynamics/body_motion.hpp>

namespace wheelrail::detail {

template <class Value, std::size_t MaximumBodies>
class BodyArray {
 public:
  BodyArray() = default;
  // All of them @p value: Eigen's matrices are not zero by themselves.
  explicit BodyArray(const Value& value) { values_.fill(value); }

  [[nodiscard]] Value& operator[](int body) { return values_[place(body)]; }
  [[nodiscard]] const Value& operator[](int body) const { return values_[place(body)]; }

 private:
  static_assert(ground_body == -1);
  static constexpr std::size_t place(int body) { return static_cast<std::size_t>(body + 1); }

  std::array<Value, MaximumBodies + 1> values_{};
};

}  // namespace wheelrail::detail
