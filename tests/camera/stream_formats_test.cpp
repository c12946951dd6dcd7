// Each format that is a stream, from a pipe, a TCP server and a TCP client.
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <doctest/doctest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "common/io/event_reader.h"
#include "services/camera/stream_source.h"
#include "services/camera/tcp_source.h"
#include "tests/camera/camera_fixtures.h"
#include "tests/camera/tcp_server.h"
#include "tests/support/child_process.h"
#include "tests/support/contains.h"
#include "tests/support/environment.h"
#include "tests/support/wait_until.h"

namespace puck {
namespace {

constexpr SensorSize kStreamSensor{64, 48};

struct StreamSample {
  std::string name;
  std::string bytes;
  EventFileOptions options;
  std::vector<SeenEvent> events;  // As read from a file.
};

void append_word32(std::string& bytes, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift & 0xff);
}

// No header, as the words of a camera's driver.
std::string evt4_words() {
  std::string bytes;
  for (std::uint32_t high = 0; high < 50; ++high) {
    append_word32(bytes, 0xe0000000U | high);
    for (std::uint32_t low = 0; low < 64; ++low) {
      append_word32(bytes, (low % 2 == 0 ? 0xaU : 0xbU) << 28 | low << 22 | low << 11 | high % 48);
    }
  }
  return bytes;
}

std::string aedat2_records() {
  std::string bytes = "#!AER-DAT2.0\r\n# AEChip: DVS128\r\n";
  const auto append_big_endian = [&](std::uint32_t word) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(word >> shift & 0xff);
  };
  for (std::uint32_t i = 0; i < 3000; ++i) {
    append_big_endian(i % 128 << 8 | (i * 3) % 128 << 1 | (i & 1));
    append_big_endian(1000 + 5 * i);
  }
  return bytes;
}

StreamSample sample_of(const std::string& name, const std::string& bytes,
                       const EventFileOptions& options) {
  StreamSample sample{name, bytes, options, {}};
  const CameraFolder folder;
  const auto path = folder / (name == "text" || name == "csv" ? "a.txt" : "a.raw");
  std::ofstream(path, std::ios::binary) << bytes;
  const auto reader = open_event_file(path, options);
  EventPacket packet;
  while (reader->read(packet, 1000)) append_seen(packet, sample.events);
  return sample;
}

std::vector<StreamSample> stream_samples() {
  std::vector<StreamSample> samples;
  const CameraFolder folder;
  for (const std::string format : {"evt2", "evt21", "evt3", "dat", "es", "csv", "text"}) {
    const auto path = folder / format;
    const auto writer = make_event_writer(path, format, kStreamSensor);
    EventPacket packet;
    packet.start = {1000};
    for (std::uint32_t i = 0; i < 3000; ++i) {
      Event event;
      event.x = static_cast<std::uint16_t>(i % 64);
      event.y = (i % 48) & 0x7fff;
      event.polarity = i % 2;
      event.offset_us = 7 * i;
      packet.events.push_back(event);
    }
    writer->write(packet);
    writer->close();
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    samples.push_back(sample_of(format, bytes, {.sensor = kStreamSensor, .text_unit = "us"}));
  }
  samples.push_back(sample_of("evt4", evt4_words(), {.from = "evt4", .sensor = kStreamSensor}));
  samples.push_back(sample_of("aedat2", aedat2_records(), {}));
  return samples;
}

bool send_all(int socket, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

/// Connects to a port of this machine and sends bytes.
class TcpClient {
 public:
  explicit TcpClient(int port) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    is_connected_ = connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  }
  ~TcpClient() { close(socket_); }
  TcpClient(const TcpClient&) = delete;
  TcpClient& operator=(const TcpClient&) = delete;

  bool send(std::string_view bytes) const { return is_connected_ && send_all(socket_, bytes); }

 private:
  int socket_;
  bool is_connected_ = false;
};

/// The port of a source that listens, from what it waits for.
int port_of(const EventSource& source) {
  const std::string text = source.waiting_for();
  return std::stoi(text.substr(text.rfind(':') + 1));
}

/// The events until `count` have come or 20 s are over.
std::vector<SeenEvent> take_events(EventSource& source, std::size_t count) {
  std::vector<SeenEvent> events;
  EventSource::Chunk chunk;
  CHECK(wait_until([&] {
    while (source.next(chunk) == EventSource::Outcome::kEvents) append_seen(chunk.packet, events);
    return events.size() >= count;
  }));
  return events;
}

std::vector<SeenEvent> events_from_pipe(const StreamSample& sample) {
  std::array<int, 2> ends{};
  REQUIRE(pipe(ends.data()) == 0);
  std::jthread writer([&] {
    for (std::size_t at = 0; at < sample.bytes.size();) {
      const ssize_t written = write(ends[1], sample.bytes.data() + at, sample.bytes.size() - at);
      if (written <= 0) break;
      at += static_cast<std::size_t>(written);
    }
    close(ends[1]);
  });
  DescriptorEvents stream(ends[0], "pipe", sample.options);
  std::vector<SeenEvent> events;
  EventPacket packet;
  DescriptorEvents::Outcome outcome{};
  while ((outcome = stream.next(packet)) != DescriptorEvents::Outcome::kEnd) {
    if (outcome == DescriptorEvents::Outcome::kEvents) append_seen(packet, events);
  }
  close(ends[0]);
  return events;
}

}  // namespace

TEST_CASE("each format that is a stream gives a file's events from a pipe and both ends of TCP") {
  for (const StreamSample& sample : stream_samples()) {
    CAPTURE(sample.name);
    CHECK(sample.events.size() >= 3000);
    CHECK(events_from_pipe(sample) == sample.events);

    const TcpServer server;
    TcpSource client(connect_to_server("127.0.0.1", server.port()), sample.options);
    std::jthread serving([&] { CHECK(server.serve(sample.bytes)); });
    CHECK(take_events(client, sample.events.size()) == sample.events);

    TcpSource listener(listen_for_clients("127.0.0.1", 0), sample.options);
    std::jthread sending([&, port = port_of(listener)] {
      const TcpClient camera(port);
      CHECK(camera.send(sample.bytes));
    });
    CHECK(take_events(listener, sample.events.size()) == sample.events);
  }
}

TEST_CASE("a TCP server takes one client after the other, and garbage ends one of them only") {
  const std::vector<StreamSample> samples = stream_samples();
  const StreamSample& sample = samples[2];  // EVT3.
  TcpSource source(listen_for_clients("127.0.0.1", 0), sample.options);
  const int port = port_of(source);
  EventSource::Chunk chunk;
  CHECK(source.next(chunk) == EventSource::Outcome::kNothingYet);
  CHECK(contains(source.waiting_for(), "a client of 127.0.0.1:"));
  auto first = std::make_optional<TcpClient>(port);
  auto second = std::make_optional<TcpClient>(port);
  CHECK(first->send("neither a header nor words, whatever a format may be\n"));
  CHECK(second->send(sample.bytes));
  while (!contains(source.waiting_for(), "events from")) source.next(chunk);
  first.reset();
  // The last events wait for the next time word or the end.
  second.reset();
  CHECK(take_events(source, sample.events.size()) == sample.events);
  CHECK(source.disconnections() == 2);

  auto third = std::make_optional<TcpClient>(port);
  CHECK(third->send(sample.bytes));
  third.reset();
  const auto again = take_events(source, sample.events.size());
  CHECK(source.disconnections() == 3);
  REQUIRE(again.size() == sample.events.size());
  CHECK(again.front().t_us == sample.events.back().t_us + 1);
}

TEST_CASE("a TCP server's address that is taken or not of this machine is refused") {
  const TcpServer other;
  CHECK_THROWS_WITH_AS(listen_for_clients("127.0.0.1", other.port()),
                       doctest::Contains("cannot listen at 127.0.0.1:"), std::runtime_error);
  CHECK_THROWS_AS(listen_for_clients("192.0.2.1", 0), std::runtime_error);
  CHECK_THROWS_WITH(listen_for_clients("no such host", 1), doctest::Contains("cannot be found"));
}

namespace {

/// The errors of a camera that reads `bytes` from stdin as they arrive.
std::string run_on_stdin(const std::string& bytes, std::vector<std::string> settings) {
  const CameraFolder folder;
  std::ofstream(folder / "bytes", std::ios::binary) << bytes;
  std::vector<std::string> arguments{program_path("puck-camera"), "--lcm-url", "memq://"};
  settings.insert(settings.end(), {"camera.source=stdin", "camera.pace=arrival"});
  for (const std::string& setting : settings) {
    arguments.insert(arguments.end(), {"--set", setting});
  }
  const Finished finished = run_program(arguments, {.input = folder / "bytes"});
  CHECK(finished.exit_code == 0);
  return finished.errors;
}

}  // namespace

TEST_CASE("the program publishes EVT2.1 and Event Stream from stdin to their end") {
  for (const StreamSample& sample : stream_samples()) {
    if (sample.name != "evt21" && sample.name != "es") continue;
    CAPTURE(sample.name);
    CHECK(contains(run_on_stdin(sample.bytes, {}), "has ended after 3000 events"));
  }
}

TEST_CASE("the output of vendors' tools is read from stdin with the settings of docs/cameras.md") {
  const auto recorded = [](const char* file) {
    std::ifstream in(source_folder() / "tests" / "io" / "data" / file, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  };
  // By faery.
  CHECK(contains(run_on_stdin(recorded("events.csv"), {"camera.text_unit=us"}),
                 "has ended after 300 events"));
  // RAW with its header, as a Metavision recorder writes it.
  CHECK(contains(run_on_stdin(recorded("evt3.raw"), {}), "has ended after 700 events"));
  // Words without a header, as of an OpenMV.
  const StreamSample evt2 = stream_samples().front();
  const std::string words = evt2.bytes.substr(evt2.bytes.find("% end\n") + 6);
  CHECK(
      contains(run_on_stdin(words, {"camera.format=evt2", "camera.width=320", "camera.height=320"}),
               "has ended after 3000 events"));
}

}  // namespace puck
