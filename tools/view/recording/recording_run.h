#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "common/io/event_cutter.h"
#include "common/vision/surface/surface.h"
#include "tools/view/interface/newest_events.h"
#include "tools/view/interface/picture_wishes.h"
#include "tools/view/interface/view_scene.h"
#include "tools/view/interface/view_state.h"
#include "tools/view/recording/logged_game.h"
#include "tools/view/recording/opened_recording.h"
#include "tools/view/recording/side_run.h"
#include "tools/view/recording/time_spans.h"

namespace puck {

/// A recording's events and up to two trackers on it, advanced in sensor time. The trackers get the
/// events in milliseconds and are asked at each, as puck-evaluate does: what they say depends only
/// on the recording and on the time of the start, not on the times of pictures. One thread.
class RecordingRun {
 public:
  /// Sensor time that the trackers run before the time that is wanted.
  static constexpr std::int64_t kWarmUp_us = 1'000'000;
  /// Losses that are so near one another are one.
  static constexpr std::int64_t kJoin_us = 20'000;

  /// `recording` must outlive this object. Throws what reading its events throws.
  explicit RecordingRun(const OpenedRecording& recording);

  /// Chooses a side's tracker for the next start. Throws std::invalid_argument with words for the
  /// user.
  void choose(int side, const std::string& name);
  const std::string& chosen(int side) const { return chosen_[static_cast<std::size_t>(side)]; }

  /// Keeps the surface of a side from now on; complete after the next start. False if it was kept.
  bool keep_surface(int side);

  /// Makes new trackers, which start kWarmUp_us before `target`. Then call step() up to it.
  void start(Timestamp target);

  enum class Progress { kAdvanced, kReached, kEnded };
  /// Does a small piece of the work up to `until`, which is not before now(). kEnded: there are no
  /// further events, nor messages of a log. Throws what reading throws.
  Progress step(Timestamp until);

  /// Time up to which all events are shown.
  Timestamp now() const { return now_; }
  Timestamp first() const { return recording_.first(); }
  /// As EventReader::share_read.
  std::optional<double> share_read() const { return events_->share_read(); }
  /// Increases with each start.
  std::int64_t run() const { return run_; }

  /// Fills all but `heat`; for a heat map, `surface`.
  void fill(const PictureWishes& wishes, ViewScene& scene) const;

  const SideRun& side(int index) const { return *sides_[static_cast<std::size_t>(index)]; }
  const std::deque<ChartSample>& samples() const { return samples_; }
  /// Over all starts since the side's tracker was chosen; from the targets of the starts on.
  const TimeSpans& losses(int side) const { return losses_[static_cast<std::size_t>(side)]; }
  const TimeSpans& examined(int side) const { return examined_[static_cast<std::size_t>(side)]; }

 private:
  static constexpr std::int64_t kTick_us = 1000;

  void take(const EventPacket& piece);
  void tick(Timestamp tick);
  void add_sample(Timestamp tick);
  std::optional<TruthRow> truth_at(Timestamp time) const;
  void fill_table(std::size_t side, ViewScene& scene) const;

  const OpenedRecording& recording_;
  std::unique_ptr<EventReader> events_;
  std::optional<EventCutter> cutter_;
  std::optional<LoggedGame> logged_;
  std::array<std::string, kViewSides> chosen_;
  std::array<std::unique_ptr<SideRun>, kViewSides> sides_;
  std::array<bool, kViewSides> keeps_surface_{};
  mutable std::array<std::optional<Surface>, kViewSides>
      surfaces_;  // Their snapshots are not const.
  mutable SurfaceSnapshot snapshot_;

  Timestamp from_;          // Events before are skipped.
  Timestamp counted_from_;  // Losses before do not count.
  Timestamp now_;
  Timestamp next_tick_;
  std::int64_t run_ = 0;
  EventPacket piece_;
  EventPacket pending_;  // Since the last tick.
  NewestEvents newest_;
  std::int64_t sample_events_ = 0;
  std::deque<ChartSample> samples_;
  std::array<TimeSpans, kViewSides> losses_{TimeSpans(kJoin_us), TimeSpans(kJoin_us)};
  std::array<TimeSpans, kViewSides> examined_{TimeSpans(kTick_us), TimeSpans(kTick_us)};
};

}  // namespace puck
