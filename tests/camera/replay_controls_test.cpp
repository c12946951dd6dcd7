// Controls of several senders on the bus, and their ages.
#include "services/camera/replay_controls.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include <doctest/doctest.h>
#include <spdlog/sinks/ostream_sink.h>

#include "tests/support/contains.h"
#include "tests/support/skewed_machine.h"
#include "tests/support/status_counter.h"
#include "tests/support/test_url.h"
#include "tests/support/wait_until.h"

namespace puck {
namespace {

using Control = camera_control_t;

/// A recording in which each place is searched for until the test ends the search.
class EndlessSearch final : public EventSource {
 public:
  Outcome next(Chunk&) override { return Outcome::kNothingYet; }
  std::optional<SensorSize> sensor_size() const override { return SensorSize{64, 48}; }
  bool is_recording() const override { return true; }
  ControlVerdict seek(std::int64_t) override { return ControlVerdict::kSearching; }
};

/// The controls of a camera, and two programs with clocks of their own.
class ControlledReplay {
 public:
  ControlledReplay() : log_("camera", std::make_shared<spdlog::sinks::ostream_sink_mt>(log_text_)) {
    REQUIRE(bus_.start({}, [](const std::string&) {}));
    replay_.begin({0}, Replay::Clock::now());
    REQUIRE(serve_until(
        [&] { return status_.clock_of(first_.session()) && status_.clock_of(second_.session()); }));
  }

  bool serve_until(const std::function<bool()>& condition) {
    return wait_until([&] {
      bus_.handle(std::chrono::milliseconds(0));
      status_.poll([](StatusReport&) {});
      first_.serve();
      second_.serve();
      return condition();
    });
  }
  /// `age_us`: of the control's utime.
  void publish(SkewedMachine& sender, std::int8_t mode, std::int64_t request,
               std::int64_t age_us = 0, std::int64_t other_camera = 0) {
    Control control{};
    control.mode = mode;
    control.request = request;
    control.camera_session = other_camera != 0 ? other_camera : bus_.session();
    control.speed = 2;
    sender.publish(control, age_us);
  }
  std::int64_t counter(const std::string& name) const {
    return test::counter(controls_, name).value_or(0);
  }
  bool has_answered(const SkewedMachine& sender, ControlVerdict verdict) const {
    return counter(kControlSession) == sender.session() &&
           counter(kControlVerdict) == static_cast<std::int64_t>(verdict);
  }

  std::string url_ = private_lcm_url(3);
  std::ostringstream log_text_;
  spdlog::logger log_;
  Bus bus_{{.url = url_}};
  StatusReporter status_{bus_, "puck-camera"};
  RateLimitedLog limited_log_{log_};
  BusWatch bus_watch_{bus_, log_};
  PeerWatch peers_{status_, log_};
  ServiceContext context_{bus_, status_, log_, limited_log_, bus_watch_, peers_};
  EndlessSearch source_;
  Replay replay_{{}, source_};
  ReplayControls controls_{&replay_, context_};
  SkewedMachine first_{url_, 11, 5'000'000};
  SkewedMachine second_{url_, 22, -5'000'000};
};

TEST_CASE("of two senders at once one is obeyed, and the other told what became of its request") {
  ControlledReplay camera;
  camera.publish(camera.first_, Control::MODE_SEEK, 0);
  camera.publish(camera.second_, Control::MODE_SEEK, 0);
  REQUIRE(camera.serve_until([&] { return camera.counter("controls_refused") == 1; }));
  CHECK(camera.has_answered(camera.first_, ControlVerdict::kSearching));
  // The second repeats its request, which is taken in its turn …
  REQUIRE(camera.serve_until([&] {
    camera.publish(camera.second_, Control::MODE_SEEK, 0);
    return camera.has_answered(camera.second_, ControlVerdict::kSearching);
  }));
  // … and replaces the first one, whose repeats do not take the search back.
  camera.publish(camera.first_, Control::MODE_SEEK, 0);
  REQUIRE(camera.serve_until(
      [&] { return camera.has_answered(camera.first_, ControlVerdict::kReplaced); }));
  camera.replay_.end_search(true, Replay::Clock::now());
  camera.controls_.end_search(true);
  CHECK(camera.has_answered(camera.second_, ControlVerdict::kObeyed));
  camera.publish(camera.first_, Control::MODE_SEEK, 0);
  CHECK(camera.serve_until(
      [&] { return camera.has_answered(camera.first_, ControlVerdict::kReplaced); }));
  CHECK(camera.counter("controls_obeyed") == 1);
}

TEST_CASE("a control counts only while its age by its sender's clock is known and small") {
  ControlledReplay camera;
  std::int64_t refused = 0;
  const auto check_refused = [&](std::int64_t request, std::int64_t age_us, const char* reason) {
    CAPTURE(reason);
    camera.publish(camera.first_, Control::MODE_PAUSE, request, age_us);
    ++refused;
    CHECK(camera.serve_until([&] { return camera.counter("controls_refused") == refused; }));
  };
  check_refused(0, 300'000, "old");
  check_refused(1, -300'000, "from the future");
  CHECK_FALSE(camera.replay_.is_paused());
  CHECK(contains(camera.log_text_.str(), "refused: it was published more than 200 ms ago"));
  camera.publish(camera.first_, Control::MODE_PAUSE, 2);
  CHECK(camera.serve_until([&] { return camera.replay_.is_paused(); }));

  SkewedMachine unknown(camera.url_, 33, 0);
  camera.publish(unknown, Control::MODE_RESUME, 0);
  ++refused;
  CHECK(camera.serve_until([&] { return camera.counter("controls_refused") == refused; }));
  CHECK(camera.replay_.is_paused());
}

TEST_CASE("a control for another camera is counted without a warning") {
  ControlledReplay camera;
  camera.publish(camera.first_, Control::MODE_PAUSE, 0, 0, 77);
  CHECK(camera.serve_until([&] { return camera.counter("controls_for_others") == 1; }));
  CHECK(camera.counter("controls_refused") == 0);
  CHECK_FALSE(camera.replay_.is_paused());
  CHECK_FALSE(contains(camera.log_text_.str(), "control"));
}

}  // namespace
}  // namespace puck
