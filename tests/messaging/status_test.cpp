#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <thread>
#include <utility>

#include <doctest/doctest.h>
#include <unistd.h>

#include "common/messaging/status_check.h"
#include "common/messaging/status_reporter.h"
#include "tests/support/skewed_machine.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_url.h"
#include "tests/support/wait_until.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

void no_details(StatusReport&) {}

}  // namespace

TEST_CASE("a status has the sender's identity, state and counters") {
  Bus bus({.url = "memq://"});
  StatusReporter reporter(bus, "puck-tracker");
  std::vector<service_status_t> heard;
  bus.subscribe<service_status_t>(
      [&](const service_status_t& status, const Receipt&) { heard.push_back(status); });
  REQUIRE(bus.start({}, [](const std::string&) {}));

  reporter.set_state(ServiceState::kWaiting, "for events\non PUCK_EVENTS");
  reporter.poll([](StatusReport& report) {
    report.counters = {{"packets_received", 12}, {"packets_lost", 0}};
    report.latencies = {{"packet_to_estimate", 40, 200, 350, 1000}};
  });
  bus.handle(milliseconds(100));

  REQUIRE(heard.size() == 1);
  const service_status_t& status = heard.front();
  CHECK(status.service == "puck-tracker");
  CHECK_FALSE(status.host.empty());
  CHECK(status.pid == getpid());
  CHECK(status.version == PUCK_VERSION);
  CHECK(status.state == service_status_t::STATE_WAITING);
  CHECK(status.state_text == "for events on PUCK_EVENTS");
  CHECK(status.counter_name == std::vector<std::string>{"packets_received", "packets_lost"});
  CHECK(status.counter_value == std::vector<std::int64_t>{12, 0});
  CHECK(status.latency_name == std::vector<std::string>{"packet_to_estimate"});
  CHECK(status.latency_p99_us == std::vector<std::int64_t>{200});
  CHECK(status.latency_samples == std::vector<std::int64_t>{1000});
}

TEST_CASE("a status fits one frame with any number of counters, and gives the number left out") {
  const TemporaryFolder folder;
  const auto key = folder / "key";
  std::ofstream(key) << std::string(32, 'k');
  std::filesystem::permissions(key, std::filesystem::perms::owner_read);
  Bus bus({.url = "memq://", .prefix = "ABCDEFGHIJKLMNOP", .key_file = key.string()});
  StatusReporter reporter(bus, "puck-tracker");
  std::vector<service_status_t> heard;
  bus.subscribe<service_status_t>(
      [&](const service_status_t& status, const Receipt&) { heard.push_back(status); });
  REQUIRE(bus.start({}, [](const std::string&) {}));
  reporter.set_state(ServiceState::kDegraded, std::string(255, 's'));
  reporter.poll([](StatusReport& report) {
    report.counters = {{"first", 1}, {"second", 2}};
    report.counters.resize(60, {std::string(30, 'x'), 7});
    report.counters.resize(1000, {std::string(510, 'y'), 8});
    report.latencies.assign(4, {"packet_to_estimate", 40, 200, 350, 1000});
  });
  bus.handle(milliseconds(100));
  REQUIRE(heard.size() == 1);
  const service_status_t& status = heard.front();
  const auto datagram = 8 + channel_name(Channel::kStatus, bus.prefix()).size() + 1 +
                        bus.overhead_bytes() + static_cast<std::size_t>(status.getEncodedSize());
  CHECK(datagram <= 1472);
  CHECK(datagram > 1472 - 60);  // What there is room for is said.
  CHECK(status.counter_name.front() == "first");
  CHECK(status.counter_name.back() == "counters_left_out");
  CHECK(status.counter_value.back() + std::ssize(status.counter_name) - 1 == 1000);
}

TEST_CASE("a counter too long for the frame does not displace shorter ones") {
  Bus bus({.url = "memq://"});
  StatusReporter reporter(bus, "puck-tracker");
  service_status_t newest{};
  bus.subscribe<service_status_t>(
      [&](const service_status_t& status, const Receipt&) { newest = status; });
  REQUIRE(bus.start({}, [](const std::string&) {}));
  reporter.poll([](StatusReport& report) {
    for (int i = 0; i < 5; ++i) report.counters.emplace_back(std::string(200, 'x'), i);
    report.counters.emplace_back(std::string(255, 'y'), 5);
    report.counters.emplace_back(std::string(255, 'y'), 6);
    report.counters.emplace_back("short", 7);
  });
  bus.handle(milliseconds(100));
  REQUIRE(newest.counter_name.size() > 2);
  CHECK(newest.counter_name.back() == "counters_left_out");
  CHECK(newest.counter_value.back() > 0);
  CHECK(newest.counter_name[newest.counter_name.size() - 2] == "short");
}

TEST_CASE("many runs are answered in turn") {
  const std::string url = private_lcm_url();
  Bus bus({.url = url});
  StatusReporter reporter(bus, "puck-tracker");
  std::set<std::int64_t> answered;
  std::size_t most = 0;
  bus.subscribe<service_status_t>([&](const service_status_t& status, const Receipt&) {
    if (status.session != bus.session()) return;
    answered.insert(status.pong_session.begin(), status.pong_session.end());
    most = std::max(most, status.pong_session.size());
  });
  REQUIRE(bus.start({}, [](const std::string&) {}));
  std::vector<std::unique_ptr<SkewedMachine>> others;
  for (std::int64_t session = 1; session <= 20; ++session) {
    others.push_back(std::make_unique<SkewedMachine>(url, session, 0));
  }
  for (int i = 0; i < 1000 && answered.size() < others.size(); ++i) {
    for (auto& other : others) other->serve();
    bus.handle(milliseconds(5));
    reporter.poll(no_details);
  }
  CHECK(answered.size() == others.size());
  CHECK(most == 8);
}

TEST_CASE("a status is published at once on a change of state, else every 100 ms") {
  Bus bus({.url = "memq://"});
  StatusReporter reporter(bus, "puck-arm");
  REQUIRE(bus.start({}, [](const std::string&) {}));
  const auto published = [&] { return bus.counters<service_status_t>().published; };
  const auto began = std::chrono::steady_clock::now();

  reporter.poll(no_details);
  CHECK(published() == 1);
  reporter.set_state(ServiceState::kRunning);
  reporter.poll(no_details);
  CHECK(published() == 2);
  reporter.poll(no_details);
  reporter.set_state(ServiceState::kRunning, "a text alone waits for its turn");
  reporter.poll(no_details);
  const bool quick = std::chrono::steady_clock::now() - began < milliseconds(100);
  if (quick) CHECK(published() == 2);
  CHECK(wait_until([&] {
    reporter.poll(no_details);
    return published() >= 3;
  }));
  const auto before = published();
  reporter.stop(no_details);
  CHECK(published() == before + 1);
  CHECK(reporter.state() == ServiceState::kStopping);
}

TEST_CASE("statuses of others are answered with pongs") {
  const std::string url = private_lcm_url();
  Bus first({.url = url});
  Bus second({.url = url});
  StatusReporter one(first, "puck-camera");
  StatusReporter two(second, "puck-tracker");
  std::vector<service_status_t> heard;
  first.subscribe<service_status_t>([&](const service_status_t& status, const Receipt&) {
    if (status.service == "puck-tracker") heard.push_back(status);
  });
  REQUIRE(first.start({}, [](const std::string&) {}));
  REQUIRE(second.start({}, [](const std::string&) {}));
  one.poll(no_details);
  second.handle(milliseconds(1000));
  two.poll(no_details);
  for (int i = 0; i < 100 && heard.empty(); ++i) first.handle(milliseconds(20));

  REQUIRE(heard.size() == 1);
  REQUIRE(heard[0].pong_session == std::vector<std::int64_t>{first.session()});
  CHECK(heard[0].pong_utime[0] > 0);
  CHECK(heard[0].pong_received_utime[0] >= heard[0].pong_utime[0]);
}

TEST_CASE("services know each other's clocks from their statuses, and their own clock at once") {
  const std::string url = private_lcm_url();
  Bus first({.url = url});
  Bus second({.url = url});
  StatusReporter one(first, "puck-camera");
  StatusReporter two(second, "puck-tracker");
  REQUIRE(first.start({}, [](const std::string&) {}));
  REQUIRE(second.start({}, [](const std::string&) {}));
  CHECK_FALSE(one.clock_of(second.session()));
  CHECK(one.clock_of(first.session())->ahead_us == 0);
  for (int i = 0; i < 1000 && !(one.clock_of(second.session()) && two.clock_of(first.session()));
       ++i) {
    one.poll(no_details);
    two.poll(no_details);
    first.handle(milliseconds(5));
    second.handle(milliseconds(5));
  }
  for (const SenderClock& clock : {one.clock_of(second.session()), two.clock_of(first.session())}) {
    REQUIRE(clock);
    CHECK(clock->ahead_us == 0);
  }
}

TEST_CASE("a flood of new runs locks out no regular peer, and is answered at 50 Hz") {
  const std::string url = private_lcm_url();
  Bus bus({.url = url});
  StatusReporter reporter(bus, "puck-arm");
  service_status_t newest{};
  SkewedMachine friendly(url, 4711, 0);
  bus.subscribe<service_status_t>([&](const service_status_t& status, const Receipt&) {
    if (status.session == bus.session()) newest = status;
  });
  REQUIRE(bus.start({}, [](const std::string&) {}));
  const auto answers_friendly = [&] {
    return std::find(newest.pong_session.begin(), newest.pong_session.end(), 4711) !=
           newest.pong_session.end();
  };
  const auto serve_until_answered = [&] {
    const auto end = std::chrono::steady_clock::now() + milliseconds(10'000);
    while (!answers_friendly() && std::chrono::steady_clock::now() < end) {
      friendly.serve();
      reporter.poll(no_details);
      bus.handle(milliseconds(2));
    }
  };
  serve_until_answered();
  std::this_thread::sleep_for(milliseconds(30));
  friendly.serve();
  std::this_thread::sleep_for(milliseconds(30));
  friendly.serve();
  const auto before = bus.counters<service_status_t>().published;
  const auto began = std::chrono::steady_clock::now();
  for (std::int64_t session = 10'000; session < 10'300; ++session) {
    SkewedMachine(url, session, 0).serve();
    if (session % 20 == 0) friendly.serve();
    bus.handle(milliseconds(1));
    reporter.poll(no_details);
  }
  const auto took = std::chrono::steady_clock::now() - began;
  CHECK(bus.counters<service_status_t>().published - before <= took / milliseconds(20) + 2);
  newest = {};
  serve_until_answered();
  CHECK(answers_friendly());
}

TEST_CASE("new runs are answered two at a time and soon, with any number of known ones") {
  const std::string url = private_lcm_url();
  Bus bus({.url = url});
  StatusReporter reporter(bus, "puck-arm");
  std::set<std::int64_t> heard;
  std::vector<std::vector<std::int64_t>> answered;  // in each STATUS of ours
  bus.subscribe<service_status_t>([&](const service_status_t& status, const Receipt&) {
    if (status.session == bus.session()) {
      answered.push_back(status.pong_session);
    } else {
      heard.insert(status.session);
    }
  });
  REQUIRE(bus.start({}, [](const std::string&) {}));
  std::vector<std::unique_ptr<SkewedMachine>> known;
  for (std::int64_t session = 1; session <= 10; ++session) {
    known.push_back(std::make_unique<SkewedMachine>(url, session, 0));
  }
  for (int round = 0; round < 5; ++round) {
    for (auto& machine : known) machine->serve();
    std::this_thread::sleep_for(milliseconds(25));
    bus.handle(milliseconds(0));
    reporter.poll(no_details);
  }
  REQUIRE(heard.size() == known.size());
  while (bus.handle(milliseconds(50)) > 0) continue;
  answered.clear();

  for (std::int64_t session = 101; session <= 105; ++session) {
    SkewedMachine(url, session, 0).serve();
  }
  for (int i = 0; i < 100 && heard.size() < known.size() + 5; ++i) bus.handle(milliseconds(20));
  // Each of them is due, even before the 100 ms are over.
  for (std::size_t i = 1; i <= 3; ++i) {
    std::this_thread::sleep_for(milliseconds(25));
    const auto before = bus.counters<service_status_t>().published;
    reporter.poll(no_details);
    CHECK(bus.counters<service_status_t>().published == before + 1);
    for (int j = 0; j < 100 && answered.size() < i; ++j) bus.handle(milliseconds(20));
  }
  REQUIRE(answered.size() == 3);
  std::set<std::int64_t> new_ones;
  for (const auto& sessions : answered) {
    CHECK(sessions.size() == 8);
    for (const std::int64_t session : sessions) {
      if (session > 100) new_ones.insert(session);
    }
    CHECK(std::count_if(sessions.begin(), sessions.end(), [](auto id) { return id <= 10; }) >= 6);
  }
  CHECK(new_ones == std::set<std::int64_t>{101, 102, 103, 104, 105});
}

TEST_CASE("problems of peers come before a service's own state text, and delay it") {
  Bus bus({.url = "memq://"});
  StatusReporter reporter(bus, "puck-arm");
  service_status_t newest{};
  bus.subscribe<service_status_t>(
      [&](const service_status_t& status, const Receipt&) { newest = status; });
  REQUIRE(bus.start({}, [](const std::string&) {}));
  const auto said = [&] {
    reporter.poll(no_details);
    bus.handle(milliseconds(100));
    return std::pair(static_cast<ServiceState>(newest.state), newest.state_text);
  };
  reporter.set_state(ServiceState::kRunning, "plays");
  reporter.set_trouble_of_peers(ServiceState::kWaiting, "puck-bridge is silent");
  CHECK(said() == std::pair(ServiceState::kWaiting, std::string("puck-bridge is silent; plays")));
  CHECK(reporter.state() == ServiceState::kRunning);
  reporter.set_trouble_of_peers(ServiceState::kDegraded, "two bridges");
  CHECK(said() == std::pair(ServiceState::kDegraded, std::string("two bridges; plays")));
  reporter.set_state(ServiceState::kDegraded, "stopped");
  reporter.set_trouble_of_peers(ServiceState::kWaiting, "puck-bridge is silent");
  CHECK(said() ==
        std::pair(ServiceState::kDegraded, std::string("puck-bridge is silent; stopped")));
  reporter.set_trouble_of_peers(ServiceState::kWaiting, "");
  CHECK(said() == std::pair(ServiceState::kDegraded, std::string("stopped")));
}

TEST_CASE("a check finds a running service, and reports a missing or degraded one") {
  const std::string url = private_lcm_url();
  Bus bus({.url = url});
  StatusReporter reporter(bus, "puck-bridge");
  REQUIRE(bus.start({}, [](const std::string&) {}));
  reporter.set_state(ServiceState::kRunning);

  const auto check_while_publishing = [&](const std::string& service, milliseconds timeout) {
    const std::jthread publisher([&](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        reporter.poll(no_details);
        bus.handle(milliseconds(10));
      }
    });
    return check_service({.url = url}, service, timeout, {});
  };
  const StatusCheck well = check_while_publishing("puck-bridge", milliseconds(5000));
  CHECK(well.healthy);
  CHECK(well.text.find("puck-bridge on ") == 0);
  CHECK(well.text.find("is running") != std::string::npos);

  CHECK_FALSE(check_while_publishing("puck-arm", milliseconds(300)).healthy);
  CHECK(check_while_publishing("puck-arm", milliseconds(300)).text ==
        "no puck-arm is heard on " + url);

  reporter.set_state(ServiceState::kDegraded, "no calibration");
  // On a busy machine one check may time out.
  const auto give_up_at = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  bool is_said = false;
  while (!is_said && std::chrono::steady_clock::now() < give_up_at) {
    const StatusCheck unwell = check_while_publishing("puck-bridge", milliseconds(300));
    CHECK_FALSE(unwell.healthy);
    is_said = unwell.text.find("is degraded: no calibration") != std::string::npos;
  }
  CHECK(is_said);
}

}  // namespace puck
