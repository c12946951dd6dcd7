#include "common/io/known_sensors.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace puck {
namespace {

struct Camera {
  std::string_view name;
  SensorSize sensor;
};

// Longer names before those that they contain.
constexpr std::array<Camera, 17> kCameras{{
    {"genx320", {320, 320}},
    {"gen4", {1280, 720}},
    {"gen3", {640, 480}},
    {"imx636", {1280, 720}},
    {"imx646", {1280, 720}},
    {"imx637", {640, 512}},
    {"imx647", {640, 512}},
    {"evk4", {1280, 720}},
    {"silkyevcam_hd", {1280, 720}},
    {"davis240", {240, 180}},
    {"davis346", {346, 260}},
    {"davis640", {640, 480}},
    {"dvs128", {128, 128}},
    {"dvxplorer_lite", {320, 240}},
    {"dvxplorer lite", {320, 240}},
    {"dvxplorer", {640, 480}},
    {"atis", {304, 240}},
}};

// By area.
constexpr std::array<SensorSize, 12> kSensors{{
    {128, 128},
    {240, 180},
    {304, 240},
    {320, 240},
    {346, 260},
    {320, 320},
    {640, 480},
    {640, 512},
    {768, 640},
    {1280, 720},
    {1280, 800},
    {1280, 960},
}};

}  // namespace

std::optional<SensorSize> sensor_of_camera(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char character) {
    return static_cast<char>(std::tolower(character));
  });
  for (const Camera& camera : kCameras) {
    if (lower.find(camera.name) != std::string::npos) return camera.sensor;
  }
  return std::nullopt;
}

SensorSize next_known_sensor(SensorSize least) {
  const auto known = std::find_if(kSensors.begin(), kSensors.end(), [&](SensorSize sensor) {
    return sensor.width >= least.width && sensor.height >= least.height;
  });
  return known == kSensors.end() ? least : *known;
}

}  // namespace puck
