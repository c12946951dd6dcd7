#include "tools/simulate/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace puck {
namespace {

constexpr int kLeft = 80;
constexpr int kTop = 50;
constexpr int kWidth = 800;
constexpr int kHeight = 400;
constexpr int kTicks = 5;

struct Axis {
  double from = 0;
  double to = 1;
  bool is_log = false;

  double share_of(double value) const {
    if (is_log) return std::log(value / from) / std::log(to / from);
    return (value - from) / (to - from);
  }
  double value_at(double share) const {
    return is_log ? from * std::pow(to / from, share) : from + share * (to - from);
  }
};

template <typename Coordinate>
Axis axis_of(const std::vector<Curve>& curves, bool is_log, Coordinate coordinate) {
  Axis axis{is_log ? 1e300 : 0, is_log ? 0 : 1e-9, is_log};
  for (const Curve& curve : curves) {
    for (const Curve::Point& point : curve.points) {
      axis.from = std::min(axis.from, coordinate(point));
      axis.to = std::max(axis.to, coordinate(point));
    }
  }
  return axis;
}

std::string number(double value) {
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), "%.3g", value);
  return digits.data();
}

void write(cv::Mat& canvas, const std::string& words, cv::Point at, const cv::Scalar& colour) {
  cv::putText(canvas, words, at, cv::FONT_HERSHEY_SIMPLEX, 0.5, colour, 1, cv::LINE_AA);
}

}  // namespace

void Chart::save(const std::filesystem::path& path) const {
  const cv::Scalar ink(60, 60, 60);
  const cv::Scalar grid(225, 225, 225);
  const std::array<cv::Scalar, 5> colours{cv::Scalar(180, 90, 20), cv::Scalar(30, 30, 200),
                                          cv::Scalar(40, 140, 40), cv::Scalar(160, 40, 160),
                                          cv::Scalar(20, 150, 200)};
  const Axis x = axis_of(curves_, log_x_, [](const Curve::Point& point) { return point.x; });
  const Axis y = axis_of(curves_, false, [](const Curve::Point& point) { return point.y; });
  const auto place = [](double right, double up) {
    return cv::Point(kLeft + static_cast<int>(std::lround(right * kWidth)),
                     kTop + kHeight - static_cast<int>(std::lround(up * kHeight)));
  };

  cv::Mat canvas(kTop + kHeight + 60, kLeft + kWidth + 40, CV_8UC3, cv::Scalar::all(255));
  write(canvas, title_, {kLeft, 28}, ink);
  write(canvas, x_label_, {kLeft + kWidth / 2 - 60, kTop + kHeight + 46}, ink);
  for (int i = 0; i <= kTicks; ++i) {
    const double share = static_cast<double>(i) / kTicks;
    cv::line(canvas, place(share, 0), place(share, 1), grid);
    cv::line(canvas, place(0, share), place(1, share), grid);
    write(canvas, number(x.value_at(share)), place(share, 0) + cv::Point(-16, 20), ink);
    write(canvas, number(y.value_at(share)), place(0, share) + cv::Point(-62, 5), ink);
  }
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    const cv::Scalar& colour = colours[i % colours.size()];
    std::vector<cv::Point> line;
    for (const Curve::Point& point : curves_[i].points) {
      line.push_back(place(x.share_of(point.x), y.share_of(point.y)));
    }
    cv::polylines(canvas, line, false, colour, 2, cv::LINE_AA);
    write(canvas, curves_[i].name, {kLeft + 12, kTop + 20 + 20 * static_cast<int>(i)}, colour);
  }
  if (!cv::imwrite(path.string(), canvas)) {
    throw std::runtime_error(path.string() + ": cannot be written");
  }
}

}  // namespace puck
