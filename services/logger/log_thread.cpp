#include "services/logger/log_thread.h"

#include <condition_variable>
#include <mutex>
#include <utility>

namespace puck {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kIdle{500};
// Collects messages for one write: fifty writes a second instead of one for each message, and the
// most that a SIGKILL loses while the disk keeps up.
constexpr milliseconds kGather{20};

}  // namespace

LogThread::LogThread(std::size_t queue_bytes, Write write)
    : queue_(queue_bytes),
      write_(std::move(write)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void LogThread::finish() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

void LogThread::run(const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any never;
  while (!stop.stop_requested()) {
    queue_.wait(stop, kIdle);
    std::unique_lock lock(mutex);
    never.wait_for(lock, stop, kGather, [] { return false; });
    write_all();
  }
  write_all();
}

void LogThread::write_all() {
  for (auto records = queue_.front(); !records.empty(); records = queue_.front()) {
    queue_.release(write_(records));
  }
}

}  // namespace puck
