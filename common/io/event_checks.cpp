#include "common/io/event_checks.h"

#include <stdexcept>
#include <string>

namespace puck {

SensorSize checked_sensor(SensorSize sensor) {
  if (!sensor.is_valid()) {
    throw std::invalid_argument("a sensor must be from 1 x 1 to 2048 x 2048 pixels, got " +
                                std::to_string(sensor.width) + " x " +
                                std::to_string(sensor.height));
  }
  return sensor;
}

void check_event(const Event& event, Timestamp time, SensorSize sensor, Timestamp newest) {
  if (!sensor.contains(event.x, event.y)) {
    throw std::invalid_argument("an event at (" + std::to_string(event.x) + ", " +
                                std::to_string(event.y) + ") lies outside the sensor");
  }
  if (time < newest) {
    throw std::invalid_argument("an event at " + std::to_string(time.us) +
                                " µs is older than the one before it");
  }
}

void PauseSum::add(std::int64_t pause_us, std::string_view format) {
  ++events_;
  sum_us_ += pause_us;
  if (sum_us_ <= kMostUs + events_ * kMostUsAnEvent) return;
  throw std::invalid_argument(
      std::string(format) + " holds pauses of up to 24 h in all, and 0.1 s an event more, got " +
      std::to_string(sum_us_ / 3'600'000'000) + " h in " + std::to_string(events_) +
      " events: are times damaged? (puck-info lists the gaps)");
}

}  // namespace puck
