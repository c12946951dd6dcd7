#include <chrono>
#include <cmath>
#include <exception>

#include "tools/view/recording/recording_source.h"

namespace puck {
namespace {

using std::chrono::steady_clock;

constexpr double kFastest = 100;
constexpr double kLongest_s = 1e7;

std::optional<std::int64_t> microseconds_of(double seconds) {
  if (!(std::abs(seconds) <= kLongest_s)) return std::nullopt;
  return std::llround(seconds * 1e6);
}

}  // namespace

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

}  // namespace puck
