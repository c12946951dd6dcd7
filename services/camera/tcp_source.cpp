#include "services/camera/tcp_source.h"

#include <chrono>
#include <thread>
#include <utility>

namespace puck {
namespace {

constexpr std::chrono::milliseconds kIdle{2};

}  // namespace

TcpSource::TcpSource(std::unique_ptr<TcpLink> link, const EventFileOptions& options)
    : link_(std::move(link)), options_(options) {}

EventSource::Outcome TcpSource::next(Chunk& chunk) {
  if (!is_connected()) {
    std::this_thread::sleep_for(kIdle);
    return Outcome::kNothingYet;
  }
  try {
    const DescriptorEvents::Outcome outcome = events_->next(chunk.packet);
    check_sensor();
    if (outcome == DescriptorEvents::Outcome::kEnd) {
      disconnect("it closed the connection");
      return Outcome::kNothingYet;
    }
    if (outcome == DescriptorEvents::Outcome::kNothingYet) return Outcome::kNothingYet;
  } catch (const EventFileError& error) {
    disconnect(error.what());
    return Outcome::kNothingYet;
  }
  place(chunk, time_, is_new_clock_);
  return Outcome::kEvents;
}

bool TcpSource::is_connected() {
  if (events_) return true;
  socket_ = link_->connect();
  if (!socket_.is_open()) return false;
  events_.emplace(socket_.number(), link_->name(), options_);
  time_.begin_new_clock(1);
  is_new_clock_ = true;
  return true;
}

void TcpSource::disconnect(const std::string& reason) {
  ++disconnections_;
  dropped_before_ += events_->dropped();
  malformed_before_ += events_->stream().counters().malformed_words;
  events_.reset();
  socket_ = {};
  link_->note_end(reason);
}

// Another sensor at the same address would not match the events published before.
void TcpSource::check_sensor() {
  const auto sensor = events_->stream().sensor_size();
  if (!sensor) return;
  if (sensor_ && *sensor_ != *sensor) throw EventFileError("the sensor's size has changed");
  sensor_ = sensor;
}

std::string TcpSource::waiting_for() const {
  return events_ ? "events from " + link_->name() : link_->waiting_for();
}

std::int64_t TcpSource::events_dropped() const {
  return dropped_before_ + (events_ ? events_->dropped() : 0);
}

std::int64_t TcpSource::malformed_words() const {
  return malformed_before_ + (events_ ? events_->stream().counters().malformed_words : 0);
}

}  // namespace puck
