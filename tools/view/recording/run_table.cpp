#include "tools/view/recording/run_table.h"

#include "common/messaging/conversions.h"
#include "tools/view/table/table_messages.h"

namespace puck {
namespace {

// A clock without an error, on which sensor time 0 is this time.
constexpr ClockOffset kSensorClock{};
constexpr std::int64_t kSensorZero_us = 1'000'000'000;
constexpr std::int64_t kTrackerSession = 1;
constexpr std::int64_t kCameraSession = 2;

PlayBridgeParams bridge_params(const TableCalibration& calibration) {
  PlayBridgeParams params;
  // Enough for pictures.
  params.max_trajectory_hz = 100;
  if (calibration.motion) params.motion = with_constants(params.motion, *calibration.motion);
  return params;
}

}  // namespace

RunTable::RunTable(const TableCalibration& calibration, SensorSize sensor)
    : sensor_(sensor),
      bridge_(bridge_params(calibration), calibration.table_from_image, calibration.geometry,
              calibration.camera) {
  table_.geometry = calibration.geometry;
}

void RunTable::take(const PuckEstimate& estimate, Timestamp tick) {
  const HostNow now{kSensorZero_us + tick.us, kSensorZero_us + tick.us};
  PublishedEstimate published{{now.utime, kTrackerSession, estimates_++}, estimate};
  published.sensor = sensor_;
  published.events_session = kCameraSession;
  published.event_utime = kSensorZero_us + estimate.newest_event.us;
  published.is_live = true;
  bridge_.hear(published, now, kSensorClock);
  if (const auto trajectory = bridge_.next_trajectory(now)) {
    puck::take(to_message(*trajectory), table_);
  }
  if (const auto game = bridge_.next_game(now)) puck::take(to_message(*game), table_);
}

}  // namespace puck
