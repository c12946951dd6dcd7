#include "common/calibration/size_fit.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <doctest/doctest.h>

namespace puck {
namespace {

constexpr PuckSizeModel kModel{5, 0.01, 0.096, 4, -0.02, 0.08};

std::vector<Annotation> annotations_of(const PuckSizeModel& model) {
  std::vector<Annotation> annotations;
  for (const Pixel centre :
       {Pixel{100, 100}, Pixel{500, 120}, Pixel{300, 250}, Pixel{120, 400}, Pixel{560, 430}}) {
    annotations.push_back({{1000}, centre, model.at(centre)});
  }
  return annotations;
}

TEST_CASE("The size fit recovers the coefficients behind the annotations") {
  const SizeFit fit = fit_puck_size_model(annotations_of(kModel));
  CHECK(fit.model.width_0 == doctest::Approx(5));
  CHECK(fit.model.width_x == doctest::Approx(0.01));
  CHECK(fit.model.width_y == doctest::Approx(0.096));
  CHECK(fit.model.height_0 == doctest::Approx(4));
  CHECK(fit.model.height_x == doctest::Approx(-0.02));
  CHECK(fit.model.height_y == doctest::Approx(0.08));
  CHECK(fit.width.max_px < 1e-9);
  CHECK(fit.height.rms_px < 1e-9);
}

TEST_CASE("The size fit reports its residuals for width and height separately") {
  // At the corners of a rectangle a checkerboard error is orthogonal to every plane.
  std::vector<Annotation> annotations;
  for (const Pixel centre : {Pixel{100, 100}, Pixel{300, 100}, Pixel{100, 300}, Pixel{300, 300}}) {
    annotations.push_back({{0}, centre, {40, 30}});
  }
  annotations[0].size.width += 2;
  annotations[1].size.width -= 2;
  annotations[2].size.width -= 2;
  annotations[3].size.width += 2;
  const SizeFit fit = fit_puck_size_model(annotations);
  CHECK(fit.width.rms_px == doctest::Approx(2));
  CHECK(fit.width.max_px == doctest::Approx(2));
  CHECK(fit.height.max_px < 1e-9);
  CHECK(fit.model.at({200, 200}).width == doctest::Approx(40));
}

TEST_CASE("The size fit refuses fewer than three annotations and says how many it got") {
  std::vector<Annotation> annotations = annotations_of(kModel);
  annotations.resize(2);
  CHECK_THROWS_WITH_AS(fit_puck_size_model(annotations),
                       "the size model needs at least 3 annotations, got 2", std::invalid_argument);
}

TEST_CASE("The size fit refuses centres on one line and centres in one place") {
  std::vector<Annotation> line;
  for (int i = 0; i < 10; ++i) line.push_back({{0}, {100.0 + 30 * i, 50.0 + 20 * i}, {40, 30}});
  CHECK_THROWS_AS(fit_puck_size_model(line), std::invalid_argument);
  const std::vector<Annotation> place(10, Annotation{{0}, {320, 240}, {40, 30}});
  CHECK_THROWS_AS(fit_puck_size_model(place), std::invalid_argument);
}

TEST_CASE("The size fit refuses an annotation that is not finite or has no size") {
  std::vector<Annotation> annotations = annotations_of(kModel);
  annotations[3].size.height = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH_AS(fit_puck_size_model(annotations),
                       "annotation 4 needs a finite centre and a positive width and height",
                       std::invalid_argument);
  annotations[3].size.height = 0;
  CHECK_THROWS_AS(fit_puck_size_model(annotations), std::invalid_argument);
}

}  // namespace
}  // namespace puck
