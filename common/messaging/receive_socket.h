#pragma once

#include <optional>
#include <string>

#include "common/messaging/lcm_url.h"
#include "common/posix/file_descriptor.h"

namespace puck {

/// A UDP socket that receives only the group of a URL: it is bound to the group's address, so that
/// other groups on the same port and unicast datagrams do not reach it. Nothing passes until a
/// filter (receive_filter.h) is set. Each datagram has the kernel's time of receipt. Moves.
class ReceiveSocket {
 public:
  /// `buffer_bytes`: requested buffer size; empty: the kernel's default. Returns nothing on
  /// success, else the reason.
  std::optional<std::string> open(const LcmUrl& url, std::optional<int> buffer_bytes);

  bool is_open() const { return socket_.is_open(); }
  int descriptor() const { return socket_.number(); }

  /// Whether the socket has lost the group because its network disappeared or was replaced. Then
  /// only a new socket receives again; LCM's own never does.
  bool has_lost_its_group();

 private:
  LcmUrl url_;
  FileDescriptor socket_;
};

}  // namespace puck
