#include "tools/evaluate/picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include <opencv2/imgproc.hpp>

#include "common/plot/chart.h"

namespace puck {
namespace {

// Blue and orange differ for every kind of colour blindness; overlays are bright.
constexpr Ink kBackground{13, 17, 23};
constexpr Ink kBar{22, 27, 34};
constexpr Ink kWords{230, 237, 243};
constexpr Ink kQuietWords{150, 160, 172};
constexpr Ink kBrighter{240, 165, 40};
constexpr Ink kDarker{70, 140, 230};
constexpr Ink kEstimate{255, 255, 255};
constexpr Ink kTrail{90, 220, 150};
constexpr Ink kTruth{255, 90, 200};

constexpr int kFont = cv::FONT_HERSHEY_DUPLEX;
constexpr int kFooterPx = 48;
constexpr int kMarginPx = 16;
// The arrow ends at the position predicted this far ahead.
constexpr double kArrowS = 0.05;
// Trail points with a longer gap are not joined.
constexpr std::int64_t kLongestGapUs = 20'000;
// Share of the colour that an event of age kEventsUs keeps.
constexpr double kOldestShare = 0.25;
// Extent of the close-up, in lengths of the puck's longer axis.
constexpr double kCloseUpSizes = 1.35;
constexpr int kShift = 4;  // Fractional bits of OpenCV coordinates: 1/16 px.

cv::Scalar scalar(Ink ink) { return cv::Scalar(ink.blue, ink.green, ink.red); }

Ink mix(Ink from, Ink to, double share) {
  const auto part = [&](int a, int b) {
    return static_cast<int>(std::lround(a + share * (b - a)));
  };
  return {part(from.red, to.red), part(from.green, to.green), part(from.blue, to.blue)};
}

/// Draws in sensor coordinates; `origin` is the first visible pixel.
class SensorCanvas {
 public:
  SensorCanvas(cv::Mat area, int scale, cv::Point origin = {})
      : area_(std::move(area)), scale_(scale), origin_(origin) {}

  void events(const TrackedMoment& moment) {
    for (const Event& event : moment.events.events) {
      const std::int64_t age_us = moment.time - moment.events.time_of(event);
      if (age_us < 0 || age_us >= TrackedMoment::kEventsUs) continue;
      if (!moment.sensor.contains(event.x, event.y)) continue;
      const double age = static_cast<double>(age_us) / TrackedMoment::kEventsUs;
      const Ink ink =
          mix(event.polarity == 1 ? kBrighter : kDarker, kBackground, age * (1 - kOldestShare));
      const cv::Point at = (cv::Point(event.x, event.y) - origin_) * scale_;
      area_(cv::Rect(at, cv::Size(scale_, scale_)) & cv::Rect({}, area_.size())) = scalar(ink);
    }
  }

  void trail(const TrackedMoment& moment) {
    const auto& points = moment.trail;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const auto& from = points[i - 1];
      const auto& to = points[i];
      const std::int64_t age_us = moment.time - to.time;
      if (age_us < 0 || age_us > TrackedMoment::kTrailUs) continue;
      if (!from.position || !to.position || to.time - from.time > kLongestGapUs) continue;
      const double share = 1 - 0.8 * static_cast<double>(age_us) / TrackedMoment::kTrailUs;
      line(*from.position, *to.position, mix(kBackground, kTrail, share), 3);
    }
  }

  void ellipse(Pixel centre, PuckSize size, Ink ink, int width_px) {
    const cv::Size axes(length(size.width / 2), length(size.height / 2));
    cv::ellipse(area_, place(centre), axes, 0, 0, 360, scalar(ink), width_px, cv::LINE_AA, kShift);
  }

  void puck(const TrackedMoment& moment) {
    const PuckEstimate& estimate = moment.estimate;
    if (estimate.position) {
      ellipse(*estimate.position, estimate.size, kBackground, 6);
      ellipse(*estimate.position, estimate.size, kEstimate, 2);
    }
    if (moment.truth) ellipse(moment.truth->centre, moment.truth->size, kTruth, 1);
  }

  void arrow(Pixel from, PixelVelocity velocity) {
    const Pixel step{velocity.x * kArrowS, velocity.y * kArrowS};
    const double length_px = std::hypot(step.x, step.y);
    constexpr double kHeadPx = 9;  // of the picture
    const double head = kHeadPx / scale_;
    if (length_px < 2 * head) return;
    const Pixel to{from.x + step.x, from.y + step.y};
    const Pixel along{step.x / length_px, step.y / length_px};
    const auto barb = [&](double side) {
      return Pixel{to.x - head * (1.6 * along.x - side * along.y),
                   to.y - head * (1.6 * along.y + side * along.x)};
    };
    for (const auto& [ink, width_px] : {std::pair(kBackground, 6), std::pair(kEstimate, 2)}) {
      line(from, to, ink, width_px);
      line(to, barb(1), ink, width_px);
      line(to, barb(-1), ink, width_px);
    }
  }

 private:
  int length(double px) const { return static_cast<int>(std::lround(px * scale_ * (1 << kShift))); }
  cv::Point place(Pixel at) const {
    // Map the pixel's centre to the centre of its block.
    const double half = 0.5 - 0.5 / scale_;
    // OpenCV's integer coordinates would overflow further out.
    const auto held = [](double px) { return std::clamp(px, -5e3, 5e3); };
    return {length(held(at.x - origin_.x) + half), length(held(at.y - origin_.y) + half)};
  }
  void line(Pixel from, Pixel to, Ink ink, int width_px) {
    cv::line(area_, place(from), place(to), scalar(ink), width_px, cv::LINE_AA, kShift);
  }

  cv::Mat area_;
  int scale_;
  cv::Point origin_;
};

/// Writes text and samples from left to right on a bar.
class Bar {
 public:
  explicit Bar(cv::Mat area) : area_(std::move(area)) {
    area_ = scalar(kBar);
    middle_ = area_.rows / 2;
  }

  void words(const std::string& text, Ink ink, double size = 0.75) {
    int baseline = 0;
    const cv::Size box = cv::getTextSize(text, kFont, size, 1, &baseline);
    cv::putText(area_, text, {x_, middle_ + box.height / 2}, kFont, size, scalar(ink), 1,
                cv::LINE_AA);
    x_ += box.width;
  }
  void space(int px) { x_ += px; }

  void square(Ink ink) {
    cv::rectangle(area_, cv::Rect(x_, middle_ - 6, 12, 12), scalar(ink), cv::FILLED);
    x_ += 12 + 8;
  }
  void ring(Ink ink, int width_px) {
    cv::ellipse(area_, {x_ + 12, middle_}, {11, 7}, 0, 0, 360, scalar(ink), width_px, cv::LINE_AA);
    x_ += 24 + 8;
  }
  void stroke(Ink from, Ink to) {
    for (int i = 0; i < 28; i += 2) {
      cv::line(area_, {x_ + i, middle_}, {x_ + i + 2, middle_}, scalar(mix(from, to, i / 28.0)), 3);
    }
    x_ += 28 + 8;
  }
  void arrow(Ink ink) {
    cv::arrowedLine(area_, {x_, middle_}, {x_ + 28, middle_}, scalar(ink), 2, cv::LINE_AA, 0, 0.3);
    x_ += 28 + 8;
  }

 private:
  cv::Mat area_;
  int middle_ = 0;
  int x_ = kMarginPx;
};

std::string number(const char* format, double value) {
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string state_of(const PuckEstimate& estimate) {
  std::string text = to_string(estimate.state);
  if (estimate.resting) text += ", resting";
  if (estimate.coasting) text += ", coasting";
  if (estimate.left_image) text += ", left the image";
  return text;
}

void write_facts(const TrackedMoment& moment, Bar bar) {
  const PuckEstimate& estimate = moment.estimate;
  const auto fact = [&](const char* name, const std::string& value) {
    bar.words(name, kQuietWords);
    bar.space(10);
    bar.words(value, kWords);
    bar.space(40);
  };
  fact("time", number("%.3f s", moment.seconds));
  fact("state", state_of(estimate));
  if (!estimate.position) return;
  fact("speed", number("%.0f px/s", std::hypot(estimate.velocity.x, estimate.velocity.y)));
  if (moment.truth) {
    fact("error", number("%.2f px", distance_px(*estimate.position, moment.truth->centre)));
  }
}

void write_legend(const TrackedMoment& moment, Bar bar) {
  const auto name = [&](const char* text) {
    bar.words(text, kQuietWords, 0.6);
    bar.space(26);
  };
  name("events of the last 20 ms:");
  bar.square(kBrighter);
  name("brighter");
  bar.square(kDarker);
  name("darker");
  bar.ring(kEstimate, 2);
  name("estimate");
  if (moment.truth) {
    bar.ring(kTruth, 1);
    name("truth");
  }
  bar.stroke(mix(kBackground, kTrail, 0.2), kTrail);
  name("trail, 0.5 s");
  bar.arrow(kEstimate);
  name("velocity (50 ms)");
}

// A close-up of the puck in the corner that is furthest from it.
void draw_close_up(const TrackedMoment& moment, cv::Mat area, int scale) {
  const PuckEstimate& estimate = moment.estimate;
  const double longest = std::max({estimate.size.width, estimate.size.height, 1.0});
  const int side = std::min(area.cols, area.rows) * 3 / 10;
  const int zoom = static_cast<int>(side / (kCloseUpSizes * longest));
  if (zoom < 2 * scale) return;
  const int shown = side / zoom;
  const bool right = estimate.position->x * scale < area.cols / 2.0;
  const bool low = estimate.position->y * scale < area.rows / 2.0;
  const cv::Rect frame(right ? area.cols - shown * zoom - kMarginPx : kMarginPx,
                       low ? area.rows - shown * zoom - kMarginPx : kMarginPx, shown * zoom,
                       shown * zoom);
  const Region region = Region::around(*estimate.position, shown, shown);
  cv::Mat close_up = area(frame);
  close_up = scalar(kBackground);
  SensorCanvas canvas(close_up, zoom, {region.x, region.y});
  canvas.events(moment);
  canvas.puck(moment);
  cv::rectangle(area, frame, scalar(kQuietWords));
}

}  // namespace

cv::Mat draw_picture(const TrackedMoment& moment) {
  const int scale = picture_scale(moment.sensor);
  const int width = moment.sensor.width * scale;
  const int height = moment.sensor.height * scale;
  cv::Mat picture(kPictureHeaderPx + height + kFooterPx, width, CV_8UC3, scalar(kBackground));
  SensorCanvas canvas(picture(cv::Rect(0, kPictureHeaderPx, width, height)), scale);
  canvas.events(moment);
  canvas.trail(moment);
  canvas.puck(moment);
  if (moment.estimate.position) {
    canvas.arrow(*moment.estimate.position, moment.estimate.velocity);
    draw_close_up(moment, picture(cv::Rect(0, kPictureHeaderPx, width, height)), scale);
  }
  write_facts(moment, Bar(picture(cv::Rect(0, 0, width, kPictureHeaderPx))));
  write_legend(moment, Bar(picture(cv::Rect(0, kPictureHeaderPx + height, width, kFooterPx))));
  return picture;
}

}  // namespace puck
