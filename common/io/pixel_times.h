#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"

namespace puck {

/// A time for each pixel, in 32 bits instead of 64, with a margin of one pixel around the sensor.
/// Ages up to `longest_us` are exact however long the stream is; greater ones count as greater.
class PixelTimes {
 public:
  /// `longest_us`: 1 to kLongestUs.
  PixelTimes(SensorSize sensor, std::int64_t longest_us);

  static constexpr std::int64_t kLongestUs = 10'000'000;

  /// Forgets all times.
  void clear();

  /// Must come before the stamps of the packet's events from index `first` on. Returns the index
  /// up to which they are valid. Times that go back behind the first one clear the map.
  std::size_t prepare(const EventPacket& packet, std::size_t first);

  /// The time of an event of the packet.
  std::uint32_t stamp_of(const Event& event) const { return packet_start_ + event.offset_us; }
  /// Element of a pixel; its neighbours in a row are beside it, other rows `row_length` away.
  std::uint32_t* at(const Event& event) {
    return stamps_.data() + (event.y + std::size_t{1}) * row_length_ + event.x + 1;
  }
  std::ptrdiff_t row_length() const { return static_cast<std::ptrdiff_t>(row_length_); }

 private:
  void rebase(Timestamp oldest);

  std::size_t row_length_;
  std::int64_t longest_us_;
  std::vector<std::uint32_t> stamps_;  // 0: never, which is longer ago than longest_us_.
  bool has_base_ = false;
  Timestamp base_;                  // The time of stamp 0.
  std::uint32_t packet_start_ = 0;  // Modulo 2^32, since it may be before the base.
};

}  // namespace puck
