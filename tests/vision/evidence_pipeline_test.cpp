#include "common/vision/hypotheses/evidence_pipeline.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <doctest/doctest.h>

#include "common/vision/presets.h"
#include "common/vision/surface_tracker.h"
#include "tests/vision/contour_table.h"

namespace puck {
namespace {

using test::kTableSensor;
using test::kTableSizeModel;

// Shows a puck that glides for 300 ms.
void show_puck(const PacketObserver& observer) {
  HypothesesParams params = default_params();
  params.on_packet = observer;
  SurfaceTracker tracker(kTableSensor, params, kTableSizeModel);
  const PuckContour contour(kTableSensor, kTableSizeModel, params.contour);
  test::MovingContour puck(contour, {80, 100}, {400, 100});
  for (std::int64_t t_us = 0; t_us < 300'000; t_us += 1000) {
    tracker.update(test::packet_of(puck.events(t_us, t_us + 1000), kTableSensor, t_us, t_us));
  }
}

TEST_CASE("an observer sees each packet with all that its evidence follows from") {
  const HypothesesParams params = default_params();
  std::size_t packets = 0;
  std::size_t explained = 0;
  show_puck([&](const Hypothesis& hypothesis, const GameTraits& game) {
    const double nats = evidence_of(hypothesis.packet(), hypothesis.areas(),
                                    hypothesis.expected_density(), game, params.evidence)
                            .sum(params.evidence);
    const double most = params.decision.most_nats;
    ++packets;
    if (hypothesis.nats() == std::clamp(nats, -most, most)) ++explained;
  });
  CHECK(packets > 300);
  CHECK(explained == packets);
}

TEST_CASE("an observed tracker forgets each hypothesis after 0.1 s and begins new ones") {
  std::int64_t oldest_us = 0;
  std::int64_t last_born_us = 0;
  show_puck([&](const Hypothesis& hypothesis, const GameTraits&) {
    oldest_us = std::max(oldest_us, hypothesis.decided_us() - hypothesis.born_us());
    if (hypothesis.origin() != Hypothesis::Origin::kSearch) return;
    last_born_us = std::max(last_born_us, hypothesis.born_us());
  });
  CHECK(oldest_us > 0);
  CHECK(oldest_us < 200'000);
  CHECK(last_born_us > 200'000);
}

}  // namespace
}  // namespace puck
