#include "tools/view/drawing/picture_bars.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "tools/view/drawing/palette.h"
#include "tools/view/drawing/track_marks.h"

namespace puck {
namespace {

constexpr double kBarText_px = 11;
constexpr double kLegend_px = 9;
constexpr double kGap_px = 22;
constexpr double kLeastLegendGap_px = 8;
constexpr int kRow_px = 20;
constexpr int kRowMargin_px = 6;
constexpr double kBarSide_px = 12;
// As AccuracyScore's.
constexpr double kLost_px = 20;
// Width of a sample of the legend, with the gap behind it.
constexpr double kSample_px = 18;

std::string number_words(const char* format, double value) {
  char text[60];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

std::vector<LegendEntry> camera_legend(const ViewScene& scene, const PictureWishes& wishes) {
  using Sample = LegendEntry::Sample;
  const Palette& palette = palette_of(wishes.theme);
  const PictureWishes::Layers& layers = wishes.layers;
  std::vector<LegendEntry> entries;
  switch (wishes.backdrop) {
    case PictureWishes::Backdrop::kEvents:
      entries.push_back({Sample::kSquare, palette.brighter, "brighter"});
      entries.push_back(
          {Sample::kSquare, palette.darker,
           number_words("darker, last %g ms", static_cast<double>(wishes.window_us) / 1e3)});
      break;
    case PictureWishes::Backdrop::kSurface:
      entries.push_back({Sample::kSquare, palette.words, "newest edges"});
      break;
    case PictureWishes::Backdrop::kHeatMap:
      entries.push_back({Sample::kSquare, palette.brighter, "looks like a puck"});
      break;
  }
  const ViewTrack& track = scene.tracks[static_cast<std::size_t>(wishes.side)];
  if (!track.name.empty()) {
    if (layers.ellipse) entries.push_back({Sample::kRing, palette.estimate, "estimate"});
    if (layers.velocity) {
      entries.push_back(
          {Sample::kArrow, palette.estimate, number_words("in %.0f ms", kArrow_s * 1e3)});
    }
    if (layers.covariance) entries.push_back({Sample::kRing, palette.covariance, "uncertainty"});
    if (layers.trail) entries.push_back({Sample::kLine, palette.trail, "trail, 1 s"});
    // Also while there is none: the legend's height stays the same.
    if (layers.regions) entries.push_back({Sample::kDashes, palette.region, "region"});
  }
  if (layers.truth && scene.truth) entries.push_back({Sample::kRing, palette.truth, "truth"});
  return entries;
}

namespace {

void draw_sample(const LegendEntry& entry, double x, double y, Canvas& canvas) {
  using Sample = LegendEntry::Sample;
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

double width_of(const LegendEntry& entry) {
  return kSample_px + Canvas::text_width(entry.words, kLegend_px);
}

// Narrow if all entries are then in one row.
double gap_of(const std::vector<LegendEntry>& entries, int width_px) {
  double total = 1.5 * kBarSide_px;
  for (const LegendEntry& entry : entries) total += width_of(entry);
  const double gap =
      (width_px - total) / static_cast<double>(std::max<std::size_t>(entries.size(), 2) - 1);
  return gap >= kLeastLegendGap_px ? std::min(gap, kGap_px) : kGap_px;
}

// The row of each entry.
std::vector<int> rows_of(const std::vector<LegendEntry>& entries, int width_px) {
  std::vector<int> rows;
  const double gap = gap_of(entries, width_px);
  int row = 0;
  double x = kBarSide_px;
  for (const LegendEntry& entry : entries) {
    if (x > kBarSide_px && x + width_of(entry) > width_px) {
      x = kBarSide_px;
      ++row;
    }
    rows.push_back(row);
    x += width_of(entry) + gap;
  }
  return rows;
}

}  // namespace

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
      words.emplace_back(number_words("error %.2f px", *error),
                         *error > kLost_px ? palette.doubt : palette.words);
    }
    if (track.estimate && track.estimate->position) {
      const PixelVelocity v = track.estimate->velocity;
      words.emplace_back(number_words("%.0f px/s", std::hypot(v.x, v.y)), palette.words);
      words.emplace_back(number_words("score %.2f", track.estimate->score), palette.quiet);
    }
  }
  double x = kBarSide_px;
  for (const auto& [text, colour] : words) {
    const double text_px = Canvas::text_width(text, kBarText_px);
    if (x + text_px > width_px) return;
    canvas.text(text, {x, kTopBar_px / 2.0}, kBarText_px, colour);
    x += text_px + kGap_px;
  }
}

int legend_height_px(const std::vector<LegendEntry>& entries, int width_px) {
  return entries.empty() ? 0
                         : rows_of(entries, width_px).back() * kRow_px + kRow_px + kRowMargin_px;
}

void draw_legend(const std::vector<LegendEntry>& entries, const Palette& palette,
                 cv::Mat& picture) {
  const int top = std::max(0, picture.rows - legend_height_px(entries, picture.cols));
  picture.rowRange(top, picture.rows).setTo(palette.bar);
  const std::vector<int> rows = rows_of(entries, picture.cols);
  const double gap = gap_of(entries, picture.cols);
  Canvas canvas(picture);
  double x = kBarSide_px;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (i > 0 && rows[i] != rows[i - 1]) x = kBarSide_px;
    const double y = top + (kRow_px + kRowMargin_px) / 2.0 + rows[i] * kRow_px;
    draw_sample(entries[i], x, y, canvas);
    canvas.text(entries[i].words, {x + kSample_px, y}, kLegend_px, palette.quiet);
    x += width_of(entries[i]) + gap;
  }
}

}  // namespace puck
