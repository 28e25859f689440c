#pragma once
// Times of several ways to do the same, relative to the first, within one run: a table in Markdown.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace wheelrail_bench {

// The sum of evaluations over all poses.
template <class Poses, class Search>
[[nodiscard]] long sum_over(const Poses& poses, const Search& search) {
  long evaluations = 0;
  for (const auto& pose : poses) {
    const auto found = search(pose);
    benchmark::DoNotOptimize(found.patches.begin());
    evaluations += found.evaluations;
  }
  return evaluations;
}

[[nodiscard]] inline double nanoseconds_of(const std::function<void()>& body) {
  const auto begin = std::chrono::steady_clock::now();
  body();
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
}

// The least of many tries of one call.
template <class Body>
[[nodiscard]] double least_nanoseconds(const Body& body) {
  constexpr int calls = 8;
  double least = 1e300;
  for (int i = 0; i < 20; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    for (int k = 0; k < calls; ++k) body();
    const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - begin;
    least = std::min(least, taken.count() / calls);
  }
  return least;
}

struct Contender {
  std::string name;
  std::function<long()> run;  // over all poses; returns the evaluations
};

// All contenders take turns; the medians of their times relative to the first one's in that turn.
inline void print_ratio_table(const std::string& title, const std::vector<Contender>& contenders,
                              std::size_t poses) {
  constexpr std::size_t rounds = 31;
  std::vector<std::vector<double>> ratios(contenders.size());
  std::vector<double> least(contenders.size(), 1e300);
  std::vector<long> evaluations(contenders.size());
  for (std::size_t round = 0; round <= rounds; ++round) {
    double first = 0;
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      const double taken = nanoseconds_of([&] { evaluations[i] = contenders[i].run(); });
      if (i == 0) first = taken;
      if (round == 0) continue;  // warms up
      ratios[i].push_back(taken / first);
      least[i] = std::min(least[i], taken);
    }
  }
  std::printf("| %s | time | evaluations | least time [us] |\n|---|---|---|---|\n", title.c_str());
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    std::sort(ratios[i].begin(), ratios[i].end());
    std::printf("| %s | %.2f | %.1f | %.2f |\n", contenders[i].name.c_str(), ratios[i][rounds / 2],
                static_cast<double>(evaluations[i]) / static_cast<double>(poses),
                least[i] / static_cast<double>(poses) / 1000);
  }
  std::printf("\n");
}

}  // namespace wheelrail_bench
