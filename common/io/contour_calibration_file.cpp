#include "common/io/contour_calibration_file.h"

#include "common/io/calibration_text.h"
#include "common/io/config.h"
#include "common/io/toml_entries.h"

namespace puck {

std::optional<ContourCalibration> read_contour_calibration(const std::filesystem::path& path) {
  constexpr double kLongestLagUs = 50'000;
  constexpr double kLargestWallShare = 1;
  constexpr double kLargestGrowthPx = 20;
  constexpr double kLongestTrailPx = 5;
  constexpr double kLargestLeanDeg = 40;
  Config config = Config::from_file(path);
  if (!config.has("contour.lag_us") && !config.has("contour.wall_share") &&
      !config.has("contour.grow_px") && !config.has("contour.trail_px") &&
      !config.has("contour.lean_deg")) {
    return std::nullopt;
  }
  ContourCalibration calibration;
  config.read("contour.lag_us", calibration.lag_us, -kLongestLagUs, kLongestLagUs);
  config.read("contour.wall_share", calibration.wall_share, -kLargestWallShare, kLargestWallShare);
  config.read("contour.grow_px", calibration.grow_px, -kLargestGrowthPx, kLargestGrowthPx);
  config.read("contour.trail_px", calibration.trail_px, -kLongestTrailPx, kLongestTrailPx);
  config.read("contour.lean_deg", calibration.lean_deg, -kLargestLeanDeg, kLargestLeanDeg);
  return calibration;
}

std::string contour_calibration_text(const ContourCalibration& calibration,
                                     std::string_view provenance) {
  return toml_comment(provenance) +
         "# Where the contour's events lie relative to the puck's ellipse: late by lag_us, and\n"
         "# trail_px behind at any speed; on a ring larger by grow_px in both axes and lower by\n"
         "# wall_share times the width, with the same upper edge. lean_deg, the ellipse's turn\n"
         "# within its box, is not fitted.\n"
         "[contour]\nlag_us = " +
         toml_number(calibration.lag_us) + "\nwall_share = " + toml_number(calibration.wall_share) +
         "\ngrow_px = " + toml_number(calibration.grow_px) +
         "\ntrail_px = " + toml_number(calibration.trail_px) +
         "\nlean_deg = " + toml_number(calibration.lean_deg) + "\n";
}

}  // namespace puck
