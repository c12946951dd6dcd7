// Cost of each event filter, beside the straightforward form of those that keep times.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <benchmark/benchmark.h>

#include "common/io/event_filter.h"
#include "tests/bench/bench_streams.h"

namespace puck {
namespace {

// As many events as the camera service requests at once.
constexpr std::size_t kPacketEvents = 8192;
constexpr SensorSize kSensor{640, 480};

/// The simulated game, packet by packet and in its order; each round begins as a new stream.
/// Copying the packets counts, too.
template <typename Filter>
void filter_scene(benchmark::State& state, Filter& filter) {
  BenchEvents scene = load(BenchStream::kScene);
  scene.packet.events.resize(std::min<std::size_t>(scene.packet.events.size(), 1'000'000));
  EventPacket packet;
  packet.events.reserve(kPacketEvents);
  std::int64_t events = 0;
  std::int64_t left = 0;
  for (auto _ : state) {
    filter.reset();
    std::span<const Event> rest = scene.packet.events;
    while (!rest.empty()) {
      const auto part = rest.first(std::min(kPacketEvents, rest.size()));
      rest = rest.subspan(part.size());
      packet.start = scene.packet.start;
      packet.events.assign(part.begin(), part.end());
      filter.apply(packet);
      benchmark::DoNotOptimize(packet.events.data());
      left += static_cast<std::int64_t>(packet.events.size());
    }
    events += static_cast<std::int64_t>(scene.packet.events.size());
  }
  state.SetItemsProcessed(events);
  state.counters["left_percent"] =
      100 * static_cast<double>(left) / static_cast<double>(std::max<std::int64_t>(1, events));
}

void ours(benchmark::State& state, const EventFilterParams& params) {
  EventFilter filter(params, kSensor);
  filter_scene(state, filter);
}

/// The filters with a time for each pixel as their definitions say, with 64-bit times.
class PlainFilter {
 public:
  PlainFilter(std::int64_t refractory_us, std::int64_t background_activity_us)
      : refractory_us_(refractory_us), background_activity_us_(background_activity_us) {
    reset();
  }

  void reset() { last_us_.assign(std::size_t{640} * 480, -1'000'000'000); }

  void apply(EventPacket& packet) {
    std::erase_if(packet.events, [&](const Event& event) {
      const std::int64_t now_us = packet.time_of(event).us;
      return refractory_us_ > 0 ? is_blind(event, now_us) : is_alone(event, now_us);
    });
  }

 private:
  std::int64_t& last(int x, int y) {
    return last_us_[static_cast<std::size_t>(y * kSensor.width + x)];
  }

  bool is_blind(const Event& event, std::int64_t now_us) {
    if (now_us - last(event.x, event.y) < refractory_us_) return true;
    last(event.x, event.y) = now_us;
    return false;
  }

  bool is_alone(const Event& event, std::int64_t now_us) {
    last(event.x, event.y) = now_us;
    for (int y = event.y - 1; y <= event.y + 1; ++y) {
      for (int x = event.x - 1; x <= event.x + 1; ++x) {
        if ((x == event.x && y == event.y) || !kSensor.contains(x, y)) continue;
        if (now_us - last(x, y) <= background_activity_us_) return false;
      }
    }
    return true;
  }

  std::int64_t refractory_us_;
  std::int64_t background_activity_us_;
  std::vector<std::int64_t> last_us_;
};

void plain(benchmark::State& state, std::int64_t refractory_us,
           std::int64_t background_activity_us) {
  PlainFilter filter(refractory_us, background_activity_us);
  filter_scene(state, filter);
}

PixelMask some_mask() {
  std::vector<PixelPlace> pixels;
  for (int i = 0; i < 100; ++i) pixels.push_back({37 * i % kSensor.width, 91 * i % kSensor.height});
  return {kSensor, pixels};
}

Lens some_lens() {
  return {.sensor = kSensor,
          .fx_px = 500,
          .fy_px = 500,
          .cx_px = 320,
          .cy_px = 240,
          .distortion = {-0.2, 0.05, 0.001, 0.001, 0}};
}

[[maybe_unused]] const bool registered = [] {
  using benchmark::RegisterBenchmark;
  const PictureTurn quarter{.flip_x = true, .rotate_deg = 90};
  RegisterBenchmark("filter_none/ours", ours, EventFilterParams{});
  RegisterBenchmark("filter_mask/ours", ours, EventFilterParams{.mask = some_mask()});
  RegisterBenchmark("filter_crop/ours", ours,
                    EventFilterParams{.crop = Region{160, 120, 320, 240}});
  RegisterBenchmark("filter_polarity/ours", ours,
                    EventFilterParams{.polarity = EventFilterParams::Polarity::kOn});
  RegisterBenchmark("filter_refractory/ours", ours, EventFilterParams{.refractory_us = 1000});
  RegisterBenchmark("filter_activity/ours", ours,
                    EventFilterParams{.background_activity_us = 5000});
  RegisterBenchmark("filter_refractory/plain", plain, 1000, 0);
  RegisterBenchmark("filter_activity/plain", plain, 0, 5000);
  RegisterBenchmark("filter_turn/ours", ours, EventFilterParams{.turn = quarter});
  RegisterBenchmark("filter_undistort/ours", ours, EventFilterParams{.lens = some_lens()});
  RegisterBenchmark("filter_all/ours", ours,
                    EventFilterParams{.mask = some_mask(),
                                      .crop = Region{20, 20, 600, 440},
                                      .refractory_us = 1000,
                                      .background_activity_us = 5000,
                                      .turn = {.flip_x = true, .rotate_deg = 180},
                                      .lens = some_lens()});
  return true;
}();

}  // namespace
}  // namespace puck
