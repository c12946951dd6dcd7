#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "common/yarp/name_server.h"
#include "common/yarp/port_message.h"
#include "common/yarp/retry_pause.h"
#include "common/yarp/stream_connection.h"
#include "common/yarp/waiter.h"

namespace puck {

struct PortReaderParams {
  std::string port;                        ///< Name of the port, such as "/atis3/AE:o".
  std::string server_host = "127.0.0.1";   ///< Name server: host name or IPv4 address.
  int server_port = 10000;                 ///< Port of the name server.
  std::string server_key = "server_host";  ///< Names `server_host` in messages.
  std::string local_name = "puck";         ///< Our name in requests.
  int connect_timeout_ms = 1000;           ///< Of one connection.
  int answer_timeout_ms = 500;             ///< Of one answer of the name server.
  int retry_ms = 250;                      ///< First pause after a failure; doubled up to 5 s.
  std::size_t most_bytes = std::size_t{16} << 20;  ///< Longer messages end the connection.
};

/// Reads what another program sends on a streaming port: asks the name server for the port,
/// connects in the binary carrier, and connects again after every error. The port's owner never
/// waits for it as long as it is read. One thread, except for interrupt().
class PortReader {
 public:
  /// Looks up the name server's host. Throws std::invalid_argument if it is unknown.
  explicit PortReader(const PortReaderParams& params);
  PortReader(const PortReader&) = delete;
  PortReader& operator=(const PortReader&) = delete;

  /// The next message, valid until the next call; nothing if none has come within `wait` or the
  /// connection has failed. Takes longer only while it connects.
  std::optional<PortMessage> next(std::chrono::milliseconds wait);

  bool is_connected() const { return connection_.has_value(); }
  /// What it waits for, and the newest error while it is not connected. Empty during the first
  /// attempt.
  const std::string& waiting_for() const { return waiting_for_; }

  /// Ends a wait of next(), and all later ones. Safe from any thread.
  void interrupt();

  std::int64_t connections() const { return connections_; }
  std::int64_t failures() const { return failures_; }  ///< Of connections and attempts.
  std::int64_t messages() const { return messages_; }
  /// Messages that the counts of the stamps show as lost.
  std::int64_t messages_lost() const { return messages_lost_; }

 private:
  void connect();
  std::optional<PortMessage> receive(Deadline until);
  void note_stamp(const PortMessage& message);
  void fail(const std::string& reason);

  PortReaderParams params_;
  std::vector<PortAddress> name_servers_;  // All addresses of the host, tried in turn.
  std::size_t next_server_ = 0;
  std::stop_source stop_;
  Waker waker_;
  Waiter waiter_{stop_.get_token(), waker_};
  std::optional<StreamConnection> connection_;
  RetryPause pause_;
  Deadline next_attempt_;
  std::string waiting_for_;
  std::optional<std::int64_t> newest_count_;  // Of this connection's stamps.
  std::int64_t connections_ = 0;
  std::int64_t failures_ = 0;
  std::int64_t messages_ = 0;
  std::int64_t messages_lost_ = 0;
};

}  // namespace puck
