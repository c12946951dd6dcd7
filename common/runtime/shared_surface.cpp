#include "common/runtime/shared_surface.h"

#include <algorithm>
#include <thread>

#include "common/vision/surface/region_filter.h"

namespace puck {
namespace {

// Events between two checks for a request: about 1 µs.
constexpr std::size_t kBatchEvents = 100;

// Polls of the request between two attempts to lock the surface, which disturbs the event thread;
// and attempts before the first yield.
constexpr int kPolls = 64;
constexpr int kTriesBeforeYielding = 32;

}  // namespace

SharedSurface::SharedSurface(SensorSize sensor, const SurfaceParams& params, const Options& options)
    : surface_(sensor, params), roi_only_(options.roi_only) {
  // Allocates the buffers now.
  surface_.take(Region::all_of(sensor), taken_);
  if (!options.keeps_fresh) return;
  fresh_.emplace(sensor);
  fresh_->copy_rows({}, taken_fresh_);
}

void SharedSurface::update(const EventPacket& packet, const PacketOrigin& origin, bool wakes) {
  const std::span<const Event> events(packet.events);
  newest_packet_.store(origin.received.time_since_epoch().count(), std::memory_order_relaxed);
  const std::lock_guard lock(surface_mutex_);
  for (std::size_t applied = 0; applied < events.size();) {
    const std::span<const Event> batch =
        events.subspan(applied, std::min(kBatchEvents, events.size() - applied));
    surface_.update(packet.start, batch);
    if (fresh_) fresh_->take(packet.start, batch);
    applied += batch.size();
    if (queues_) queue_.push(packet.start, batch);
    note_applied(packet, applied, origin);
    if (queues_ || watched_.empty() || any_inside(batch, watched_)) report_news(wakes);
    if (requested_.load(std::memory_order_acquire)) serve();
  }
}

void SharedSurface::snapshot(const Region& region, bool events, SharedSnapshot& out) {
  const bool has_region = !region.empty();
  if (takes_events_only_ && events && !has_region) {
    out.surface.region = {};
    return take_stamps(out);
  }
  request({.region = region, .events = events, .snapshot = &out});
  surface_.develop(taken_, out.surface);
  takes_events_only_ = events && !has_region;
}

// Together with the events, so that no snapshot promises events that are not in the queue yet.
void SharedSurface::note_applied(const EventPacket& packet, std::size_t applied,
                                 const PacketOrigin& origin) {
  const std::lock_guard lock(stamps_mutex_);
  stamps_ = {origin,
             surface_.newest_event(),
             surface_.events_applied(),
             packet.newest() - surface_.newest_event(),
             static_cast<std::int64_t>(packet.events.size() - applied),
             queue_.end()};
}

void SharedSurface::take_stamps(SharedSnapshot& out) {
  // Cleared before, so that events after the copy count as news again. What is copied just before
  // it is reported stays news: one look for nothing.
  news_.store(false, std::memory_order_release);
  const std::lock_guard lock(stamps_mutex_);
  out.origin = stamps_.origin;
  out.surface.newest_event = stamps_.newest_event;
  out.surface.events_applied = stamps_.events_applied;
  out.backlog_us = stamps_.backlog_us;
  out.backlog_events = stamps_.backlog_events;
  out.events_end = stamps_.events_end;
}

void SharedSurface::copy_part(const Region& part, bool fresh_only, SurfaceSnapshot& out) {
  request({.region = part, .fresh_only = fresh_only});
  surface_.develop_part(taken_, out);
  if (fresh_only && fresh_) taken_fresh_.darken_stale(part, out.picture_of(part));
}

void SharedSurface::request(const Request& request) {
  request_ = request;
  requested_.store(true, std::memory_order_release);
  for (int tries = 0; requested_.load(std::memory_order_acquire); ++tries) {
    const std::unique_lock lock(surface_mutex_, std::try_to_lock);
    // The event thread may have served the request just before it released the lock.
    if (lock.owns_lock()) {
      if (requested_.load(std::memory_order_acquire)) serve();
      return;
    }
    // The event thread is applying a packet and serves the request within a batch of events, unless
    // it is preempted.
    for (int polls = 0; polls < kPolls && requested_.load(std::memory_order_acquire); ++polls) {
    }
    if (tries >= kTriesBeforeYielding) std::this_thread::yield();
  }
}

bool SharedSurface::wait_for_news(std::chrono::microseconds timeout) {
  std::unique_lock lock(sleep_mutex_);
  woken_.wait_for(lock, timeout,
                  [&] { return wake_requested_ || news_.load(std::memory_order_acquire); });
  wake_requested_ = false;
  return news_.load(std::memory_order_acquire);
}

void SharedSurface::wait(std::chrono::microseconds timeout) {
  std::unique_lock lock(sleep_mutex_);
  woken_.wait_for(lock, timeout, [&] { return wake_requested_; });
  wake_requested_ = false;
}

void SharedSurface::wake() {
  {
    const std::lock_guard lock(sleep_mutex_);
    wake_requested_ = true;
  }
  woken_.notify_one();
}

void SharedSurface::serve() {
  if (request_.snapshot != nullptr && roi_only_) {
    const Region asked = request_.events ? Region{} : request_.region;
    surface_.keep_only(asked.empty() ? Region::all_of(size()) : asked);
  }
  surface_.take(request_.region, taken_);
  if (request_.fresh_only && fresh_) fresh_->copy_rows(request_.region, taken_fresh_);
  if (request_.snapshot != nullptr) {
    take_stamps(*request_.snapshot);
    watched_ = request_.region;
    queues_ = request_.events;
  }
  requested_.store(false, std::memory_order_release);
}

void SharedSurface::report_news(bool wakes) {
  if (news_.exchange(true, std::memory_order_acq_rel) || !wakes) return;
  // The lock ensures that a waiting thread either sees the news before it sleeps or gets the
  // notification. It is released first, because the woken thread needs it.
  { const std::lock_guard lock(sleep_mutex_); }
  woken_.notify_one();
}

}  // namespace puck
