#pragma once

#include "common/events/sensor_size.h"
#include "common/vision/contour_calibration.h"
#include "common/vision/pixel.h"
#include "common/vision/puck_size_model.h"

namespace puck {

/// What the size model says of the contour at one place.
struct ContourPlace {
  PuckSize size;
  double shear = 0;  ///< Of a flat disc there, px along x per px along y; 0 where it is not known.
};

/// The same anywhere in the image.
class ContourPlaces {
 public:
  ContourPlaces(SensorSize sensor, const PuckSizeModel& size_model);

  ContourPlace at(Pixel centre) const;

 private:
  PuckSizeModel size_model_;
  double middle_column_;
  double horizon_row_ = 0;
  bool is_plane_;
};

/// Where a point lies relative to the ring on which the contour's events are expected.
struct RingOffset {
  double distance_px = 0;  ///< To first order; positive outside.
  double normal_x = 0;     ///< Unit vector out of the ring there.
  double normal_y = 0;
};

/// Of a point at (dx, dy) from the centre of a puck. The ring is the ellipse of the size model with
/// full axes larger by the growth, its lower edge raised by the wall's share of the width, sheared
/// as a disc on a plane is.
RingOffset ring_offset(const ContourPlace& place, const ContourCalibration& calibration, double dx,
                       double dy);

}  // namespace puck
