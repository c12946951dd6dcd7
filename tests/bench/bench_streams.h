#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"

namespace puck {

/// Event streams for the benchmarks.
enum class BenchStream : std::uint8_t {
  kScene,      ///< The simulated table in play, 640×480, head moving. Its figures count.
  kUniform,    ///< Every pixel of 640×480 as likely as any other: the worst case for caches.
  kDriving,    ///< Real: a street from a moving car, 1280×720.
  kSparklers,  ///< Real: a static camera before sparks, 640×480.
};
inline constexpr BenchStream kBenchStreams[] = {BenchStream::kScene, BenchStream::kUniform,
                                                BenchStream::kDriving, BenchStream::kSparklers};

/// `scene`, `uniform`, `driving`, `sparklers`: part of the benchmarks' names.
const char* to_string(BenchStream stream);

/// The folder of real recordings: PUCK_RECORDINGS, else ../shared/recordings beside the project.
/// It may not exist.
std::filesystem::path bench_recordings();

/// False for an absent real recording.
bool is_there(BenchStream stream);

/// A whole stream in memory.
struct BenchEvents {
  SensorSize sensor;
  EventPacket packet;
};

/// The same events in every run. The scene takes a while to simulate; it is kept on disk and read
/// from there the next time. Throws std::runtime_error, or what EventReader throws.
BenchEvents load(BenchStream stream);

/// A stream's events in equal parts, one for each iteration of a benchmark. The order spreads any
/// number of successive parts over the whole stream, so that slow code, which gets through few
/// parts, works on the same mixture as fast code.
class BenchParts {
 public:
  explicit BenchParts(std::span<const Event> events, std::size_t part_size = 16384);

  std::span<const Event> next();
  std::size_t part_size() const { return part_size_; }

 private:
  std::span<const Event> events_;
  std::size_t part_size_;
  std::size_t parts_;
  std::size_t step_;
  std::size_t part_ = 0;
};

}  // namespace puck
