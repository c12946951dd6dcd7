#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/events/timestamp.h"

namespace puck {

/// An event before the readout.
struct PixelEvent {
  std::int64_t t_us = 0;
  std::uint32_t pixel = 0;  ///< Row-major index.
  bool polarity = false;
};

/// The sensor's readout, of limited rate. When events exceed it, their rows wait in the order of
/// arrival, and a row is read out whole: its events get the time of the readout. A pixel whose
/// event waits cannot fire; its further events are lost.
class SensorReadout {
 public:
  SensorReadout(double rate_mev_s, SensorSize size);

  /// Appends the events that are read out in [from, to) to the packet, in the order of their times;
  /// the others wait. `events` must lie in [from, to), in any order. An empty packet starts at
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

  std::vector<std::uint32_t> first_at_;  ///< Index in `sorted_` at which each µs begins.
  std::vector<PixelEvent> sorted_;

  std::vector<Row> rows_;                ///< Waiting events of each row.
  std::deque<std::uint32_t> row_order_;  ///< Waiting rows, in the order of arrival.
  std::vector<bool> is_waiting_;         ///< Whether each pixel has a waiting event.
  double credit_ = 0;                    ///< Events that may be read out now.
};

}  // namespace puck
