#include "common/messaging/datagram.h"

#include <algorithm>
#include <initializer_list>
#include <memory>
#include <random>
#include <vector>

#include <doctest/doctest.h>

namespace puck {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Parses a copy of exactly this size, so that a sanitizer sees a read beyond.
Datagram parse_exactly(const Bytes& bytes, std::unique_ptr<std::uint8_t[]>& memory) {
  memory = std::make_unique<std::uint8_t[]>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), memory.get());
  return parse_datagram({memory.get(), bytes.size()});
}

void put(Bytes& bytes, std::string_view text) {
  bytes.insert(bytes.end(), text.begin(), text.end());
}

void put_number(Bytes& bytes, std::uint64_t value, int size) {
  for (int shift = 8 * (size - 1); shift >= 0; shift -= 8) {
    bytes.push_back(static_cast<std::uint8_t>(value >> shift));
  }
}

Bytes whole_message(std::string_view channel, std::string_view payload, bool ends = true) {
  Bytes bytes;
  put(bytes, "LC02");
  put_number(bytes, 0x01020304, 4);
  put(bytes, channel);
  if (ends) bytes.push_back(0);
  put(bytes, payload);
  return bytes;
}

struct FragmentHeader {
  std::uint32_t message_size = 100;
  std::uint32_t offset = 0;
  std::uint16_t index = 0;
  std::uint16_t fragments = 2;
};

Bytes fragment(const FragmentHeader& header, std::string_view rest) {
  Bytes bytes;
  put(bytes, "LC03");
  put_number(bytes, 7, 4);
  put_number(bytes, header.message_size, 4);
  put_number(bytes, header.offset, 4);
  put_number(bytes, header.index, 2);
  put_number(bytes, header.fragments, 2);
  put(bytes, rest);
  return bytes;
}

std::string text_of(std::span<const std::uint8_t> bytes) { return {bytes.begin(), bytes.end()}; }

BadDatagram bad(const Bytes& bytes) {
  std::unique_ptr<std::uint8_t[]> memory;
  const Datagram datagram = parse_exactly(bytes, memory);
  REQUIRE(std::holds_alternative<BadDatagram>(datagram));
  return std::get<BadDatagram>(datagram);  // Its text is constant and outlives the bytes.
}

}  // namespace

TEST_CASE("a whole message is split into number, channel and payload") {
  const Bytes bytes = whole_message("PUCK_STATUS", std::string_view("a\0b", 3));
  const Datagram datagram = parse_datagram(bytes);
  REQUIRE(std::holds_alternative<WholeMessage>(datagram));
  const auto& message = std::get<WholeMessage>(datagram);
  CHECK(message.number == 0x01020304);
  CHECK(message.channel == "PUCK_STATUS");
  CHECK(text_of(message.payload) == std::string("a\0b", 3));
}

TEST_CASE("a message may have no payload, but must have a channel") {
  const Datagram datagram = parse_datagram(whole_message("A", ""));
  REQUIRE(std::holds_alternative<WholeMessage>(datagram));
  CHECK(std::get<WholeMessage>(datagram).payload.empty());
  CHECK(bad(whole_message("", "abc")).why == "has no channel name");
}

TEST_CASE("a channel name has up to 63 bytes and ends within the datagram") {
  for (std::size_t length = 1; length <= 63; ++length) {
    const Bytes bytes = whole_message(std::string(length, 'C'), "payload");
    const Datagram datagram = parse_datagram(bytes);
    REQUIRE(std::holds_alternative<WholeMessage>(datagram));
    CHECK(std::get<WholeMessage>(datagram).channel.size() == length);
    CHECK(text_of(std::get<WholeMessage>(datagram).payload) == "payload");
  }
  const auto too_long = bad(whole_message(std::string(64, 'C'), "payload"));
  CHECK(too_long.why == "has a channel name of more than 63 bytes");
  CHECK(too_long.has_magic);
  CHECK(bad(whole_message(std::string(65'000, 'C'), "", false)).why ==
        "has a channel name of more than 63 bytes");
  CHECK(bad(whole_message("PUCK_STATUS", "", false)).why == "has an unterminated channel name");
  CHECK(bad(whole_message("", "", false)).why == "has an unterminated channel name");
  CHECK(bad(whole_message(std::string(63, 'C'), "", false)).why ==
        "has an unterminated channel name");
}

TEST_CASE("a datagram shorter than a header is bad, at every length") {
  const Bytes message = whole_message("A", "");
  const Bytes part = fragment({}, std::string_view("A\0xyz", 5));
  for (std::size_t size = 0; size < 4; ++size) {
    CHECK_FALSE(bad({message.begin(), message.begin() + static_cast<long>(size)}).has_magic);
  }
  for (std::size_t size = 4; size < message.size(); ++size) {
    CHECK(bad({message.begin(), message.begin() + static_cast<long>(size)}).has_magic);
  }
  for (std::size_t size = 4; size < 22; ++size) {
    CHECK(bad({part.begin(), part.begin() + static_cast<long>(size)}).has_magic);
  }
}

TEST_CASE("a datagram without LCM's magic is not LCM") {
  Bytes bytes = whole_message("A", "abc");
  for (const char last : {'0', '1', '4', '\0'}) {
    bytes[3] = static_cast<std::uint8_t>(last);
    CHECK(bad(bytes).why == "is not one of LCM");
    CHECK_FALSE(bad(bytes).has_magic);
  }
}

TEST_CASE("only the first fragment has a channel") {
  const Bytes first = fragment({.message_size = 5}, std::string_view("CH\0abc", 6));
  const Datagram datagram = parse_datagram(first);
  REQUIRE(std::holds_alternative<MessageFragment>(datagram));
  const auto& part = std::get<MessageFragment>(datagram);
  CHECK(part.number == 7);
  CHECK(part.message_size == 5);
  CHECK(part.index == 0);
  CHECK(part.fragments == 2);
  CHECK(part.channel == "CH");
  CHECK(text_of(part.payload) == "abc");

  const Bytes second = fragment({.message_size = 5, .offset = 3, .index = 1}, "de");
  const Datagram next = parse_datagram(second);
  REQUIRE(std::holds_alternative<MessageFragment>(next));
  CHECK(std::get<MessageFragment>(next).channel.empty());
  CHECK(std::get<MessageFragment>(next).offset == 3);
  CHECK(text_of(std::get<MessageFragment>(next).payload) == "de");

  CHECK(bad(fragment({}, "CH")).why == "has an unterminated channel name");
}

TEST_CASE("a fragment must lie within its message, even where 32 bits wrap") {
  const FragmentHeader fits{.message_size = 10, .offset = 8, .index = 1};
  CHECK(std::holds_alternative<MessageFragment>(parse_datagram(fragment(fits, "ab"))));
  CHECK(bad(fragment(fits, "abc")).why == "is a fragment that reaches beyond its message");
  // What crashes liblcm: 0xfffffff0 + 16 is 0 in 32 bits.
  const FragmentHeader wraps{.message_size = 100, .offset = 0xfffffff0, .index = 1};
  CHECK(bad(fragment(wraps, "0123456789abcdef")).why ==
        "is a fragment that reaches beyond its message");
  const FragmentHeader largest{.message_size = 0xffffffff, .offset = 0xffffffff, .index = 1};
  CHECK(std::holds_alternative<MessageFragment>(parse_datagram(fragment(largest, ""))));
  CHECK(bad(fragment(largest, "a")).why == "is a fragment that reaches beyond its message");
}

TEST_CASE("a fragment's number must be below the number of fragments") {
  CHECK(bad(fragment({.index = 2, .fragments = 2}, "ab")).why ==
        "is a fragment numbered beyond the last one");
  CHECK(bad(fragment({.index = 0, .fragments = 0}, "ab")).why ==
        "is a fragment numbered beyond the last one");
  CHECK(std::holds_alternative<MessageFragment>(
      parse_datagram(fragment({.index = 65534, .fragments = 65535}, "ab"))));
}

TEST_CASE("for any bytes the returned parts lie within the datagram") {
  std::mt19937_64 random(6);
  const Bytes message = whole_message("PUCK_EVENTS", "some payload");
  const Bytes part = fragment({}, std::string_view("PUCK_EVENTS\0payload", 19));
  int good = 0;
  for (int i = 0; i < 200'000; ++i) {
    Bytes bytes = i % 2 == 0 ? message : part;
    bytes.resize(random() % (bytes.size() + 1));
    for (std::size_t spoilt = random() % 4; spoilt > 0 && !bytes.empty(); --spoilt) {
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    }
    std::unique_ptr<std::uint8_t[]> memory;
    const Datagram datagram = parse_exactly(bytes, memory);
    const auto inside = [&](const void* begin, std::size_t size) {
      const auto* from = static_cast<const std::uint8_t*>(begin);
      return from >= memory.get() && from + size <= memory.get() + bytes.size();
    };
    if (const auto* whole = std::get_if<WholeMessage>(&datagram)) {
      ++good;
      REQUIRE(inside(whole->channel.data(), whole->channel.size()));
      REQUIRE(inside(whole->payload.data(), whole->payload.size()));
      REQUIRE(8 + whole->channel.size() + 1 + whole->payload.size() == bytes.size());
    } else if (const auto* a_part = std::get_if<MessageFragment>(&datagram)) {
      ++good;
      REQUIRE(inside(a_part->payload.data(), a_part->payload.size()));
      REQUIRE(a_part->index < a_part->fragments);
      REQUIRE(std::uint64_t{a_part->offset} + a_part->payload.size() <= a_part->message_size);
    } else {
      REQUIRE_FALSE(std::get<BadDatagram>(datagram).why.empty());
    }
  }
  CHECK(good > 10'000);
}

TEST_CASE("a displayed name cannot control a terminal or imitate another name") {
  CHECK(printable("PUCK_EVENTS 1~") == "PUCK_EVENTS 1~");
  CHECK(printable("\x1b[2J\n\x7f\xc3\xa9") == "\\x1b[2J\\x0a\\x7f\\xc3\\xa9");
  CHECK(printable("a\\x0a") == "a\\x5cx0a");
  CHECK(printable(std::string_view("a\0b", 3)) == "a\\x00b");
  CHECK(printable(std::string(1000, 'x')).size() == 63);
}

}  // namespace puck
