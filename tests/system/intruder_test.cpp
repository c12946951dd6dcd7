// Any program can send anything on the bus: the services count it, and continue.
#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <lcm/eventlog.h>

#include "common/messaging/log_file.h"
#include "common/messaging/message_check.h"
#include "tests/intruder/attacks.h"
#include "tests/support/process_usage.h"
#include "tests/support/temporary_folder.h"
#include "tests/system/system_bench.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

constexpr int kLoggerQueueBytes = 32 << 20;

/// A game with its logger, on a bus with other receivers.
class Game {
 public:
  explicit Game(const TemporaryFolder& folder) : log_(folder / "game.lcm"), bus(url) {
    for (const std::string& name : kServices) {
      std::vector<std::string> settings;
      if (name == "puck-logger") {
        settings = {"logger.path=" + log_.string(),
                    "logger.queue_bytes=" + std::to_string(kLoggerQueueBytes)};
      }
      services_.emplace(name, new ChildProcess(start_service(name, url, settings)));
    }
    REQUIRE(bus.hears(kServices));
    REQUIRE(goes_on());
  }

  /// Events are tracked, and commands reach the arm.
  bool goes_on() {
    const std::int64_t estimates = bus.fresh_estimates();
    const std::int64_t commands = bus.counter("puck-arm", "commands_accepted");
    const std::int64_t written = bus.counter("puck-logger", "messages_written");
    return bus.until([&] {
      return bus.fresh_estimates() > estimates + 50 &&
             bus.counter("puck-arm", "commands_accepted") > commands + 20 &&
             bus.counter("puck-logger", "messages_written") > written + 50;
    });
  }

  bool all_run() {
    return std::all_of(services_.begin(), services_.end(),
                       [](auto& service) { return service.second->is_running(); });
  }

  std::map<std::string, double> memory_mb() const {
    std::map<std::string, double> memory;
    for (const auto& [name, service] : services_) memory[name] = resident_mb(service->pid());
    return memory;
  }

  std::map<std::string, std::int64_t> counters(const std::string& counter) const {
    std::map<std::string, std::int64_t> values;
    for (const std::string& name : kServices) values[name] = bus.counter(name, counter);
    return values;
  }

  /// Ends it and closes the log.
  const std::filesystem::path& stop() {
    for (auto& service : services_) {
      CAPTURE(service.first);
      service.second->send(SIGTERM);
      CHECK(service.second->wait_for(std::chrono::seconds(10)) == 0);
    }
    return log_;
  }

 private:
  const std::filesystem::path log_;

 public:
  const std::string url = new_lcm_url();
  BusListener bus;

 private:
  std::map<std::string, std::unique_ptr<ChildProcess>> services_;
};

/// Runs the intruder for a second. Returns its own count of sent datagrams.
std::int64_t intrude(Game& game, const Attack& attack, int seed, const TemporaryFolder& folder) {
  ChildProcess intruder(
      {program("puck-intruder"), "--lcm-url", game.url, "--attack", std::string(attack.name),
       "--seconds", "1", "--seed", std::to_string(seed)},
      {.output = folder / "intruder"});
  // The listener must not be late.
  REQUIRE(game.bus.until([&] { return !intruder.is_running(); }));
  REQUIRE(intruder.wait() == 0);
  const std::string said = read_text(folder / "intruder");
  REQUIRE(said.starts_with(attack.name));
  return std::stoll(said.substr(attack.name.size()));
}

void check_attack(Game& game, const Attack& attack, int seed, const TemporaryFolder& folder) {
  CAPTURE(attack.name);
  const std::string counter(attack.counted_as);
  const auto before = game.counters(counter);
  const std::int64_t estimates = game.bus.fresh_estimates();
  const std::int64_t sent = intrude(game, attack, seed, folder);
  REQUIRE(sent > 100);
  REQUIRE(game.all_run());
  CHECK(game.bus.fresh_estimates() > estimates);
  CHECK(game.goes_on());
  if (counter.empty()) return;
  for (const std::string& name : kServices) {
    CAPTURE(name);
    // All services receive STATUS, which is a part of the attack.
    CHECK(game.bus.until([&] {
      return game.bus.counter(name, counter) - std::max<std::int64_t>(before.at(name), 0) >
             sent / 100;
    }));
  }
}

struct LogContent {
  std::int64_t messages = 0;
  std::int64_t malformed_events = 0;
  std::int64_t estimates = 0;
};

LogContent read_log(const std::filesystem::path& path) {
  LogContent content;
  LogReader reader(path);
  LogRecord record;
  while (reader.next(record)) {
    ++content.messages;
    const auto channel = find_channel(record.channel, "");
    if (channel == Channel::kEstimate) ++content.estimates;
    if (channel == Channel::kEvents && check_message(*channel, record.bytes)) {
      ++content.malformed_events;
    }
  }
  CHECK_FALSE(reader.damage().has_value());
  return content;
}

/// Number of messages in LCM's own reader, which its player uses.
std::int64_t messages_for_lcm(const std::filesystem::path& path) {
  lcm_eventlog_t* const log = lcm_eventlog_create(path.c_str(), "r");
  REQUIRE(log != nullptr);
  std::int64_t messages = 0;
  while (lcm_eventlog_event_t* const event = lcm_eventlog_read_next_event(log)) {
    lcm_eventlog_free_event(event);
    ++messages;
  }
  lcm_eventlog_destroy(log);
  return messages;
}

}  // namespace

TEST_CASE("no attack stops a game, grows a service, goes uncounted or damages the log") {
  const TemporaryFolder folder;
  Game game(folder);
  // The largest reserve of each for waiting datagrams, and for the names of 40000 channels; and the
  // logger's queue for its disk.
  constexpr double kAllowanceMb = 48 + kLoggerQueueBytes * 1e-6;
  const auto calm_mb = game.memory_mb();
  for (const int seed : {1, 2}) {
    for (const Attack& attack : all_attacks()) check_attack(game, attack, seed, folder);
    for (const auto& [name, now_mb] : game.memory_mb()) {
      MESSAGE(name, ": ", calm_mb.at(name), " MB before, ", now_mb, " MB after all attacks");
      CHECK(now_mb < 1.1 * calm_mb.at(name) + kAllowanceMb);
    }
  }

  const auto& log = game.stop();
  REQUIRE(game.bus.until(
      [&] { return game.bus.status("puck-logger")->state == service_status_t::STATE_STOPPING; }));
  const std::int64_t rejected = game.bus.counter("puck-logger", "packets_rejected");
  const std::int64_t not_written = game.bus.counter("puck-logger", "messages_not_written");
  const LogContent content = read_log(log);
  MESSAGE("the log holds ", content.messages, " messages, ", content.malformed_events,
          " of them malformed events");
  CHECK(content.estimates > 1000);
  CHECK(content.malformed_events > 1000);
  CHECK(content.malformed_events <= rejected);
  CHECK(content.malformed_events >= rejected - not_written);
  CHECK(messages_for_lcm(log) == content.messages);
}

TEST_CASE("lcm-logplayer plays a log of an attack to its end") {
  const TemporaryFolder folder;
  {
    Game game(folder);
    for (const char* name : {"counts", "channels"}) {
      check_attack(game, *find_attack(name), 1, folder);
    }
    game.stop();
  }
  const std::string url = new_lcm_url();
  BusListener bus(url);
  ChildProcess player({"lcm-logplayer", "--lcm-url=" + url, (folder / "game.lcm").string()});
  CHECK(bus.until([&] { return !player.is_running(); }, std::chrono::seconds(60)));
  CHECK(player.wait() == 0);
  CHECK(bus.fresh_estimates() > 50);
}

}  // namespace puck
