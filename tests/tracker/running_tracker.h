#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>
#include <spdlog/sinks/null_sink.h>

#include "common/messaging/event_packing.h"
#include "services/tracker/tracker_service.h"
#include "tests/support/status_counter.h"
#include "tests/support/wait_until.h"
#include "tests/vision/puck_picture.h"

namespace puck::test {

// Small, so that a search of all of it is quick even under a sanitizer.
inline constexpr SensorSize kSensor{160, 120};

// A tracker on a bus of its own. The test publishes on the same bus, from its own thread.
class RunningTracker {
 public:
  explicit RunningTracker(const std::string& settings = "") {
    // These rings do not move, and `default` detects a puck by its motion.
    Config config =
        Config::from_text("[tracker]\npreset = \"correlation\"\n" + settings, "tracker.toml");
    TrackerServiceParams params = TrackerService::read_params(config);
    params.size_model = {25, 0, 0, 17, 0, 0};
    bus_.subscribe<puck_estimate_t>([this](const puck_estimate_t& estimate, const Receipt&) {
      const std::lock_guard lock(mutex_);
      estimates_.push_back(estimate);
    });
    service_ = std::make_unique<TrackerService>(params, context_);
    REQUIRE(bus_.start({}, [](const std::string&) {}));
    thread_ = std::jthread([this](const std::stop_token& stop) { service_->run(stop); });
  }

  void publish(const EventPacket& events, std::int64_t sensor_zero_utime = 0) {
    packer_.pack(events.start, events.events, [&](event_packet_t& packet) {
      packet.sensor_zero_utime = sensor_zero_utime;
      bus_.publish(packet);
    });
  }

  // Sends a packet unchanged, with any order in its header.
  void publish_raw(event_packet_t packet) { bus_.publish(packet); }

  std::vector<puck_estimate_t> estimates() const {
    const std::lock_guard lock(mutex_);
    return estimates_;
  }

  template <typename Condition>
  bool eventually(const Condition& condition) const {
    return wait_until([&] {
      const auto all = estimates();
      return !all.empty() && condition(all.back());
    });
  }

  Bus& bus() { return bus_; }
  void stop() {
    thread_.request_stop();
    thread_.join();
  }
  const TrackerService& service() const { return *service_; }

 private:
  Bus bus_{{.url = "memq://"}};
  StatusReporter status_{bus_, "puck-tracker"};
  spdlog::logger log_{"test", std::make_shared<spdlog::sinks::null_sink_mt>()};
  RateLimitedLog limited_log_{log_};
  BusWatch bus_watch_{bus_, log_};
  PeerWatch peers_{status_, log_};
  ServiceContext context_{bus_, status_, log_, limited_log_, bus_watch_, peers_};
  EventPacker packer_{{.sensor = kSensor, .packet_bytes = 60000}};
  mutable std::mutex mutex_;
  std::vector<puck_estimate_t> estimates_;
  std::unique_ptr<TrackerService> service_;
  std::jthread thread_;
};

inline EventPacket puck_at(Pixel centre, std::int64_t t_us) {
  return {{t_us}, contour_events(kSensor, centre, {25, 17}, 150)};
}

}  // namespace puck::test
