#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/io/event_reader.h"
#include "common/io/event_sink.h"
#include "common/io/line_reader.h"
#include "common/io/peeked_bytes.h"
#include "common/io/yarp_event_clock.h"
#include "common/io/yarp_packet.h"

namespace puck {

/// The text log that yarpdatadumper writes of an IIT event camera's port (`data.log`): one packet a
/// line, `sequence time [time] AE …`, in one of three encodings:
///
/// - `AE (stamp address stamp address …)`: 24-bit addresses of an ATIS on an iCub. An event is ON
/// if
///   bit 0 is zero.
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
  void rewind() override;
  const EventCounters& counters() const override { return sink_.counters(); }
  RecordingFacts facts() const override {
    return {has_stamps_ ? "YARP log, a time with each event" : "YARP log, times of packets", {}};
  }
  std::optional<double> share_read() const override { return bytes_.share_read(); }
  std::vector<std::string> warnings() const override;

 private:
  void find_encoding();
  void start();
  void take_line(std::string_view line);
  void take_stamped();
  void take_plain();
  void place_plain(const YarpPacket& packet, double start_us);
  void finish();
  bool is_of_this_eye(std::uint32_t address);
  void append_placed();
  void append(Timestamp time, std::uint32_t address);

  EventFileOptions options_;
  SensorSize sensor_;
  PeekedBytes bytes_;
  LineReader lines_;
  bool is_finished_ = false;  // At the end, and no record or packet waits.
  YarpPacket packet_;
  bool has_stamps_ = true;  // Before each record.
  double us_per_tick_ = 1;
  std::uint32_t eye_ = 0;  // Whose events are read.
  YarpEventClock clock_;
  std::vector<TimedRecord> placed_;
  std::optional<YarpPacket> held_;      // A packet without stamps whose host time is doubtful.
  std::optional<double> plain_zero_s_;  // Host time at which the log's first plain packet began.
  double newest_plain_us_ = 0;          // End of the newest packet without stamps.
  EventSink sink_;
};

}  // namespace puck
