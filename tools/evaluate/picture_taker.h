#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "common/evaluation/truth_track.h"
#include "common/io/event_reader.h"
#include "tools/evaluate/picture.h"
#include "tools/evaluate/runs.h"

namespace puck {

/// Finds the moment of --picture: collects the ticks of one moment during a run and reads that
/// moment's events afterwards. One thread at a time.
class PictureTaker {
 public:
  /// `at_s`: seconds after the first event; empty: when the tracked puck is fastest. Reads the
  /// first event and rewinds. Throws std::runtime_error if `path` is not writable.
  PictureTaker(std::filesystem::path path, std::optional<double> at_s, EventReader& events);

  /// Ticks in order of time.
  void add(const EvaluatedTick& tick);

  /// Reads the events again. Throws std::invalid_argument if the moment is outside of the recording
  /// or the puck was never tracked.
  TrackedMoment moment(EventReader& events, const RunSummary& run, const TruthTrack* truth) const;

  const std::filesystem::path& path() const { return path_; }

 private:
  bool is_wanted(const EvaluatedTick& tick) const;

  std::filesystem::path path_;
  Timestamp first_;
  std::optional<Timestamp> at_;
  std::vector<TrackedMoment::TrailPoint> trail_;  // Up to the newest tick.
  std::optional<TrackedMoment> moment_;
};

}  // namespace puck
