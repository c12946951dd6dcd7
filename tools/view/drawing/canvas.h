#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace puck {

/// A pen's stroke. A halo, two pixels wider, is drawn below it unless its width is 0.
struct Stroke {
  cv::Scalar colour;
  int width_px = 1;
  cv::Scalar halo;
  bool has_halo = false;
  double dash_px = 0;  ///< Length of dashes and of the gaps between them; 0: a solid line.
};

/// Draws on a BGR picture with positions finer than a pixel. Marks may lie partly or wholly
/// outside; positions that are not finite draw nothing. Borrows the picture.
class Canvas {
 public:
  explicit Canvas(cv::Mat& picture) : picture_(picture) {}

  void line(cv::Point2d from, cv::Point2d to, const Stroke& stroke);
  /// Joins the points; closed: also the last with the first.
  void polyline(const std::vector<cv::Point2d>& points, bool closed, const Stroke& stroke);
  void rectangle(cv::Point2d from, cv::Point2d to, const Stroke& stroke);
  /// `axes`: half of width and height, px; `turn_rad`: clockwise, as y points down.
  void ellipse(cv::Point2d centre, cv::Size2d axes, double turn_rad, const Stroke& stroke);
  /// A head of `head_px` at the end of a line; nothing if the line is shorter than the head.
  void arrow(cv::Point2d from, cv::Point2d to, double head_px, const Stroke& stroke);
  void filled_circle(cv::Point2d centre, double radius_px, const cv::Scalar& colour);
  void filled_polygon(const std::vector<cv::Point2d>& points, const cv::Scalar& colour);

  /// Text whose left end, or middle, or right end is at x, and whose capitals stand around y.
  enum class Align { kLeft, kMiddle, kRight };
  void text(const std::string& words, cv::Point2d at, double height_px, const cv::Scalar& colour,
            Align align = Align::kLeft);
  /// Lines of whole words, as wide as allowed, around a middle.
  void paragraph(const std::string& words, cv::Point2d middle, double width_px, double height_px,
                 const cv::Scalar& colour);
  /// A text on a filled box, moved so that it lies inside the picture.
  void label(const std::string& words, cv::Point2d at, double height_px, const cv::Scalar& colour,
             const cv::Scalar& box);
  static double text_width(const std::string& words, double height_px);

 private:
  void strokes(const std::vector<cv::Point2d>& points, bool closed, const cv::Scalar& colour,
               int width_px);

  cv::Mat& picture_;
};

}  // namespace puck
