#pragma once

#include <optional>
#include <string>

#include "common/messaging/lcm_url.h"
#include "common/posix/file_descriptor.h"

namespace puck {

/// A UDP socket that hears the group of a URL and nothing else: it is bound to the group's address,
/// so that neither another group at the same port nor a datagram sent to this host alone reaches
/// it. Nothing comes through until a filter (receive_filter.h) says what may. Every datagram comes
/// with the time at which the kernel had it. Moves.
class ReceiveSocket {
 public:
  /// `buffer_bytes`: to ask the kernel for; nothing: its default. Nothing when it worked, else why
  /// not.
  std::optional<std::string> open(const LcmUrl& url, std::optional<int> buffer_bytes);

  bool is_open() const { return socket_.is_open(); }
  int descriptor() const { return socket_.number(); }

  /// Whether the group no longer reaches this socket, since the network that it joined has gone or
  /// come back as another one. Then only a new socket hears again: LCM's own stays deaf for ever.
  bool has_lost_its_group();

 private:
  LcmUrl url_;
  FileDescriptor socket_;
};

}  // namespace puck
