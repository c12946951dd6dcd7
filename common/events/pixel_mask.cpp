#include "common/events/pixel_mask.h"

#include <stdexcept>
#include <string>

namespace puck {
namespace {

std::string text_of(SensorSize sensor) {
  return std::to_string(sensor.width) + "x" + std::to_string(sensor.height) + " px";
}

}  // namespace

PixelMask::PixelMask(SensorSize sensor, std::span<const PixelPlace> pixels) : sensor_(sensor) {
  if (!sensor.is_valid()) {
    throw std::invalid_argument("a pixel mask needs a sensor of 1 to " +
                                std::to_string(SensorSize::kMax) + " px each way, got " +
                                text_of(sensor));
  }
  covered_.resize(static_cast<std::size_t>(sensor.width) *
                  static_cast<std::size_t>(sensor.height));
  for (const PixelPlace pixel : pixels) {
    if (!sensor.contains(pixel.x, pixel.y)) {
      throw std::invalid_argument("the masked pixel (" + std::to_string(pixel.x) + ", " +
                                  std::to_string(pixel.y) + ") lies outside the sensor of " +
                                  text_of(sensor));
    }
    covered_[index_of(pixel.x, pixel.y)] = 1;
  }
  for (int y = 0; y < sensor.height; ++y) {
    for (int x = 0; x < sensor.width; ++x) {
      if (covers(x, y)) pixels_.push_back({x, y});
    }
  }
}

void PixelMask::check_sensor(SensorSize events, std::string_view name) const {
  if (sensor_ == SensorSize{} || sensor_ == events) return;
  throw std::invalid_argument(std::string(name) + " is of a sensor of " + text_of(sensor_) +
                              ", the events are of one of " + text_of(events));
}

std::int64_t PixelMask::remove_from(EventPacket& packet) const {
  if (pixels_.empty()) return 0;
  return static_cast<std::int64_t>(
      std::erase_if(packet.events, [this](const Event& e) { return covers(e.x, e.y); }));
}

}  // namespace puck
