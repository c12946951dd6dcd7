#include "common/calibration/size_calibration.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace puck {
namespace {

constexpr SensorSize kAnnotatedSensor{640, 480};
constexpr Pixel kImageMiddle{319.5, 239.5};

// A camera 0.8 m above the table, tilted down by 30°, and a puck of 6.5 cm, 1.3 cm thick, whose
// silhouette is sampled from points of its two circles.
class Camera {
 public:
  static constexpr double kFocalPx = 700;
  static constexpr double kTilt = std::numbers::pi / 6;
  static constexpr double kDiameter = 0.065;
  double thickness = 0.013;

  Annotation puck_at(double across_m, double ahead_m) const {
    double left = 1e9;
    double right = -1e9;
    double top = 1e9;
    double bottom = -1e9;
    for (int i = 0; i < 720; ++i) {
      const double angle = std::numbers::pi * (i / 2) / 180;
      const double up = i % 2 == 0 ? 0 : thickness;
      const Pixel p = seen(across_m + kDiameter / 2 * std::cos(angle),
                           ahead_m + kDiameter / 2 * std::sin(angle), up);
      left = std::min(left, p.x);
      right = std::max(right, p.x);
      top = std::min(top, p.y);
      bottom = std::max(bottom, p.y);
    }
    return {{0}, {(left + right) / 2, (top + bottom) / 2}, {right - left, bottom - top}};
  }

  // All over the table.
  std::vector<Annotation> annotations() const {
    std::vector<Annotation> all;
    for (double ahead = 0.75; ahead < 2.3; ahead += 0.25) {
      for (double across = -0.5; across < 0.6; across += 0.25) {
        const Annotation a = puck_at(across, ahead);
        if (a.centre.x > 0 && a.centre.x < 639) all.push_back(a);
      }
    }
    return all;
  }

 private:
  static Pixel seen(double across, double ahead, double up) {
    constexpr double kAbove = 0.8;
    const double drop = kAbove - up;
    const double depth = ahead * std::cos(kTilt) + drop * std::sin(kTilt);
    const double down = drop * std::cos(kTilt) - ahead * std::sin(kTilt);
    return {kImageMiddle.x + kFocalPx * across / depth, kImageMiddle.y + kFocalPx * down / depth};
  }
};

TEST_CASE("the disc on a plane explains a real cylinder's boxes to about a tenth of a pixel") {
  const std::vector<Annotation> annotations = Camera().annotations();
  REQUIRE(annotations.size() > 25);
  const DiscFit fit = fit_disc_model(annotations, kImageMiddle);
  CHECK(fit.width.max_px < 0.25);
  CHECK(fit.height.max_px < 0.25);
  CHECK(fit.model.has_perspective());
  CHECK(fit.model.tilt_deg() == doctest::Approx(30).epsilon(0.03));
  CHECK(fit.model.focal_px() == doctest::Approx(700).epsilon(0.03));
  CHECK(fit.model.thickness == doctest::Approx(0.2).epsilon(0.15));
  // Equation (2) cannot: the height grows quadratically, and the box widens to the sides.
  const SizeFit planes = fit_puck_size_model(annotations);
  CHECK(planes.height.max_px > 3 * fit.height.max_px);
  CHECK(planes.width.max_px > 3 * fit.width.max_px);
}

TEST_CASE("annotations of the face alone give a disc without thickness, with any marking errors") {
  Camera camera;
  camera.thickness = 0;
  std::vector<Annotation> annotations = camera.annotations();
  int half = 1;
  for (Annotation& a : annotations) {
    // Only a wall of negative height would explain these.
    a.size.height -= 0.4 + 0.4 * half;
    half = -half;
  }
  const SizeCalibration calibration = calibrate_size(annotations, kAnnotatedSensor);
  REQUIRE(calibration.model.disc.has_value());
  CHECK(calibration.model.disc->thickness < 0.02);
  CHECK(calibration.model.wall_of_width() == 0);
  CHECK(calibration.model.disc->tilt_deg() == doctest::Approx(30).epsilon(0.1));
}

TEST_CASE("the disc model holds for unannotated pucks, and gives the principal point") {
  const Camera camera;
  const DiscFit fit = fit_disc_model(camera.annotations(), {300, 239.5});
  CHECK(fit.model.principal_x_px == doctest::Approx(kImageMiddle.x).epsilon(0.02));
  for (const double across : {-0.4, 0.1, 0.45}) {
    const Annotation a = camera.puck_at(across, 1.13);
    CHECK(std::abs(fit.model.at(a.centre).width - a.size.width) < 0.3);
    CHECK(std::abs(fit.model.at(a.centre).height - a.size.height) < 0.3);
  }
}

TEST_CASE("a puck of the same size everywhere has a disc model, but no perspective") {
  std::vector<Annotation> annotations;
  for (const Pixel centre : {Pixel{50, 60}, Pixel{500, 80}, Pixel{300, 400}, Pixel{90, 300}}) {
    annotations.push_back({{0}, centre, {30, 30}});
  }
  const DiscFit fit = fit_disc_model(annotations, kImageMiddle);
  CHECK_FALSE(fit.model.has_perspective());
  CHECK(fit.width.max_px < 0.5);
  CHECK(fit.height.max_px < 0.5);
}

TEST_CASE("implausible annotations are named by row and left out; the others are kept") {
  std::vector<Annotation> annotations = Camera().annotations();
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 0.4);
  for (Annotation& a : annotations) {
    a.size.width += noise(random);
    a.size.height += noise(random);
  }
  const PuckSizeModel before = calibrate_size(annotations, kAnnotatedSensor).planes.model;
  annotations[4].size = {annotations[4].size.height, annotations[4].size.width};
  annotations[20].size.width += 40;
  const SizeCalibration calibration = calibrate_size(annotations, kAnnotatedSensor);
  std::vector<std::size_t> rows;
  for (const SizeOutlier& outlier : calibration.outliers) rows.push_back(outlier.row);
  std::sort(rows.begin(), rows.end());
  CHECK(rows == std::vector<std::size_t>{5, 21});
  const SizeOutlier& worst = calibration.outliers.front();
  CHECK(worst.row == 21);
  CHECK(worst.annotation.size.width == annotations[20].size.width);
  CHECK(worst.expected.width == doctest::Approx(annotations[20].size.width - 40).epsilon(0.1));
  CHECK(calibration.planes.model.at(kImageMiddle).width ==
        doctest::Approx(before.at(kImageMiddle).width).epsilon(0.01));
}

// Annotated in the far half of the table only, to half a pixel.
TEST_CASE("beyond the annotations the disc is accurate where Equation (2) is not") {
  const Camera camera;
  std::vector<Annotation> annotations;
  for (const Annotation& a : camera.annotations()) {
    if (a.centre.y < 250) annotations.push_back(a);
  }
  REQUIRE(annotations.size() >= 20);
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 0.5);
  for (Annotation& a : annotations) {
    a.size.width += noise(random);
    a.size.height += noise(random);
  }
  const SizeCalibration calibration = calibrate_size(annotations, kAnnotatedSensor);
  REQUIRE(calibration.model.disc.has_value());
  const Annotation near = camera.puck_at(0.1, 0.75);
  REQUIRE(near.centre.y > 400);
  CHECK(std::abs(calibration.model.extrapolated_at(near.centre).height - near.size.height) < 2.5);
  CHECK(std::abs(calibration.planes.model.extrapolated_at(near.centre).height - near.size.height) >
        4);
}

TEST_CASE("too few annotations, or sizes without growth towards the camera, determine no disc") {
  std::vector<Annotation> annotations = Camera().annotations();
  CHECK(calibrate_size(annotations, kAnnotatedSensor).model.disc.has_value());
  // The first rows lie on two lines: enough for Equation (2).
  annotations.resize(7);
  CHECK_FALSE(calibrate_size(annotations, kAnnotatedSensor).model.disc.has_value());
  // The disc fits them better, but does not determine the camera.
  const DiscModel flat{.width_0 = 30,
                       .width_y = 0.0045,
                       .face_on_px = 60,
                       .thickness = 0.2,
                       .principal_x_px = kImageMiddle.x,
                       .principal_y_px = kImageMiddle.y};
  std::vector<Annotation> alike = Camera().annotations();
  for (Annotation& a : alike) a.size = flat.at(a.centre);
  const SizeCalibration calibration = calibrate_size(alike, kAnnotatedSensor);
  CHECK(calibration.disc.height.rms_px <= calibration.planes.height.rms_px);
  CHECK_FALSE(calibration.model.disc.has_value());
}

TEST_CASE("the size limits enclose the annotated sizes") {
  const std::vector<Annotation> annotations{
      {{0}, {100, 100}, {20, 10}}, {{1}, {300, 100}, {20, 12}}, {{2}, {100, 300}, {40, 30}}};
  const PuckSizeModel model = calibrate_size(annotations, kAnnotatedSensor).planes.model;
  CHECK(model.smallest.width == doctest::Approx(10.0));
  CHECK(model.smallest.height == doctest::Approx(5.0));
  CHECK(model.largest.width == doctest::Approx(80));
  CHECK(model.largest.height == doctest::Approx(60));
  CHECK(model.sensor == kAnnotatedSensor);
}

TEST_CASE("little coverage, clamping inside the image and swapped columns cause warnings") {
  const auto warned = [](const std::vector<Annotation>& annotations, const char* of) {
    const SizeCalibration calibration = calibrate_size(annotations, kAnnotatedSensor);
    return std::any_of(calibration.warnings.begin(), calibration.warnings.end(),
                       [of](const std::string& w) { return w.find(of) != std::string::npos; });
  };
  const std::vector<Annotation> few{
      {{0}, {100, 200}, {20, 10}}, {{1}, {300, 200}, {20, 10}}, {{2}, {100, 100}, {40, 30}}};
  CHECK(warned(few, "only 31 % of the image's width and 21 % of its height"));
  CHECK(warned(few, "at (0, 479), where 10.0 x 5.0 px are used"));
  CHECK_FALSE(warned(few, "swapped"));
  std::vector<Annotation> all = Camera().annotations();
  CHECK_FALSE(warned(all, "only"));
  for (Annotation& a : all) std::swap(a.size.width, a.size.height);
  CHECK(warned(all, "are width and height swapped?"));
}

TEST_CASE("annotations outside the sensor, or with swapped columns, are refused") {
  std::vector<Annotation> annotations = Camera().annotations();
  annotations[1].centre.x = 700;
  CHECK_THROWS_AS(calibrate_size(annotations, kAnnotatedSensor), std::invalid_argument);
  CHECK_NOTHROW(calibrate_size(annotations, SensorSize{}));
  for (Annotation& a : annotations) {
    std::swap(a.centre.x, a.size.width);
    std::swap(a.centre.y, a.size.height);
  }
  CHECK_THROWS_WITH_AS(calibrate_size(annotations, SensorSize{}),
                       "most of the annotated boxes reach beyond the image's left and upper "
                       "borders; are the columns in the order that the header says?",
                       std::invalid_argument);
}

}  // namespace
}  // namespace puck
