#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "common/io/event_reader.h"

namespace puck {

struct LossyReaderParams {
  double drop_percent = 0;  ///< Share of lost packets.
  std::uint64_t seed = 1;   ///< The same seed loses the same packets.
  int packet_bytes = 1472;  ///< Largest datagram.
};

/// Another reader's events after a network with packet loss: cut into the packets that puck-camera
/// would send with its default settings, of which some are dropped at random.
class LossyReader final : public EventReader {
 public:
  /// Throws std::invalid_argument for an invalid packet size.
  LossyReader(std::unique_ptr<EventReader> events, const LossyReaderParams& params);

  SensorSize sensor_size() const override { return events_->sensor_size(); }
  bool read(EventPacket& packet, std::size_t max_events) override;
  bool can_rewind() const override { return events_->can_rewind(); }
  void rewind() override;
  /// Of the other reader: lost events count as read.
  const EventCounters& counters() const override { return events_->counters(); }
  std::vector<std::string> warnings() const override;

  std::int64_t packets() const { return packets_; }  ///< Lost ones included.
  std::int64_t packets_lost() const { return packets_lost_; }
  std::int64_t events_lost() const { return events_lost_; }

 private:
  bool cut_packet();
  bool is_complete(Timestamp next) const;
  bool is_lost();

  std::unique_ptr<EventReader> events_;
  LossyReaderParams params_;
  std::size_t max_events_;
  std::mt19937_64 random_;
  EventPacket recorded_;  // Last packet of the other reader …
  std::size_t cut_ = 0;   // … and the number of its events already in packets.
  EventPacket packet_;
  std::size_t handed_out_ = 0;  // Events of packet_ returned so far.
  std::int64_t packets_ = 0;
  std::int64_t packets_lost_ = 0;
  std::int64_t events_lost_ = 0;
};

}  // namespace puck
