#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"

namespace puck {

struct PixelPlace {
  int x = 0;
  int y = 0;

  friend constexpr bool operator==(PixelPlace, PixelPlace) = default;
};

/// Pixels whose events carry no information, because they fire all the time.
class PixelMask {
 public:
  /// An empty mask, valid for any sensor.
  PixelMask() = default;
  /// Throws std::invalid_argument for an invalid sensor or a pixel outside it. Duplicate pixels are
  /// allowed.
  PixelMask(SensorSize sensor, std::span<const PixelPlace> pixels);

  /// {0, 0}: any sensor.
  SensorSize sensor() const { return sensor_; }
  /// Row by row, without duplicates.
  const std::vector<PixelPlace>& pixels() const { return pixels_; }

  bool covers(int x, int y) const {
    return sensor_.contains(x, y) && covered_[index_of(x, y)] != 0;
  }

  /// Throws std::invalid_argument when the mask is for another sensor than the events. `name`: the
  /// mask's name in the message.
  void check_sensor(SensorSize events, std::string_view name) const;

  /// Removes the events of masked pixels from the packet, which may become empty; returns their
  /// number.
  std::int64_t remove_from(EventPacket& packet) const;

 private:
  std::size_t index_of(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(sensor_.width) +
           static_cast<std::size_t>(x);
  }

  SensorSize sensor_;
  std::vector<PixelPlace> pixels_;
  std::vector<std::uint8_t> covered_;
};

}  // namespace puck
