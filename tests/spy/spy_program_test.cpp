#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "common/messaging/bus.h"
#include "tests/spy/spy_bench.h"
#include "tests/support/child_process.h"
#include "tests/support/environment.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/terminal_process.h"
#include "tests/support/test_url.h"

namespace puck {
namespace {

using Json = nlohmann::json;
using std::chrono::milliseconds;

constexpr const char* kFullScreen = "\x1b[?1049h";
constexpr const char* kFullScreenOver = "\x1b[?1049l";

std::string spy_path() { return program_path("puck-spy"); }

/// A camera that publishes until the test ends.
class Camera {
 public:
  explicit Camera(const BusParams& params) : bus_(params) {
    REQUIRE(bus_.start({}, [](const std::string&) {}));
    thread_ = std::jthread([this](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        event_packet_t packet = packet_of(10);
        bus_.publish(packet);
        service_status_t status = status_of("puck-camera");
        bus_.publish(status);
        std::this_thread::sleep_for(milliseconds(10));
      }
    });
  }

 private:
  Bus bus_;
  std::jthread thread_;
};

/// puck-spy in a terminal of its own.
class SpyInTerminal : public TerminalProcess {
 public:
  explicit SpyInTerminal(const std::string& lcm_url, const char* type = "xterm")
      : TerminalProcess({spy_path(), "--lcm-url", lcm_url}, type) {}
};

}  // namespace

TEST_CASE("puck-spy --once --json prints the traffic on the bus under its prefix") {
  const Camera camera({.url = private_lcm_url(0), .prefix = "LEFT"});
  const Finished spy = run_program({spy_path(), "--lcm-url", private_lcm_url(0), "--prefix", "LEFT",
                                    "--once", "--seconds", "3", "--json"});
  CHECK(spy.exit_code == 0);
  CHECK(spy.errors.empty());
  const Json report = Json::parse(spy.output);
  REQUIRE(report["channels"].size() == 2);
  CHECK(report["channels"][0]["channel"] == "LEFT_PUCK_EVENTS");
  CHECK(report["channels"][0]["received"].get<int>() > 0);
  CHECK(report["channels"][0]["lost"] == 0);
  CHECK(report["publishers"][0]["service"] == "puck-camera");
  REQUIRE(report["services"].size() == 1);
  CHECK(report["services"][0]["host"] == "robot");

  const Finished table = run_program({spy_path(), "--lcm-url", private_lcm_url(0), "--prefix",
                                      "LEFT", "--once", "--seconds", "3"});
  CHECK(table.exit_code == 0);
  CHECK(table.output.find("LEFT_PUCK_EVENTS") != std::string::npos);
}

TEST_CASE("puck-spy --once reports a silent bus, and exits with 1") {
  const Finished spy = run_program(
      {spy_path(), "--lcm-url", private_lcm_url(1), "--once", "--seconds", "0.2", "--json"});
  CHECK(spy.exit_code == 1);
  CHECK(spy.errors == "puck-spy: no message was received on " + private_lcm_url(1) + "\n");
  CHECK(Json::parse(spy.output)["messages"] == 0);
}

TEST_CASE("without messages of ours puck-spy names the foreign ones") {
  const Camera camera({.url = private_lcm_url(0), .prefix = "RIGHT"});
  const Finished spy = run_program({spy_path(), "--lcm-url", private_lcm_url(0), "--prefix", "LEFT",
                                    "--once", "--seconds", "3"});
  CHECK(spy.exit_code == 1);
  CHECK(spy.errors.find("foreign datagrams: channel \"RIGHT_PUCK_") != std::string::npos);
  CHECK(spy.output.find("FOREIGN TRAFFIC") != std::string::npos);
}

TEST_CASE("puck-spy with a key reports unsealed messages") {
  const TemporaryFolder folder;
  const auto key = folder.write("key", std::string(32, 'k'));
  std::filesystem::permissions(key, std::filesystem::perms::owner_read);
  const Camera camera({.url = private_lcm_url(5)});
  const Finished spy = run_program({spy_path(), "--lcm-url", private_lcm_url(5), "--set",
                                    "lcm.key_file=" + key.string(), "--once", "--seconds", "1"});
  CHECK(spy.exit_code == 1);
  CHECK(spy.errors.find("messages without our key, the last on PUCK_STATUS is not sealed, and "
                        "this service has a key, from ") != std::string::npos);
}

TEST_CASE("puck-spy takes the bus from any service's settings, and refuses unusable ones") {
  const std::string config = source_folder() / "config/tracker.toml";
  const Finished spy = run_program({spy_path(), "--config", config, "--lcm-url", private_lcm_url(1),
                                    "--once", "--seconds", "0.2"});
  CHECK(spy.exit_code == 1);
  CHECK(spy.errors.find("no message was received") != std::string::npos);

  const Camera camera({.url = private_lcm_url(4), .prefix = "LEFT"});
  const Finished set =
      run_program({spy_path(), "--config", config, "--set", "lcm.url=" + private_lcm_url(4),
                   "--set", "lcm.prefix=LEFT", "--once", "--seconds", "1"});
  CHECK(set.exit_code == 0);
  CHECK(set.output.find("LEFT_PUCK_EVENTS") != std::string::npos);
  const Finished unknown = run_program({spy_path(), "--once", "--set", "lcm.prefx=LEFT"});
  CHECK(unknown.exit_code == 1);
  CHECK(unknown.errors.find("lcm.prefx") != std::string::npos);

  CHECK(run_program({spy_path(), "--json"}).exit_code == 2);
  CHECK(run_program({spy_path(), "--once", "--seconds", "nan"}).exit_code == 2);
  CHECK(run_program({spy_path(), "--once", "--lcm-url", "nonsense"}).exit_code == 1);
  CHECK(run_program({spy_path(), "--once", "--prefix", "left"}).exit_code == 1);
  const Finished piped = run_program({spy_path(), "--lcm-url", private_lcm_url(1)});
  CHECK(piped.exit_code == 1);
  CHECK(piped.errors == "puck-spy: the live view needs a terminal; without one use --once\n");
}

TEST_CASE("the live view follows keys and the terminal's size, and restores the terminal") {
  const Camera camera({.url = private_lcm_url(2)});
  SpyInTerminal spy(private_lcm_url(2));
  REQUIRE(spy.reads(kFullScreen));
  REQUIRE(spy.reads("PUCK_EVENTS"));
  REQUIRE(spy.reads("puck-camera"));
  spy.type("\r");
  REQUIRE(spy.reads("event_packet_t, "));
  spy.type("h");
  REQUIRE(spy.reads("counts since the start"));
  spy.type("h");
  spy.resize(160, 50);
  REQUIRE(spy.reads("COUNTERS"));
  spy.type("q");
  CHECK(spy.reads(kFullScreenOver));
  CHECK(spy.wait() == 0);
}

TEST_CASE("the live view restores the terminal on SIGTERM") {
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    SpyInTerminal spy(private_lcm_url(3));
    REQUIRE(spy.reads(kFullScreen));
    REQUIRE(spy.reads("no message received yet"));
    spy.send(signal);
    CHECK(spy.reads(kFullScreenOver));
    CHECK(spy.wait() == 0);
  }
}

TEST_CASE("the live view restores the terminal after an error") {
  SpyInTerminal spy("nonsense");
  REQUIRE(spy.reads(kFullScreen));
  CHECK(spy.reads(kFullScreenOver));
  CHECK(spy.reads("puck-spy: "));
  CHECK(spy.wait() == 1);
}

TEST_CASE("an unknown terminal is refused with advice") {
  SpyInTerminal spy(private_lcm_url(3), "no-such-terminal");
  CHECK(spy.reads("TERM=no-such-terminal; try TERM=xterm"));
  CHECK(spy.wait() == 1);
}

}  // namespace puck
