#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/events/event.h"
#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/vision/region.h"
#include "common/vision/surface_snapshot.h"

namespace puck {

/// How a decayed pixel becomes a whole grey value.
enum class ErosRounding : std::uint8_t {
  kNearest,           ///< 255·dⁿ, rounded once.
  kTruncateEachStep,  ///< Truncated after every decay, as the authors' 8-bit surface does.
};

struct ErosParams {
  /// The paper's k: the decayed window is 2k + 1 pixels wide. 1 to 8.
  int half_width_px = 5;
  /// The paper's d: what a neighbouring event leaves of a pixel. Larger keeps old edges longer.
  double decay = 0.786;
  ErosRounding rounding = ErosRounding::kNearest;
};

/// The Exponential Reduced Ordinal Surface (paper, Algorithm 1): each event sets its pixel to 255
/// and multiplies the pixels around it by the decay. Exact and without a multiplication: a pixel
/// holds 255 − n, n the events in its window since its own last one, and becomes the grey value
/// 255·dⁿ only when it is read. Not safe for use from several threads at once.
class ErosSurface {
 public:
  /// Throws std::invalid_argument, naming the key, when a parameter is out of range.
  ErosSurface(SensorSize size, const ErosParams& params);

  /// Every event must lie inside the sensor. Batches and single events give the same surface.
  void update(const Event& event);
  void update(std::span<const Event> events);
  void update(const EventPacket& packet);
  /// Like the batch form, for a part of a packet that starts at `start`. `events` is not empty.
  void update(Timestamp start, std::span<const Event> events);

  /// Copies the part of `region` that lies inside the sensor.
  void snapshot(const Region& region, SurfaceSnapshot& out) const;
  /// Copies `part`, which lies inside `out`'s region and picture, to its place there; the stamps
  /// become those of this copy.
  void copy(const Region& part, SurfaceSnapshot& out) const;

  SensorSize size() const { return size_; }
  std::int64_t events_applied() const { return events_applied_; }
  Timestamp newest_event() const { return newest_event_; }

 private:
  template <int kVectors>
  void apply(std::span<const Event> events);

  SensorSize size_;
  int half_width_;
  std::ptrdiff_t stride_;
  std::vector<std::uint8_t> counts_;       // 255 − n, with a border as wide as the window
  std::array<std::uint8_t, 32> window_{};  // 1 for the columns of the window, 0 beyond
  std::array<std::uint8_t, 256> grey_of_count_{};
  std::int64_t events_applied_ = 0;
  Timestamp newest_event_;
};

}  // namespace puck
