// A surface that keeps only a region up to date: events a second, most of them outside.

#include <algorithm>
#include <vector>

#include <benchmark/benchmark.h>

#include "common/vision/surface/surface.h"
#include "tests/bench/bench_streams.h"
#include "tests/bench/eros_textbook.h"

namespace puck {
namespace {

constexpr int kHalfWidth = 3;
constexpr double kDecay = 0.786;
// A puck in the middle of the table with the tracker's surroundings.
constexpr Region kRegion{200, 150, 150, 110};
// Share of the events that are applied, at most, so that the figure is about the others.
constexpr double kMostInside = 0.10;

double share_inside(const BenchEvents& stream, const Region& region) {
  const std::vector<Event>& events = stream.packet.events;
  const auto inside = std::count_if(events.begin(), events.end(), [&](const Event& event) {
    return region.contains(event.x, event.y);
  });
  return static_cast<double>(inside) / static_cast<double>(events.size());
}

// The region with what reaches into it, made smaller until at most a tenth of the events are
// inside.
Region region_for(const BenchEvents& stream) {
  Region region = kRegion;
  while (share_inside(stream, region.inflated(kHalfWidth)) > kMostInside) {
    region = region.inflated(-4);
  }
  return region;
}

template <typename Update>
void apply_stream(benchmark::State& state, const BenchEvents& stream, const Update& update) {
  BenchParts parts(stream.packet.events);
  for (auto _ : state) {
    update(parts.next());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(parts.part_size()));
}

void ours(benchmark::State& state) {
  const BenchEvents stream = load(BenchStream::kScene);
  const Region region = region_for(stream);
  Surface surface(stream.sensor, ErosParams{.half_width_px = kHalfWidth, .decay = kDecay});
  surface.keep_only(region);
  apply_stream(state, stream, [&](std::span<const Event> events) { surface.update(events); });
  state.counters["inside_percent"] = 100 * share_inside(stream, region.inflated(kHalfWidth));
}

// Each event is checked and, if it is inside, applied in the textbook's form.
void opencv(benchmark::State& state) {
  const BenchEvents stream = load(BenchStream::kScene);
  const Region reach = region_for(stream).inflated(kHalfWidth);
  TextbookEros<std::uint8_t> surface(stream.sensor, kHalfWidth, kDecay);
  apply_stream(state, stream, [&](std::span<const Event> events) {
    for (const Event& event : events) {
      if (reach.contains(event.x, event.y)) surface.update(std::span(&event, 1));
    }
  });
}

[[maybe_unused]] const bool registered = [] {
  benchmark::RegisterBenchmark("eros_roi/ours", ours);
  benchmark::RegisterBenchmark("eros_roi/opencv", opencv);
  return true;
}();

}  // namespace
}  // namespace puck
