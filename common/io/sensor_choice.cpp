#include "common/io/sensor_choice.h"

#include <stdexcept>

#include "common/io/event_checks.h"

namespace puck {
namespace {

std::string text_of_size(SensorSize size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

}  // namespace

SensorSize choose_sensor(const std::string& name, std::optional<SensorSize> stated,
                         std::optional<SensorSize> of_camera, const EventFileOptions& options) {
  const bool is_asked = options.sensor != SensorSize{};
  if (stated && is_asked && options.sensor != *stated) {
    throw EventFileError(name + ": says that the sensor is " + text_of_size(*stated) +
                         ", the options that it is " + text_of_size(options.sensor));
  }
  const SensorSize sensor = stated      ? *stated
                            : is_asked  ? options.sensor
                            : of_camera ? *of_camera
                                        : options.fallback_sensor;
  if (sensor == SensorSize{}) {
    throw SensorUnknownError(name +
                             ": does not say how large the sensor is; give width and height "
                             "(--width and --height, or camera.width and camera.height)");
  }
  try {
    return checked_sensor(sensor);
  } catch (const std::invalid_argument& error) {
    throw EventFileError(name + ": " + error.what());
  }
}

}  // namespace puck
