#include <filesystem>
#include <map>
#include <thread>

#include <doctest/doctest.h>
#include <spdlog/sinks/null_sink.h>

#include "common/messaging/bus_settings.h"
#include "common/messaging/event_packing.h"
#include "common/messaging/message_codec.h"
#include "common/messaging/status_check.h"
#include "services/logger/logger_service.h"
#include "tests/support/child_process.h"
#include "tests/support/environment.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_url.h"
#include "tests/support/thread_wake_ups.h"
#include "tests/support/wait_until.h"

namespace puck {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

/// A logger within the test, on a bus of its own.
struct LoggerBench {
  Bus bus{BusParams{.url = "memq://"}};
  StatusReporter status{bus, "puck-logger"};
  spdlog::logger log{"test", std::make_shared<spdlog::sinks::null_sink_mt>()};
  RateLimitedLog limited_log{log};
  BusWatch bus_watch{bus, log};
  PeerWatch peers{status, log};
  ServiceContext context{bus, status, log, limited_log, bus_watch, peers};
  LoggerService logger;

  explicit LoggerBench(const LoggerParams& params) : logger(params, context) {
    REQUIRE(bus.start({}, [](const std::string&) {}));
  }

  /// Lets it write the messages published so far.
  void run() {
    std::stop_source stop;
    stop.request_stop();
    logger.run(stop.get_token());
  }

  std::map<std::string, std::int64_t> counters() const {
    StatusReport report;
    logger.report(report);
    return {report.counters.begin(), report.counters.end()};
  }
};

void publish_events(Bus& bus, int packets) {
  EventPacker packer({.sensor = {640, 480}});
  for (int i = 0; i < packets; ++i) {
    packer.pack({1000 * i}, std::vector<Event>(10),
                [&](event_packet_t& packet) { bus.publish(packet); });
  }
}

/// Number of messages of each channel.
std::map<std::string, int> channels_in(const std::filesystem::path& path) {
  LogReader reader(path);
  std::map<std::string, int> channels;
  LogRecord record;
  while (reader.next(record)) ++channels[record.channel];
  CHECK_FALSE(reader.damage().has_value());
  return channels;
}

}  // namespace

TEST_CASE("the logger writes messages of every channel") {
  const TemporaryFolder folder;
  LoggerBench bench({.path = folder / "a.lcm"});
  publish_events(bench.bus, 5);
  head_state_t head{};
  bench.bus.publish(head);
  bench.run();
  CHECK(channels_in(folder / "a.lcm") ==
        std::map<std::string, int>{{"PUCK_EVENTS", 5}, {"PUCK_HEAD", 1}});
  CHECK(bench.counters()["messages_written"] == 6);
  CHECK(bench.counters()["packets_received"] == 5);
  CHECK(bench.counters()["packets_lost"] == 0);
  CHECK(bench.counters()["bytes_written"] ==
        static_cast<std::int64_t>(std::filesystem::file_size(folder / "a.lcm")));
}

TEST_CASE("slow traffic does not wake the logger for every message") {
  const TemporaryFolder folder;
  LoggerBench bench({.path = folder / "a.lcm"});
  WakeUpTally tally;
  bench.bus.subscribe<head_state_t>([&](const head_state_t&, const Receipt&) { tally.add(); });
  {
    const std::jthread runner([&](const std::stop_token& stop) { bench.logger.run(stop); });
    REQUIRE(publish_ten_a_ms(bench.bus, head_state_t{}, 2000));
    wait_until([&] { return bench.bus.counters<head_state_t>().arrivals.received == 2000; });
  }
  CHECK(tally.messages == 2000);
  CHECK(tally.wake_ups() < tally.messages / 2);
  CHECK(channels_in(folder / "a.lcm")["PUCK_HEAD"] == 2000);
}

TEST_CASE("the logger counts event packets and missing events") {
  const TemporaryFolder folder;
  LoggerBench bench({.path = folder / "a.lcm"});
  EventPacker packer({.sensor = {640, 480}});
  for (int i = 0; i < 5; ++i) {
    packer.pack({i}, std::vector<Event>(10), [&](const event_packet_t& packet) {
      event_packet_t sent = packet;
      // The bus refuses this one, but uses its number.
      if (i == 2) sent.encoding = 9;
      bench.bus.publish(sent);
    });
  }
  bench.run();
  CHECK(bench.counters()["packets_received"] == 4);
  CHECK(bench.counters()["packets_lost"] == 1);
  CHECK(bench.counters()["events_lost"] == 10);
}

TEST_CASE("the logger stops at its quota, reports that and counts the unwritten messages") {
  const TemporaryFolder folder;
  const std::int64_t packet_bytes = 28 + 11 + 93 + 40;
  LoggerBench bench({.path = folder / "a.lcm", .max_bytes = 3 * packet_bytes + 1});
  publish_events(bench.bus, 5);
  bench.run();
  CHECK(channels_in(folder / "a.lcm")["PUCK_EVENTS"] == 3);
  CHECK(bench.counters()["messages_not_written"] == 2);
  CHECK(bench.status.state() == ServiceState::kDegraded);
  CHECK(bench.status.state_text().find("logger.max_bytes = 517 is reached") != std::string::npos);
}

TEST_CASE("the logger counts messages beyond its queue by channel, and reports them") {
  const TemporaryFolder folder;
  // A queue that takes a packet of 10 events, but not one of 1000.
  LoggerBench bench({.path = folder / "a.lcm", .queue_bytes = 1000});
  EventPacker packer({.sensor = {640, 480}, .packet_bytes = EventPackerParams::kMaxBytes});
  for (const std::size_t events : {10, 1000, 1000}) {
    packer.pack({0}, std::vector<Event>(events),
                [&](event_packet_t& packet) { bench.bus.publish(packet); });
  }
  bench.run();
  CHECK(channels_in(folder / "a.lcm")["PUCK_EVENTS"] == 1);
  CHECK(bench.counters()["messages_not_written"] == 2);
  CHECK(bench.counters()["messages_not_written.PUCK_EVENTS"] == 2);
  CHECK(bench.counters()["packets_received"] == 3);
  CHECK(bench.counters()["queue_most_bytes"] <= 1000);
  CHECK(bench.status.state() == ServiceState::kDegraded);
  CHECK(bench.status.state_text().find("logger.queue_bytes") != std::string::npos);
}

TEST_CASE("a logger restarted within a second waits for the next second's name") {
  const TemporaryFolder folder;
  const LoggerParams params{.path = (folder / "%Y-%m-%d-%H-%M-%S.lcm").string()};
  const LoggerBench first(params);
  const LoggerBench second(params);
  CHECK(first.logger.path() < second.logger.path());
}

TEST_CASE("the logger writes its start time into the path, and overwrites nothing") {
  const TemporaryFolder folder;
  {
    LoggerBench bench({.path = (folder / "%Y.lcm").string()});
    CHECK(std::filesystem::exists(bench.logger.path()));
    CHECK(bench.logger.path().find('%') == std::string::npos);
  }
  const LoggerParams params{.path = (folder / "%Y.lcm").string()};
  CHECK_THROWS_AS(LoggerBench{params}, LogFileError);
  CHECK_NOTHROW(LoggerBench({.path = params.path, .overwrite = true}));
}

TEST_CASE("the logger reads its settings and refuses impossible ones") {
  const auto params_of = [](const std::string& text) {
    Config config = Config::from_text(text, "logger.toml");
    const LoggerParams params = LoggerService::read_params(config);
    config.reject_unknown();
    return params;
  };
  const LoggerParams params =
      params_of("[logger]\npath = 'x.lcm'\noverwrite = true\nmax_bytes = 1000\n");
  CHECK(params.path == "x.lcm");
  CHECK(params.overwrite);
  CHECK(params.max_bytes == 1000);
  CHECK(params_of("[logger]\nrotate_bytes = 65536\nquota_bytes = 131072\n").quota_bytes == 131072);
  for (const char* wrong :
       {"rotate_bytes = 65535", "rotate_s = -1", "quota_bytes = 1000000",
        "rotate_bytes = 65536\nquota_bytes = 131071", "min_free_bytes = -1", "queue_bytes = 1000",
        "path = '%Y/a.lcm'\nrotate_bytes = 65536\nquota_bytes = 131072"}) {
    CAPTURE(wrong);
    CHECK_THROWS_AS(params_of(std::string("[logger]\n") + wrong), ConfigError);
  }
  CHECK_THROWS_AS(params_of("[logger]\nmax_bytes = -1\n"), ConfigError);
  CHECK_THROWS_AS(params_of("[logger]\npaht = 'x'\n"), ConfigError);
}

TEST_CASE("the commented settings file holds every key with its default") {
  Config config = Config::from_file(source_folder() / "config/logger.toml");
  const BusParams bus = read_bus_params(config);
  const LoggerParams params = LoggerService::read_params(config);
  CHECK_NOTHROW(config.reject_unknown());
  for (const char* key : {"lcm.url", "lcm.prefix", "logger.path", "logger.overwrite",
                          "logger.max_bytes", "logger.rotate_bytes", "logger.rotate_s",
                          "logger.quota_bytes", "logger.min_free_bytes", "logger.queue_bytes"}) {
    CAPTURE(key);
    CHECK(config.has(key));
  }
  CHECK(bus.url == BusParams{}.url);
  CHECK(bus.prefix == BusParams{}.prefix);
  CHECK(params.path == LoggerParams{}.path);
  CHECK(params.overwrite == LoggerParams{}.overwrite);
  CHECK(params.max_bytes == LoggerParams{}.max_bytes);
  CHECK(params.rotate_bytes == LoggerParams{}.rotate_bytes);
  CHECK(params.rotate_s == LoggerParams{}.rotate_s);
  CHECK(params.quota_bytes == LoggerParams{}.quota_bytes);
  CHECK(params.min_free_bytes == LoggerParams{}.min_free_bytes);
  CHECK(params.queue_bytes == LoggerParams{}.queue_bytes);
}

TEST_CASE("puck-logger logs replayed messages of lcm-logplayer, and stops at once on SIGTERM") {
  const TemporaryFolder folder;
  const std::string path = folder / "a.lcm";
  const std::string live = private_lcm_url(0);
  const std::string replayed = private_lcm_url(1);
  {
    ChildProcess logger({program_path("puck-logger"), "--lcm-url", live, "--prefix", "LEFT",
                         "--set", "logger.path=" + path, "--log-level", "error"});
    REQUIRE(check_service({.url = live, .prefix = "LEFT"}, "puck-logger", milliseconds(10000), {})
                .healthy);
    Bus camera({.url = live, .prefix = "LEFT"});
    REQUIRE(camera.start({}, [](const std::string&) {}));
    for (int i = 0; i < 20; ++i) {
      publish_events(camera, 10);
      std::this_thread::sleep_for(milliseconds(2));
    }
    std::this_thread::sleep_for(milliseconds(100));
    logger.send(SIGTERM);
    CHECK(logger.wait() == 0);
  }
  CHECK(channels_in(path)["LEFT_PUCK_EVENTS"] == 200);

  int packets = 0;
  Bus tracker({.url = replayed, .prefix = "LEFT"});
  tracker.subscribe<event_packet_t>([&](const event_packet_t&, const Receipt&) { ++packets; });
  REQUIRE(tracker.start({}, [](const std::string&) {}));
  ChildProcess player({"lcm-logplayer", "--lcm-url=" + replayed, path});
  wait_until([&] { return tracker.handle(milliseconds(10)) >= 0 && packets == 200; });
  CHECK(packets == 200);
  CHECK(player.wait() == 0);
  CHECK(tracker.counters<event_packet_t>().rejected == 0);
}

}  // namespace puck
