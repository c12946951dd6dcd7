#include "services/camera/live_source.h"

#include <limits>
#include <stdexcept>
#include <utility>

#include "common/messages/host_time.h"

namespace puck {
namespace {

constexpr std::chrono::milliseconds kWait{2};

void append(const EventPacket& from, EventPacket& to) {
  const auto shift_us = static_cast<std::uint32_t>(from.start - to.start);
  const std::size_t before = to.events.size();
  to.events.insert(to.events.end(), from.events.begin(), from.events.end());
  for (std::size_t i = before; i < to.events.size(); ++i) to.events[i].offset_us += shift_us;
}

}  // namespace

LiveSource::LiveSource(std::unique_ptr<EventSource> source, std::size_t most_chunks)
    : source_(std::move(source)), ring_(most_chunks) {
  if (most_chunks == 0) throw std::invalid_argument("a live source must hold at least 1 chunk");
  told_.sensor = source_->sensor_size();
  told_.waiting_for = source_->waiting_for();
  thread_ = std::jthread([this](std::stop_token stop) { read(std::move(stop)); });
}

LiveSource::~LiveSource() {
  thread_.request_stop();
  source_->interrupt();
}

EventSource::Outcome LiveSource::next(Chunk& chunk) {
  std::unique_lock lock(mutex_);
  if (!came_.wait_for(lock, kWait, [this] { return count_ > 0 || has_ended_; })) {
    return Outcome::kNothingYet;
  }
  if (count_ == 0) {
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    return Outcome::kEnd;
  }
  std::swap(chunk, ring_[oldest_]);
  oldest_ = (oldest_ + 1) % ring_.size();
  --count_;
  return Outcome::kEvents;
}

std::int64_t LiveSource::malformed_words() const {
  const std::lock_guard lock(mutex_);
  return told_.malformed_words;
}

// Asked at each turn: no more than this is copied while the thread waits.
std::optional<EventSource::PortCounts> LiveSource::port_counts() const {
  const std::lock_guard lock(mutex_);
  return told_.port;
}

std::int64_t LiveSource::events_dropped() const {
  const std::lock_guard lock(mutex_);
  return told_.dropped + overflowed_;
}

std::int64_t LiveSource::events_overflowed() const {
  const std::lock_guard lock(mutex_);
  return overflowed_;
}

LiveSource::Told LiveSource::told() const {
  const std::lock_guard lock(mutex_);
  return told_;
}

void LiveSource::read(std::stop_token stop) {
  Chunk chunk;
  Told told;
  bool has_ended = false;
  std::exception_ptr failure;
  while (!has_ended && !stop.stop_requested()) {
    Outcome outcome = Outcome::kEnd;
    try {
      outcome = source_->next(chunk);
      if (outcome == Outcome::kEnd) told.warnings = source_->warnings();
    } catch (...) {
      failure = std::current_exception();
    }
    has_ended = outcome == Outcome::kEnd;
    told.sensor = source_->sensor_size();
    told.waiting_for = source_->waiting_for();
    told.dropped = source_->events_dropped();
    told.malformed_words = source_->malformed_words();
    told.port = source_->port_counts();
    chunk.came_utime = host_utime();

    const std::lock_guard lock(mutex_);
    told_ = told;
    if (outcome == Outcome::kEvents) push(chunk);
    has_ended_ = has_ended;
    failure_ = failure;
    if (outcome != Outcome::kNothingYet) came_.notify_one();
  }
}

void LiveSource::push(Chunk& chunk) {
  if (joins_newest(chunk)) {
    Chunk& newest = ring_[(oldest_ + count_ - 1) % ring_.size()];
    append(chunk.packet, newest.packet);
    newest.until = chunk.until;
    newest.came_utime = chunk.came_utime;
    return;
  }
  if (count_ == ring_.size()) drop_oldest();
  std::swap(chunk, ring_[(oldest_ + count_) % ring_.size()]);
  ++count_;
}

void LiveSource::drop_oldest() {
  overflowed_ += static_cast<std::int64_t>(ring_[oldest_].packet.events.size());
  const bool began_new_clock = ring_[oldest_].new_clock;
  oldest_ = (oldest_ + 1) % ring_.size();
  --count_;
  // The next chunk must keep this information.
  if (count_ > 0 && began_new_clock) ring_[oldest_].new_clock = true;
}

bool LiveSource::joins_newest(const Chunk& chunk) const {
  if (count_ == 0 || chunk.new_clock) return false;
  const EventPacket& newest = ring_[(oldest_ + count_ - 1) % ring_.size()].packet;
  if (newest.empty() || chunk.packet.empty()) return false;
  return newest.events.size() + chunk.packet.events.size() <= kChunkEvents &&
         chunk.packet.newest() - newest.start <= std::numeric_limits<std::uint32_t>::max();
}

}  // namespace puck
