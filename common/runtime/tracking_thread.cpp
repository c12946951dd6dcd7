#include "common/runtime/tracking_thread.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "common/vision/interfaces/event_pieces.h"

namespace puck {
namespace {

using std::chrono::microseconds;
using std::chrono::system_clock;

// Events per batch from the queue.
constexpr std::size_t kQueueBatchEvents = 256;
// Longest time in which the tracking thread takes events before the next estimate.
constexpr microseconds kLongestTake{1'000};
// Period of the steps while no region is watched, and of the polls of a running search.
constexpr microseconds kIdlePeriod{1'000};

// Shortest period of urgent searches: without a track, a search of the whole image runs on this
// thread, which takes some 4 ms. In between, the worker does the larger searches.
constexpr microseconds kUrgentSearchPeriod{10'000};

}  // namespace

microseconds publish_period(const TrackingThreadParams& params) {
  if (params.max_publish_hz < 1 || params.heartbeat <= microseconds::zero()) {
    throw std::invalid_argument("tracker.max_publish_hz must be at least 1, got " +
                                std::to_string(params.max_publish_hz));
  }
  return microseconds(1'000'000 / params.max_publish_hz);
}

TrackingThread::TrackingThread(SharedSurface& surface, std::unique_ptr<TrackingPipeline> pipeline,
                               PuckSearch search, const TrackingThreadParams& params,
                               Publish publish)
    : surface_(surface),
      pipeline_(std::move(pipeline)),
      worker_(std::move(search)),
      params_(params),
      publish_period_(publish_period(params)),
      publish_(std::move(publish)) {
  events_.reserve(kQueueBatchEvents);
  snapshot_.surface.grey.reserve(surface.size().width, surface.size().height);
  next_publish_ = Clock::now();
  heartbeat_due_ = next_publish_;
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

TrackingThread::~TrackingThread() {
  thread_.request_stop();
  surface_.wake();
}

void TrackingThread::look_now() {
  if (!surface_.has_news()) return;
  bool leaves_work = true;
  // Without the lock, it is unknown whether the tracking thread sees the news before it sleeps.
  if (const std::unique_lock lock(step_mutex_, std::try_to_lock);
      lock.owns_lock() && is_for_event_thread()) {
    make_step(params_.longest_on_event_thread);
    leaves_work = unpublished_ || look_requested_ || worker_.is_copying();
  }
  if (leaves_work) surface_.wake();
}

bool TrackingThread::is_for_event_thread() const {
  // A step without a track is longer and not urgent.
  return newest_.estimate.state == TrackState::kTracking &&
         last_step_ <= params_.longest_on_event_thread && Clock::now() >= next_look_;
}

void TrackingThread::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    Pause pause;
    {
      const std::lock_guard lock(step_mutex_);
      run_due_tasks();
      pause = next_pause();
    }
    if (pause.ends_with_news) {
      surface_.wait_for_news(pause.longest);
    } else {
      surface_.wait(pause.longest);
    }
  }
}

void TrackingThread::run_due_tasks() {
  if (look_requested_ || (surface_.has_news() && Clock::now() >= next_look_)) {
    make_step(kLongestTake);
  }
  // After the estimate, because it may take longer than a step; the next one follows at once.
  take_search_result();
  if (worker_.is_copying()) worker_.copy_more(surface_);
  publish_if_due();
}

TrackingThread::Pause TrackingThread::next_pause() const {
  const auto now = Clock::now();
  auto until = unpublished_ ? std::min(std::max(next_publish_, publish_from_), heartbeat_due_)
                            : heartbeat_due_;
  if (worker_.is_copying() || look_requested_) {
    until = now;
  } else if (!worker_.is_idle()) {
    until = std::min(until, now + kIdlePeriod);
  }
  const bool look_allowed = now >= next_look_;
  if (!look_allowed) until = std::min(until, next_look_);
  return {std::max(std::chrono::ceil<microseconds>(until - now), microseconds::zero()),
          look_allowed};
}

void TrackingThread::take_search_result() {
  const SearchResult* result = worker_.poll();
  if (result == nullptr) return;
  pipeline_->take(*result);
  look_requested_ = true;
}

void TrackingThread::make_step(microseconds longest_take) {
  const auto began = Clock::now();
  look(longest_take);
  publish_if_due();
  pipeline_->work_off();
  last_step_ = Clock::now() - began;
}

void TrackingThread::look(microseconds longest_take) {
  newest_.tracking_started = system_clock::now();
  const auto began = Clock::now();
  surface_.snapshot(pipeline_->region_needed(), pipeline_->needs_events(), snapshot_);
  look_requested_ = false;
  const bool is_all_taken = take_events(longest_take);
  if (!is_all_taken) look_requested_ = true;
  newest_.estimate = pipeline_->step(snapshot_.surface);
  begin_search_if_wanted();
  if (snapshot_.origin.received != newest_.origin.received) {
    newest_.packet_to_look = std::max(began - snapshot_.origin.received, Clock::duration::zero());
  }
  newest_.origin = snapshot_.origin;
  newest_.backlog_us = snapshot_.backlog_us;
  newest_.backlog_events = snapshot_.backlog_events;
  // An estimate from a part of a packet waits for the one from all of it, which follows soon.
  const bool is_whole = snapshot_.backlog_events == 0 && is_all_taken;
  if (is_whole) {
    publish_from_ = began;
  } else if (!unpublished_) {
    publish_from_ = began + publish_period_ / 2;
  }
  unpublished_ = true;
  if (pipeline_->region_needed().empty() && !pipeline_->needs_events()) {
    next_look_ = Clock::now() + std::min(publish_period_, kIdlePeriod);
  }
}

// Passes the snapshot's events to the pipeline. Returns false when `longest_take` ends before all
// are taken; the snapshot's newest event and backlog are then those of the events taken.
bool TrackingThread::take_events(microseconds longest_take) {
  const auto time_up = Clock::now() + longest_take;
  while (true) {
    const Timestamp start = surface_.pop_events(snapshot_.events_end, kQueueBatchEvents, events_);
    if (events_.empty()) return true;
    for_each_piece(start, events_, pipeline_->decision_period_us(),
                   [&](std::span<const Event> piece) {
                     pipeline_->take(start, piece);
                     begin_search_if_wanted();
                   });
    if (Clock::now() >= time_up) {
      const Timestamp newest_taken = start + events_.back().offset_us;
      snapshot_.backlog_us += snapshot_.surface.newest_event - newest_taken;
      snapshot_.surface.newest_event = newest_taken;
      return false;
    }
  }
}

void TrackingThread::begin_search_if_wanted() {
  if (!worker_.is_idle()) return;
  const SearchRequest wanted = pipeline_->search_wanted();
  if (wanted.region.empty()) return;
  const auto now = Clock::now();
  const bool is_urgent = newest_.estimate.state != TrackState::kTracking &&
                         !worker_.is_small(wanted) &&
                         now - urgently_searched_ >= kUrgentSearchPeriod;
  if (is_urgent) urgently_searched_ = now;
  worker_.begin(wanted, is_urgent);
  // The next look requests the events that the search needs.
  look_requested_ = true;
}

void TrackingThread::publish_if_due() {
  const auto now = Clock::now();
  const bool changed = newest_.estimate.state != published_state_;
  const bool slot = unpublished_ && now >= next_publish_ && now >= publish_from_;
  if (!changed && !slot && now < heartbeat_due_) return;
  newest_.input_age = now - surface_.newest_packet_received();
  publish_(newest_);
  published_state_ = newest_.estimate.state;
  unpublished_ = false;
  // Evenly spaced: the next time follows from the last one unless that is long past.
  next_publish_ = std::max(next_publish_ + publish_period_, now);
  heartbeat_due_ = now + params_.heartbeat;
}

}  // namespace puck
