#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "common/messaging/log_file.h"

namespace puck {

/// Syncs written data to the disk with fdatasync(2) on its own thread. A sync may take long, and
/// the writer thread must not wait for it, since its queue is lost with the process.
/// sync_file_range(2) would not block, but does not sync the file's new length or the disk's cache,
/// so that a loss of power could lose everything.
class LogSync {
 public:
  using Clock = std::chrono::steady_clock;

  LogSync();
  /// Syncs the remaining data.
  ~LogSync();
  LogSync(const LogSync&) = delete;
  LogSync& operator=(const LogSync&) = delete;

  /// Requests a sync of all data written to this file. Safe from any thread.
  void request(const std::shared_ptr<OpenLog>& file);

  /// Age of the oldest unfinished request. Safe from any thread.
  Clock::duration lag() const;
  /// Reason why the newest sync failed; empty: it did not. Safe from any thread.
  std::string problem() const;

 private:
  struct Request {
    std::shared_ptr<OpenLog> file;
    Clock::time_point since;
  };

  void run(const std::stop_token& stop);
  void put_on_disk(const std::vector<Request>& requests);

  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::vector<Request> waiting_;  // Guarded by mutex_, as are the next two.
  std::vector<Request> under_way_;
  std::string problem_;
  std::jthread thread_;  // Last, so that it ends before what it uses.
};

}  // namespace puck
