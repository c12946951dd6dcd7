#include "tools/view/recording/recording_source.h"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <stop_token>
#include <utility>

namespace puck {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// Longest piece of work while the mutex is held.
constexpr milliseconds kPiece(4);
// Between two looks at the clock while nothing is due.
constexpr milliseconds kNothingDue(3);
// Without a viewer for so long, a recording does not play on.
constexpr std::chrono::seconds kUnwatched(2);
constexpr milliseconds kUnwatchedPause(50);

}  // namespace

RecordingSource::RecordingSource(std::unique_ptr<OpenedRecording> recording,
                                 const std::array<std::string, kViewSides>& trackers, bool plays)
    : recording_(std::move(recording)), scan_(recording_->open_events()), run_(*recording_) {
  for (int side = 0; side < kViewSides; ++side) {
    run_.choose(side, trackers[static_cast<std::size_t>(side)]);
  }
  if (recording_->size_model() != nullptr) heat_map_.emplace(*recording_->size_model());
  seek(recording_->first(), plays ? Activity::kPlaying : Activity::kPaused);
  worker_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

void RecordingSource::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    if (activity_ == Activity::kPaused || activity_ == Activity::kEnded) {
      work_wanted_.wait(lock, stop, [&] {
        return activity_ != Activity::kPaused && activity_ != Activity::kEnded;
      });
      continue;
    }
    const bool has_more = make_progress();
    if (has_more) {
      lock.unlock();
      while (waiting_.load(std::memory_order_relaxed) > 0 && !stop.stop_requested()) {
        std::this_thread::yield();
      }
      lock.lock();
    } else {
      work_wanted_.wait_for(lock, stop, is_watched() ? kNothingDue : kUnwatchedPause,
                            [] { return false; });
    }
  }
}

bool RecordingSource::make_progress() {
  try {
    switch (activity_) {
      case Activity::kPlaying:
        return play();
      case Activity::kSeeking:
        return advance_to_target();
      case Activity::kSearching:
        return search();
      case Activity::kPaused:
      case Activity::kEnded:
        return false;
    }
  } catch (const std::exception& error) {
    fault_ = error.what();
    enter(Activity::kEnded);
  }
  return false;
}

bool RecordingSource::is_watched() const {
  return viewed_ && steady_clock::now() - *viewed_ < kUnwatched;
}

bool RecordingSource::play() {
  const auto begin = steady_clock::now();
  if (!is_watched()) {
    clock_.start(run_.now(), begin);
    return false;
  }
  const Timestamp before = run_.now();
  const Timestamp due = clock_.due(before, begin);
  auto progress =
      due > before ? RecordingRun::Progress::kAdvanced : RecordingRun::Progress::kReached;
  while (progress == RecordingRun::Progress::kAdvanced && steady_clock::now() - begin < kPiece) {
    progress = run_.step(due);
  }
  if (progress == RecordingRun::Progress::kEnded) {
    enter(Activity::kEnded);
  } else if (run_.now() != before) {
    announce();
  }
  return progress == RecordingRun::Progress::kAdvanced;
}

bool RecordingSource::advance_to_target() {
  const auto begin = steady_clock::now();
  auto progress = RecordingRun::Progress::kAdvanced;
  if (run_.now() >= target_) progress = RecordingRun::Progress::kReached;
  while (progress == RecordingRun::Progress::kAdvanced && steady_clock::now() - begin < kPiece) {
    progress = run_.step(target_);
  }
  if (progress == RecordingRun::Progress::kEnded) enter(Activity::kEnded);
  if (progress == RecordingRun::Progress::kReached) enter(afterwards_);
  return true;
}

bool RecordingSource::search() {
  const auto begin = steady_clock::now();
  while (steady_clock::now() - begin < kPiece) {
    const auto progress = run_.step(run_.now() + 1000);
    if (progress == RecordingRun::Progress::kEnded) {
      enter(Activity::kEnded);
      return true;
    }
    const auto loss = run_.losses(searched_side_).after(searched_from_);
    if (loss && loss->end - loss->begin >= kShortestLoss_us) {
      enter(Activity::kPaused);
      return true;
    }
    // A loss that was too short: the next one is another.
    if (loss && run_.now() - loss->end > RecordingRun::kJoin_us) searched_from_ = loss->begin;
  }
  return true;
}

void RecordingSource::enter(Activity activity) {
  activity_ = activity;
  if (activity == Activity::kPlaying) clock_.start(run_.now(), steady_clock::now());
  work_wanted_.notify_all();
  announce();
}

void RecordingSource::seek(Timestamp target, Activity afterwards) {
  fault_.clear();
  target_ = std::max(target, recording_->first());
  afterwards_ = afterwards;
  run_.start(target_);
  started_at_ = run_.now();
  enter(Activity::kSeeking);
}

RecordingSource::Activity RecordingSource::activity_after_seek() const {
  if (activity_ == Activity::kSeeking) return afterwards_;
  return activity_ == Activity::kPlaying ? Activity::kPlaying : Activity::kPaused;
}

bool RecordingSource::fill(const PictureWishes& wishes, ViewScene& scene) {
  const bool is_heat = wishes.view == PictureWishes::View::kCamera &&
                       wishes.backdrop == PictureWishes::Backdrop::kHeatMap;
  {
    const Visit visit(*this);
    viewed_ = steady_clock::now();
    const bool needs_surface = wishes.view == PictureWishes::View::kCamera &&
                               wishes.backdrop != PictureWishes::Backdrop::kEvents;
    // While it plays the surface fills by itself.
    if (needs_surface && run_.keep_surface(std::clamp(wishes.side, 0, kViewSides - 1)) &&
        activity_ != Activity::kPlaying) {
      seek(run_.now(), activity_after_seek());
    }
    run_.fill(wishes, scene);
  }
  if (is_heat && scene.no_backdrop.empty()) {
    const std::lock_guard lock(heat_mutex_);
    heat_map_->fill(scene.surface, scene.heat);
  }
  return true;
}

void RecordingSource::announce() {
  version_.fetch_add(1, std::memory_order_release);
  // With the mutex, so that no waiter misses it between its look and its sleep.
  const std::lock_guard lock(change_mutex_);
  changed_.notify_all();
}

void RecordingSource::wait_for_change(std::uint64_t seen, milliseconds timeout) {
  std::unique_lock lock(change_mutex_);
  changed_.wait_for(lock, timeout, [&] { return version() != seen; });
}

}  // namespace puck
