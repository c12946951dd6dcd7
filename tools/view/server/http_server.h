#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "tools/view/server/http_message.h"
#include "tools/view/server/listen_address.h"

namespace puck {

struct HttpServerParams {
  ListenAddress listen;
  /// When all are in use, a new connection replaces the one that has been idle for longest, or is
  /// refused if none is idle.
  std::size_t most_connections = 32;
  /// A connection without a whole request for so long is closed.
  std::chrono::milliseconds request_time{30'000};
  /// So is one whose peer does not take a whole reply within this time.
  std::chrono::milliseconds reply_time{20'000};
  bool stop_on_signals = true;  ///< SIGINT, SIGTERM and SIGHUP end run().
};

/// What answers the requests.
class HttpHandler {
 public:
  virtual ~HttpHandler() = default;

  /// Nothing: there is no news yet, ask again soon; `waited` is the time since the request. Called
  /// by two threads. Exceptions become a reply with status 500.
  virtual std::optional<HttpReply> answer(const HttpRequest& request,
                                          std::chrono::milliseconds waited) = 0;
};

/// Serves HTTP/1.1. Memory is bounded whatever the peers do: connections, header and body of a
/// request are limited, and a connection has one request and one reply at a time. A request that
/// waits for news needs no thread. Neither copied nor moved.
class HttpServer {
 public:
  static constexpr std::size_t kMostHeaderBytes = 8 * 1024;
  static constexpr std::size_t kMostBodyBytes = 4 * 1024;

  /// Listens; throws std::runtime_error that says why it cannot and what to do.
  explicit HttpServer(const HttpServerParams& params);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// The one in use, if port 0 was asked for.
  std::uint16_t port() const;

  /// Serves on this and two more threads until stop() or a signal. Once.
  void run(HttpHandler& handler);

  /// Safe from any thread.
  void stop();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// A whole request from bytes of any origin, within the server's limits; nothing if it is none.
std::optional<HttpRequest> parse_request(std::string_view bytes);

}  // namespace puck
