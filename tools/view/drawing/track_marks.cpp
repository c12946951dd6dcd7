#include "tools/view/drawing/track_marks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "common/evaluation/truth_track.h"

namespace puck {
namespace {

// Points of the trail with a longer gap are not joined.
constexpr std::int64_t kLongestGap_us = 20'000;
// Parts into which the trail fades.
constexpr int kTrailParts = 8;
constexpr double kOldestTrail = 0.2;
// Share of a doubtful mark's colour; the rest is background.
constexpr double kFaded = 0.6;
constexpr double kDash_px = 6;
constexpr double kArrowHead_px = 9;
constexpr double kWord_px = 11;

struct Marks {
  const ViewScene& scene;
  const ViewTrack& track;
  const SensorFrame& frame;
  const Palette& palette;
  Canvas& canvas;

  cv::Size2d axes(PuckSize size) const {
    return {size.width / 2 * frame.scale, size.height / 2 * frame.scale};
  }
  Stroke stroke(const cv::Scalar& colour, int width_px, bool doubtful = false) const {
    return {.colour = doubtful ? mixed(palette.background, colour, kFaded) : colour,
            .width_px = width_px,
            .halo = palette.halo,
            .has_halo = true,
            .dash_px = doubtful ? kDash_px : 0};
  }
};

void draw_region(const Marks& marks, const PuckEstimate& estimate) {
  const Region& region = estimate.region;
  const double left = region.x - 0.5;
  const double top = region.y - 0.5;
  Stroke stroke = marks.stroke(marks.palette.region, 1);
  stroke.dash_px = 3;
  marks.canvas.rectangle(marks.frame.at({left, top}),
                         marks.frame.at({left + region.width, top + region.height}), stroke);
}

void draw_trail(const Marks& marks) {
  const Timestamp now = marks.scene.time;
  std::vector<cv::Point2d> line;
  int part = -1;
  Timestamp before;
  const auto finish = [&] {
    const double age = (part + 0.5) / kTrailParts;
    marks.canvas.polyline(line, false,
                          {.colour = mixed(marks.palette.background, marks.palette.trail,
                                           1 - (1 - kOldestTrail) * age),
                           .width_px = 2});
  };
  for (const ViewTrack::TrailPoint& point : marks.track.trail) {
    const std::int64_t age_us = now - point.time;
    if (age_us < 0 || age_us > ViewTrack::kTrail_us) continue;
    const int of =
        std::min(static_cast<int>(age_us * kTrailParts / ViewTrack::kTrail_us), kTrailParts - 1);
    const bool joins = !line.empty() && point.position && point.time - before <= kLongestGap_us;
    if (!joins || of != part) {
      finish();
      const cv::Point2d last = line.empty() ? cv::Point2d() : line.back();
      line.clear();
      if (joins) line.push_back(last);
      part = of;
    }
    if (point.position) line.push_back(marks.frame.at(*point.position));
    before = point.time;
  }
  finish();
}

// Two standard deviations of the position.
void draw_covariance(const Marks& marks, const PuckEstimate& estimate, bool doubtful) {
  const double xx = estimate.covariance[0];
  const double xy = estimate.covariance[1];
  const double yy = estimate.covariance[5];
  const double middle = (xx + yy) / 2;
  const double spread = std::hypot((xx - yy) / 2, xy);
  if (!(middle - spread >= 0 && middle > 0)) return;
  const double turn = std::atan2(2 * xy, xx - yy) / 2;
  marks.canvas.ellipse(marks.frame.at(*estimate.position),
                       {2 * std::sqrt(middle + spread) * marks.frame.scale,
                        2 * std::sqrt(middle - spread) * marks.frame.scale},
                       turn, marks.stroke(marks.palette.covariance, 1, doubtful));
}

void draw_velocity(const Marks& marks, const PuckEstimate& estimate, bool doubtful) {
  const Pixel to{estimate.position->x + estimate.velocity.x * kArrow_s,
                 estimate.position->y + estimate.velocity.y * kArrow_s};
  marks.canvas.arrow(marks.frame.at(*estimate.position), marks.frame.at(to), kArrowHead_px,
                     marks.stroke(marks.palette.estimate, 2, doubtful));
}

// The newest position of a track without one now.
const ViewTrack::TrailPoint* last_seen(const ViewTrack& track) {
  const auto found =
      std::find_if(track.trail.rbegin(), track.trail.rend(),
                   [](const ViewTrack::TrailPoint& point) { return point.position.has_value(); });
  return found == track.trail.rend() ? nullptr : &*found;
}

void write_word(const Marks& marks, Pixel at, PuckSize size) {
  cv::Point2d place = marks.frame.at(at);
  place.x += marks.axes(size).width + 10;
  place.y -= marks.axes(size).height + 6;
  marks.canvas.label(state_words(marks.track, marks.scene.time), place, kWord_px,
                     marks.palette.doubt, marks.palette.bar);
}

// Where a puck was last seen, or left the image.
void draw_absence(const Marks& marks, const PuckEstimate& estimate) {
  const ViewTrack::TrailPoint* seen = last_seen(marks.track);
  if (estimate.left_image) {
    const cv::Point2d at = marks.frame.at(*estimate.left_image);
    const double r = 9;
    const Stroke stroke = marks.stroke(marks.palette.doubt, 2);
    marks.canvas.line(at - cv::Point2d(r, r), at + cv::Point2d(r, r), stroke);
    marks.canvas.line(at + cv::Point2d(-r, r), at + cv::Point2d(r, -r), stroke);
    write_word(marks, *estimate.left_image, {});
  } else if (seen != nullptr) {
    PuckSize size = estimate.size;
    if (!(size.width > 0 && size.height > 0))
      size = {16 / marks.frame.scale, 16 / marks.frame.scale};
    marks.canvas.ellipse(marks.frame.at(*seen->position), marks.axes(size), 0,
                         marks.stroke(marks.palette.doubt, 2, true));
    write_word(marks, *seen->position, size);
  }
}

void draw_puck(const Marks& marks, const PictureWishes::Layers& layers,
               const PuckEstimate& estimate) {
  const bool doubtful = is_doubtful(estimate);
  if (layers.ellipse) {
    marks.canvas.ellipse(marks.frame.at(*estimate.position), marks.axes(estimate.size), 0,
                         marks.stroke(marks.palette.estimate, 2, doubtful));
    if (doubtful) write_word(marks, *estimate.position, estimate.size);
  }
  if (layers.covariance) draw_covariance(marks, estimate, doubtful);
  if (layers.velocity) draw_velocity(marks, estimate, doubtful);
}

}  // namespace

bool is_doubtful(const PuckEstimate& estimate) {
  return estimate.state != TrackState::kTracking || estimate.coasting;
}

bool has_region(const ViewTrack& track, SensorSize sensor) {
  return track.estimate && !track.estimate->region.empty() &&
         track.estimate->region != Region::all_of(sensor);
}

std::string state_words(const ViewTrack& track, Timestamp now) {
  if (!track.estimate) return "no estimate";
  const PuckEstimate& estimate = *track.estimate;
  if (estimate.left_image) return "left the image";
  switch (estimate.state) {
    case TrackState::kSearching:
      return "searching";
    case TrackState::kTracking:
      if (estimate.coasting) return "coasting: predicted, not seen";
      return estimate.resting ? "tracking, at rest" : "tracking";
    case TrackState::kLost:
      break;
  }
  const ViewTrack::TrailPoint* seen = last_seen(track);
  if (seen == nullptr) return "lost for more than 1 s";
  char text[40];
  std::snprintf(text, sizeof text, "lost for %.2f s", static_cast<double>(now - seen->time) * 1e-6);
  return text;
}

std::optional<double> error_px(const ViewTrack& track, const std::optional<TruthRow>& truth) {
  if (!track.estimate || !track.estimate->position || !truth || !is_visible(*truth)) {
    return std::nullopt;
  }
  return distance_px(*track.estimate->position, truth->centre);
}

void draw_track(const ViewScene& scene, const PictureWishes& wishes, const SensorFrame& frame,
                Canvas& canvas) {
  const ViewTrack& track = scene.tracks[static_cast<std::size_t>(wishes.side)];
  const PictureWishes::Layers& layers = wishes.layers;
  const Marks marks{scene, track, frame, palette_of(wishes.theme), canvas};
  const bool has_track = !track.name.empty() && track.estimate;
  if (layers.regions && has_region(track, scene.sensor)) draw_region(marks, *track.estimate);
  if (has_track && layers.trail) draw_trail(marks);
  if (has_track && track.estimate->position) {
    draw_puck(marks, layers, *track.estimate);
  } else if (has_track && layers.ellipse) {
    draw_absence(marks, *track.estimate);
  }
  // Above the estimate's thicker line, which it may equal.
  if (layers.truth && scene.truth && scene.truth->visible > 0) {
    Stroke stroke = marks.stroke(marks.palette.truth, 1, !is_visible(*scene.truth));
    stroke.has_halo = false;
    canvas.ellipse(frame.at(scene.truth->centre), marks.axes(scene.truth->size), 0, stroke);
  }
}

}  // namespace puck
