#pragma once

#include <cstdint>
#include <span>

#include "common/io/evt3_run.h"
#include "common/io/file_event_writer.h"

namespace puck {

/// Prophesee RAW, EVT 3.0. Its time is 24 bits wide and starts at 0, so the file begins with enough
/// time words to count up to the first event; pauses are counted through in the same way.
class Evt3Writer final : public FileEventWriter {
 public:
  /// Longer pauses and later first times would fill the file with time words.
  static constexpr std::int64_t kLongestPauseUs = std::int64_t{24} * 3600 * 1000000;

  /// Writes the header. Throws EventFileError, std::invalid_argument for an invalid sensor.
  Evt3Writer(const std::filesystem::path& path, SensorSize sensor);

  void write(const EventPacket& packet) override;

 private:
  void move_clock_to(Timestamp time);
  void put(Evt3Type type, std::uint32_t payload);
  void write_run(std::span<const Event> run);

  std::int64_t high_ = -1;    // Unwrapped; −1: no time word yet.
  std::int64_t low_us_ = -1;  // −1: none since the newest high part.
  int row_ = -1;
};

}  // namespace puck
