#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/io/event_decoder.h"

namespace puck {

/// Collects a reader's events: drops those outside the sensor or too late, fills the caller's
/// packet, and keeps the rest for the next packet.
class EventSink {
 public:
  /// `reorder_us`: events up to so much older than the newest are passed on, out of order. Throws
  /// std::invalid_argument when `sensor` is not a valid size.
  explicit EventSink(SensorSize sensor, std::int64_t reorder_us = 0);

  /// Starts to fill `packet` up to `max_events`, first with the backlog. The packet must stay until
  /// the next `begin`.
  void begin(EventPacket& packet, std::size_t max_events);

  /// Whether the packet takes another event.
  bool has_room() const { return !has_backlog() && packet_->events.size() < max_events_; }
  bool has_backlog() const { return backlog_taken_ < backlog_.size(); }

  /// Appends the event to the packet, or to the backlog if the packet is full. Drops and counts an
  /// event outside the sensor or too much older than the newest.
  void append(Timestamp time, int x, int y, bool brighter) {
    if (!sensor_.contains(x, y)) {
      ++counters_.outside_sensor;
      return;
    }
    if (time < newest_ && time < oldest_allowed_) {
      ++counters_.backwards;
      return;
    }
    if (time >= newest_) set_newest(time);
    const TimedEvent event{time, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                           brighter};
    if (!has_room() || !hand_out(event)) backlog_.push_back(event);
  }

  /// Number of events at `time` that a decoder may pass to `append_run` directly. 0 when the packet
  /// is empty, or when such events need `append`: older than the newest, or too long after the
  /// packet's start.
  std::size_t room_at(Timestamp time) const {
    if (!has_room() || packet_->empty() || time < newest_) return 0;
    const std::int64_t offset_us = time - packet_->start;
    if (offset_us < 0 || offset_us > std::numeric_limits<std::uint32_t>::max()) return 0;
    return max_events_ - packet_->events.size();
  }
  /// Origin of the offsets for `append_run`.
  Timestamp packet_start() const { return packet_->start; }
  /// Of all accepted events, also of those in the backlog.
  Timestamp newest() const { return newest_; }
  SensorSize sensor() const { return sensor_; }

  /// Appends events without checks: they must be inside the sensor, in order, not older than the
  /// newest, and no more than `room_at` allows.
  void append_run(std::span<const Event> events) {
    if (events.empty()) return;
    packet_->events.insert(packet_->events.end(), events.begin(), events.end());
    set_newest(packet_->newest());
    counters_.events += static_cast<std::int64_t>(events.size());
  }

  EventCounters& counters() { return counters_; }
  const EventCounters& counters() const { return counters_; }

 private:
  struct TimedEvent {
    Timestamp time;
    std::uint16_t x = 0;
    std::uint16_t y = 0;
    bool brighter = false;
  };

  void set_newest(Timestamp time) {
    newest_ = time;
    oldest_allowed_ = {time.us - reorder_us_};
  }

  // Returns false when the event lies before the packet's start or too long after it.
  bool hand_out(const TimedEvent& event) {
    if (packet_->empty()) packet_->start = event.time;
    const std::int64_t offset_us = event.time - packet_->start;
    if (offset_us < 0 || offset_us > std::numeric_limits<std::uint32_t>::max()) return false;
    Event out;
    out.x = event.x;
    out.y = event.y & 0x7fff;
    out.polarity = event.brighter ? 1 : 0;
    out.offset_us = static_cast<std::uint32_t>(offset_us);
    packet_->events.push_back(out);
    ++counters_.events;
    return true;
  }

  SensorSize sensor_;
  EventPacket* packet_ = nullptr;
  std::size_t max_events_ = 0;
  std::int64_t reorder_us_ = 0;
  Timestamp newest_{std::numeric_limits<std::int64_t>::min()};
  Timestamp oldest_allowed_{std::numeric_limits<std::int64_t>::min()};
  std::vector<TimedEvent> backlog_;
  std::size_t backlog_taken_ = 0;  // Number of backlog events already handed out.
  EventCounters counters_;
};

}  // namespace puck
