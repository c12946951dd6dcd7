#include "common/io/evt21_writer.h"

#include <span>

#include "common/io/event_checks.h"
#include "common/io/event_vector.h"
#include "common/io/time_words.h"

namespace puck {
namespace {

constexpr std::uint64_t kEvt21TimeHigh = std::uint64_t{0x8} << 60;
constexpr int kEvt21HighBits = 28;
constexpr int kEvt21LowBits = 6;

}  // namespace

Evt21Writer::Evt21Writer(const std::filesystem::path& path, SensorSize sensor)
    : FileEventWriter(path, sensor) {
  write_raw_header("2.1", "EVT21", ";endianness=little");
}

void Evt21Writer::write(const EventPacket& packet) {
  const std::span<const Event> events = packet.events;
  for (std::size_t i = 0; i < events.size();) {
    const Event& first = events[i];
    const Timestamp time = packet.time_of(first);
    std::uint64_t mask = 0;
    std::size_t end = i;
    do {
      check_event(events[end], time, sensor_, newest_);
      mask |= std::uint64_t{1} << (events[end].x % kVectorPixels);
      ++end;
    } while (end < events.size() && continues_vector(events[end - 1], events[end]));
    newest_ = time;

    const std::int64_t high = time.us >> kEvt21LowBits;
    if (high != high_) {
      count_time_up(high_, high, kEvt21HighBits, [this](std::int64_t word) {
        file_.append_word(kEvt21TimeHigh | (static_cast<std::uint64_t>(word) & 0x0fffffffU) << 32);
      });
      high_ = high;
    }
    const std::uint64_t low_us = static_cast<std::uint64_t>(time.us) & 0x3fU;
    const auto base = static_cast<std::uint64_t>(first.x / kVectorPixels * kVectorPixels);
    file_.append_word(std::uint64_t{first.polarity} << 60 | low_us << 54 | base << 43 |
                      std::uint64_t{first.y} << 32 | mask);
    i = end;
  }
}

}  // namespace puck
