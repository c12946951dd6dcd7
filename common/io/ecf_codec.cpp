#include "common/io/ecf_codec.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "common/io/word_assembler.h"

namespace puck {
namespace {

// Of the header's two lowest bits: how y, x and polarity are stored.
constexpr std::uint32_t kAllPacked = 2;      // The three together, 24 bits an event.
constexpr std::uint32_t kColumnsPacked = 1;  // y in runs; x and polarity together, 12 bits.

constexpr std::uint32_t kLargeStep = 15;       // Time: four more bits of a step.
constexpr std::size_t kLongTimeRun = 15;       // A run of this length and more …
constexpr std::size_t kLongRowRun = 31;        // … is followed by
constexpr std::size_t kLongPolarityRun = 127;  // … its length in 16 bits.
constexpr int kMaskPixels = 5;

class EcfInput {
 public:
  explicit EcfInput(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <typename Word>
  Word take() {
    require(sizeof(Word));
    const Word word = load_word<Word>(bytes_.data() + used_);
    used_ += sizeof(Word);
    return word;
  }
  // Once for many words that `next` takes.
  void require(std::size_t count) const {
    if (bytes_.size() - used_ < count) fail_early();
  }
  template <typename Word>
  Word next() {
    const Word word = load_word<Word>(bytes_.data() + used_);
    used_ += sizeof(Word);
    return word;
  }
  [[noreturn, gnu::noinline]] void fail_early() const { fail("ends there"); }
  [[noreturn, gnu::noinline]] void fail_run(std::size_t run, std::size_t room) const {
    fail("a run of " + std::to_string(run) + ", expected 1 to " + std::to_string(room));
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw std::invalid_argument("malformed at byte " + std::to_string(used_) + " of " +
                                std::to_string(bytes_.size()) + ": " + what);
  }

 private:
  std::span<const std::byte> bytes_;
  std::size_t used_ = 0;
};

// Of 1 to `room` events; a run of 0 would never end.
inline void check_run(const EcfInput& input, std::size_t run, std::size_t room) {
  if (run - 1 >= room) input.fail_run(run, room);
}

void decode_times(EcfInput& input, std::span<EcfEvent> events) {
  auto t_us = input.take<std::uint64_t>();
  for (std::size_t i = 0; i < events.size();) {
    std::uint8_t code = input.take<std::uint8_t>();
    std::uint64_t step_us = 0;
    for (int shift = 0; code >> 4 == kLargeStep; shift += 4) {
      if (shift >= 64) input.fail("a time step of more than 64 bits");
      step_us |= std::uint64_t{code & 0xfU} << shift;
      code = input.take<std::uint8_t>();
    }
    t_us += step_us + (code >> 4);
    std::size_t run = code & 0xfU;
    if (run == kLongTimeRun) run = input.take<std::uint16_t>();
    check_run(input, run, events.size() - i);
    for (std::size_t end = i + run; i < end; ++i) events[i].t_us = static_cast<std::int64_t>(t_us);
  }
}

// Of a group of four, the last one of the chunk included, whose rest has no meaning.
void decode_all_packed(EcfInput& input, std::span<EcfEvent> events) {
  input.require((events.size() + 3) / 4 * 12);
  for (std::size_t i = 0; i < events.size(); i += 4) {
    const auto a = input.next<std::uint32_t>();
    const auto b = input.next<std::uint32_t>();
    const auto c = input.next<std::uint32_t>();
    const std::array<std::uint32_t, 4> packed{a >> 8, (a & 0xffU) | b >> 16 << 8,
                                              (b & 0xffffU) | c >> 24 << 16, c & 0xffffffU};
    const std::size_t group = std::min<std::size_t>(4, events.size() - i);
    for (std::size_t j = 0; j < group; ++j) {
      EcfEvent& event = events[i + j];
      event.y = static_cast<std::uint16_t>(packed[j] >> 12 & 0x7ffU);
      event.x = static_cast<std::uint16_t>(packed[j] >> 1 & 0x7ffU);
      event.polarity = static_cast<std::int16_t>(packed[j] & 1U);
    }
  }
}

void decode_columns_packed(EcfInput& input, std::span<EcfEvent> events) {
  input.require((events.size() + 3) / 4 * 6);
  for (std::size_t i = 0; i < events.size(); i += 4) {
    const std::uint32_t a = input.next<std::uint16_t>();
    const std::uint32_t b = input.next<std::uint16_t>();
    const std::uint32_t c = input.next<std::uint16_t>();
    const std::array<std::uint32_t, 4> packed{a >> 4, (a & 0xfU) | b >> 8 << 4,
                                              (b & 0xffU) | c >> 12 << 8, c & 0xfffU};
    for (std::size_t j = 0; j < 4 && i + j < events.size(); ++j) {
      events[i + j].x = static_cast<std::uint16_t>(packed[j] >> 1);
      events[i + j].polarity = static_cast<std::int16_t>(packed[j] & 1U);
    }
  }
}

void decode_rows(EcfInput& input, std::span<EcfEvent> events) {
  for (std::size_t i = 0; i < events.size();) {
    const auto code = input.take<std::uint16_t>();
    std::size_t run = code & 0x1fU;
    if (run == kLongRowRun) run = input.take<std::uint16_t>();
    check_run(input, run, events.size() - i);
    for (std::size_t end = i + run; i < end; ++i) events[i].y = code >> 5;
  }
}

void decode_masked_columns(EcfInput& input, std::span<EcfEvent> events) {
  for (std::size_t i = 0; i < events.size();) {
    const auto code = input.take<std::uint16_t>();
    const auto x = static_cast<std::uint16_t>(code >> 5);
    events[i++].x = x;
    // The last mask may name more events than there are.
    for (int j = 0; j < kMaskPixels && i < events.size(); ++j) {
      if ((code >> (kMaskPixels - 1 - j) & 1) != 0) {
        events[i++].x = static_cast<std::uint16_t>(x + j + 1);
      }
    }
  }
}

void decode_polarities(EcfInput& input, std::span<EcfEvent> events) {
  for (std::size_t i = 0; i < events.size();) {
    const auto code = input.take<std::uint8_t>();
    std::size_t run = code & 0x7fU;
    if (run == kLongPolarityRun) run = input.take<std::uint16_t>();
    check_run(input, run, events.size() - i);
    for (std::size_t end = i + run; i < end; ++i) events[i].polarity = code >> 7;
  }
}

// Number of events from the first one on with its value.
template <typename Value>
std::size_t run_length(std::span<const EcfEvent> events, Value value_of) {
  std::size_t length = 1;
  while (length < events.size() && value_of(events[length]) == value_of(events[0])) ++length;
  return length;
}

void encode_times(std::span<const EcfEvent> events, std::vector<std::byte>& bytes) {
  auto t_us = static_cast<std::uint64_t>(events[0].t_us);
  append_word(bytes, t_us);
  while (!events.empty()) {
    const std::size_t run = run_length(events, [](const EcfEvent& event) { return event.t_us; });
    std::uint64_t step_us = static_cast<std::uint64_t>(events[0].t_us) - t_us;
    t_us += step_us;
    if (step_us >= kLargeStep) {
      for (; step_us > 0; step_us >>= 4) {
        append_word(bytes, static_cast<std::uint8_t>(kLargeStep << 4 | (step_us & 0xfU)));
      }
    }
    const std::size_t code = std::min(run, kLongTimeRun);
    append_word(bytes, static_cast<std::uint8_t>(step_us << 4 | code));
    if (code == kLongTimeRun) append_word(bytes, static_cast<std::uint16_t>(run));
    events = events.subspan(run);
  }
}

void encode_all_packed(std::span<const EcfEvent> events, std::vector<std::byte>& bytes) {
  for (std::size_t i = 0; i < events.size(); i += 4) {
    std::array<std::uint32_t, 4> packed{};
    for (std::size_t j = 0; j < 4 && i + j < events.size(); ++j) {
      const EcfEvent& event = events[i + j];
      packed[j] = static_cast<std::uint32_t>(event.y << 12 | event.x << 1 | event.polarity);
    }
    append_word(bytes, packed[0] << 8 | (packed[1] & 0xffU));
    append_word(bytes, packed[1] >> 8 << 16 | (packed[2] & 0xffffU));
    append_word(bytes, packed[2] >> 16 << 24 | packed[3]);
  }
}

void encode_columns_packed(std::span<const EcfEvent> events, std::vector<std::byte>& bytes) {
  for (std::size_t i = 0; i < events.size(); i += 4) {
    std::array<std::uint32_t, 4> packed{};
    for (std::size_t j = 0; j < 4 && i + j < events.size(); ++j) {
      packed[j] = static_cast<std::uint32_t>(events[i + j].x << 1 | events[i + j].polarity);
    }
    append_word(bytes, static_cast<std::uint16_t>(packed[0] << 4 | (packed[1] & 0xfU)));
    append_word(bytes, static_cast<std::uint16_t>(packed[1] >> 4 << 8 | (packed[2] & 0xffU)));
    append_word(bytes, static_cast<std::uint16_t>(packed[2] >> 8 << 12 | packed[3]));
  }
}

void encode_rows(std::span<const EcfEvent> events, std::vector<std::byte>& bytes) {
  while (!events.empty()) {
    const std::size_t run = run_length(events, [](const EcfEvent& event) { return event.y; });
    const std::size_t code = std::min(run, kLongRowRun);
    append_word(bytes, static_cast<std::uint16_t>(std::size_t{events[0].y} << 5 | code));
    if (code == kLongRowRun) append_word(bytes, static_cast<std::uint16_t>(run));
    events = events.subspan(run);
  }
}

void encode_masked_columns(std::span<const EcfEvent> events, std::vector<std::byte>& bytes) {
  for (std::size_t i = 0; i < events.size();) {
    const int x = events[i++].x;
    int code = x << 5;
    for (int j = 1; j <= kMaskPixels && i < events.size(); ++j) {
      if (events[i].x != x + j) continue;
      code |= 1 << (kMaskPixels - j);
      ++i;
    }
    append_word(bytes, static_cast<std::uint16_t>(code));
  }
}

void encode_polarities(std::span<const EcfEvent> events, std::vector<std::byte>& bytes) {
  while (!events.empty()) {
    const std::size_t run =
        run_length(events, [](const EcfEvent& event) { return event.polarity; });
    const std::size_t code = std::min(run, kLongPolarityRun);
    append_word(bytes,
                static_cast<std::uint8_t>(static_cast<unsigned>(events[0].polarity) << 7 | code));
    if (code == kLongPolarityRun) append_word(bytes, static_cast<std::uint16_t>(run));
    events = events.subspan(run);
  }
}

}  // namespace

void decode_ecf(std::span<const std::byte> chunk, std::vector<EcfEvent>& events) {
  try {
    EcfInput input(chunk);
    const auto header = input.take<std::uint32_t>();
    if (header >> 2 > kMostEcfEvents) {
      input.fail(std::to_string(header >> 2) + " events, expected up to 65535");
    }
    events.resize(header >> 2);
    decode_times(input, events);
    if ((header & kAllPacked) != 0) {
      decode_all_packed(input, events);
      return;
    }
    decode_rows(input, events);
    if ((header & kColumnsPacked) != 0) {
      decode_columns_packed(input, events);
    } else {
      decode_masked_columns(input, events);
      decode_polarities(input, events);
    }
  } catch (const std::invalid_argument&) {
    events.clear();
    throw;
  }
}

void encode_ecf(std::span<const EcfEvent> events, std::vector<std::byte>& chunk) {
  chunk.clear();
  if (events.empty()) {
    append_word(chunk, kAllPacked);
    append_word(chunk, std::uint64_t{0});
    return;
  }
  std::vector<std::byte> rows;
  encode_rows(events, rows);
  std::vector<std::byte> columns;
  encode_masked_columns(events, columns);
  encode_polarities(events, columns);

  const std::size_t groups = (events.size() + 3) / 4;
  const bool columns_pack = groups * 6 <= columns.size();
  const bool all_pack = groups * 12 <= rows.size() + std::min(columns.size(), groups * 6);
  const std::uint32_t form = all_pack ? kAllPacked : columns_pack ? kColumnsPacked : 0;
  append_word(chunk, static_cast<std::uint32_t>(events.size() << 2 | form));
  encode_times(events, chunk);
  if (all_pack) {
    encode_all_packed(events, chunk);
    return;
  }
  chunk.insert(chunk.end(), rows.begin(), rows.end());
  if (columns_pack) {
    encode_columns_packed(events, chunk);
  } else {
    chunk.insert(chunk.end(), columns.begin(), columns.end());
  }
}

}  // namespace puck
