#include "common/yarp/board_exchange.h"

#include <algorithm>
#include <utility>

namespace puck {

bool BoardExchange::give_set_point(const JointAngles& set_point) {
  const std::lock_guard lock(mutex_);
  if (!reading_ || !has_read_ || !untold_.empty()) {
    ++counters_.set_points_unheard;
    return false;
  }
  if (set_point_) ++counters_.set_points_replaced;
  set_point_ = set_point;
  return true;
}

std::optional<JointReading> BoardExchange::reading() {
  const std::lock_guard lock(mutex_);
  has_read_ = reading_.has_value();
  return reading_;
}

std::string BoardExchange::fault(std::int64_t monotonic_us) {
  const std::lock_guard lock(mutex_);
  std::string untold = std::exchange(untold_, {});
  if (!untold.empty()) return untold;
  if (!reading_) return why_none_;
  // Should the board's thread itself hang.
  const std::int64_t age_us = monotonic_us - reading_->received_us;
  if (age_us <= 2 * silent_us_) return {};
  return "no encoders for " + std::to_string(age_us / 1000) + " ms";
}

YarpCounters BoardExchange::counters(std::int64_t monotonic_us) const {
  const std::lock_guard lock(mutex_);
  YarpCounters counters = counters_;
  if (reading_) counters.encoder_age_us = monotonic_us - reading_->received_us;
  return counters;
}

void BoardExchange::begin_connection(const JointReading& first) {
  const std::lock_guard lock(mutex_);
  ++counters_.connections;
  ++counters_.encoders_received;
  has_read_ = false;
  reading_ = first;
  set_point_.reset();
  why_none_.clear();
}

void BoardExchange::put_encoders(const JointReading& reading) {
  const std::lock_guard lock(mutex_);
  ++counters_.encoders_received;
  reading_ = reading;
}

void BoardExchange::lose_connection(const std::string& reason) {
  const std::lock_guard lock(mutex_);
  ++counters_.failures;
  reading_.reset();
  set_point_.reset();
  why_none_ = reason;
  untold_ = reason;
}

std::optional<JointAngles> BoardExchange::newest_set_point() const {
  const std::lock_guard lock(mutex_);
  return set_point_;
}

std::optional<JointAngles> BoardExchange::take_set_point() {
  const std::lock_guard lock(mutex_);
  return std::exchange(set_point_, std::nullopt);
}

void BoardExchange::count_sent() {
  const std::lock_guard lock(mutex_);
  ++counters_.set_points_sent;
}

void BoardExchange::refuse_set_point(const std::string& reason) {
  const std::lock_guard lock(mutex_);
  ++counters_.set_points_refused;
  set_point_.reset();
  untold_ = reason;
}

void BoardExchange::put_round_trip(std::int64_t round_trip_us) {
  const std::lock_guard lock(mutex_);
  counters_.round_trip_us = round_trip_us;
  counters_.round_trip_max_us = std::max(counters_.round_trip_max_us, round_trip_us);
}

}  // namespace puck
