#include "common/control/track_watch.h"

#include <cmath>

#include "common/messaging/message_facts.h"

namespace puck {
namespace {

bool rests(const puck_estimate_t& estimate) {
  return (estimate.flags & puck_estimate_t::FLAG_RESTING) != 0;
}

// Host time at sensor time 0, as the camera says; any value, hence doubles.
double zero_utime(const puck_estimate_t& estimate) {
  return static_cast<double>(estimate.event_utime) - static_cast<double>(estimate.sensor_us);
}

bool tracks(const puck_estimate_t& estimate) {
  return estimate.state == puck_estimate_t::STATE_TRACKING &&
         (estimate.flags & puck_estimate_t::FLAG_POSITION) != 0 &&
         (estimate.flags & puck_estimate_t::FLAG_LIVE) != 0;
}

}  // namespace

TrackWatch::Verdict TrackWatch::hear(const puck_estimate_t& estimate, const HostNow& now,
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
  if (tracks(estimate) && !(std::isfinite(estimate.x_px) && std::isfinite(estimate.y_px))) {
    return Verdict::kMalformed;
  }
  if (!is_sensor_time(estimate.sensor_us)) return Verdict::kMalformed;
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
  if (tracks(estimate) && !rests(estimate) && estimate.event_utime != 0 &&
      freshness_of(estimate.event_utime, now, sender, oldest_us) != Freshness::kOfNow) {
    return Verdict::kStale;
  }
  follow_sensor_clock(estimate, now.monotonic_us);
  const bool went_on = !newest_ || newest_->events_session != estimate.events_session ||
                       estimate.sensor_us > newest_->sensor_us;
  if (rests(estimate) || went_on) {
    went_on_us_ = now.monotonic_us;
  } else if (tracks(estimate)) {
    ++frozen_;
  }
  newest_ = estimate;
  newest_heard_us_ = now.monotonic_us;
  published_[static_cast<std::size_t>(estimate.seq) % kRemembered] = {
      estimate.session, estimate.seq, sender->to_own(estimate.utime)};
  return Verdict::kUsed;
}

void TrackWatch::follow_sensor_clock(const puck_estimate_t& estimate, std::int64_t monotonic_us) {
  // Repeated restarts of a camera keep its clock distrusted.
  if (newest_ && newest_->events_session != estimate.events_session) {
    sensor_clock_.doubt(params_.dead_man_us, monotonic_us);
  }
  if (estimate.event_utime == 0) return;
  if (!params_.camera_is_real && newest_ && newest_->event_utime != 0) {
    sensor_clock_.slip(zero_utime(estimate) - zero_utime(*newest_));
  }
  sensor_clock_.see(estimate.sensor_us, monotonic_us, tracks(estimate) && !rests(estimate));
}

const puck_estimate_t* TrackWatch::alive(std::int64_t monotonic_us) const {
  if (!newest_ || !tracks(*newest_) || !sensor_clock_.is_believed(monotonic_us)) return nullptr;
  if (params_.camera_is_real && newest_->event_utime == 0) return nullptr;
  if (monotonic_us - newest_heard_us_ > params_.dead_man_us) return nullptr;
  if (monotonic_us - went_on_us_ > params_.dead_man_us) return nullptr;
  return &*newest_;
}

std::optional<std::int64_t> TrackWatch::published_utime(std::int64_t session,
                                                        std::int64_t seq) const {
  const Published& found = published_[static_cast<std::size_t>(seq) % kRemembered];
  if (seq < 0 || found.session != session || found.seq != seq) return std::nullopt;
  return found.utime;
}

}  // namespace puck
