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

/// Puts what was written on the disk, with fdatasync(2) on a thread of its own: it may take as long
/// as the disk likes, and the thread that writes must not wait for it, for what is still in its
/// queue is lost with the process. sync_file_range(2) would not wait either, but leaves the file's
/// new length and the disk's own cache behind, so that a loss of power could take everything.
class LogSync {
 public:
  using Clock = std::chrono::steady_clock;

  LogSync();
  /// Puts the rest on the disk.
  ~LogSync();
  LogSync(const LogSync&) = delete;
  LogSync& operator=(const LogSync&) = delete;

  /// What has been written into this file shall be on the disk soon. Safe from any thread.
  void request(const std::shared_ptr<OpenLog>& file);

  /// How long what was requested first has been waiting. Safe from any thread.
  Clock::duration lag() const;
  /// Why the newest attempt failed; empty: it did not. Safe from any thread.
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
