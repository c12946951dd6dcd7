#include "common/vision/paper/search_params.h"

namespace puck {

SurfaceParams SearchParams::surface_params() const {
  switch (surface) {
    case SurfaceKind::kEros:
      break;
    case SurfaceKind::kTos:
      return TosParams{};
    case SurfaceKind::kSits:
      return SitsParams{};
    case SurfaceKind::kSae:
      return SaeParams{};
  }
  return eros;
}

std::optional<SoftRing> SearchParams::make_ring(SensorSize sensor, const PuckSizeModel& size_model,
                                                bool other_wall) const {
  if (!has_ring) return std::nullopt;
  return SoftRing(sensor, size_model, contour, other_wall);
}

PuckSizeModel SearchParams::sizes_of(PuckSizeModel model) const {
  if (!sizes_by_disc) model.disc.reset();
  return model;
}

}  // namespace puck
