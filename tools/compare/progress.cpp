#include "tools/compare/progress.h"

#include <cmath>
#include <cstdio>

namespace puck {
namespace {

std::string clock_text(double seconds) {
  const auto whole = static_cast<long>(std::lround(seconds));
  char text[32];
  std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  return text;
}

}  // namespace

Progress::Progress(int steps, double cost) : steps_(steps), cost_left_(cost) {}

void Progress::skip(double cost) {
  const std::scoped_lock lock(mutex_);
  ++steps_done_;
  cost_left_ -= cost;
}

void Progress::finish(double cost, const std::string& what) {
  const std::scoped_lock lock(mutex_);
  ++steps_done_;
  cost_left_ -= cost;
  cost_done_ += cost;
  const double elapsed_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  const double left_s = elapsed_s * std::fmax(cost_left_, 0) / cost_done_;
  std::printf("[%*d/%d, %s, about %s left] %s\n", steps_ < 100 ? 2 : 3, steps_done_, steps_,
              clock_text(elapsed_s).c_str(), clock_text(left_s).c_str(), what.c_str());
  std::fflush(stdout);
}

}  // namespace puck
