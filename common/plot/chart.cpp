#include "common/plot/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace puck {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr int kLeft = 84;
constexpr int kRight = 28;
constexpr int kTop = 66;
constexpr int kBottom = 62;
constexpr Ink kGridInk{226, 226, 226};
constexpr Ink kFrameInk{120, 120, 120};
// OpenCV gets points in 1/16 px.
constexpr int kShift = 4;
constexpr double kOne = 1 << kShift;
// Far outside any picture, and well within the range of OpenCV's integers.
constexpr double kFar = 20;

cv::Scalar scalar(Ink ink) { return cv::Scalar(ink.blue, ink.green, ink.red); }

Ink lighter(Ink ink) {
  const auto mix = [](int part) { return 255 - (255 - part) * 2 / 5; };
  return {mix(ink.red), mix(ink.green), mix(ink.blue)};
}

int text_width(const std::string& words, double scale) {
  int baseline = 0;
  return cv::getTextSize(words, kFont, scale, 1, &baseline).width;
}

void write_picture(const cv::Mat& picture, const std::filesystem::path& path) {
  if (!cv::imwrite(path.string(), picture)) {
    throw std::runtime_error(path.string() + ": cannot be written");
  }
}

}  // namespace

Ink series_ink(std::size_t number) {
  constexpr std::array<Ink, 7> kInks{{{86, 180, 233},
                                      {230, 159, 0},
                                      {0, 158, 115},
                                      {204, 121, 167},
                                      {0, 114, 178},
                                      {213, 94, 0},
                                      {110, 80, 60}}};
  return kInks[number % kInks.size()];
}

Chart::Chart(const std::string& title, Axis x, Axis y, ChartSize size)
    : x_(std::move(x)),
      y_(std::move(y)),
      area_(kLeft, kTop, size.width_px - kLeft - kRight, size.height_px - kTop - kBottom),
      legend_x_(kLeft),
      picture_(size.height_px, size.width_px, CV_8UC3, cv::Scalar::all(255)) {
  text(title, {kLeft, 26}, 0.62);
  draw_grid();
}

void Chart::draw_grid() {
  for (const Axis::Tick& tick : x_.ticks()) {
    const int at = area_.x + static_cast<int>(std::lround(x_.fraction(tick.value) * area_.width));
    if (x_.things.empty()) {
      cv::line(picture_, {at, area_.y}, {at, area_.br().y}, scalar(kGridInk));
    }
    std::istringstream lines(tick.label);
    int y = area_.br().y + 20;
    for (std::string line; std::getline(lines, line); y += 16) text_centred(line, {at, y}, 0.45);
  }
  for (const Axis::Tick& tick : y_.ticks()) {
    const int at =
        area_.br().y - static_cast<int>(std::lround(y_.fraction(tick.value) * area_.height));
    cv::line(picture_, {area_.x, at}, {area_.br().x, at}, scalar(kGridInk));
    text(tick.label, {area_.x - 8 - text_width(tick.label, 0.45), at + 5}, 0.45);
  }
  cv::rectangle(picture_, area_, scalar(kFrameInk));
  text_centred(x_.label, {area_.x + area_.width / 2, area_.br().y + 46}, 0.5);
  // Vertical, beside the axis.
  const int length = text_width(y_.label, 0.5);
  if (length == 0) return;
  cv::Mat words(20, length + 4, CV_8UC3, cv::Scalar::all(255));
  cv::putText(words, y_.label, {2, 14}, kFont, 0.5, scalar(kBlack), 1, cv::LINE_AA);
  cv::rotate(words, words, cv::ROTATE_90_COUNTERCLOCKWISE);
  const cv::Rect there(6, area_.y + (area_.height - words.rows) / 2, words.cols, words.rows);
  const cv::Rect visible = there & cv::Rect({0, 0}, picture_.size());
  words(visible - there.tl()).copyTo(picture_(visible));
}

cv::Point Chart::place(Point point) const {
  const double right = std::clamp(x_.fraction(point.x), -kFar, kFar) * area_.width;
  const double up = std::clamp(y_.fraction(point.y), -kFar, kFar) * area_.height;
  return {static_cast<int>(std::lround(right * kOne)),
          static_cast<int>(std::lround((area_.height - up) * kOne))};
}

cv::Mat Chart::area() { return picture_(area_); }

void Chart::text(const std::string& words, cv::Point at, double scale) {
  cv::putText(picture_, words, at, kFont, scale, scalar(kBlack), 1, cv::LINE_AA);
}

void Chart::text_centred(const std::string& words, cv::Point at, double scale) {
  text(words, {at.x - text_width(words, scale) / 2, at.y}, scale);
}

void Chart::line(const std::vector<Point>& points, Ink ink, int width_px) {
  const auto known = [](Point p) { return std::isfinite(p.x) && std::isfinite(p.y); };
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!known(points[i - 1]) || !known(points[i])) continue;
    cv::Mat drawn = area();
    cv::line(drawn, place(points[i - 1]), place(points[i]), scalar(ink), width_px, cv::LINE_AA,
             kShift);
  }
}

void Chart::box(double x, double half_width, const Box& box, Ink ink) {
  cv::Mat drawn = area();
  const auto across = [&](double from, double to, double y, int width) {
    cv::line(drawn, place({from, y}), place({to, y}), scalar(ink), width, cv::LINE_AA, kShift);
  };
  const auto upright = [&](double from, double to) {
    cv::line(drawn, place({x, from}), place({x, to}), scalar(ink), 1, cv::LINE_AA, kShift);
  };
  upright(box.low, box.lower_quartile);
  upright(box.upper_quartile, box.high);
  across(x - half_width / 2, x + half_width / 2, box.low, 1);
  across(x - half_width / 2, x + half_width / 2, box.high, 1);
  const cv::Point corner = place({x - half_width, box.upper_quartile});
  const cv::Point opposite = place({x + half_width, box.lower_quartile});
  cv::rectangle(drawn, corner, opposite, scalar(lighter(ink)), cv::FILLED, cv::LINE_AA, kShift);
  cv::rectangle(drawn, corner, opposite, scalar(ink), 1, cv::LINE_AA, kShift);
  across(x - half_width, x + half_width, box.median, 2);
}

void Chart::bar(double x, double half_width, double value, const std::string& words, Ink ink) {
  cv::Mat drawn = area();
  const cv::Point top = place({x - half_width, value});
  cv::Point bottom = place({x + half_width, value});
  bottom.y = static_cast<int>(kOne) * area_.height;
  cv::rectangle(drawn, top, bottom, scalar(ink), cv::FILLED, cv::LINE_AA, kShift);
  const cv::Point middle = place({x, value}) / static_cast<int>(kOne);
  text_centred(words, area_.tl() + cv::Point(middle.x, std::max(middle.y - 6, 14)), 0.42);
}

void Chart::mark(Point at, const std::string& words, Ink ink) {
  cv::Mat drawn = area();
  cv::circle(drawn, place(at), 5 << kShift, scalar(ink), 2, cv::LINE_AA, kShift);
  const cv::Point centre = area_.tl() + place(at) / static_cast<int>(kOne);
  const bool left = centre.x > area_.x + area_.width * 2 / 3;
  text(words, centre + cv::Point(left ? -10 - text_width(words, 0.45) : 10, 18), 0.45);
}

void Chart::legend(const std::string& name, Ink ink) {
  constexpr int kBaseline = 50;
  cv::line(picture_, {legend_x_, kBaseline - 5}, {legend_x_ + 22, kBaseline - 5}, scalar(ink), 3,
           cv::LINE_AA);
  text(name, {legend_x_ + 28, kBaseline}, 0.45);
  legend_x_ += 28 + text_width(name, 0.45) + 22;
}

void Chart::save(const std::filesystem::path& path) const { write_picture(picture_, path); }

void save_stacked(const std::vector<Chart>& charts, const std::filesystem::path& path) {
  std::vector<cv::Mat> pictures;
  for (const Chart& chart : charts) pictures.push_back(chart.picture());
  cv::Mat stacked;
  cv::vconcat(pictures, stacked);
  write_picture(stacked, path);
}

}  // namespace puck
