#include "common/runtime/shared_surface.h"

#include <algorithm>
#include <thread>

namespace puck {
namespace {

// Events between two looks for a request: about a microsecond's worth.
constexpr std::size_t kHandful = 100;

bool any_inside(std::span<const Event> events, const Region& region) {
  return std::any_of(events.begin(), events.end(),
                     [&](const Event& event) { return region.contains(event.x, event.y); });
}

}  // namespace

void SharedSurface::update(const EventPacket& packet, const PacketOrigin& origin) {
  const std::span<const Event> events(packet.events);
  newest_packet_.store(origin.received.time_since_epoch().count(), std::memory_order_relaxed);
  const std::lock_guard lock(surface_mutex_);
  origin_ = origin;
  for (std::size_t applied = 0; applied < events.size();) {
    const std::span<const Event> handful =
        events.subspan(applied, std::min(kHandful, events.size() - applied));
    surface_.update(packet.start, handful);
    applied += handful.size();
    if (watched_.empty() || any_inside(handful, watched_)) report_news();
    if (requested_.load(std::memory_order_acquire)) serve_request(packet, applied);
  }
}

void SharedSurface::snapshot(const Region& region, SharedSnapshot& out) {
  requested_region_ = region;
  requested_snapshot_ = &out;
  requested_.store(true, std::memory_order_release);
  while (requested_.load(std::memory_order_acquire)) {
    const std::unique_lock lock(surface_mutex_, std::try_to_lock);
    if (!lock.owns_lock()) {
      // The event thread is at work and will serve the request within a handful of events.
      std::this_thread::yield();
      continue;
    }
    // It may have served the request just before it let go of the surface.
    if (requested_.load(std::memory_order_acquire)) {
      copy_to(out, nullptr, 0);
      requested_.store(false, std::memory_order_release);
    }
  }
}

bool SharedSurface::wait_for_news(std::chrono::microseconds timeout) {
  std::unique_lock lock(sleep_mutex_);
  woken_.wait_for(lock, timeout,
                  [&] { return wake_requested_ || news_.load(std::memory_order_acquire); });
  wake_requested_ = false;
  return news_.load(std::memory_order_acquire);
}

void SharedSurface::wake() {
  const std::lock_guard lock(sleep_mutex_);
  wake_requested_ = true;
  woken_.notify_one();
}

void SharedSurface::copy_to(SharedSnapshot& out, const EventPacket* pending, std::size_t applied) {
  // Cleared first: what comes after the copy is news again.
  news_.store(false, std::memory_order_release);
  watched_ = requested_region_;
  surface_.snapshot(requested_region_, out.surface);
  out.origin = origin_;
  out.backlog_us = 0;
  out.backlog_events = 0;
  if (pending != nullptr) {
    out.backlog_us = pending->newest() - surface_.newest_event();
    out.backlog_events = static_cast<std::int64_t>(pending->events.size() - applied);
  }
}

void SharedSurface::serve_request(const EventPacket& packet, std::size_t applied) {
  copy_to(*requested_snapshot_, &packet, applied);
  requested_.store(false, std::memory_order_release);
}

void SharedSurface::report_news() {
  if (news_.exchange(true, std::memory_order_acq_rel)) return;
  // The lock makes sure that a sleeper either sees the news before it sleeps or hears the call.
  const std::lock_guard lock(sleep_mutex_);
  woken_.notify_one();
}

}  // namespace puck
