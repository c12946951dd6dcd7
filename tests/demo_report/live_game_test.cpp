#include "tools/demo_report/live_game.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

service_status_t status_of(const char* service, std::int64_t estimates, std::int64_t latency_us) {
  service_status_t status{};
  status.service = service;
  status.counter_name = {"events_received", "estimates"};
  status.counter_value = {1'000'000, estimates};
  status.latency_name = {"packet_to_estimate"};
  status.latency_p50_us = {latency_us};
  status.latency_samples = {1};
  return status;
}

}  // namespace

TEST_CASE(
    "a game's progress line shows shots, saves, the rate since the last line and the latency") {
  LiveGame game;
  CHECK(game.line(1) == "   1 s   shots -   saves -   - estimates/s   median latency - us");
  ground_truth_t truth{};
  truth.shots = 3;
  truth.saves = 2;
  game.take(truth);
  game.take(status_of("puck-tracker", 4000, 91));
  CHECK(game.line(2) == "   2 s   shots 3   saves 2   4000 estimates/s   median latency 91 us");
  game.take(status_of("puck-tracker", 16'000, 90));
  game.take(status_of("puck-bridge", 1, 1));
  CHECK(game.line(6) == "   6 s   shots 3   saves 2   3000 estimates/s   median latency 90 us");
}

}  // namespace puck
