#include "common/runtime/stepped_tracker.h"

#include <cstring>
#include <thread>

#include <doctest/doctest.h>

#include "common/vision/paper/paper_presets.h"
#include "common/vision/presets.h"
#include "tests/runtime/tracking_fixtures.h"
#include "tests/support/wait_until.h"
#include "tests/vision/puck_picture.h"

namespace puck {
namespace {

using namespace test;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

// A puck that moves with each packet; packets of different lengths.
EventPacket packet_number(int i) {
  EventPacket packet{{1000 * i},
                     contour_events(kSensor, {40 + 0.3 * i, 60}, {25, 17}, 100 + i % 7)};
  for (std::size_t k = 0; k < packet.events.size(); ++k) {
    packet.events[k].offset_us = static_cast<std::uint32_t>(k * 8);
  }
  return packet;
}

PacketOrigin received_now() { return {.received = steady_clock::now()}; }

bool is_equal(const PuckEstimate& a, const PuckEstimate& b) {
  if (a.position.has_value() != b.position.has_value()) return false;
  if (a.position && std::memcmp(&*a.position, &*b.position, sizeof *a.position) != 0) return false;
  return a.state == b.state && a.newest_event == b.newest_event && a.region == b.region &&
         std::memcmp(&a.score, &b.score, sizeof a.score) == 0 &&
         std::memcmp(a.covariance.data(), b.covariance.data(), sizeof a.covariance) == 0;
}

TEST_CASE("every estimate of a stepped tracker is reproducible to the bit from its count") {
  for (const Preset preset : {Preset::kDefault, Preset::kCorrelation}) {
    const PipelineParams params = preset_params(preset);
    Published published;
    // At so low a rate that most packets go unanswered on any machine.
    SteppedTracker stepped(kSensor, params, kSizeModel, {.max_publish_hz = 50},
                           [&](const TrackedEstimate& tracked) { published.add(tracked); });
    int sent = 0;
    for (; sent < 20 || published.count() < 15; ++sent) {
      stepped.update(packet_number(sent + 1), received_now());
      std::this_thread::sleep_for(milliseconds(sent % 3 * 2));
    }
    SurfaceTracker again(kSensor, params, kSizeModel);
    std::int64_t applied = 0;
    int packets = 0;
    int answers = 0;
    for (const TrackedEstimate& tracked : published.all()) {
      if (tracked.estimate.events_applied == applied) continue;  // Repeated.
      while (applied < tracked.estimate.events_applied) {
        const EventPacket packet = packet_number(++packets);
        applied += static_cast<std::int64_t>(packet.events.size());
        again.update(packet);
      }
      REQUIRE(applied == tracked.estimate.events_applied);
      REQUIRE(is_equal(again.estimate(), tracked.estimate));
      ++answers;
    }
    CHECK(answers > 10);
    CHECK(answers < sent);
    if (preset == Preset::kCorrelation) {
      CHECK(published.all().back().estimate.state == TrackState::kTracking);
    }
  }
}

TEST_CASE("a stepped tracker answers the last packet in time, and repeats itself in silence") {
  Published published;
  SteppedTracker stepped(kSensor, correlation_params(), kSizeModel, {.max_publish_hz = 50},
                         [&](const TrackedEstimate& tracked) { published.add(tracked); });
  stepped.update(packet_number(1), received_now());
  REQUIRE(published.count() == 1);
  stepped.update(packet_number(2), received_now());
  const auto answered = [&] {
    stepped.poll();
    return published.all().back().estimate.newest_event == packet_number(2).newest();
  };
  REQUIRE(wait_until(answered));
  const std::size_t count = published.count();
  REQUIRE(wait_until([&] {
    stepped.poll();
    return published.count() >= count + 3;
  }));
  const auto all = published.all();
  CHECK(all.back().estimate.events_applied == all[count - 1].estimate.events_applied);
  CHECK(all.back().input_age > all[count - 1].input_age);
}

}  // namespace
}  // namespace puck
