// The contact searches on the same poses, checked against each other before anything is timed.
//
//   cmake -B build/bench -DCMAKE_BUILD_TYPE=Release -DWHEELRAIL_BUILD_BENCHMARKS=ON
//   cmake --build build/bench --target contact_bench
//   build/bench/bench/contact_bench --ratios   # the README's table
//   build/bench/bench/contact_bench            # all benchmarks

#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "contact_poses.hpp"
#include "ratio_table.hpp"
#include "support/allocation_counter.hpp"

namespace {

using namespace wheelrail;
using namespace wheelrail_bench;

// Runs search(pose) over poses; counters per search.
template <class Poses, class Search>
void run(benchmark::State& state, const Poses& poses, Search&& search) {
  long evaluations = 0, failures = 0, searches = 0, patches = 0;
  const long allocations = wheelrail_test::allocations_so_far();
  for (auto _ : state) {
    for (const auto& pose : poses) {
      const auto found = search(pose);
      benchmark::DoNotOptimize(found.patches.begin());
      evaluations += found.evaluations;
      patches += static_cast<long>(found.patches.size());
      failures += found.status != SearchStatus::complete;
    }
    searches += static_cast<long>(poses.size());
  }
  const auto per_search = [&](long count) {
    return static_cast<double>(count) / static_cast<double>(searches);
  };
  state.SetItemsProcessed(searches);
  state.counters["evaluations"] = per_search(evaluations);
  state.counters["patches"] = per_search(patches);
  state.counters["failures"] = static_cast<double>(failures);
  state.counters["allocations"] =
      static_cast<double>(wheelrail_test::allocations_so_far() - allocations);
}

// Also the median and the 99th percentile over single poses, each the least of many tries.
template <class Poses, class Search>
void run_percentiles(benchmark::State& state, const Poses& poses, Search&& search) {
  run(state, poses, search);
  std::vector<double> times;
  for (const auto& pose : poses)
    times.push_back(
        least_nanoseconds([&] { benchmark::DoNotOptimize(search(pose).patches.begin()); }));
  std::sort(times.begin(), times.end());
  state.counters["p50_ns"] = times[times.size() / 2];
  state.counters["p99_ns"] = times[times.size() * 99 / 100];
}

// Searches a batch into results that are used again; counters per search.
template <class W, class R, class T>
void run_batch(benchmark::State& state, const W& wheel, const R& rail,
               const PlacementBatch<T>& batch, int threads) {
  std::vector<ContactResult<T>> results(batch.size());
  long searches = 0;
  const long allocations = wheelrail_test::allocations_so_far();
  for (auto _ : state) {
    results = find_contacts(wheel, rail, batch, {}, threads, std::move(results));
    benchmark::DoNotOptimize(results.data());
    searches += static_cast<long>(batch.size());
  }
  const auto per_search = [&](long count) {
    return static_cast<double>(count) / static_cast<double>(searches);
  };
  long evaluations = 0, patches = 0, failures = 0;
  for (const auto& result : results) {
    evaluations += result.evaluations;
    patches += static_cast<long>(result.patches.size());
    failures += result.status != SearchStatus::complete;
  }
  const auto per_result = [&](long count) {
    return static_cast<double>(count) / static_cast<double>(results.size());
  };
  state.SetItemsProcessed(searches);
  state.counters["evaluations"] = per_result(evaluations);
  state.counters["patches"] = per_result(patches);
  state.counters["failures"] = static_cast<double>(failures);
  state.counters["allocations_per_search"] =
      per_search(wheelrail_test::allocations_so_far() - allocations);
}

template <class Body>
void add(const std::string& name, Body body) {
  benchmark::RegisterBenchmark(name.c_str(), body);
}

void add_searches(const Setting& s) {
  const auto& rail = s.rail();
  add("cold/minimum_distance/convex", [&](auto& state) {
    run_percentiles(state, s.poses, [&](const auto& pose) {
      return find_contact_by_minimum_distance(s.convex, rail, pose, s.parts);
    });
  });
  add("cold/strips/convex", [&](auto& state) {
    run_percentiles(state, s.poses,
                    [&](const auto& pose) { return find_contact(s.convex, rail, pose); });
  });
  add("cold/strips/s1002", [&](auto& state) {
    run_percentiles(state, s.poses,
                    [&](const auto& pose) { return find_contact(s.real, rail, pose); });
  });
  add("cold/strips/s1002_without_zone_ends", [&](auto& state) {
    run_percentiles(state, s.poses, [&](const auto& pose) {
      return find_contact(s.real, rail, pose, {.zone_ends = false});
    });
  });
  add("cold/strips/spline_of_s1002", [&](auto& state) {
    run_percentiles(state, s.poses,
                    [&](const auto& pose) { return find_contact(s.spline, rail, pose); });
  });
  add("cold/strips/s1002_float", [&](auto& state) {
    run_percentiles(state, s.float_poses, [&](const auto& pose) {
      return find_contact(s.float_wheel, s.float_rail, pose);
    });
  });
  add("path/minimum_distance/convex_cold", [&](auto& state) {
    run(state, s.path, [&](const auto& pose) {
      return find_contact_by_minimum_distance(s.convex, rail, pose, s.parts);
    });
  });
  add("path/minimum_distance/convex_warm", [&](auto& state) {
    MinimumDistanceMemory<double> memory;
    run(state, s.path, [&](const auto& pose) {
      return find_contact_by_minimum_distance(s.convex, rail, pose, s.parts, memory);
    });
  });
  add("path/strips/s1002_cold", [&](auto& state) {
    run(state, s.path, [&](const auto& pose) { return find_contact(s.real, rail, pose); });
  });
  add("path/strips/s1002_warm", [&](auto& state) {
    SearchMemory<double> memory(s.real);
    run(state, s.path, [&](const auto& pose) { return find_contact(s.real, rail, pose, memory); });
  });
  for (const auto& [count, with_count] : s.by_patches) {
    add("patches/" + std::to_string(count), [&rail, &s, &poses = with_count](auto& state) {
      run(state, poses, [&](const auto& pose) { return find_contact(s.real, rail, pose); });
    });
  }
  for (const auto& [yaw, with_yaw] : s.by_yaw) {
    add("yaw_mrad/" + std::to_string(yaw), [&rail, &s, &poses = with_yaw](auto& state) {
      run(state, poses, [&](const auto& pose) { return find_contact(s.real, rail, pose); });
    });
  }
}

void add_batches(const Setting& s) {
  const auto& rail = s.rail();
  add("batch/one_by_one", [&](auto& state) {
    run(state, s.many, [&](const auto& pose) { return find_contact(s.real, rail, pose); });
  });
  add("batch/one_by_one_float", [&](auto& state) {
    run(state, s.float_many,
        [&](const auto& pose) { return find_contact(s.float_wheel, s.float_rail, pose); });
  });
  for (const int threads : {1, 2}) {
    const std::string name = "batch/threads_" + std::to_string(threads);
    // By the clock on the wall: the calling thread's own time says nothing of the others.
    benchmark::RegisterBenchmark(name.c_str(), [&s, &rail, threads](auto& state) {
      run_batch(state, s.real, rail, s.batch, threads);
    })->UseRealTime();
    benchmark::RegisterBenchmark((name + "_float").c_str(), [&s, threads](auto& state) {
      run_batch(state, s.float_wheel, s.float_rail, s.float_batch, threads);
    })->UseRealTime();
  }
}

// What a search and a force are made of, on the strips and patches of the same poses.
void add_stages(const Setting& s) {
  const auto each = [](benchmark::State& state, const auto& items, auto&& body) {
    for (auto _ : state) {
      for (const auto& item : items) benchmark::DoNotOptimize(body(item));
    }
    state.SetItemsProcessed(state.iterations() * static_cast<long>(items.size()));
  };
  const auto& rail = s.rail();
  add("stage/locus", [&s, each](auto& state) {
    each(state, s.strips,
         [&](const auto& at) { return locus_point(s.real, *at.placement, at.lateral, at.point); });
  });
  add("stage/rail_solve", [&s, &rail, each](auto& state) {
    each(state, s.loci,
         [&](const auto& at) { return rail_foot(rail.profile(), at.lateral, at.up); });
  });
  add("stage/refinement", [&s, &rail, each](auto& state) {
    // One step of Newton's method for a deepest point: a strip with its derivatives.
    each(state, s.strips, [&](const auto& at) {
      return detail::LocusStrips(s.real, rail, *at.placement).at(at.piece, at.lateral);
    });
  });
  add("stage/hertz", [&s, each](auto& state) {
    each(state, s.contacts, [&](const auto& at) { return hertz_shape(at.curvatures); });
  });
  add("stage/polach", [&s, each](auto& state) {
    each(state, s.creep, [&](const auto& at) { return polach_force(at.creepage, at.contact); });
  });
  add("stage/contact_force", [&s, each](auto& state) {
    const ContactForceModel<double> model;
    each(state, s.contacts, [&](const auto& at) { return model(at); });
  });
}

void print_ratios(const Setting& s) {
  const auto& rail = s.rail();
  MinimumDistanceMemory<double> distance_memory;
  SearchMemory<double> memory(s.real), brief_memory(s.real);
  const auto over = [](const auto& poses, auto search) {
    return [&poses, search] { return sum_over(poses, search); };
  };
  const SearchOptions<double> brief{.zone_ends = false};
  print_ratio_table(
      "single poses, cold",
      {{"minimum distance, convex", over(s.poses,
                                         [&](const auto& pose) {
                                           return find_contact_by_minimum_distance(s.convex, rail,
                                                                                   pose, s.parts);
                                         })},
       {"strips, convex",
        over(s.poses, [&](const auto& pose) { return find_contact(s.convex, rail, pose); })},
       {"strips, S1002",
        over(s.poses, [&](const auto& pose) { return find_contact(s.real, rail, pose); })},
       {"strips, S1002, without zone ends",
        over(s.poses, [&](const auto& pose) { return find_contact(s.real, rail, pose, brief); })}},
      s.poses.size());
  print_ratio_table(
      "a hunting motion, step by step",
      {{"minimum distance, convex, cold", over(s.path,
                                               [&](const auto& pose) {
                                                 return find_contact_by_minimum_distance(
                                                     s.convex, rail, pose, s.parts);
                                               })},
       {"minimum distance, convex, warm", over(s.path,
                                               [&](const auto& pose) {
                                                 return find_contact_by_minimum_distance(
                                                     s.convex, rail, pose, s.parts,
                                                     distance_memory);
                                               })},
       {"strips, S1002, cold",
        over(s.path, [&](const auto& pose) { return find_contact(s.real, rail, pose); })},
       {"strips, S1002, warm",
        over(s.path, [&](const auto& pose) { return find_contact(s.real, rail, pose, memory); })},
       {"strips, S1002, cold, without zone ends",
        over(s.path, [&](const auto& pose) { return find_contact(s.real, rail, pose, brief); })},
       {"strips, S1002, warm, without zone ends", over(s.path,
                                                       [&](const auto& pose) {
                                                         return find_contact(s.real, rail, pose,
                                                                             brief_memory, brief);
                                                       })}},
      s.path.size());
  const auto print_batches = [&](const char* title, const auto& wheel, const auto& on,
                                 const auto& poses, const auto& batch) {
    using Results = std::vector<decltype(find_contact(wheel, on, poses[0]))>;
    Results results(poses.size());
    const auto evaluations = [&] {
      long sum = 0;
      for (const auto& result : results) sum += result.evaluations;
      return sum;
    };
    const auto one_by_one = [&] {
      for (std::size_t i = 0; i < poses.size(); ++i) results[i] = find_contact(wheel, on, poses[i]);
      return evaluations();
    };
    const auto together = [&](int threads) {
      return [&, threads] {
        results = find_contacts(wheel, on, batch, {}, threads, std::move(results));
        return evaluations();
      };
    };
    print_ratio_table(title,
                      {{"strips, S1002, one by one, cold", one_by_one},
                       {"strips, S1002, batch", together(1)},
                       {"strips, S1002, batch on two threads", together(2)}},
                      poses.size());
  };
  print_batches("many poses", s.real, rail, s.many, s.batch);
  print_batches("many poses, float", s.float_wheel, s.float_rail, s.float_many, s.float_batch);
}

}  // namespace

int main(int argc, char** argv) {
  const Setting setting;
  if (const char* fault = setting.fault()) {
    std::fprintf(stderr, "contact_bench: %s: nothing is timed\n", fault);
    return 1;
  }
  if (argc == 2 && std::strcmp(argv[1], "--ratios") == 0) {
    print_ratios(setting);
    return 0;
  }
  add_searches(setting);
  add_batches(setting);
  add_stages(setting);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
