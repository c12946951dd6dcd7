#pragma once

#include <memory>
#include <string>

#include "common/posix/file_descriptor.h"

namespace puck {

/// Makes the connections of a TCP source, one after the other. No call waits.
class TcpLink {
 public:
  virtual ~TcpLink() = default;

  /// The next connection; not open while there is none.
  virtual FileDescriptor connect() = 0;

  /// What is waited for while there is no connection.
  virtual const std::string& waiting_for() const = 0;

  /// The newest connection has ended.
  virtual void note_end(const std::string& reason) = 0;

  /// How messages name the other side.
  virtual const std::string& name() const = 0;
};

/// Connects to a server, and again one second after a failure or an end. Looks up the host and
/// tries all its addresses in turn. Throws std::runtime_error if the host is not found.
std::unique_ptr<TcpLink> connect_to_server(const std::string& host, int port);

/// Listens at an address of this machine, or at all with "0.0.0.0" or "::"; `port` 0: any free one.
/// Clients that come while another one is connected wait for its end. Throws std::runtime_error if
/// the address cannot be had.
std::unique_ptr<TcpLink> listen_for_clients(const std::string& host, int port);

}  // namespace puck
