#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "common/io/event_reader.h"
#include "tools/view/interface/view_state.h"

namespace puck {

/// Counts a recording's events over time, on a thread of its own. The bins double their width
/// whenever there would be too many, so that any length fits. Functions are safe from any thread.
class RateScan {
 public:
  static constexpr std::size_t kMostBins = 2000;

  explicit RateScan(std::unique_ptr<EventReader> events);

  /// Fills all but losses and examined parts.
  void fill(ViewTimeline& timeline) const;
  /// Faults of the file, once it has been read to its end; before, none.
  std::vector<std::string> warnings() const;

 private:
  void run(const std::stop_token& stop);
  void count(const EventPacket& packet);

  std::unique_ptr<EventReader> events_;  // The thread's.
  mutable std::mutex mutex_;
  ViewTimeline found_;                 // Guarded by mutex_.
  std::vector<std::string> warnings_;  // Guarded by mutex_.
  std::jthread thread_;                // Last member: uses the others.
};

}  // namespace puck
