#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/events/event.h"
#include "common/events/sensor_size.h"
#include "common/vision/region.h"

namespace puck {

/// A part of an EROS surface as it lies in memory: taken by copying a few long runs of bytes, so
/// that the event thread loses little time; ErosGrey makes a picture of it, on any thread.
struct SurfaceCounts {
  Region region;         ///< What it shows: inside the sensor, maybe empty.
  int strip_width = 0;   ///< Columns a strip.
  int first_column = 0;  ///< Of the first strip, relative to the region's first column: 0 or less.
  std::vector<std::uint8_t> strips;  ///< One strip after the other, each row by row.
};

/// The memory of an EROS surface: a byte a pixel that holds 255 − n, n the events in its window
/// since its own last one. Pixels lie in strips of a few columns with their rows one after the
/// other, so that a window is two or three runs of bytes, whatever its place, instead of a run a
/// row; that is what makes an event cheap. Around the sensor there is a border as wide as the
/// window reaches. One thread at a time.
class ErosStrips {
 public:
  static constexpr int kMaxHalfWidth = 8;

  /// `half_width_px`: 1 to 8, the window is twice that plus one wide. All pixels are 0.
  ErosStrips(SensorSize sensor, int half_width_px);

  /// Algorithm 1 for each event, which must lie inside the sensor: all pixels of its window lose
  /// one, down to 0; its own becomes 255. Uses the widest vectors that the machine has.
  void apply(std::span<const Event> events);
  /// The same, pixel by pixel: what apply() must do.
  void apply_pixel_by_pixel(std::span<const Event> events);

  /// Sets the pixels of `region`, which lies inside the sensor, to 0.
  void clear(const Region& region);

  /// Copies `region`, which lies inside the sensor.
  void take(const Region& region, SurfaceCounts& out) const;

  std::uint8_t at(int x, int y) const {
    return bytes_[offset_of(x + half_width_, y + half_width_)];
  }
  int strip_width() const { return layout_.width; }

 private:
  // A line of cache, which vectors do not cross when it holds the masks.
  struct alignas(64) Line {
    std::array<std::uint8_t, 64> bytes{};
  };
  struct Layout {
    int width = 8;    // columns of a strip
    int touched = 2;  // strips that a window touches at most
    int lines = 1;    // cache lines that a window's part of a strip takes
  };

  static Layout layout_for(int half_width);

  // Of a pixel with the border counted in.
  std::size_t offset_of(int column, int row) const {
    return static_cast<std::size_t>(column / layout_.width) * strip_bytes_ +
           static_cast<std::size_t>(row * layout_.width + column % layout_.width);
  }

  int half_width_;
  Layout layout_;
  std::size_t strip_bytes_ = 0;
  std::vector<std::uint8_t> bytes_;
  // What a window takes from the bytes of the strips that it touches, for each column of a strip
  // that it may begin in: 1 inside the window, 0 beside and below it.
  std::vector<Line> masks_;
};

}  // namespace puck
