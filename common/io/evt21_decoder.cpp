#include "common/io/evt21_decoder.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "common/events/event_bits.h"
#include "common/io/event_vector.h"
#include "common/io/word_stream_end.h"

namespace puck {
namespace {

enum class Evt21Type : std::uint32_t {
  kDarker = 0x0,
  kBrighter = 0x1,
  kTimeHigh = 0x8,
  kTrigger = 0xA,
  kOther = 0xE,
  kContinued = 0xF,
};

/// The parts of a word.
struct Evt21Word {
  explicit Evt21Word(std::uint64_t word)
      : high(static_cast<std::uint32_t>(word >> 32)), mask(static_cast<std::uint32_t>(word)) {}

  std::uint32_t type() const { return high >> 28; }
  std::uint32_t low_us() const { return high >> 22 & 0x3fU; }
  std::uint32_t x() const { return high >> 11 & 0x7ffU; }
  std::uint32_t y() const { return high & 0x7ffU; }
  bool is_vector() const { return type() <= 1; }
  bool is_valid_vector() const {
    return static_cast<bool>(static_cast<unsigned>(mask != 0) &
                             static_cast<unsigned>(x() % kVectorPixels == 0));
  }

  std::uint32_t high;
  std::uint32_t mask;
};

bool is_time(std::uint64_t bits) {
  const Evt21Word word(bits);
  return word.type() == static_cast<std::uint32_t>(Evt21Type::kTimeHigh) && word.mask == 0;
}

}  // namespace

std::size_t Evt21Decoder::decode(std::span<const std::byte> bytes, EventPacket& packet,
                                 std::size_t max_events) {
  sink_.begin(packet, max_events);
  if (!sink_.has_room()) return 0;
  return words_.feed(
      bytes, [this](std::span<const std::byte> rest) { return take_run(rest); },
      [this](std::uint64_t word) {
        take(std::rotl(word, turn_bits_));
        return sink_.has_room();
      });
}

void Evt21Decoder::finish() { finish_words(words_, clock_, sink_); }

std::optional<Evt21Decoder::Order> Evt21Decoder::likely_order(std::span<const std::byte> data) {
  // Cameras repeat them every few µs. Words with their halves swapped look like vectors.
  std::int64_t little_times = 0;
  std::int64_t legacy_times = 0;
  for (std::size_t i = 0; i + sizeof(std::uint64_t) <= data.size(); i += sizeof(std::uint64_t)) {
    const auto word = load_word<std::uint64_t>(data.data() + i);
    little_times += is_time(word) ? 1 : 0;
    legacy_times += is_time(std::rotl(word, 32)) ? 1 : 0;
  }
  if (little_times == legacy_times) return std::nullopt;
  return legacy_times > little_times ? Order::kLegacy : Order::kLittle;
}

// Decodes vectors up to the first other word, or the first that needs the checks of `take`.
std::size_t Evt21Decoder::take_run(std::span<const std::byte> bytes) {
  if (bytes.size() < sizeof(std::uint64_t) || !clock_.is_steady()) return 0;
  const auto word_at = [&](std::size_t i) {
    return Evt21Word(
        std::rotl(load_word<std::uint64_t>(bytes.data() + i * sizeof(std::uint64_t)), turn_bits_));
  };
  const std::uint32_t first_us = word_at(0).low_us();
  const std::size_t room = sink_.room_at(clock_.time_of(first_us));
  if (room <= kVectorEvents) return 0;
  Event* out = run_.data();
  const Event* const full = out + std::min(room - kVectorEvents, kRunEvents);
  const std::size_t words = bytes.size() / sizeof(std::uint64_t);
  const auto width = static_cast<std::uint32_t>(sink_.sensor().width);
  const auto height = static_cast<std::uint32_t>(sink_.sensor().height);
  const std::int64_t base_us = clock_.time_of(0) - sink_.packet_start();
  std::int64_t newest_us = base_us + first_us;

  std::size_t taken = 0;
  for (; taken < words && out < full; ++taken) {
    const Evt21Word word = word_at(taken);
    const std::int64_t offset_us = base_us + word.low_us();
    const std::uint32_t last_x =
        word.x() + kVectorPixels - 1 - static_cast<std::uint32_t>(std::countl_zero(word.mask));
    if (!word.is_vector() || !word.is_valid_vector() || last_x >= width || word.y() >= height ||
        offset_us < newest_us || offset_us > std::numeric_limits<std::uint32_t>::max()) {
      break;
    }
    newest_us = offset_us;
    const std::uint64_t first =
        event_bits(word.x(), word.y(), word.type(), static_cast<std::uint32_t>(offset_us));
    for (std::uint32_t mask = word.mask; mask != 0; mask &= mask - 1) {
      *out++ = std::bit_cast<Event>(
          first + event_bits(static_cast<std::uint32_t>(std::countr_zero(mask)), 0, 0, 0));
    }
  }
  sink_.append_run({run_.data(), out});
  return taken * sizeof(std::uint64_t);
}

void Evt21Decoder::take(std::uint64_t bits) {
  const Evt21Word word(bits);
  switch (static_cast<Evt21Type>(word.type())) {
    case Evt21Type::kDarker:
    case Evt21Type::kBrighter:
      break;
    case Evt21Type::kTimeHigh:
      clock_.set_high(word.high & 0x0fffffff, sink_);
      return;
    case Evt21Type::kTrigger:
    case Evt21Type::kOther:
    case Evt21Type::kContinued:
      return;
    default:
      ++sink_.counters().malformed_words;
      return;
  }
  if (!word.is_valid_vector()) {
    ++sink_.counters().malformed_words;
    return;
  }
  if (!clock_.is_known()) {
    sink_.counters().before_start += std::popcount(word.mask);
    return;
  }
  for (std::uint32_t mask = word.mask; mask != 0; mask &= mask - 1) {
    const int x = static_cast<int>(word.x()) + std::countr_zero(mask);
    clock_.append(word.low_us(), x, static_cast<int>(word.y()),
                  word.type() == static_cast<std::uint32_t>(Evt21Type::kBrighter), sink_);
  }
}

}  // namespace puck
