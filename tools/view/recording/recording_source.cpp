#include "tools/view/recording/recording_source.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <iterator>
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
// Shorter losses are not jumped to.
constexpr std::int64_t kShortestLoss_us = 10'000;
constexpr double kFastest = 100;
constexpr double kLongest_s = 1e7;
// The log's tracker has had time to speak.
constexpr std::int64_t kSilent_us = 500'000;

std::string words(const char* format, auto... values) {
  char text[240];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

std::optional<std::int64_t> microseconds_of(double seconds) {
  if (!(std::abs(seconds) <= kLongest_s)) return std::nullopt;
  return std::llround(seconds * 1e6);
}

}  // namespace

/// The mutex, for a caller that the worker makes room for.
class RecordingSource::Visit {
 public:
  explicit Visit(RecordingSource& source) {
    source.waiting_.fetch_add(1, std::memory_order_relaxed);
    lock_ = std::unique_lock(source.mutex_);
    source.waiting_.fetch_sub(1, std::memory_order_relaxed);
  }

 private:
  std::unique_lock<std::mutex> lock_;
};

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

ViewState RecordingSource::state(Timestamp since, std::int64_t run) {
  ViewState state;
  state.source = recording_->path().filename().string();
  state.sensor = recording_->sensor();
  state.trackers = recording_->trackers();
  const Visit visit(*this);
  viewed_ = steady_clock::now();
  state.time = run_.now();
  state.seconds = static_cast<double>(run_.now() - run_.first()) * 1e-6;
  state.run = run_.run();
  state.playback = ViewPlayback{activity_, clock_.speed(),
                                activity_ == Activity::kPlaying ? clock_.reached_speed() : 0};
  for (int i = 0; i < kViewSides; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const SideRun& side = run_.side(i);
    state.chosen[at] = run_.chosen(i);
    state.estimates[at] = side.track().estimate;
    state.errors_px[at] = side.error_px();
    const LatencySummary work = side.work();
    if (work.samples == 0) continue;
    state.latencies.push_back({side.track().name + ": work for 1 ms of the recording", work.p50_us,
                               work.p99_us, work.max_us});
  }
  const auto& samples = run_.samples();
  double events = 0;
  int counted = 0;
  for (auto sample = samples.rbegin(); sample != samples.rend(); ++sample) {
    if (run_.now() - sample->time > 1'000'000) break;
    events += sample->events_per_s;
    ++counted;
  }
  if (counted > 0) state.events_per_s = events / counted;
  std::copy_if(samples.begin(), samples.end(), std::back_inserter(state.samples),
               [&](const ChartSample& s) { return run != run_.run() || s.time > since; });
  add_messages(state);
  return state;
}

void RecordingSource::add_messages(ViewState& state) const {
  using Level = ViewMessage::Level;
  auto& messages = state.messages;
  if (!fault_.empty()) messages.push_back({Level::kError, fault_});
  messages.insert(messages.end(), recording_->messages().begin(), recording_->messages().end());
  for (std::string& warning : scan_.warnings()) {
    messages.push_back({Level::kWarning, std::move(warning)});
  }
  if (activity_ == Activity::kPlaying && clock_.is_too_slow()) {
    messages.push_back(
        {Level::kWarning, words("plays at %.2gx instead of %.3gx: reading and tracking need longer",
                                clock_.reached_speed(), clock_.speed())});
  }
  for (int i = 0; i < kViewSides; ++i) {
    if (run_.chosen(i) == kLoggedTracker && !run_.side(i).track().estimate &&
        run_.now() - run_.first() > kSilent_us) {
      messages.push_back(
          {Level::kWarning,
           "the log holds no estimates so far: choose a tracker to run on its events"});
    }
  }
  if (activity_ == Activity::kEnded && fault_.empty()) {
    messages.push_back({Level::kInfo, words("the recording ends at %.3f s", state.seconds)});
  }
  const bool runs_tracker =
      std::any_of(state.chosen.begin(), state.chosen.end(),
                  [](const auto& c) { return c != kNoTracker && c != kLoggedTracker; });
  if (runs_tracker && started_at_ > run_.first()) {
    messages.push_back(
        {Level::kInfo,
         words("the trackers started anew at %.3f s: before that they have seen nothing",
               static_cast<double>(started_at_ - run_.first()) * 1e-6)});
  }
}

ViewTimeline RecordingSource::timeline() {
  ViewTimeline timeline;
  scan_.fill(timeline);
  const Visit visit(*this);
  for (int i = 0; i < kViewSides; ++i) {
    timeline.losses[static_cast<std::size_t>(i)] = run_.losses(i).spans();
    timeline.examined[static_cast<std::size_t>(i)] = run_.examined(i).spans();
  }
  return timeline;
}

std::string RecordingSource::control(const ViewControl& control) {
  using Action = ViewControl::Action;
  if (control.side < 0 || control.side >= kViewSides) return "there are sides 0 and 1";
  const std::optional<std::int64_t> value_us = microseconds_of(control.value);
  if (!value_us) return "expected a number of seconds";
  const Visit visit(*this);
  switch (control.action) {
    case Action::kPlay:
      if (activity_ == Activity::kEnded) {
        seek(run_.first(), Activity::kPlaying);
      } else if (activity_ == Activity::kSeeking) {
        afterwards_ = Activity::kPlaying;
      } else if (activity_ != Activity::kPlaying) {
        enter(Activity::kPlaying);
      }
      return {};
    case Action::kPause:
      if (activity_ == Activity::kSeeking) {
        afterwards_ = Activity::kPaused;
      } else if (activity_ != Activity::kEnded) {
        enter(Activity::kPaused);
      }
      return {};
    case Action::kStep:
      if (*value_us < 0) {
        seek(run_.now() + *value_us, Activity::kPaused);
      } else if (activity_ != Activity::kEnded) {
        // Without a new start: the next moment of this run.
        target_ = (activity_ == Activity::kSeeking ? target_ : run_.now()) + *value_us;
        afterwards_ = Activity::kPaused;
        enter(Activity::kSeeking);
      }
      return {};
    case Action::kSeek:
      seek(run_.first() + *value_us, activity_after_seek());
      return {};
    case Action::kSpeed:
      if (!(control.value >= 0 && control.value <= kFastest)) {
        return "a speed is between 0.001 and 100, or 0: as fast as possible";
      }
      clock_.set_speed(control.value);
      clock_.start(run_.now(), steady_clock::now());
      return {};
    case Action::kTracker:
      try {
        run_.choose(control.side, control.name);
      } catch (const std::exception& error) {
        return error.what();
      }
      seek(run_.now(), activity_after_seek());
      return {};
    case Action::kNextLoss:
    case Action::kPreviousLoss:
      return jump_to_loss(control.side, control.action == Action::kNextLoss);
  }
  return "there is no such action";
}

std::string RecordingSource::jump_to_loss(int side, bool is_next) {
  if (run_.chosen(side) == kNoTracker) return "no tracker, no loss: choose a tracker";
  const TimeSpans& losses = run_.losses(side);
  const auto is_long = [](const TimeSpans::Span& loss) {
    return loss.end - loss.begin >= kShortestLoss_us;
  };
  // Inside of a loss that was jumped to, the previous one is another.
  Timestamp from = is_next ? run_.now() : run_.now() - kShortestLoss_us;
  auto loss = is_next ? losses.after(from) : losses.before(from);
  while (loss && !is_long(*loss)) {
    loss = is_next ? losses.after(loss->begin) : losses.before(loss->begin);
  }
  if (is_next && (!loss || run_.examined(side).end_around(run_.now()) < loss->begin)) {
    if (activity_ == Activity::kEnded) return "no loss before the recording's end";
    searched_side_ = side;
    searched_from_ = run_.now();
    enter(Activity::kSearching);
    return {};
  }
  if (!loss) return "no loss in the part that the tracker has run over";
  seek(loss->begin + kShortestLoss_us, Activity::kPaused);
  return {};
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
