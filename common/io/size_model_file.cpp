#include "common/io/size_model_file.h"

#include <array>
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
constexpr double kLargest = 1e4;

}  // namespace

PuckSizeModel read_size_model_file(const std::filesystem::path& path) {
  Config config = Config::from_file(path);
  PuckSizeModel model;
  for (const Coefficient& coefficient : kCoefficients) {
    if (!config.has(coefficient.key)) config.fail(coefficient.key, "is missing");
    config.read(coefficient.key, model.*coefficient.member, -kLargest, kLargest);
  }
  return model;
}

std::string size_model_text(const PuckSizeModel& model, std::string_view provenance) {
  std::string text = toml_comment(provenance) +
                     "# Full axes of the puck's ellipse in the image: px at the top left corner, "
                     "and px per px along x and y.\n[size_model]\n";
  for (const Coefficient& coefficient : kCoefficients) {
    const std::string_view key(coefficient.key);
    text += std::string(key.substr(key.find('.') + 1)) + " = " +
            toml_number(model.*coefficient.member) + "\n";
  }
  return text;
}

void write_size_model_file(const std::filesystem::path& path, const PuckSizeModel& model,
                           std::string_view provenance) {
  write_calibration_text(path, size_model_text(model, provenance));
}

}  // namespace puck
