// Bounds on a step's time in the event thread, and the work that it leaves undone.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <thread>

#include <doctest/doctest.h>

#include "common/runtime/tracking_thread.h"
#include "tests/runtime/tracking_fixtures.h"
#include "tests/support/wait_until.h"

namespace puck {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;
using Clock = std::chrono::steady_clock;
using namespace test;

constexpr Region kRegion{0, 0, 40, 40};

// Behaviour of a pipeline, and its record.
struct Conduct {
  std::thread::id event_thread = std::this_thread::get_id();
  TrackState state = TrackState::kTracking;
  bool needs_events = false;
  std::atomic<bool> slow_steps{false};      // 5 ms each
  std::atomic<bool> slow_takes{false};      // 200 µs a piece
  std::atomic<int> packets{0};              // handed over
  std::atomic<int> packets_during_step{0};  // at most
  std::atomic<int> quick_by_event_thread{0};
  std::atomic<int> slow_by_event_thread{0};
  std::atomic<int> by_tracking_thread{0};
  std::atomic<int> pieces_by_event_thread{0};
  std::atomic<std::int64_t> events_taken{0};

  bool is_event_thread() const { return std::this_thread::get_id() == event_thread; }
};

class ConductedPipeline final : public TrackingPipeline {
 public:
  explicit ConductedPipeline(Conduct& conduct) : conduct_(conduct) {}

  bool needs_events() const override { return conduct_.needs_events; }
  std::int64_t decision_period_us() const override { return 0; }
  void take(Timestamp, std::span<const Event> events) override {
    if (conduct_.slow_takes) std::this_thread::sleep_for(microseconds(200));
    if (conduct_.is_event_thread()) ++conduct_.pieces_by_event_thread;
    conduct_.events_taken += static_cast<std::int64_t>(events.size());
  }
  Region region_needed() const override { return kRegion; }
  PuckEstimate step(const SurfaceSnapshot& snapshot) override {
    const bool slow = conduct_.slow_steps;
    const int packets = conduct_.packets;
    if (slow) std::this_thread::sleep_for(milliseconds(5));
    if (!conduct_.is_event_thread()) {
      ++conduct_.by_tracking_thread;
    } else {
      ++(slow ? conduct_.slow_by_event_thread : conduct_.quick_by_event_thread);
    }
    conduct_.packets_during_step =
        std::max(conduct_.packets_during_step.load(), conduct_.packets - packets);
    PuckEstimate estimate;
    estimate.state = conduct_.state;
    estimate.newest_event = snapshot.newest_event;
    return estimate;
  }
  SearchRequest search_wanted() override { return {}; }
  void take(const SearchResult&) override {}

 private:
  Conduct& conduct_;
};

// The two threads; the test's own is the event thread.
struct Threads {
  Threads(Conduct& its_conduct, const TrackingThreadParams& params)
      : conduct(its_conduct),
        thread(surface, std::make_unique<ConductedPipeline>(conduct), default_search(), params,
               [this](const TrackedEstimate& tracked) {
                 newest_us = tracked.estimate.newest_event.us;
                 ++published;
               }) {}

  void hand_over(std::size_t events = 1) {
    ++conduct.packets;
    now_us += 1000;
    EventPacket packet{{now_us}, {}};
    packet.events.assign(events, Event{20, 20, 1, 0});
    surface.update(packet, {}, false);
    thread.look_now();
  }

  // Hands packets over until the event thread makes a step.
  bool comes_to_event_thread() {
    const int before = conduct.quick_by_event_thread;
    return wait_until([&] {
      hand_over();
      return conduct.quick_by_event_thread > before;
    });
  }

  Conduct& conduct;
  std::int64_t now_us = 0;
  std::atomic<std::int64_t> newest_us{-1};
  std::atomic<int> published{0};
  SharedSurface surface{kSensor, {}};
  TrackingThread thread;
};

}  // namespace

TEST_CASE("a slow step delays the event thread once; quick steps return to it") {
  Conduct conduct;
  Threads threads(conduct, {});
  REQUIRE(threads.comes_to_event_thread());
  conduct.slow_steps = true;
  const int before = conduct.by_tracking_thread;
  CHECK(wait_until([&] {
    threads.hand_over();
    return conduct.slow_by_event_thread > 1 ||
           (conduct.by_tracking_thread >= before + 10 && conduct.packets_during_step >= 2);
  }));
  CHECK(conduct.slow_by_event_thread <= 1);
  conduct.slow_steps = false;
  CHECK(threads.comes_to_event_thread());
}

TEST_CASE("without a track the event thread makes no step") {
  for (const TrackState state : {TrackState::kSearching, TrackState::kLost}) {
    Conduct conduct;
    conduct.state = state;
    Threads threads(conduct, {.longest_on_event_thread = seconds(10)});
    CHECK(wait_until([&] {
      threads.hand_over();
      return conduct.by_tracking_thread >= 50;
    }));
    CHECK(conduct.quick_by_event_thread == 0);
  }
}

TEST_CASE("the event thread takes a few of many events and leaves the others to the other thread") {
  Conduct conduct;
  conduct.needs_events = true;
  Threads threads(conduct, {});
  int most = 0;
  for (int round = 0; round < 20; ++round) {
    REQUIRE(threads.comes_to_event_thread());
    conduct.slow_takes = true;
    const int before = conduct.pieces_by_event_thread;
    const std::int64_t taken_before = conduct.events_taken;
    threads.hand_over(2000);
    most = std::max(most, conduct.pieces_by_event_thread - before);
    conduct.slow_takes = false;
    CHECK(wait_until([&] { return conduct.events_taken >= taken_before + 2000; }));
  }
  CHECK(most == 1);
}

TEST_CASE("an estimate due too early is published at its time") {
  Conduct conduct;
  Threads threads(
      conduct,
      {.max_publish_hz = 50, .heartbeat = seconds(10), .longest_on_event_thread = seconds(10)});
  REQUIRE(threads.comes_to_event_thread());
  for (int round = 0; round < 10; ++round) {
    threads.hand_over();
    std::this_thread::sleep_for(milliseconds(1));
    threads.hand_over();
    const auto silent_since = Clock::now();
    REQUIRE(wait_until([&] { return threads.newest_us == threads.now_us; }));
    CHECK(Clock::now() - silent_since < seconds(1));
  }
  const auto begin = Clock::now();
  const int before = threads.published;
  for (int i = 0; i < 500; ++i) {
    threads.hand_over();
    std::this_thread::sleep_for(milliseconds(1));
  }
  const int published = threads.published - before;
  // One more may follow at once after a pause, and one at the end of the time.
  CHECK(published <= 50 * std::chrono::duration<double>(Clock::now() - begin).count() + 2);
  CHECK(published > 1);
}

}  // namespace puck
