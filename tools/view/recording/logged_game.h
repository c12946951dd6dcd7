#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "common/events/sensor_size.h"
#include "common/events/timestamp.h"
#include "common/messaging/log_file.h"
#include "common/vision/interfaces/puck_estimate.h"
#include "tools/view/interface/view_scene.h"

namespace puck {

/// What the services said in a log, as sensor time passes: the tracker's estimates, the bridge's
/// trajectory and game, the arm. Follows the first run of the camera and the first tracker and
/// bridge on its events; in a log without events, the run that the first estimate names. Reads the
/// log once, in constant memory. One thread.
class LoggedGame {
 public:
  /// Throws LogFileError.
  LoggedGame(std::filesystem::path path, std::string prefix);

  /// Starts again before the first message.
  void rewind();
  /// Takes all messages up to this sensor time, and those that tell no sensor time between them.
  void advance_to(Timestamp until);

  /// Whether there are later messages, at most an hour after `now`.
  bool has_more(Timestamp now);

  /// The newest estimate.
  const std::optional<PuckEstimate>& estimate() const { return estimate_; }
  /// Empty before the first TRAJECTORY, GAME or ARM_STATE.
  const std::optional<ViewTable>& table() const { return table_; }

 private:
  bool find_next();
  void take_next();
  ViewTable& table_of_game();

  std::filesystem::path path_;
  std::string prefix_;
  std::int64_t events_session_ = 0;  // 0: not known yet.
  std::optional<LogReader> log_;
  LogRecord record_;
  bool has_record_ = false;
  Timestamp record_time_;  // Sensor time of the record, or of the newest one before it.
  std::int64_t tracker_session_ = 0;
  std::optional<PuckEstimate> estimate_;
  std::optional<ViewTable> table_;
};

/// What the estimates in a log tell of the camera.
struct LoggedCamera {
  SensorSize sensor;
  Timestamp first;  ///< Sensor time of the estimate.
  Timestamp last;   ///< Of the last one.
};

/// Nothing in a log without estimates. Throws LogFileError.
std::optional<LoggedCamera> camera_of_log(const std::filesystem::path& path,
                                          const std::string& prefix);

}  // namespace puck
