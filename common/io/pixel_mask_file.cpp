#include "common/io/pixel_mask_file.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/io/calibration_text.h"
#include "common/io/config.h"

namespace puck {

PixelMask read_pixel_mask_file(const std::filesystem::path& path) {
  Config config = Config::from_file(path);
  for (const char* key : {"pixel_mask.width", "pixel_mask.height", "pixel_mask.pixels"}) {
    if (!config.has(key)) config.fail(key, "is missing");
  }
  SensorSize sensor;
  config.read("pixel_mask.width", sensor.width, 1, SensorSize::kMax);
  config.read("pixel_mask.height", sensor.height, 1, SensorSize::kMax);
  std::vector<double> numbers;
  config.read("pixel_mask.pixels", numbers, 0, SensorSize::kMax);
  if (numbers.size() % 2 != 0) {
    config.fail("pixel_mask.pixels", "must be pairs of x and y, got an odd number of values");
  }
  std::vector<PixelPlace> pixels;
  for (std::size_t i = 0; i < numbers.size(); i += 2) {
    if (numbers[i] != std::floor(numbers[i]) || numbers[i + 1] != std::floor(numbers[i + 1])) {
      config.fail("pixel_mask.pixels", "must be whole numbers");
    }
    pixels.push_back({static_cast<int>(numbers[i]), static_cast<int>(numbers[i + 1])});
  }
  try {
    return {sensor, pixels};
  } catch (const std::invalid_argument& error) {
    config.fail("pixel_mask.pixels", std::string("cannot be used: ") + error.what());
  }
}

void write_pixel_mask_file(const std::filesystem::path& path, const PixelMask& mask,
                           std::string_view provenance) {
  std::string text = toml_comment(provenance) +
                     "# Pixels whose events are dropped: x and y of each.\n[pixel_mask]\nwidth = ";
  text += std::to_string(mask.sensor().width);
  text += "\nheight = ";
  text += std::to_string(mask.sensor().height);
  text += "\npixels = [\n";
  for (const PixelPlace pixel : mask.pixels()) {
    text += "  ";
    text += std::to_string(pixel.x);
    text += ", ";
    text += std::to_string(pixel.y);
    text += ",\n";
  }
  text += "]\n";
  write_calibration_text(path, text);
}

}  // namespace puck
