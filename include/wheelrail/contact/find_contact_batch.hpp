#pragma once
/// @file
/// The search of find_contact.hpp for many placements at once: in lanes that vector instructions work
/// on, and on several threads. May include: core, numerics, profile, surface, contact.

#include <algorithm>
#include <future>
#include <span>
#include <utility>
#include <vector>
#include <wheelrail/contact/detail/block_walk.hpp>
#include <wheelrail/contact/placement_batch.hpp>
#include <wheelrail/core/require.hpp>

namespace wheelrail {

namespace detail {

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
  std::vector<std::pair<T, std::size_t>> order;  // lateral position and index
  order.reserve(end - begin);
  for (std::size_t i = begin; i < end; ++i) {
    if (is_finite(options.penetration_threshold) && is_finite_placement(placements.at(i))) {
      order.emplace_back(placements.lateral_rail()[i], i);
    } else {
      results[i] = ContactResult<T>();
      results[i].status = SearchStatus::not_finite;
    }
  }
  std::sort(order.begin(), order.end(),
            [](const auto& one, const auto& other) { return one.first < other.first; });
  BlockWalk<P, R> walk(wheel, rail, placements, options);
  std::vector<std::size_t> block;
  block.reserve(walk.greatest_size);
  for (std::size_t first = 0; first < order.size(); first += walk.greatest_size) {
    const std::size_t last = std::min(order.size(), first + walk.greatest_size);
    block.clear();
    for (std::size_t i = first; i < last; ++i) block.push_back(order[i].second);
    walk.run(block, results);
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
  constexpr std::size_t block = detail::BlockWalk<P, R>::greatest_size;
  const std::size_t count = placements.size();
  const std::size_t shares =
      std::clamp((count + block - 1) / block, std::size_t{1}, static_cast<std::size_t>(threads));
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
