#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "common/evaluation/truth_track.h"
#include "common/io/event_reader.h"
#include "tools/evaluate/picture.h"
#include "tools/evaluate/runs.h"

namespace puck {

/// Takes the picture of --picture: keeps what the ticks of a run say about one moment, and reads
/// that moment's events afterwards. One thread at a time.
class PictureTaker {
 public:
  /// `at_s`: seconds after the first event; nothing: when the tracked puck is fastest. Reads the
  /// first event and rewinds. Throws std::runtime_error when no file can be written at `path`.
  PictureTaker(std::filesystem::path path, std::optional<double> at_s, EventReader& events);

  /// Ticks in the order of their times.
  void add(const EvaluatedTick& tick);

  /// Reads the events again and writes the file. Throws std::invalid_argument when the moment lies
  /// outside of the recording or the puck was never tracked, std::runtime_error when the file
  /// cannot be written.
  void save(EventReader& events, const RunSummary& run, const TruthTrack* truth);

 private:
  bool is_wanted(const EvaluatedTick& tick) const;

  std::filesystem::path path_;
  Timestamp first_;
  std::optional<Timestamp> at_;
  std::vector<TrackedMoment::TrailPoint> trail_;  // Up to the newest tick.
  std::optional<TrackedMoment> moment_;
};

}  // namespace puck
