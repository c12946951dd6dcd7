#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/events/event.h"
#include "common/events/sensor_size.h"
#include "common/vision/geometry/region.h"
#include "common/vision/surface/eros_strips.h"
#include "common/vision/surface/grey_table.h"

namespace puck {

struct SitsParams {
  /// The paper's r: the window is 2r + 1 pixels wide. 1 to 7.
  int radius_px = 5;
};

/// The pixels of a Speed Invariant Time Surface (Manderscheid, Sironi, Bourdis, Migliore and
/// Lepetit: Speed Invariant Time Surface for Learning to Detect Corner Points with Event-Based
/// Cameras, CVPR 2019, Algorithm 1), a byte each. As in EROS, both polarities share a surface,
/// where the paper has two. One thread at a time.
class SitsPixels {
 public:
  static constexpr int kMaxRadius = 7;  // so that (2r + 1)² fits a byte

  SitsPixels(SensorSize sensor, const SitsParams& params);

  /// For each event, which must lie inside the sensor: subtracts 1 from all pixels of its window
  /// that are not less than its own, down to 0, and sets its own to (2r + 1)².
  void apply(std::span<const Event> events);

  /// Sets the pixels of `region`, which lies inside the sensor, to 0.
  void clear(const Region& region);

  /// Copies `region`, which lies inside the sensor.
  void take(const Region& region, SurfaceCounts& out) const;

  /// The pixels' values, scaled from (2r + 1)² to 255.
  GreyValues greys() const;

 private:
  // Bytes of a vector, which holds a row of any window.
  static constexpr std::size_t kRow = 16;

  std::size_t offset_of(int x, int y) const;

  int radius_;
  std::uint8_t highest_;
  std::size_t stride_;
  std::array<std::uint8_t, kRow> window_{};  // 1 inside a window's row, 0 beside it
  std::vector<std::uint8_t> pixels_;         // with a border as wide as the radius
};

}  // namespace puck
