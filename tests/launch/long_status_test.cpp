#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/service_bench.h"
#include "tests/support/skewed_machine.h"
#include "tests/support/test_url.h"

namespace puck {
namespace {

/// Has more counters of its own than fit into a frame.
class TalkativeService : public Service {
 public:
  void run(std::stop_token) override {}
  void report(StatusReport& report) const override {
    for (int i = 0; i < counters; ++i) {
      report.counters.emplace_back("own_counter_number_" + std::to_string(100 + i), i);
    }
  }

  int counters = 0;
};

/// A service among six others with names of the greatest length.
struct LoudNetwork {
  LoudNetwork() {
    bench.bus.subscribe<head_state_t>([](const head_state_t&, const Receipt&) {});
    bench.bus.subscribe<service_status_t>([this](const service_status_t& status, const Receipt&) {
      if (status.session == bench.bus.session()) newest = status;
    });
    REQUIRE(bench.bus.start({}, [](const std::string&) {}));
    for (std::int64_t session = 1; session <= 6; ++session) {
      others.push_back(std::make_unique<SkewedMachine>(
          url, session, 0, std::to_string(session) + std::string(200, 'n')));
    }
    others[0]->publish(head_state_t{});
  }

  std::ptrdiff_t place_of(const std::string& beginning) const {
    const auto& names = newest.counter_name;
    const auto found = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
      return name.starts_with(beginning);
    });
    return found == names.end() ? -1 : found - names.begin();
  }
  bool until(const std::function<bool()>& condition) {
    return ServiceBench::until(condition, [this] {
      for (auto& other : others) other->serve();
      bench.bus.handle(std::chrono::milliseconds(5));
      poll_status(bench.context, service);
    });
  }
  bool knows_all_clocks() const {
    return std::all_of(others.begin(), others.end(), [this](const auto& other) {
      return bench.status.clock_of(other->session()).has_value();
    });
  }

  std::string url = private_lcm_url();
  ServiceBench bench{url};
  TalkativeService service;
  service_status_t newest{};
  std::vector<std::unique_ptr<SkewedMachine>> others;
};

}  // namespace

TEST_CASE("a status lists bus losses first, then the service, channels and peers") {
  LoudNetwork network;
  network.service.counters = 1;
  REQUIRE(network.until([&] { return network.place_of("clock_offset_us 6") >= 0; }));
  CHECK(network.place_of("messages_received") == 0);
  CHECK(network.place_of("own_counter") > network.place_of("publish_failures"));
  CHECK(network.place_of("PUCK_HEAD.received") > network.place_of("own_counter"));
  CHECK(network.place_of("clock_offset_us 1") > network.place_of("PUCK_STATUS.received"));
  CHECK(network.place_of("counters_left_out") < 0);
  const auto place = static_cast<std::size_t>(network.place_of("clock_offset_us 1"));
  CHECK(network.newest.counter_name[place] == "clock_offset_us 1" + std::string(31, 'n'));
}

TEST_CASE("a status too long for its frame keeps the bus's losses, none of them as 0") {
  LoudNetwork network;
  REQUIRE(network.until([&] { return network.knows_all_clocks(); }));
  network.service.counters = 60;
  REQUIRE(network.until([&] { return network.place_of("counters_left_out") >= 0; }));
  for (const char* name : {"messages_received", "messages_lost", "messages_late",
                           "messages_rejected", "handler_failures", "publish_failures"}) {
    CAPTURE(name);
    CHECK(network.place_of(name) >= 0);
  }
  CHECK(network.place_of("own_counter_number_100") >= 0);
  CHECK(network.place_of("clock_offset_us") < 0);
}

}  // namespace puck
