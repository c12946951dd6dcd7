#include "tools/spy/spy_report.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/monitor/monitor_bench.h"

namespace puck {
namespace {

using Json = nlohmann::json;

BusSnapshot heard(const service_status_t& status) {
  MonitorBench spy({}, MonitorParams::whole_time());
  for (const int seq : {0, 1, 3}) spy.hear(packet_of(10), 7, seq, 1'000'000);
  spy.hear(status, 7, 0, 1'500'000);
  return spy.model.snapshot(2'000'000);
}

}  // namespace

TEST_CASE("the JSON report is flat: every figure has a name") {
  service_status_t status = status_of("puck-camera", "eye", 99);
  status.counter_name = {"events_sent"};
  status.counter_value = {30};
  status.latency_name = {"packet_to_estimate"};
  status.latency_p50_us = {75};
  status.latency_p99_us = {671};
  status.latency_max_us = {24'111};
  status.latency_samples = {500};
  const Json report = Json::parse(json_report(heard(status), "udpm://x", "LEFT"));

  CHECK(report["url"] == "udpm://x");
  CHECK(report["prefix"] == "LEFT");
  CHECK(report["seconds"] == 2.0);
  CHECK(report["messages"] == 4);
  REQUIRE(report["channels"].size() == 2);
  const Json& events = report["channels"][0];
  CHECK(events["channel"] == "PUCK_EVENTS");
  CHECK(events["type"] == "event_packet_t");
  CHECK(events["messages_per_s"] == 1.5);
  CHECK(events["events_per_s"] == 15.0);
  CHECK(events["received"] == 3);
  CHECK(events["lost"] == 1);
  CHECK(events["malformed"] == 0);
  CHECK(events["publishers"] == 1);
  CHECK(events["several_publishers"] == false);
  CHECK(events["age_ms"] == 1000.0);
  REQUIRE(report["publishers"].size() == 2);
  CHECK(report["publishers"][0]["channel"] == "PUCK_EVENTS");
  CHECK(report["publishers"][0]["service"] == "puck-camera");
  CHECK(report["publishers"][0]["pid"] == 99);
  REQUIRE(report["services"].size() == 1);
  const Json& camera = report["services"][0];
  CHECK(camera["service"] == "puck-camera");
  CHECK(camera["state"] == "running");
  CHECK(camera["silent"] == false);
  CHECK(camera["status_age_ms"] == 500.0);
  CHECK(camera["counter_events_sent"] == 30);
  CHECK(camera["latency_packet_to_estimate_p99_us"] == 671);
  for (const char* array : {"channels", "publishers", "services"}) {
    for (const Json& row : report[array]) {
      for (const Json& value : row) CHECK(value.is_primitive());
    }
  }
}

TEST_CASE("rates have one decimal, and ages whole microseconds") {
  BusSnapshot snapshot = heard(status_of("puck-camera"));
  snapshot.channels[0].messages_per_s = 1342.0209510781526;
  snapshot.channels[0].newest_age_us = 647'377;
  const std::string report = json_report(snapshot, "", "");
  CHECK(report.find("\"messages_per_s\": 1342.0,") != std::string::npos);
  CHECK(report.find("\"age_ms\": 647.377\n") != std::string::npos);
}

TEST_CASE("an unmeasured latency has no value") {
  service_status_t status = status_of("puck-tracker");
  status.latency_name = {"sensor_to_estimate"};
  status.latency_p50_us = status.latency_p99_us = status.latency_max_us = {0};
  status.latency_samples = {0};
  const Json tracker = Json::parse(json_report(heard(status), "", ""))["services"][0];
  CHECK(tracker["latency_sensor_to_estimate_p99_us"].is_null());
  CHECK(tracker["latency_sensor_to_estimate_samples"] == 0);
}

TEST_CASE("a channel whose messages were all dropped without our key has no age") {
  MonitorBench spy;
  spy.model.set_unauthenticated(Channel::kGame, 5, "is not sealed", 900'000'000);
  const BusSnapshot snapshot = spy.model.snapshot(900'000'000);
  const Json channel = Json::parse(json_report(snapshot, "", ""))["channels"][0];
  CHECK(channel["age_ms"].is_null());
  CHECK(channel["unauthenticated"] == 5);
  CHECK(text_report(snapshot, 200).find("15m") == std::string::npos);
}

TEST_CASE("text that is not UTF-8 does not break the report") {
  const Json report = Json::parse(json_report(heard(status_of("puck-\xff\xc3")), "", ""));
  CHECK(report["services"][0]["service"].get<std::string>().starts_with("puck-"));
}

TEST_CASE("a silent bus makes an empty report") {
  const Json report = Json::parse(json_report({}, "memq://", ""));
  CHECK(report["messages"] == 0);
  CHECK(report["channels"].empty());
  CHECK(report["services"].empty());
  CHECK(text_report({}, 80).empty());
}

TEST_CASE("the text report has all columns and every word in full at unlimited width") {
  service_status_t status = status_of("puck-camera");
  status.state_text = std::string(200, 'x') + " end";
  const std::string report = text_report(heard(status), 10'000);
  for (const char* text : {"PUCK_EVENTS", "RUNS", "puck-camera", "COUNTERS", "x end"}) {
    CHECK_MESSAGE(report.find(text) != std::string::npos, text);
  }
}

}  // namespace puck
