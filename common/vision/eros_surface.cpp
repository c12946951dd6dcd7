#include "common/vision/eros_surface.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>

namespace puck {
namespace {

constexpr int kMaxHalfWidth = 8;

// Rows end with room for the widest load beyond the last column of the last window, and begin far
// enough apart that the rows of a window do not compete for the same cache sets: strides that are
// multiples of a large power of two would.
std::ptrdiff_t stride_for(int width, int half_width) {
  std::ptrdiff_t stride = width + 2 * half_width + 32;
  if (stride % 256 < 32) stride += 32;
  return stride;
}

std::array<std::uint8_t, 256> grey_table(const ErosParams& params) {
  std::array<std::uint8_t, 256> table{};
  int truncated = 255;
  for (int n = 0; n < 255; ++n) {
    table[static_cast<std::size_t>(255 - n)] =
        params.rounding == ErosRounding::kNearest
            ? static_cast<std::uint8_t>(std::lround(255 * std::pow(params.decay, n)))
            : static_cast<std::uint8_t>(truncated);
    truncated = static_cast<int>(truncated * params.decay);
  }
  // A pixel that never fired, or not for 255 neighbouring events, is dark.
  table[0] = 0;
  return table;
}

using Vector = std::array<std::uint8_t, 16>;

// The local copy tells the compiler that nothing overlaps, so that it uses vector instructions.
void subtract_saturated(std::uint8_t* pixels, const Vector& amount) {
  Vector values;
  std::memcpy(values.data(), pixels, sizeof(values));
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = static_cast<std::uint8_t>(values[i] - std::min(values[i], amount[i]));
  }
  std::memcpy(pixels, values.data(), sizeof(values));
}

}  // namespace

ErosSurface::ErosSurface(SensorSize size, const ErosParams& params)
    : size_(size), half_width_(params.half_width_px) {
  if (!size.is_valid()) {
    throw std::invalid_argument("the sensor must be 1x1 to 2048x2048 pixels, got " +
                                std::to_string(size.width) + "x" + std::to_string(size.height));
  }
  if (half_width_ < 1 || half_width_ > kMaxHalfWidth) {
    throw std::invalid_argument("tracker.half_width_px must be 1 to 8, got " +
                                std::to_string(half_width_));
  }
  if (!(params.decay > 0 && params.decay < 1)) {
    throw std::invalid_argument("tracker.decay must lie between 0 and 1, got " +
                                std::to_string(params.decay));
  }
  stride_ = stride_for(size.width, half_width_);
  counts_.resize(static_cast<std::size_t>(stride_ * (size.height + 2 * half_width_)));
  std::fill_n(window_.begin(), 2 * half_width_ + 1, std::uint8_t{1});
  grey_of_count_ = grey_table(params);
}

void ErosSurface::update(const Event& event) { update(std::span(&event, 1)); }

void ErosSurface::update(std::span<const Event> events) {
  if (2 * half_width_ + 1 <= 16) {
    apply<1>(events);
  } else {
    apply<2>(events);
  }
  events_applied_ += static_cast<std::int64_t>(events.size());
}

void ErosSurface::update(const EventPacket& packet) {
  if (!packet.empty()) update(packet.start, packet.events);
}

void ErosSurface::update(Timestamp start, std::span<const Event> events) {
  update(events);
  newest_event_ = start + events.back().offset_us;
}

template <int kVectors>
void ErosSurface::apply(std::span<const Event> events) {
  const int rows = 2 * half_width_ + 1;
  std::array<Vector, kVectors> window;
  std::memcpy(window.data(), window_.data(), sizeof(window));
  for (const Event& event : events) {
    // Algorithm 1, lines 2–6: decay the window. Whole vectors are loaded and stored for each row;
    // the columns beyond the window lose nothing.
    std::uint8_t* row = counts_.data() + event.y * stride_ + event.x;
    for (int r = 0; r < rows; ++r, row += stride_) {
      for (std::size_t v = 0; v < kVectors; ++v) {
        subtract_saturated(row + v * sizeof(Vector), window[v]);
      }
    }
    // Algorithm 1, line 7: the event's own pixel.
    counts_[static_cast<std::size_t>((event.y + half_width_) * stride_ + event.x + half_width_)] =
        255;
  }
}

void ErosSurface::snapshot(const Region& region, SurfaceSnapshot& out) const {
  out.region = region.intersect(Region::all_of(size_));
  out.grey.resize(out.region.width, out.region.height);
  copy(out.region, out);
}

void ErosSurface::copy(const Region& part, SurfaceSnapshot& out) const {
  out.newest_event = newest_event_;
  out.events_applied = events_applied_;
  for (int y = part.y; y < part.bottom(); ++y) {
    const std::uint8_t* from =
        counts_.data() + (y + half_width_) * stride_ + part.x + half_width_;
    std::uint8_t* to = out.grey.row(y - out.region.y) + (part.x - out.region.x);
    for (int x = 0; x < part.width; ++x) to[x] = grey_of_count_[from[x]];
  }
}

}  // namespace puck
