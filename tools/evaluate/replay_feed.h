#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/io/event_reader.h"
#include "common/vision/tracking_algorithm.h"
#include "tools/evaluate/runs.h"

namespace puck {

/// Hands the events of a log to a tracker as another one got them, of which is known only how many
/// events it had at which times. Packets stay whole where they can: between two questions a tracker
/// may depend on how its events were handed over. One thread.
class ReplayFeed {
 public:
  ReplayFeed(EventReader& events, TrackingAlgorithm& tracker)
      : events_(events), tracker_(tracker) {}

  /// Passes over the events that the other tracker was too late for, where `applied` events after
  /// its first packet the newest was of `time`; false when no packet can have been its first.
  bool skip_to_start(std::int64_t applied, Timestamp time);

  /// Hands over what makes `applied` events in all, the newest of `time`. False when there is no
  /// such place: then all up to that time, and it is counted on from there.
  bool feed(std::int64_t applied, Timestamp time);

  /// Events handed over, and when the first and the last of them were.
  const RunSummary& summary() const { return summary_; }

 private:
  std::optional<std::int64_t> find_start(std::int64_t applied, Timestamp time);
  bool has_more();
  void give(std::size_t count);

  EventReader& events_;
  TrackingAlgorithm& tracker_;
  EventPacket packet_;
  std::size_t used_ = 0;  // Events of it that have been handed over.
  EventPacket piece_;
  std::int64_t ahead_ = 0;  // Events that the other tracker has counted beyond those here.
  RunSummary summary_;
};

}  // namespace puck
