#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

#include <doctest/doctest.h>
#include <spdlog/sinks/ostream_sink.h>

#include "services/launch/bus_watch.h"
#include "services/launch/rate_limited_log.h"
#include "tests/support/status_counter.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_url.h"

namespace puck {
namespace {

using test::counter;

/// A log with readable lines.
struct ReadableLog {
  std::ostringstream text;
  spdlog::logger log{"test", std::make_shared<spdlog::sinks::ostream_sink_mt>(text)};

  ReadableLog() { log.set_pattern("%v"); }
};

}  // namespace

TEST_CASE("warnings on a subject appear once a second, with the number of suppressed ones") {
  ReadableLog readable;
  RateLimitedLog limited(readable.log);
  const RateLimitedLog::Clock::time_point start{};
  const auto at = [&](int ms) { return start + std::chrono::milliseconds(ms); };
  limited.warn("camera", "a", at(0));
  limited.warn("camera", "b", at(1));
  limited.warn("camera", "c", at(999));
  limited.warn("arm", "d", at(999));
  limited.warn("camera", "e", at(1000));
  limited.warn("camera", "f", at(2500));
  CHECK(readable.text.str() ==
        "camera: a\narm: d\ncamera: e (2 more like it not shown)\ncamera: f\n");
}

TEST_CASE("problems on the bus are logged once, and summed up for the status") {
  ReadableLog readable;
  Bus bus({.url = "memq://"});
  BusWatch watch(bus, readable.log);
  bus.subscribe<head_state_t>(
      [](const head_state_t&, const Receipt&) { throw std::runtime_error("no head"); });
  REQUIRE(bus.start({}, [](const std::string&) {}));
  head_state_t head{};
  bus.publish(head);
  bus.handle(std::chrono::milliseconds(1000));
  arm_command_t command{};
  command.mode = 9;
  bus.publish(command);
  bus.publish(command);

  watch.look();
  watch.look();
  CHECK(readable.text.str() ==
        "PUCK_ARM_COMMAND: 2 messages not sent, the last: arm_command_t.mode must be 0 to 3, "
        "got 9\nPUCK_HEAD: 1 messages dropped because of an error in this service, the last: "
        "no head\n");
  StatusReport report;
  watch.report_totals(report);
  watch.report_channels(report);
  CHECK(counter(report, "messages_rejected") == 0);
  CHECK(counter(report, "messages_received") == 1);
  CHECK(counter(report, "PUCK_HEAD.received") == 1);
  CHECK_FALSE(counter(report, "PUCK_HEAD.publishers"));
  CHECK_FALSE(counter(report, "messages_foreign"));
  CHECK_FALSE(counter(report, "PUCK_HEAD.lost"));
  CHECK_FALSE(counter(report, "PUCK_GAME.received"));
  CHECK(counter(report, "handler_failures") == 1);
  CHECK(counter(report, "publish_failures") == 2);
}

TEST_CASE("lost and late messages of all channels are summed up for the status") {
  ReadableLog readable;
  Bus sender({.url = private_lcm_url()});
  Bus receiver({.url = private_lcm_url()});
  BusWatch watch(receiver, readable.log);
  int heads = 0;
  receiver.subscribe<head_state_t>([&](const head_state_t&, const Receipt&) { ++heads; });
  REQUIRE(sender.start({}, [](const std::string&) {}));
  REQUIRE(receiver.start({}, [](const std::string&) {}));
  head_state_t head{};
  head_state_t spoilt{};
  spoilt.yaw_deg = std::numeric_limits<double>::quiet_NaN();
  sender.publish(head);
  sender.publish(spoilt);  // its number is missing for the receiver
  sender.publish(head);
  while (heads < 2) REQUIRE(receiver.handle(std::chrono::milliseconds(5000)) > 0);
  StatusReport report;
  watch.report_totals(report);
  watch.report_channels(report);
  CHECK(counter(report, "messages_lost") == 1);
  CHECK(counter(report, "PUCK_HEAD.lost") == 1);
}

TEST_CASE("a foreign sender on the port is named once, and counted") {
  ReadableLog readable;
  Bus stranger({.url = private_lcm_url(), .prefix = "RIGHT"});
  Bus bus({.url = private_lcm_url()});
  BusWatch watch(bus, readable.log);
  REQUIRE(stranger.start({}, [](const std::string&) {}));
  REQUIRE(bus.start({}, [](const std::string&) {}));
  head_state_t head{};
  stranger.publish(head);
  stranger.publish(head);
  while (bus.network_counters().foreign < 2) bus.handle(std::chrono::milliseconds(10));
  watch.look();
  watch.look();
  CHECK(readable.text.str().starts_with(
      "foreign datagrams on this group and port: channel \"RIGHT_PUCK_HEAD\" from "));
  CHECK(readable.text.str().find('\n') == readable.text.str().size() - 1);
  StatusReport report;
  watch.report_totals(report);
  watch.report_channels(report);
  CHECK(counter(report, "messages_foreign") == 2);
}

TEST_CASE("messages without our key are counted on unknown PUCK channels, too") {
  const TemporaryFolder folder;
  const auto key = folder / "key";
  std::ofstream(key) << std::string(32, 'k');
  std::filesystem::permissions(key, std::filesystem::perms::owner_read);
  ReadableLog readable;
  Bus stranger({.url = private_lcm_url(), .prefix = "PUCK"});  // PUCK_PUCK_HEAD
  Bus bus({.url = private_lcm_url(), .key_file = key.string()});
  BusWatch watch(bus, readable.log);
  bus.subscribe_all([](std::string_view, std::span<const std::uint8_t>, const Receipt&) {});
  REQUIRE(stranger.start({}, [](const std::string&) {}));
  REQUIRE(bus.start({}, [](const std::string&) {}));
  head_state_t head{};
  stranger.publish(head);
  for (int i = 0; i < 500 && bus.unknown_channels().unauthenticated == 0; ++i) {
    bus.handle(std::chrono::milliseconds(10));
  }
  watch.look();
  watch.look();
  CHECK(
      readable.text.str().starts_with("unknown PUCK channels: 1 messages without our key "
                                      "dropped, the last: is not sealed"));
  CHECK(readable.text.str().find('\n') == readable.text.str().size() - 1);
  StatusReport report;
  watch.report_totals(report);
  watch.report_channels(report);
  CHECK(counter(report, "messages_unauthenticated") == 1);
}

}  // namespace puck
