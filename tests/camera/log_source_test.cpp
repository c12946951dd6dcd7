// camera.source = "log": the events of a log, as a recording.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <utility>

#include <doctest/doctest.h>

#include "common/messaging/log_file.h"
#include "common/messages/single_publisher.h"
#include "common/recording/event_log_reader.h"
#include "services/camera/file_source.h"
#include "tests/camera/camera_fixtures.h"
#include "tests/camera/camera_run.h"
#include "tests/support/event_log_writer.h"
#include "tests/support/temporary_folder.h"

namespace puck {
namespace {

constexpr SensorSize kSensor{64, 48};
constexpr auto kJoined = EventLog::Sessions::kJoined;

std::vector<SeenEvent> seen(const std::vector<EventPacket>& packets) {
  std::vector<SeenEvent> events;
  for (const EventPacket& packet : packets) append_seen(packet, events);
  return events;
}

std::vector<EventPacket> hundred_packets() {
  std::vector<EventPacket> packets;
  for (int i = 0; i < 100; ++i) packets.push_back(numbered_events(5'000'000 + 1000 * i, 40));
  return packets;
}

void write_log(const std::filesystem::path& path, const std::vector<EventPacket>& packets,
               const std::string& channel = "PUCK_EVENTS") {
  EventLogWriter writer(path, kSensor, channel);
  for (const EventPacket& packet : packets) writer.write(packet);
}

std::string log_settings(const std::filesystem::path& path, const std::string& more = "") {
  return "[camera]\nsource = \"log\"\nfile = \"" + path.string() + "\"\n" + more;
}

TEST_CASE("a log is played whole, at its sensor times, as a session of this camera") {
  const CameraFolder folder;
  write_log(folder / "a.lcm", hundred_packets());
  CameraRun run(log_settings(folder / "a.lcm"));
  run.run();
  CHECK(run.events_ == seen(hundred_packets()));
  CHECK(run.in_order_);
  for (std::size_t i = 0; i < run.packets_.size(); ++i) {
    REQUIRE(run.packets_[i].session == run.bus_.session());
    REQUIRE(run.packets_[i].seq == static_cast<std::int64_t>(i));
  }
  // Its sensor's zero is a time of this host; on the recording host it was near 0.
  CHECK(run.packets_.back().sensor_zero_utime > 1'000'000'000'000'000);
  CHECK(run.last_counter("events_sent") == 4000);
  CHECK(run.last_counter("events_dropped") == 0);
  CHECK(run.log_text_.str().find("warning") == std::string::npos);
}

TEST_CASE("missing packets in a log are counted as dropped, in EVENTS too, and reported") {
  const CameraFolder folder;
  {
    EventLogWriter writer(folder / "a.lcm", kSensor);
    writer.write(numbered_events(1000, 40));
    writer.lose(numbered_events(10'000, 25));
    writer.write(numbered_events(20'000, 40));
  }
  CameraRun run(log_settings(folder / "a.lcm"));
  run.run();
  CHECK(run.events_.size() == 80);
  CHECK(run.packets_.back().events_dropped == 25);
  CHECK(run.last_counter("events_dropped") == 25);
  CHECK(run.log_text_.str().find("1 packets of events missing") != std::string::npos);
}

TEST_CASE("the intact part of a damaged log is played, and the skipped part is reported") {
  const CameraFolder folder;
  write_log(folder / "a.lcm", hundred_packets());
  std::filesystem::resize_file(folder / "a.lcm", std::filesystem::file_size(folder / "a.lcm") - 10);
  CameraRun run(log_settings(folder / "a.lcm"));
  run.run();
  CHECK(run.events_.size() == 99 * 40);
  CHECK(run.log_text_.str().find("the log ends within a message at byte") != std::string::npos);
}

TEST_CASE("a log of another prefix plays with that prefix only") {
  const CameraFolder folder;
  write_log(folder / "a.lcm", hundred_packets(), "LEFT_PUCK_EVENTS");
  CHECK_THROWS_AS(CameraRun(log_settings(folder / "a.lcm")).run(), LogFileError);
  CameraRun run(log_settings(folder / "a.lcm", "log_prefix = \"LEFT\"\n"));
  run.run();
  CHECK(run.events_.size() == 4000);
}

TEST_CASE("a log can be looped and stretched like a recording") {
  const CameraFolder folder;
  write_log(folder / "a.lcm", {numbered_events(1000, 1000)});
  FileSource looped({.file = folder / "a.lcm", .loop = true},
                    open_event_log(folder / "a.lcm", "", kJoined));
  EventSource::Chunk chunk;
  std::vector<SeenEvent> events;
  while (events.size() < 2500) {
    REQUIRE(looped.next(chunk) == EventSource::Outcome::kEvents);
    append_seen(chunk.packet, events);
  }
  for (std::size_t i = 0; i < 2500; ++i) {
    REQUIRE(events[i].t_us == 1000 + static_cast<std::int64_t>(i) * 10);
  }
  FileSource slow({.file = folder / "a.lcm", .rate_mev_s = 0.01},
                  open_event_log(folder / "a.lcm", "", kJoined));
  events.clear();
  while (slow.next(chunk) == EventSource::Outcome::kEvents) append_seen(chunk.packet, events);
  REQUIRE(events.size() == 1000);
  CHECK(events.back().t_us - events.front().t_us == doctest::Approx(100'000).epsilon(0.01));
}

TEST_CASE("two joined logs are played in order, as two sessions, whenever they were recorded") {
  const CameraFolder folder;
  const auto write_session = [&](const std::string& name, std::int64_t session,
                                 std::int64_t later_us) {
    EventLogWriter writer(folder / name, kSensor);
    writer.begin_session(session, later_us);
    for (int i = 0; i < 20; ++i) writer.write(numbered_events(5'000'000 + 1000 * i, 40));
    writer.flush();
  };
  constexpr std::int64_t kDayUs = 86'400'000'000;
  write_session("a.lcm", 5, 2 * kDayUs);
  for (const auto& [session, later_us] : std::vector<std::pair<std::int64_t, std::int64_t>>{
           {6, 4 * kDayUs}, {6, kDayUs}, {5, 2 * kDayUs}}) {
    write_session("b.lcm", session, later_us);
    std::ofstream(folder / "ab.lcm", std::ios::binary)
        << read_text(folder / "a.lcm") << read_text(folder / "b.lcm");
    std::filesystem::remove(folder / "b.lcm");
    CameraRun run(log_settings(folder / "ab.lcm"));
    run.run();
    CHECK(run.events_.size() == 1600);
    const std::int64_t first = run.packets_.front().session;
    const auto joint = std::find_if(run.packets_.begin(), run.packets_.end(),
                                    [&](const auto& packet) { return packet.session != first; });
    REQUIRE(joint != run.packets_.end());
    CHECK(joint->seq == 0);
    CHECK(joint->events_before == 0);
    CHECK(joint->utime - (joint - 1)->utime > SinglePublisher::kSilentAfterUs);
    CHECK(run.packets_.back().session == joint->session);
    CHECK(run.packets_.back().events_before + run.packets_.back().count == 800);
    for (std::size_t i = 0; i < 800; ++i) {
      REQUIRE(run.events_[800 + i].x == run.events_[i].x);
      REQUIRE(run.events_[800 + i].t_us - run.events_[800].t_us ==
              run.events_[i].t_us - run.events_[0].t_us);
    }
    CHECK(run.last_counter("events_dropped") == 0);
  }
}

TEST_CASE("the next file of a logger's run continues its session") {
  const CameraFolder folder;
  EventLogWriter whole(folder / "whole.lcm", kSensor);
  for (int i = 0; i < 40; ++i) whole.write(numbered_events(5'000'000 + 1000 * i, 40));
  whole.flush();
  // As puck-logger does: each file counts its messages from 0.
  LogReader reader(folder / "whole.lcm");
  LogRecord record;
  for (const char* name : {"1.lcm", "2.lcm"}) {
    LogWriter writer(folder / name);
    for (int i = 0; i < 20 && reader.next(record); ++i) {
      writer.write(record.channel, record.utime, record.bytes);
    }
  }
  std::ofstream(folder / "both.lcm", std::ios::binary)
      << read_text(folder / "1.lcm") << read_text(folder / "2.lcm");
  CameraRun run(log_settings(folder / "both.lcm"));
  run.run();
  CHECK(run.events_.size() == 1600);
  CHECK(run.packets_.back().session == run.packets_.front().session);
  CHECK(run.events_.back().t_us == 5'039'000 + 390);
}

TEST_CASE("files that are no log, and logs without a name, are refused") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(10, 0, 1));
  CHECK_THROWS_WITH_AS(open_event_log(folder / "a.raw", "", kJoined),
                       doctest::Contains("is not an LCM log"), LogFileError);
  CHECK_THROWS_WITH(
      CameraRun("[camera]\nsource = \"log\"\n"),
      doctest::Contains("camera.file must name a recording when camera.source is \"log\""));
}

}  // namespace
}  // namespace puck
