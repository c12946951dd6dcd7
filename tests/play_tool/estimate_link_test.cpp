#include "tools/play/estimate_link.h"

#include <stdexcept>
#include <vector>

#include <doctest/doctest.h>

#include "tests/play_tool/play_bench.h"

namespace puck {
namespace {

struct Traffic {
  int sent = 0;
  std::vector<bool> arrived;
};

// 200 s of estimates, numbered.
Traffic run(const EstimateLinkParams& params) {
  EstimateLink link(params, 5);
  Traffic traffic;
  for (std::int64_t now_us = 0; now_us < 200'000'000; now_us += kStepUs) {
    if (link.is_due(now_us)) {
      PublishedEstimate estimate;
      estimate.seq = traffic.sent++;
      traffic.arrived.push_back(false);
      link.send(estimate, now_us);
    }
    while (const auto estimate = link.receive(now_us)) {
      traffic.arrived[static_cast<std::size_t>(estimate->seq)] = true;
    }
  }
  return traffic;
}

double lost_percent(const Traffic& traffic) {
  int lost = 0;
  for (const bool arrived : traffic.arrived) lost += arrived ? 0 : 1;
  return 100.0 * lost / traffic.sent;
}

double mean_burst(const Traffic& traffic) {
  int bursts = 0;
  int lost = 0;
  bool before = true;
  for (const bool arrived : traffic.arrived) {
    if (!arrived) ++lost;
    if (before && !arrived) ++bursts;
    before = arrived;
  }
  return static_cast<double>(lost) / bursts;
}

TEST_CASE("Estimates are due at their rate, even where it is no multiple of the step") {
  CHECK(run({.rate_hz = 1000, .latency_us = 0}).sent == 200'000);
  CHECK(run({.rate_hz = 30, .latency_us = 0}).sent == 6'000);
  CHECK(run({.rate_hz = 5000, .latency_us = 0}).sent == 1'000'000);
}

TEST_CASE("An estimate arrives after the latency, and not before") {
  EstimateLink link({.rate_hz = 1000, .latency_us = 4000}, 1);
  link.send({}, 10'000);
  link.send({}, 10'000, 1'000);
  CHECK_FALSE(link.receive(13'999));
  CHECK(link.receive(14'000));
  CHECK_FALSE(link.receive(14'999));
  CHECK(link.receive(15'000));
  CHECK_FALSE(link.receive(1'000'000));
}

TEST_CASE("The share of lost estimates is the specified one, single or in bursts") {
  CHECK(lost_percent(run({.latency_us = 0, .loss_percent = 0})) == 0);
  CHECK(lost_percent(run({.latency_us = 0, .loss_percent = 100})) == 100);
  const Traffic single = run({.latency_us = 0, .loss_percent = 25});
  CHECK(lost_percent(single) == doctest::Approx(25).epsilon(0.02));
  CHECK(mean_burst(single) == doctest::Approx(1 / 0.75).epsilon(0.02));
  const Traffic bursts = run({.latency_us = 0, .loss_percent = 25, .burst_us = 20'000});
  CHECK(lost_percent(bursts) == doctest::Approx(25).epsilon(0.1));
  CHECK(mean_burst(bursts) == doctest::Approx(20).epsilon(0.1));
}

TEST_CASE("A link refuses impossible values, by the option's name") {
  CHECK_THROWS_WITH(EstimateLink({.rate_hz = 0}, 1),
                    "--rate-hz must be between 1 and 5000, got 0.000000");
  CHECK_THROWS_AS(EstimateLink({.latency_us = -1}, 1), std::invalid_argument);
  CHECK_THROWS_AS(EstimateLink({.loss_percent = 101}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace puck
