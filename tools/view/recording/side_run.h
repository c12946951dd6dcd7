#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "common/evaluation/truth_track.h"
#include "common/runtime/latency_histogram.h"
#include "common/vision/interfaces/tracking_algorithm.h"
#include "tools/view/interface/view_scene.h"
#include "tools/view/interface/view_state.h"
#include "tools/view/recording/logged_game.h"
#include "tools/view/recording/opened_recording.h"
#include "tools/view/recording/run_table.h"

namespace puck {

/// One tracker's run over a part of a recording, from a fresh tracker on. One thread at a time.
class SideRun {
 public:
  /// `name`: one of OpenedRecording::trackers(), or kNoTracker. Throws std::invalid_argument with
  /// words for the user. `recording` must outlive this object.
  SideRun(const OpenedRecording& recording, const std::string& name);

  /// Events since the last tick, then the tick: asks for an estimate. `logged`: that of the log,
  /// for kLoggedTracker.
  void update(const EventPacket& events);
  void tick(Timestamp tick, const std::optional<PuckEstimate>& logged);

  const ViewTrack& track() const { return track_; }
  /// Of the newest tick, against truth; empty without truth or a position.
  const std::optional<double>& error_px() const { return error_px_; }
  /// Whether the puck is lost at the newest tick: visible in the image by truth but not tracked
  /// within 20 px; without truth, followed before and not now. Empty where nobody can tell.
  const std::optional<bool>& is_lost() const { return is_lost_; }
  /// The game on the table; null without a calibration of the table, and for kLoggedTracker.
  const ViewTable* table() const { return table_ ? &table_->table() : nullptr; }
  /// Work of the tracker for a tick, on the wall clock.
  LatencySummary work() const { return work_.summary(); }
  /// The surface's settings of the tracker's preset; EROS as of preset default for others.
  SurfaceParams surface_params() const { return surface_; }

 private:
  void judge(const std::optional<TruthRow>& truth);

  const OpenedRecording& recording_;
  std::unique_ptr<TrackingAlgorithm> tracker_;  // Null: off, or the log's.
  SurfaceParams surface_;
  std::optional<RunTable> table_;
  ViewTrack track_;
  bool was_tracked_ = false;
  std::optional<double> error_px_;
  std::optional<bool> is_lost_;
  std::int64_t update_us_ = 0;
  LatencyHistogram work_;
};

}  // namespace puck
