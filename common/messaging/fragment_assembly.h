#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/messaging/datagram.h"
#include "common/messaging/transport.h"

namespace puck {

/// Puts messages together that came in several datagrams (LCM's LC03). LCM's own assembly writes
/// where a datagram tells it to; this one writes only inside of the message, takes no byte twice,
/// and hands a message over only when every byte of it has come. It holds at most kMessages that
/// are not whole yet; a further one takes the place of the oldest. One thread.
class FragmentAssembly {
 public:
  static constexpr std::size_t kMessages = 8;
  static constexpr std::size_t kMostBytes = std::size_t{1} << 20;  ///< Of one message.
  static constexpr std::size_t kMostFragments = 1024;

  struct Whole {
    std::string channel;
    std::vector<std::uint8_t> payload;
  };

  /// A message that this fragment makes whole, if it does. `problem`: set when the fragment does
  /// not fit to itself or to those before it; the message that it belongs to is dropped with it.
  std::optional<Whole> add(const Sender& sender, const MessageFragment& fragment,
                           std::optional<std::string>& problem);

 private:
  struct Part {
    bool came = false;
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  struct Message {
    Sender sender;
    std::uint32_t number = 0;
    std::string channel;
    std::vector<std::uint8_t> payload;
    std::vector<Part> parts;
    std::size_t parts_missing = 0;
    std::uint64_t begun = 0;  // 0: this place is free.
  };

  Message* find(const Sender& sender, std::uint32_t number);
  Message& begin(const Sender& sender, const MessageFragment& fragment);

  std::array<Message, kMessages> messages_;
  std::uint64_t begun_ = 0;
};

}  // namespace puck
