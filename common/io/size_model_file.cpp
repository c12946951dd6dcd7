#include "common/io/size_model_file.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "common/io/calibration_text.h"
#include "common/io/config.h"
#include "common/io/toml_entries.h"

namespace puck {
namespace {

struct Coefficient {
  const char* key = nullptr;
  double PuckSizeModel::*member = nullptr;
};

constexpr std::array<Coefficient, 6> kCoefficients{{
    {"size_model.width_0", &PuckSizeModel::width_0},
    {"size_model.width_x", &PuckSizeModel::width_x},
    {"size_model.width_y", &PuckSizeModel::width_y},
    {"size_model.height_0", &PuckSizeModel::height_0},
    {"size_model.height_x", &PuckSizeModel::height_x},
    {"size_model.height_y", &PuckSizeModel::height_y},
}};

struct DiscNumber {
  const char* key = nullptr;
  double DiscModel::*member = nullptr;
  double lowest = 0;
};

constexpr double kLargest = 1e4;
constexpr std::array<DiscNumber, 7> kDiscNumbers{{
    {"disc.width_0", &DiscModel::width_0, -kLargest},
    {"disc.width_x", &DiscModel::width_x, -kLargest},
    {"disc.width_y", &DiscModel::width_y, -kLargest},
    {"disc.face_on_px", &DiscModel::face_on_px, DiscModel::kSmallestWidth_px},
    {"disc.thickness", &DiscModel::thickness, 0},
    {"disc.principal_x_px", &DiscModel::principal_x_px, -kLargest},
    {"disc.principal_y_px", &DiscModel::principal_y_px, -kLargest},
}};

struct RangeLimit {
  const char* key = nullptr;
  PuckSize PuckSizeModel::*which = nullptr;
  double PuckSize::*side = nullptr;
};

constexpr std::array<RangeLimit, 4> kRangeLimits{{
    {"size_range.smallest_width", &PuckSizeModel::smallest, &PuckSize::width},
    {"size_range.smallest_height", &PuckSizeModel::smallest, &PuckSize::height},
    {"size_range.largest_width", &PuckSizeModel::largest, &PuckSize::width},
    {"size_range.largest_height", &PuckSizeModel::largest, &PuckSize::height},
}};
constexpr double kSmallestLimitPx = 1;
constexpr double kLargestLimitPx = SensorSize::kMax;

void read_range(Config& config, PuckSizeModel& model) {
  for (const RangeLimit& limit : kRangeLimits) {
    config.read(limit.key, model.*limit.which.*limit.side, kSmallestLimitPx, kLargestLimitPx);
  }
  for (double PuckSize::*side : {&PuckSize::width, &PuckSize::height}) {
    if (model.smallest.*side <= model.largest.*side) continue;
    config.fail(
        side == &PuckSize::width ? "size_range.smallest_width" : "size_range.smallest_height",
        "must not be above the largest");
  }
  config.read("size_range.sensor_width", model.sensor.width, 0, SensorSize::kMax);
  config.read("size_range.sensor_height", model.sensor.height, 0, SensorSize::kMax);
}

// The size would be clamped to the smallest everywhere, and specks detected as the puck.
void refuse_sizeless(const Config& config, double at_corner, double along_x, double along_y,
                     const std::string& key) {
  if (at_corner > 0 || along_x > 0 || along_y > 0) return;
  const std::string side = key.substr(key.find('.') + 1);
  config.fail(key + "_0", "must be above 0, or " + side + "_x or " + side + "_y: the puck has no " +
                              side + " anywhere in the image");
}

std::optional<DiscModel> read_disc(Config& config) {
  const auto is_there = [&](const DiscNumber& number) { return config.has(number.key); };
  if (std::none_of(kDiscNumbers.begin(), kDiscNumbers.end(), is_there)) return std::nullopt;
  DiscModel disc;
  for (const DiscNumber& number : kDiscNumbers) {
    if (!is_there(number)) config.fail(number.key, "is missing");
    config.read(number.key, disc.*number.member, number.lowest, kLargest);
  }
  refuse_sizeless(config, disc.width_0, disc.width_x, disc.width_y, "disc.width");
  return disc;
}

std::string entry(std::string_view key, const std::string& value) {
  return std::string(key.substr(key.find('.') + 1)) + " = " + value + "\n";
}

}  // namespace

PuckSizeModel read_size_model_file(const std::filesystem::path& path) {
  Config config = Config::from_file(path);
  PuckSizeModel model;
  for (const Coefficient& coefficient : kCoefficients) {
    if (!config.has(coefficient.key)) config.fail(coefficient.key, "is missing");
    config.read(coefficient.key, model.*coefficient.member, -kLargest, kLargest);
  }
  refuse_sizeless(config, model.width_0, model.width_x, model.width_y, "size_model.width");
  refuse_sizeless(config, model.height_0, model.height_x, model.height_y, "size_model.height");
  model.disc = read_disc(config);
  read_range(config, model);
  return model;
}

std::string size_model_text(const PuckSizeModel& model, std::string_view provenance) {
  std::string text = toml_comment(provenance) +
                     "# Full axes of the puck's ellipse in the image: px at the top left corner, "
                     "and px per px along x and y.\n[size_model]\n";
  for (const Coefficient& coefficient : kCoefficients) {
    text += entry(coefficient.key, toml_number(model.*coefficient.member));
  }
  if (model.disc) {
    text +=
        "# Perspective model of a disc on a plane, which [size_model] approximates. px, px per px; "
        "thickness in diameters.\n[disc]\n";
    for (const DiscNumber& number : kDiscNumbers) {
      text += entry(number.key, toml_number(*model.disc.*number.member));
    }
  }
  text +=
      "# Limits of the size from any model, px. Sensor: 0 if not known.\n"
      "[size_range]\n";
  for (const RangeLimit& limit : kRangeLimits) {
    text += entry(limit.key, toml_number(model.*limit.which.*limit.side));
  }
  text += entry("sensor_width", std::to_string(model.sensor.width));
  text += entry("sensor_height", std::to_string(model.sensor.height));
  return text;
}

void write_size_model_file(const std::filesystem::path& path, const PuckSizeModel& model,
                           std::string_view provenance) {
  write_calibration_text(path, size_model_text(model, provenance));
}

}  // namespace puck
