#pragma once
/// @file
/// The search of find_contact.hpp for many placements at once: in lanes that vector instructions work
/// on, and on several threads. May include: core, numerics, profile, surface, contact.

#include <algorithm>
#include <future>
#include <span>
#include <vector>
#include <wheelrail/contact/detail/block_walk.hpp>
#include <wheelrail/contact/placement_batch.hpp>
#include <wheelrail/core/require.hpp>

namespace wheelrail {

namespace detail {

// `indices` nearly in the order of their keys: by the class that a key falls into, among as many of
// equal width between `least` and `greatest` as there are indices. Those beyond are of the outer ones.
// Scalars that convert to nothing stay in the order in which they are.
template <Real T>
[[nodiscard]] std::vector<std::size_t> nearly_sorted(const std::vector<std::size_t>& indices,
                                                     const std::vector<T>& keys, const T& least,
                                                     const T& greatest) {
  if constexpr (std::is_floating_point_v<T>) {
    const std::size_t count = indices.size();
    const T classes = T(static_cast<int>(count)), per_key = classes / (greatest - least);
    std::vector<std::size_t> class_of(count), begin(count + 1, 0), sorted(count);
    for (std::size_t i = 0; i < count; ++i) {
      const T place = clamp(T((keys[indices[i]] - least) * per_key), T(0), classes);
      class_of[i] =
          std::min(count - 1, static_cast<std::size_t>(static_cast<std::ptrdiff_t>(place)));
      ++begin[class_of[i] + 1];
    }
    for (std::size_t i = 1; i <= count; ++i) begin[i] += begin[i - 1];
    for (std::size_t i = 0; i < count; ++i) sorted[begin[class_of[i]]++] = indices[i];
    return sorted;
  } else {
    return indices;
  }
}

// Searches the placements from `begin` to `end`, block by block; results[i] becomes that of placement
// i. Neighbours across the track go into one block's lanes: they leave out the same of the wheel.
template <Profile P, Profile R>
void find_contacts_between(const Wheel<P>& wheel, const Rail<R>& rail,
                           const PlacementBatch<typename P::Scalar>& placements, std::size_t begin,
                           std::size_t end, std::span<ContactResult<typename P::Scalar>> results,
                           const SearchOptions<typename P::Scalar>& options) {
  using T = typename P::Scalar;
  if (T(0) < options.blending_length) {  // the lanes know one patch for each zone
    for (std::size_t i = begin; i < end; ++i) {
      results[i] = find_contact(wheel, rail, placements.at(i), options);
    }
    return;
  }
  std::vector<std::size_t> searched;
  searched.reserve(end - begin);
  for (std::size_t i = begin; i < end; ++i) {
    if (is_finite(options.penetration_threshold) && is_finite_placement(placements.at(i))) {
      searched.push_back(i);
    } else {
      results[i] = ContactResult<T>();
      results[i].status = SearchStatus::not_finite;
    }
  }
  // Where wheel and rail are over each other.
  const T least = rail.profile().lower() - wheel.profile().upper();
  const T greatest = rail.profile().upper() - wheel.profile().lower();
  const auto order = nearly_sorted(searched, placements.lateral_rail(), least, greatest);
  BlockWalk<P, R> walk(wheel, rail, placements, options);
  for (std::size_t first = 0; first < order.size(); first += walk.greatest_size) {
    const std::size_t size = std::min(order.size() - first, walk.greatest_size);
    walk.run(std::span(order).subspan(first, size), results);
  }
}

}  // namespace detail

/// All patches between @p wheel and @p rail at each of many placements, as `find_contact` finds them
/// at one: the same patches with the same status and is_proved, in numbers that differ by rounding
/// at most where the compiler fuses products and sums in another way (penetration by less than 16
/// epsilon nominal radii). What is found at a placement depends neither on the others, nor on their
/// order, nor on @p threads.
/// @param threads that share the work, the calling one among them.
/// @param results whose memory is used again: pass those of a call before by std::move.
/// @return that of placement i at i.
/// @throws std::invalid_argument unless threads >= 1; std::bad_alloc or std::system_error where a
///   thread or its memory is not to be had.
/// @note Allocates some memory for each thread, and for the results; not for each placement.
template <Profile P, Profile R>
[[nodiscard]] std::vector<ContactResult<typename P::Scalar>> find_contacts(
    const Wheel<P>& wheel, const Rail<R>& rail,
    const PlacementBatch<typename P::Scalar>& placements,
    const SearchOptions<typename P::Scalar>& options = {}, int threads = 1,
    std::vector<ContactResult<typename P::Scalar>> results = {}) {
  detail::require(1 <= threads, "find_contacts: there must be at least one thread");
  results.resize(placements.size());
  constexpr std::size_t least_share = 256;  // fewer are searched sooner than a thread starts
  const std::size_t count = placements.size();
  const std::size_t shares = std::clamp((count + least_share - 1) / least_share, std::size_t{1},
                                        static_cast<std::size_t>(threads));
  const auto search_share = [&](std::size_t share) {
    detail::find_contacts_between(wheel, rail, placements, count * share / shares,
                                  count * (share + 1) / shares, results, options);
  };
  std::vector<std::future<void>> others;  // whose ends are waited for here, whatever happens
  others.reserve(shares - 1);
  for (std::size_t share = 1; share < shares; ++share) {
    others.push_back(std::async(std::launch::async, search_share, share));
  }
  search_share(0);
  for (std::future<void>& other : others) other.get();  // throws what its thread threw
  return results;
}

}  // namespace wheelrail
