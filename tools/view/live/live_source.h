#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "common/messaging/bus.h"
#include "common/monitor/bus_monitor.h"
#include "common/vision/geometry/puck_size_model.h"
#include "tools/view/drawing/heat_map.h"
#include "tools/view/interface/view_source.h"
#include "tools/view/live/doctor_run.h"
#include "tools/view/live/live_messages.h"
#include "tools/view/live/live_view.h"

namespace puck {

/// What the live bus is looked at with.
struct LiveOptions {
  BusParams bus;
  std::optional<PuckSizeModel> size_model;  ///< For the heat map.
  std::string no_size_model;                ///< Why there is none, and what to do.
};

/// The live bus, as a subscriber that publishes nothing. Is on the bus only while somebody looks
/// and for 10 s more; without a viewer it costs nothing.
class LiveSource : public ViewSource {
 public:
  /// Throws BusError for a malformed URL, prefix or key.
  explicit LiveSource(LiveOptions options);

  bool fill(const PictureWishes& wishes, ViewScene& scene) override;
  ViewState state(Timestamp since, std::int64_t run) override;
  ViewTimeline timeline() override { return {}; }
  /// A live camera cannot be played; always says so.
  std::string control(const ViewControl& control) override;
  std::uint64_t version() const override { return version_.load(std::memory_order_relaxed); }
  void wait_for_change(std::uint64_t seen, std::chrono::milliseconds timeout) override;

 private:
  /// One stay on the bus.
  struct Stay {
    explicit Stay(const std::string& prefix, std::int64_t now_us)
        : monitor(prefix, MonitorParams{}, now_us) {}

    BusMonitor monitor;
    LiveView view;
    TransportCounters network;
    std::int64_t unknown_unauthenticated = 0;
  };

  void note_viewer();
  bool somebody_looks() const;
  void listen(const std::stop_token& stop);
  void stay_on_bus(const std::stop_token& stop);
  void hear(std::string_view channel, std::span<const std::uint8_t> bytes, const Receipt& receipt);
  /// puck-doctor tests itself on the bus: that is no sign of life.
  bool is_of_doctor(std::string_view channel, std::span<const std::uint8_t> bytes) const;
  void keep_counters(const Bus& bus);
  BusSnapshot snapshot(std::int64_t now_us);  // Under mutex_.
  void changed();

  LiveOptions options_;
  DoctorRun doctor_;
  // Relaxed: only tells that something is to be done; the data is behind the mutex.
  std::atomic<std::uint64_t> version_{1};
  std::atomic<std::int64_t> looked_us_{0};
  std::mutex mutex_;
  std::condition_variable_any news_;  // Of a viewer, or of a changed version.
  std::optional<Stay> stay_;          // Guarded by mutex_.
  std::string network_problem_;       // Guarded by mutex_.
  std::size_t received_bytes_ = 0;    // In this step; thread_ only.
  std::mutex heat_mutex_;
  std::optional<HeatMap> heat_map_;  // Guarded by heat_mutex_.
  std::jthread thread_;
};

}  // namespace puck
