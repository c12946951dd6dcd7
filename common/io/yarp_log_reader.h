#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/io/event_reader.h"
#include "common/io/event_sink.h"
#include "common/io/yarp_event_clock.h"
#include "common/io/yarp_packet.h"

namespace puck {

/// The text log that yarpdatadumper writes of an IIT event camera's port (`data.log`): one packet a
/// line, `sequence time [time] AE …`, in any of three encodings:
///
/// - `AE (stamp address stamp address …)`: the 24-bit addresses of an ATIS on an iCub, ON where bit
///   0 is 0;
/// - `AE duration "bytes"`: the present records, ON where bit 0 is 1, 32 bits an event behind a
///   stamp of as many,
/// - or without stamps: a packet's events are then spread evenly over its duration, which ends at
///   the packet's time.
///
/// Stamps count ticks of 80 ns, or of 1 µs where the packets' times say so, and wrap after 31 bits.
/// An address holds x in bits 1 to 11, y in bits 12 to 21 and the eye (0: left, 1: right) in bit
/// 22; the events of one eye are read. Times are µs since the log's first event, as none of its
/// clocks has a zero that means anything. A log does not say how large the sensor is.
class YarpLogReader final : public EventReader {
 public:
  /// Reads enough of the file to tell its encoding. Throws EventFileError.
  YarpLogReader(const std::filesystem::path& path, const EventFileOptions& options);

  SensorSize sensor_size() const override { return options_.sensor; }
  bool read(EventPacket& packet, std::size_t max_events) override;
  void rewind() override;
  const EventCounters& counters() const override { return sink_.counters(); }
  std::vector<std::string> warnings() const override;

 private:
  void find_encoding();
  bool next_line();
  void take_line();
  void take_stamped();
  void take_plain();
  void place_plain(const YarpPacket& packet, double start_us);
  void finish();
  bool is_of_this_eye(std::uint32_t address);
  void append_placed();
  void append(Timestamp time, std::uint32_t address);

  std::string name_;
  EventFileOptions options_;
  std::ifstream file_;
  std::vector<char> buffer_;
  std::string_view line_;
  bool is_line_whole_ = true;  // Ended by a line end, not by the end of the file.
  bool is_at_end_ = false;
  bool is_finished_ = false;  // At the end, with all that waited handed out.
  YarpPacket packet_;
  bool has_stamps_ = true;  // Before each record.
  double us_per_tick_ = 1;
  std::uint32_t eye_ = 0;  // Whose events are read.
  YarpEventClock clock_;
  std::vector<TimedRecord> placed_;
  std::int64_t told_doubtful_ = 0;      // Of the clock's doubtful records.
  std::optional<YarpPacket> held_;      // Without stamps, and with a doubtful host time.
  std::optional<double> plain_zero_s_;  // Host time at which the log's first plain packet began.
  double newest_plain_us_ = 0;          // Up to here plain packets reach.
  EventSink sink_;
};

}  // namespace puck
