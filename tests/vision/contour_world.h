#pragma once

#include <cstdint>
#include <vector>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/vision/contour_track.h"
#include "common/vision/region.h"
#include "tests/vision/moving_contour.h"

namespace puck::test {

inline constexpr SensorSize kSensor{640, 480};
inline constexpr Region kImage = Region::all_of(kSensor);
inline constexpr PuckSizeModel kSizeModel{14, 0, 0.077, 5, 0, 0.077};

/// All that is the same for contour tracks, of a sensor without lag.
inline ContourContext contour_context() {
  return {PuckContour(kSensor, kSizeModel, {0, 0, 0}, true), {}, {}, {}};
}

/// Lets a track follow a puck for some milliseconds, with a decision each; the mean error of the
/// second half, px.
inline double follow(ContourTrack& track, MovingContour& puck, const ContourContext& context,
                     std::int64_t from_us, std::int64_t to_us) {
  double sum = 0;
  int count = 0;
  for (std::int64_t t = from_us; t < to_us; t += 1000) {
    for (const ContourEvent& event : puck.events(t, t + 1000)) track.take(event, context);
    track.decide(t + 1000, false, context);
    if (t < (from_us + to_us) / 2) continue;
    sum += distance_px(track.filter().position(), puck.position_at(t + 1000));
    ++count;
  }
  return sum / count;
}

/// What of these events lies on a sensor, as a packet that starts at `start_us`; the events' times
/// count from `origin_us`.
inline EventPacket packet_of(const std::vector<ContourEvent>& events, SensorSize sensor,
                             std::int64_t start_us, std::int64_t origin_us) {
  EventPacket packet{{start_us}, {}};
  for (const ContourEvent& event : events) {
    if (!sensor.contains(static_cast<int>(event.x), static_cast<int>(event.y))) continue;
    Event made{static_cast<std::uint16_t>(event.x), 0, 0,
               static_cast<std::uint32_t>(event.time_us - origin_us)};
    made.y = static_cast<std::uint16_t>(event.y) & 0x7fffu;
    made.polarity = event.on ? 1 : 0;
    packet.events.push_back(made);
  }
  return packet;
}

}  // namespace puck::test
