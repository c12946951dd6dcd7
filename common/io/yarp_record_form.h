#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/events/sensor_size.h"
#include "common/io/yarp_packet.h"

namespace puck {

/// What no packet of an IIT camera states of its records.
struct YarpRecordForm {
  bool has_stamps = true;  ///< A stamp before each address in the bytes of a string.
  double us_per_tick = 1;  ///< Of the stamps: 0.08 or 1.
  std::uint32_t eye = 0;   ///< Whose events are read; 0: left, 1: right.
};

/// Detects the form of a camera's records from its first packets.
class YarpFormSample {
 public:
  /// With an unknown sensor (SensorSize::kMax) a usual one is assumed.
  explicit YarpFormSample(SensorSize sensor);

  void add(const YarpPacket& packet);

  /// Number of packets with records so far.
  int packets() const { return packets_; }

  /// `eye` is "left", "right", or "auto": the one with more events.
  YarpRecordForm form(const std::string& eye) const;

 private:
  bool has_stamps() const;
  double us_per_tick() const;
  std::uint32_t busier_eye() const;
  bool is_on_sensor(std::uint32_t word) const;
  void add_pace(const YarpPacket& packet);

  SensorSize sensor_;
  int packets_ = 0;
  bool is_bytes_ = false;
  // Counts for words at even places, possibly stamps, and at odd places, the addresses behind them.
  std::array<std::int64_t, 2> on_sensor_{};
  std::array<std::array<std::int64_t, 2>, 2> of_eye_{};
  int odd_packets_ = 0;
  std::int64_t rises_ = 0;
  std::int64_t falls_ = 0;
  double host_time_s_ = 0;
  std::uint32_t newest_ = 0;
  std::vector<double> ticks_per_us_;  // From one packet to the next.
};

}  // namespace puck
