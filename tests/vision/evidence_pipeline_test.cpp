#include "common/vision/hypotheses/evidence_pipeline.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <doctest/doctest.h>

#include "common/vision/presets.h"
#include "common/vision/surface_tracker.h"
#include "tests/vision/contour_table.h"
#include "tests/vision/random_numbers.h"

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

// Counts the searches in 100 ms of events at random, `events_a_ms` of them all over the image.
class SearchCount {
 public:
  int in_100_ms(int events_a_ms) {
    int searches = 0;
    for (int i = 0; i < 100; ++i) {
      std::vector<Event> events;
      for (int n = 0; n < events_a_ms; ++n) {
        events.push_back({static_cast<std::uint16_t>(random_.below(320)),
                          static_cast<std::uint16_t>(random_.below(240)), 0, 500});
      }
      pipeline_->take({time_us_}, events);
      time_us_ += 1'000;
      SurfaceSnapshot nothing;
      nothing.newest_event = {time_us_};
      pipeline_->step(nothing);
      const SearchRequest wanted = pipeline_->search_wanted();
      if (wanted.region.empty()) continue;
      ++searches;
      pipeline_->take(SearchResult{{time_us_}, wanted, {}});
    }
    return searches;
  }

 private:
  std::unique_ptr<TrackingPipeline> pipeline_ =
      make_pipeline(kTableSensor, default_params(), kTableSizeModel);
  std::int64_t time_us_ = 0;
  test::RandomNumbers random_;
};

TEST_CASE("searches are rare while nothing but noise comes, and frequent again at once") {
  SearchCount count;
  CHECK(count.in_100_ms(10) > 10);
  for (int i = 0; i < 5; ++i) count.in_100_ms(10);
  CHECK(count.in_100_ms(10) <= 2);
  CHECK(count.in_100_ms(100) > 10);
}

TEST_CASE("a puck is as well followed where each pixel makes many events of an edge") {
  test::ContourTable table;
  table.density = 60;
  CHECK(table.glide({400, 60}, 200) < 0.5);
  CHECK(table.estimate().state == TrackState::kTracking);
}

}  // namespace
}  // namespace puck
