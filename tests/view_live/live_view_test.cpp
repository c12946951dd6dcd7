#include "tools/view/live/live_view.h"

#include <vector>

#include <doctest/doctest.h>

#include "common/messaging/event_packing.h"

namespace puck {
namespace {

constexpr SensorSize kSensor{640, 480};

/// A live view, and who publishes to it. Host time passes with sensor time.
struct LiveBench {
  LiveView view;
  std::int64_t seq = 0;

  /// `count` events at one place and time.
  void events(std::int64_t time_us, int x, int y, int count = 1, std::int64_t session = 1,
              SensorSize sensor = kSensor) {
    EventPacker packer({.sensor = sensor});
    const Event event{
        .x = static_cast<std::uint16_t>(x), .y = static_cast<std::uint16_t>(y), .polarity = 1};
    const std::vector<Event> all(static_cast<std::size_t>(count), event);
    packer.pack({time_us}, all, [&](event_packet_t& packet) {
      packet.session = session;
      packet.seq = seq++;
      view.take(view_of(packet), 1'000'000 + time_us);
    });
  }

  puck_estimate_t estimate_at(std::int64_t time_us, double x) {
    puck_estimate_t message{};
    message.session = 2;
    message.seq = seq++;
    message.sensor_us = time_us;
    message.state = puck_estimate_t::STATE_TRACKING;
    message.flags = puck_estimate_t::FLAG_POSITION;
    message.x_px = x;
    message.y_px = 200;
    message.width_px = 20;
    message.height_px = 12;
    message.image_width = kSensor.width;
    message.image_height = kSensor.height;
    return message;
  }
  void estimate(std::int64_t time_us, double x) {
    view.take(estimate_at(time_us, x), 1'000'000 + time_us);
  }
  void truth(std::int64_t time_us, double x) {
    ground_truth_t message{};
    message.sensor_us = time_us;
    message.x_px = x;
    message.y_px = 200;
    message.visible = 1;
    view.take(message, 1'000'000 + time_us);
  }

  ViewScene scene(PictureWishes wishes = {}) {
    ViewScene scene;
    REQUIRE(view.fill(wishes, 1'000'000, scene));
    return scene;
  }
  ViewState state(Timestamp since = {}, std::int64_t run = -1) {
    ViewState state;
    view.add_to(state, since, run, 1'000'000);
    return state;
  }
};

bool has_event(const ViewScene& scene, int x, int y) {
  return scene.events.row(y)[x] != NewestEvents::kNone;
}

}  // namespace

TEST_CASE("nothing is shown before the sensor is known") {
  LiveBench bench;
  ViewScene scene;
  CHECK_FALSE(bench.view.fill({}, 0, scene));
  bench.estimate(1000, 100);
  CHECK(bench.view.fill({}, 0, scene));
  CHECK(scene.sensor == kSensor);
}

TEST_CASE("a scene has the events, the newest estimate and its trail") {
  LiveBench bench;
  bench.events(1000, 5, 6);
  for (int i = 0; i < 100; ++i) bench.estimate(1000 + i * 200, 100 + i);
  const ViewScene scene = bench.scene();
  CHECK(has_event(scene, 5, 6));
  CHECK_FALSE(has_event(scene, 6, 5));
  REQUIRE(scene.tracks[0].estimate);
  CHECK(scene.tracks[0].estimate->position->x == 199);
  // A point every 2 ms.
  CHECK(scene.tracks[0].trail.size() == 10);
  CHECK(scene.tracks[1].name.empty());
}

TEST_CASE("the last estimate of a tracker that fell silent is no track") {
  LiveBench bench;
  bench.events(1000, 5, 6);
  bench.estimate(2000, 100);
  bench.events(400'000, 5, 6);
  CHECK(bench.scene().tracks[0].estimate);
  bench.events(600'000, 5, 6);
  CHECK_FALSE(bench.scene().tracks[0].estimate);
  CHECK_FALSE(bench.state().estimates[0]);
  CHECK_FALSE(bench.state().samples.back().tracks[0].position);
}

TEST_CASE("of two cameras the first is shown, and the second once the first is silent") {
  LiveBench bench;
  bench.events(1000, 5, 6, 1, 1);
  bench.events(2000, 7, 8, 1, 11);
  CHECK(has_event(bench.scene(), 5, 6));
  CHECK_FALSE(has_event(bench.scene(), 7, 8));
  bench.events(700'000, 7, 8, 1, 11);
  CHECK(has_event(bench.scene(), 7, 8));
}

TEST_CASE("a camera that starts again begins a new run, without the old picture and samples") {
  LiveBench bench;
  for (int i = 1; i < 50; ++i) bench.events(i * 10'000, 5, 6);
  const std::int64_t run = bench.state().run;
  CHECK(bench.state().samples.size() == 48);
  bench.seq = 0;
  bench.view.take(view_of([] {
                    event_packet_t packet{};
                    packet.session = 5;
                    packet.width = 320;
                    packet.height = 240;
                    packet.encoding = event_packet_t::ENCODING_X10_Y9_DT12;
                    return packet;
                  }()),
                  9'000'000);
  CHECK(bench.state().run == run + 1);
  CHECK(bench.state().samples.empty());
  CHECK(bench.state().sensor == SensorSize{320, 240});
}

TEST_CASE("samples come every 10 ms with the rate, the estimate and its error") {
  LiveBench bench;
  bench.truth(0, 100);
  for (int i = 0; i <= 10; ++i) {
    bench.truth(i * 5000 + 1000, 100);
    bench.estimate(i * 5000 + 1000, 103);
    bench.events(i * 5000 + 1000, 5, 6, 50);
  }
  const ViewState state = bench.state();
  REQUIRE(state.samples.size() == 5);
  const ChartSample& sample = state.samples.back();
  CHECK(sample.time.us == 50'000);
  CHECK(sample.events_per_s == doctest::Approx(10'000).epsilon(0.6));
  CHECK(sample.tracks[0].position->x == 103);
  CHECK(*sample.tracks[0].error_px == doctest::Approx(3));
  CHECK_FALSE(sample.tracks[0].is_doubtful);
  CHECK(state.errors_px[0].value() == doctest::Approx(3));
  CHECK(bench.state({30'000}, state.run).samples.size() == 2);
  CHECK(bench.state({30'000}, state.run + 1).samples.size() == 5);
}

TEST_CASE("latencies are those of the last second") {
  LiveBench bench;
  for (int i = 1; i <= 100; ++i) {
    puck_estimate_t message = bench.estimate_at(i * 1000, 100);
    message.packet_received_utime = 5'000'000;
    message.utime = 5'000'000 + i;
    bench.view.take(message, i * 1000);
  }
  ViewState state;
  bench.view.add_to(state, {}, -1, 100'000);
  REQUIRE(state.latencies.size() == 2);
  CHECK(state.latencies[0].name == "packet to estimate");
  CHECK(*state.latencies[0].p50_us == 50);
  CHECK(*state.latencies[0].p99_us == 99);
  CHECK(*state.latencies[0].max_us == 100);
  CHECK_FALSE(state.latencies[1].p50_us);
  ViewState later;
  bench.view.add_to(later, {}, -1, 2'000'000);
  CHECK_FALSE(later.latencies[0].p50_us);
}

TEST_CASE("a tracker of another sensor size is noticed") {
  LiveBench bench;
  bench.events(1000, 5, 6, 1, 1, {320, 240});
  CHECK_FALSE(bench.view.other_sensor());
  bench.estimate(1000, 100);
  CHECK(bench.view.other_sensor() == kSensor);
}

TEST_CASE("the surface is computed from the first look on") {
  LiveBench bench;
  const PictureWishes wishes{.backdrop = PictureWishes::Backdrop::kSurface};
  bench.events(1000, 50, 60);
  CHECK(bench.scene(wishes).surface(50, 60) == 0);
  bench.events(2000, 70, 80);
  CHECK(bench.scene(wishes).surface(70, 80) == 255);
  CHECK(bench.scene(wishes).surface(50, 60) == 0);
}

TEST_CASE("the table shows what the bridge and the arm say, while they say it") {
  LiveBench bench;
  bench.events(1000, 5, 6);
  const PictureWishes wishes{.view = PictureWishes::View::kTable};
  ViewScene scene;
  CHECK(bench.view.fill(wishes, 0, scene));
  CHECK_FALSE(scene.table);
  CHECK(scene.no_table.find("start it") != std::string::npos);

  puck_trajectory_t trajectory{};
  trajectory.validity = puck_trajectory_t::VALIDITY_TRACKED;
  trajectory.x_m = 1.5;
  bench.view.take(trajectory, 1'000'000);
  arm_state_t arm{};
  arm.position_m = 0.1;
  bench.view.take(arm, 1'000'000);
  CHECK(bench.view.fill(wishes, 1'100'000, scene));
  REQUIRE(scene.table);
  CHECK(scene.table->puck.state.position.x_m == 1.5);
  CHECK(scene.table->mallet_y_m.value() == 0.1);
  CHECK(bench.view.fill(wishes, 2'000'000, scene));
  CHECK(scene.table->validity == ViewTable::Validity::kNone);
  CHECK_FALSE(scene.table->mallet_y_m);
}

}  // namespace puck
