#include "tools/demo_report/live_game.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <stop_token>

#include <unistd.h>

#include "common/messaging/bus.h"
#include "tools/command_line/flush_stdout.h"

namespace puck {
namespace {

std::string or_dash(const std::optional<std::int64_t>& value) {
  return value ? std::to_string(*value) : "-";
}

}  // namespace

void LiveGame::take(const ground_truth_t& truth) { truth_ = truth; }

void LiveGame::take(const service_status_t& status) {
  if (status.service != "puck-tracker") return;
  for (std::size_t i = 0; i < status.counter_name.size(); ++i) {
    if (status.counter_name[i] == "estimates") estimates_ = status.counter_value[i];
  }
  for (std::size_t i = 0; i < status.latency_name.size(); ++i) {
    if (status.latency_name[i] != "packet_to_estimate" || status.latency_samples[i] == 0) continue;
    latency_p50_us_ = status.latency_p50_us[i];
  }
}

std::string LiveGame::line(double elapsed_s) {
  std::optional<std::int64_t> rate;
  if (estimates_ && elapsed_s > line_before_s_) {
    rate = static_cast<std::int64_t>(static_cast<double>(*estimates_ - estimates_before_) /
                                     (elapsed_s - line_before_s_));
    estimates_before_ = *estimates_;
  }
  line_before_s_ = elapsed_s;
  std::optional<std::int64_t> shots;
  std::optional<std::int64_t> saves;
  if (truth_) {
    shots = truth_->shots;
    saves = truth_->saves;
  }
  char text[160];
  std::snprintf(text, sizeof text,
                "%4.0f s   shots %s   saves %s   %s estimates/s   median latency %s us", elapsed_s,
                or_dash(shots).c_str(), or_dash(saves).c_str(), or_dash(rate).c_str(),
                or_dash(latency_p50_us_).c_str());
  return text;
}

void watch_game(const std::string& url, int seconds) {
  using std::chrono::steady_clock;
  LiveGame game;
  Bus bus({.url = url});
  bus.subscribe<ground_truth_t>([&](const auto& truth, const Receipt&) { game.take(truth); });
  bus.subscribe<service_status_t>([&](const auto& status, const Receipt&) { game.take(status); });
  std::stop_source give_up;
  std::string reason;
  const bool started = bus.start(give_up.get_token(), [&](const std::string& waiting_for) {
    reason = waiting_for;
    give_up.request_stop();
  });
  if (!started) throw std::runtime_error(reason);

  const bool is_terminal = isatty(STDOUT_FILENO) == 1;
  const int step_s = is_terminal ? 1 : 5;
  const auto begin = steady_clock::now();
  for (int shown_s = 0; shown_s < seconds;) {
    shown_s = std::min(shown_s + step_s, seconds);
    const auto due = begin + std::chrono::seconds(shown_s);
    while (steady_clock::now() < due) bus.handle(std::chrono::milliseconds(20));
    std::printf(is_terminal ? "\r\033[K%s" : "%s\n", game.line(shown_s).c_str());
    flush_stdout();
  }
  if (is_terminal) std::printf("\n");
  flush_stdout();
}

}  // namespace puck
