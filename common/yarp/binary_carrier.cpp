#include "common/yarp/binary_carrier.h"

#include <algorithm>

#include "common/yarp/yarp_error.h"

namespace puck {
namespace {

// YARP's tagged header: `Y A`, int32, `R P`.
constexpr std::size_t kTaggedBytes = 8;
constexpr std::array<std::uint8_t, kTaggedBytes> kHello{'Y', 'A', 0x64, 0x1E, 0, 0, 'R', 'P'};
constexpr std::array<std::uint8_t, kTaggedBytes> kIndex{'Y', 'A', 10, 0, 0, 0, 'R', 'P'};

// A message's index: number of blocks, number of reply blocks, unused bytes.
constexpr std::size_t kIndexBytes = 10;
constexpr std::uint8_t kAnswerBlocks = 1;
constexpr std::uint8_t kUnused = 0xFF;
// A vector or a packet of events takes a few blocks, an envelope one more.
constexpr std::size_t kMostBlocks = 64;

bool is_tagged(std::span<const std::uint8_t> bytes) {
  return bytes[0] == 'Y' && bytes[1] == 'A' && bytes[6] == 'R' && bytes[7] == 'P';
}

void append(Bytes& to, std::span<const std::uint8_t> bytes) {
  to.insert(to.end(), bytes.begin(), bytes.end());
}

}  // namespace

Bytes hello(std::string_view name) {
  Bytes bytes(kHello.begin(), kHello.end());
  append_int(bytes, static_cast<std::int32_t>(name.size() + 1));
  bytes.insert(bytes.end(), name.begin(), name.end());
  bytes.push_back(0);
  return bytes;
}

void check_hello_answer(std::span<const std::uint8_t, kHelloAnswerBytes> answer) {
  if (!is_tagged(answer) || answer[4] != 0 || answer[5] != 0) {
    throw YarpError("it does not answer in the binary carrier");
  }
}

void append_message(PortCommand command, std::span<const std::uint8_t> payload, Bytes& to) {
  const std::array<std::uint8_t, 8> first{0, 0, 0, 0, '~', static_cast<std::uint8_t>(command),
                                          0, 1};
  const bool has_payload = !payload.empty();
  append(to, kIndex);
  to.push_back(has_payload ? 2 : 1);
  to.push_back(kAnswerBlocks);
  to.insert(to.end(), kIndexBytes - 2, kUnused);
  append_int(to, first.size());
  if (has_payload) append_int(to, static_cast<std::int32_t>(payload.size()));
  append_int(to, 0);
  append(to, first);
  append(to, payload);
}

void MessageReader::feed(std::span<const std::uint8_t> bytes) {
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(begin_));
  begin_ = 0;
  append(bytes_, bytes);
}

std::optional<std::span<const std::uint8_t>> MessageReader::next() {
  const auto whole = std::span<const std::uint8_t>(bytes_).subspan(begin_);
  const auto refuse = [](const char* why) {
    throw YarpError(std::string("it sent an invalid message: ") + why);
  };
  if (whole.size() < kTaggedBytes) {
    if (!std::equal(whole.begin(), whole.end(), kIndex.begin())) refuse("wrong header");
    return std::nullopt;
  }
  if (!std::equal(kIndex.begin(), kIndex.end(), whole.begin())) refuse("wrong header");
  LittleEndianReader reader(whole.subspan(kTaggedBytes));
  if (reader.left() < kIndexBytes) return std::nullopt;
  const auto index = reader.take(kIndexBytes);
  const std::size_t blocks = index[0];
  if (blocks == 0 || blocks > kMostBlocks) refuse("impossible number of blocks");
  if (index[1] != kAnswerBlocks) refuse("unexpected reply blocks");
  const auto unused = index.subspan(2);
  if (!std::all_of(unused.begin(), unused.end(), [](std::uint8_t b) { return b == kUnused; })) {
    refuse("index not padded");
  }

  constexpr std::size_t kSizeBytes = 4;
  if (reader.left() < kSizeBytes * (blocks + kAnswerBlocks)) return std::nullopt;
  std::size_t size = 0;
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::int32_t block = reader.whole();
    if (block < 0 || static_cast<std::size_t>(block) > most_bytes_ - size) {
      refuse("larger than expected");
    }
    size += static_cast<std::size_t>(block);
  }
  if (reader.whole() != 0) refuse("unexpected reply blocks");
  if (reader.left() < size) return std::nullopt;
  begin_ += kTaggedBytes + reader.at() + size;
  return reader.take(size);
}

}  // namespace puck
