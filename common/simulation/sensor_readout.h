#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/events/timestamp.h"

namespace puck {

/// An event as a pixel makes it.
struct PixelEvent {
  std::int64_t t_us = 0;
  std::uint32_t pixel = 0;  ///< Row by row.
  bool polarity = false;
};

/// The way of the events out of the sensor, which only so many can go in a µs. When more come,
/// their rows wait in the order in which they came, and a row goes out whole: its events get the
/// time at which it does. A pixel whose event waits can make no other; such ones are lost.
class SensorReadout {
 public:
  SensorReadout(double rate_mev_s, SensorSize size);

  /// Appends those of the events that come out in [from, to) to the packet, in the order of their
  /// times; the rest waits. The events lie in [from, to), in any order. An empty packet starts at
  /// `from`.
  void read(std::span<const PixelEvent> events, Timestamp from, Timestamp to, EventPacket& packet);

  std::int64_t lost() const { return lost_; }

 private:
  using Row = std::vector<PixelEvent>;

  /// Fills `sorted_` and `first_at_`.
  void sort(std::span<const PixelEvent> events, Timestamp from, Timestamp to);
  bool is_congested(std::size_t slots) const;
  void queue(const PixelEvent& event);
  void put(const PixelEvent& event, std::int64_t t_us, EventPacket& packet) const;

  double rate_per_us_;
  std::uint32_t width_;
  std::int64_t lost_ = 0;

  std::vector<std::uint32_t> first_at_;  ///< Where each µs begins in `sorted_`.
  std::vector<PixelEvent> sorted_;

  std::vector<Row> rows_;            ///< What waits in each row …
  std::deque<std::uint32_t> turns_;  ///< … and the rows' order.
  std::vector<bool> is_waiting_;     ///< Each pixel.
  double credit_ = 0;                ///< Events that may go out now.
};

}  // namespace puck
