#include "common/messaging/message_seal.h"

#include <algorithm>

#include <sodium.h>

#include "common/messaging/byte_order.h"
#include "common/messaging/byte_reader.h"

namespace puck {
namespace {

// "PSL" and the seal's version, which changes with the hash or its input.
constexpr std::uint32_t kMark = 0x50534c00;
constexpr char kVersion = '2';

/// The version in a seal; nothing for a message without one.
std::optional<char> version_of_seal(std::span<const std::uint8_t> message) {
  if (message.size() < kSealBytes) return std::nullopt;
  const auto mark = ByteReader(message.last(sizeof kMark)).whole<std::uint32_t>();
  const char version = static_cast<char>(mark & 0xff);
  if ((mark & ~0xffU) != kMark || version < '1' || version > '9') return std::nullopt;
  return version;
}

}  // namespace

bool looks_sealed(std::span<const std::uint8_t> message) {
  return version_of_seal(message).has_value();
}

MessageSealer::MessageSealer(const SharedKey& key) : key_(key) {
  randombytes_buf(&sender_, sizeof sender_);
}

void MessageSealer::seal(std::string_view channel, std::vector<std::uint8_t>& message) {
  const std::uint64_t number = sealed_++;
  const SharedKey::Hash hash = key_.hash(channel, message, sender_, number);
  std::array<std::uint8_t, kSealBytes> seal{};
  put_big_endian(sender_, seal.data());
  put_big_endian(number, seal.data() + 8);
  std::copy(hash.begin(), hash.end(), seal.begin() + 16);
  put_big_endian(kMark | static_cast<std::uint32_t>(kVersion), seal.data() + 32);
  message.insert(message.end(), seal.begin(), seal.end());
}

std::optional<std::span<const std::uint8_t>> SealOpener::open(std::string_view channel,
                                                              std::span<const std::uint8_t> message,
                                                              std::string& problem) {
  const auto version = version_of_seal(message);
  if (!version) {
    problem = "is not sealed, and this service has a key";
    return std::nullopt;
  }
  if (*version != kVersion) {
    problem = std::string("has a seal of version ") + *version + ", and this service's are of " +
              kVersion + ": one of the two is another version of PUCK";
    return std::nullopt;
  }
  const auto plain = message.first(message.size() - kSealBytes);
  ByteReader seal(message.last(kSealBytes));
  const auto sender = seal.whole<std::uint64_t>();
  const auto number = seal.whole<std::uint64_t>();
  const auto hash = seal.take(std::tuple_size_v<SharedKey::Hash>);
  const SharedKey::Hash expected = key_.hash(channel, plain, sender, number);
  // Constant time, so that the duration does not reveal correct bytes of a guess.
  if (sodium_memcmp(hash.data(), expected.data(), expected.size()) != 0) {
    problem = "is sealed with a different key, or was modified on its way";
    return std::nullopt;
  }
  if (!is_first_time(sender, number)) {
    problem = "was received before: it is a replay, or the network duplicated it";
    return std::nullopt;
  }
  return plain;
}

bool SealOpener::is_first_time(std::uint64_t id, std::uint64_t number) {
  ++opened_;
  auto sender = std::find_if(senders_.begin(), senders_.end(), [id](const Sender& known) {
    return known.last_heard != 0 && known.id == id;
  });
  if (sender == senders_.end()) {
    sender = std::min_element(
        senders_.begin(), senders_.end(),
        [](const Sender& a, const Sender& b) { return a.last_heard < b.last_heard; });
    *sender = {id, number, 1, opened_};
    return true;
  }
  sender->last_heard = opened_;
  if (number > sender->newest) {
    const std::uint64_t step = number - sender->newest;
    sender->seen = step >= kWindow ? 1 : sender->seen << step | 1;
    sender->newest = number;
    return true;
  }
  const std::uint64_t age = sender->newest - number;
  if (age >= kWindow) return false;
  const std::uint64_t bit = std::uint64_t{1} << age;
  const bool is_first = (sender->seen & bit) == 0;
  sender->seen |= bit;
  return is_first;
}

}  // namespace puck
