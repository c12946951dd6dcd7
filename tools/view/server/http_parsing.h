#pragma once

#include <string>

#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>

#include "tools/view/server/http_message.h"
#include "tools/view/server/http_server.h"
#include "tools/view/server/url_query.h"

namespace puck {

using RequestParser = boost::beast::http::request_parser<boost::beast::http::string_body>;

inline void limit(RequestParser& parser) {
  parser.header_limit(HttpServer::kMostHeaderBytes);
  parser.body_limit(HttpServer::kMostBodyBytes);
}

inline HttpRequest to_request(const RequestParser::value_type& message) {
  namespace http = boost::beast::http;
  const auto text_of = [&](http::field field) -> std::optional<std::string> {
    const auto found = message.find(field);
    if (found == message.end()) return std::nullopt;
    return std::string(found->value().data(), found->value().size());
  };
  HttpRequest request;
  if (message.method() == http::verb::get) request.method = HttpRequest::Method::kGet;
  if (message.method() == http::verb::post) request.method = HttpRequest::Method::kPost;
  if (request.method == HttpRequest::Method::kOther) return request;
  UrlTarget target = split_target({message.target().data(), message.target().size()});
  request.path = std::move(target.path);
  request.query = std::move(target.query);
  request.host = text_of(http::field::host);
  request.origin = text_of(http::field::origin);
  request.cookies = text_of(http::field::cookie).value_or("");
  request.content_type = text_of(http::field::content_type).value_or("");
  request.body = message.body();
  return request;
}

}  // namespace puck
