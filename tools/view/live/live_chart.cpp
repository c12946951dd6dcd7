#include "tools/view/live/live_chart.h"

#include <cmath>

namespace puck {
namespace {

constexpr double kPeriod_s = static_cast<double>(ChartSample::kPeriod_us) / 1e6;

/// The first end of a period after `time`.
Timestamp period_end_after(Timestamp time) {
  return {(time.us / ChartSample::kPeriod_us + 1) * ChartSample::kPeriod_us};
}

}  // namespace

void LiveChart::add_events(Timestamp newest, std::int64_t count) {
  events_ += count;
  advance(newest);
}

void LiveChart::advance(Timestamp time) {
  if (!next_ || time - *next_ > ChartSample::kKept_us) next_ = period_end_after(time);
  while (time >= *next_) {
    add_sample();
    *next_ = *next_ + ChartSample::kPeriod_us;
  }
}

void LiveChart::clear() { *this = {}; }

std::optional<double> LiveChart::error_px() const {
  if (!estimate_ || !estimate_->position) return std::nullopt;
  const auto truth = truth_.at(estimate_->newest_event);
  if (!truth || !is_visible(*truth)) return std::nullopt;
  return std::hypot(estimate_->position->x - truth->centre.x,
                    estimate_->position->y - truth->centre.y);
}

void LiveChart::add_sample() {
  ChartSample& sample = samples_.emplace_back();
  sample.time = *next_;
  sample.events_per_s = static_cast<double>(events_) / kPeriod_s;
  events_ = 0;
  if (estimate_) {
    ChartSample::Track& track = sample.tracks[0];
    track.position = estimate_->position;
    track.error_px = error_px();
    track.score = estimate_->score;
    track.state = estimate_->state;
    track.is_doubtful = estimate_->state != TrackState::kTracking || estimate_->coasting;
  }
  const auto truth = truth_.at(sample.time);
  if (truth && is_visible(*truth)) sample.truth = truth->centre;
  while (sample.time - samples_.front().time > ChartSample::kKept_us) samples_.pop_front();
}

}  // namespace puck
