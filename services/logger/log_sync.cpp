#include "services/logger/log_sync.h"

#include <algorithm>
#include <utility>

namespace puck {
namespace {

// The first byte waits this long, so that not every message causes a sync; the sync has the rest of
// the second.
constexpr std::chrono::milliseconds kPause{300};

}  // namespace

LogSync::LogSync() : thread_([this](const std::stop_token& stop) { run(stop); }) {}

LogSync::~LogSync() {
  thread_.request_stop();
  thread_.join();
}

void LogSync::request(const std::shared_ptr<OpenLog>& file) {
  const std::lock_guard lock(mutex_);
  const bool known = std::any_of(waiting_.begin(), waiting_.end(),
                                 [&](const Request& request) { return request.file == file; });
  if (known) return;
  waiting_.push_back({file, Clock::now()});
  changed_.notify_one();
}

LogSync::Clock::duration LogSync::lag() const {
  const std::lock_guard lock(mutex_);
  const std::vector<Request>& oldest = under_way_.empty() ? waiting_ : under_way_;
  return oldest.empty() ? Clock::duration{} : Clock::now() - oldest.front().since;
}

std::string LogSync::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

void LogSync::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return !waiting_.empty(); })) {
    changed_.wait_for(lock, stop, kPause, [] { return false; });
    under_way_ = std::exchange(waiting_, {});
    const std::vector<Request> requests = under_way_;
    lock.unlock();
    put_on_disk(requests);
    lock.lock();
    under_way_.clear();
  }
}

void LogSync::put_on_disk(const std::vector<Request>& requests) {
  std::string problem;
  for (const Request& request : requests) {
    try {
      request.file->put_on_disk();
    } catch (const LogFileError& error) {
      problem = error.what();
    }
  }
  const std::lock_guard lock(mutex_);
  problem_ = problem;
}

}  // namespace puck
