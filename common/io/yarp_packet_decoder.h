#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/io/event_sink.h"
#include "common/io/yarp_event_clock.h"
#include "common/io/yarp_packet.h"
#include "common/io/yarp_record_form.h"

namespace puck {

/// Decodes an IIT camera's packets to events, of a log or of a live port. Times are µs since the
/// first event, as its clocks have arbitrary zeros. The events of one eye are decoded.
///
/// Packets without stamps: a packet's events are spread evenly over its duration, which ends at the
/// packet's host time.
class YarpPacketDecoder {
 public:
  /// `reorder_us`: as EventSink's. Throws std::invalid_argument when `sensor` is not a valid size.
  YarpPacketDecoder(SensorSize sensor, const YarpRecordForm& form, std::int64_t reorder_us);

  /// As EventSink::begin: the events of further calls go there.
  void begin(EventPacket& packet, std::size_t max_events) { sink_.begin(packet, max_events); }
  bool has_room() const { return sink_.has_room(); }
  bool has_backlog() const { return sink_.has_backlog(); }

  /// `is_whole`: false for a packet at the end of a log that was cut.
  void take(const YarpPacket& packet, bool is_whole = true);
  /// After the last packet: the records that waited for later ones.
  void finish();

  EventCounters& counters() { return sink_.counters(); }
  const EventCounters& counters() const { return sink_.counters(); }

 private:
  void take_stamped(const YarpPacket& packet, bool is_whole);
  void take_plain(const YarpPacket& packet);
  void place_plain(const YarpPacket& packet, double start_us);
  bool is_of_this_eye(std::uint32_t address);
  void append_placed();
  void append(Timestamp time, std::uint32_t address);

  YarpRecordForm form_;
  YarpEventClock clock_;
  std::vector<TimedRecord> placed_;
  std::optional<YarpPacket> held_;      // A packet without stamps whose host time is doubtful.
  std::optional<double> plain_zero_s_;  // Host time at which the first plain packet began.
  double newest_plain_us_ = 0;          // End of the newest packet without stamps.
  EventSink sink_;
};

}  // namespace puck
