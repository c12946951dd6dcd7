#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/io/event_reader.h"
#include "services/camera/event_source.h"
#include "services/camera/growing_time.h"

namespace puck {

struct FileSourceParams {
  static constexpr std::int64_t kToEnd = std::numeric_limits<std::int64_t>::max();

  std::filesystem::path file;       ///< Key camera.file.
  EventFileOptions options;         ///< Keys camera.format, width, height, text_….
  std::int64_t start_us = 0;        ///< Key camera.start_s: the played part, since the first event.
  std::int64_t length_us = kToEnd;  ///< Key camera.seconds.
  bool loop = false;      ///< Key camera.loop: play again after the end; time continues to grow.
  double rate_mev_s = 0;  ///< Key camera.rate_mev_s: mean rate after rescaling; 0: as recorded.
};

/// A recording: a file of events, or another reader's events. Positions are recorded time. A search
/// reads on at full speed, backwards from the beginning, in bounded memory.
class FileSource final : public EventSource {
 public:
  /// Reads the whole file once if it is looped or rescaled. Throws EventFileError, also if such a
  /// file has fewer than two events.
  explicit FileSource(const FileSourceParams& params);
  /// For an open recording; `params.file` is its name.
  FileSource(const FileSourceParams& params, std::unique_ptr<EventReader> reader);

  /// Throws EventFileError, also if the recording ends before its played part.
  Outcome next(Chunk& chunk) override;
  bool is_recording() const override { return true; }
  ControlVerdict seek(std::int64_t position_us) override;
  std::int64_t position_us(Timestamp time) const override;
  std::optional<SensorSize> sensor_size() const override { return reader_->sensor_size(); }
  std::string waiting_for() const override { return "the end of a search in the recording"; }
  std::int64_t events_dropped() const override;
  std::int64_t malformed_words() const override;
  std::vector<std::string> warnings() const override { return reader_->warnings(); }

 private:
  /// What happens to the events that are read.
  enum class Task {
    kPlay,
    kSearch,  ///< Those before `from_` are left out, then kPlay.
    kReturn,  ///< The first `return_to_` ones are left out, then kPlay.
  };

  void measure();
  bool read(EventPacket& packet, std::size_t most);
  bool read_next(EventPacket& packet);
  bool go_to_start();
  Outcome end_of_part(Chunk& chunk);
  Outcome return_on(EventPacket& packet);
  void cut(EventPacket& packet) const;
  void place(Chunk& chunk);
  Timestamp stretched(Timestamp time) const;

  FileSourceParams params_;
  std::unique_ptr<EventReader> reader_;
  double stretch_ = 1;
  std::int64_t mean_gap_us_ = 1;  // Mean time between events after rescaling.
  GrowingTime time_;
  std::int64_t dropped_before_ = 0;  // In earlier readings.
  std::int64_t malformed_before_ = 0;

  // As recorded, of the first reading on.
  bool has_first_ = false;
  Timestamp first_;
  Timestamp part_begin_;
  Timestamp part_end_;             // Exclusive.
  std::optional<Timestamp> last_;  // In the part; known once its end was read.
  // Of this reading.
  Task task_ = Task::kPlay;
  Timestamp from_;
  Timestamp newest_;  // Of the part, that was read.
  std::int64_t events_read_ = 0;
  std::int64_t return_to_ = 0;
  std::int64_t session_number_ = 0;
  EventPacket latest_;           // As read last, for a place within it …
  bool repeats_latest_ = false;  // … which is then returned again.
};

}  // namespace puck
