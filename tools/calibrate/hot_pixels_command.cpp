#include "tools/calibrate/hot_pixels_command.h"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "common/calibration/hot_pixels.h"
#include "common/io/pixel_mask_file.h"

namespace puck {
namespace {

constexpr std::size_t kPrinted = 10;

void print(const HotPixelReport& report) {
  std::printf("%zu hot pixels in %.1f s; half of all pixels fire at %.2f Hz or less\n",
              report.pixels.size(), report.seconds, report.median_rate_hz);
  std::printf("they made %lld of %lld events, %.2f %%\n", static_cast<long long>(report.hot_events),
              static_cast<long long>(report.events),
              100.0 * static_cast<double>(report.hot_events) / static_cast<double>(report.events));
  if (report.pixels.empty()) return;
  std::printf("   x    y        Hz  active %%\n");
  for (std::size_t i = 0; i < std::min(kPrinted, report.pixels.size()); ++i) {
    const HotPixel& pixel = report.pixels[i];
    std::printf("%4d %4d %9.1f %9.0f\n", pixel.place.x, pixel.place.y, pixel.rate_hz,
                100 * pixel.active_share);
  }
  if (report.pixels.size() > kPrinted) {
    std::printf("and %zu more\n", report.pixels.size() - kPrinted);
  }
}

}  // namespace

void calibrate_hot_pixels(const HotPixelsCommand& command, const std::string& typed) {
  const auto events = open_event_file(command.recording, command.file);
  HotPixelFinder finder(events->sensor_size());
  EventPacket packet;
  while (events->read(packet, EventReader::kUsualEvents)) finder.add(packet);
  const HotPixelReport report = finder.find();
  std::vector<PixelPlace> places;
  for (const HotPixel& pixel : report.pixels) places.push_back(pixel.place);
  write_pixel_mask_file(command.output, PixelMask(events->sensor_size(), places), typed);
  print(report);
}

}  // namespace puck
