#include "tools/view/live/live_messages.h"

#include <string>

#include <doctest/doctest.h>

#include "tests/monitor/monitor_bench.h"
#include "tools/view/live/doctor_run.h"

namespace puck {
namespace {

std::string all_of(const std::vector<ViewMessage>& messages) {
  std::string text;
  for (const ViewMessage& message : messages) text += message.text + '\n';
  return text;
}

bool says(MonitorBench& bench, std::int64_t now_us, const std::string& words,
          LiveFacts facts = {}) {
  const std::string all = all_of(live_messages(bench.model.snapshot(now_us), facts));
  CAPTURE(all);
  return all.find(words) != std::string::npos;
}

LiveFacts with_events() { return {.sensor = {640, 480}, .events_age_us = 1000}; }

}  // namespace

TEST_CASE("a bus without messages is told after 2 s, with what puck-doctor says") {
  MonitorBench bench;
  CHECK(live_messages(bench.model.snapshot(1'900'000), {}).empty());
  CHECK(says(bench, 2'100'000, "no message arrives on this bus; asking puck-doctor why"));
  CHECK(says(bench, 2'100'000, "under the prefix LEFT", {.prefix = "LEFT"}));
  const std::vector<ViewMessage> doctor{{ViewMessage::Level::kError, "route: none"}};
  CHECK(says(bench, 2'100'000, "route: none", {.doctor = doctor}));
}

TEST_CASE("a network that is not there is told with its reason") {
  MonitorBench bench;
  CHECK(says(bench, 0, "not on the bus yet: no route", {.network_problem = "no route"}));
}

TEST_CASE("a missing camera, a waiting one and one without events are told apart") {
  MonitorBench bench;
  for (std::int64_t seq = 0; seq < 30; ++seq) {
    bench.hear(status_of("puck-tracker"), 1, seq, seq * 100'000);
  }
  CHECK(says(bench, 2'950'000, "no puck-camera runs on this bus"));
  bench.hear(status_of("puck-camera"), 2, 0, 2'900'000);
  CHECK(says(bench, 2'950'000, "puck-camera runs, but no event has arrived"));
  service_status_t waiting = status_of("puck-camera");
  waiting.state = service_status_t::STATE_WAITING;
  waiting.state_text = "for a connection to localhost:3333";
  bench.hear(waiting, 2, 1, 2'920'000);
  CHECK(says(bench, 2'950'000, "waiting, for a connection to localhost:3333"));
  CHECK_FALSE(says(bench, 2'950'000, "no event has arrived"));
}

TEST_CASE("two cameras at once are named, with the remedy") {
  MonitorBench bench;
  bench.hear(status_of("puck-camera", "eye", 7), 1, 0, 0);
  bench.hear(status_of("puck-camera", "ear", 8), 2, 0, 0);
  for (std::int64_t seq = 0; seq < 5; ++seq) {
    bench.hear(packet_of(1), 1, seq, seq * 10'000);
    bench.hear(packet_of(1), 2, seq, seq * 10'000 + 5'000);
  }
  CHECK(says(bench, 50'000,
             "several cameras publish on PUCK_EVENTS: puck-camera (pid 7 on eye), "
             "puck-camera (pid 8 on ear). Shown is the one heard first.",
             with_events()));
}

TEST_CASE("a camera under another prefix is told with the option that shows it") {
  MonitorBench bench;
  BusSnapshot snapshot = bench.model.snapshot(0);
  snapshot.network.foreign_traffic.push_back({.what = "channel \"RIGHT_PUCK_EVENTS\""});
  snapshot.network.foreign_traffic.push_back({.what = "channel \"RIGHT_PUCK_STATUS\""});
  CHECK(all_of(live_messages(snapshot, {})) ==
        "another camera publishes on RIGHT_PUCK_EVENTS; to see it, run puck-view with --prefix "
        "RIGHT\n");
}

TEST_CASE("events without estimates and a tracker of another size are told") {
  MonitorBench bench;
  for (std::int64_t seq = 0; seq < 30; ++seq) bench.hear(packet_of(1), 1, seq, seq * 100'000);
  CHECK(says(bench, 2'950'000, "is puck-tracker running on this bus?", with_events()));
  LiveFacts facts = with_events();
  facts.other_sensor = SensorSize{320, 240};
  CHECK(says(bench, 2'950'000, "640 x 480 px, but the tracker works on 320 x 240 px", facts));
}

TEST_CASE("losses and services with trouble are told, healthy ones are not") {
  MonitorBench bench;
  bench.hear(status_of("puck-tracker"), 3, 0, 0);
  bench.hear(packet_of(1), 1, 0, 0);
  CHECK(live_messages(bench.model.snapshot(10'000), with_events()).empty());
  bench.hear(packet_of(1), 1, 3, 20'000);
  CHECK(says(bench, 30'000, "PUCK_EVENTS: 2 messages lost", with_events()));
  CHECK(says(bench, 700'000, "puck-tracker on robot: silent", with_events()));
}

TEST_CASE("the doctor's faults become errors with their remedy, its notes warnings") {
  const auto messages = doctor_messages(R"({"findings": [
    {"check": "ttl", "verdict": "ok", "text": "fine", "mend": null},
    {"check": "route", "verdict": "wrong", "text": "no route", "mend": "ip route add"},
    {"check": "mtu", "verdict": "note", "text": "small", "mend": null}]})");
  REQUIRE(messages.size() == 2);
  CHECK(messages[0].level == ViewMessage::Level::kError);
  CHECK(messages[0].text == "route: no route. To mend it: ip route add");
  CHECK(messages[1].level == ViewMessage::Level::kWarning);
  CHECK(messages[1].text == "mtu: small");
  CHECK(doctor_messages("")[0].text.find("gave no report") != std::string::npos);
  CHECK(doctor_messages(R"({"findings": [7, {"verdict": 3}]})").size() == 1);
  CHECK(doctor_messages(R"({"findings": []})")[0].text.find("finds nothing wrong") !=
        std::string::npos);
}

}  // namespace puck
