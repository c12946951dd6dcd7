#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "common/io/event_reader.h"

namespace puck {

/// A time span, counted from the first event.
struct RecordingPart {
  static constexpr std::int64_t kEnd = std::numeric_limits<std::int64_t>::max();

  std::int64_t from_us = 0;
  std::int64_t length_us = kEnd;

  bool is_whole() const { return from_us == 0 && length_us == kEnd; }
};

/// A part of another reader's events, which is read once: it may be a pipe.
class PartReader final : public EventReader {
 public:
  /// Throws std::invalid_argument if the recording ends before the part.
  PartReader(std::unique_ptr<EventReader> events, const RecordingPart& part);

  SensorSize sensor_size() const override { return events_->sensor_size(); }
  bool read(EventPacket& packet, std::size_t max_events) override;
  bool can_rewind() const override { return events_->can_rewind(); }
  void rewind() override;
  /// Of the other reader: events before the part count as read.
  const EventCounters& counters() const override { return events_->counters(); }
  /// Of the other reader, without warnings on events after the part.
  std::vector<std::string> warnings() const override { return events_->warnings(); }

  Timestamp begin() const { return begin_; }

 private:
  bool next(EventPacket& packet, std::size_t max_events);

  std::unique_ptr<EventReader> events_;
  EventPacket early_;  // Read before the part's begin was known, and reaches into it.
  Timestamp begin_;
  Timestamp end_;  // Exclusive.
};

}  // namespace puck
