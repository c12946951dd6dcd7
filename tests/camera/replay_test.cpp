// What people ask of a recording that is played: pauses, steps, speeds and places.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <sys/stat.h>

#include "common/messages/single_publisher.h"
#include "services/camera/control_verdict.h"
#include "tests/camera/camera_fixtures.h"
#include "tests/camera/camera_run.h"
#include "tests/camera/tcp_server.h"
#include "tests/support/contains.h"
#include "tests/support/event_log_writer.h"
#include "tests/support/temporary_folder.h"

namespace puck {
namespace {

using Control = camera_control_t;

std::string recording_settings(const std::filesystem::path& path, const std::string& more = "") {
  return "[camera]\nsource = \"file\"\nfile = \"" + path.string() + "\"\n" + more;
}

bool is_paused(const service_status_t& status) {
  return status.state == service_status_t::STATE_WAITING &&
         status.state_text.starts_with("paused at ");
}

/// The part of `events` with times from `from_us` to below `to_us`.
std::vector<SeenEvent> part(const std::vector<SeenEvent>& events, std::int64_t from_us,
                            std::int64_t to_us = INT64_MAX) {
  std::vector<SeenEvent> chosen;
  for (const SeenEvent& event : events) {
    if (event.t_us >= from_us && event.t_us < to_us) chosen.push_back(event);
  }
  return chosen;
}

/// The events that a session of the run has published.
std::vector<SeenEvent> session_events(const CameraRun& run, std::int64_t session) {
  std::vector<SeenEvent> events;
  for (const event_packet_t& packet : run.packets_) {
    if (packet.session != session) continue;
    EventPacket unpacked;
    unpack(packet, unpacked);
    append_seen(unpacked, events);
  }
  return events;
}

TEST_CASE("a paused recording publishes nothing, then plays on in the same session") {
  const CameraFolder folder;
  const auto events = even_events(30'000, 5'000'000, 10);
  write_recording(folder / "a.raw", events);
  CameraRun run(recording_settings(folder / "a.raw"));
  std::size_t seen_paused = 0;
  int paused_statuses = 0;
  run.stop_when_ = [&, told = false]() mutable {
    if (!told && run.events_.size() > 5000) {
      told = true;
      run.control(Control::MODE_PAUSE);
    }
    return false;
  };
  run.on_status_ = [&](const service_status_t& status) {
    if (!is_paused(status)) return;
    if (++paused_statuses == 2) seen_paused = run.events_.size();
    if (paused_statuses == 5) {
      CHECK(run.events_.size() == seen_paused);
      run.control(Control::MODE_RESUME);
    }
  };
  run.run();
  CHECK(paused_statuses >= 5);
  CHECK(seen_paused < events.size());
  CHECK(run.events_ == events);
  CHECK(run.in_order_);
  CHECK(run.packets_.back().session == run.packets_.front().session);
  CHECK(run.packets_.back().recorded);
  // The time of the pause is not lateness.
  CHECK(run.last_counter("late_us").value() < 200'000);
  // Sensor time 0 moves by the pause, which lasted 3 STATUS at least.
  CHECK(run.packets_.back().sensor_zero_utime - run.packets_.front().sensor_zero_utime > 250'000);
  CHECK(run.last_counter("controls_obeyed") == 2);
  CHECK(run.last_counter("controls_refused") == std::nullopt);
}

TEST_CASE("a step of a paused recording publishes one packet") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(3000, 0, 100));
  CameraRun run(recording_settings(folder / "a.raw", "paused = true\nquiet_flush_us = 500\n"));
  std::vector<std::size_t> packets;
  run.on_status_ = [&](const service_status_t& status) {
    if (!is_paused(status)) return;
    packets.push_back(run.packets_.size());
    if (packets.size() < 5) return run.control(Control::MODE_STEP);
    run.stop_.request_stop();
  };
  run.run();
  REQUIRE(packets.size() >= 5);
  // STATUS may be published before or after the step that it caused.
  CHECK(packets[0] == 0);
  CHECK(packets[4] >= 3);
  CHECK(packets[4] <= 4);
  CHECK(run.events_ == part(even_events(3000, 0, 100), 0, run.events_.back().t_us + 1));
}

TEST_CASE("a step of sensor time plays the events of this time, then pauses") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(3000, 0, 100));
  CameraRun run(recording_settings(folder / "a.raw", "paused = true\nquiet_flush_us = 500\n"));
  bool has_stepped = false;
  run.on_status_ = [&](const service_status_t& status) {
    if (!is_paused(status)) return;
    if (!has_stepped) {
      has_stepped = true;
      run.control(Control::MODE_STEP, 20'000);
    } else if (test::counter(status, "position_us") == 20'000) {
      run.stop_.request_stop();
    }
  };
  run.run();
  REQUIRE(!run.events_.empty());
  CHECK(run.events_.back().t_us <= 20'000);
  CHECK(run.events_.back().t_us > 19'000);
}

TEST_CASE("a seek begins a new session behind a silence, with exactly the events from its place") {
  const CameraFolder folder;
  const auto events = even_events(20'000, 7'000'000, 20);  // 0.4 s.
  write_recording(folder / "a.raw", events);
  for (const std::int64_t sought_us : {50'010, 350'000}) {
    CAPTURE(sought_us);
    CameraRun run(recording_settings(folder / "a.raw"));
    run.stop_when_ = [&, told = false]() mutable {
      if (!told && run.events_.back().t_us > 7'100'000) {
        told = true;
        run.control(Control::MODE_SEEK, sought_us);
      }
      return false;
    };
    run.run();
    const std::int64_t first = run.packets_.front().session;
    const std::int64_t second = run.packets_.back().session;
    REQUIRE(first != second);
    CHECK(second == run.bus_.session());
    CHECK(session_events(run, second) == part(events, 7'000'000 + sought_us));
    const auto before = session_events(run, first);
    CHECK(before == part(events, 0, before.back().t_us + 1));

    const auto begin = std::find_if(run.packets_.begin(), run.packets_.end(),
                                    [&](const auto& packet) { return packet.session == second; });
    CHECK(begin->seq == 0);
    CHECK(begin->events_before == 0);
    CHECK(begin->recorded);
    // A receiver that follows the first session takes the second one.
    CHECK(begin->utime - (begin - 1)->utime > SinglePublisher::kSilentAfterUs);
    CHECK(run.packets_.back().events_before + run.packets_.back().count ==
          static_cast<std::int64_t>(session_events(run, second).size()));
    CHECK(run.last_counter("events_sent") == static_cast<std::int64_t>(run.events_.size()));
    CHECK(run.last_counter("control_verdict") == 0);
  }
}

TEST_CASE("a place beyond the end is refused, and the recording plays on without a loss") {
  const CameraFolder folder;
  const auto events = even_events(40'000, 0, 20);
  write_recording(folder / "a.raw", events);
  CameraRun run(recording_settings(folder / "a.raw"));
  run.stop_when_ = [&, told = 0]() mutable {
    if (run.events_.size() > 5000 && std::exchange(told, 1) == 0) {
      run.control(Control::MODE_SEEK, 3'600'000'000);
    }
    return false;
  };
  run.run();
  CHECK(run.events_ == events);
  CHECK(run.in_order_);
  CHECK(run.packets_.back().session == run.packets_.front().session);
  CHECK(run.last_counter("controls_obeyed") == std::nullopt);
  CHECK(run.last_counter("controls_refused") == 1);
  CHECK(run.last_counter("control_verdict") ==
        static_cast<std::int64_t>(ControlVerdict::kBeyondEnd));
  CHECK(contains(run.log_text_.str(), "refused: the recording, or the part that is played, ends"));
}

TEST_CASE("a log that has vanished refuses to go back with the reason, and plays on") {
  const CameraFolder folder;
  std::vector<SeenEvent> events;
  {
    EventLogWriter log(folder / "a.lcm", {64, 48}, "PUCK_EVENTS");
    for (int i = 0; i < 300; ++i) {
      log.write(numbered_events(1000 * i, 40));
      append_seen(numbered_events(1000 * i, 40), events);
    }
  }
  CameraRun run("[camera]\nsource = \"log\"\nfile = \"" + (folder / "a.lcm").string() + "\"\n");
  run.stop_when_ = [&, told = 0]() mutable {
    if (run.events_.size() > 4000 && std::exchange(told, 1) == 0) {
      std::filesystem::remove(folder / "a.lcm");
      run.control(Control::MODE_SEEK, 0);
    }
    return false;
  };
  run.run();
  CHECK(run.events_ == events);
  CHECK(run.packets_.back().session == run.packets_.front().session);
  CHECK(run.last_counter("control_verdict") ==
        static_cast<std::int64_t>(ControlVerdict::kUnreadable));
  CHECK(contains(run.log_text_.str(), "a.lcm: cannot be read: No such file or directory"));
}

TEST_CASE("a recording that was overwritten refuses to go back, and ends with the reason") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(30'000, 0, 10));
  CameraRun run(recording_settings(folder / "a.raw"));
  run.stop_when_ = [&, told = 0]() mutable {
    if (run.events_.size() > 10'000 && std::exchange(told, 1) == 0) {
      std::ofstream(folder / "a.raw") << "no events";
      run.control(Control::MODE_SEEK, 0);
    }
    return false;
  };
  CHECK_THROWS_WITH(run.run(), doctest::Contains("a.raw: "));
  CHECK(contains(run.log_text_.str(), "the recording cannot be read again"));
}

TEST_CASE("a place beyond the end of a pipe is refused, and what was read before is played") {
  const CameraFolder folder;
  const auto events = even_events(8000, 0, 50);  // One chunk.
  write_recording(folder / "a.raw", events);
  const std::filesystem::path pipe = folder / "pipe.raw";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  std::jthread sender([bytes = read_text(folder / "a.raw"), pipe] {
    std::ofstream(pipe, std::ios::binary) << bytes;
  });
  CameraRun run(recording_settings(pipe));
  run.stop_when_ = [&, told = 0]() mutable {
    if (std::exchange(told, 1) == 0) run.control(Control::MODE_SEEK, 60'000'000);
    return false;
  };
  run.run();
  CHECK(run.events_ == events);
  CHECK(run.packets_.back().session == run.packets_.front().session);
  CHECK(run.last_counter("control_verdict") ==
        static_cast<std::int64_t>(ControlVerdict::kBeyondEnd));
}

TEST_CASE("after its end a recording that waits can go back and is played again") {
  const CameraFolder folder;
  const auto events = even_events(2000, 0, 20);
  write_recording(folder / "a.raw", events);
  CameraRun run(recording_settings(folder / "a.raw", "at_end = \"wait\"\n"));
  int ended_statuses = 0;
  run.on_status_ = [&](const service_status_t& status) {
    if (is_paused(status)) run.stop_.request_stop();
    if (status.state_text != "the source has ended") return;
    CHECK(status.state == service_status_t::STATE_WAITING);
    if (run.events_.size() > events.size()) run.stop_.request_stop();
    // A pause does not hide the end.
    if (++ended_statuses == 1) run.control(Control::MODE_PAUSE);
    if (ended_statuses == 3) run.control(Control::MODE_RESUME);
    if (ended_statuses != 5) return;
    CHECK(run.events_ == events);
    run.control(Control::MODE_SEEK, 20'000);
  };
  run.run();
  CHECK(run.last_counter("controls_obeyed") == 3);
  CHECK(session_events(run, run.bus_.session()) == part(events, 20'000));
}

TEST_CASE("a pause hides no trouble in STATUS") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(30'000, 0, 10));
  CameraRun run(recording_settings(folder / "a.raw"));
  run.stop_when_ = [&, told = 0]() mutable {
    if (run.events_.size() > 3000 && std::exchange(told, 1) == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(150));
    }
    return false;
  };
  bool is_paused_in_trouble = false;
  run.on_status_ = [&](const service_status_t& status) {
    if (status.state == service_status_t::STATE_RUNNING) return;
    if (is_paused(status)) run.stop_.request_stop();  // The trouble is over.
    if (status.state != service_status_t::STATE_DEGRADED) return;
    CHECK(status.state_text.starts_with("cannot keep up with the sensor's clock; "));
    if (contains(status.state_text, "; paused at ")) is_paused_in_trouble = true;
    run.control(Control::MODE_PAUSE);
  };
  run.run();
  CHECK(is_paused_in_trouble);
}

TEST_CASE("another speed holds from its control on, and sensor time has no fixed zero then") {
  const CameraFolder folder;
  const auto events = even_events(20'000, 0, 1000);  // 20 s.
  write_recording(folder / "a.raw", events);
  CameraRun run(recording_settings(folder / "a.raw"));
  run.stop_when_ = [&, told = 0]() mutable {
    if (run.events_.size() > 100 && std::exchange(told, 1) == 0) {
      run.control(Control::MODE_SPEED, 0, 50);
    }
    return false;
  };
  run.run();
  CHECK(run.events_ == events);
  CHECK(run.packets_.front().sensor_zero_utime > 0);
  CHECK(run.packets_.back().sensor_zero_utime == 0);
  CHECK(run.packets_.back().utime - run.packets_.front().utime < 15'000'000);
}

TEST_CASE("controls that are absurd, foreign or too frequent are counted, and change nothing") {
  const CameraFolder folder;
  const auto events = even_events(30'000, 0, 10);
  write_recording(folder / "a.raw", events);
  CameraRun run(recording_settings(folder / "a.raw"));
  run.stop_when_ = [&, told = 0]() mutable {
    if (run.events_.size() < 3000 || std::exchange(told, 1) != 0) return false;
    run.control(Control::MODE_SPEED, 0, 0);  // Taken, and refused.
    for (int i = 0; i < 50; ++i) run.control(Control::MODE_PAUSE);
    camera_control_t other{};
    other.mode = Control::MODE_PAUSE;
    other.camera_session = run.bus_.session() + 1;
    other.request = 1000;
    CHECK(run.bus_.publish(other));
    camera_control_t repeat{};
    repeat.mode = Control::MODE_PAUSE;
    repeat.camera_session = run.bus_.session();
    CHECK(run.bus_.publish(repeat));
    // The bus itself refuses these.
    camera_control_t back{};
    back.mode = Control::MODE_SEEK;
    back.position_us = -1;
    CHECK_FALSE(run.bus_.publish(back));
    camera_control_t nan{};
    nan.mode = Control::MODE_SPEED;
    nan.speed = std::nan("");
    CHECK_FALSE(run.bus_.publish(nan));
    return false;
  };
  run.run();
  CHECK(run.events_ == events);
  CHECK(run.packets_.back().session == run.packets_.front().session);
  CHECK(run.last_counter("controls_refused") == 51);
  CHECK(run.last_counter("controls_for_others") == 1);
  CHECK(run.last_counter("controls_obeyed") == std::nullopt);
}

TEST_CASE("a source that may be live obeys no control, and counts it") {
  CameraRun simulated("");
  simulated.stop_when_ = [&, told = 0]() mutable {
    if (std::exchange(told, 1) == 0) simulated.control(Control::MODE_PAUSE);
    return false;
  };
  simulated.run(3000);
  CHECK(simulated.last_counter("controls_refused") == 1);
  CHECK(simulated.last_counter("control_verdict") ==
        static_cast<std::int64_t>(ControlVerdict::kNoRecording));

  const CameraFolder folder;
  const auto events = even_events(2000, 0, 10);
  write_recording(folder / "a.raw", events);
  const TcpServer server;
  CameraRun tcp("[camera]\nsource = \"tcp\"\ntcp_host = \"127.0.0.1\"\ntcp_port = " +
                std::to_string(server.port()) + "\n");
  std::jthread sender([&, bytes = read_text(folder / "a.raw")] { server.serve(bytes); });
  tcp.stop_when_ = [&, told = 0]() mutable {
    if (std::exchange(told, 1) == 0) tcp.control(Control::MODE_SEEK);
    return tcp.events_.size() == events.size() && tcp.last_counter("controls_refused") == 1;
  };
  tcp.on_status_ = [&](const service_status_t&) {
    if (tcp.stop_when_()) tcp.stop_.request_stop();
  };
  tcp.run();
  CHECK(tcp.events_ == events);
  CHECK_FALSE(tcp.packets_.back().recorded);
  CHECK(contains(tcp.log_text_.str(), "only a recording can be controlled"));
}

TEST_CASE("the part of a recording between camera.start_s and camera.seconds is played") {
  const CameraFolder folder;
  const auto events = even_events(40'000, 7'000'000, 20);
  write_recording(folder / "a.raw", events);
  CameraRun run(recording_settings(folder / "a.raw", "start_s = 0.3\nseconds = 0.2\n"));
  run.run();
  CHECK(run.events_ == part(events, 7'300'000, 7'500'000));

  CameraRun beyond(recording_settings(folder / "a.raw", "start_s = 5\n"));
  CHECK_THROWS_WITH(beyond.run(), doctest::Contains("nothing is left from 5.000 s on "
                                                    "(camera.start_s)"));
}

TEST_CASE("the closing line tells how late the packets were") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(5000, 0, 10));
  CameraRun run(recording_settings(folder / "a.raw"));
  run.run();
  CHECK(contains(run.log_text_.str(), "the source has ended after 5000 events; " +
                                          std::to_string(run.packets_.size()) +
                                          " packets, behind their schedule by "));
  const auto& names = run.statuses_.back().latency_name;
  const auto place = std::find(names.begin(), names.end(), "behind_schedule") - names.begin();
  REQUIRE(place < std::ssize(names));
  CHECK(run.statuses_.back().latency_samples[static_cast<std::size_t>(place)] ==
        static_cast<std::int64_t>(run.packets_.size()));
}

}  // namespace
}  // namespace puck
