#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <stop_token>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <spdlog/sinks/ostream_sink.h>

#include "common/messaging/event_packing.h"
#include "services/camera/camera_service.h"
#include "tests/camera/camera_fixtures.h"
#include "tests/support/status_counter.h"

namespace puck {

/// A camera on a bus of its own, and what it publishes. All on one thread.
class CameraRun {
 public:
  explicit CameraRun(const std::string& toml)
      : log_("camera", std::make_shared<spdlog::sinks::ostream_sink_mt>(log_text_)),
        config_(Config::from_text(toml, "camera.toml")) {
    settings_ = CameraService::read_params(config_);
    config_.reject_unknown();
    bus_.subscribe<event_packet_t>([this](const event_packet_t& packet, const Receipt& receipt) {
      in_order_ = in_order_ && receipt.in_order();
      EventPacket events;
      unpack(packet, events);
      append_seen(events, events_);
      packets_.push_back(packet);
      after_packet();
    });
    bus_.subscribe<ground_truth_t>([this](const ground_truth_t& truth, const Receipt&) {
      truths_us_.push_back(truth.sensor_us);
      on_truth_();
    });
    bus_.subscribe<head_state_t>([this](const head_state_t&, const Receipt&) { ++heads_; });
    bus_.subscribe<service_status_t>([this](const service_status_t& status, const Receipt&) {
      statuses_.push_back(status);
      on_status_(status);
    });
  }

  /// Until the source has ended, or `stop_after` events have come, and the bus is empty.
  void run(std::size_t stop_after = static_cast<std::size_t>(-1)) {
    stop_after_ = stop_after;
    ServiceContext context{bus_, status_, log_, limited_log_, bus_watch_, peers_};
    CameraService camera(settings_, context);
    REQUIRE(bus_.start(stop_.get_token(), [](const std::string&) {}));
    camera.run(stop_.get_token());
    status_.stop([&](StatusReport& report) { camera.report(report); });
    while (bus_.handle(std::chrono::milliseconds(10)) > 0) continue;
  }

  /// Publishes a control for this camera, as another program would.
  void control(std::int8_t mode, std::int64_t us = 0, double speed = 1) {
    camera_control_t control{};
    control.mode = mode;
    control.camera_session = bus_.session();
    control.request = requests_++;
    control.position_us = us;
    control.step_us = us;
    control.speed = speed;
    CHECK(bus_.publish(control));
  }

  std::optional<std::int64_t> last_counter(const std::string& name) const {
    return test::counter(statuses_.back(), name);
  }

  bool in_order_ = true;
  std::vector<SeenEvent> events_;
  std::vector<event_packet_t> packets_;
  std::vector<std::int64_t> truths_us_;
  int heads_ = 0;
  std::vector<service_status_t> statuses_;
  std::ostringstream log_text_;
  std::function<void()> on_truth_ = [] {};
  std::function<void(const service_status_t&)> on_status_ = [](const service_status_t&) {};
  std::function<bool()> stop_when_ = [] { return false; };
  std::stop_source stop_;
  Bus bus_{{.url = "memq://"}};

 private:
  void after_packet() {
    if (events_.size() >= stop_after_ || stop_when_()) stop_.request_stop();
  }

  spdlog::logger log_;
  Config config_;
  CameraSettings settings_;
  StatusReporter status_{bus_, "puck-camera"};
  RateLimitedLog limited_log_{log_};
  BusWatch bus_watch_{bus_, log_};
  PeerWatch peers_{status_, log_};
  std::size_t stop_after_ = 0;
  std::int64_t requests_ = 0;
};

}  // namespace puck
