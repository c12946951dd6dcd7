#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/events/event.h"
#include "common/events/sensor_size.h"
#include "common/events/timestamp.h"
#include "common/vision/geometry/region.h"
#include "common/vision/surface/eros_strips.h"
#include "common/vision/surface/grey_table.h"

namespace puck {

struct SaeParams {
  /// A pixel fades to 1/e in this time, µs. 100 to 1,000,000.
  std::int64_t time_constant_us = 5'000;
};

/// The Surface of Active Events (Benosman, Clercq, Lagorce, Ieng and Bartolozzi: Event-Based Visual
/// Flow, TNNLS 2014): the time of each pixel's last event. Shown with the exponential decay of
/// Lagorce, Orchard, Galluppi, Shi and Benosman (HOTS, TPAMI 2017), as it is at the newest event.
/// Both polarities share a surface. One thread at a time.
class SaePixels {
 public:
  SaePixels(SensorSize sensor, const SaeParams& params);

  /// Events of a packet that starts at `start`. All lie inside the sensor.
  void apply(Timestamp start, std::span<const Event> events);

  /// Makes the pixels of `region`, which lies inside the sensor, dark.
  void clear(const Region& region);

  /// Takes `region`, which lies inside the sensor: 255 less each pixel's age at `now`, in ticks.
  void take(const Region& region, Timestamp now, SurfaceCounts& out) const;

  /// Grey values of the ages: 255·exp(−age / time constant).
  GreyValues greys() const;

 private:
  // Ages below 256 ticks are told apart.
  std::uint32_t tick_of(std::int64_t time_us) const;

  int width_;
  double time_constant_us_;
  int tick_bits_;  // a tick is 2 to this power, µs
  // 0 before the first event. Times wrap after 2³² ticks, 150 hours with the default; for an
  // instant pixels that never fired are bright then.
  std::vector<std::uint32_t> last_;
};

}  // namespace puck
