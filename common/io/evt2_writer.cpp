#include "common/io/evt2_writer.h"

#include "common/io/event_checks.h"
#include "common/io/time_words.h"

namespace puck {
namespace {

constexpr std::uint32_t kEvt2TimeHigh = 0x8U << 28;
constexpr int kEvt2HighBits = 28;
constexpr int kEvt2LowBits = 6;

}  // namespace

Evt2Writer::Evt2Writer(const std::filesystem::path& path, SensorSize sensor)
    : FileEventWriter(path, sensor) {
  write_raw_header("2.0", "EVT2");
}

void Evt2Writer::write(const EventPacket& packet) {
  for (const Event& event : packet.events) {
    const Timestamp time = packet.time_of(event);
    check_event(event, time, sensor_, newest_);
    newest_ = time;
    const std::int64_t high = time.us >> kEvt2LowBits;
    if (high != high_) {
      count_time_up(high_, high, kEvt2HighBits, [this](std::int64_t word) {
        file_.append_word(kEvt2TimeHigh | (static_cast<std::uint32_t>(word) & 0x0fffffffU));
      });
      high_ = high;
    }
    const std::uint32_t low_us = static_cast<std::uint32_t>(time.us) & 0x3fU;
    file_.append_word(std::uint32_t{event.polarity} << 28 | low_us << 22 |
                      std::uint32_t{event.x} << 11 | std::uint32_t{event.y});
  }
}

}  // namespace puck
