#include <cmath>
#include <limits>
#include <stdexcept>

#include <doctest/doctest.h>
#include <opencv2/imgcodecs.hpp>

#include "common/plot/chart.h"
#include "tests/support/temporary_folder.h"

namespace puck {
namespace {

constexpr Ink kRed{255, 0, 0};

bool is_red(const cv::Vec3b& pixel) { return pixel[2] > 200 && pixel[0] < 100 && pixel[1] < 100; }

// Columns and rows with red in them; columns count from the left, rows from above.
cv::Rect red_part(const cv::Mat& picture) {
  cv::Rect part;
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      if (is_red(picture.at<cv::Vec3b>(y, x))) part |= cv::Rect(x, y, 1, 1);
    }
  }
  return part;
}

Chart chart() { return Chart("title", {.label = "x", .to = 10}, {.label = "y", .to = 10}); }

}  // namespace

TEST_CASE("ticks are round numbers within the axis") {
  const auto ticks = Axis{.from = 0.3, .to = 10.2}.ticks();
  REQUIRE(ticks.size() == 5);
  CHECK(ticks.front().value == doctest::Approx(2));
  CHECK(ticks.back().label == "10");
  CHECK(Axis{}.ticks().front().label == "0");
  const auto decades = Axis{.from = 0.1, .to = 100, .logarithmic = true}.ticks();
  CHECK(decades.size() == 28);
  CHECK(decades.front().label == "0.1");
  CHECK(decades[1].label.empty());
  CHECK(decades.back().label == "100");
}

TEST_CASE("a value is drawn at its place on the axis") {
  CHECK(Axis{.from = 10, .to = 20}.fraction(15) == doctest::Approx(0.5));
  CHECK(Axis{.from = 480, .to = 0}.fraction(120) == doctest::Approx(0.75));
  CHECK(Axis{.from = 0.1, .to = 10, .logarithmic = true}.fraction(1) == doctest::Approx(0.5));
  CHECK(Axis{.from = 0.1, .to = 10, .logarithmic = true}.fraction(0) < -1);
  CHECK(Axis{.things = {"a", "b"}}.fraction(0.5) == doctest::Approx(0.25));
}

TEST_CASE("axes cover their values") {
  CHECK(axis_from_zero("", 20).to == doctest::Approx(21));
  CHECK(axis_from_zero("", 0).to == 1);
  const Axis axis = logarithmic_axis("", 0.03, 250);
  CHECK(axis.from == doctest::Approx(0.01));
  CHECK(axis.to == doctest::Approx(1000));
  CHECK(logarithmic_axis("", 1, 1).to == doctest::Approx(10));
  CHECK(logarithmic_axis("", 0, 0).from > 0);
}

TEST_CASE("a line rises from the lower left to the upper right and is cut off at the axes") {
  Chart drawn = chart();
  drawn.line({{5, 5}, {1e9, 1e9}}, kRed);
  const cv::Rect part = red_part(drawn.picture());
  CHECK(part.width > 300);
  CHECK(part.br().x < drawn.picture().cols);
  CHECK(part.y > 40);
  CHECK(is_red(drawn.picture().at<cv::Vec3b>(part.br().y - 3, part.x + 3)));
}

TEST_CASE("a line is interrupted at unknown values") {
  Chart drawn = chart();
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  drawn.line({{0, 5}, {4, 5}, {5, unknown}, {6, 5}, {10, 5}}, kRed);
  const cv::Rect part = red_part(drawn.picture());
  const int middle_y = part.y + part.height / 2;
  CHECK(is_red(drawn.picture().at<cv::Vec3b>(middle_y, part.x + part.width / 4)));
  CHECK_FALSE(is_red(drawn.picture().at<cv::Vec3b>(middle_y, part.x + part.width / 2)));
}

TEST_CASE("a bar twice as high is twice as high") {
  Chart low = chart();
  low.bar(5, 1, 4, "", kRed);
  Chart high = chart();
  high.bar(5, 1, 8, "", kRed);
  CHECK(red_part(high.picture()).height ==
        doctest::Approx(2 * red_part(low.picture()).height).epsilon(0.02));
}

TEST_CASE("stacked charts are written as a picture, and an impossible path is reported") {
  const TemporaryFolder folder;
  chart().save(folder / "one.png");
  save_stacked({chart(), chart()}, folder / "two.png");
  CHECK(cv::imread((folder / "one.png").string()).rows == 480);
  CHECK(cv::imread((folder / "two.png").string()).rows == 960);
  CHECK_THROWS_AS(chart().save(folder / "no" / "such.png"), std::runtime_error);
}

}  // namespace puck
