#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/evaluation/truth_track.h"
#include "common/events/sensor_size.h"
#include "common/events/timestamp.h"
#include "common/io/event_filter.h"
#include "common/io/event_reader.h"
#include "common/io/table_file.h"
#include "common/trackers/tracker_setup.h"
#include "tools/view/interface/view_state.h"

namespace puck {

/// A recording and what belongs to it, as the command line names them.
struct RecordingOptions {
  std::filesystem::path recording;
  EventFileOptions file;
  EventFilterParams filter;
  std::string prefix;                ///< Of a log's channels.
  std::filesystem::path truth;       ///< Empty: BASE.truth.csv beside it, or the log's.
  std::filesystem::path size_model;  ///< Empty: as find_calibration says.
  std::filesystem::path table;       ///< Empty: BASE.toml beside it.
  std::optional<Region> detection_region;
  std::int64_t truth_gap_us = 10'000;  ///< As AccuracyParams::truth_gap_us.
};

/// The name of the recorded estimates of a log, among the trackers.
inline constexpr const char* kLoggedTracker = "log";
/// No tracker.
inline constexpr const char* kNoTracker = "off";

/// A recording that is ready to be played, with everything that was found beside it. What is
/// missing is told in words: events can be seen without it.
class OpenedRecording {
 public:
  /// Throws EventFileError when neither events can be read nor a log's estimates; other exceptions
  /// of io for files that the options name and that cannot be read.
  explicit OpenedRecording(const RecordingOptions& options);

  /// The recording's events from the first one, once more: for another thread.
  std::unique_ptr<EventReader> open_events() const;

  const std::filesystem::path& path() const { return options_.recording; }
  const std::string& prefix() const { return options_.prefix; }
  bool is_log() const { return is_log_; }
  SensorSize sensor() const { return sensor_; }
  /// Of the first event; in a log without events, of the first estimate.
  Timestamp first() const { return first_; }
  bool has_events() const { return has_events_; }
  /// In a log without events: of the last estimate.
  Timestamp last() const { return last_; }

  const TruthTrack* truth() const { return truth_ ? &*truth_ : nullptr; }
  std::int64_t truth_gap_us() const { return options_.truth_gap_us; }
  const PuckSizeModel* size_model() const { return size_model_ ? &*size_model_ : nullptr; }
  const TableCalibration* table() const { return table_ ? &*table_ : nullptr; }

  /// Why there is no size model or no table, and what to do.
  const std::string& no_size_model() const { return no_size_model_; }
  const std::string& no_table() const { return no_table_; }
  const std::vector<ViewMessage>& messages() const { return messages_; }

  /// The names of all that can track: presets of PUCK, other algorithms, and a log's own estimates.
  std::vector<std::string> trackers() const;
  /// What `name` stands for; empty for kLoggedTracker and kNoTracker. Throws std::invalid_argument
  /// with words for the user when there is no such tracker, or it lacks a size model.
  std::optional<TrackerSetup> setup_of(const std::string& name) const;

 private:
  void find_first();
  void find_size_model();
  void find_table();
  void find_truth();
  void fail(std::string text);
  void warn(std::string text);

  RecordingOptions options_;
  bool is_log_ = false;
  bool has_events_ = false;
  SensorSize sensor_;
  Timestamp first_;
  Timestamp last_;
  std::optional<TruthTrack> truth_;
  std::optional<PuckSizeModel> size_model_;
  ContourCalibration contour_;
  std::optional<TableCalibration> table_;
  std::string no_size_model_;
  std::string no_table_;
  std::vector<ViewMessage> messages_;
};

}  // namespace puck
