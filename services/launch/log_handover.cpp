#include "services/launch/log_handover.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>

namespace puck {
namespace {

// A line appears so much later at most.
constexpr std::chrono::milliseconds kPeriod{20};

}  // namespace

LogHandover::LogHandover(std::shared_ptr<spdlog::sinks::sink> writes)
    : writes_(std::move(writes)), lines_(kLines) {
  for (std::size_t i = 0; i < kLines; ++i) lines_[i].turn.store(i, std::memory_order_relaxed);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void LogHandover::log(const spdlog::details::log_msg& line) {
  std::uint64_t mine = next_.load(std::memory_order_relaxed);
  while (true) {
    const std::uint64_t turn = lines_[mine % kLines].turn.load(std::memory_order_acquire);
    if (turn < mine) {
      lost_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    if (turn > mine) {
      mine = next_.load(std::memory_order_relaxed);
    } else if (next_.compare_exchange_weak(mine, mine + 1, std::memory_order_relaxed)) {
      break;
    }
  }
  Line& place = lines_[mine % kLines];
  place.time = line.time;
  place.level = line.level;
  place.logger = {line.logger_name.data(), line.logger_name.size()};
  place.length = std::min(line.payload.size(), kLongest);
  std::copy_n(line.payload.data(), place.length, place.text.data());
  place.turn.store(mine + 1, std::memory_order_release);
}

void LogHandover::write_all() {
  while (true) {
    Line& line = lines_[next_to_write_ % kLines];
    if (line.turn.load(std::memory_order_acquire) != next_to_write_ + 1) break;
    writes_->log({line.time,
                  spdlog::source_loc{},
                  {line.logger.data(), line.logger.size()},
                  line.level,
                  {line.text.data(), line.length}});
    const std::string logger(line.logger);
    line.turn.store(next_to_write_ + kLines, std::memory_order_release);
    ++next_to_write_;
    const std::int64_t lost = lost_.load(std::memory_order_relaxed);
    if (lost == told_lost_) continue;
    const std::string text = std::to_string(lost - told_lost_) + " lines of the log were lost";
    told_lost_ = lost;
    writes_->log({spdlog::source_loc{}, logger, spdlog::level::warn, text});
  }
  writes_->flush();
}

void LogHandover::run(const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any stopped;
  while (!stop.stop_requested()) {
    std::unique_lock lock(mutex);
    stopped.wait_for(lock, stop, kPeriod, [] { return false; });
    write_all();
  }
  write_all();
}

}  // namespace puck
