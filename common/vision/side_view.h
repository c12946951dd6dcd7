#pragma once

#include <cstdint>
#include <optional>

#include "common/events/sensor_size.h"
#include "common/vision/pixel.h"
#include "common/vision/puck_contour.h"

namespace puck {

/// What is different about a puck at the left and right sides of the image. Part of its ring may
/// lie outside. And it may be larger than the size model says: the head has turned away for it to
/// be seen there, so that the table lies at another slant than it was calibrated at. At the angle θ
/// beside the optical axis, the head turned away by ψ, widths are cos²(θ − ψ) / cos² θ times as
/// large, less than 1 + 2 ψ tan θ: a tenth more at the side of a lens that sees 23° to each side,
/// the head turned by 8°.
struct SideView {
  /// The ring may be so much larger all round, px.
  double slack_px = 0;
  /// Of the kContourSectors directions from its centre those in which it does not lie beyond either
  /// side; at least half of them, so that a corner of a ring is not taken for a ring.
  int sectors = kContourSectors;
};

/// Of the ring of a puck at `centre`.
SideView side_view_of(const ContourRing& ring, Pixel centre, SensorSize sensor);

/// Remembers whether the puck was at a side of the image: while it is elsewhere, what is too large
/// for a puck there is none.
class SideWatch {
 public:
  explicit SideWatch(SensorSize sensor) : sensor_(sensor) {}

  /// To be called at each decision. `puck`: where it is beyond doubt, or has left the image; none
  /// while that is not known.
  void note(const std::optional<Pixel>& puck, std::int64_t time_us);

  /// The puck is, or was within the last 0.3 s, at a side, or has left there: it may be there
  /// again, whatever is followed by then.
  bool may_be_aside(std::int64_t time_us) const { return time_us < until_us_; }

 private:
  SensorSize sensor_;
  std::int64_t until_us_ = 0;
};

}  // namespace puck
