#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <iterator>
#include <utility>

#include "tools/view/recording/recording_source.h"

namespace puck {
namespace {

// The log's tracker has had time to speak.
constexpr std::int64_t kSilent_us = 500'000;

std::string words(const char* format, auto... values) {
  char text[240];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

}  // namespace

ViewState RecordingSource::state(Timestamp since, std::int64_t run) {
  ViewState state;
  state.source = recording_->path().filename().string();
  state.sensor = recording_->sensor();
  state.trackers = recording_->trackers();
  const Visit visit(*this);
  viewed_ = std::chrono::steady_clock::now();
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
    state.latencies.push_back(
        {side.track().name + ": work per ms of recording", work.p50_us, work.p99_us, work.max_us});
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
    messages.push_back(
        {Level::kInfo, words("the recording ends at %.3f s: play starts it again", state.seconds)});
  }
  const bool runs_tracker =
      std::any_of(state.chosen.begin(), state.chosen.end(),
                  [](const auto& c) { return c != kNoTracker && c != kLoggedTracker; });
  if (runs_tracker && started_at_ > run_.first()) {
    messages.push_back(
        {Level::kInfo,
         words("after the jump, trackers and score began at %.3f s: they know nothing from before",
               static_cast<double>(started_at_ - run_.first()) * 1e-6)});
  }
}

ViewTimeline RecordingSource::timeline() {
  ViewTimeline timeline;
  scan_.fill(timeline);
  if (!recording_->has_events()) {
    timeline.first = recording_->first();
    timeline.last = recording_->last();
  }
  const Visit visit(*this);
  for (int i = 0; i < kViewSides; ++i) {
    timeline.losses[static_cast<std::size_t>(i)] = run_.losses(i).spans();
    timeline.examined[static_cast<std::size_t>(i)] = run_.examined(i).spans();
  }
  return timeline;
}

}  // namespace puck
