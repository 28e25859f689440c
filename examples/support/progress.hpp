#pragma once
// How far a number of jobs has come: a bar with the remaining time on a terminal, a line for every
// tenth in a log.

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <string>
#include <vector>

namespace examples {

// "48 s", "2 min 05 s".
[[nodiscard]] inline std::string duration_text(double seconds) {
  const int whole = static_cast<int>(std::max(0.0, seconds) + 0.5);
  char text[40];
  if (whole < 60) {
    std::snprintf(text, sizeof text, "%d s", whole);
  } else {
    std::snprintf(text, sizeof text, "%d min %02d s", whole / 60, whole % 60);
  }
  return text;
}

// "[#####...............]  25 %, 2 min 05 s left": the rest takes as long as what is done did, each
// part by its weight. Unknown until something is done.
[[nodiscard]] inline std::string progress_text(double share, double elapsed_seconds) {
  constexpr int width = 20;
  const double done = std::clamp(share, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(width * done);
  std::string text = "[";
  text.append(filled, '#').append(width - filled, '.').append("]");
  char percent[16];
  std::snprintf(percent, sizeof percent, " %3d %%", static_cast<int>(100 * done));
  text += percent;
  if (done >= 1) return text + ", " + duration_text(elapsed_seconds) + " in all";
  if (done > 0.01) text += ", " + duration_text(elapsed_seconds * (1 - done) / done) + " left";
  return text;
}

// What redraws a line of a terminal of 80 columns; what is too long for it is cut.
[[nodiscard]] inline std::string bar_text(const std::string& line) {
  return std::string("\r").append(line, 0, 79).append("\033[K");
}

// May be told of from several threads.
class Progress {
 public:
  // The weights of the jobs: how long each takes, in any unit; the sum must be > 0.
  explicit Progress(std::vector<double> weights)
      : weights_(std::move(weights)), shares_(weights_.size(), 1.0) {
    total_ = sum_of_shares();
    shares_.assign(weights_.size(), 0.0);
  }

  // Job `job` has come to `share` of itself.
  void report(std::size_t job, double share, const std::string& name) {
    const std::lock_guard lock(mutex_);
    shares_[job] = share;
    const double all = sum_of_shares() / total_;
    const int percent = static_cast<int>(100 * all);
    const int step = terminal_ ? percent : percent / 10;
    if (step == shown_) return;
    shown_ = step;
    const double elapsed =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    const std::string line = progress_text(all, elapsed) + ": " + name;
    std::fputs(terminal_ ? bar_text(line).c_str() : (line + "\n").c_str(), stderr);
    std::fflush(stderr);
  }

  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  // Ends the bar's line.
  ~Progress() {
    if (terminal_ && shown_ >= 0) std::fputs("\n", stderr);
  }

 private:
  // Exactly total_ when all are done.
  [[nodiscard]] double sum_of_shares() const {
    double sum = 0;
    for (std::size_t i = 0; i < weights_.size(); ++i) sum += weights_[i] * shares_[i];
    return sum;
  }

  std::vector<double> weights_, shares_;
  double total_ = 0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  bool terminal_ = isatty(STDERR_FILENO) != 0;
  int shown_ = -1;
  std::mutex mutex_;
};

}  // namespace examples
