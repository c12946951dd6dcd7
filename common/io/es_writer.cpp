#include "common/io/es_writer.h"

#include <stdexcept>
#include <string>
#include <string_view>

#include "common/io/event_checks.h"

namespace puck {
namespace {

constexpr std::int64_t kEsOverflow_us = 127;
// Signature, version 2.0.0, type of stream 1 (DVS).
constexpr std::string_view kEsStart("Event Stream\2\0\0\1", 16);

}  // namespace

EsWriter::EsWriter(const std::filesystem::path& path, SensorSize sensor)
    : FileEventWriter(path, sensor) {
  file_.append(kEsStart);
  file_.append_word(static_cast<std::uint16_t>(sensor.width));
  file_.append_word(static_cast<std::uint16_t>(sensor.height));
}

void EsWriter::write(const EventPacket& packet) {
  for (const Event& event : packet.events) {
    const Timestamp time = packet.time_of(event);
    check_event(event, time, sensor_, newest_);
    std::int64_t step_us = time - newest_;
    if (step_us > kLongestPauseUs) {
      throw std::invalid_argument(
          "Event Stream holds pauses, and a first time, of up to 1 h, got " +
          std::to_string(step_us / 1000000) + " s");
    }
    pauses_.add(step_us, "Event Stream");
    newest_ = time;
    for (; step_us >= kEsOverflow_us; step_us -= kEsOverflow_us) file_.append("\xff");
    file_.append_word(static_cast<std::uint8_t>(step_us << 1 | event.polarity));
    file_.append_word(std::uint16_t{event.x});
    file_.append_word(static_cast<std::uint16_t>(sensor_.height - 1 - event.y));
  }
}

}  // namespace puck
