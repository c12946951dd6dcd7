#include "common/monitor/service_list.h"

#include <doctest/doctest.h>

#include "tests/monitor/monitor_bench.h"

namespace puck {
namespace {

service_status_t status_with(service_status_t status, std::int64_t session, std::int8_t state) {
  status.session = session;
  status.state = state;
  return status;
}

constexpr std::int8_t kRunning = service_status_t::STATE_RUNNING;
constexpr std::int8_t kStopping = service_status_t::STATE_STOPPING;

}  // namespace

TEST_CASE("a service is shown by its latest status") {
  service_status_t status = status_of("puck-tracker", "eye", 17);
  status.session = 7;
  status.state = service_status_t::STATE_DEGRADED;
  status.state_text = "overload: more events arrive than can be processed";
  status.counter_name = {"events_lost", "estimates"};
  status.counter_value = {3, 500};
  status.latency_name = {"packet_to_estimate"};
  status.latency_p50_us = {75};
  status.latency_p99_us = {671};
  status.latency_max_us = {24'111};
  status.latency_samples = {500};
  ServiceList services({});
  services.hear(status_with(status_of("puck-tracker", "eye", 17), 7, kRunning), 1000);
  services.hear(status, 2000);

  const std::vector<ServiceRow> rows = services.rows(300'000);
  REQUIRE(rows.size() == 1);
  const ServiceRow& row = rows[0];
  CHECK(row.service == "puck-tracker");
  CHECK(row.host == "eye");
  CHECK(row.pid == 17);
  CHECK(row.version == "0.1.0");
  CHECK(row.state == ServiceState::kDegraded);
  CHECK(row.state_text == "overload: more events arrive than can be processed");
  CHECK(row.uptime_us == 5'000'000);
  CHECK(row.status_age_us == 298'000);
  CHECK_FALSE(row.silent);
  CHECK(row.counters ==
        std::vector<std::pair<std::string, std::int64_t>>{{"events_lost", 3}, {"estimates", 500}});
  REQUIRE(row.latencies.size() == 1);
  const StatusLatency& latency = row.latencies[0];
  CHECK(latency.name == "packet_to_estimate");
  CHECK(latency.p50_us == 75);
  CHECK(latency.p99_us == 671);
  CHECK(latency.max_us == 24'111);
}

TEST_CASE("a service is silent after half a second, unless it announced its stop") {
  ServiceList services({});
  services.hear(status_with(status_of("puck-arm"), 7, kRunning), 0);
  services.hear(status_with(status_of("puck-bridge"), 8, kStopping), 0);
  CHECK_FALSE(services.rows(500'000)[0].silent);
  const std::vector<ServiceRow> rows = services.rows(500'001);
  CHECK(rows[0].silent);
  CHECK(state_of(rows[0]) == "silent");
  CHECK_FALSE(rows[1].silent);
  CHECK(state_of(rows[1]) == "stopped");
}

TEST_CASE("a killed service stays listed until a new run of it publishes") {
  ServiceList services({});
  services.hear(status_with(status_of("puck-arm", "robot", 10), 7, kRunning), 0);
  CHECK(services.rows(30'000'000).size() == 1);
  services.hear(status_with(status_of("puck-arm", "robot", 11), 8, kRunning), 30'000'000);
  const std::vector<ServiceRow> rows = services.rows(30'000'000);
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].pid == 11);
  // Its channels may still be on the screen.
  PublisherRow publisher{.session = 7};
  services.name(publisher);
  CHECK(publisher.pid == 10);
}

TEST_CASE("two services of one name that both publish are both listed") {
  ServiceList services({});
  for (int i = 0; i < 3; ++i) {
    services.hear(status_with(status_of("puck-arm", "robot", 11), 8, kRunning), i * 100'000);
    services.hear(status_with(status_of("puck-arm", "robot", 10), 7, kRunning), i * 100'000);
  }
  const std::vector<ServiceRow> rows = services.rows(200'000);
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].pid == 10);
  CHECK(rows[1].pid == 11);
}

TEST_CASE("a service gone for long is dropped, and 1000 take the room of 64") {
  ServiceList services({});
  services.hear(status_with(status_of("puck-arm"), 7, kRunning), 0);
  CHECK(services.rows(60'000'001).empty());
  for (int i = 0; i < 1000; ++i) {
    services.hear(status_with(status_of("puck-" + std::to_string(i)), 10 + i, kRunning), i);
  }
  CHECK(services.rows(1000).size() == 64);
}

}  // namespace puck
