// The real puck-logger, killed during a write.
#include <csignal>
#include <random>
#include <thread>

#include <doctest/doctest.h>

#include "common/messaging/log_file.h"
#include "common/messaging/loss_accounting.h"
#include "common/messaging/message_codec.h"
#include "tests/support/child_process.h"
#include "tests/support/crowd_publisher.h"
#include "tests/support/environment.h"
#include "tests/support/status_counter.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_url.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

struct LoggedPackets {
  std::int64_t messages = 0;
  std::int64_t packets = 0;
  std::int64_t lost = 0;
};

LoggedPackets read_log(const std::filesystem::path& path) {
  LogReader reader(path);
  LoggedPackets logged;
  LossAccount account;
  for (LogRecord record; reader.next(record); ++logged.messages) {
    if (record.channel != "PUCK_EVENTS") continue;
    REQUIRE(check_message(Channel::kEvents, record.bytes) == std::nullopt);
    const MessageHeader header = read_header(record.bytes);
    account.add(header.session, header.seq);
    ++logged.packets;
  }
  logged.lost = account.counters().lost;
  // At most the last write is torn.
  CHECK(reader.bytes_skipped() <= 1 << 20);
  return logged;
}

}  // namespace

TEST_CASE("a killed logger leaves all messages that it reported as written, in a playable log") {
  const TemporaryFolder folder;
  std::mt19937 random(std::random_device{}());
  for (int kill = 0; kill < 3; ++kill) {
    const std::string url = private_lcm_url(2 * kill);
    const std::string path = folder / ("a" + std::to_string(kill) + ".lcm");
    ChildProcess logger({program_path("puck-logger"), "--lcm-url", url, "--set",
                         "logger.path=" + path, "--log-level", "error"});
    Bus bus({.url = url});
    std::int64_t said = -1;
    bus.subscribe<service_status_t>([&](const service_status_t& status, const Receipt&) {
      said = test::counter(status, "messages_written").value_or(-1);
    });
    REQUIRE(bus.start({}, [](const std::string&) {}));
    CrowdPublisher camera(url);
    const std::int64_t enough = 500 + static_cast<std::int64_t>(random() % 500);
    for (int i = 0; i < 30'000 && said < enough; ++i) {
      camera.publish(1000);
      bus.handle(milliseconds(1));
    }
    REQUIRE(said >= enough);
    logger.send(SIGKILL);
    CHECK(logger.wait() == -1);

    const LoggedPackets logged = read_log(path);
    CHECK(logged.messages >= said);
    CHECK(logged.lost == 0);

    const std::string replayed = private_lcm_url(2 * kill + 1);
    std::int64_t heard = 0;
    Bus listener({.url = replayed});
    listener.subscribe<event_packet_t>([&](const event_packet_t&, const Receipt&) { ++heard; });
    REQUIRE(listener.start({}, [](const std::string&) {}));
    ChildProcess player({"lcm-logplayer", "--speed=0.5", "--lcm-url=" + replayed, path},
                        {.output = folder / "player"});
    while (player.is_running()) listener.handle(milliseconds(10));
    while (listener.handle(milliseconds(100)) > 0) continue;
    CHECK(player.wait() == 0);
    CHECK(heard == logged.packets);
  }
}

}  // namespace puck
