#include "common/runtime/shared_surface.h"

#include <algorithm>
#include <thread>

#include "common/vision/region_filter.h"

namespace puck {
namespace {

// Events between two looks for a request: about a microsecond's worth.
constexpr std::size_t kHandful = 100;

// How often the tracking thread looks whether it has been served before it tries to serve itself,
// which disturbs the event thread, and how often it tries before it lets others run.
constexpr int kLooks = 64;
constexpr int kTriesBeforeYielding = 32;

}  // namespace

SharedSurface::SharedSurface(SensorSize sensor, const ErosParams& params, const Options& options)
    : surface_(sensor, params), roi_only_(options.roi_only) {
  if (!options.keeps_fresh) return;
  fresh_.emplace(sensor);
  // Asks for its memory now.
  fresh_->copy_rows({}, taken_fresh_);
}

void SharedSurface::update(const EventPacket& packet, const PacketOrigin& origin, bool wakes) {
  const std::span<const Event> events(packet.events);
  newest_packet_.store(origin.received.time_since_epoch().count(), std::memory_order_relaxed);
  const std::lock_guard lock(surface_mutex_);
  origin_ = origin;
  for (std::size_t applied = 0; applied < events.size();) {
    const std::span<const Event> handful =
        events.subspan(applied, std::min(kHandful, events.size() - applied));
    surface_.update(packet.start, handful);
    if (fresh_) fresh_->take(packet.start, handful);
    applied += handful.size();
    const bool queued = !queued_.empty() && queue_.push(packet.start, handful, queued_) > 0;
    const bool watches_all = watched_.empty() && queued_.empty();
    if (queued || watches_all || any_inside(handful, watched_)) report_news(wakes);
    if (requested_.load(std::memory_order_acquire)) serve(&packet, applied);
  }
}

void SharedSurface::snapshot(const Region& region, const Region& events, SharedSnapshot& out) {
  ask({.region = region, .events = events, .snapshot = &out});
  surface_.develop(taken_, out.surface);
}

void SharedSurface::copy_part(const Region& part, bool fresh_only, SurfaceSnapshot& out) {
  ask({.region = part, .fresh_only = fresh_only});
  surface_.develop_part(taken_, out);
  if (fresh_only && fresh_) taken_fresh_.darken_stale(part, out.picture_of(part));
}

void SharedSurface::ask(const Request& request) {
  request_ = request;
  requested_.store(true, std::memory_order_release);
  for (int tries = 0; requested_.load(std::memory_order_acquire); ++tries) {
    const std::unique_lock lock(surface_mutex_, std::try_to_lock);
    // The event thread may have served the request just before it let go of the surface.
    if (lock.owns_lock()) {
      if (requested_.load(std::memory_order_acquire)) serve(nullptr, 0);
      return;
    }
    // It is at work and will serve the request within a handful of events, unless it has been
    // interrupted.
    for (int looks = 0; looks < kLooks && requested_.load(std::memory_order_acquire); ++looks) {
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

void SharedSurface::serve(const EventPacket* pending, std::size_t applied) {
  if (request_.snapshot != nullptr && roi_only_) {
    const Region asked = request_.region.united(request_.events);
    surface_.keep_only(asked.empty() ? Region::all_of(size()) : asked);
  }
  surface_.take(request_.region, taken_);
  if (request_.fresh_only && fresh_) fresh_->copy_rows(request_.region, taken_fresh_);
  if (request_.snapshot != nullptr) {
    SharedSnapshot& out = *request_.snapshot;
    // Cleared under the lock: what comes after the copy is news again.
    news_.store(false, std::memory_order_release);
    watched_ = request_.region;
    queued_ = request_.events;
    out.events_end = queue_.end();
    out.origin = origin_;
    out.backlog_us = 0;
    out.backlog_events = 0;
    if (pending != nullptr) {
      out.backlog_us = pending->newest() - surface_.newest_event();
      out.backlog_events = static_cast<std::int64_t>(pending->events.size() - applied);
    }
  }
  requested_.store(false, std::memory_order_release);
}

void SharedSurface::report_news(bool wakes) {
  if (news_.exchange(true, std::memory_order_acq_rel) || !wakes) return;
  // The lock makes sure that a sleeper either sees the news before it sleeps or hears the call. Who
  // is woken needs it too, so it is let go of first.
  { const std::lock_guard lock(sleep_mutex_); }
  woken_.notify_one();
}

}  // namespace puck
