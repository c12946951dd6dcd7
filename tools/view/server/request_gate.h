#pragma once

#include <optional>
#include <string>

#include "tools/view/server/http_message.h"

namespace puck {

/// 128 random bits as 32 hexadecimal digits.
std::string random_token();

/// Decides which requests are answered. Keeps out pages of other origins in the same browser
/// (Origin), names that were pointed at this machine by their owner (Host), and, with a token,
/// everyone who does not know it. Immutable; safe from any thread.
class RequestGate {
 public:
  /// `token`: empty if none is needed. `port` makes the cookie's name, as browsers share cookies
  /// between the ports of a machine.
  RequestGate(std::string token, std::uint16_t port);

  /// The refusal; empty: the request may pass.
  std::optional<HttpReply> refuse(const HttpRequest& request) const;

  /// Value of the Set-Cookie header that lets the page's other requests pass; empty: none is
  /// needed.
  std::string cookie() const;

 private:
  bool knows_token(const HttpRequest& request) const;

  std::string token_;
  std::string cookie_name_;
  std::string host_name_;  // Of this machine.
};

}  // namespace puck
