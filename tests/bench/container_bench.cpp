// Speed of the formats that are containers, from and to files.
#include <algorithm>
#include <filesystem>
#include <string>

#include <benchmark/benchmark.h>

#include "common/io/event_reader.h"
#include "common/io/event_writer.h"
#include "tests/bench/bench_streams.h"
#include "tests/support/temporary_folder.h"

namespace puck {
namespace {

// As many as the converter asks for at once.
constexpr std::size_t kPacketEvents = 16384;

/// The scene's first events.
BenchEvents some_events() {
  constexpr std::size_t kMostEvents = 200'000;
  BenchEvents events = load(BenchStream::kScene);
  if (events.packet.events.size() > kMostEvents) events.packet.events.resize(kMostEvents);
  return events;
}

void write_file(const std::filesystem::path& path, const std::string& format,
                const BenchEvents& events) {
  const auto writer = make_event_writer(path, format, events.sensor);
  writer->write(events.packet);
  writer->close();
}

void read_ours(benchmark::State& state, const std::string& format) {
  const TemporaryFolder folder;
  write_file(folder / "events", format, some_events());
  const auto reader = open_event_file(folder / "events");
  EventPacket packet;
  std::int64_t count = 0;
  for (auto _ : state) {
    reader->rewind();
    while (reader->read(packet, kPacketEvents)) benchmark::DoNotOptimize(packet.events.data());
    count += reader->counters().events;
  }
  state.SetItemsProcessed(count);
}

void write_ours(benchmark::State& state, const std::string& format) {
  const TemporaryFolder folder;
  const BenchEvents events = some_events();
  std::int64_t count = 0;
  for (auto _ : state) {
    write_file(folder / "events", format, events);
    count += static_cast<std::int64_t>(events.packet.events.size());
  }
  state.SetItemsProcessed(count);
}

[[maybe_unused]] const bool containers_registered = [] {
  using benchmark::RegisterBenchmark;
  // Keys of the figures have no hyphen.
  const auto figure = [](std::string format, const char* what) {
    std::replace(format.begin(), format.end(), '-', '_');
    return format + what;
  };
  for (const std::string format : {"aedat4", "hdf5", "hdf5-ecf"}) {
    RegisterBenchmark(figure(format, "_read/ours").c_str(), read_ours, format);
  }
  for (const WrittenFormat& format : kWrittenFormats) {
    const std::string name(format.name);
    RegisterBenchmark(figure(name, "_write/ours").c_str(), write_ours, name);
  }
  return true;
}();

}  // namespace
}  // namespace puck
