#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/io/event_reader.h"
#include "common/io/line_reader.h"
#include "common/io/peeked_bytes.h"
#include "common/io/yarp_packet.h"
#include "common/io/yarp_packet_decoder.h"
#include "common/io/yarp_record_form.h"

namespace puck {

/// The text log that yarpdatadumper writes of an IIT event camera's port (`data.log`): one packet a
/// line, `sequence time [time] AE …`, in one of three encodings:
///
/// - `AE (stamp address stamp address …)`: 24-bit addresses of an ATIS on an iCub. An event
///   is ON if bit 0 is zero.
/// - `AE duration "bytes"`: present records, a 32-bit stamp and a 32-bit address an event. An event
///   is ON if bit 0 is set.
/// - The same without stamps: a packet's events are spread evenly over its duration, which ends at
///   the packet's time.
///
/// Stamps count ticks of 80 ns or 1 µs, which the packets' times decide, and wrap after 31 bits. An
/// address contains x in bits 1 to 11, y in bits 12 to 21 and the eye (0: left, 1: right) in bit
/// 22; the events of one eye are read. Times are µs since the log's first event, as its clocks have
/// arbitrary zeros. A log does not contain the sensor's size.
class YarpLogReader final : public EventReader {
 public:
  /// Reads the beginning of the file to detect its encoding. Throws EventFileError.
  YarpLogReader(std::unique_ptr<ByteSource> bytes, const EventFileOptions& options);

  SensorSize sensor_size() const override { return sensor_; }
  bool read(EventPacket& packet, std::size_t max_events) override;
  bool can_rewind() const override { return bytes_.can_rewind(); }
  void rewind() override;
  const EventCounters& counters() const override { return decoder_.counters(); }
  RecordingFacts facts() const override {
    return {form_.has_stamps ? "YARP log, a time with each event" : "YARP log, times of packets",
            {}};
  }
  std::optional<double> share_read() const override { return bytes_.share_read(); }
  std::vector<std::string> warnings() const override;

 private:
  YarpRecordForm find_form();
  void take_line(std::string_view line);

  EventFileOptions options_;
  SensorSize sensor_;
  PeekedBytes bytes_;
  LineReader lines_;
  bool is_finished_ = false;  // At the end, and no record or packet waits.
  YarpPacket packet_;
  YarpRecordForm form_;
  YarpPacketDecoder decoder_;
};

}  // namespace puck
