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

}  // namespace puck
