#include <algorithm>
#include <atomic>
#include <memory>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include "common/runtime/tracking_thread.h"
#include "common/vision/paper/paper_presets.h"
#include "common/vision/paper/puck_search.h"
#include "tests/runtime/tracking_fixtures.h"
#include "tests/support/wait_until.h"
#include "tests/vision/puck_picture.h"

namespace puck {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using namespace test;

// A pipeline's record; written by the tracking thread, read after its end.
struct Life {
  std::vector<std::int64_t> event_times;
  std::vector<std::size_t> events_at_step;  // how many it had taken at each step
  std::vector<Timestamp> stamps;            // of each step
  std::int64_t pieces_across = 0;           // with a multiple of the period inside
  std::atomic<int> results{0};              // of searches
  std::atomic<int> steps_during_search{0};  // at most
};

// Requests single events and searches, and only records them.
class LivingPipeline final : public TrackingPipeline {
 public:
  LivingPipeline(Life& life, const Region& search) : life_(life), search_(search) {}

  bool needs_events() const override { return true; }
  std::int64_t decision_period_us() const override { return 100; }
  void take(Timestamp start, std::span<const Event> events) override {
    for (const Event& event : events) life_.event_times.push_back(start.us + event.offset_us);
    const std::int64_t first = start.us + events.front().offset_us;
    const std::int64_t last = start.us + events.back().offset_us;
    if ((first + 99) / 100 != (last + 99) / 100) ++life_.pieces_across;
  }
  Region region_needed() const override { return {}; }
  PuckEstimate step(const SurfaceSnapshot& snapshot) override {
    life_.events_at_step.push_back(life_.event_times.size());
    life_.stamps.push_back(snapshot.newest_event);
    ++steps_;
    PuckEstimate estimate;
    estimate.newest_event = snapshot.newest_event;
    return estimate;
  }
  SearchRequest search_wanted() override {
    steps_ = 0;
    return {search_};
  }
  void take(const SearchResult& result) override {
    CHECK(result.request.region == search_);
    life_.steps_during_search = std::max(life_.steps_during_search.load(), steps_);
    ++life_.results;
  }

 private:
  Life& life_;
  Region search_;
  int steps_ = 0;
};

}  // namespace

TEST_CASE("single events arrive in order, in pieces, and before the step on their snapshot") {
  SharedSurface surface(kSensor, {});
  Published published;
  Life life;
  std::vector<std::int64_t> sent;
  {
    const TrackingThread thread(surface, std::make_unique<LivingPipeline>(life, Region{}),
                                default_search(), {.heartbeat = milliseconds(5)},
                                [&](const TrackedEstimate& e) { published.add(e); });
    // Events are requested in the first step, which needs a new event.
    surface.update({{0}, {{1, 1, 0, 0}}}, {});
    REQUIRE(wait_until([&] {
      const auto all = published.all();
      return !all.empty() && all.back().estimate.newest_event == Timestamp{0} &&
             all.back().tracking_started != std::chrono::system_clock::time_point{};
    }));
    for (int i = 1; i <= 100; ++i) {
      EventPacket packet{{i * 1000}, {}};
      for (std::uint32_t k = 0; k < 50; ++k) {
        const auto x = static_cast<std::uint16_t>((i * 7 + k * 13) % 160);
        packet.events.push_back({x, 60, 1, k * 20});
        sent.push_back(packet.start.us + k * 20);
      }
      surface.update(packet, {});
      if (i % 10 == 0) std::this_thread::sleep_for(milliseconds(1));
    }
    surface.update({{101'000}, {{50, 50, 1, 0}}}, {});
    sent.push_back(101'000);
    CHECK(wait_until(
        [&] { return published.all().back().estimate.newest_event == Timestamp{101'000}; }));
  }
  CHECK(surface.events_thinned() == 0);
  CHECK(life.event_times == sent);
  CHECK(life.pieces_across == 0);
  for (std::size_t i = 0; i < life.stamps.size(); ++i) {
    const auto shown = std::upper_bound(sent.begin(), sent.end(), life.stamps[i].us);
    REQUIRE(life.events_at_step[i] == static_cast<std::size_t>(shown - sent.begin()));
  }
}

TEST_CASE("a slow tracking thread gets fewer events, and the others are counted") {
  SharedSurface surface(kSensor, {});
  Published published;
  Life life;
  constexpr int kPackets = 40;
  constexpr std::uint32_t kEach = 1000;
  {
    std::atomic<bool> stuck{true};
    std::atomic<int> steps{0};
    const TrackingThread thread(
        surface, std::make_unique<LivingPipeline>(life, Region{}), default_search(),
        {.heartbeat = milliseconds(5)}, [&](const TrackedEstimate& e) {
          // From the first estimate with an event on, until all events have come.
          while (stuck && e.tracking_started != std::chrono::system_clock::time_point{}) {
            ++steps;
            std::this_thread::sleep_for(microseconds(100));
          }
          published.add(e);
        });
    surface.update({{0}, {{1, 1, 0, 0}}}, {});
    REQUIRE(wait_until([&] { return steps > 0; }));
    for (int i = 1; i <= kPackets; ++i) {
      EventPacket packet{{i * 1000}, {}};
      for (std::uint32_t k = 0; k < kEach; ++k) packet.events.push_back({5, 5, 1, k});
      surface.update(packet, {});
    }
    stuck = false;
    CHECK(wait_until([&] {
      const auto all = published.all();
      return !all.empty() && all.back().estimate.newest_event == Timestamp{kPackets * 1000 + 999};
    }));
  }
  const auto taken = static_cast<std::int64_t>(life.event_times.size());
  CHECK(taken <= static_cast<std::int64_t>(SharedSurface::kQueuedEvents));
  CHECK(taken > static_cast<std::int64_t>(SharedSurface::kQueuedEvents) * 9 / 10);
  CHECK(taken + surface.events_thinned() == kPackets * kEach);
  CHECK(std::is_sorted(life.event_times.begin(), life.event_times.end()));
  // The newest ones are there, too, only fewer of them.
  CHECK(life.event_times.back() > 10'000);
}

TEST_CASE("tracking and its heartbeat continue during a search of a large surface") {
  // A search of all of it takes far longer than the surface's copy, and about a hundred times as
  // long as a step, with some twenty steps in between.
  constexpr SensorSize kLarge{SensorSize::kMax, SensorSize::kMax};
  constexpr int kManySteps = 60;
  const PuckPipelineParams params = correlation_params();
  SharedSurface surface(kLarge, params.eros);
  Published published;
  Life life;
  {
    const TrackingThread thread(
        surface, std::make_unique<LivingPipeline>(life, Region::all_of(kLarge)),
        PuckSearch(kLarge, params, kSizeModel), {.heartbeat = milliseconds(2)},
        [&](const TrackedEstimate& e) { published.add(e); });
    // A single search may meet a busy machine.
    for (int i = 1; life.steps_during_search < kManySteps && life.results < 20; ++i) {
      surface.update({{i * 1000}, {{100, 100, 1, 0}, {1500, 1500, 1, 1}}}, {});
      std::this_thread::sleep_for(microseconds(50));
    }
  }
  CHECK(life.steps_during_search >= kManySteps);
  CHECK(published.count() >= 10);
}

TEST_CASE("the result of a search is published even without new events") {
  const PuckPipelineParams params = correlation_params();
  // A small region is searched at once, a large one by the worker.
  for (const SensorSize sensor : {SensorSize{120, 100}, SensorSize{640, 480}}) {
    CAPTURE(sensor.width);
    SharedSurface surface(sensor, params.eros);
    Published published;
    const TrackingThread thread(surface, make_pipeline(sensor, params, kSizeModel),
                                PuckSearch(sensor, params, kSizeModel), {},
                                [&](const TrackedEstimate& e) { published.add(e); });
    surface.update({{1000}, test::contour_events(sensor, {60, 50}, kSizeModel.at({}), 150)}, {});
    CHECK(wait_until([&] {
      const auto all = published.all();
      return !all.empty() && all.back().estimate.state == TrackState::kTracking &&
             all.back().estimate.newest_event == Timestamp{1000};
    }));
  }
}

}  // namespace puck
