// What puck-camera --pause and its like believe of the cameras that they hear.
#include "services/camera/camera_request.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/messaging/conversions.h"
#include "tests/support/contains.h"
#include "tests/support/skewed_machine.h"
#include "tests/support/test_url.h"
#include "tests/support/wait_until.h"

namespace puck {
namespace {

constexpr std::int64_t kFarthestUs = 1'000'000'000'000'000;

CameraControl second_on() {
  CameraControl control;
  control.mode = CameraControlMode::kSeek;
  control.position_us = 1'000'000;
  return control;
}

/// A request to move by 1 s, and a machine whose STATUS the test makes up.
class Asking {
 public:
  Asking() {
    request_.listen(bus_, status_);
    bus_.subscribe<CameraControl>(
        [this](const CameraControl& control, const Receipt&) { sent_.push_back(control); });
    REQUIRE(bus_.start({}, [](const std::string&) {}));
    REQUIRE(serve_until([&] { return status_.clock_of(machine_.session()).has_value(); }));
  }

  bool serve_until(const std::function<bool()>& condition) {
    return wait_until([&] {
      serve();
      return condition();
    });
  }
  /// Until each camera that speaks meanwhile would be asked.
  void introduce(const std::function<void()>& speak) {
    for (int i = 0; i < 3; ++i) {
      speak();
      const std::int64_t end_us = host_monotonic_us() + 40'000;
      serve_until([&] { return host_monotonic_us() > end_us; });
    }
  }
  void hear_camera(int pid, std::optional<std::int64_t> position_us, std::int64_t age_us = 0,
                   std::optional<ControlVerdict> verdict = std::nullopt) {
    service_status_t status{};
    status.service = "puck-camera";
    status.host = "lab";
    status.pid = pid;
    status.state = service_status_t::STATE_WAITING;
    status.state_text = "cannot keep up; paused at " + std::to_string(pid);
    if (position_us) {
      status.counter_name = {kPositionUs};
      status.counter_value = {*position_us};
    }
    if (verdict) {
      status.counter_name.insert(status.counter_name.end(), {kControlSession, kControlVerdict});
      status.counter_value.insert(status.counter_value.end(),
                                  {bus_.session(), static_cast<std::int64_t>(*verdict)});
    }
    machine_.publish(status, age_us);
  }
  /// The positions that were asked for in one round.
  std::vector<std::int64_t> positions_asked() {
    sent_.clear();
    request_.publish(bus_);
    // A control of our own behind them tells that all have come.
    CameraControl last;
    last.request = 7;
    bus_.publish(last);
    CHECK(serve_until([&] { return !sent_.empty() && sent_.back().request == 7; }));
    std::vector<std::int64_t> positions;
    for (const CameraControl& control : sent_) {
      if (control.request != 7) positions.push_back(control.position_us);
    }
    return positions;
  }

  std::string url_ = private_lcm_url(4);
  Bus bus_{{.url = url_}};
  StatusReporter status_{bus_, "puck-operator"};
  CameraRequest request_{second_on(), true, "moved"};
  SkewedMachine machine_{url_, 11, 0};
  std::vector<CameraControl> sent_;

 private:
  void serve() {
    bus_.handle(std::chrono::milliseconds(0));
    status_.poll([](StatusReport&) {});
    machine_.serve();
  }
};

TEST_CASE("only cameras with a current STATUS are asked, from a position within bounds") {
  Asking asking;
  CHECK(asking.request_.why_not() == "no puck-camera is heard");
  asking.introduce([&] {
    asking.hear_camera(1, 5'000'000, 300'000);  // Stale.
    asking.hear_camera(2, 7'000'000);
    asking.hear_camera(3, -4'000'000);
    asking.hear_camera(4, INT64_MAX);
  });
  CHECK(asking.positions_asked() ==
        std::vector<std::int64_t>{8'000'000, 1'000'000, kFarthestUs + 1'000'000});
}

TEST_CASE("a sender that makes up cameras is asked as 64 of them at most") {
  Asking asking;
  asking.introduce([&] {
    for (int pid = 1; pid <= 100; ++pid) asking.hear_camera(pid, 0);
  });
  CHECK(asking.positions_asked().size() == 64);
}

TEST_CASE("a camera that searches is asked again, since its answer may be hidden by another one") {
  Asking asking;
  asking.introduce([&] { asking.hear_camera(1, 0, 0, ControlVerdict::kSearching); });
  CHECK(asking.positions_asked() == std::vector<std::int64_t>{1'000'000});
  CHECK(asking.request_.is_in_progress());
  asking.hear_camera(1, 0, 0, ControlVerdict::kObeyed);
  REQUIRE(asking.serve_until([&] { return asking.request_.why_not().empty(); }));
  CHECK(asking.positions_asked().empty());
}

TEST_CASE("a camera without a recording does not matter beside one that obeyed, which is named") {
  Asking asking;
  asking.hear_camera(1, std::nullopt);
  REQUIRE(asking.serve_until([&] { return !asking.request_.refusal().empty(); }));
  CHECK(asking.request_.refusal() ==
        "no camera on this bus plays a recording: camera.source is not \"file\" or \"log\", or "
        "camera.pace is \"arrival\" (lab, pid 1)");
  asking.hear_camera(2, 0);
  asking.hear_camera(4, 0, 0, ControlVerdict::kNoRecording);
  REQUIRE(asking.serve_until([&] { return asking.request_.refusal().empty(); }));
  CHECK(asking.request_.why_not() == "the camera on lab, pid 2 does not answer");
  asking.hear_camera(2, 0, 0, ControlVerdict::kObeyed);
  REQUIRE(asking.serve_until([&] { return asking.request_.why_not().empty(); }));
  CHECK(asking.request_.refusal().empty());
  CHECK(asking.request_.result() == "paused at 2 (lab, pid 2)");
  asking.hear_camera(3, 0, 0, ControlVerdict::kBeyondEnd);
  REQUIRE(asking.serve_until([&] { return !asking.request_.refusal().empty(); }));
  CHECK(asking.request_.refusal() == std::string(to_string(ControlVerdict::kBeyondEnd)) +
                                         " (lab, pid 3); but obeyed: paused at 2 (lab, pid 2)");
}

}  // namespace
}  // namespace puck
