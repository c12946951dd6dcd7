#include "tools/view/drawing/backdrop.h"

#include <array>
#include <cstddef>

#include <opencv2/imgproc.hpp>

namespace puck {
namespace {

// Share of the colour that the oldest event keeps.
constexpr double kOldestShare = 0.3;
constexpr int kShades = 64;

cv::Vec3b pixel_of(const cv::Scalar& colour) {
  return {cv::saturate_cast<std::uint8_t>(colour[0]), cv::saturate_cast<std::uint8_t>(colour[1]),
          cv::saturate_cast<std::uint8_t>(colour[2])};
}

// Borrows the image.
cv::Mat matrix_of(const Image<std::uint8_t>& image) {
  return {image.height(), image.width(), CV_8UC1, const_cast<std::uint8_t*>(image.row(0))};
}

}  // namespace

void draw_events(const NewestEvents& events, Timestamp now, std::int64_t window_us,
                 const Palette& palette, cv::Mat& out) {
  const SensorSize sensor = events.sensor();
  out.create(sensor.height, sensor.width, CV_8UC3);
  const cv::Vec3b background = pixel_of(palette.background);
  // By polarity, then age.
  std::array<std::array<cv::Vec3b, kShades>, 2> shades;
  for (int i = 0; i < kShades; ++i) {
    const double share = 1 - (1 - kOldestShare) * i / kShades;
    const auto at = static_cast<std::size_t>(i);
    shades[0][at] = pixel_of(mixed(palette.background, palette.darker, share));
    shades[1][at] = pixel_of(mixed(palette.background, palette.brighter, share));
  }
  // In stamps, which are twice the time plus the polarity.
  const std::int64_t newest = now.us * 2 + 1;
  const std::int64_t oldest = (now.us - window_us) * 2 + 1;
  const double shades_per_stamp = kShades / (2.0 * static_cast<double>(window_us) + 1);
  for (int y = 0; y < sensor.height; ++y) {
    const std::int64_t* stamps = events.row(y);
    auto* pixels = out.ptr<cv::Vec3b>(y);
    for (int x = 0; x < sensor.width; ++x) {
      const std::int64_t stamp = stamps[x];
      if (stamp <= oldest || stamp > newest) {
        pixels[x] = background;
        continue;
      }
      const auto shade =
          static_cast<std::size_t>(static_cast<double>(newest - stamp) * shades_per_stamp);
      pixels[x] = shades[NewestEvents::is_brighter(stamp) ? 1 : 0][shade];
    }
  }
}

void draw_surface(const Image<std::uint8_t>& surface, const Palette& palette, cv::Mat& out) {
  cv::Mat table(1, 256, CV_8UC3);
  for (int i = 0; i < 256; ++i) {
    table.at<cv::Vec3b>(0, i) = pixel_of(mixed(palette.background, palette.words, i / 255.0));
  }
  cv::Mat channels;
  cv::cvtColor(matrix_of(surface), channels, cv::COLOR_GRAY2BGR);
  cv::LUT(channels, table, out);
}

void draw_heat(const Image<std::uint8_t>& heat, cv::Mat& out) {
  cv::applyColorMap(matrix_of(heat), out, cv::COLORMAP_INFERNO);
}

}  // namespace puck
