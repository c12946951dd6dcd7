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
#include "common/events/packet_counters.h"
#include "common/events/sensor_size.h"
#include "common/runtime/event_queue.h"
#include "common/vision/geometry/region.h"
#include "common/vision/surface/fresh_pixels.h"
#include "common/vision/surface/surface.h"
#include "common/vision/surface/surface_snapshot.h"

namespace puck {

/// Origin and times of a packet of events; an estimate carries those of its newest event.
struct PacketOrigin {
  std::int64_t session = 0;            ///< Of the publisher of the events.
  std::int64_t sensor_zero_utime = 0;  ///< Host realtime at sensor time 0, µs; 0: not known.
  bool is_live = false;                ///< Published now by a camera whose clock is known.
  bool is_recorded = false;            ///< The events are recorded ones.
  std::int64_t received_utime = 0;     ///< Host realtime at its receipt, µs.
  std::chrono::steady_clock::time_point received;
  std::int64_t queued_us = 0;  ///< Sensor time received after the packet before it was applied.
  PacketCounters counters;     ///< Counts up to this packet.
};

/// A copy of a region of the shared surface with the state at its time.
struct SharedSnapshot {
  SurfaceSnapshot surface;
  PacketOrigin origin;              ///< Of the packet that holds the newest event.
  std::int64_t backlog_us = 0;      ///< Sensor time received but not on the surface yet.
  std::int64_t backlog_events = 0;  ///< Events received but not on the surface yet.
  /// Position in the queue after the last event that is not newer than this copy.
  std::uint64_t events_end = 0;
};

/// The data shared by the paper's two threads. The event thread owns the surface, the tracking
/// thread requests a region of it. The event thread serves a request between two batches of events;
/// while it is idle, the tracking thread serves itself. So neither waits for longer than it takes
/// to apply a batch or to copy a region. The copies hold counts, which the tracking thread converts
/// to grey values. Single events, if requested, are passed in a queue; a snapshot without a region
/// is then a copy of a few numbers.
///
/// A tracking step runs on the tracking thread, or on the event thread between two updates, one at
/// a time under TrackingThread's lock: the stepping thread is the thread that holds it.
class SharedSurface {
 public:
  /// Capacity of the queue, and so the largest delay of a slow tracking thread, in events. Bursts
  /// of up to half of it are not thinned.
  static constexpr std::size_t kQueuedEvents = 8192;

  struct Options {
    /// Updates only the region of the last snapshot, or the whole surface if that region is empty
    /// or events are requested.
    bool roi_only = false;
    /// Allows `fresh_only` copies.
    bool keeps_fresh = true;
  };
  SharedSurface(SensorSize sensor, const SurfaceParams& params, const Options& options);
  SharedSurface(SensorSize sensor, const SurfaceParams& params)
      : SharedSurface(sensor, params, Options{}) {}

  SensorSize size() const { return surface_.size(); }

  /// Event thread only. Applies a packet, which must not be empty, and serves requests meanwhile.
  /// With `wakes`, wakes the tracking thread when an event is news; without it, the caller must
  /// poll `has_news()` or call `wake()`.
  void update(const EventPacket& packet, const PacketOrigin& origin, bool wakes = true);

  /// Safe from any thread. Whether events have arrived in the watched region since the last
  /// snapshot.
  bool has_news() const { return news_.load(std::memory_order_acquire); }

  /// Stepping thread only. Copies `region`. From then on that region is watched, or the whole
  /// sensor if it is empty; with `events`, all events go to the queue and are news.
  void snapshot(const Region& region, bool events, SharedSnapshot& out);

  /// Stepping thread only. Copies `part`, which must lie inside `out`'s region and picture, to its
  /// place in `out`, with the stamps of this copy. The watched region does not change. `fresh_only`
  /// needs Options::keeps_fresh: pixels that have not fired recently are dark.
  void copy_part(const Region& part, bool fresh_only, SurfaceSnapshot& out);

  /// Stepping thread only. As EventQueue::pop.
  Timestamp pop_events(std::uint64_t until, std::size_t most, std::vector<Event>& out) {
    return queue_.pop(until, most, out);
  }

  /// Safe from any thread. Requested events that the queue dropped.
  std::int64_t events_thinned() const { return queue_.thinned(); }

  /// Tracking thread only, between steps. Sleeps until there is news, `timeout` has passed or
  /// `wake` is called. Returns whether there is news.
  bool wait_for_news(std::chrono::microseconds timeout);

  /// Tracking thread only, between steps. Sleeps, also when there is news, until `timeout` has
  /// passed or `wake` is called.
  void wait(std::chrono::microseconds timeout);

  /// Safe from any thread. Ends a `wait` or `wait_for_news`.
  void wake();

  /// Safe from any thread. Time at which the newest packet was received; the clock's epoch before
  /// the first.
  std::chrono::steady_clock::time_point newest_packet_received() const {
    return std::chrono::steady_clock::time_point(
        std::chrono::steady_clock::duration(newest_packet_.load(std::memory_order_relaxed)));
  }

 private:
  // A request of the stepping thread: a snapshot, or a part of one.
  struct Request {
    Region region;
    bool events = false;
    SharedSnapshot* snapshot = nullptr;  // nullptr: a part, without the queue's and packet's state.
    bool fresh_only = false;
  };

  // What a snapshot says of its time.
  struct Stamps {
    PacketOrigin origin;
    Timestamp newest_event;
    std::int64_t events_applied = 0;
    std::int64_t backlog_us = 0;
    std::int64_t backlog_events = 0;
    std::uint64_t events_end = 0;
  };

  void request(const Request& request);
  void serve();
  void note_applied(const EventPacket& packet, std::size_t applied, const PacketOrigin& origin);
  void take_stamps(SharedSnapshot& out);
  void report_news(bool wakes);

  // Held by the event thread while it applies a packet, and by the stepping thread while it serves
  // itself.
  std::mutex surface_mutex_;
  Surface surface_;                   // Guarded by surface_mutex_.
  std::optional<FreshPixels> fresh_;  // Guarded by surface_mutex_.
  const bool roi_only_;
  Region watched_;       // Guarded by surface_mutex_. Empty: the whole sensor.
  bool queues_ = false;  // Guarded by surface_mutex_. Events go to the queue; all of them are news.
  EventQueue queue_{kQueuedEvents};

  std::mutex stamps_mutex_;  // Held for a moment after each batch, and to copy the stamps.
  Stamps stamps_;            // Guarded by stamps_mutex_.
  // Stepping thread. The last snapshot had no region, but requested events.
  bool takes_events_only_ = false;

  // Written by the stepping thread before it sets `requested_` (release), served by the holder of
  // surface_mutex_ after it loads it (acquire), finished by clearing it (release).
  Request request_;
  SurfaceExposure taken_;
  FreshRows taken_fresh_;
  // On its own cache line, because the event thread polls it.
  alignas(64) std::atomic<bool> requested_{false};

  // Relaxed: no other data depends on it.
  std::atomic<std::chrono::steady_clock::rep> newest_packet_{0};

  // Set by the event thread, cleared by a snapshot.
  std::atomic<bool> news_{false};
  std::mutex sleep_mutex_;
  std::condition_variable woken_;
  bool wake_requested_ = false;  // Guarded by sleep_mutex_.
};

}  // namespace puck
