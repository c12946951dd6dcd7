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

/// The text log (`data.log`) of an IIT event camera's port, written by yarpdatadumper: one packet a
/// line, `sequence time [time] AE …`, in any of three encodings:
///
/// - `AE (stamp address stamp address …)`: the 24-bit addresses of an ATIS on an iCub, ON where bit
///   0 is 0;
/// - `AE duration "bytes"`: the present records, ON where bit 0 is 1, 32 bits an event after a
/// 32-bit stamp,
/// - or without stamps: a packet's events are then spread evenly over its duration, which ends at
/// the packet's time.
///
/// Stamps count ticks of 80 ns, or of 1 µs if the packets' times say so, and wrap after 31 bits. An
/// address holds x in bits 1 to 11, y in bits 12 to 21 and the eye (0: left, 1: right) in bit 22;
/// the events of one eye are read. Times are µs since the log's first event, as the zero of its
/// clocks is arbitrary. A log does not state the sensor's size.
class YarpLogReader final : public EventReader {
 public:
  /// Reads enough of the file to determine its encoding. Throws EventFileError.
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
  void take_stamped(bool is_off_one);
  void take_plain();
  bool is_of_this_eye(std::uint32_t address);
  void append(Timestamp time, std::uint32_t address, bool is_off_one);

  std::string name_;
  EventFileOptions options_;
  std::ifstream file_;
  std::vector<char> buffer_;
  std::string_view line_;
  bool is_line_whole_ = true;  // The line had a line end; not cut by the end of the file.
  bool is_at_end_ = false;
  YarpPacket packet_;
  bool has_stamps_ = false;  // Stamps before the records of byte packets.
  double us_per_tick_ = 1;
  YarpEventClock clock_;
  std::optional<double> first_plain_s_;  // Start of the log's first packet without stamps.
  Timestamp newest_plain_;
  std::optional<std::uint32_t> eye_;  // The eye whose events are read, once known.
  EventSink sink_;
};

}  // namespace puck
