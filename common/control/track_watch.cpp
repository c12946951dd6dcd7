#include "common/control/track_watch.h"

#include <cmath>

namespace puck {
namespace {

// Host time at sensor time 0, as the camera says; any value, hence doubles.
double zero_utime(const PublishedEstimate& estimate) {
  return static_cast<double>(*estimate.event_utime) - static_cast<double>(estimate.newest_event.us);
}

bool tracks(const PublishedEstimate& estimate) {
  return estimate.is_tracking() && estimate.is_live;
}

}  // namespace

TrackWatch::Verdict TrackWatch::hear(const PublishedEstimate& estimate, const HostNow& now,
                                     const SenderClock& sender) {
  switch (freshness_of(estimate.utime, now, sender, params_.max_clock_error_us)) {
    case Freshness::kClockUnknown:
      return Verdict::kClockUnknown;
    case Freshness::kOld:
    case Freshness::kFromFuture:
      return Verdict::kClock;
    case Freshness::kOfNow:
      break;
  }
  if (tracks(estimate) &&
      !(std::isfinite(estimate.position->x) && std::isfinite(estimate.position->y))) {
    return Verdict::kMalformed;
  }
  if (!is_sensor_time(estimate.newest_event)) return Verdict::kMalformed;
  switch (publisher_.hear(estimate.session, estimate.seq, now.monotonic_us)) {
    case SinglePublisher::Verdict::kLate:
      return Verdict::kLate;
    case SinglePublisher::Verdict::kOtherPublisher:
      return Verdict::kOtherPublisher;
    case SinglePublisher::Verdict::kNewPublisher:
      newest_.reset();
      sensor_clock_.restart();
      break;
    case SinglePublisher::Verdict::kAccepted:
      break;
  }

  // The uncertainty of the clock is added to the limit.
  const std::int64_t oldest_us = params_.dead_man_us + 2 * sender->uncertainty_us;
  if (tracks(estimate) && !estimate.resting && estimate.event_utime &&
      freshness_of(*estimate.event_utime, now, sender, oldest_us) != Freshness::kOfNow) {
    return Verdict::kStale;
  }
  follow_sensor_clock(estimate, now.monotonic_us);
  const bool went_on = !newest_ || newest_->events_session != estimate.events_session ||
                       estimate.newest_event > newest_->newest_event;
  if (estimate.resting || went_on) {
    went_on_us_ = now.monotonic_us;
  } else if (tracks(estimate)) {
    ++frozen_;
  }
  newest_ = estimate;
  newest_heard_us_ = now.monotonic_us;
  published_[static_cast<std::size_t>(estimate.seq) % kRemembered] = {
      estimate.id(), sender->to_own(estimate.utime)};
  return Verdict::kUsed;
}

void TrackWatch::follow_sensor_clock(const PublishedEstimate& estimate, std::int64_t monotonic_us) {
  // Repeated restarts of a camera keep its clock distrusted.
  if (newest_ && newest_->events_session != estimate.events_session) {
    sensor_clock_.doubt(params_.dead_man_us, monotonic_us);
  }
  if (!estimate.event_utime) return;
  if (!params_.camera_is_real && newest_ && newest_->event_utime) {
    sensor_clock_.slip(zero_utime(estimate) - zero_utime(*newest_));
  }
  sensor_clock_.see(estimate.newest_event.us, monotonic_us, tracks(estimate) && !estimate.resting);
}

const PublishedEstimate* TrackWatch::alive(std::int64_t monotonic_us) const {
  if (!newest_ || !tracks(*newest_) || !sensor_clock_.is_believed(monotonic_us)) return nullptr;
  if (params_.camera_is_real && !newest_->event_utime) return nullptr;
  if (monotonic_us - newest_heard_us_ > params_.dead_man_us) return nullptr;
  if (monotonic_us - went_on_us_ > params_.dead_man_us) return nullptr;
  return &*newest_;
}

std::optional<std::int64_t> TrackWatch::published_utime(const MessageId& estimate) const {
  const Published& found = published_[static_cast<std::size_t>(estimate.seq) % kRemembered];
  if (estimate.seq < 0 || found.id != estimate) return std::nullopt;
  return found.utime;
}

}  // namespace puck
