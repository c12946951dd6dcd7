#include "common/vision/surface/surface.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "common/vision/surface/region_filter.h"

namespace puck {
namespace {

void require(bool holds, const std::string& message) {
  if (!holds) throw std::invalid_argument(message);
}

void check(const ErosParams& params) {
  require(params.half_width_px >= 1 && params.half_width_px <= ErosStrips::kMaxHalfWidth,
          "tracker.half_width_px must be 1 to 8, got " + std::to_string(params.half_width_px));
  require(params.decay > 0 && params.decay < 1,
          "tracker.decay must lie between 0 and 1, got " + std::to_string(params.decay));
}

void check(const TosParams& params) {
  require(params.half_width_px >= 1 && params.half_width_px <= ErosStrips::kMaxHalfWidth,
          "tos.half_width_px must be 1 to 8, got " + std::to_string(params.half_width_px));
  require(params.depth >= 1 && params.depth <= 254,
          "tos.depth must be 1 to 254, got " + std::to_string(params.depth));
}

void check(const SitsParams& params) {
  require(params.radius_px >= 1 && params.radius_px <= SitsPixels::kMaxRadius,
          "sits.radius_px must be 1 to 7, got " + std::to_string(params.radius_px));
}

void check(const SaeParams& params) {
  require(params.time_constant_us >= 100 && params.time_constant_us <= 1'000'000,
          "sae.time_constant_us must be 100 to 1000000, got " +
              std::to_string(params.time_constant_us));
}

SensorSize checked(SensorSize size, const SurfaceParams& params) {
  require(size.is_valid(), "the sensor must be 1x1 to 2048x2048 pixels, got " +
                               std::to_string(size.width) + "x" + std::to_string(size.height));
  std::visit([](const auto& kind) { check(kind); }, params);
  return size;
}

int half_width_of(const ErosParams& params) { return params.half_width_px; }
int half_width_of(const TosParams& params) { return params.half_width_px; }
int half_width_of(const SitsParams& params) { return params.radius_px; }
int half_width_of(const SaeParams&) { return 0; }

GreyValues tos_greys(const TosParams& params) {
  GreyValues greys{};
  for (int value = 255 - params.depth; value <= 255; ++value) {
    greys[static_cast<std::size_t>(value)] = static_cast<std::uint8_t>(value);
  }
  return greys;
}

}  // namespace

const char* to_string(SurfaceKind kind) {
  return kSurfaceNames.at(static_cast<std::size_t>(kind)).data();
}

std::optional<SurfaceKind> surface_kind_from(std::string_view name) {
  const auto* const found = std::find(kSurfaceNames.begin(), kSurfaceNames.end(), name);
  if (found == kSurfaceNames.end()) return std::nullopt;
  return static_cast<SurfaceKind>(found - kSurfaceNames.begin());
}

Surface::Surface(SensorSize size, const SurfaceParams& params)
    : size_(checked(size, params)),
      half_width_(std::visit([](const auto& kind) { return half_width_of(kind); }, params)),
      pixels_(pixels_of(size, params)),
      grey_(greys_of(params, pixels_)),
      kept_(Region::all_of(size)) {}

Surface::Pixels Surface::pixels_of(SensorSize size, const SurfaceParams& params) {
  if (const auto* sits = std::get_if<SitsParams>(&params)) return SitsPixels(size, *sits);
  if (const auto* sae = std::get_if<SaeParams>(&params)) return SaePixels(size, *sae);
  return std::visit([&](const auto& kind) { return ErosStrips(size, half_width_of(kind)); },
                    params);
}

GreyValues Surface::greys_of(const SurfaceParams& params, const Pixels& pixels) {
  if (const auto* sits = std::get_if<SitsPixels>(&pixels)) return sits->greys();
  if (const auto* sae = std::get_if<SaePixels>(&pixels)) return sae->greys();
  if (const auto* tos = std::get_if<TosParams>(&params)) return tos_greys(*tos);
  const auto& eros = std::get<ErosParams>(params);
  return eros_greys(eros.decay, eros.rounding);
}

void Surface::apply(Timestamp start, std::span<const Event> events) {
  events_applied_ += static_cast<std::int64_t>(events.size());
  if (kept_ == Region::all_of(size_)) {
    apply_to_pixels(start, events);
    return;
  }
  for_inside(events, kept_.inflated(half_width_),
             [&](std::span<const Event> inside) { apply_to_pixels(start, inside); });
}

void Surface::apply_to_pixels(Timestamp start, std::span<const Event> events) {
  if (auto* strips = std::get_if<ErosStrips>(&pixels_)) return strips->apply(events);
  if (auto* sits = std::get_if<SitsPixels>(&pixels_)) return sits->apply(events);
  std::get<SaePixels>(pixels_).apply(start, events);
}

void Surface::clear(const Region& region) {
  std::visit([&](auto& pixels) { pixels.clear(region); }, pixels_);
}

void Surface::update(const Event& event) { update(std::span(&event, 1)); }

void Surface::update(std::span<const Event> events) { apply({}, events); }

void Surface::update(const EventPacket& packet) {
  if (!packet.empty()) update(packet.start, packet.events);
}

void Surface::update(Timestamp start, std::span<const Event> events) {
  apply(start, events);
  newest_event_ = start + events.back().offset_us;
}

void Surface::keep_only(const Region& region) {
  const Region all = Region::all_of(size_);
  const Region now = region.intersect(all);
  if (now == kept_) return;
  // Windows of kept events also reach outside the kept region.
  const Region traces = kept_.inflated(half_width_).intersect(all);
  const Region stays = kept_.intersect(now);
  kept_ = now;
  if (stays.empty()) {
    clear(traces);
    return;
  }
  clear({traces.x, traces.y, traces.width, stays.y - traces.y});
  clear({traces.x, stays.bottom(), traces.width, traces.bottom() - stays.bottom()});
  clear({traces.x, stays.y, stays.x - traces.x, stays.height});
  clear({stays.right(), stays.y, traces.right() - stays.right(), stays.height});
}

void Surface::snapshot(const Region& region, SurfaceSnapshot& out) {
  take(region, taken_);
  develop(taken_, out);
}

void Surface::take(const Region& region, SurfaceExposure& out) const {
  const Region part = region.intersect(Region::all_of(size_));
  if (const auto* sae = std::get_if<SaePixels>(&pixels_)) {
    sae->take(part, newest_event_, out.counts);
  } else if (const auto* sits = std::get_if<SitsPixels>(&pixels_)) {
    sits->take(part, out.counts);
  } else {
    std::get<ErosStrips>(pixels_).take(part, out.counts);
  }
  out.newest_event = newest_event_;
  out.events_applied = events_applied_;
}

void Surface::develop(SurfaceExposure& taken, SurfaceSnapshot& out) const {
  out.region = taken.counts.region;
  out.grey.resize(out.region.width, out.region.height);
  develop_part(taken, out);
}

void Surface::develop_part(SurfaceExposure& taken, SurfaceSnapshot& out) const {
  const Region& part = taken.counts.region;
  out.newest_event = taken.newest_event;
  out.events_applied = taken.events_applied;
  grey_.develop(taken.counts, out.picture_of(part));
}

}  // namespace puck
