#include "common/runtime/tracking_thread.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace puck {

using std::chrono::duration_cast;
using std::chrono::microseconds;
using std::chrono::steady_clock;
using std::chrono::system_clock;

TrackingThread::TrackingThread(SharedSurface& surface, std::unique_ptr<TrackingPipeline> pipeline,
                               PuckSearch search, const TrackingThreadParams& params,
                               Publish publish)
    : surface_(surface),
      pipeline_(std::move(pipeline)),
      search_(std::move(search)),
      params_(params),
      publish_(std::move(publish)) {
  if (params.max_publish_hz < 1 || params.heartbeat <= microseconds::zero()) {
    throw std::invalid_argument("tracker.max_publish_hz must be at least 1, got " +
                                std::to_string(params.max_publish_hz));
  }
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

TrackingThread::~TrackingThread() {
  thread_.request_stop();
  surface_.wake();
}

void TrackingThread::run(const std::stop_token& stop) {
  const microseconds publish_period(1'000'000 / params_.max_publish_hz);
  SharedSnapshot snapshot;
  TrackedEstimate newest;
  bool unpublished = true;  // the first word is that the search has begun
  TrackState published_state = TrackState::kSearching;
  auto next_publish = steady_clock::now();
  auto heartbeat_due = next_publish;

  while (!stop.stop_requested()) {
    const auto due = unpublished ? std::min(next_publish, heartbeat_due) : heartbeat_due;
    const auto left = duration_cast<microseconds>(due - steady_clock::now());
    if (surface_.wait_for_news(std::max(left, microseconds::zero()))) {
      newest.tracking_started = system_clock::now();
      surface_.snapshot(pipeline_->region_needed(), snapshot);
      newest.estimate = pipeline_->step(snapshot.surface);
      if (search_if_wanted()) {
        surface_.snapshot(pipeline_->region_needed(), snapshot);
        newest.estimate = pipeline_->step(snapshot.surface);
      }
      newest.origin = snapshot.origin;
      newest.backlog_us = snapshot.backlog_us;
      newest.backlog_events = snapshot.backlog_events;
      unpublished = true;
    }
    const auto now = steady_clock::now();
    const bool changed = newest.estimate.state != published_state;
    if (changed || (unpublished && now >= next_publish) || now >= heartbeat_due) {
      newest.input_age = now - surface_.newest_packet_received();
      publish_(newest);
      published_state = newest.estimate.state;
      unpublished = false;
      // Evenly: the next slot follows from the last one unless that has long passed.
      next_publish = std::max(next_publish + publish_period, now);
      heartbeat_due = now + params_.heartbeat;
    }
  }
}

bool TrackingThread::search_if_wanted() {
  const Region wanted = pipeline_->search_wanted();
  if (wanted.empty()) return false;
  SharedSnapshot snapshot;
  surface_.snapshot(search_.snapshot_region(wanted), snapshot);
  pipeline_->take(search_.search(snapshot.surface, wanted));
  return true;
}

}  // namespace puck
