#include "tests/bench/bench_streams.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>

#include <unistd.h>

#include "common/io/event_reader.h"
#include "common/simulation/simulated_table.h"

namespace puck {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kSceneEvents = 2'000'000;
constexpr std::size_t kUniformEvents = 1'000'000;
// The beginning, the serve, has few events.
constexpr std::int64_t kSceneBegin_us = 500'000;
constexpr std::int64_t kSceneSeed = 7;

fs::path recording(BenchStream stream) {
  switch (stream) {
    case BenchStream::kDriving:
      return bench_recordings() / "driving_gen41_1280x720_evt3.raw";
    case BenchStream::kSparklers:
      return bench_recordings() / "sparklers_gen31_640x480_evt2.raw";
    case BenchStream::kScene:
    case BenchStream::kUniform:
      break;
  }
  return {};
}

BenchEvents simulate_scene() {
  SimulationParams params;
  params.seed = kSceneSeed;
  params.moving_camera = true;
  params.autonomous_robot = true;
  SimulatedTable table(params);
  BenchEvents scene{params.sensor_size, {}};
  while (table.now().us < kSceneBegin_us) {
    scene.packet.events.clear();
    table.advance(scene.packet);
  }
  scene.packet.events.clear();
  while (scene.packet.events.size() < kSceneEvents) table.advance(scene.packet);
  scene.packet.events.resize(kSceneEvents);
  return scene;
}

BenchEvents make_uniform() {
  BenchEvents uniform{{640, 480}, {}};
  std::mt19937 random(1);
  uniform.packet.events.reserve(kUniformEvents);
  for (std::size_t i = 0; i < kUniformEvents; ++i) {
    const auto bits = static_cast<std::uint32_t>(random());
    const std::uint32_t pixel = bits % (640 * 480);
    uniform.packet.events.push_back(
        {static_cast<std::uint16_t>(pixel % 640), static_cast<std::uint16_t>(pixel / 640),
         static_cast<std::uint16_t>(bits >> 31), static_cast<std::uint32_t>(i)});
  }
  return uniform;
}

BenchEvents read_recording(const fs::path& path) {
  const auto reader = open_event_file(path);
  BenchEvents recording{reader->sensor_size(), {}};
  reader->read(recording.packet, std::size_t{1} << 22);
  return recording;
}

struct CacheHeader {
  std::uint64_t magic = 0x31766b6375700000;
  std::int64_t start_us = 0;
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::uint64_t events = 0;
};

std::optional<BenchEvents> read_cache(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  CacheHeader header;
  const std::uint64_t magic = header.magic;
  file.read(reinterpret_cast<char*>(&header), sizeof(header));
  if (!file || header.magic != magic || header.events != kSceneEvents) return std::nullopt;
  BenchEvents events{{header.width, header.height}, {{header.start_us}, {}}};
  events.packet.events.resize(header.events);
  file.read(reinterpret_cast<char*>(events.packet.events.data()),
            static_cast<std::streamsize>(header.events * sizeof(Event)));
  if (!file) return std::nullopt;
  return events;
}

// Written beside it and then renamed, so that an interrupted run leaves no partial file.
void write_cache(const fs::path& path, const BenchEvents& events) {
  fs::create_directories(path.parent_path());
  const fs::path unfinished = path.string() + "." + std::to_string(getpid());
  const CacheHeader header{.start_us = events.packet.start.us,
                           .width = events.sensor.width,
                           .height = events.sensor.height,
                           .events = events.packet.events.size()};
  std::ofstream file(unfinished, std::ios::binary);
  file.write(reinterpret_cast<const char*>(&header), sizeof(header));
  file.write(reinterpret_cast<const char*>(events.packet.events.data()),
             static_cast<std::streamsize>(header.events * sizeof(Event)));
  file.close();
  if (!file) throw std::runtime_error(unfinished.string() + ": cannot be written");
  fs::rename(unfinished, path);
}

}  // namespace

const char* to_string(BenchStream stream) {
  switch (stream) {
    case BenchStream::kScene:
      return "scene";
    case BenchStream::kUniform:
      return "uniform";
    case BenchStream::kDriving:
      return "driving";
    case BenchStream::kSparklers:
      return "sparklers";
  }
  return "unknown";
}

fs::path bench_recordings() {
  if (const char* named = std::getenv("PUCK_RECORDINGS")) return named;
  return fs::path(PUCK_SOURCE_DIR) / ".." / "shared" / "recordings";
}

bool is_there(BenchStream stream) {
  const fs::path path = recording(stream);
  return path.empty() || fs::exists(path);
}

BenchEvents load(BenchStream stream) {
  if (stream == BenchStream::kUniform) return make_uniform();
  if (stream != BenchStream::kScene) return read_recording(recording(stream));
  const fs::path cache = fs::path(PUCK_BENCH_DATA) / "scene.events";
  if (auto events = read_cache(cache)) return *std::move(events);
  BenchEvents events = simulate_scene();
  write_cache(cache, events);
  return events;
}

BenchParts::BenchParts(std::span<const Event> events, std::size_t part_size)
    : events_(events),
      part_size_(std::min(part_size, events.size())),
      parts_(events.size() / part_size_) {
  // Golden section steps spread best; a step coprime to the number of parts visits every part.
  step_ = std::max<std::size_t>(1, parts_ * 618 / 1000);
  while (std::gcd(step_, parts_) != 1) ++step_;
}

std::span<const Event> BenchParts::next() {
  const auto part = events_.subspan(part_ * part_size_, part_size_);
  part_ = (part_ + step_) % parts_;
  return part;
}

}  // namespace puck
