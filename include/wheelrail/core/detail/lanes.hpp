#pragma once
// Several numbers that go through the same formulas together, as Eigen's arrays: their expressions
// become vector instructions where there are any, and so do the short loops here. What a lane holds
// never depends on the others. Truth values of lanes are flags, one or zero: a product is `and`, max
// is `or`. May include: core, Eigen, std.

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <wheelrail/core/scalar.hpp>

namespace wheelrail::detail {

// Two vectors of the widest: while one waits for its result, the other is worked on.
inline constexpr int lane_count = 16;

template <Real T>
using Lanes = Eigen::Array<T, lane_count, 1>;

template <Real T>
[[nodiscard, gnu::always_inline]] inline Lanes<T> all_lanes(const T& x) {
  return Lanes<T>::Constant(x);
}

// A vector of T of the compiler's own, with comparisons and choices, as wide as the processor has it:
// left to itself the compiler unrolls short loops before it looks for vectors in them.
#if defined(__GNUC__)
template <Real T>
inline constexpr std::size_t vector_size =
    !(std::is_same_v<T, float> || std::is_same_v<T, double>)
        ? 0
        : std::min<std::size_t>(EIGEN_MAX_STATIC_ALIGN_BYTES, lane_count * sizeof(T));
template <class T, std::size_t Size>
struct VectorOf {
  using Type [[gnu::vector_size(Size)]] = T;
};
#else
template <Real T>
inline constexpr std::size_t vector_size = 0;
template <class T, std::size_t Size>
struct VectorOf;
#endif

// choice(one, other, then, otherwise, result) of each lane.
template <Real T, class Choice>
[[nodiscard, gnu::always_inline]] inline Lanes<T> choice_of(const Choice& choice,
                                                            const Lanes<T>& one,
                                                            const Lanes<T>& other,
                                                            const Lanes<T>& then,
                                                            const Lanes<T>& otherwise) {
  Lanes<T> result;
  if constexpr (0 < vector_size<T>) {
    constexpr int step = static_cast<int>(vector_size<T> / sizeof(T));
    for (int lane = 0; lane < lane_count; lane += step) {
      typename VectorOf<T, vector_size<T>>::Type a, b, c, d, chosen;
      std::memcpy(&a, one.data() + lane, sizeof(a));
      std::memcpy(&b, other.data() + lane, sizeof(b));
      std::memcpy(&c, then.data() + lane, sizeof(c));
      std::memcpy(&d, otherwise.data() + lane, sizeof(d));
      choice(a, b, c, d, chosen);
      std::memcpy(result.data() + lane, &chosen, sizeof(chosen));
    }
  } else {
    for (int lane = 0; lane < lane_count; ++lane) {
      choice(one[lane], other[lane], then[lane], otherwise[lane], result[lane]);
    }
  }
  return result;
}

// Flags of the lanes where one < other.
template <Real T>
[[nodiscard, gnu::always_inline]] inline Lanes<T> less(const Lanes<T>& one, const Lanes<T>& other) {
  return choice_of<T>([](const auto& a, const auto& b, const auto& c, const auto& d,
                         auto& chosen) { chosen = a < b ? c : d; },
                      one, other, all_lanes(T(1)), all_lanes(T(0)));
}

// Flags of the lanes where one == other.
template <Real T>
[[nodiscard, gnu::always_inline]] inline Lanes<T> equal(const Lanes<T>& one,
                                                        const Lanes<T>& other) {
  return choice_of<T>([](const auto& a, const auto& b, const auto& c, const auto& d,
                         auto& chosen) { chosen = a == b ? c : d; },
                      one, other, all_lanes(T(1)), all_lanes(T(0)));
}

template <Real T>
[[nodiscard, gnu::always_inline]] inline Lanes<T> finite(const Lanes<T>& x) {
  return equal<T>(x - x, all_lanes(T(0)));
}

template <Real T>
[[nodiscard, gnu::always_inline]] inline Lanes<T> choose(const Lanes<T>& flags,
                                                         const Lanes<T>& then,
                                                         const Lanes<T>& otherwise) {
  return choice_of<T>([](const auto& a, const auto& b, const auto& c, const auto& d,
                         auto& chosen) { chosen = a < b ? c : d; },
                      all_lanes(T(0)), flags, then, otherwise);
}

// A number of things that a lane counted. @pre 0 <= x <= 1000, which is whole
template <Real T>
[[nodiscard]] inline int count_of(const T& x) {
  if constexpr (std::is_floating_point_v<T>) {
    return static_cast<int>(x);
  } else {
    int count = 0;
    while (count < 1000 && T(count) < x) ++count;
    return count;
  }
}

// Whether there is a flag that is one; the others are zero without a sign. Without a branch for each
// lane, and bits are quicker put together than numbers.
template <Real T>
[[nodiscard, gnu::always_inline]] inline bool any(const Lanes<T>& flags) {
  if constexpr (0 < vector_size<T>) {
    using Bits =
        std::conditional_t<sizeof(T) == sizeof(std::uint64_t), std::uint64_t, std::uint32_t>;
    Bits bits[lane_count], all = 0;
    std::memcpy(bits, flags.data(), sizeof(bits));
    for (int lane = 0; lane < lane_count; ++lane) all |= bits[lane];
    return all != 0;
  } else {
    return T(0) < flags.maxCoeff();
  }
}

}  // namespace wheelrail::detail
