#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "common/plot/axis.h"

namespace puck {

/// Red, green, blue.
struct Ink {
  int red = 0;
  int green = 0;
  int blue = 0;
};
inline constexpr Ink kBlack{30, 30, 30};
inline constexpr Ink kGrey{150, 150, 150};
/// Colours that colour-blind readers can tell apart; they repeat after seven.
Ink series_ink(std::size_t number);

struct ChartSize {
  int width_px = 1000;  ///< Width of the whole picture.
  int height_px = 480;
};

/// A chart with a title, two axes, a grid and a legend, to be saved as a picture. Clips what lies
/// beyond the axes. Texts must be ASCII: OpenCV's fonts have no other characters.
class Chart {
 public:
  Chart(const std::string& title, Axis x, Axis y, ChartSize size = {});

  struct Point {
    double x = 0;
    double y = 0;
  };
  /// Interrupted at points that are not numbers.
  void line(const std::vector<Point>& points, Ink ink, int width_px = 2);

  /// Box plot: quartiles, median and whiskers.
  struct Box {
    double low = 0;
    double lower_quartile = 0;
    double median = 0;
    double upper_quartile = 0;
    double high = 0;
  };
  void box(double x, double half_width, const Box& box, Ink ink);

  /// From the bottom of the chart, with a text above it.
  void bar(double x, double half_width, double value, const std::string& words, Ink ink);

  /// A ring around a point, with a text beside it.
  void mark(Point at, const std::string& words, Ink ink);

  /// Adds an entry to the line below the title.
  void legend(const std::string& name, Ink ink);

  const cv::Mat& picture() const { return picture_; }
  /// Throws std::runtime_error when the file cannot be written.
  void save(const std::filesystem::path& path) const;

 private:
  void draw_grid();
  cv::Point place(Point point) const;  // In the drawn area, in 1/16 px.
  cv::Mat area();
  void text(const std::string& words, cv::Point at, double scale);
  void text_centred(const std::string& words, cv::Point at, double scale);

  Axis x_;
  Axis y_;
  cv::Rect area_;
  int legend_x_ = 0;
  cv::Mat picture_;
};

/// Saves charts of the same width, one below the other. Throws std::runtime_error when the file
/// cannot be written.
void save_stacked(const std::vector<Chart>& charts, const std::filesystem::path& path);

}  // namespace puck
