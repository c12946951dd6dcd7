#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/events/event_packet.h"
#include "common/events/pixel_mask.h"
#include "common/events/sensor_size.h"

namespace puck {

struct HotPixel {
  PixelPlace place;
  double rate_hz = 0;
  double active_share = 0;  ///< Share of the recording's slices of 100 ms in which it fired.
};

struct HotPixelReport {
  std::vector<HotPixel> pixels;  ///< Noisiest first.
  std::int64_t events = 0;       ///< Events of all pixels.
  std::int64_t hot_events = 0;
  double seconds = 0;
  double median_rate_hz = 0;  ///< Over all pixels.
};

/// Detects pixels that fire without a change of light. A hot pixel fires at least 20 times, more
/// than five times as often as its neighbourhood explains, and all the time: an edge also sweeps
/// over the neighbours, and fires only while it passes. The neighbourhood explains the rate of the
/// third busiest of the 24 pixels around, so that up to three hot pixels may be adjacent.
class HotPixelFinder {
 public:
  explicit HotPixelFinder(SensorSize sensor);

  /// Packets in the order of their times. Ignores events outside the sensor.
  void add(const EventPacket& packet);

  /// Throws std::invalid_argument for less than a second of events.
  HotPixelReport find() const;

 private:
  std::uint32_t neighbourhood_explains(int x, int y) const;
  std::size_t index_of(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(sensor_.width) +
           static_cast<std::size_t>(x);
  }

  struct PixelRecord {
    std::uint32_t events = 0;
    std::uint32_t active_slices = 0;
    std::int64_t last_slice = -1;
  };

  SensorSize sensor_;
  std::vector<PixelRecord> records_;
  std::optional<Timestamp> first_;
  Timestamp last_;
  std::int64_t events_ = 0;
};

}  // namespace puck
