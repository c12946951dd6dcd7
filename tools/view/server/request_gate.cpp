#include "tools/view/server/request_gate.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include <arpa/inet.h>
#include <sys/random.h>
#include <unistd.h>

namespace puck {
namespace {

std::string this_host() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return {};
  return name.data();
}

bool same_ignoring_case(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

/// `Host` without its port.
std::string_view name_in(std::string_view host) {
  if (host.starts_with('[')) return host.substr(0, host.find(']') + 1);
  return host.substr(0, host.rfind(':'));
}

/// An address cannot be pointed at another machine, a name can.
bool is_address(std::string_view name) {
  std::array<unsigned char, sizeof(in6_addr)> address{};
  if (name.starts_with('[') && name.ends_with(']')) {
    name = name.substr(1, name.size() - 2);
    return inet_pton(AF_INET6, std::string(name).c_str(), address.data()) == 1;
  }
  return inet_pton(AF_INET, std::string(name).c_str(), address.data()) == 1;
}

/// Takes the same time for every wrong token of the right length.
bool equals_secret(std::string_view given, std::string_view secret) {
  if (given.size() != secret.size()) return false;
  unsigned char difference = 0;
  for (std::size_t i = 0; i < secret.size(); ++i) {
    difference |= static_cast<unsigned char>(given[i] ^ secret[i]);
  }
  return difference == 0;
}

}  // namespace

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw std::runtime_error(std::string("no random bytes for a token: ") + std::strerror(errno));
  }
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string token;
  for (const unsigned char byte : bytes) {
    token += kDigits[byte >> 4];
    token += kDigits[byte & 15];
  }
  return token;
}

RequestGate::RequestGate(std::string token, std::uint16_t port)
    : token_(std::move(token)),
      cookie_name_("puck_view_" + std::to_string(port)),
      host_name_(this_host()) {}

std::optional<HttpReply> RequestGate::refuse(const HttpRequest& request) const {
  if (!request.host) return text_reply(400, "the request has no Host");
  const std::string_view name = name_in(*request.host);
  const bool is_ours = is_address(name) || same_ignoring_case(name, "localhost") ||
                       same_ignoring_case(name, host_name_) ||
                       same_ignoring_case(name, host_name_ + ".local");
  if (!is_ours) {
    return text_reply(403,
                      "puck-view does not answer to this host name: open the page by the "
                      "machine's address, by localhost or by its own name");
  }
  if (request.origin && !same_ignoring_case(*request.origin, "http://" + *request.host)) {
    return text_reply(403, "puck-view does not answer to pages of another origin");
  }
  if (!token_.empty() && !knows_token(request)) {
    return text_reply(403, "this page needs the token: open the whole URL that puck-view printed");
  }
  return std::nullopt;
}

std::string RequestGate::cookie() const {
  if (token_.empty()) return {};
  return cookie_name_ + '=' + token_ + "; HttpOnly; SameSite=Strict; Path=/";
}

bool RequestGate::knows_token(const HttpRequest& request) const {
  const auto given = request.query.find("token");
  if (given != request.query.end() && equals_secret(given->second, token_)) return true;
  std::string_view rest = request.cookies;
  while (!rest.empty()) {
    std::string_view part = rest.substr(0, rest.find(';'));
    rest.remove_prefix(std::min(part.size() + 1, rest.size()));
    part.remove_prefix(std::min(part.find_first_not_of(' '), part.size()));
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos || part.substr(0, equals) != cookie_name_) continue;
    if (equals_secret(part.substr(equals + 1), token_)) return true;
  }
  return false;
}

}  // namespace puck
