#include "common/vision/surface/eros_strips.h"

#include <algorithm>
#include <cstring>

#include "common/vision/surface/eros_update.h"

namespace puck {
namespace {

// Addresses equal in their lowest 12 bits compete for the same cache sets, so neighbouring strips
// differ there by at least kApart.
constexpr std::size_t kPage = 4096;
constexpr std::size_t kApart = 256;
// The last window of the last strip is loaded in whole vectors.
constexpr std::size_t kBeyond = 256;

}  // namespace

ErosStrips::Layout ErosStrips::layout_for(int half_width) {
  return {.width = eros_strip_width(half_width),
          .touched = eros_strips_touched(half_width),
          .lines = eros_mask_lines(half_width)};
}

ErosStrips::ErosStrips(SensorSize sensor, int half_width_px)
    : half_width_(half_width_px), layout_(layout_for(half_width_px)) {
  const int side = 2 * half_width_ + 1;
  strip_bytes_ = static_cast<std::size_t>((sensor.height + 2 * half_width_) * layout_.width);
  if (const std::size_t off_page = (strip_bytes_ + kApart) % kPage; off_page < 2 * kApart) {
    strip_bytes_ += 2 * kApart - off_page;
  }
  const auto strips =
      static_cast<std::size_t>((sensor.width - 1) / layout_.width + layout_.touched);
  bytes_.resize(strips * strip_bytes_ + kBeyond);

  masks_.resize(static_cast<std::size_t>(layout_.width * layout_.touched * layout_.lines));
  for (int phase = 0; phase < layout_.width; ++phase) {
    for (int column = phase; column < phase + side; ++column) {
      const int strip = phase * layout_.touched + column / layout_.width;
      for (int row = 0; row < side; ++row) {
        const int byte = row * layout_.width + column % layout_.width;
        Line& line = masks_[static_cast<std::size_t>(strip * layout_.lines + byte / 64)];
        line.bytes[static_cast<std::size_t>(byte % 64)] = 1;
      }
    }
  }
}

void ErosStrips::apply(std::span<const Event> events) {
  apply_eros_events({bytes_.data(), strip_bytes_, masks_.front().bytes.data(), half_width_},
                    events);
}

void ErosStrips::clear(const Region& region) {
  for (int y = region.y; y < region.bottom(); ++y) {
    for (int x = region.x; x < region.right();) {
      const int column = x + half_width_;
      const int run = std::min(layout_.width - column % layout_.width, region.right() - x);
      std::memset(bytes_.data() + offset_of(column, y + half_width_), 0,
                  static_cast<std::size_t>(run));
      x += run;
    }
  }
}

void ErosStrips::take(const Region& region, SurfaceCounts& out) const {
  out.region = region;
  out.strip_width = layout_.width;
  if (region.empty()) return;
  const int first = (region.x + half_width_) / layout_.width;
  const int last = (region.right() - 1 + half_width_) / layout_.width;
  out.first_column = first * layout_.width - half_width_ - region.x;
  const auto run = static_cast<std::size_t>(region.height * layout_.width);
  out.strips.resize(static_cast<std::size_t>(last - first + 1) * run);
  std::uint8_t* to = out.strips.data();
  for (int strip = first; strip <= last; ++strip, to += run) {
    std::memcpy(to, bytes_.data() + offset_of(strip * layout_.width, region.y + half_width_), run);
  }
}

}  // namespace puck
