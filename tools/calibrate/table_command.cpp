#include "tools/calibrate/table_command.h"

#include <cstdio>
#include <stdexcept>
#include <vector>

#include "common/calibration/camera_fit.h"
#include "common/calibration/homography_fit.h"
#include "common/io/correspondence_file.h"
#include "common/io/table_file.h"

namespace puck {
namespace {

std::optional<Pixel> principal_point_of(const TableCommand& command) {
  if (command.principal_point) {
    return Pixel{(*command.principal_point)[0], (*command.principal_point)[1]};
  }
  if (command.sensor.width > 0 && command.sensor.height > 0) {
    return Pixel{(command.sensor.width - 1) / 2.0, (command.sensor.height - 1) / 2.0};
  }
  return std::nullopt;
}

std::optional<PinholeCamera> fit_camera(const TableCommand& command, const HomographyFit& fit,
                                        const std::vector<Correspondence>& rows) {
  const std::optional<Pixel> principal_point = principal_point_of(command);
  if (!principal_point) {
    if (command.focal_px || command.puck_height_m != 0 ||
        command.pivot_m != PinholeCamera{}.pivot_m) {
      throw std::invalid_argument(
          "the principal point is unknown: give --width and --height of the sensor, or "
          "--principal-point");
    }
    return std::nullopt;
  }
  if (command.focal_px) return PinholeCamera{*command.focal_px, *principal_point, command.pivot_m};
  const FocalLengthFit focal = fit_focal_length(fit.homography, *principal_point, rows);
  std::printf("focal length %.1f px; 1 px of error in the markings moves it by %.1f px\n",
              focal.focal_px, focal.focal_px * focal.sigma_per_px);
  std::printf("residual of a camera without distortion %.3f px\n", focal.rms_px);
  return PinholeCamera{focal.focal_px, *principal_point, command.pivot_m};
}

}  // namespace

void calibrate_table(const TableCommand& command, const std::string& typed) {
  const std::vector<Correspondence> rows = read_correspondence_file(command.correspondences);
  const HomographyFit fit = fit_homography(rows);
  std::printf("%zu correspondences\n", rows.size());
  std::printf("residual        rms       max\n");
  std::printf("image, px  %8.3f  %8.3f\n", fit.rms_px, fit.max_px);
  std::printf("table, mm  %8.3f  %8.3f\n", fit.rms_m * 1e3, fit.max_m * 1e3);
  if (rows.size() == 4) {
    std::printf("four correspondences always fit exactly: add more to see their errors\n");
  }
  TableCalibration calibration{fit.homography, TableGeometry{}, fit_camera(command, fit, rows)};
  if (calibration.camera) {
    // The tracked centre is that of the puck's whole outline, halfway up.
    calibration.table_from_image =
        TableCamera(fit.homography, *calibration.camera).raised(command.puck_height_m / 2);
  }
  write_table_file(command.output, calibration, typed);
}

}  // namespace puck
