#include "common/vision/stopping.h"

#include "common/vision/image_bounds.h"

namespace puck {
namespace {

constexpr double kSurelyStopped = 12;
constexpr double kSilent_us = 3'000;
// More events beside the ring than this share of the missing ones: something covers the puck.
constexpr double kMostClutter = 0.2;
constexpr double kBeyondImage_px = 15;

}  // namespace

void stop_if_silent(ContourTrack& track, const ContourContext& context, std::int64_t time_us) {
  if (!context.ingredients.stopping || context.signature.density() <= 0) return;
  const double silent_us = static_cast<double>(time_us - track.last_ring_us());
  const double missing =
      track.expected_events(context.signature) * silent_us / RingEvidence::kMemory_us;
  if (missing > kSurelyStopped && silent_us > kSilent_us &&
      track.clutter_since_ring() < kMostClutter * missing) {
    track.stop_at(track.last_ring_position(), time_us, context);
  }
}

bool stop_beyond_image(ContourTrack& track, const ContourContext& context, SensorSize sensor,
                       std::int64_t time_us) {
  const Pixel position = track.filter().position();
  const Pixel followed = nearest_in_image(position, sensor, kBeyondImage_px);
  if (followed == position) return false;
  track.stop_at(followed, time_us, context);
  return true;
}

}  // namespace puck
