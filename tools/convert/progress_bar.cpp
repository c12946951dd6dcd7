#include "tools/convert/progress_bar.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include <unistd.h>

namespace puck {
namespace {

constexpr std::chrono::milliseconds kBarPeriod(100);
constexpr int kBarWidth = 30;

}  // namespace

ProgressBar::ProgressBar()
    : is_terminal_(isatty(STDERR_FILENO) == 1), start_(std::chrono::steady_clock::now()) {
  next_ = start_ + kBarPeriod;
}

ProgressBar::~ProgressBar() {
  if (is_drawn_) std::fputs("\r\x1b[K", stderr);
}

void ProgressBar::show(std::int64_t events, std::optional<double> share) {
  if (!is_terminal_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;
  next_ = now + kBarPeriod;
  is_drawn_ = true;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double million = static_cast<double>(events) * 1e-6;
  if (!share) {
    std::fprintf(stderr, "\r\x1b[K%.1f Mev, %.1f Mev/s", million, million / seconds);
    return;
  }
  const double done = std::clamp(*share, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(done * kBarWidth);
  const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
  std::fprintf(stderr, "\r\x1b[K[%s] %3.0f %%  %.1f Mev, %.1f Mev/s, %.0f s left", bar.c_str(),
               100 * done, million, million / seconds,
               done > 0.01 ? seconds * (1 - done) / done : 0.0);
}

}  // namespace puck
