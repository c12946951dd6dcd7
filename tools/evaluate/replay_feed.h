#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/io/event_reader.h"
#include "common/vision/interfaces/tracking_algorithm.h"
#include "tools/evaluate/runs.h"

namespace puck {

/// Feeds a tracker with a log's events as another tracker received them, given that tracker's event
/// counts over time. Packets stay whole if possible, because a tracker may depend on the
/// boundaries. One thread.
class ReplayFeed {
 public:
  ReplayFeed(EventReader& events, TrackingAlgorithm& tracker)
      : events_(events), tracker_(tracker) {}

  /// Skips the events before the other tracker's start, so that after `applied` further events the
  /// newest has `time`; false if no packet fits.
  bool skip_to_start(std::int64_t applied, Timestamp time);

  /// Feeds up to `applied` events in all, the newest with `time`. False if the counts do not fit:
  /// then feeds all up to `time` and counts on from there.
  bool feed(std::int64_t applied, Timestamp time);

  /// Number and time span of the fed events.
  const RunSummary& summary() const { return summary_; }

 private:
  std::optional<std::int64_t> find_start(std::int64_t applied, Timestamp time);
  bool has_more();
  void give(std::size_t count);

  EventReader& events_;
  TrackingAlgorithm& tracker_;
  EventPacket packet_;
  std::size_t used_ = 0;  // Events of it that were fed.
  EventPacket piece_;
  std::int64_t ahead_ = 0;  // Events counted by the other tracker but missing here.
  RunSummary summary_;
};

}  // namespace puck
