#pragma once

#include <cstddef>
#include <vector>

#include "common/io/event_writer.h"
#include "common/io/output_file.h"

namespace puck {

/// AEDAT4 with one stream of events, in packets packed with LZ4, and no index of them.
class Aedat4Writer final : public EventWriter {
 public:
  /// Writes the header. Throws EventFileError, std::invalid_argument for an invalid sensor.
  Aedat4Writer(const std::filesystem::path& path, SensorSize sensor);
  ~Aedat4Writer() override;

  void write(const EventPacket& packet) override;
  void close() override;

 private:
  void write_packet();

  SensorSize sensor_;
  OutputFile file_;
  Timestamp newest_{0};
  std::size_t packet_events_ = 0;
  std::vector<std::byte> content_;  // Of the packet.
  std::vector<std::byte> packed_;
};

}  // namespace puck
