#include "common/messaging/fragment_assembly.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

const Sender kSender{0x7f000001, 5000};
const std::string kText = "abcdefghij";

MessageFragment part(std::uint16_t index, std::uint16_t fragments, std::uint32_t offset,
                     std::size_t size, std::uint32_t number = 1) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(kText.data());
  return {.number = number,
          .message_size = static_cast<std::uint32_t>(kText.size()),
          .offset = offset,
          .index = index,
          .fragments = fragments,
          .channel = index == 0 ? "PUCK_STATUS" : "",
          .payload = {bytes + offset, size}};
}

/// Feeds fragments in order; returns the text of the complete message, or the error.
std::string assembled(FragmentAssembly& assembly, const std::vector<MessageFragment>& fragments,
                      const Sender& sender = kSender) {
  std::string result;
  for (const MessageFragment& fragment : fragments) {
    std::optional<std::string> problem;
    const auto whole = assembly.add(sender, fragment, problem);
    if (problem) return *problem;
    if (whole)
      result += whole->channel + ":" + std::string(whole->payload.begin(), whole->payload.end());
  }
  return result;
}

std::string assembled(const std::vector<MessageFragment>& fragments) {
  FragmentAssembly assembly;
  return assembled(assembly, fragments);
}

}  // namespace

TEST_CASE("a message is complete after all its parts, in any order and once each") {
  CHECK(assembled({part(0, 3, 0, 4), part(1, 3, 4, 4), part(2, 3, 8, 2)}) ==
        "PUCK_STATUS:abcdefghij");
  CHECK(assembled({part(2, 3, 8, 2), part(0, 3, 0, 4), part(1, 3, 4, 4)}) ==
        "PUCK_STATUS:abcdefghij");
  CHECK(assembled({part(0, 3, 0, 4), part(0, 3, 0, 4), part(2, 3, 8, 2)}).empty());
  CHECK(assembled({part(0, 1, 0, 10)}) == "PUCK_STATUS:abcdefghij");
}

TEST_CASE("parts that overlap, leave a gap or end too early make no message") {
  CHECK(assembled({part(0, 2, 0, 6), part(1, 2, 4, 6)}) ==
        "is the last fragment of a message with a gap or an overlap");
  CHECK(assembled({part(0, 2, 0, 4), part(1, 2, 6, 4)}) ==
        "is the last fragment of a message with a gap or an overlap");
  CHECK(assembled({part(0, 2, 0, 4), part(1, 2, 4, 4)}) ==
        "is the last fragment of a message that ends too early");
}

TEST_CASE("contradictory parts drop their message") {
  FragmentAssembly assembly;
  MessageFragment larger = part(1, 2, 4, 6);
  larger.message_size = 11;
  CHECK(assembled(assembly, {part(0, 2, 0, 4), larger}) ==
        "is a fragment that contradicts another one of its message");
  CHECK(assembled(assembly, {part(1, 2, 4, 6)}).empty());
  CHECK(assembled(assembly, {part(0, 2, 0, 4)}) == "PUCK_STATUS:abcdefghij");
}

TEST_CASE("a message above the size limit is refused before memory is allocated") {
  FragmentAssembly assembly;
  MessageFragment huge = part(0, 2, 0, 4);
  huge.message_size = 0xffffffff;
  CHECK(assembled(assembly, {huge}) ==
        "is a fragment of a message of 4294967295 bytes, at most 1048576 bytes are taken");
  MessageFragment many = part(0, 65535, 0, 4);
  CHECK(assembled(assembly, {many}) == "is one of 65535 fragments, at most 1024 are taken");
}

TEST_CASE("senders are kept separate, and the oldest of too many messages is dropped") {
  FragmentAssembly assembly;
  CHECK(assembled(assembly, {part(0, 2, 0, 4)}).empty());
  CHECK(assembled(assembly, {part(1, 2, 4, 6)}, {0x7f000001, 5001}).empty());
  for (std::uint32_t number = 2; number < 2 + FragmentAssembly::kMessages - 2; ++number) {
    CHECK(assembled(assembly, {part(0, 2, 0, 4, number)}).empty());
  }
  // All places are taken; the first message is still there.
  CHECK(assembled(assembly, {part(1, 2, 4, 6)}) == "PUCK_STATUS:abcdefghij");
  CHECK(assembled(assembly, {part(0, 2, 0, 4, 100)}).empty());
  CHECK(assembled(assembly, {part(0, 2, 0, 4, 101)}).empty());  // in place of that of port 5001
  CHECK(assembled(assembly, {part(0, 2, 0, 4)}, {0x7f000001, 5001}).empty());
}

}  // namespace puck
