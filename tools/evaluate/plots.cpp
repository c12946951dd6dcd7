#include "tools/evaluate/plots.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace puck {
namespace {

const cv::Scalar kInk(60, 60, 60);
const cv::Scalar kGrid(225, 225, 225);
const cv::Scalar kLine(180, 90, 20);

// A plot with axes from 0; both axes linear.
class Plot {
 public:
  Plot(const std::string& title, const std::string& x_label, double x_end, double y_end)
      : x_end_(x_end > 0 ? x_end : 1), y_end_(y_end > 0 ? y_end : 1) {
    text(title, {kLeft, 24}, 0.6);
    text(x_label, {kLeft + kWidth / 2 - 40, kTop + kHeight + 42}, 0.5);
    constexpr int kTicks = 5;
    for (int i = 0; i <= kTicks; ++i) {
      const double x = x_end_ * i / kTicks;
      const double y = y_end_ * i / kTicks;
      cv::line(canvas_, place(x, 0), place(x, y_end_), kGrid);
      cv::line(canvas_, place(0, y), place(x_end_, y), kGrid);
      text(number(x), place(x, 0) + cv::Point(-12, 20), 0.45);
      text(number(y), place(0, y) + cv::Point(-58, 5), 0.45);
    }
  }

  void line(const std::vector<cv::Point2d>& points) {
    for (std::size_t i = 1; i < points.size(); ++i) {
      cv::line(canvas_, place(points[i - 1].x, points[i - 1].y), place(points[i].x, points[i].y),
               kLine, 1, cv::LINE_AA);
    }
  }

  void save(const std::filesystem::path& path) const {
    if (!cv::imwrite(path.string(), canvas_)) {
      throw std::runtime_error(path.string() + ": cannot be written");
    }
  }

 private:
  static constexpr int kLeft = 70;
  static constexpr int kTop = 40;
  static constexpr int kWidth = 800;
  static constexpr int kHeight = 360;

  cv::Point place(double x, double y) const {
    const double right = std::clamp(x / x_end_, 0.0, 1.0);
    const double up = std::clamp(y / y_end_, 0.0, 1.0);
    return {kLeft + static_cast<int>(std::lround(right * kWidth)),
            kTop + kHeight - static_cast<int>(std::lround(up * kHeight))};
  }
  static std::string number(double value) {
    std::string digits = std::to_string(value);
    digits.resize(digits.find('.') + 3);
    return digits;
  }
  void text(const std::string& words, cv::Point at, double scale) {
    cv::putText(canvas_, words, at, cv::FONT_HERSHEY_SIMPLEX, scale, kInk, 1, cv::LINE_AA);
  }

  double x_end_;
  double y_end_;
  cv::Mat canvas_{kTop + kHeight + 60, kLeft + kWidth + 30, CV_8UC3, cv::Scalar::all(255)};
};

}  // namespace

void write_plots(const AccuracyScore& score, const std::filesystem::path& folder) {
  const auto& samples = score.samples();
  if (samples.empty()) throw std::runtime_error("nothing to plot: no tick counts");
  std::filesystem::create_directories(folder);

  std::vector<cv::Point2d> over_time;
  std::vector<double> sorted;
  for (const auto& sample : samples) {
    over_time.emplace_back(static_cast<double>(sample.tick - samples.front().tick) * 1e-6,
                           sample.error_px);
    sorted.push_back(sample.error_px);
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<cv::Point2d> within;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    within.emplace_back(sorted[i],
                        100.0 * static_cast<double>(i + 1) / static_cast<double>(sorted.size()));
  }

  constexpr double kShownPx = 10;
  Plot error("error, px (cut at 10)", "time, s", over_time.back().x, kShownPx);
  error.line(over_time);
  error.save(folder / "error.png");
  Plot share("ticks within an error, %", "error, px", kShownPx, 100);
  share.line(within);
  share.save(folder / "within.png");
}

}  // namespace puck
