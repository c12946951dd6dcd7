#include "common/vision/geometry/puck_size_model.h"

#include <array>
#include <cmath>
#include <limits>

namespace puck {
namespace {

std::string text_of(SensorSize sensor) {
  return std::to_string(sensor.width) + "x" + std::to_string(sensor.height);
}

// Rounded to a tenth of a pixel.
std::string text_of(double size_px) {
  if (!(std::abs(size_px) < 1e6)) return "no usable number of";
  const long long tenths = std::llround(std::abs(size_px) * 10);
  std::string text;
  if (size_px < 0 && tenths > 0) text += '-';
  text += std::to_string(tenths / 10);
  text += '.';
  text += std::to_string(tenths % 10);
  return text;
}

std::string text_of(PuckSize size) {
  return text_of(size.width) + " x " + text_of(size.height) + " px";
}

double change(PuckSize from, PuckSize to) {
  const double sum = std::abs(to.width - from.width) + std::abs(to.height - from.height);
  return std::isnan(sum) ? std::numeric_limits<double>::infinity() : sum;
}

}  // namespace

std::vector<std::string> doubts_about(const PuckSizeModel& model, SensorSize sensor) {
  std::vector<std::string> doubts;
  if (model.sensor != SensorSize{} && model.sensor != sensor) {
    doubts.push_back("the size model was fitted for a sensor of " + text_of(model.sensor) +
                     " px, this one has " + text_of(sensor) +
                     ": check the width and height that were given, or calibrate it anew");
  }
  // Planes have their extremes at the corners; the disc nearly so.
  const double right = sensor.width - 1;
  const double bottom = sensor.height - 1;
  Pixel worst;
  double most = 0;
  for (const Pixel corner :
       std::array{Pixel{0, 0}, Pixel{right, 0}, Pixel{0, bottom}, Pixel{right, bottom}}) {
    const double clamped_by = change(model.extrapolated_at(corner), model.at(corner));
    if (clamped_by > most) {
      most = clamped_by;
      worst = corner;
    }
  }
  if (most > 0) {
    doubts.push_back(
        "the size model says " + text_of(model.extrapolated_at(worst)) + " at (" +
        std::to_string(std::lround(worst.x)) + ", " + std::to_string(std::lround(worst.y)) +
        "), where " + text_of(model.at(worst)) +
        " are used: it is extrapolated there; annotate more of the image, unless the puck "
        "is never there");
  }
  return doubts;
}

}  // namespace puck
