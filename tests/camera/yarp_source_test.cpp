#include "services/camera/yarp_source.h"

#include <chrono>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include "common/io/event_reader.h"
#include "tests/camera/camera_fixtures.h"
#include "tests/camera/camera_run.h"
#include "tests/support/contains.h"
#include "tests/support/test_board_bytes.h"
#include "tests/support/test_event_port.h"
#include "tests/support/wait_until.h"
#include "tests/support/yarp_bottle_encoder.h"
#include "tests/support/yarp_log_encoder.h"

namespace puck {
namespace {

constexpr SensorSize kEye{304, 240};
constexpr int kPacketsInLog = 120;

std::string camera_log(YarpEncoding encoding) {
  YarpLogEncoder encoder(encoding, {0});
  for (int i = 0; i < kPacketsInLog; ++i) {
    EventPacket packet;
    packet.start = {i * 1000};
    for (std::uint32_t k = 0; k < 50; ++k) {
      Event event;
      event.x = static_cast<std::uint16_t>((static_cast<std::uint32_t>(i) * 7 + k) % 304);
      event.y = (k * 4) & 0x7fff;
      event.polarity = k % 2;
      event.offset_us = k * 20;
      packet.events.push_back(event);
    }
    encoder.add(packet, 1000);
  }
  return encoder.text();
}

std::vector<SeenEvent> events_of_log(const std::string& log) {
  const CameraFolder folder;
  std::ofstream(folder / "data.log", std::ios::binary) << log;
  const auto reader = open_event_file(folder / "data.log", {.sensor = kEye});
  std::vector<SeenEvent> events;
  EventPacket packet;
  while (reader->read(packet, 1000)) append_seen(packet, events);
  return events;
}

void play_log(TestEventPort& camera, const std::string& log) {
  for (const WireBottle& bottle : wire_bottle::of_log(log)) {
    camera.send(carrier_message({stamp_block(bottle.count, bottle.time_s), bottle.bytes}));
  }
}

PortReaderParams reading(const TestEventPort& camera) {
  return {.port = "/atis3/AE:o", .server_port = camera.name_server(), .retry_ms = 10};
}

EventFileOptions eye_options() { return {.sensor = kEye, .reorder_us = 0}; }

/// Reads until `is_done`, for up to 20 s.
template <typename Condition>
void take_until(EventSource& source, std::vector<SeenEvent>& events, const Condition& is_done) {
  EventSource::Chunk chunk;
  CHECK(wait_until([&] {
    while (source.next(chunk) == EventSource::Outcome::kEvents) append_seen(chunk.packet, events);
    return is_done();
  }));
}

}  // namespace

TEST_CASE("a camera's port gives the events of a log of its messages, in each form") {
  for (const YarpEncoding encoding :
       {YarpEncoding::kList, YarpEncoding::kStamped, YarpEncoding::kPlain}) {
    CAPTURE(static_cast<int>(encoding));
    const std::string log = camera_log(encoding);
    const auto expected = events_of_log(log);
    CHECK(expected.size() == 50 * kPacketsInLog);
    TestEventPort camera("/atis3/AE:o");
    YarpSource source(reading(camera), eye_options());
    CHECK(source.sensor_size() == kEye);
    std::vector<SeenEvent> events;
    take_until(source, events, [&] { return camera.readers() == 1; });
    play_log(camera, log);
    take_until(source, events, [&] { return source.port_counts()->messages == kPacketsInLog; });
    // The last event waits for its successor.
    CHECK(events.size() + 50 >= expected.size());
    camera.die();
    take_until(source, events, [&] { return events.size() == expected.size(); });
    CHECK(events == expected);
    CHECK(source.events_dropped() == 0);
    CHECK(source.malformed_words() == 0);
  }
}

TEST_CASE("a camera that is started again continues in time, with a new clock") {
  const std::string log = camera_log(YarpEncoding::kStamped);
  const auto once = events_of_log(log);
  TestEventPort camera("/atis3/AE:o");
  YarpSource source(reading(camera), eye_options());
  std::vector<SeenEvent> events;
  for (std::size_t run = 1; run <= 2; ++run) {
    take_until(source, events, [&] { return camera.readers() == 1; });
    play_log(camera, log);
    camera.die();
    EventSource::Chunk chunk;
    while (source.next(chunk) != EventSource::Outcome::kEvents) continue;
    CHECK(chunk.new_clock);
    append_seen(chunk.packet, events);
    while (source.next(chunk) != EventSource::Outcome::kEvents) continue;
    CHECK_FALSE(chunk.new_clock);
    append_seen(chunk.packet, events);
    take_until(source, events, [&] { return events.size() == run * once.size(); });
    camera.revive();
  }
  REQUIRE(events.size() == 2 * once.size());
  const std::int64_t shift_us = once.back().t_us + 1;
  for (std::size_t i = 0; i < once.size(); ++i) {
    SeenEvent again = once[i];
    again.t_us += shift_us;
    REQUIRE(events[once.size() + i] == again);
  }
}

TEST_CASE("messages that are lost or hold no events are counted, and the rest is read") {
  TestEventPort camera("/atis3/AE:o");
  YarpSource source(reading(camera), eye_options());
  std::vector<SeenEvent> events;
  take_until(source, events, [&] { return camera.readers() == 1; });
  const auto bottles = wire_bottle::of_log(camera_log(YarpEncoding::kStamped));
  for (std::size_t i = 0; i < bottles.size(); ++i) {
    if (i == 50 || i == 51) continue;
    const std::string block = stamp_block(bottles[i].count, bottles[i].time_s);
    camera.send(carrier_message({block, i == 60 ? "no bottle at all" : bottles[i].bytes}));
  }
  camera.die();
  take_until(source, events, [&] { return events.size() == 50 * (kPacketsInLog - 3); });
  CHECK(source.port_counts()->lost == 2);
  CHECK(source.port_counts()->malformed == 1);
  CHECK(source.port_counts()->connections == 1);
}

TEST_CASE("a camera that sends little is read after a second") {
  TestEventPort camera("/atis3/AE:o");
  YarpSource source(reading(camera), eye_options());
  std::vector<SeenEvent> events;
  take_until(source, events, [&] { return camera.readers() == 1; });
  const auto bottles = wire_bottle::of_log(camera_log(YarpEncoding::kStamped));
  for (std::size_t i = 0; i < 3; ++i) {
    camera.send(
        carrier_message({stamp_block(bottles[i].count, bottles[i].time_s), bottles[i].bytes}));
  }
  take_until(source, events, [&] { return events.size() >= 149; });
}

TEST_CASE("the service publishes a YARP camera's events, and its counts in STATUS") {
  const std::string log = camera_log(YarpEncoding::kStamped);
  auto expected = events_of_log(log);
  TestEventPort camera("/atis3/AE:o");
  std::jthread player([&](const std::stop_token& stop) {
    while (!stop.stop_requested() && camera.readers() == 0) std::this_thread::yield();
    play_log(camera, log);
  });
  CameraRun run("[camera]\nsource = \"yarp\"\nwidth = 304\nheight = 240\nyarp_server_port = " +
                std::to_string(camera.name_server()) + "\n");
  run.run(expected.size() - 1);
  expected.pop_back();
  CHECK(run.events_ == expected);
  CHECK(run.packets_.front().recorded == 0);
  CHECK(run.last_counter("port_messages") == kPacketsInLog);
  CHECK(run.last_counter("port_messages_lost") == 0);
  CHECK(run.last_counter("port_messages_malformed") == 0);
  CHECK(run.last_counter("port_connections") == 1);
}

TEST_CASE("a missing name server is said in one line, and a stop ends the wait for it") {
  int port = 0;
  {
    const TestEventPort gone("/atis3/AE:o");
    port = gone.name_server();
  }
  CameraRun run("[camera]\nsource = \"yarp\"\nwidth = 304\nheight = 240\nyarp_server_port = " +
                std::to_string(port) + "\n");
  std::jthread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    run.stop_.request_stop();
  });
  run.run();
  const std::string log = run.log_text_.str();
  const std::string line =
      "for a connection to /atis3/AE:o: the name server: cannot connect to "
      "127.0.0.1:" +
      std::to_string(port) + ": Connection refused";
  CAPTURE(log);
  const std::size_t first = log.find(line);
  CHECK(first != std::string::npos);
  CHECK(log.find(line, first + 1) == std::string::npos);
  CHECK(*run.last_counter("port_failures") >= 2);
}

TEST_CASE("settings that do not fit a YARP port are refused with their key") {
  const auto refusal = [](const std::string& more) {
    Config config = Config::from_text("[camera]\nsource = \"yarp\"\n" + more, "camera.toml");
    try {
      read_camera_settings(config);
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string size = "width = 304\nheight = 240\n";
  CHECK(refusal(size).empty());
  CHECK(contains(refusal("width = 304\n"), "camera.width and camera.height must be set"));
  CHECK(contains(refusal(size + "pace = \"sensor\"\n"), "camera.pace cannot be \"sensor\""));
  CHECK(contains(refusal(size + "yarp_port = \"AE:o\"\n"), "camera.yarp_port must be the name"));
  CHECK(contains(refusal(size + "yarp_port = \"/a b\"\n"), "camera.yarp_port must be the name"));
}

}  // namespace puck
