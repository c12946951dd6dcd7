#include "tools/view/server/view_pages.h"

#include <limits>
#include <utility>
#include <variant>

#include <nlohmann/json.hpp>

#include "tools/view/server/control_json.h"
#include "tools/view/server/picture_query.h"
#include "tools/view/server/state_json.h"

namespace puck {
namespace {

constexpr std::chrono::milliseconds kLongestHold{1000};
constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();

/// Everything comes from this server, and no other page may show or read it.
void add_security_headers(HttpReply& reply) {
  reply.headers.emplace_back("Content-Security-Policy",
                             "default-src 'none'; script-src 'self'; style-src 'self'; "
                             "img-src 'self' blob: data:; connect-src 'self'; base-uri 'none'; "
                             "form-action 'none'; frame-ancestors 'none'");
  reply.headers.emplace_back("X-Content-Type-Options", "nosniff");
  reply.headers.emplace_back("Referrer-Policy", "no-referrer");
  reply.headers.emplace_back("Cross-Origin-Resource-Policy", "same-origin");
}

HttpReply never_stored(HttpReply reply) {
  reply.headers.emplace_back("Cache-Control", "no-store");
  return reply;
}

HttpReply method_not_allowed(const char* allowed) {
  HttpReply reply = text_reply(405, std::string("expected the method ") + allowed);
  reply.headers.emplace_back("Allow", allowed);
  return reply;
}

}  // namespace

ViewPages::ViewPages(ViewSource& source, PageFiles files, RequestGate gate)
    : source_(source), files_(std::move(files)), gate_(std::move(gate)), desk_(source) {}

std::optional<HttpReply> ViewPages::answer(const HttpRequest& request,
                                           std::chrono::milliseconds waited) {
  std::optional<HttpReply> reply = gate_.refuse(request);
  if (!reply) reply = route(request, waited);
  if (reply) add_security_headers(*reply);
  return reply;
}

std::optional<HttpReply> ViewPages::route(const HttpRequest& request,
                                          std::chrono::milliseconds waited) {
  if (request.path == "/control") {
    if (request.method != HttpRequest::Method::kPost) return method_not_allowed("POST");
    return control(request);
  }
  if (request.method != HttpRequest::Method::kGet) return method_not_allowed("GET");
  if (request.path == "/picture") return picture(request, waited);
  if (request.path == "/state") {
    const Timestamp since{number_of(request, "since_us", 0, 0, kMost)};
    return never_stored(
        json_reply(state_json(source_.state(since, number_of(request, "run", -1, -1, kMost)))));
  }
  if (request.path == "/timeline") {
    return never_stored(json_reply(timeline_json(source_.timeline())));
  }
  return file(request);
}

std::optional<HttpReply> ViewPages::picture(const HttpRequest& request,
                                            std::chrono::milliseconds waited) {
  const auto seen = static_cast<std::uint64_t>(number_of(request, "seen", 0, 0, kMost));
  const auto picture = desk_.newer(wishes_of(request), seen);
  if (!picture) {
    if (waited < kLongestHold) return std::nullopt;
    return never_stored({.status = 204});
  }
  HttpReply reply{.content_type = "image/jpeg", .body = picture->jpeg};
  reply.headers.emplace_back("Puck-Version", std::to_string(picture->version));
  return never_stored(std::move(reply));
}

HttpReply ViewPages::control(const HttpRequest& request) {
  // A form of another origin cannot send this type.
  if (!request.content_type.starts_with("application/json")) {
    return text_reply(415, "expected Content-Type: application/json");
  }
  const auto parsed = parse_control(request.body);
  if (const auto* problem = std::get_if<std::string>(&parsed)) return text_reply(400, *problem);
  const nlohmann::json answer{{"problem", source_.control(std::get<ViewControl>(parsed))}};
  return never_stored(
      json_reply(answer.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)));
}

HttpReply ViewPages::file(const HttpRequest& request) const {
  const HttpReply* file = files_.find(request.path);
  if (file == nullptr) return text_reply(404, "there is no such page");
  HttpReply reply = *file;
  if (const std::string cookie = gate_.cookie(); !cookie.empty()) {
    reply.headers.emplace_back("Set-Cookie", cookie);
  }
  return reply;
}

}  // namespace puck
