// Fragments of messages in any order, from several senders, well formed and not.
#include <algorithm>
#include <variant>

#include <fuzzer/FuzzedDataProvider.h>

#include "common/messaging/fragment_assembly.h"
#include "tests/fuzz/require.h"

namespace puck {
namespace {

/// The content of every message at this offset, so that a wrong or unwritten byte is noticed.
std::uint8_t content_at(std::size_t offset) { return static_cast<std::uint8_t>(offset * 31 + 7); }

void check(const FragmentAssembly::Whole& whole) {
  require(whole.payload.size() <= FragmentAssembly::kMostBytes, "no message is beyond the limit");
  for (std::size_t i = 0; i < whole.payload.size(); ++i) {
    require(whole.payload[i] == content_at(i), "every byte has come, and is where it belongs");
  }
}

/// Like parse_datagram(), which passes only fragments inside their message.
bool is_possible(const MessageFragment& fragment) {
  return fragment.index < fragment.fragments &&
         std::uint64_t{fragment.offset} + fragment.payload.size() <= fragment.message_size;
}

void add(FuzzedDataProvider& input, FragmentAssembly& assembly) {
  // Few parts and small messages, so that some become complete; arbitrary ones now and then.
  const bool is_wild = input.ConsumeIntegral<std::uint8_t>() == 0;
  const std::uint32_t most_bytes = is_wild ? ~0U : 64;
  const std::uint16_t most_parts = is_wild ? 0xffff : 4;
  MessageFragment fragment;
  const Sender sender{input.ConsumeIntegralInRange<std::uint32_t>(1, 3), 1};
  fragment.number = input.ConsumeIntegralInRange<std::uint32_t>(0, 3);
  fragment.message_size = input.ConsumeIntegralInRange<std::uint32_t>(0, most_bytes);
  fragment.offset = input.ConsumeIntegralInRange<std::uint32_t>(0, most_bytes);
  fragment.index = input.ConsumeIntegralInRange<std::uint16_t>(0, most_parts);
  fragment.fragments = input.ConsumeIntegralInRange<std::uint16_t>(0, most_parts);
  if (fragment.index == 0) fragment.channel = "PUCK_EVENTS";
  std::vector<std::uint8_t> payload(input.ConsumeIntegralInRange<std::size_t>(0, 64));
  for (std::size_t i = 0; i < payload.size(); ++i) payload[i] = content_at(fragment.offset + i);
  fragment.payload = payload;
  if (!is_possible(fragment)) return;

  std::optional<std::string> problem;
  const auto whole = assembly.add(sender, fragment, problem);
  if (problem) require_one_line(*problem);
  require(!whole || !problem, "a message with a problem is not handed over");
  if (!whole) return;
  require(whole->channel == "PUCK_EVENTS", "the first part names the channel");
  check(*whole);
}

}  // namespace
}  // namespace puck

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider input(data, size);
  puck::FragmentAssembly assembly;
  while (input.remaining_bytes() > 0) puck::add(input, assembly);
  return 0;
}
