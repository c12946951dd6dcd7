#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/events/pixel_mask.h"
#include "common/io/event_reader.h"

namespace puck {

/// Another reader's events without those of masked pixels.
class MaskedReader final : public EventReader {
 public:
  /// Throws std::invalid_argument when the mask is for another sensor; `name`: the mask's name in
  /// the message.
  MaskedReader(std::unique_ptr<EventReader> events, PixelMask mask, std::string_view name);

  SensorSize sensor_size() const override { return events_->sensor_size(); }
  bool read(EventPacket& packet, std::size_t max_events) override;
  void rewind() override;
  /// Of the other reader: masked events count as read.
  const EventCounters& counters() const override { return events_->counters(); }
  std::vector<std::string> warnings() const override;

  std::int64_t masked_events() const { return masked_events_; }

 private:
  std::unique_ptr<EventReader> events_;
  PixelMask mask_;
  std::int64_t masked_events_ = 0;
};

}  // namespace puck
