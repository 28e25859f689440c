#pragma once
// A program that runs the paper's wheelset in another simulator, its host, and with wheelrail's own
// integrator, and compares the two. C++17.

#include <functional>
#include <string>
#include <vector>

#include "embedded_run.hpp"

namespace examples {

struct Host {
  std::string name;     // of the simulator
  std::string summary;  // for --help: what the program does, and its bound
  // The option that says how exactly the host computes: a step or a tolerance.
  std::string option, placeholder, default_value, help;
  double least, greatest;  // allowed values
  // It must go into 0.01 s a whole number of times, and there are three runs: with it, with a half
  // and with a quarter of it. Otherwise there is one.
  bool is_step;
  // The lateral shift may differ from that of the embedded run by this much at most, in 10 s [m].
  std::function<double(double setting)> bound;
  // The lateral shift [m] at `interval` 0, 1, 2, ... `count` [s]. Throws when the run fails.
  std::function<std::vector<double>(const WheelsetBody& wheelset, double interval, int count,
                                    double setting)>
      lateral_shifts;
};

// The whole of main().
// Exit code 0; 2 on bad input, 3 when a run failed or a difference is beyond its bound.
[[nodiscard]] int compare_with_embedded_run(int argc, char** argv, const Host& host);

}  // namespace examples
