#include "tools/view/recording/logged_game.h"

#include <algorithm>
#include <utility>

#include "common/messaging/channels.h"
#include "common/messaging/conversions.h"
#include "common/messaging/message_codec.h"
#include "common/recording/log_recording.h"
#include "tools/view/table/table_messages.h"

namespace puck {
namespace {

// A later time is damaged.
constexpr std::int64_t kLongestPause_us = std::int64_t{3600} * 1'000'000;

template <typename Message>
std::optional<Message> decoded(const LogRecord& record) {
  Message message;
  if (decode(record.bytes, message)) return std::nullopt;
  return message;
}

}  // namespace

LoggedGame::LoggedGame(std::filesystem::path path, std::string prefix)
    : path_(std::move(path)), prefix_(std::move(prefix)) {
  rewind();
  try {
    events_session_ = session_of_event_log(path_, prefix_);
  } catch (const LogFileError&) {
    // Without events.
  }
}

void LoggedGame::rewind() {
  log_.emplace(path_);
  has_record_ = false;
  record_time_ = {};
  tracker_session_ = 0;
  estimate_.reset();
  table_.reset();
}

void LoggedGame::advance_to(Timestamp until) {
  while (find_next() && record_time_ <= until) take_next();
}

bool LoggedGame::has_more(Timestamp now) {
  return find_next() && record_time_ - now <= kLongestPause_us;
}

// Finds the next message that is of use, and its time.
bool LoggedGame::find_next() {
  while (!has_record_) {
    if (!log_->next(record_)) return false;
    const std::optional<Channel> channel = find_channel(record_.channel, prefix_);
    if (!channel) continue;
    std::optional<std::int64_t> sensor_us;
    switch (*channel) {
      case Channel::kEstimate: {
        const auto estimate = decoded<puck_estimate_t>(record_);
        if (!estimate) continue;
        if (events_session_ == 0) events_session_ = estimate->events_session;
        if (estimate->events_session != events_session_) continue;
        if (tracker_session_ == 0) tracker_session_ = estimate->session;
        if (estimate->session != tracker_session_) continue;
        sensor_us = estimate->sensor_us;
        break;
      }
      case Channel::kTrajectory: {
        const auto trajectory = decoded<puck_trajectory_t>(record_);
        if (!trajectory || trajectory->estimate_session != tracker_session_) continue;
        sensor_us = trajectory->sensor_us;
        break;
      }
      case Channel::kTruth: {
        const auto truth = decoded<ground_truth_t>(record_);
        if (!truth) continue;
        sensor_us = truth->sensor_us;
        break;
      }
      case Channel::kGame:
      case Channel::kArmState:
      case Channel::kArmCommand:
        break;
      case Channel::kEvents:
      case Channel::kHead:
      case Channel::kCameraControl:
      case Channel::kStatus:
        continue;
    }
    if (sensor_us && is_sensor_time(Timestamp{*sensor_us})) {
      record_time_ = std::max(record_time_, Timestamp{*sensor_us});
    }
    has_record_ = true;
  }
  return true;
}

ViewTable& LoggedGame::table_of_game() { return table_ ? *table_ : table_.emplace(); }

void LoggedGame::take_next() {
  has_record_ = false;
  switch (*find_channel(record_.channel, prefix_)) {
    case Channel::kEstimate:
      estimate_ = from_message(*decoded<puck_estimate_t>(record_));
      break;
    case Channel::kTrajectory:
      take(*decoded<puck_trajectory_t>(record_), table_of_game());
      break;
    case Channel::kTruth:
      if (table_) take(*decoded<ground_truth_t>(record_), *table_);
      break;
    case Channel::kGame:
      if (const auto game = decoded<game_state_t>(record_)) take(*game, table_of_game());
      break;
    case Channel::kArmState:
      if (const auto arm = decoded<arm_state_t>(record_)) take(*arm, table_of_game());
      break;
    case Channel::kArmCommand:
      if (const auto command = decoded<arm_command_t>(record_)) take(*command, table_of_game());
      break;
    default:
      break;
  }
}

std::optional<LoggedCamera> camera_of_log(const std::filesystem::path& path,
                                          const std::string& prefix) {
  LogReader log(path);
  LogRecord record;
  const std::string channel = channel_name(Channel::kEstimate, prefix);
  std::optional<LoggedCamera> camera;
  std::int64_t session = 0;
  while (log.next(record)) {
    if (record.channel != channel) continue;
    const auto estimate = decoded<puck_estimate_t>(record);
    if (!estimate || !is_sensor_time(Timestamp{estimate->sensor_us})) continue;
    const SensorSize sensor{estimate->image_width, estimate->image_height};
    const Timestamp time{estimate->sensor_us};
    if (!camera && sensor.is_valid()) camera = {sensor, time, time};
    // A tracker names none before its first events.
    if (session == 0) session = estimate->events_session;
    if (camera && estimate->events_session == session) camera->last = std::max(camera->last, time);
  }
  return camera;
}

}  // namespace puck
