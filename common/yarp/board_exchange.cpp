#include "common/yarp/board_exchange.h"

#include <algorithm>

namespace puck {
namespace {

void count(std::atomic<std::int64_t>& counter) { counter.fetch_add(1, std::memory_order_relaxed); }

}  // namespace

bool BoardExchange::give_set_point(const JointAngles& set_point, std::int64_t monotonic_us) {
  to_loop_.look();
  const BoardState& board = to_loop_.seen();
  if (!board.reading || read_connection_ != board.connection || read_faults_ != board.faults) {
    count(counts_.set_points_unheard);
    return false;
  }
  to_board_.next() = {set_point, monotonic_us, board.connection, board.faults};
  if (to_board_.publish() && has_given_) count(counts_.set_points_replaced);
  has_given_ = true;
  return true;
}

void BoardExchange::withdraw_set_point() {
  if (!has_given_) return;
  has_given_ = false;
  to_board_.next() = {};
  if (to_board_.publish()) count(counts_.set_points_withdrawn);
}

bool BoardExchange::holds() {
  to_loop_.look();
  return to_loop_.seen().holds;
}

std::optional<JointReading> BoardExchange::reading() {
  to_loop_.look();
  const BoardState& board = to_loop_.seen();
  read_connection_ = board.reading ? board.connection : 0;
  return board.reading;
}

std::string BoardExchange::fault(std::int64_t monotonic_us) {
  to_loop_.look();
  const BoardState& board = to_loop_.seen();
  if (read_faults_ != board.faults) {
    read_faults_ = board.faults;
    return board.newest_fault;
  }
  if (!board.reading) return board.is_fault ? board.why_none : std::string{};
  // The board's thread itself may hang.
  const std::int64_t age_us = monotonic_us - board.reading->received_us;
  if (age_us <= 2 * silent_us_) return {};
  return "no encoders for " + std::to_string(age_us / 1000) + " ms";
}

std::string BoardExchange::awaited() {
  to_loop_.look();
  const BoardState& board = to_loop_.seen();
  return board.is_fault ? std::string{} : board.why_none;
}

YarpCounters BoardExchange::counters(std::int64_t monotonic_us) const {
  const auto now = [](const std::atomic<std::int64_t>& counter) {
    return counter.load(std::memory_order_relaxed);
  };
  YarpCounters counters{now(counts_.connections),         now(counts_.failures),
                        now(counts_.encoders_received),   now(counts_.set_points_sent),
                        now(counts_.set_points_replaced), now(counts_.set_points_unheard),
                        now(counts_.set_points_refused),  now(counts_.set_points_withdrawn),
                        now(counts_.set_points_expired),  now(counts_.round_trip_us),
                        now(counts_.round_trip_max_us),   std::nullopt};
  const std::int64_t encoders_at_us = now(counts_.encoders_at_us);
  if (encoders_at_us != kNever) counters.encoder_age_us = monotonic_us - encoders_at_us;
  return counters;
}

void BoardExchange::publish() {
  counts_.encoders_at_us.store(state_.reading ? state_.reading->received_us : kNever,
                               std::memory_order_relaxed);
  to_loop_.next() = state_;
  to_loop_.publish();
}

void BoardExchange::begin_connection(const JointReading& first) {
  count(counts_.connections);
  count(counts_.encoders_received);
  ++state_.connection;
  state_.reading = first;
  state_.why_none.clear();
  state_.is_fault = false;
  publish();
}

void BoardExchange::put_encoders(const JointReading& reading) {
  count(counts_.encoders_received);
  state_.reading = reading;
  publish();
}

void BoardExchange::lose_connection(const YarpError& why) {
  count(counts_.failures);
  state_.reading.reset();
  state_.holds = false;
  state_.why_none = why.what();
  switch (why.kind()) {
    case YarpError::Kind::kFailed:
      state_.is_fault = state_.connection > 0;
      break;
    case YarpError::Kind::kNotReady:
      state_.is_fault = was_held_;
      break;
    case YarpError::Kind::kNeedsPerson:
      state_.is_fault = true;
      break;
  }
  if (state_.is_fault) {
    ++state_.faults;
    state_.newest_fault = state_.why_none;
  }
  publish();
}

void BoardExchange::put_hold() {
  if (state_.holds) return;
  was_held_ = state_.holds = true;
  publish();
}

// Accepts a set-point only if the loop gave it after it read the present connection and every
// fault.
void BoardExchange::poll_set_point(std::int64_t monotonic_us) {
  if (to_board_.look()) {
    const LoopRequest& newer = to_board_.seen();
    if (waiting_) {
      count(newer.set_point ? counts_.set_points_replaced : counts_.set_points_withdrawn);
    }
    waiting_.reset();
    if (newer.set_point) waiting_ = newer;
  }
  if (waiting_ && monotonic_us - waiting_->given_us > kOldestSetPointUs) {
    count(counts_.set_points_expired);
    waiting_.reset();
  }
  if (waiting_ && (!state_.reading || waiting_->connection != state_.connection ||
                   waiting_->faults != state_.faults)) {
    waiting_.reset();
  }
}

std::optional<JointAngles> BoardExchange::newest_set_point(std::int64_t monotonic_us) {
  poll_set_point(monotonic_us);
  return waiting_ ? waiting_->set_point : std::nullopt;
}

std::optional<JointAngles> BoardExchange::take_set_point(std::int64_t monotonic_us) {
  const std::optional<JointAngles> taken = newest_set_point(monotonic_us);
  waiting_.reset();
  return taken;
}

void BoardExchange::count_sent() { count(counts_.set_points_sent); }

void BoardExchange::refuse_set_point(const std::string& reason) {
  count(counts_.set_points_refused);
  ++state_.faults;
  state_.newest_fault = reason;
  publish();
}

void BoardExchange::put_round_trip(std::int64_t round_trip_us) {
  counts_.round_trip_us.store(round_trip_us, std::memory_order_relaxed);
  const std::int64_t most = counts_.round_trip_max_us.load(std::memory_order_relaxed);
  counts_.round_trip_max_us.store(std::max(most, round_trip_us), std::memory_order_relaxed);
}

}  // namespace puck
