#include "tools/view/recording/opened_recording.h"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "common/io/contour_calibration_file.h"
#include "common/io/filtered_reader.h"
#include "common/io/size_model_file.h"
#include "common/io/truth_file.h"
#include "common/messaging/log_file.h"
#include "common/recording/event_log_reader.h"
#include "common/recording/log_recording.h"
#include "tools/view/recording/logged_game.h"

namespace puck {
namespace {

std::filesystem::path beside(const std::filesystem::path& recording, const char* ending) {
  std::filesystem::path path = recording;
  path.replace_extension(ending);
  return path;
}

bool is_there(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::exists(path, error);
}

class NoEvents final : public EventReader {
 public:
  explicit NoEvents(SensorSize sensor) : sensor_(sensor) {}

  SensorSize sensor_size() const override { return sensor_; }
  bool read(EventPacket& packet, std::size_t /*max_events*/) override {
    packet.events.clear();
    return false;
  }
  bool can_rewind() const override { return true; }
  void rewind() override {}
  const EventCounters& counters() const override { return counters_; }
  std::vector<std::string> warnings() const override { return {}; }

 private:
  SensorSize sensor_;
  EventCounters counters_;
};

}  // namespace

OpenedRecording::OpenedRecording(const RecordingOptions& options) : options_(options) {
  if (options_.recording == "-") {
    throw EventFileError("stdin: a recording is read more than once to be played: give a file");
  }
  is_log_ = is_lcm_log(options_.recording);
  find_size_model();
  find_first();
  if (size_model_) {
    for (std::string& doubt : doubts_about(default_params().sizes_of(*size_model_), sensor_)) {
      warn(std::move(doubt));
    }
  }
  find_table();
  find_truth();
}

// Finds the sensor and the time of the first event.
void OpenedRecording::find_first() {
  try {
    const auto events = open_events();
    sensor_ = events->sensor_size();
    EventPacket packet;
    has_events_ = events->read(packet, 1);
    if (has_events_) first_ = packet.newest();
  } catch (const EventFileError& error) {
    const auto camera = is_log_ ? camera_of_log(options_.recording, options_.prefix) : std::nullopt;
    if (!camera) throw;
    sensor_ = camera->sensor;
    first_ = camera->first;
    last_ = camera->last;
    fail(std::string(error.what()) + ": only what the services said is shown");
    return;
  }
  if (!has_events_) fail(options_.recording.string() + " holds no events: nothing can be shown");
}

// Before all warnings.
void OpenedRecording::fail(std::string text) {
  messages_.insert(messages_.begin(), {ViewMessage::Level::kError, std::move(text)});
}

void OpenedRecording::warn(std::string text) {
  messages_.push_back({ViewMessage::Level::kWarning, std::move(text)});
}

std::unique_ptr<EventReader> OpenedRecording::open_events() const {
  // Known not to have any.
  if (!has_events_ && sensor_.is_valid()) return std::make_unique<NoEvents>(sensor_);
  std::unique_ptr<EventReader> events;
  if (is_log_) {
    try {
      events = open_event_log(options_.recording, options_.prefix, EventLog::Sessions::kFirst);
    } catch (const LogFileError& error) {
      throw EventFileError(error.what());
    }
  } else {
    events = open_event_file(options_.recording, options_.file);
  }
  return std::make_unique<FilteredReader>(std::move(events), options_.filter,
                                          options_.recording.string());
}

void OpenedRecording::find_size_model() {
  std::filesystem::path path;
  try {
    path = find_calibration(options_.recording, options_.size_model);
  } catch (const std::exception& error) {
    no_size_model_ = error.what();
    warn("no tracker can run: " + no_size_model_ +
         "; puck-calibrate size makes one from marks of the puck");
    return;
  }
  size_model_ = read_size_model_file(path);
  contour_ = read_contour_calibration(path).value_or(ContourCalibration{});
  // The size model of another recording tells nothing about this one's sensor.
  const bool is_of_other = options_.size_model.empty() && path.stem() != options_.recording.stem();
  if (!is_of_other) {
    options_.file.fallback_sensor = size_model_->sensor;
  } else if (!is_log_) {
    warn("no size model of this recording: the trackers use " + path.string() +
         "; make its own with puck-calibrate size, and give --size-model");
  }
}

void OpenedRecording::find_table() {
  const std::filesystem::path path =
      options_.table.empty() ? beside(options_.recording, ".toml") : options_.table;
  if (options_.table.empty() && !is_there(path)) {
    no_table_ = "no table: give its calibration with --table, made by puck-calibrate table";
    return;
  }
  try {
    table_ = read_table_file(path);
  } catch (const ConfigError& error) {
    if (!options_.table.empty()) throw;
    no_table_ = std::string("no table: ") + error.what() + "; give one with --table";
  }
}

void OpenedRecording::find_truth() {
  std::vector<TruthRow> rows;
  const std::filesystem::path path = beside(options_.recording, ".truth.csv");
  if (!options_.truth.empty()) {
    rows = read_truth_file(options_.truth);
  } else if (is_log_) {
    rows = read_truth_log(options_.recording, options_.prefix);
  } else if (is_there(path)) {
    rows = read_truth_file(path);
  }
  if (rows.empty()) return;
  truth_.emplace(std::move(rows));
  if (truth_->last() < first_) {
    warn("the truth ends before the first event: it must be on the recording's own clock");
  }
}

std::vector<std::string> OpenedRecording::trackers() const {
  std::vector<std::string> names;
  if (is_log_) names.emplace_back(kLoggedTracker);
  if (!size_model_ || !has_events_) return names;
  for (const std::string_view preset : kPresetNames) names.emplace_back(preset);
  for (const Algorithm algorithm : kAlgorithms) {
    // Its presets stand for it.
    if (algorithm != Algorithm::kPuck) names.emplace_back(to_string(algorithm));
  }
  return names;
}

std::optional<TrackerSetup> OpenedRecording::setup_of(const std::string& name) const {
  if (name == kNoTracker || (is_log_ && name == kLoggedTracker)) return std::nullopt;
  TrackerSetup setup;
  if (const auto preset = preset_from(name)) {
    setup.preset = *preset;
  } else if (const auto algorithm = algorithm_from(name);
             algorithm && *algorithm != Algorithm::kPuck) {
    setup.algorithm = *algorithm;
  } else {
    std::string names;
    for (const std::string& each : trackers()) names += " " + each;
    throw std::invalid_argument("there is no tracker called " + name + ": choose off or one of" +
                                names);
  }
  if (!size_model_)
    throw std::invalid_argument("tracker " + name + " cannot run: " + no_size_model_);
  setup.size_model = *size_model_;
  setup.contour = contour_;
  setup.detection_region = options_.detection_region;
  return setup;
}

}  // namespace puck
