#include "common/vision/correlation/gaussian_blur.h"

#include <doctest/doctest.h>
#include <opencv2/imgproc.hpp>

#include "tests/vision/noise_picture.h"

namespace puck {
TEST_CASE("the blur equals OpenCV's GaussianBlur to the bit, at the borders and on tiny pictures") {
  GaussianBlur blur;
  for (const auto& size : {std::pair{640, 40}, {37, 21}, {5, 5}, {3, 9}, {2, 2}}) {
    const int width = size.first;
    const int height = size.second;
    CAPTURE(width);
    CAPTURE(height);
    Image<std::uint8_t> source = test::noise(width, height, 11);
    Image<std::uint8_t> blurred;
    blur.apply(source.view(), blurred);

    const cv::Mat input(height, width, CV_8U, source.row(0));
    cv::Mat expected;
    cv::GaussianBlur(input, expected, cv::Size(5, 5), 0);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) REQUIRE(blurred(x, y) == expected.at<std::uint8_t>(y, x));
    }
  }
}

TEST_CASE("an even picture is unchanged and a single pixel is mirrored onto itself") {
  GaussianBlur blur;
  Image<std::uint8_t> even(9, 7);
  std::fill_n(even.row(0), 63, std::uint8_t{200});
  Image<std::uint8_t> blurred;
  blur.apply(even.view(), blurred);
  CHECK(blurred(0, 0) == 200);
  CHECK(blurred(4, 3) == 200);
  blur.apply(even.view().part(3, 3, 1, 1), blurred);
  CHECK(blurred.width() == 1);
  CHECK(blurred(0, 0) == 200);
}

}  // namespace puck
