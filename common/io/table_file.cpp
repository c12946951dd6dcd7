#include "common/io/table_file.h"

#include <array>
#include <stdexcept>
#include <string>

#include "common/io/calibration_text.h"
#include "common/io/toml_entries.h"

namespace puck {
namespace {

struct Length {
  const char* key = nullptr;
  double TableGeometry::*member = nullptr;
};

constexpr std::array<Length, 7> kLengths{{
    {"table.length_m", &TableGeometry::length_m},
    {"table.width_m", &TableGeometry::width_m},
    {"table.goal_width_m", &TableGeometry::goal_width_m},
    {"table.puck_radius_m", &TableGeometry::puck_radius_m},
    {"table.mallet_radius_m", &TableGeometry::mallet_radius_m},
    {"table.robot_line_x_m", &TableGeometry::robot_line_x_m},
    {"table.robot_line_half_m", &TableGeometry::robot_line_half_m},
}};
constexpr const char* kHomographyKey = "table.table_from_image";
constexpr double kShortest = 0.001;
constexpr double kLongest = 10;
constexpr double kLargestCoefficient = 1e12;

}  // namespace

void read_table_geometry(Config& config, TableGeometry& geometry) {
  for (const Length& length : kLengths) {
    config.read(length.key, geometry.*length.member, kShortest, kLongest);
  }
}

TableCalibration read_table_file(const std::filesystem::path& path) {
  Config config = Config::from_file(path);
  if (!config.has(kHomographyKey)) config.fail(kHomographyKey, "is missing");
  std::array<double, 9> coefficients{};
  config.read(kHomographyKey, coefficients, -kLargestCoefficient, kLargestCoefficient);
  TableGeometry geometry;
  read_table_geometry(config, geometry);
  try {
    return {Homography(coefficients), geometry};
  } catch (const std::invalid_argument& error) {
    config.fail(kHomographyKey, std::string("cannot be used: ") + error.what());
  }
}

std::string table_text(const TableCalibration& calibration, std::string_view provenance) {
  std::string text = toml_comment(provenance) +
                     "[table]\n# Homography from the image (px) to the table (m), row by row.\n"
                     "table_from_image = [";
  const auto& coefficients = calibration.table_from_image.table_from_image();
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    if (i > 0) text += ", ";
    text += toml_number(coefficients[i]);
  }
  text += "]\n";
  for (const Length& length : kLengths) {
    const std::string_view key(length.key);
    text += std::string(key.substr(key.find('.') + 1)) + " = " +
            toml_number(calibration.geometry.*length.member) + "\n";
  }
  return text;
}

void write_table_file(const std::filesystem::path& path, const TableCalibration& calibration,
                      std::string_view provenance) {
  write_calibration_text(path, table_text(calibration, provenance));
}

}  // namespace puck
