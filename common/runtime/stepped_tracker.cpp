#include "common/runtime/stepped_tracker.h"

#include <algorithm>
#include <utility>

namespace puck {

using std::chrono::microseconds;

SteppedTracker::SteppedTracker(SensorSize sensor, const PipelineParams& params,
                               const PuckSizeModel& size_model,
                               const TrackingThreadParams& thread_params,
                               TrackingThread::Publish publish)
    : tracker_(sensor, params, size_model),
      period_(std::min(publish_period(thread_params), thread_params.heartbeat)),
      heartbeat_(thread_params.heartbeat),
      publish_(std::move(publish)),
      next_publish_(Clock::now()),
      heartbeat_due_(next_publish_) {}

void SteppedTracker::update(const EventPacket& packet, const PacketOrigin& origin) {
  if (origin.received != origin_.received) {
    newest_.packet_to_look = std::max(Clock::now() - origin.received, Clock::duration::zero());
  }
  tracker_.update(packet);
  origin_ = origin;
  has_news_ = true;
  poll();
}

void SteppedTracker::poll() {
  const auto now = Clock::now();
  if (has_news_ && now >= next_publish_) {
    has_news_ = false;
    newest_.tracking_started = std::chrono::system_clock::now();
    newest_.estimate = tracker_.estimate();
    newest_.origin = origin_;
    publish(now);
  } else if (now >= heartbeat_due_) {
    publish(now);
  }
}

void SteppedTracker::publish(Clock::time_point now) {
  newest_.input_age = Clock::now() - origin_.received;
  publish_(newest_);
  next_publish_ = std::max(next_publish_ + period_, now);
  heartbeat_due_ = now + heartbeat_;
}

}  // namespace puck
