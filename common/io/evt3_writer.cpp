#include "common/io/evt3_writer.h"

#include <stdexcept>
#include <string>

#include "common/io/event_checks.h"
#include "common/io/event_vector.h"
#include "common/io/time_words.h"

namespace puck {
namespace {

constexpr int kLowBits = 12;
constexpr int kHighBits = 12;

// A vector costs four words.
constexpr std::size_t kVectorPays = 5;

}  // namespace

Evt3Writer::Evt3Writer(const std::filesystem::path& path, SensorSize sensor)
    : FileEventWriter(path, sensor) {
  write_raw_header("3.0", "EVT3");
}

void Evt3Writer::write(const EventPacket& packet) {
  const std::span<const Event> events = packet.events;
  for (std::size_t i = 0; i < events.size();) {
    const Event& first = events[i];
    const Timestamp time = packet.time_of(first);
    check_event(first, time, sensor_, newest_);
    move_clock_to(time);
    newest_ = time;
    if (first.y != row_) {
      row_ = first.y;
      put(Evt3Type::kRow, first.y);
    }
    std::size_t end = i + 1;
    while (end < events.size() && continues_vector(events[end - 1], events[end]) &&
           events[end].x < sensor_.width) {
      ++end;
    }
    write_run(events.subspan(i, end - i));
    i = end;
  }
}

void Evt3Writer::write_run(std::span<const Event> run) {
  const std::uint32_t polarity = run.front().polarity ? 0x800u : 0u;
  if (run.size() < kVectorPays) {
    for (const Event& event : run) put(Evt3Type::kColumn, polarity | event.x);
    return;
  }
  const std::uint32_t base = run.front().x / kVectorPixels * kVectorPixels;
  std::uint32_t mask = 0;
  for (const Event& event : run) mask |= 1u << (event.x - base);
  put(Evt3Type::kVectorBase, polarity | base);
  put(Evt3Type::kVector12, mask & 0xfffu);
  put(Evt3Type::kVector12, (mask >> 12) & 0xfffu);
  put(Evt3Type::kVector8, mask >> 24);
}

void Evt3Writer::move_clock_to(Timestamp time) {
  const std::int64_t high = time.us >> kLowBits;
  if (high != high_) {
    if (time - newest_ > kLongestPauseUs) {
      throw std::invalid_argument("EVT3 holds pauses, and a first time, of up to 24 h, got " +
                                  std::to_string((time - newest_) / 1000000) + " s");
    }
    count_time_up(high_, high, kHighBits, [this](std::int64_t word) {
      put(Evt3Type::kTimeHigh, static_cast<std::uint32_t>(word));
    });
    high_ = high;
    low_us_ = -1;
  }
  const std::int64_t low_us = time.us & ((1 << kLowBits) - 1);
  if (low_us != low_us_) {
    put(Evt3Type::kTimeLow, static_cast<std::uint32_t>(low_us));
    low_us_ = low_us;
  }
}

void Evt3Writer::put(Evt3Type type, std::uint32_t payload) {
  file_.append_word(
      static_cast<std::uint16_t>(static_cast<std::uint32_t>(type) << 12 | (payload & 0xfffu)));
}

}  // namespace puck
