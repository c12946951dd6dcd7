#include "common/runtime/tracking_thread.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <doctest/doctest.h>

#include "common/vision/paper/paper_presets.h"
#include "tests/runtime/tracking_fixtures.h"
#include "tests/support/wait_until.h"
#include "tests/vision/puck_picture.h"

namespace puck {
namespace {

using std::chrono::milliseconds;
using namespace test;

}  // namespace

TEST_CASE("the two threads follow the puck and stamp estimates with their newest packet") {
  const PuckPipelineParams params = correlation_params();
  SharedSurface surface(kSensor, params.eros);
  Published published;
  const TrackingThread thread(surface, default_pipeline(), default_search(), {},
                              [&](const TrackedEstimate& e) { published.add(e); });
  Pixel truth;
  for (int i = 1; i <= 300; ++i) {
    truth = {40 + 0.25 * i, 50 + 0.1 * i};
    EventPacket packet{{i * 1000}, test::contour_events(kSensor, truth, kSizeModel.at(truth), 150)};
    surface.update(packet, {.session = 9, .received_utime = i});
    std::this_thread::sleep_for(milliseconds(1));
  }
  // After a long delay the thread finds the puck again, from the same events.
  TrackedEstimate last;
  const auto tracks_newest = [&] {
    const auto all = published.all();
    if (!all.empty()) last = all.back();
    return last.estimate.newest_event == Timestamp{300'000} && last.backlog_events == 0 &&
           last.estimate.state == TrackState::kTracking;
  };
  REQUIRE(wait_until(tracks_newest));
  // … but it also followed the puck during its motion.
  const auto all = published.all();
  CHECK(std::any_of(all.begin(), all.end(), [](const TrackedEstimate& e) {
    const double i = static_cast<double>(e.estimate.newest_event.us) / 1000;
    return i > 100 && i < 300 && e.estimate.state == TrackState::kTracking && e.estimate.position &&
           std::abs(e.estimate.position->x - (40 + 0.25 * i)) < 2 &&
           std::abs(e.estimate.position->y - (50 + 0.1 * i)) < 2;
  }));
  REQUIRE(last.estimate.position.has_value());
  CHECK(std::abs(last.estimate.position->x - truth.x) < 2);
  CHECK(std::abs(last.estimate.position->y - truth.y) < 2);
  CHECK(last.origin.session == 9);
  CHECK(last.origin.received_utime == 300);
  CHECK(last.backlog_events == 0);
}

TEST_CASE("the tracking thread sleeps without new events, but publishes its heartbeat") {
  SharedSurface surface(kSensor, {});
  Published published;
  const TrackingThread thread(surface, default_pipeline(), default_search(),
                              {.heartbeat = milliseconds(5)},
                              [&](const TrackedEstimate& e) { published.add(e); });
  CHECK(wait_until([&] { return published.count() >= 5; }));
  for (const TrackedEstimate& e : published.all()) {
    CHECK(e.estimate.state == TrackState::kSearching);
    // No step was made: a step would have set its start time.
    CHECK(e.tracking_started == std::chrono::system_clock::time_point{});
  }
}

TEST_CASE("estimates are published at most at the requested rate") {
  SharedSurface surface(kSensor, {});
  Published published;
  const auto begin = std::chrono::steady_clock::now();
  {
    const TrackingThread thread(surface, default_pipeline(), default_search(),
                                {.max_publish_hz = 100, .heartbeat = milliseconds(1000)},
                                [&](const TrackedEstimate& e) { published.add(e); });
    for (int i = 1; i <= 200; ++i) {
      EventPacket packet{{i * 1000}, {{80, 60, 1, 0}}};
      surface.update(packet, {});
      std::this_thread::sleep_for(milliseconds(1));
    }
  }
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  // One more may follow at once after a pause.
  CHECK(static_cast<double>(published.count()) <= seconds * 100 + 3);
  CHECK(published.count() >= 2);
}

TEST_CASE("a sleeping tracking thread ends promptly when it is destroyed") {
  SharedSurface surface(kSensor, {});
  {
    const TrackingThread thread(surface, default_pipeline(), default_search(), {},
                                [](const TrackedEstimate&) {});
  }
  CHECK(surface.size() == kSensor);
}

TEST_CASE("a publishing rate below one is refused") {
  SharedSurface surface(kSensor, {});
  CHECK_THROWS_WITH_AS(TrackingThread(surface, default_pipeline(), default_search(),
                                      {.max_publish_hz = 0}, [](const TrackedEstimate&) {}),
                       "tracker.max_publish_hz must be at least 1, got 0", std::invalid_argument);
}

}  // namespace puck
