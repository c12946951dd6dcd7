#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/io/aedat4_header.h"
#include "common/io/byte_source.h"
#include "common/io/event_reader.h"
#include "common/io/event_sink.h"

namespace puck {

/// AEDAT4 files and streams: the first stream of events. Packets of other streams count as other
/// data. What follows the packets is read too, for its faults: damage at the end of a compressed
/// file, or another AEDAT4 file, which is left out with a warning.
class Aedat4Reader final : public EventReader {
 public:
  /// Reads the header of `bytes`, of which nothing may have been read. Throws EventFileError.
  Aedat4Reader(std::unique_ptr<ByteSource> bytes, const EventFileOptions& options);

  SensorSize sensor_size() const override { return sensor_; }
  bool read(EventPacket& packet, std::size_t max_events) override;
  bool can_rewind() const override { return bytes_->can_rewind(); }
  void rewind() override;
  const EventCounters& counters() const override { return sink_.counters(); }
  RecordingFacts facts() const override;
  std::optional<double> share_read() const override { return bytes_->share_read(); }
  std::vector<std::string> warnings() const override;

 private:
  void read_header();
  void find_stream(const EventFileOptions& options);
  bool take_packet();
  void unpack(std::size_t bytes);
  bool end(const std::string& fault = {}, std::string rest = {});
  void read_rest(std::string rest);

  std::unique_ptr<ByteSource> bytes_;
  Aedat4Header header_;
  Aedat4Stream stream_;
  SensorSize sensor_;
  std::int64_t reorder_us_ = 0;
  EventSink sink_{{1, 1}};
  Aedat4Unpacker unpacker_{Aedat4Packing::kNone};
  std::int64_t position_ = 0;  // Bytes read.
  std::vector<std::byte> packed_;
  std::span<const std::byte> records_;  // Of the packet, not yet handed out.
  std::array<Event, 1024> run_{};
  bool is_at_end_ = false;
  std::vector<std::string> faults_;
};

}  // namespace puck
