#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/io/event_filter.h"

namespace puck {

/// What is left of a recording when it is converted.
struct ConversionFilterParams {
  static constexpr std::int64_t kEnd = std::numeric_limits<std::int64_t>::max();

  std::int64_t from_us = 0;       ///< Since the first event …
  std::int64_t length_us = kEnd;  ///< … and from there on.
  bool start_at_zero = false;     ///< Times count from the first event that is left.
  EventFilterParams events;
};

/// Takes a part of a recording through an event filter.
class ConversionFilter {
 public:
  /// Throws std::invalid_argument for an event filter that does not fit the sensor.
  ConversionFilter(const ConversionFilterParams& params, SensorSize sensor);

  SensorSize sensor() const { return events_.sensor(); }

  /// Changes the packet, which may become empty. Returns false when the part is over; what follows
  /// need not be read.
  bool apply(EventPacket& packet);

  std::int64_t before() const { return before_; }
  /// Only those that were read.
  std::int64_t after() const { return after_; }
  const FilteredEvents& filtered() const { return events_.left_out(); }
  /// From the first event to the newest of all, µs.
  std::int64_t span_us() const { return first_ ? newest_ - *first_ : 0; }

 private:
  bool cut(EventPacket& packet);
  void shift_to_zero(EventPacket& packet);

  ConversionFilterParams params_;
  EventFilter events_;
  std::optional<Timestamp> first_;
  Timestamp newest_;
  std::optional<Timestamp> zero_;  // Becomes time 0.
  std::int64_t before_ = 0;
  std::int64_t after_ = 0;
};

}  // namespace puck
