#include "common/io/dat_writer.h"

#include <limits>
#include <stdexcept>
#include <string>

#include "common/io/event_checks.h"

namespace puck {

DatWriter::DatWriter(const std::filesystem::path& path, SensorSize sensor)
    : FileEventWriter(path, sensor) {
  file_.append("% Data file containing CD events.\n% Version 2\n% Width " +
               std::to_string(sensor.width) + "\n% Height " + std::to_string(sensor.height) + "\n");
  // The type of the events, and the bytes of each.
  file_.append("\x0c\x08");
}

void DatWriter::write(const EventPacket& packet) {
  for (const Event& event : packet.events) {
    const Timestamp time = packet.time_of(event);
    check_event(event, time, sensor_, newest_);
    const std::int64_t longest_us =
        is_first_ ? std::int64_t{std::numeric_limits<std::uint32_t>::max()} : kLongestPauseUs;
    if (time - newest_ > longest_us) {
      throw std::invalid_argument(
          "DAT holds a first time of up to 4294 s and pauses of up to 2147 "
          "s, got " +
          std::to_string((time - newest_) / 1000000) + " s");
    }
    is_first_ = false;
    newest_ = time;
    file_.append_word(static_cast<std::uint32_t>(time.us));
    file_.append_word(std::uint32_t{event.polarity} << 28 | std::uint32_t{event.y} << 14 |
                      std::uint32_t{event.x});
  }
}

}  // namespace puck
