#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/io/event_reader.h"
#include "services/camera/event_source.h"
#include "services/camera/growing_time.h"

namespace puck {

struct FileSourceParams {
  std::filesystem::path file;  ///< Key camera.file.
  EventFileOptions options;    ///< Keys camera.format, width, height, text_….
  bool loop = false;      ///< Key camera.loop: play again after the end; time continues to grow.
  double rate_mev_s = 0;  ///< Key camera.rate_mev_s: mean rate after rescaling; 0: as recorded.
};

/// A recording: a file of events, or another reader's events.
class FileSource final : public EventSource {
 public:
  /// Reads the whole file once if it is looped or rescaled. Throws EventFileError, also if such a
  /// file has fewer than two events.
  explicit FileSource(const FileSourceParams& params);
  /// For an open recording; `params.file` is its name.
  FileSource(const FileSourceParams& params, std::unique_ptr<EventReader> reader);

  Outcome next(Chunk& chunk) override;
  std::optional<SensorSize> sensor_size() const override { return reader_->sensor_size(); }
  std::int64_t events_dropped() const override;
  std::int64_t malformed_words() const override;
  std::vector<std::string> warnings() const override { return reader_->warnings(); }

 private:
  void measure();
  bool begin_again();
  void place(Chunk& chunk);
  Timestamp stretched(Timestamp time) const;

  FileSourceParams params_;
  std::unique_ptr<EventReader> reader_;
  Timestamp first_;
  double stretch_ = 1;
  std::int64_t mean_gap_us_ = 1;  // Mean time between events after rescaling.
  GrowingTime time_;
  std::int64_t dropped_before_ = 0;  // In earlier rounds of the loop.
  std::int64_t malformed_before_ = 0;
};

}  // namespace puck
