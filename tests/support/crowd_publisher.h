#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <vector>

#include "common/messages/host_time.h"
#include "common/messaging/bus.h"
#include "common/messaging/event_packing.h"

namespace puck {

/// Publishes events of random pixels in packets of the largest size; their sensor time is the
/// host's since the start of this object. One thread.
class CrowdPublisher {
 public:
  /// Throws std::runtime_error without a route to the network.
  explicit CrowdPublisher(const std::string& url, const std::string& key_file = {})
      : bus_({.url = url, .key_file = key_file}),
        packer_({.sensor = kSensor, .packet_bytes = EventPackerParams::kMaxBytes}) {
    std::stop_source give_up;
    if (!bus_.start(give_up.get_token(), [&](const std::string&) { give_up.request_stop(); })) {
      throw std::runtime_error("no multicast route on this machine");
    }
    std::mt19937 random(1);
    for (Event& event : events_) {
      event.x = static_cast<std::uint16_t>(random() % kSensor.width);
      event.y = static_cast<std::uint16_t>(random() % kSensor.height) & 0x7fff;
      event.polarity = random() & 1;
    }
  }

  /// Publishes so many at once, at most 15000. Returns their sensor time, now, µs.
  std::int64_t publish(std::size_t count) {
    const std::int64_t now_us = host_utime() - zero_utime_;
    packer_.pack({now_us}, std::span(events_).first(count), [this](event_packet_t& packet) {
      packet.sensor_zero_utime = zero_utime_;
      bus_.publish(packet);
    });
    return now_us;
  }

  std::int64_t events() const { return packer_.events_packed(); }

 private:
  static constexpr SensorSize kSensor{640, 480};

  Bus bus_;
  EventPacker packer_;
  std::int64_t zero_utime_ = host_utime();
  std::vector<Event> events_ = std::vector<Event>(15'000);
};

}  // namespace puck
