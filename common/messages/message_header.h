#pragma once

#include <cstdint>

namespace puck {

/// Names one message of a channel.
struct MessageId {
  std::int64_t session = 0;  ///< Of the publisher's run; 0: no message.
  std::int64_t seq = 0;

  friend constexpr bool operator==(const MessageId&, const MessageId&) = default;
};

/// Header of every message. The bus fills it in at publication.
struct MessageHeader {
  std::int64_t utime = 0;    ///< Host CLOCK_REALTIME at publish, µs.
  std::int64_t session = 0;  ///< Random id of the publisher's run.
  std::int64_t seq = 0;      ///< Messages published before this one in this session.

  constexpr MessageId id() const { return {session, seq}; }
};

}  // namespace puck
