#include "tools/calibrate/size_command.h"

#include <cstdio>
#include <stdexcept>

#include "common/calibration/size_calibration.h"
#include "common/io/annotation_file.h"
#include "common/io/size_model_file.h"

namespace puck {
namespace {

void print_residuals(const char* model, const SizeResiduals& width, const SizeResiduals& height) {
  std::printf("%-16s %9.3f %8.3f %10.3f %8.3f\n", model, width.rms_px, width.max_px, height.rms_px,
              height.max_px);
}

void print_disc(const DiscModel& disc) {
  if (!disc.has_perspective()) {
    std::printf("the sizes grow too little towards the camera to estimate its tilt\n");
    return;
  }
  std::printf(
      "the disc implies a camera that is tilted down by %.1f deg, with a focal length of "
      "%.0f px, and a puck %.2f diameters thick\n",
      disc.tilt_deg(), disc.focal_px(), disc.thickness);
}

void print_coverage(const SizeCalibration& calibration, SensorSize sensor) {
  const Pixel from = calibration.from;
  const Pixel to = calibration.to;
  std::printf("centres lie in x %.0f to %.0f, y %.0f to %.0f", from.x, to.x, from.y, to.y);
  if (sensor == SensorSize{}) {
    std::printf(" (give --width and --height for the share of the image)\n");
  } else {
    std::printf(": %.0f %% of the image's width, %.0f %% of its height\n",
                100 * (to.x - from.x) / sensor.width, 100 * (to.y - from.y) / sensor.height);
  }
  const PuckSizeModel& model = calibration.planes.model;
  std::printf("sizes are kept to %.1f to %.1f px of width, %.1f to %.1f px of height\n",
              model.smallest.width, model.largest.width, model.smallest.height,
              model.largest.height);
}

void print(const SizeCalibration& calibration, std::size_t rows, SensorSize sensor) {
  std::printf("%zu annotations, %zu left out\n", rows, calibration.outliers.size());
  for (const SizeOutlier& outlier : calibration.outliers) {
    const Annotation& a = outlier.annotation;
    std::printf(
        "  row %zu (t %lld us, at %.1f, %.1f): %.1f x %.1f px; the other rows imply %.1f x "
        "%.1f\n",
        outlier.row, static_cast<long long>(a.time.us), a.centre.x, a.centre.y, a.size.width,
        a.size.height, outlier.expected.width, outlier.expected.height);
  }
  std::printf("residuals, px    width rms      max height rms      max\n");
  print_residuals("Equation (2)", calibration.planes.width, calibration.planes.height);
  print_residuals("disc on a plane", calibration.disc.width, calibration.disc.height);
  print_disc(calibration.disc.model);
  std::printf("%s\n", calibration.model.disc
                          ? "the disc is written beside Equation (2): presets correlation and "
                            "default use it"
                          : "the disc is not written: too few annotations, a larger error than "
                            "Equation (2), or an impossible camera pose");
  if (calibration.model.wall_of_width() <= 0) {
    std::printf(
        "the annotations outline the puck's top face only; the tracker searches for the side "
        "wall below it\n");
  }
  print_coverage(calibration, sensor);
  for (const std::string& warning : calibration.warnings) {
    std::printf("warning: %s\n", warning.c_str());
  }
}

}  // namespace

void calibrate_size(const SizeCommand& command, const std::string& typed) {
  if (command.sensor != SensorSize{} && !command.sensor.is_valid()) {
    throw std::invalid_argument("--width and --height must be given together, 1 to " +
                                std::to_string(SensorSize::kMax) + " px");
  }
  const std::vector<Annotation> annotations = read_annotation_file(command.annotations);
  const SizeCalibration calibration = calibrate_size(annotations, command.sensor);
  write_size_model_file(command.output, calibration.model, typed);
  print(calibration, annotations.size(), command.sensor);
}

}  // namespace puck
