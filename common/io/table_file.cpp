#include "common/io/table_file.h"

#include <algorithm>
#include <array>
#include <optional>
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
constexpr std::array<const char*, 3> kCameraKeys{"camera.focal_px", "camera.principal_x_px",
                                                 "camera.principal_y_px"};
constexpr const char* kPivotKey = "camera.pivot_m";

struct Constant {
  const char* key = nullptr;
  double MotionConstants::*member = nullptr;
  double highest = 1;
};

constexpr std::array<Constant, 3> kConstants{{
    {"motion.damping_per_s", &MotionConstants::damping_per_s, 100},
    {"motion.rail_restitution", &MotionConstants::rail_restitution},
    {"motion.rail_grip", &MotionConstants::rail_grip},
}};

std::string_view last_part(std::string_view key) { return key.substr(key.find('.') + 1); }

std::optional<PinholeCamera> read_camera(Config& config) {
  const auto is_set = [&](const char* key) { return config.has(key); };
  if (!config.has(kPivotKey) && std::none_of(kCameraKeys.begin(), kCameraKeys.end(), is_set)) {
    return std::nullopt;
  }
  for (const char* key : kCameraKeys) {
    if (!config.has(key)) config.fail(key, "is missing: [camera] needs it");
  }
  PinholeCamera camera;
  config.read(kCameraKeys[0], camera.focal_px, 10, 100'000);
  config.read(kCameraKeys[1], camera.principal_point.x, -100'000, 100'000);
  config.read(kCameraKeys[2], camera.principal_point.y, -100'000, 100'000);
  config.read(kPivotKey, camera.pivot_m, -kLongest, kLongest);
  return camera;
}

std::optional<MotionConstants> read_motion(Config& config) {
  const auto is_set = [&](const Constant& constant) { return config.has(constant.key); };
  if (std::none_of(kConstants.begin(), kConstants.end(), is_set)) return std::nullopt;
  MotionConstants motion;
  for (const Constant& constant : kConstants) {
    if (!is_set(constant)) config.fail(constant.key, "is missing: [motion] needs it");
    config.read(constant.key, motion.*constant.member, 0, constant.highest);
  }
  return motion;
}

template <std::size_t N>
std::string toml_list(const std::array<double, N>& numbers) {
  std::string text = "[";
  for (std::size_t i = 0; i < N; ++i) text += (i > 0 ? ", " : "") + toml_number(numbers[i]);
  return text + "]";
}

std::string camera_text(const PinholeCamera& camera) {
  return "# For a camera that turns: its focal length and the pixel on its optical axis.\n"
         "[camera]\nfocal_px = " +
         toml_number(camera.focal_px) +
         "\nprincipal_x_px = " + toml_number(camera.principal_point.x) +
         "\nprincipal_y_px = " + toml_number(camera.principal_point.y) +
         "\n# Where the head's axes meet, in the home camera's frame: right, down, forwards, m.\n"
         "pivot_m = " +
         toml_list(camera.pivot_m) + "\n";
}

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
  const std::optional<PinholeCamera> camera = read_camera(config);
  config.reject_unknown_in("table");
  config.reject_unknown_in("camera");
  const std::optional<MotionConstants> motion = read_motion(config);
  config.reject_unknown_in("motion");
  try {
    return {Homography(coefficients), geometry, camera, motion};
  } catch (const std::invalid_argument& error) {
    config.fail(kHomographyKey, std::string("cannot be used: ") + error.what());
  }
}

std::string table_text(const TableCalibration& calibration, std::string_view provenance) {
  std::string text =
      toml_comment(provenance) +
      "[table]\n# Homography from the image (px) to the table (m), row by row, of the "
      "plane in which\n# the puck's centre moves.\ntable_from_image = " +
      toml_list(calibration.table_from_image.coefficients()) + "\n";
  for (const Length& length : kLengths) {
    text += std::string(last_part(length.key)) + " = " +
            toml_number(calibration.geometry.*length.member) + "\n";
  }
  if (calibration.camera) text += camera_text(*calibration.camera);
  if (calibration.motion) text += motion_text(*calibration.motion, {});
  return text;
}

std::string motion_text(const MotionConstants& motion, std::string_view provenance) {
  std::string text = toml_comment(provenance) +
                     "# How the puck glides and bounces: the decay rate of its speed, 1/s, and the "
                     "shares of the\n"
                     "# speed across and along a rail that a bounce keeps.\n"
                     "[motion]\n";
  for (const Constant& constant : kConstants) {
    text +=
        std::string(last_part(constant.key)) + " = " + toml_number(motion.*constant.member) + "\n";
  }
  return text;
}

void write_table_file(const std::filesystem::path& path, const TableCalibration& calibration,
                      std::string_view provenance) {
  write_calibration_text(path, table_text(calibration, provenance));
}

}  // namespace puck
