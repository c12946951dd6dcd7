#include "tools/command_line/progress_bar.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

#include <unistd.h>

namespace puck {
namespace {

constexpr std::chrono::milliseconds kBarPeriod(100);
constexpr int kBarWidth = 30;

}  // namespace

ProgressBar::ProgressBar(std::string unit, double shown_per_count)
    : unit_(std::move(unit)),
      shown_per_count_(shown_per_count),
      is_terminal_(isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()) {
  next_ = start_ + kBarPeriod;
}

ProgressBar::~ProgressBar() {
  if (is_drawn_) std::fputs("\r\x1b[K", stderr);
}

void ProgressBar::show(std::int64_t count, std::optional<double> share) {
  if (!is_terminal_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;
  next_ = now + kBarPeriod;
  is_drawn_ = true;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double amount = static_cast<double>(count) * shown_per_count_;
  const int decimals = shown_per_count_ < 1 ? 1 : 0;
  char done[120];
  std::snprintf(done, sizeof done, "%.*f %s, %.1f %s/s", decimals, amount, unit_.c_str(),
                amount / seconds, unit_.c_str());
  if (!share) {
    std::fprintf(stderr, "\r\x1b[K%s", done);
    return;
  }
  const double fraction = std::clamp(*share, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(fraction * kBarWidth);
  const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
  std::fprintf(stderr, "\r\x1b[K[%s] %3.0f %%  %s, %.0f s left", bar.c_str(), 100 * fraction, done,
               fraction > 0.01 ? seconds * (1 - fraction) / fraction : 0.0);
}

}  // namespace puck
