#include "common/io/yarp_record_form.h"

#include <algorithm>

#include "common/io/yarp_address.h"

namespace puck {
namespace {

// With an unknown sensor every address would do.
constexpr SensorSize kLikelySensor{640, 480};

}  // namespace

YarpFormSample::YarpFormSample(SensorSize sensor)
    : sensor_(sensor != SensorSize{SensorSize::kMax, SensorSize::kMax} ? sensor : kLikelySensor) {}

void YarpFormSample::add(const YarpPacket& packet) {
  if (packet.words.empty() || packet.is_cut) return;
  ++packets_;
  is_bytes_ = packet.is_bytes;
  if (packet.words.size() % 2 == 1) ++odd_packets_;
  for (std::size_t i = 0; i < packet.words.size(); ++i) {
    if (is_on_sensor(packet.words[i])) ++on_sensor_[i % 2];
    if (is_yarp_event(packet.words[i])) ++of_eye_[i % 2][yarp_eye_of(packet.words[i])];
    if (i >= 2 && i % 2 == 0) ++(packet.words[i] >= packet.words[i - 2] ? rises_ : falls_);
  }
  add_pace(packet);
}

YarpRecordForm YarpFormSample::form(const std::string& eye) const {
  return {has_stamps(), us_per_tick(), eye == "auto" ? busier_eye() : eye == "right" ? 1U : 0U};
}

// Whether every other word is a stamp: stamps rise, and look like addresses on the sensor only by
// chance.
bool YarpFormSample::has_stamps() const {
  if (!is_bytes_) return true;
  return 2 * odd_packets_ < packets_ && 10 * falls_ <= rises_ &&
         10 * on_sensor_[0] < 9 * on_sensor_[1];
}

// 0.08 or 1: whichever is nearer to the median ratio of host time to stamps.
double YarpFormSample::us_per_tick() const {
  constexpr double kBetween = 3.5;  // Ticks a µs, of 12.5 and 1.
  if (ticks_per_us_.empty()) return is_bytes_ ? 1 : 0.08;
  std::vector<double> sorted = ticks_per_us_;
  std::sort(sorted.begin(), sorted.end());
  return sorted[sorted.size() / 2] > kBetween ? 0.08 : 1;
}

std::uint32_t YarpFormSample::busier_eye() const {
  std::array<std::int64_t, 2> events = of_eye_[1];
  if (!has_stamps()) {
    for (std::size_t i = 0; i < events.size(); ++i) events[i] += of_eye_[0][i];
  }
  return events[1] > events[0] ? 1 : 0;
}

bool YarpFormSample::is_on_sensor(std::uint32_t word) const {
  return is_yarp_event(word) && sensor_.contains(yarp_x_of(word), yarp_y_of(word));
}

void YarpFormSample::add_pace(const YarpPacket& packet) {
  // In a longer pause the counter may wrap.
  constexpr double kLongestPauseUs = 60e6;
  const std::uint32_t newest = packet.words[(packet.words.size() - 1) / 2 * 2] & kYarpStampMask;
  const double host_us = (packet.host_time_s - host_time_s_) * 1e6;
  const double ticks = (newest - newest_) & kYarpStampMask;
  if (packets_ > 1 && host_us > 0 && host_us < kLongestPauseUs && ticks > 0) {
    ticks_per_us_.push_back(ticks / host_us);
  }
  host_time_s_ = packet.host_time_s;
  newest_ = newest;
}

}  // namespace puck
