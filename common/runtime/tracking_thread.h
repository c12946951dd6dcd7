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
#include "common/vision/puck_search.h"
#include "common/vision/tracking_pipeline.h"

namespace puck {

struct TrackingThreadParams {
  /// Estimates are handed on at most so often, evenly; a change of state at once. Key
  /// tracker.max_publish_hz.
  int max_publish_hz = 5000;
  /// … and at least so often, also when nothing changes, so that silence always means trouble.
  std::chrono::microseconds heartbeat{20'000};
  /// The event thread makes a step itself only while the last one took no longer than this, and
  /// takes single events for no longer, because the surface stands still meanwhile. A step takes
  /// some 10 µs and one in a hundred 50; to wake the other thread costs 20 to 40.
  std::chrono::microseconds longest_on_event_thread{100};
};

/// The time between two estimates. Throws std::invalid_argument, naming the key, when a parameter
/// is out of range.
std::chrono::microseconds publish_period(const TrackingThreadParams& params);

/// An estimate and the times of the chain that led to it.
struct TrackedEstimate {
  PuckEstimate estimate;
  PacketOrigin origin;
  std::chrono::system_clock::time_point tracking_started;
  /// From the receipt of the newest packet to the first look at the surface that showed some of it.
  std::chrono::steady_clock::duration packet_to_look{};
  std::int64_t backlog_us = 0;
  std::int64_t backlog_events = 0;
  /// How long ago, at publication, the newest packet came, even if it brought nothing for the
  /// tracking region.
  std::chrono::steady_clock::duration input_age{};
};

/// The paper's second thread (Figure 2): takes the newest surface, detects or tracks, as fast as it
/// can while there is something new in its region; sleeps while there is nothing. When nothing else
/// waits for the event thread that one makes the step itself, which takes less time than to wake
/// another thread; floods of events, slow steps, those without a track, searches and what is due by
/// time are this one's. Where its pipeline takes single events it gets those that the surface shows
/// before the surface itself. Searches run on a thread of their own, of low priority, and are never
/// waited for.
class TrackingThread {
 public:
  using Publish = std::function<void(const TrackedEstimate&)>;

  /// Starts the thread. `publish` is called on it or in look_now(), by one of them at a time, and
  /// must not throw. The surface must outlive this object.
  TrackingThread(SharedSurface& surface, std::unique_ptr<TrackingPipeline> pipeline,
                 PuckSearch search, const TrackingThreadParams& params, Publish publish);
  /// Stops the thread and waits for it.
  ~TrackingThread();
  TrackingThread(const TrackingThread&) = delete;
  TrackingThread& operator=(const TrackingThread&) = delete;

  /// Event thread only, after an update of the surface that did not wake this thread: makes the
  /// step that is due for it on the caller's thread, or, where this thread is making one, the last
  /// one was slow, or there is no track, leaves it to this thread. Waits for nobody, and never
  /// searches.
  void look_now();

 private:
  using Clock = std::chrono::steady_clock;

  /// How long there is nothing to do.
  struct Pause {
    std::chrono::microseconds longest{};
    bool ends_with_news = true;
  };

  void run(const std::stop_token& stop);
  void do_what_is_due();
  Pause next_pause() const;
  void take_search_result();
  bool is_for_event_thread() const;
  void make_step(std::chrono::microseconds longest_take);
  void look(std::chrono::microseconds longest_take);
  bool take_events(std::chrono::microseconds longest_take);
  void begin_search_if_wanted();
  void publish_if_due();

  SharedSurface& surface_;
  // Held by whoever makes a step, for as long as it takes. Guards all below but the thread.
  std::mutex step_mutex_;
  std::unique_ptr<TrackingPipeline> pipeline_;
  SearchWorker worker_;
  TrackingThreadParams params_;
  std::chrono::microseconds publish_period_{};
  Publish publish_;

  SharedSnapshot snapshot_;
  std::vector<Event> events_;    // of the queue, a handful at a time
  std::vector<Event> wanted_;    // of a piece of them
  bool look_anyway_ = false;     // also when there is no news
  Clock::time_point next_look_;  // not before
  Clock::time_point urgently_searched_;
  Clock::duration last_step_{};  // how long it took, publication included
  TrackedEstimate newest_;
  bool unpublished_ = true;  // the first word is that the search has begun
  TrackState published_state_ = TrackState::kSearching;
  Clock::time_point publish_from_;  // what is unpublished; not before
  Clock::time_point next_publish_;
  Clock::time_point heartbeat_due_;

  std::jthread thread_;  // last: it uses what stands above
};

}  // namespace puck
