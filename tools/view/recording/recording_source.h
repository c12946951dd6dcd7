#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tools/view/drawing/heat_map.h"
#include "tools/view/interface/view_source.h"
#include "tools/view/recording/play_clock.h"
#include "tools/view/recording/rate_scan.h"
#include "tools/view/recording/recording_run.h"

namespace puck {

/// A recording that is played. A thread of its own reads it and runs the trackers, at the wanted
/// speed if they can, while somebody looks: it waits for its first viewer, and when nobody has
/// called fill() or state() for 2 s; a second one counts the events for the time line. Seeking
/// starts the trackers anew some time before, so that what is seen after it is the same each time.
/// Functions are safe from any thread.
class RecordingSource final : public ViewSource {
 public:
  /// `trackers`: of the two sides. Plays at once if `plays`. Throws std::invalid_argument with
  /// words for the user, and what reading throws.
  RecordingSource(std::unique_ptr<OpenedRecording> recording,
                  const std::array<std::string, kViewSides>& trackers, bool plays);

  bool fill(const PictureWishes& wishes, ViewScene& scene) override;
  ViewState state(Timestamp since, std::int64_t run) override;
  ViewTimeline timeline() override;
  std::string control(const ViewControl& control) override;
  std::uint64_t version() const override { return version_.load(std::memory_order_acquire); }
  void wait_for_change(std::uint64_t seen, std::chrono::milliseconds timeout) override;

 private:
  using Activity = ViewPlayback::Activity;

  // Shorter losses are not jumped to.
  static constexpr std::int64_t kShortestLoss_us = 10'000;

  // The mutex, for a caller that the worker makes room for.
  class Visit {
   public:
    explicit Visit(RecordingSource& source) {
      source.waiting_.fetch_add(1, std::memory_order_relaxed);
      lock_ = std::unique_lock(source.mutex_);
      source.waiting_.fetch_sub(1, std::memory_order_relaxed);
    }

   private:
    std::unique_lock<std::mutex> lock_;
  };

  void work(const std::stop_token& stop);
  // Each returns whether more is to be done at once.
  bool make_progress();
  bool play();
  bool advance_to_target();
  bool search();
  void seek(Timestamp target, Activity afterwards);
  void enter(Activity activity);
  Activity activity_after_seek() const;
  bool is_watched() const;
  std::string jump_to_loss(int side, bool is_next);
  void add_messages(ViewState& state) const;
  void announce();

  std::unique_ptr<OpenedRecording> recording_;
  RateScan scan_;

  // Held by the worker while it does a piece of work of some ms; by others for the time of a copy.
  std::mutex mutex_;
  std::condition_variable_any work_wanted_;
  std::atomic<int> waiting_{0};  // Callers that want the mutex: the worker lets them first.
  // All guarded by mutex_.
  RecordingRun run_;
  PlayClock clock_;
  Activity activity_ = Activity::kPaused;
  Activity afterwards_ = Activity::kPaused;  // Of a seek.
  Timestamp target_;                         // Of a seek.
  int searched_side_ = 0;
  Timestamp searched_from_;
  Timestamp started_at_;                                         // The trackers of this run.
  std::string fault_;                                            // Reading failed.
  std::optional<std::chrono::steady_clock::time_point> viewed_;  // The last fill() or state().

  std::mutex heat_mutex_;
  std::optional<HeatMap> heat_map_;  // Guarded by heat_mutex_.

  std::mutex change_mutex_;
  std::condition_variable changed_;
  std::atomic<std::uint64_t> version_{0};

  std::jthread worker_;  // Last member: uses the others.
};

}  // namespace puck
