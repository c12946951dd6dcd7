#pragma once

#include <cstdint>
#include <span>

#include "common/events/event.h"
#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/vision/eros_grey.h"
#include "common/vision/eros_strips.h"
#include "common/vision/region.h"
#include "common/vision/surface_snapshot.h"

namespace puck {

struct ErosParams {
  /// The paper's k: the decayed window is 2k + 1 pixels wide. 1 to 8.
  int half_width_px = 5;
  /// The paper's d: factor by which an event fades its neighbours. Larger keeps old edges longer.
  double decay = 0.786;
  ErosRounding rounding = ErosRounding::kNearest;
};

/// A part of the surface with its stamps, taken on the event thread and developed on another.
struct SurfaceExposure {
  SurfaceCounts counts;
  Timestamp newest_event;           ///< Newest event on the surface when it was taken.
  std::int64_t events_applied = 0;  ///< Events applied to the surface until then.
};

/// The Exponential Reduced Ordinal Surface (paper, Algorithm 1): each event sets its pixel to 255
/// and multiplies the pixels around it by the decay. Exact and without a multiplication: a pixel
/// holds 255 − n, n the events in its window since its own last one, and is converted to the grey
/// value 255·dⁿ only when it is read. One thread at a time, except develop().
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

  /// Keeps only `region` up to date from now on, which is cheaper: events outside its reach are
  /// counted but not applied. Pixels outside the region become dark, and pixels that enter it later
  /// start dark. The whole sensor, as at the start, keeps all.
  void keep_only(const Region& region);

  /// Copies the part of `region` that lies inside the sensor.
  void snapshot(const Region& region, SurfaceSnapshot& out);

  /// snapshot() in two steps: the first is quick …
  void take(const Region& region, SurfaceExposure& out) const;
  /// … and the second, which overwrites `taken`, may run while another thread updates the surface.
  void develop(SurfaceExposure& taken, SurfaceSnapshot& out) const;
  /// As develop(), but into its place in `out`, whose region contains that of `taken`.
  void develop_part(SurfaceExposure& taken, SurfaceSnapshot& out) const;

  SensorSize size() const { return size_; }
  std::int64_t events_applied() const { return events_applied_; }
  Timestamp newest_event() const { return newest_event_; }

 private:
  SensorSize size_;
  int half_width_;
  ErosStrips strips_;
  ErosGrey grey_;
  Region kept_;            // the part kept up to date
  SurfaceExposure taken_;  // of a snapshot
  std::int64_t events_applied_ = 0;
  Timestamp newest_event_;
};

}  // namespace puck
