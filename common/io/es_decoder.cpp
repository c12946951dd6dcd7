#include "common/io/es_decoder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "common/events/event_bits.h"
#include "common/io/event_sink.h"
#include "common/io/word_assembler.h"

namespace puck {
namespace {

enum class EsType : std::uint8_t { kGeneric, kDvs, kAtis, kDisplay, kColour };

constexpr std::size_t kTypeByte = 15;
constexpr std::size_t kHeaderBytes = 20;
constexpr std::size_t kEventBytes = 5;

/// The first byte of an event of a DVS: 7 bits of time, polarity.
struct DvsByte {
  static std::uint32_t step_us(std::uint32_t byte) { return byte >> 1; }
  static bool is_time_only(std::uint32_t byte) { return byte >= 0xfe; }
  static std::uint32_t overflow_us(std::uint32_t byte) { return byte == 0xff ? 127 : 0; }
  static std::uint32_t polarity(std::uint32_t byte) { return byte & 1U; }
  static bool is_change(std::uint32_t /*byte*/) { return true; }
};

/// … and of an ATIS: 6 bits of time, polarity, whether it belongs to a grey level.
struct AtisByte {
  static std::uint32_t step_us(std::uint32_t byte) { return byte >> 2; }
  static bool is_time_only(std::uint32_t byte) { return byte >= 0xfc; }
  static std::uint32_t overflow_us(std::uint32_t byte) { return 63 * (byte & 3U); }
  static std::uint32_t polarity(std::uint32_t byte) { return byte >> 1 & 1U; }
  static bool is_change(std::uint32_t byte) { return (byte & 1U) == 0; }
};

template <typename FirstByte>
class EsDecoder final : public EventDecoder {
 public:
  EsDecoder(SensorSize sensor, std::int64_t reorder_us) : sink_(sensor, reorder_us) {}

  std::size_t decode(std::span<const std::byte> bytes, EventPacket& packet,
                     std::size_t max_events) override {
    sink_.begin(packet, max_events);
    std::size_t used = 0;
    while (sink_.has_room() && used < bytes.size()) {
      if (partial_bytes_ == 0) {
        used += take_run(bytes.subspan(used));
        if (used == bytes.size()) break;
      }
      put(bytes[used++]);
    }
    return used;
  }

  void finish() override {
    sink_.counters().truncated_bytes += static_cast<std::int64_t>(partial_bytes_);
    partial_bytes_ = 0;
  }

  bool has_backlog() const override { return sink_.has_backlog(); }
  const EventCounters& counters() const override { return sink_.counters(); }
  Timestamp newest() const override { return sink_.newest(); }

 private:
  static constexpr std::size_t kRunEvents = 1024;

  static std::uint32_t x_of(const std::byte* event) { return load_word<std::uint16_t>(event + 1); }
  static std::uint32_t y_of(const std::byte* event) { return load_word<std::uint16_t>(event + 3); }

  // Decodes what is complete, up to the first event that needs the checks of `put`. The one that
  // fills the packet is also left to it.
  std::size_t take_run(std::span<const std::byte> bytes) {
    const std::size_t room = sink_.room_at(time_);
    if (room < 2) return 0;
    const Event* const full = run_.data() + std::min(room - 1, kRunEvents);
    const auto width = static_cast<std::uint32_t>(sink_.sensor().width);
    const auto height = static_cast<std::uint32_t>(sink_.sensor().height);
    std::int64_t offset_us = time_ - sink_.packet_start();
    const std::int64_t start_us = offset_us;
    Event* out = run_.data();
    std::size_t used = 0;
    while (out < full && used + kEventBytes <= bytes.size()) {
      const std::byte* event = bytes.data() + used;
      const auto first = std::to_integer<std::uint32_t>(*event);
      if (FirstByte::is_time_only(first)) {
        offset_us += FirstByte::overflow_us(first);
        ++used;
        continue;
      }
      const std::uint32_t x = x_of(event);
      const std::uint32_t y = height - 1 - y_of(event);
      const std::int64_t event_us = offset_us + FirstByte::step_us(first);
      if (x >= width || y >= height || !FirstByte::is_change(first) ||
          event_us > std::numeric_limits<std::uint32_t>::max()) {
        break;
      }
      offset_us = event_us;
      *out++ = std::bit_cast<Event>(
          event_bits(x, y, FirstByte::polarity(first), static_cast<std::uint32_t>(event_us)));
      used += kEventBytes;
    }
    time_ = time_ + (offset_us - start_us);
    sink_.append_run({run_.data(), out});
    return used;
  }

  void put(std::byte byte) {
    partial_[partial_bytes_++] = byte;
    const auto first = std::to_integer<std::uint32_t>(partial_[0]);
    if (FirstByte::is_time_only(first)) {
      time_ = time_ + FirstByte::overflow_us(first);
      partial_bytes_ = 0;
    } else if (partial_bytes_ == kEventBytes) {
      partial_bytes_ = 0;
      time_ = time_ + FirstByte::step_us(first);
      if (!FirstByte::is_change(first)) {
        ++sink_.counters().other_data;
        return;
      }
      const auto x = static_cast<int>(x_of(partial_.data()));
      const auto y = static_cast<int>(y_of(partial_.data()));
      sink_.append(time_, x, sink_.sensor().height - 1 - y, FirstByte::polarity(first) != 0);
    }
  }

  EventSink sink_;
  Timestamp time_;  // Of the newest event.
  std::array<std::byte, kEventBytes> partial_{};
  std::size_t partial_bytes_ = 0;
  std::array<Event, kRunEvents> run_{};
};

[[noreturn]] void refuse(const StreamHead& head, const std::string& found) {
  throw EventFileError(head.name + ": is an Event Stream file of " + found +
                       "; expected version 2, and DVS or ATIS events");
}

EsType checked_type(const StreamHead& head) {
  const auto byte = [&](std::size_t i) { return std::to_integer<int>(head.bytes[i]); };
  constexpr std::size_t kMajorByte = 12;
  if (byte(kMajorByte) != 2) {
    refuse(head, "version " + std::to_string(byte(kMajorByte)) + "." +
                     std::to_string(byte(kMajorByte + 1)));
  }
  switch (static_cast<EsType>(byte(kTypeByte))) {
    case EsType::kDvs:
      return EsType::kDvs;
    case EsType::kAtis:
      return EsType::kAtis;
    case EsType::kGeneric:
      refuse(head, "generic events");
    case EsType::kDisplay:
      refuse(head, "display events");
    case EsType::kColour:
      refuse(head, "colour events");
  }
  refuse(head, "the unknown type " + std::to_string(byte(kTypeByte)));
}

}  // namespace

std::optional<StreamStart> begin_es(const StreamHead& head) {
  if (head.bytes.size() < kHeaderBytes) {
    if (!head.is_all) return std::nullopt;
    throw EventFileError(head.name + ": ends within its Event Stream header of 20 bytes, at byte " +
                         std::to_string(head.bytes.size()));
  }
  const EsType type = checked_type(head);
  const std::byte* size = head.bytes.data() + kTypeByte + 1;
  const SensorSize sensor{load_word<std::uint16_t>(size), load_word<std::uint16_t>(size + 2)};
  if (!sensor.is_valid()) {
    throw EventFileError(head.name + ": the Event Stream header gives a sensor of " +
                         std::to_string(sensor.width) + " x " + std::to_string(sensor.height) +
                         ", at byte 16; expected 1 x 1 to 2048 x 2048");
  }
  StreamStart start{.header_bytes = kHeaderBytes, .encoding = "Event Stream"};
  start.stated_sensor = sensor;
  start.repeat = "Event Stream";
  start.make_decoder = [type](SensorSize size_of_sensor,
                              std::int64_t reorder_us) -> std::unique_ptr<EventDecoder> {
    if (type == EsType::kAtis) {
      return std::make_unique<EsDecoder<AtisByte>>(size_of_sensor, reorder_us);
    }
    return std::make_unique<EsDecoder<DvsByte>>(size_of_sensor, reorder_us);
  };
  return start;
}

}  // namespace puck
