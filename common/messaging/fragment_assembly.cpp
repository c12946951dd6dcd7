#include "common/messaging/fragment_assembly.h"

#include <algorithm>

namespace puck {
namespace {

std::string bytes(std::size_t count) { return std::to_string(count) + " bytes"; }

}  // namespace

std::optional<FragmentAssembly::Whole> FragmentAssembly::add(const Sender& sender,
                                                             const MessageFragment& fragment,
                                                             std::optional<std::string>& problem) {
  if (fragment.message_size > kMostBytes) {
    problem = "is a fragment of a message of " + bytes(fragment.message_size) + ", at most " +
              bytes(kMostBytes) + " are taken";
    return std::nullopt;
  }
  if (fragment.fragments > kMostFragments) {
    problem = "is one of " + std::to_string(fragment.fragments) + " fragments, at most " +
              std::to_string(kMostFragments) + " are taken";
    return std::nullopt;
  }
  Message* known = find(sender, fragment.number);
  Message& message = known != nullptr ? *known : begin(sender, fragment);
  if (fragment.message_size != message.payload.size() ||
      fragment.fragments != message.parts.size()) {
    problem = "is a fragment that contradicts another one of its message";
    message.begun = 0;
    return std::nullopt;
  }
  Part& part = message.parts[fragment.index];
  if (part.came) return std::nullopt;  // a duplicate
  part = {true, fragment.offset, fragment.offset + fragment.payload.size()};
  std::copy(fragment.payload.begin(), fragment.payload.end(),
            message.payload.begin() + static_cast<std::ptrdiff_t>(part.begin));
  if (fragment.index == 0) message.channel = fragment.channel;
  if (--message.parts_missing > 0) return std::nullopt;

  message.begun = 0;
  // Each part must begin at the end of the previous one, so that no gap or overlap remains.
  std::size_t end = 0;
  for (const Part& each : message.parts) {
    if (each.begin != end) {
      problem = "is the last fragment of a message with a gap or an overlap";
      return std::nullopt;
    }
    end = each.end;
  }
  if (end != message.payload.size()) {
    problem = "is the last fragment of a message that ends too early";
    return std::nullopt;
  }
  return Whole{std::move(message.channel), std::move(message.payload)};
}

FragmentAssembly::Message* FragmentAssembly::find(const Sender& sender, std::uint32_t number) {
  const auto found = std::find_if(messages_.begin(), messages_.end(), [&](const Message& message) {
    return message.begun != 0 && message.number == number && message.sender == sender;
  });
  return found == messages_.end() ? nullptr : &*found;
}

FragmentAssembly::Message& FragmentAssembly::begin(const Sender& sender,
                                                   const MessageFragment& fragment) {
  Message& oldest =
      *std::min_element(messages_.begin(), messages_.end(),
                        [](const Message& a, const Message& b) { return a.begun < b.begun; });
  oldest = {sender,
            fragment.number,
            {},
            std::vector<std::uint8_t>(fragment.message_size),
            std::vector<Part>(fragment.fragments),
            fragment.fragments,
            ++begun_};
  return oldest;
}

}  // namespace puck
