// The surface: events a second, against the textbook's form in OpenCV and against plain loops.

#include <string>

#include <benchmark/benchmark.h>

#include "common/vision/surface/surface.h"
#include "tests/bench/bench_streams.h"
#include "tests/bench/eros_plain.h"
#include "tests/bench/eros_textbook.h"

namespace puck {
namespace {

constexpr double kDecay = 0.786;

// One iteration applies one part of the stream; items are events.
template <typename AnySurface>
void apply_stream(benchmark::State& state, const BenchEvents& stream, AnySurface& surface) {
  BenchParts parts(stream.packet.events);
  for (auto _ : state) {
    surface.update(parts.next());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(parts.part_size()));
}

void ours(benchmark::State& state, BenchStream name, int half_width) {
  const BenchEvents stream = load(name);
  Surface surface(stream.sensor, ErosParams{.half_width_px = half_width, .decay = kDecay});
  apply_stream(state, stream, surface);
}

template <typename Pixel>
void textbook(benchmark::State& state, BenchStream name, int half_width) {
  const BenchEvents stream = load(name);
  TextbookEros<Pixel> surface(stream.sensor, half_width, kDecay);
  apply_stream(state, stream, surface);
}

void plain(benchmark::State& state, BenchStream name, int half_width, PlainDecay form) {
  const BenchEvents stream = load(name);
  PlainEros surface(stream.sensor, half_width, kDecay, form);
  apply_stream(state, stream, surface);
}

void register_all(BenchStream stream, int half_width) {
  const std::string figure = "eros_k" + std::to_string(half_width) + "_" + to_string(stream) + "/";
  const auto add = [&](const std::string& variant, auto function, auto... more) {
    benchmark::RegisterBenchmark((figure + variant).c_str(), function, stream, half_width, more...);
  };
  add("ours", ours);
  add("opencv_8u", textbook<std::uint8_t>);
  add("opencv_64f", textbook<double>);
  add("plain_8u", plain, PlainDecay::kByteTimesFloat);
  add("plain_8u_fixed", plain, PlainDecay::kByteFixedPoint);
  add("plain_32f", plain, PlainDecay::kFloat);
}

[[maybe_unused]] const bool registered = [] {
  for (int half_width = 1; half_width <= 8; ++half_width) {
    register_all(BenchStream::kScene, half_width);
  }
  for (const BenchStream stream :
       {BenchStream::kUniform, BenchStream::kDriving, BenchStream::kSparklers}) {
    for (const int half_width : {3, 5, 7}) {
      if (is_there(stream)) register_all(stream, half_width);
    }
  }
  return true;
}();

}  // namespace
}  // namespace puck
