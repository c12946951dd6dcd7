#include "tools/view/drawing/camera_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "tools/view/drawing/backdrop.h"
#include "tools/view/drawing/canvas.h"
#include "tools/view/drawing/picture_bars.h"
#include "tools/view/drawing/track_marks.h"

namespace puck {
namespace {

constexpr double kText_px = 11;
constexpr double kSide_px = 12;
// Of the shorter side of the sensor's picture.
constexpr double kCloseUpShare = 0.3;
// Extent of the close-up, in lengths of the puck's longer axis.
constexpr double kCloseUpSizes = 1.5;
constexpr double kLeastPuck_px = 4;
// Less enlarged, it would tell nothing new.
constexpr double kLeastZoom = 2;
constexpr int kMargin_px = 10;

// Whether the source has filled the backdrop, of the sensor's size.
bool is_filled(const ViewScene& scene, PictureWishes::Backdrop backdrop) {
  const auto fits = [&](const Image<std::uint8_t>& image) {
    return image.width() == scene.sensor.width && image.height() == scene.sensor.height;
  };
  switch (backdrop) {
    case PictureWishes::Backdrop::kEvents:
      return scene.events.sensor() == scene.sensor;
    case PictureWishes::Backdrop::kSurface:
      return fits(scene.surface);
    case PictureWishes::Backdrop::kHeatMap:
      return fits(scene.heat);
  }
  return false;
}

}  // namespace

SensorFrame SensorFrame::inside(const cv::Rect& part, SensorSize sensor) {
  SensorFrame frame;
  frame.scale = std::min(static_cast<double>(part.width) / sensor.width,
                         static_cast<double>(part.height) / sensor.height);
  frame.size_px = {std::max(1, static_cast<int>(sensor.width * frame.scale)),
                   std::max(1, static_cast<int>(sensor.height * frame.scale))};
  frame.origin = cv::Point2d(part.x + (part.width - frame.size_px.width) / 2,
                             part.y + (part.height - frame.size_px.height) / 2);
  return frame;
}

void CameraPicture::draw_backdrop(const ViewScene& scene, const PictureWishes& wishes,
                                  const SensorFrame& frame, cv::Mat& picture) {
  const Palette& palette = palette_of(wishes.theme);
  switch (wishes.backdrop) {
    case PictureWishes::Backdrop::kEvents:
      draw_events(scene.events, scene.time, wishes.window_us, palette, pixels_);
      break;
    case PictureWishes::Backdrop::kSurface:
      draw_surface(scene.surface, palette, pixels_);
      break;
    case PictureWishes::Backdrop::kHeatMap:
      draw_heat(scene.heat, pixels_);
      break;
  }
  // No pixel is left out: INTER_LINEAR, which is faster than INTER_AREA, reaches every one down to
  // half of the size.
  const int method = frame.scale >= 1     ? cv::INTER_NEAREST
                     : frame.scale >= 0.5 ? cv::INTER_LINEAR
                                          : cv::INTER_AREA;
  cv::Mat place = picture(frame.rect());
  cv::resize(pixels_, place, frame.size_px, 0, 0, method);
}

void CameraPicture::draw_close_up(const ViewScene& scene, const PictureWishes& wishes,
                                  const SensorFrame& frame, cv::Mat& inside) {
  const auto& estimate = scene.tracks[static_cast<std::size_t>(wishes.side)].estimate;
  if (!estimate || !estimate->position) return;
  const Pixel puck = *estimate->position;
  const double longest = std::max({kLeastPuck_px, estimate->size.width, estimate->size.height});
  // Also when one of these is not a number.
  const bool is_near = longest <= scene.sensor.width + scene.sensor.height &&
                       std::abs(puck.x) <= 2.0 * scene.sensor.width &&
                       std::abs(puck.y) <= 2.0 * scene.sensor.height;
  if (!is_near) return;
  const int side_px =
      static_cast<int>(kCloseUpShare * std::min(frame.size_px.width, frame.size_px.height));
  const int zoom = static_cast<int>(side_px / (kCloseUpSizes * longest));
  if (zoom < kLeastZoom * frame.scale) return;
  const int shown = side_px / zoom;
  const Region part = Region::around(puck, shown, shown);
  const Region there = part.intersect(Region::all_of(scene.sensor));
  if (there.empty()) return;

  const Palette& palette = palette_of(wishes.theme);
  close_up_.create(shown * zoom, shown * zoom, CV_8UC3);
  close_up_.setTo(palette.bar);
  cv::resize(pixels_({there.x, there.y, there.width, there.height}), enlarged_, {}, zoom, zoom,
             cv::INTER_NEAREST);
  enlarged_.copyTo(close_up_(
      {cv::Point((there.x - part.x) * zoom, (there.y - part.y) * zoom), enlarged_.size()}));
  PictureWishes marks = wishes;
  marks.layers.trail = marks.layers.regions = false;
  Canvas canvas(close_up_);
  draw_track(scene, marks,
             {.scale = static_cast<double>(zoom),
              .origin = cv::Point2d(-part.x * zoom, -part.y * zoom),
              .size_px = close_up_.size()},
             canvas);
  cv::rectangle(close_up_, {{0, 0}, close_up_.size()}, palette.quiet);
  // In the corner that is farthest from the puck.
  const cv::Point place(
      puck.x < scene.sensor.width / 2.0 ? inside.cols - close_up_.cols - kMargin_px : kMargin_px,
      puck.y < scene.sensor.height / 2.0 ? inside.rows - close_up_.rows - kMargin_px : kMargin_px);
  close_up_.copyTo(inside({place, close_up_.size()}));
}

void CameraPicture::draw(const ViewScene& scene, const PictureWishes& wishes, cv::Mat& picture) {
  const Palette& palette = palette_of(wishes.theme);
  const int top = wishes.layers.words ? kTopBar_px : 0;
  std::vector<LegendEntry> legend;
  if (wishes.layers.legend) legend = camera_legend(scene, wishes);
  const int bottom = legend_height_px(legend, picture.cols);
  const cv::Rect part(0, top, picture.cols, std::max(1, picture.rows - top - bottom));
  const SensorFrame frame = SensorFrame::inside(part, scene.sensor);
  Canvas canvas(picture);
  // Beside the sensor.
  picture.setTo(palette.bar);
  const bool has_backdrop = scene.no_backdrop.empty() && is_filled(scene, wishes.backdrop);
  if (has_backdrop) {
    draw_backdrop(scene, wishes, frame, picture);
  } else {
    picture(frame.rect()).setTo(palette.background);
    canvas.paragraph(scene.no_backdrop,
                     {picture.cols / 2.0, frame.origin.y + frame.size_px.height / 2.0},
                     picture.cols - 2 * kSide_px, kText_px, palette.words);
  }
  // The marks end at the sensor's border.
  cv::Mat inside = picture(frame.rect());
  Canvas marks(inside);
  draw_track(scene, wishes, {.scale = frame.scale, .size_px = frame.size_px}, marks);
  if (wishes.layers.close_up && has_backdrop) {
    draw_close_up(scene, wishes, frame, inside);
  }
  if (top > 0) {
    cv::rectangle(picture, {0, 0, picture.cols, top}, palette.bar, cv::FILLED);
    write_bar(scene, wishes, canvas, picture.cols);
  }
  draw_legend(legend, palette, picture);
}

}  // namespace puck
