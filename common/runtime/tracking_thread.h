#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "common/runtime/search_worker.h"
#include "common/runtime/shared_surface.h"
#include "common/vision/interfaces/tracking_pipeline.h"
#include "common/vision/paper/puck_search.h"

namespace puck {

struct TrackingThreadParams {
  /// Highest rate of evenly spaced estimates; a change of state is published at once. Key
  /// tracker.max_publish_hz.
  int max_publish_hz = 5000;
  /// Longest time between two estimates, also without changes, so that silence means a fault.
  std::chrono::microseconds heartbeat{20'000};
  /// The event thread makes steps only while the last one took no longer than this, and takes
  /// single events for no longer, because the surface is not updated meanwhile. A step takes some
  /// 10 µs, one in a hundred 50 µs; waking the other thread takes 20 to 40 µs.
  std::chrono::microseconds longest_on_event_thread{100};
};

/// Shortest time between two estimates. Throws std::invalid_argument, naming the key, when a
/// parameter is out of range.
std::chrono::microseconds publish_period(const TrackingThreadParams& params);

/// An estimate and the times of its chain.
struct TrackedEstimate {
  PuckEstimate estimate;
  PacketOrigin origin;
  std::chrono::system_clock::time_point tracking_started;
  /// From the receipt of the newest packet to the first snapshot that contains some of it.
  std::chrono::steady_clock::duration packet_to_look{};
  std::int64_t backlog_us = 0;
  std::int64_t backlog_events = 0;
  /// At publication: time since the newest packet, also if it had no events in the tracked region.
  std::chrono::steady_clock::duration input_age{};
};

/// The paper's second thread (Figure 2): detects or tracks on the newest surface as fast as it can
/// while there are new events in its region, else sleeps. While no other packet waits, the event
/// thread makes the step itself, which is faster than waking this thread; this thread makes the
/// steps under load, slow steps and steps without a track, the searches, and what is due by time. A
/// pipeline that takes single events gets those that a snapshot contains before the snapshot.
/// Searches run on a low-priority thread; nothing waits for them.
class TrackingThread {
 public:
  using Publish = std::function<void(const TrackedEstimate&)>;

  /// Starts the thread. `publish` is called on it or in look_now(), one call at a time, and must
  /// not throw. `surface` must outlive this object.
  TrackingThread(SharedSurface& surface, std::unique_ptr<TrackingPipeline> pipeline,
                 PuckSearch search, const TrackingThreadParams& params, Publish publish);
  /// Stops the thread and waits for it.
  ~TrackingThread();
  TrackingThread(const TrackingThread&) = delete;
  TrackingThread& operator=(const TrackingThread&) = delete;

  /// Event thread only, after an update of the surface without `wakes`. Makes the due step on the
  /// caller's thread, or leaves it to the tracking thread if that is making one, the last one was
  /// slow, or there is no track. Never blocks, never searches.
  void look_now();

 private:
  using Clock = std::chrono::steady_clock;

  /// Time without work.
  struct Pause {
    std::chrono::microseconds longest{};
    bool ends_with_news = true;
  };

  void run(const std::stop_token& stop);
  void run_due_tasks();
  Pause next_pause() const;
  void take_search_result();
  bool is_for_event_thread() const;
  void make_step(std::chrono::microseconds longest_take);
  void look(std::chrono::microseconds longest_take);
  bool take_events(std::chrono::microseconds longest_take);
  void begin_search_if_wanted();
  void publish_if_due();

  SharedSurface& surface_;
  // Held during a step by the stepping thread. Guards all members below except the thread.
  std::mutex step_mutex_;
  std::unique_ptr<TrackingPipeline> pipeline_;
  SearchWorker worker_;
  TrackingThreadParams params_;
  std::chrono::microseconds publish_period_{};
  Publish publish_;

  SharedSnapshot snapshot_;
  std::vector<Event> events_;    // A batch from the queue.
  bool look_requested_ = false;  // Look even without news.
  Clock::time_point next_look_;  // Earliest time of the next look.
  Clock::time_point urgently_searched_;
  Clock::duration last_step_{};  // Duration, publication included.
  TrackedEstimate newest_;
  bool unpublished_ = true;  // The first estimate is due: it says that the search has begun.
  TrackState published_state_ = TrackState::kSearching;
  Clock::time_point publish_from_;  // Earliest time at which the unpublished estimate is published.
  Clock::time_point next_publish_;
  Clock::time_point heartbeat_due_;

  std::jthread thread_;  // Last member: uses the others.
};

}  // namespace puck
