#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "common/io/event_reader.h"
#include "common/io/raw_event_stream.h"

namespace puck {

/// Prophesee RAW files.
class RawFileReader final : public EventReader {
 public:
  /// Reads the header. Throws EventFileError.
  RawFileReader(const std::filesystem::path& path, const EventFileOptions& options);

  SensorSize sensor_size() const override { return *stream_->sensor_size(); }
  bool read(EventPacket& packet, std::size_t max_events) override;
  void rewind() override;
  const EventCounters& counters() const override { return stream_->counters(); }
  std::vector<std::string> warnings() const override;

 private:
  void refill();

  std::string name_;
  EventFileOptions options_;
  std::ifstream file_;
  std::vector<std::byte> block_;
  std::size_t block_used_ = 0;
  std::size_t block_size_ = 0;
  bool is_at_end_ = false;
  std::optional<RawEventStream> stream_;
};

}  // namespace puck
