#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "common/events/event_packet.h"
#include "common/events/pixel_mask.h"
#include "common/events/sensor_size.h"
#include "common/vision/geometry/region.h"

namespace puck {

/// What is left of a recording when it is converted.
struct EventFilterParams {
  static constexpr std::int64_t kEnd = std::numeric_limits<std::int64_t>::max();

  std::int64_t from_us = 0;       ///< Since the first event …
  std::int64_t length_us = kEnd;  ///< … and from there on.
  std::optional<Region> crop;     ///< Becomes the whole sensor.
  bool rotate_180 = false;        ///< After the crop.
  bool start_at_zero = false;     ///< Times count from the first event that is left.
  PixelMask mask;                 ///< Pixels whose events are left out.
};

/// Events that were left out, by reason.
struct LeftOut {
  std::int64_t before = 0;
  std::int64_t after = 0;  ///< Only those that were read.
  std::int64_t masked = 0;
  std::int64_t outside_crop = 0;

  std::int64_t sum() const { return before + after + masked + outside_crop; }
};

/// Takes events out of packets and moves the others.
class EventFilter {
 public:
  /// Throws std::invalid_argument for a crop or a mask that does not fit the sensor.
  EventFilter(const EventFilterParams& params, SensorSize sensor);

  SensorSize sensor() const { return out_; }

  /// Changes the packet, which may become empty. Returns false when the part is over; what follows
  /// need not be read.
  bool apply(EventPacket& packet);

  const LeftOut& left_out() const { return left_out_; }
  /// From the first event to the newest of all, µs.
  std::int64_t span_us() const { return first_ ? newest_ - *first_ : 0; }

 private:
  EventFilterParams params_;
  Region crop_;
  SensorSize out_;
  std::optional<Timestamp> first_;
  Timestamp newest_;
  std::optional<Timestamp> zero_;  // Becomes time 0.
  LeftOut left_out_;
};

}  // namespace puck
