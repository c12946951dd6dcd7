#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/io/event_order.h"
#include "common/io/event_reader.h"
#include "common/io/yarp_packet.h"
#include "common/io/yarp_packet_decoder.h"
#include "common/io/yarp_record_form.h"

namespace puck {

/// The events of an IIT camera's port, from the messages of one connection. They are the events of
/// a log of the same messages: µs since the first one, of one eye. One thread at a time.
///
/// The form of the records is detected from the first messages, which wait until it is decided.
class YarpStream {
 public:
  /// Messages that decide the form.
  static constexpr int kSampleMessages = 32;

  /// `name` stands for the port in messages. Throws EventFileError unless `options` hold the
  /// sensor's size.
  YarpStream(const std::string& name, const EventFileOptions& options);

  /// Takes a message that was sent at `sent_s`, on any one clock.
  void add(std::span<const std::uint8_t> message, double sent_s);

  /// Whether messages wait for the form.
  bool is_undecided() const { return !waiting_.empty(); }
  /// Decides the form from what has come, for a camera that sends little.
  void decide();

  /// Nothing follows: the rest can be taken.
  void finish();

  /// Replaces the events in `packet` by the next ones, at most `max_events`. Returns false, with an
  /// empty packet, while there is none.
  bool take(EventPacket& packet, std::size_t max_events) { return order_.take(packet, max_events); }

  SensorSize sensor_size() const { return sensor_; }
  EventCounters counters() const { return decoder_ ? decoder_->counters() : EventCounters{}; }
  std::int64_t dropped() const { return counters().dropped() + order_.dropped(); }
  /// Messages that are no events of a camera.
  std::int64_t malformed_messages() const { return malformed_messages_; }

 private:
  void decode(const YarpPacket& packet);
  void hand_on();

  EventFileOptions options_;
  SensorSize sensor_;
  YarpPacket packet_;
  YarpFormSample sample_;
  std::vector<YarpPacket> waiting_;
  std::size_t waiting_words_ = 0;
  std::optional<YarpPacketDecoder> decoder_;  // Once the form is decided.
  EventPacket decoded_;
  EventOrder order_;
  std::int64_t malformed_messages_ = 0;
};

}  // namespace puck
