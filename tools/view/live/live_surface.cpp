#include "tools/view/live/live_surface.h"

#include "common/vision/presets.h"

namespace puck {
namespace {

constexpr std::int64_t kKeptAfterLook_us = 1'000'000;

}  // namespace

void LiveSurface::reset(SensorSize sensor) {
  sensor_ = sensor;
  surface_.reset();
}

void LiveSurface::update(const EventPacket& packet, std::int64_t now_us) {
  if (!surface_) return;
  if (now_us - wanted_us_ > kKeptAfterLook_us) {
    surface_.reset();
    return;
  }
  surface_->update(packet);
}

void LiveSurface::fill(ViewScene& scene, std::int64_t now_us) {
  wanted_us_ = now_us;
  if (!surface_) surface_.emplace(sensor_, default_params().surface_params());
  surface_->snapshot(Region::all_of(sensor_), snapshot_);
  scene.surface = snapshot_.grey;
}

}  // namespace puck
