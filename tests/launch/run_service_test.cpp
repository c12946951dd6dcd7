#include "services/launch/run_service.h"

#include <chrono>
#include <csignal>
#include <stdexcept>

#include <doctest/doctest.h>
#include <unistd.h>

#include "services/launch/stop_on_signal.h"
#include "tests/support/wait_until.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

/// Records the actions of a test service.
struct Diary {
  int volume = -1;
  std::vector<int> states;  ///< Of the statuses published.
  bool stopped = false;
};

/// Runs until a signal, which it sends itself.
class SelfStoppingService : public Service {
 public:
  SelfStoppingService(Diary& diary, ServiceContext& context) : diary_(diary), context_(context) {
    context_.bus.subscribe<service_status_t>(
        [this](const service_status_t& status, const Receipt&) {
          diary_.states.push_back(status.state);
        });
  }

  void run(std::stop_token stop) override {
    if (diary_.volume == 11) throw std::runtime_error("too loud");
    context_.status.set_state(ServiceState::kRunning);
    while (!stop.stop_requested()) {
      context_.bus.handle(milliseconds(10));
      poll_status(context_, *this);
      // Twice, as an impatient operator does.
      if (!diary_.states.empty()) kill(getpid(), SIGTERM);
      if (!diary_.states.empty()) kill(getpid(), SIGTERM);
    }
    diary_.stopped = true;
  }

  void report(StatusReport& report) const override { report.counters = {{"tests", 1}}; }

 private:
  Diary& diary_;
  ServiceContext& context_;
};

int run(std::vector<const char*> arguments, Diary& diary,
        ServiceInfo info = {"puck-test", "", {}, {}}) {
  for (const char* argument : {"off", "--log-level", "puck-test"}) {
    arguments.insert(arguments.begin(), argument);
  }
  return run_service(info, static_cast<int>(arguments.size()), arguments.data(),
                     [&](Config& config) -> MakeService {
                       config.read("test.volume", diary.volume, 0, 11);
                       return [&](ServiceContext& context) {
                         return std::make_unique<SelfStoppingService>(diary, context);
                       };
                     });
}

}  // namespace

TEST_CASE("a service runs until SIGTERM and ends with 0") {
  Diary diary;
  CHECK(run({"--lcm-url", "memq://", "--set", "test.volume=5"}, diary) == 0);
  CHECK(diary.volume == 5);
  CHECK(diary.stopped);
  REQUIRE_FALSE(diary.states.empty());
  CHECK(diary.states.front() == service_status_t::STATE_RUNNING);
}

TEST_CASE("an exception in a running service ends it with 1") {
  Diary diary;
  CHECK(run({"--lcm-url", "memq://", "--set", "test.volume=11"}, diary) == 1);
  CHECK_FALSE(diary.stopped);
}

TEST_CASE("an error in settings, URL or prefix ends the start with 1, a usage error with 2") {
  Diary diary;
  CHECK(run({"--lcm-url", "udpm://1.2.3.4"}, diary) == 1);
  CHECK(run({"--lcm-url", "memq://", "--prefix", "left"}, diary) == 1);
  CHECK(run({"--lcm-url", "memq://", "--set", "test.volume=12"}, diary) == 1);
  CHECK(run({"--lcm-url", "memq://", "--set", "test.unknown=1"}, diary) == 1);
  CHECK(run({"--lcm-url", "memq://", "--config", "/nonexistent.toml"}, diary) == 1);
  CHECK(run({"--nope"}, diary) == 2);
  CHECK_FALSE(diary.stopped);
}

TEST_CASE("a check of a service that is not running ends with 1") {
  Diary diary;
  CHECK(run({"--lcm-url", "memq://", "--check"}, diary) == 1);
  CHECK_FALSE(diary.stopped);
}

TEST_CASE("a numeric prefix stays text") {
  Diary diary;
  std::string prefix;
  ServiceInfo info{"puck-test", "", {}, [&](const BusParams& params, const std::stop_token&) {
                     prefix = params.prefix;
                     return std::optional<int>(7);
                   }};
  CHECK(run({"--lcm-url", "memq://", "--prefix", "12"}, diary, info) == 7);
  CHECK(prefix == "12");
}

TEST_CASE("SIGINT and SIGTERM become a stop request within 200 ms") {
  for (const int signal : {SIGINT, SIGTERM}) {
    const StopOnSignal signals;
    CHECK_FALSE(signals.token().stop_requested());
    kill(getpid(), signal);
    CHECK(wait_until([&] { return signals.token().stop_requested(); }));
  }
}

}  // namespace puck
