#include <array>
#include <cmath>
#include <fstream>
#include <iterator>

#include <doctest/doctest.h>
#include <unistd.h>

#include "common/io/event_reader.h"
#include "services/camera/file_source.h"
#include "services/camera/simulated_source.h"
#include "services/camera/stream_source.h"
#include "services/camera/tcp_source.h"
#include "tests/camera/camera_fixtures.h"
#include "tests/camera/tcp_server.h"

namespace puck {
namespace {

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<SeenEvent> take(EventSource& source, std::size_t count) {
  std::vector<SeenEvent> events;
  EventSource::Chunk chunk;
  while (events.size() < count) {
    const auto outcome = source.next(chunk);
    if (outcome == EventSource::Outcome::kEnd) break;
    if (outcome == EventSource::Outcome::kEvents) append_seen(chunk.packet, events);
  }
  return events;
}

TEST_CASE("a recording is delivered whole and unchanged, and ends") {
  const CameraFolder folder;
  const auto expected = even_events(20000, 43'499'029, 7);
  write_recording(folder / "a.raw", expected);
  FileSource source({.file = folder / "a.raw"});
  CHECK(source.sensor_size() == SensorSize{64, 48});
  CHECK(take(source, 1'000'000) == expected);
  EventSource::Chunk chunk;
  CHECK(source.next(chunk) == EventSource::Outcome::kEnd);
}

TEST_CASE("a looped recording continues with increasing times, at its own pace") {
  const CameraFolder folder;
  const auto once = even_events(1000, 5000, 10);
  write_recording(folder / "a.raw", once);
  FileSource source({.file = folder / "a.raw", .loop = true});
  const auto events = take(source, 2500);
  REQUIRE(events.size() >= 2500);
  for (std::size_t i = 0; i < 2500; ++i) {
    const SeenEvent& expected = once[i % 1000];
    REQUIRE(events[i].x == expected.x);
    // A mean gap lies between two rounds: 9990 µs of 1000 events, rounded.
    REQUIRE(events[i].t_us == 5000 + static_cast<std::int64_t>(i) * 10);
  }
}

TEST_CASE("a recording is stretched to a mean rate in its order") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(10001, 5000, 10));  // 0.1 Mev/s
  for (const double rate_mev_s : {0.01, 0.4, 2.0}) {
    CAPTURE(rate_mev_s);
    FileSource source({.file = folder / "a.raw", .rate_mev_s = rate_mev_s});
    const auto events = take(source, 1'000'000);
    REQUIRE(events.size() == 10001);
    CHECK(events.front().t_us == 5000);
    const double span_s = static_cast<double>(events.back().t_us - events.front().t_us) * 1e-6;
    CHECK(span_s == doctest::Approx(10001 / (rate_mev_s * 1e6)).epsilon(1e-3));
    for (std::size_t i = 1; i < events.size(); ++i) {
      REQUIRE(events[i].t_us >= events[i - 1].t_us);
    }
  }
}

TEST_CASE("missing recordings and recordings too short for a loop are refused") {
  const CameraFolder folder;
  write_recording(folder / "one.raw", even_events(1, 0, 1));
  CHECK_THROWS_AS(FileSource({.file = folder / "one.raw", .loop = true}), EventFileError);
  CHECK_NOTHROW(FileSource({.file = folder / "one.raw"}));
  CHECK_THROWS_AS(FileSource({.file = folder / "none.raw"}), EventFileError);
}

TEST_CASE("a byte stream gives the same events in any pieces, and ends when it is closed") {
  const CameraFolder folder;
  const auto expected = even_events(2000, 100, 10);
  write_recording(folder / "a.raw", expected);
  const std::string bytes = content_of(folder / "a.raw");
  std::array<int, 2> ends{};
  REQUIRE(pipe(ends.data()) == 0);
  DescriptorEvents stream(ends[0], "pipe", {});

  std::vector<SeenEvent> events;
  EventPacket packet;
  const auto drain = [&] {
    DescriptorEvents::Outcome outcome{};
    while ((outcome = stream.next(packet)) == DescriptorEvents::Outcome::kEvents) {
      append_seen(packet, events);
    }
    return outcome;
  };
  CHECK(drain() == DescriptorEvents::Outcome::kNothingYet);
  for (std::size_t i = 0; i < bytes.size(); i += 777) {
    const std::string piece = bytes.substr(i, 777);
    REQUIRE(write(ends[1], piece.data(), piece.size()) == static_cast<ssize_t>(piece.size()));
    CHECK(drain() == DescriptorEvents::Outcome::kNothingYet);
  }
  close(ends[1]);
  CHECK(drain() == DescriptorEvents::Outcome::kEnd);
  close(ends[0]);
  CHECK(events == expected);
}

TEST_CASE("a byte stream that is no recording is refused") {
  std::array<int, 2> ends{};
  REQUIRE(pipe(ends.data()) == 0);
  REQUIRE(write(ends[1], "GET / HTTP/1.1\r\n", 16) == 16);
  DescriptorEvents stream(ends[0], "pipe", {});
  EventPacket packet;
  CHECK_THROWS_AS(stream.next(packet), EventFileError);
  close(ends[0]);
  close(ends[1]);
}

TEST_CASE("a TCP source reconnects after a break, a refusal and garbage, and time continues") {
  const CameraFolder folder;
  const auto once = even_events(100, 1000, 10);
  write_recording(folder / "a.raw", once);
  const std::string bytes = content_of(folder / "a.raw");

  const TcpServer server;
  TcpSource source(connect_to_server("127.0.0.1", server.port()), {});
  EventSource::Chunk chunk;
  CHECK(source.next(chunk) == EventSource::Outcome::kNothingYet);
  CHECK(source.waiting_for().find("127.0.0.1:") != std::string::npos);

  REQUIRE(server.serve(bytes));
  EventSource::Chunk first;
  while (source.next(first) != EventSource::Outcome::kEvents) continue;
  CHECK(first.new_clock);
  std::vector<SeenEvent> events;
  append_seen(first.packet, events);
  for (const SeenEvent& event : take(source, 100 - events.size())) events.push_back(event);
  CHECK(events == once);
  while (source.disconnections() < 1) source.next(chunk);
  while (source.waiting_for().find("events from") == std::string::npos) source.next(chunk);

  REQUIRE(server.serve("rubbish, longer than a header line may ever be? no: just not one\n"));
  while (source.disconnections() < 2) source.next(chunk);
  CHECK(source.waiting_for().find("neither a header of a known format nor text") !=
        std::string::npos);
  while (source.waiting_for().find("events from") == std::string::npos) source.next(chunk);

  REQUIRE(server.serve(bytes));
  events = take(source, 100);
  REQUIRE(events.size() == 100);
  CHECK(events.front().t_us == once.back().t_us + 1);
  CHECK(events.back().t_us - events.front().t_us == 990);
}

TEST_CASE("a later connection's clock is reported as new with its first events only") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(20000, 1000, 10));
  const std::string bytes = content_of(folder / "a.raw");
  const TcpServer server;
  TcpSource source(connect_to_server("127.0.0.1", server.port()), {});
  EventSource::Chunk chunk;
  for (int connection = 0; connection < 2; ++connection) {
    while (source.waiting_for().find("events from") == std::string::npos) source.next(chunk);
    REQUIRE(server.serve(bytes));
    while (source.next(chunk) != EventSource::Outcome::kEvents) continue;
    CHECK(chunk.new_clock);
    while (source.next(chunk) != EventSource::Outcome::kEvents) continue;
    CHECK_FALSE(chunk.new_clock);
    while (source.disconnections() <= connection) source.next(chunk);
  }
}

TEST_CASE("an unknown host is refused at the start") {
  CHECK_THROWS_WITH(connect_to_server("no such host", 1),
                    doctest::Contains("camera.tcp_host \"no such host\" cannot be found"));
}

TEST_CASE("the simulated table gives its truth before each millisecond of events") {
  std::vector<std::int64_t> truths_us;
  SimulatedSource source({}, 1000,
                         [&](const SimulatedTruth& truth) { truths_us.push_back(truth.time.us); });
  EventSource::Chunk chunk;
  for (int i = 0; i < 10; ++i) CHECK(source.next(chunk) == EventSource::Outcome::kEvents);
  CHECK(chunk.until.us == 5000);
  CHECK(truths_us == std::vector<std::int64_t>{0, 1000, 2000, 3000, 4000});
}

TEST_CASE("the simulated robot's mallet follows the arm") {
  double mallet_y_m = 0;
  SimulatedSource source({}, 1000,
                         [&](const SimulatedTruth& truth) { mallet_y_m = truth.robot_mallet.y_m; });
  EventSource::Chunk chunk;
  source.next(chunk);
  source.set_robot_mallet(0.2);
  for (int i = 0; i < 200; ++i) source.next(chunk);
  CHECK(mallet_y_m == doctest::Approx(0.2).epsilon(0.01));
}

}  // namespace
}  // namespace puck
