#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <thread>

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
};

/// An estimate and the times of the chain that led to it.
struct TrackedEstimate {
  PuckEstimate estimate;
  PacketOrigin origin;
  std::chrono::system_clock::time_point tracking_started;
  std::int64_t backlog_us = 0;
  std::int64_t backlog_events = 0;
  /// How long ago, at publication, the newest packet came, even if it brought nothing for the
  /// tracking region.
  std::chrono::steady_clock::duration input_age{};
};

/// The paper's second thread (Figure 2): takes the newest surface, detects or tracks, as fast as it
/// can while there is something new in its region; sleeps while there is nothing.
class TrackingThread {
 public:
  using Publish = std::function<void(const TrackedEstimate&)>;

  /// Starts the thread. `publish` is called on it and must not throw. The surface must outlive this
  /// object.
  TrackingThread(SharedSurface& surface, std::unique_ptr<TrackingPipeline> pipeline,
                 PuckSearch search, const TrackingThreadParams& params, Publish publish);
  /// Stops the thread and waits for it.
  ~TrackingThread();
  TrackingThread(const TrackingThread&) = delete;
  TrackingThread& operator=(const TrackingThread&) = delete;

 private:
  void run(const std::stop_token& stop);
  bool search_if_wanted();

  SharedSurface& surface_;
  std::unique_ptr<TrackingPipeline> pipeline_;
  PuckSearch search_;
  TrackingThreadParams params_;
  Publish publish_;
  std::jthread thread_;
};

}  // namespace puck
