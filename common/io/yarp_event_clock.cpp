#include "common/io/yarp_event_clock.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/io/number_limits.h"

namespace puck {
namespace {

constexpr std::int64_t kWrap = std::int64_t{1} << 31;
// Tolerated disorder within a packet.
constexpr double kDisorderUs = 10'000;
// Largest delay between a stamp and the host time of its packet's sending.
constexpr double kHostSlackUs = 1e6;
// A longer pause with a wrap of the counter is a damaged host time.
constexpr double kLongestPauseUs = 24 * 3600e6;
// Successive records far back that make a reset of the counter certain.
constexpr std::size_t kNewCount = 64;
// Records that are needed to detect a damaged first stamp.
constexpr std::size_t kFirstRecords = 3;

}  // namespace

// Ticks from one record to the other: the smaller step, plus the wraps that the host times show.
std::int64_t YarpEventClock::step_to(const StampedRecord& from, const StampedRecord& to) const {
  const std::int64_t forward = (std::int64_t{to.stamp} - std::int64_t{from.stamp}) & (kWrap - 1);
  const std::int64_t step = forward < kWrap / 2 ? forward : forward - kWrap;
  const double waited_us = (to.host_time_s - from.host_time_s) * 1e6;
  const double wrap_us = static_cast<double>(kWrap) * us_per_tick_;
  if (waited_us < wrap_us / 2 || waited_us > kLongestPauseUs) return step;
  const double turns = std::round((waited_us - static_cast<double>(step) * us_per_tick_) / wrap_us);
  const std::int64_t whole = step + kWrap * std::max<std::int64_t>(std::llround(turns), 0);
  const bool host_agrees =
      std::abs(waited_us - static_cast<double>(whole) * us_per_tick_) < kHostSlackUs;
  return host_agrees ? whole : step;
}

bool YarpEventClock::goes_on(const StampedRecord& from, const StampedRecord& to,
                             double most_us) const {
  const double step_us = static_cast<double>(step_to(from, to)) * us_per_tick_;
  return step_us >= 0 && step_us <= most_us;
}

void YarpEventClock::add(const StampedRecord& record, std::vector<TimedRecord>& placed) {
  if (newest_) {
    advance(record, placed);
    return;
  }
  first_.push_back(record);
  if (first_.size() == kFirstRecords) begin(placed);
}

void YarpEventClock::finish(std::vector<TimedRecord>& placed) {
  if (!newest_ && !first_.empty()) begin(placed);
  if (ahead_) {
    const StampedRecord last = *ahead_;
    ahead_.reset();
    believe(last, step_to(*newest_, last), placed);
  }
  doubtful_records_ += static_cast<std::int64_t>(back_.size());
  back_.clear();
}

// Begins with the first record whose successor agrees with it.
void YarpEventClock::begin(std::vector<TimedRecord>& placed) {
  const auto agree = [&](const StampedRecord& a, const StampedRecord& b) {
    return goes_on(a, b, std::max(b.host_time_s - a.host_time_s, 0.0) * 1e6 + kHostSlackUs);
  };
  std::size_t start = 0;
  if (first_.size() == kFirstRecords && !agree(first_[0], first_[1]) &&
      agree(first_[1], first_[2])) {
    start = 1;
    ++doubtful_records_;
  }
  const std::vector<StampedRecord> records = std::move(first_);
  first_.clear();
  believe(records[start], 0, placed);
  for (std::size_t i = start + 1; i < records.size(); ++i) advance(records[i], placed);
}

void YarpEventClock::advance(const StampedRecord& record, std::vector<TimedRecord>& placed) {
  if (ahead_) settle_ahead(record, placed);
  if (!back_.empty() && settle_back(record, placed)) return;
  const std::int64_t step = step_to(*newest_, record);
  const double step_us = static_cast<double>(step) * us_per_tick_;
  const bool is_late_packet = record.host_time_s < newest_->host_time_s;
  if (step > 0) {
    ahead_ = record;
  } else if (step_us < -kDisorderUs && !is_late_packet) {
    back_.push_back(record);
  } else {
    believe(record, step, placed);
  }
}

void YarpEventClock::believe(const StampedRecord& record, std::int64_t step,
                             std::vector<TimedRecord>& placed) {
  const std::int64_t ticks = ticks_ + step;
  // Damaged host times can sum to any value.
  if (static_cast<double>(ticks) * us_per_tick_ > kLatestUs) {
    ++doubtful_records_;
    return;
  }
  placed.push_back({{std::llround(static_cast<double>(ticks) * us_per_tick_)}, record.address});
  if (newest_ && step < 0) return;
  newest_ = record;
  ticks_ = ticks;
}

// Believes the record that waits, unless its successor is older.
void YarpEventClock::settle_ahead(const StampedRecord& next, std::vector<TimedRecord>& placed) {
  const StampedRecord waiting = *ahead_;
  ahead_.reset();
  const bool is_contradicted = step_to(waiting, next) < 0 && step_to(*newest_, next) >= 0;
  if (is_contradicted) {
    ++doubtful_records_;
  } else {
    believe(waiting, step_to(*newest_, waiting), placed);
  }
}

// Adds `next` to the records that wait, if it continues them, and detects a reset of the counter.
// Otherwise their stamps were damaged; false then.
bool YarpEventClock::settle_back(const StampedRecord& next, std::vector<TimedRecord>& placed) {
  const double waited_us = std::max(next.host_time_s - back_.back().host_time_s, 0.0) * 1e6;
  const bool joins =
      goes_on(back_.back(), next, waited_us + kHostSlackUs) && step_to(*newest_, next) < 0;
  if (!joins) {
    doubtful_records_ += static_cast<std::int64_t>(back_.size());
    back_.clear();
    return false;
  }
  back_.push_back(next);
  if (back_.size() < kNewCount) return true;
  const std::vector<StampedRecord> count = std::move(back_);
  back_.clear();
  const double pause_us =
      std::clamp((count.front().host_time_s - newest_->host_time_s) * 1e6, 0.0, kLongestPauseUs);
  believe(count.front(), std::llround(pause_us / us_per_tick_), placed);
  for (std::size_t i = 1; i < count.size(); ++i) advance(count[i], placed);
  return true;
}

}  // namespace puck
