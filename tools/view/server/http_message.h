#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace puck {

/// A request within the server's limits; all text is from the network.
struct HttpRequest {
  enum class Method { kGet, kPost, kOther };

  Method method = Method::kOther;
  std::string path;                                       ///< Of the URL, without the query.
  std::map<std::string, std::string, std::less<>> query;  ///< Decoded.
  std::optional<std::string> host;
  std::optional<std::string> origin;
  std::string cookies;       ///< As sent: `a=1; b=2`.
  std::string content_type;  ///< Of the body.
  std::string body;
};

struct HttpReply {
  int status = 200;
  std::string content_type = "text/plain; charset=utf-8";
  std::vector<std::pair<std::string, std::string>> headers;
  /// Shared, so that viewers of one picture need it once.
  std::shared_ptr<const std::string> body;
};

/// A reply of one line of text.
inline HttpReply text_reply(int status, const std::string& text) {
  return {.status = status, .body = std::make_shared<const std::string>(text + '\n')};
}

inline HttpReply json_reply(std::string text) {
  return {.content_type = "application/json",
          .body = std::make_shared<const std::string>(std::move(text))};
}

}  // namespace puck
