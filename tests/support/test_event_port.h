#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <thread>

namespace puck {

/// A name server and an output port of another program in one, on ports of this machine, in YARP's
/// protocol. A thread of its own; all calls are safe from any thread.
class TestEventPort {
 public:
  /// `name_server`: port of the name server; 0: any free port.
  explicit TestEventPort(std::string name, int name_server = 0);
  ~TestEventPort();

  /// Port of the name server.
  int name_server() const;

  /// Sends bytes to all readers. False if there are none.
  bool send(std::string_view bytes);
  /// Number of connections that asked for messages.
  std::size_t readers() const;
  /// Bytes that were not sent yet.
  std::size_t unsent() const;

  /// Sends all bytes and closes all connections and ports but the name server's, as the end of a
  /// process does; then a new port.
  void die();
  void revive();

 private:
  class Ports;
  std::unique_ptr<Ports> ports_;
  std::jthread thread_;
};

}  // namespace puck
