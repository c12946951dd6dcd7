#include "services/camera/replay.h"

#include <algorithm>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include "common/messages/host_time.h"

namespace puck {
namespace {

// Steps by packets that were asked for before the last one was published.
constexpr int kMostPackets = 100;

std::int64_t us_between(Replay::Clock::time_point from, Replay::Clock::time_point to) {
  return std::chrono::duration_cast<std::chrono::microseconds>(to - from).count();
}

}  // namespace

std::string seconds_text(std::int64_t us) {
  return fmt::format("{:.{}f} s", static_cast<double>(us) * 1e-6, us % 1000 == 0 ? 3 : 6);
}

void Replay::begin(Timestamp time, Clock::time_point now) {
  newest_ = time;
  waits_for_ = time;
  found_us_.reset();
  // A step that was asked for before the first event at this place.
  if (step_end_) step_end_ = time + (*step_end_ - held_at_);
  held_at_ = time;
  anchor(time, now);
}

ControlVerdict Replay::obey(const ReplayRequest& request, Clock::time_point now) {
  using Kind = ReplayRequest::Kind;
  if (!is_controllable()) return ControlVerdict::kNoRecording;
  if (!is_begun()) return ControlVerdict::kNotBegun;
  ControlVerdict verdict = ControlVerdict::kObeyed;
  switch (request.kind) {
    case Kind::kPause:
      pause(now);
      break;
    case Kind::kResume:
      resume(now);
      break;
    case Kind::kPauseOrResume:
      is_paused_ ? resume(now) : pause(now);
      break;
    case Kind::kStep:
      step(request.us > 0 ? request.us : params_.step_us, now);
      break;
    case Kind::kSeek:
      verdict = seek(request.us, now);
      break;
    case Kind::kSeekBy:
      verdict = seek(std::max<std::int64_t>(0, position_us(now) + request.us), now);
      break;
    case Kind::kSpeed:
      set_speed(request.speed, now);
      break;
    case Kind::kFaster:
      set_speed(std::clamp(params_.speed * request.speed, ReplayRequest::kSlowest,
                           ReplayRequest::kFastest),
                now);
      break;
  }
  return verdict;
}

std::optional<Replay::Clock::time_point> Replay::due(Timestamp time, Clock::time_point now) {
  waits_for_ = std::max(newest_, time);
  if (step_end_ && time > *step_end_ && now >= pacer_.due(*step_end_)) hold(*step_end_);
  if (is_paused_) return packets_allowed_ > 0 ? std::optional(now) : std::nullopt;
  return pacer_.due(step_end_ ? std::min(time, *step_end_) : time);
}

bool Replay::note(Timestamp time, Clock::time_point now) {
  newest_ = std::max(newest_, time);
  noted_at_ = now;
  noted_late_us_ = 0;
  if (is_paused_) {
    held_at_ = newest_;
    return false;
  }
  noted_late_us_ = us_between(pacer_.due(time), now);
  const std::int64_t slipped_before_us = pacer_.slipped_us();
  const bool has_slipped = pacer_.note(time, now);
  zero_utime_ += pacer_.slipped_us() - slipped_before_us;
  return has_slipped;
}

void Replay::note_sent(Clock::time_point now) {
  if (!is_paused_) lateness_.record(noted_late_us_ + us_between(noted_at_, now));
  packets_allowed_ = std::max(0, packets_allowed_ - 1);
}

std::int64_t Replay::skip_gap(Timestamp first, Clock::time_point now) {
  const std::int64_t gap_us = first - newest_;
  if (params_.skip_gaps_us == 0 || gap_us <= params_.skip_gaps_us) return 0;
  newest_ = first;
  waits_for_ = std::max(waits_for_, first);
  if (is_paused_) {
    held_at_ = first;
  } else {
    anchor(first, now);
  }
  return gap_us;
}

std::int64_t Replay::position_us(Clock::time_point now) const {
  if (sought_us_) return *sought_us_;
  if (found_us_) return *found_us_;
  return is_begun() ? std::max<std::int64_t>(0, source_.position_us(time_at(now))) : 0;
}

void Replay::pause(Clock::time_point now) {
  if (!is_paused_) hold(time_at(now));
}

void Replay::resume(Clock::time_point now) {
  step_end_.reset();
  packets_allowed_ = 0;
  if (std::exchange(is_paused_, false)) anchor(held_at_, now);
}

void Replay::step(std::int64_t us, Clock::time_point now) {
  if (us > 0 && step_end_) {
    step_end_ = std::min(*step_end_ + us, held_at_ + ReplayRequest::kLongestStepUs);
    return;
  }
  pause(now);
  if (us == 0) {
    packets_allowed_ = std::min(packets_allowed_ + 1, kMostPackets);
    return;
  }
  is_paused_ = false;
  step_end_ = held_at_ + us;
  anchor(held_at_, now);
}

ControlVerdict Replay::seek(std::int64_t position_us, Clock::time_point now) {
  const Timestamp was_at = is_searching() ? sought_from_ : time_at(now);
  const ControlVerdict verdict = source_.seek(position_us);
  if (verdict != ControlVerdict::kSearching) return verdict;
  sought_us_ = position_us;
  sought_from_ = was_at;
  return verdict;
}

void Replay::end_search(bool is_found, Clock::time_point now) {
  if (is_found) found_us_ = sought_us_;
  sought_us_.reset();
  if (!is_found && !is_paused_) anchor(sought_from_, now);
}

void Replay::set_speed(double speed, Clock::time_point now) {
  const Timestamp time = time_at(now);
  params_.speed = speed;
  pacer_.set_speed(speed);
  anchor(time, now);
}

void Replay::hold(Timestamp time) {
  is_paused_ = true;
  held_at_ = time;
  step_end_.reset();
  packets_allowed_ = 0;
}

void Replay::anchor(Timestamp time, Clock::time_point now) {
  pacer_.start(time, now);
  zero_utime_ = host_utime() - time.us;
}

// While the camera is late, its time stands before the events that wait.
Timestamp Replay::time_at(Clock::time_point now) const {
  return is_paused_ ? held_at_ : std::clamp(pacer_.time_at(now), newest_, waits_for_);
}

}  // namespace puck
