#include "tests/bench/live/machine_wake.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace puck {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kTimes = 1'000;
// The interval of packets at 1 Mev/s.
constexpr std::chrono::microseconds kBetween{500};

}  // namespace

LatencySummary measure_machine_wake() {
  LatencyHistogram histogram;
  std::mutex mutex;
  std::condition_variable_any woken;
  bool is_called = false;
  Clock::time_point called;
  {
    const std::jthread sleeper([&](const std::stop_token& stop) {
      std::unique_lock lock(mutex);
      while (woken.wait(lock, stop, [&] { return is_called; })) {
        is_called = false;
        const auto took = Clock::now() - called;
        histogram.record(std::chrono::duration_cast<std::chrono::microseconds>(took).count());
      }
    });
    for (int i = 0; i < kTimes; ++i) {
      std::this_thread::sleep_for(kBetween);
      {
        const std::lock_guard lock(mutex);
        is_called = true;
        called = Clock::now();
      }
      woken.notify_one();
    }
  }
  return histogram.summary();
}

}  // namespace puck
