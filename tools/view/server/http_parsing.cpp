#include "tools/view/server/http_parsing.h"

#include <boost/asio/buffer.hpp>

namespace puck {

std::optional<HttpRequest> parse_request(std::string_view bytes) {
  RequestParser parser;
  limit(parser);
  parser.eager(true);
  boost::beast::error_code error;
  while (!parser.is_done() && !error && !bytes.empty()) {
    const std::size_t used = parser.put(boost::asio::buffer(bytes.data(), bytes.size()), error);
    bytes.remove_prefix(used);
    if (used == 0) break;
  }
  if (error || !parser.is_done()) return std::nullopt;
  return to_request(parser.get());
}

}  // namespace puck
