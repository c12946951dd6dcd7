#include "tools/view/drawing/camera_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "tools/view/drawing/backdrop.h"
#include "tools/view/drawing/canvas.h"
#include "tools/view/drawing/track_marks.h"

namespace puck {
namespace {

constexpr int kTopBar_px = 30;
constexpr int kBottomBar_px = 26;
constexpr double kText_px = 11;
constexpr double kLegend_px = 9;
constexpr double kGap_px = 22;
constexpr double kSide_px = 12;
// Width of a sample of the legend, with the gap behind it.
constexpr double kSample_px = 18;

// Of the shorter side of the sensor's picture.
constexpr double kCloseUpShare = 0.3;
// Extent of the close-up, in lengths of the puck's longer axis.
constexpr double kCloseUpSizes = 1.5;
constexpr double kLeastPuck_px = 4;
// Less enlarged, it would tell nothing new.
constexpr double kLeastZoom = 2;
constexpr int kMargin_px = 10;

std::string number_words(const char* format, double value) {
  char text[60];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// From left to right, as far as the width allows.
void write_bar(const ViewScene& scene, const PictureWishes& wishes, Canvas& canvas, int width_px) {
  const Palette& palette = palette_of(wishes.theme);
  const ViewTrack& track = scene.tracks[static_cast<std::size_t>(wishes.side)];
  std::vector<std::pair<std::string, cv::Scalar>> words{
      {number_words("%.3f s", scene.seconds), palette.words}};
  if (!track.name.empty()) {
    const bool doubtful = !track.estimate || is_doubtful(*track.estimate);
    words.emplace_back(track.name, palette.quiet);
    words.emplace_back(state_words(track, scene.time), doubtful ? palette.doubt : palette.words);
    if (const auto error = error_px(track, scene.truth)) {
      words.emplace_back(number_words("error %.2f px", *error), palette.words);
    }
    if (track.estimate && track.estimate->position) {
      const PixelVelocity v = track.estimate->velocity;
      words.emplace_back(number_words("%.0f px/s", std::hypot(v.x, v.y)), palette.words);
      words.emplace_back(number_words("score %.2f", track.estimate->score), palette.quiet);
    }
  }
  double x = kSide_px;
  for (const auto& [text, colour] : words) {
    const double text_px = Canvas::text_width(text, kText_px);
    if (x + text_px > width_px) return;
    canvas.text(text, {x, kTopBar_px / 2.0}, kText_px, colour);
    x += text_px + kGap_px;
  }
}

enum class Sample { kSquare, kRing, kLine, kDashes, kArrow };

struct LegendEntry {
  Sample sample;
  cv::Scalar colour;
  std::string words;
};

std::vector<LegendEntry> legend_of(const ViewScene& scene, const PictureWishes& wishes) {
  const Palette& palette = palette_of(wishes.theme);
  const PictureWishes::Layers& layers = wishes.layers;
  std::vector<LegendEntry> entries;
  switch (wishes.backdrop) {
    case PictureWishes::Backdrop::kEvents:
      entries.push_back(
          {Sample::kSquare, palette.brighter,
           number_words("%g ms: brighter", static_cast<double>(wishes.window_us) / 1e3)});
      entries.push_back({Sample::kSquare, palette.darker, "darker"});
      break;
    case PictureWishes::Backdrop::kSurface:
      entries.push_back({Sample::kSquare, palette.words, "surface"});
      break;
    case PictureWishes::Backdrop::kHeatMap:
      entries.push_back({Sample::kSquare, palette.brighter, "like a puck"});
      break;
  }
  const ViewTrack& track = scene.tracks[static_cast<std::size_t>(wishes.side)];
  if (!track.name.empty()) {
    if (layers.ellipse) entries.push_back({Sample::kRing, palette.estimate, "estimate"});
    if (layers.velocity) {
      entries.push_back(
          {Sample::kArrow, palette.estimate, number_words("in %.0f ms", kArrow_s * 1e3)});
    }
    if (layers.covariance) entries.push_back({Sample::kRing, palette.covariance, "2 sigma"});
    if (layers.trail) entries.push_back({Sample::kLine, palette.trail, "trail, 1 s"});
    if (layers.regions && has_region(track, scene.sensor))
      entries.push_back({Sample::kDashes, palette.region, "region"});
  }
  if (layers.truth && scene.truth) entries.push_back({Sample::kRing, palette.truth, "truth"});
  return entries;
}

void draw_sample(const LegendEntry& entry, double x, double y, Canvas& canvas) {
  const Stroke stroke{.colour = entry.colour, .width_px = 2};
  switch (entry.sample) {
    case Sample::kSquare:
      canvas.filled_polygon({{x, y - 5}, {x + 10, y - 5}, {x + 10, y + 5}, {x, y + 5}},
                            entry.colour);
      break;
    case Sample::kRing:
      canvas.ellipse({x + 6, y}, {6, 4.5}, 0, stroke);
      break;
    case Sample::kLine:
      canvas.line({x, y}, {x + 12, y}, stroke);
      break;
    case Sample::kDashes:
      canvas.line({x, y}, {x + 12, y}, {.colour = entry.colour, .width_px = 1, .dash_px = 3});
      break;
    case Sample::kArrow:
      canvas.arrow({x - 2, y}, {x + 12, y}, 5, stroke);
      break;
  }
}

// Nearer together where there is little room; what does not fit is left out.
void draw_legend(const ViewScene& scene, const PictureWishes& wishes, Canvas& canvas, int width_px,
                 double y) {
  const std::vector<LegendEntry> entries = legend_of(scene, wishes);
  double total_px = 2 * kSide_px;
  for (const LegendEntry& entry : entries) {
    total_px += kSample_px + Canvas::text_width(entry.words, kLegend_px);
  }
  const double gap_px =
      std::clamp((width_px - total_px) / static_cast<double>(entries.size()), kGap_px / 4, kGap_px);
  double x = kSide_px;
  for (const LegendEntry& entry : entries) {
    const double text_px = Canvas::text_width(entry.words, kLegend_px);
    if (x + kSample_px + text_px > width_px) return;
    draw_sample(entry, x, y, canvas);
    canvas.text(entry.words, {x + kSample_px, y}, kLegend_px, palette_of(wishes.theme).quiet);
    x += kSample_px + text_px + gap_px;
  }
}

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
  const double longest = std::max({estimate->size.width, estimate->size.height, kLeastPuck_px});
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
  const int bottom = wishes.layers.legend ? kBottomBar_px : 0;
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
  if (bottom > 0) {
    const int y = picture.rows - bottom;
    cv::rectangle(picture, {0, y, picture.cols, bottom}, palette.bar, cv::FILLED);
    draw_legend(scene, wishes, canvas, picture.cols, y + bottom / 2.0);
  }
}

}  // namespace puck
