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

/// Assembles messages from several datagrams (LCM's LC03). LCM's own assembly writes wherever a
/// datagram says; this one writes within the message only, accepts no byte twice, and returns a
/// message when it is complete. It holds at most kMessages incomplete ones; a further one replaces
/// the oldest. One thread.
class FragmentAssembly {
 public:
  static constexpr std::size_t kMessages = 8;
  static constexpr std::size_t kMostBytes = std::size_t{1} << 20;  ///< For one message.
  static constexpr std::size_t kMostFragments = 1024;

  struct Whole {
    std::string channel;
    std::vector<std::uint8_t> payload;
  };

  /// Returns the message that this fragment completes, if any. `problem`: set when the fragment
  /// contradicts itself or earlier ones; its message is then dropped.
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
    std::uint64_t begun = 0;  // 0: this slot is free.
  };

  Message* find(const Sender& sender, std::uint32_t number);
  Message& begin(const Sender& sender, const MessageFragment& fragment);

  std::array<Message, kMessages> messages_;
  std::uint64_t begun_ = 0;
};

}  // namespace puck
