#include "common/vision/eros_surface.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "common/vision/region_filter.h"

namespace puck {
namespace {

const ErosParams& checked(SensorSize size, const ErosParams& params) {
  if (!size.is_valid()) {
    throw std::invalid_argument("the sensor must be 1x1 to 2048x2048 pixels, got " +
                                std::to_string(size.width) + "x" + std::to_string(size.height));
  }
  if (params.half_width_px < 1 || params.half_width_px > ErosStrips::kMaxHalfWidth) {
    throw std::invalid_argument("tracker.half_width_px must be 1 to 8, got " +
                                std::to_string(params.half_width_px));
  }
  if (!(params.decay > 0 && params.decay < 1)) {
    throw std::invalid_argument("tracker.decay must lie between 0 and 1, got " +
                                std::to_string(params.decay));
  }
  return params;
}

}  // namespace

ErosSurface::ErosSurface(SensorSize size, const ErosParams& params)
    : size_(size),
      half_width_(checked(size, params).half_width_px),
      strips_(size, half_width_),
      grey_(params.decay, params.rounding),
      kept_(Region::all_of(size)) {}

void ErosSurface::update(const Event& event) { update(std::span(&event, 1)); }

void ErosSurface::update(std::span<const Event> events) {
  events_applied_ += static_cast<std::int64_t>(events.size());
  if (kept_ == Region::all_of(size_)) {
    strips_.apply(events);
    return;
  }
  for_inside(events, kept_.inflated(half_width_),
             [this](std::span<const Event> inside) { strips_.apply(inside); });
}

void ErosSurface::update(const EventPacket& packet) {
  if (!packet.empty()) update(packet.start, packet.events);
}

void ErosSurface::update(Timestamp start, std::span<const Event> events) {
  update(events);
  newest_event_ = start + events.back().offset_us;
}

void ErosSurface::keep_only(const Region& region) {
  const Region all = Region::all_of(size_);
  const Region now = region.intersect(all);
  if (now == kept_) return;
  // Windows of kept events also reach outside the kept region.
  const Region traces = kept_.inflated(half_width_).intersect(all);
  const Region stays = kept_.intersect(now);
  kept_ = now;
  if (stays.empty()) {
    strips_.clear(traces);
    return;
  }
  strips_.clear({traces.x, traces.y, traces.width, stays.y - traces.y});
  strips_.clear({traces.x, stays.bottom(), traces.width, traces.bottom() - stays.bottom()});
  strips_.clear({traces.x, stays.y, stays.x - traces.x, stays.height});
  strips_.clear({stays.right(), stays.y, traces.right() - stays.right(), stays.height});
}

void ErosSurface::snapshot(const Region& region, SurfaceSnapshot& out) {
  take(region, taken_);
  develop(taken_, out);
}

void ErosSurface::take(const Region& region, SurfaceExposure& out) const {
  strips_.take(region.intersect(Region::all_of(size_)), out.counts);
  out.newest_event = newest_event_;
  out.events_applied = events_applied_;
}

void ErosSurface::develop(SurfaceExposure& taken, SurfaceSnapshot& out) const {
  out.region = taken.counts.region;
  out.grey.resize(out.region.width, out.region.height);
  develop_part(taken, out);
}

void ErosSurface::develop_part(SurfaceExposure& taken, SurfaceSnapshot& out) const {
  const Region& part = taken.counts.region;
  out.newest_event = taken.newest_event;
  out.events_applied = taken.events_applied;
  grey_.develop(taken.counts, out.picture_of(part));
}

}  // namespace puck
