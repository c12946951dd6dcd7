#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/runtime/event_queue.h"
#include "common/vision/eros_surface.h"
#include "common/vision/fresh_pixels.h"
#include "common/vision/region.h"
#include "common/vision/surface_snapshot.h"

namespace puck {

/// What became of the packets of a session until now.
struct PacketCounters {
  std::int64_t received = 0;
  std::int64_t lost = 0;
  std::int64_t late = 0;  ///< Came after a later one, or twice, and were dropped.
  std::int64_t rejected = 0;
  std::int64_t events_lost = 0;     ///< In lost packets.
  std::int64_t events_skipped = 0;  ///< In packets left out to keep to the newest.
  std::int64_t events_dropped = 0;  ///< By the source, before they were published.
};

/// Where a packet of events comes from and when: what an estimate says of the newest event that it
/// rests on.
struct PacketOrigin {
  std::int64_t session = 0;            ///< Of the publisher of the events.
  std::int64_t sensor_zero_utime = 0;  ///< Host realtime at sensor time 0, µs; 0: not known.
  bool is_live = false;                ///< Published just now by a camera whose clock is known.
  bool is_recorded = false;            ///< Its events are not of now all the same.
  std::int64_t received_utime = 0;     ///< Host realtime at its receipt, µs.
  std::chrono::steady_clock::time_point received;
  std::int64_t queued_us = 0;  ///< Sensor time that had been received after it when it was applied.
  PacketCounters counters;     ///< As of this packet.
};

/// A copy of a part of the shared surface with what was going on when it was made.
struct SharedSnapshot {
  SurfaceSnapshot surface;
  PacketOrigin origin;              ///< Of the packet that holds the newest event.
  std::int64_t backlog_us = 0;      ///< Sensor time received but not on the surface yet.
  std::int64_t backlog_events = 0;  ///< Events received but not on the surface yet.
  /// Where the queue's events end that are not newer than this copy.
  std::uint64_t events_end = 0;
};

/// The one place where the paper's two threads meet: the event thread owns the surface, the
/// tracking thread asks for a part of it. A request is served by the event thread between two
/// handfuls of events, or, while that one has nothing to do, by the tracking thread itself; so
/// neither waits for the other for longer than it takes to apply a handful, or to copy a region.
/// What is copied are counts; the tracking thread makes grey values of them. Single events of a
/// region that the tracking thread asks for come over in a queue. A step of the tracking is made by
/// the tracking thread, or by the event thread in its place between two updates, one at a time and
/// under one lock, that of TrackingThread: "whoever makes the step" is the one that holds it.
class SharedSurface {
 public:
  /// The queue's room. A tracking thread that falls behind is behind by no more than so many
  /// events; half as many may come at once without being thinned.
  static constexpr std::size_t kQueuedEvents = 8192;

  struct Options {
    /// Of the surface only the regions of the last snapshot are kept up to date, or all of it while
    /// both are empty.
    bool roi_only = false;
    /// Parts are asked for with `fresh_only`.
    bool keeps_fresh = true;
  };
  SharedSurface(SensorSize sensor, const ErosParams& params, const Options& options);
  SharedSurface(SensorSize sensor, const ErosParams& params)
      : SharedSurface(sensor, params, Options{}) {}

  SensorSize size() const { return surface_.size(); }

  /// Event thread only. Applies a packet, serves requests meanwhile, and, if it is to, wakes the
  /// tracking thread when an event lies in the region that was asked for last. Who does not let it
  /// wake that thread sees to the news itself, or wakes it. The packet must not be empty.
  void update(const EventPacket& packet, const PacketOrigin& origin, bool wakes = true);

  /// Safe from any thread. Whether there is something new in what is watched.
  bool has_news() const { return news_.load(std::memory_order_acquire); }

  /// By whoever makes the step. Copies `region`; from then on the events in `events` go to the
  /// queue, and both are watched. When both are empty the whole sensor is watched.
  void snapshot(const Region& region, const Region& events, SharedSnapshot& out);

  /// By whoever makes the step. Copies `part`, which lies inside `out`'s region and picture, to its
  /// place there; the stamps become those of this copy. What is watched stays as it is.
  /// `fresh_only`, with Options::keeps_fresh: pixels that have not fired of late are dark.
  void copy_part(const Region& part, bool fresh_only, SurfaceSnapshot& out);

  /// By whoever makes the step. Takes at most `most` of the queue's events up to the position
  /// `until`, as EventQueue::pop.
  Timestamp pop_events(std::uint64_t until, std::size_t most, std::vector<Event>& out) {
    return queue_.pop(until, most, out);
  }

  /// Safe from any thread. Events of regions asked for that found no room in the queue.
  std::int64_t events_thinned() const { return queue_.thinned(); }

  /// Tracking thread only, between steps. Sleeps until there is something new in what is watched,
  /// or `timeout` has passed, or someone wakes it. True when there is something new.
  bool wait_for_news(std::chrono::microseconds timeout);

  /// Tracking thread only, between steps. Sleeps, whatever is new, until `timeout` has passed or
  /// someone wakes it.
  void wait(std::chrono::microseconds timeout);

  /// Safe from any thread. Ends a wait.
  void wake();

  /// Safe from any thread. When the newest packet came, wherever its events lie; the clock's epoch
  /// before the first.
  std::chrono::steady_clock::time_point newest_packet_received() const {
    return std::chrono::steady_clock::time_point(
        std::chrono::steady_clock::duration(newest_packet_.load(std::memory_order_relaxed)));
  }

 private:
  // What whoever makes the step asks for: a snapshot, or a part of one.
  struct Request {
    Region region;
    Region events;
    SharedSnapshot* snapshot = nullptr;  // nullptr: a part, which carries no more than its stamps
    bool fresh_only = false;
  };

  void ask(const Request& request);
  void serve(const EventPacket* pending, std::size_t applied);
  void report_news(bool wakes);

  // Held by the event thread while it applies a packet, and by whoever makes the step when it
  // serves itself.
  std::mutex surface_mutex_;
  ErosSurface surface_;               // by surface_mutex_
  std::optional<FreshPixels> fresh_;  // by surface_mutex_
  const bool roi_only_;
  PacketOrigin origin_;  // by surface_mutex_
  Region watched_;       // by surface_mutex_
  Region queued_;        // by surface_mutex_; both empty: the whole sensor is watched
  EventQueue queue_{kQueuedEvents};

  // Written by whoever makes the step before it sets `requested_` (release), served by whoever
  // holds surface_mutex_ after seeing it (acquire), finished by clearing it (release).
  Request request_;
  SurfaceExposure taken_;
  FreshRows taken_fresh_;
  // On a cache line of its own, because the event thread looks at it all the time.
  alignas(64) std::atomic<bool> requested_{false};

  // Relaxed: it stands alone.
  std::atomic<std::chrono::steady_clock::rep> newest_packet_{0};

  // Set by the event thread, cleared when a copy is made.
  std::atomic<bool> news_{false};
  std::mutex sleep_mutex_;
  std::condition_variable woken_;
  bool wake_requested_ = false;  // by sleep_mutex_
};

}  // namespace puck
