#include "tests/bench/bench_streams.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "common/vision/surface/surface.h"
#include "tests/bench/eros_plain.h"
#include "tests/bench/eros_textbook.h"

namespace puck {
namespace {

constexpr SensorSize kSensor{96, 64};
constexpr double kDecay = 0.786;

std::vector<Event> events_anywhere(std::size_t count) {
  std::mt19937 random(1);
  std::vector<Event> events(count);
  for (Event& event : events) {
    event.x = static_cast<std::uint16_t>(random() % 96);
    event.y = static_cast<std::uint16_t>(random() % 64);
  }
  return events;
}

// The worst that a surface differs from ours after many events, in grey values.
template <typename AnySurface>
double worst_difference(AnySurface&& surface, std::span<const Event> events, int half_width) {
  Surface ours(kSensor, ErosParams{.half_width_px = half_width, .decay = kDecay});
  ours.update(events);
  surface.update(events);
  SurfaceSnapshot snapshot;
  ours.snapshot(Region::all_of(kSensor), snapshot);
  double worst = 0;
  for (int y = 0; y < kSensor.height; ++y) {
    for (int x = 0; x < kSensor.width; ++x) {
      const auto theirs = static_cast<double>(surface.at(x, y));
      worst = std::max(worst, std::abs(snapshot.grey(x, y) - theirs));
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("the parts cover the whole stream once a round, and a few parts are spread over it") {
  std::vector<Event> events(10 * 100);
  BenchParts parts(events, 10);
  std::set<const Event*> begins;
  std::set<std::ptrdiff_t> quarters;
  for (int i = 0; i < 100; ++i) {
    const auto part = parts.next();
    CHECK(part.size() == 10);
    begins.insert(part.data());
    if (i < 8) quarters.insert((part.data() - events.data()) / 250);
  }
  CHECK(begins.size() == 100);
  CHECK(quarters.size() == 4);
}

TEST_CASE("a stream shorter than a part is one part") {
  std::vector<Event> events(7);
  BenchParts parts(events, 10);
  CHECK(parts.next().size() == 7);
  CHECK(parts.next().data() == events.data());
}

TEST_CASE("the uniform stream is the same each time, inside its sensor and in order") {
  const BenchEvents stream = load(BenchStream::kUniform);
  CHECK(stream.packet.events == load(BenchStream::kUniform).packet.events);
  std::uint32_t before = 0;
  bool fine = true;
  for (const Event& event : stream.packet.events) {
    fine = fine && stream.sensor.contains(event.x, event.y) && event.offset_us >= before;
    before = event.offset_us;
  }
  CHECK(fine);
}

TEST_CASE("the surface for comparison is the same, but for its rounding") {
  const std::vector<Event> events = events_anywhere(20'000);
  for (const int k : {1, 3, 8}) {
    CAPTURE(k);
    CHECK(worst_difference(TextbookEros<double>(kSensor, k, kDecay), events, k) <= 0.5001);
    CHECK(worst_difference(TextbookEros<std::uint8_t>(kSensor, k, kDecay), events, k) <= 3);
    CHECK(worst_difference(PlainEros(kSensor, k, kDecay, PlainDecay::kFloat), events, k) <= 0.51);
    CHECK(worst_difference(PlainEros(kSensor, k, kDecay, PlainDecay::kByteTimesFloat), events, k) <=
          4);
    CHECK(worst_difference(PlainEros(kSensor, k, kDecay, PlainDecay::kByteFixedPoint), events, k) <=
          4);
  }
}

}  // namespace puck
