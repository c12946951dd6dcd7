#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/io/byte_source.h"
#include "common/io/event_reader.h"
#include "common/io/event_stream.h"

namespace puck {

/// Files whose format is a stream. Memory does not grow with the file.
class StreamFileReader final : public EventReader {
 public:
  /// Reads the header. Throws EventFileError.
  StreamFileReader(std::unique_ptr<ByteSource> bytes, const EventFileOptions& options);

  SensorSize sensor_size() const override { return *stream_->sensor_size(); }
  bool read(EventPacket& packet, std::size_t max_events) override;
  bool can_rewind() const override { return bytes_->can_rewind(); }
  void rewind() override;
  const EventCounters& counters() const override { return stream_->counters(); }
  RecordingFacts facts() const override { return stream_->facts(); }
  std::optional<double> share_read() const override { return bytes_->share_read(); }
  std::vector<std::string> warnings() const override;

 private:
  void start();
  void refill();

  std::unique_ptr<ByteSource> bytes_;
  EventFileOptions options_;
  std::vector<std::byte> block_;
  std::size_t block_used_ = 0;
  std::size_t block_size_ = 0;
  bool is_at_end_ = false;
  std::optional<EventStream> stream_;
};

}  // namespace puck
