#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/events/event.h"
#include "common/events/sensor_size.h"
#include "common/vision/geometry/region.h"

namespace puck {

/// A part of a surface in its memory layout. Taking it copies a few long runs of bytes, so the
/// event thread loses little time; GreyTable converts it to a picture, on any thread.
struct SurfaceCounts {
  Region region;         ///< Its place: inside the sensor, maybe empty.
  int strip_width = 0;   ///< Columns a strip.
  int first_column = 0;  ///< Of the first strip, relative to the region's first column: 0 or less.
  std::vector<std::uint8_t> strips;  ///< One strip after the other, each row by row.

  /// Room for `new_region` as one strip, row by row.
  void reset_to_rows(const Region& new_region) {
    region = new_region;
    strip_width = region.width;
    first_column = 0;
    strips.resize(static_cast<std::size_t>(region.width) * static_cast<std::size_t>(region.height));
  }
};

/// The memory of an EROS surface: a byte a pixel that holds 255 − n, n the events in its window
/// since its own last one. Pixels lie in strips of a few columns, row after row, so that a window
/// is two or three runs of bytes at any place, instead of a run for each row: this makes events
/// cheap. A border as wide as the window's reach surrounds the sensor. One thread at a time.
class ErosStrips {
 public:
  static constexpr int kMaxHalfWidth = 8;

  /// `half_width_px`: 1 to 8, the window is twice that plus one wide. All pixels are 0.
  ErosStrips(SensorSize sensor, int half_width_px);

  /// Algorithm 1 for each event, which must lie inside the sensor: subtracts 1 from all pixels of
  /// its window, down to 0, and sets its own to 255. Uses the machine's widest vectors.
  void apply(std::span<const Event> events);

  /// Sets the pixels of `region`, which lies inside the sensor, to 0.
  void clear(const Region& region);

  /// Copies `region`, which lies inside the sensor.
  void take(const Region& region, SurfaceCounts& out) const;

  std::uint8_t at(int x, int y) const {
    return bytes_[offset_of(x + half_width_, y + half_width_)];
  }
  int strip_width() const { return layout_.width; }

 private:
  // A cache line: vectors do not cross one when they load masks.
  struct alignas(64) Line {
    std::array<std::uint8_t, 64> bytes{};
  };
  struct Layout {
    int width = 8;    // columns of a strip
    int touched = 2;  // strips that a window touches at most
    int lines = 1;    // cache lines that a window's part of a strip takes
  };

  static Layout layout_for(int half_width);

  // Of a pixel in coordinates with the border.
  std::size_t offset_of(int column, int row) const {
    return static_cast<std::size_t>(column / layout_.width) * strip_bytes_ +
           static_cast<std::size_t>(row * layout_.width + column % layout_.width);
  }

  int half_width_;
  Layout layout_;
  std::size_t strip_bytes_ = 0;
  std::vector<std::uint8_t> bytes_;
  // The amount that a window subtracts from the bytes of the strips it touches, for each first
  // column in a strip: 1 inside the window, 0 beside and below it.
  std::vector<Line> masks_;
};

}  // namespace puck
