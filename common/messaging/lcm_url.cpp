#include "common/messaging/lcm_url.h"

#include <charconv>
#include <limits>
#include <string_view>

#include <arpa/inet.h>

#include "common/messaging/bus_error.h"

namespace puck {
namespace {

constexpr std::string_view kMulticastScheme = "udpm://";
constexpr std::string_view kMemoryScheme = "memq://";

[[noreturn]] void fail(const std::string& url, const std::string& what) {
  throw BusError("lcm.url \"" + url + "\": " + what);
}

int parse_number(const std::string& url, std::string_view name, std::string_view text, int min,
                 int max) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < min || value > max) {
    fail(url, std::string(name) + " must be " + std::to_string(min) + " to " + std::to_string(max) +
                  ", got \"" + std::string(text) + "\"");
  }
  return value;
}

void check_group(const std::string& url, const std::string& group) {
  in_addr address{};
  const bool is_address = inet_pton(AF_INET, group.c_str(), &address) == 1;
  if (!is_address || !IN_MULTICAST(ntohl(address.s_addr))) {
    fail(url, "the address must be a multicast group, 224.0.0.0 to 239.255.255.255, got \"" +
                  group + "\"");
  }
}

void parse_network(const std::string& url, std::string_view network, LcmUrl& parsed) {
  const auto colon = network.find(':');
  const std::string_view group = network.substr(0, colon);
  if (!group.empty()) parsed.group = group;
  check_group(url, parsed.group);
  if (colon != std::string_view::npos) {
    parsed.port = parse_number(url, "the port", network.substr(colon + 1), 1, 65535);
  }
}

void parse_option(const std::string& url, std::string_view option, LcmUrl& parsed) {
  const auto equals = option.find('=');
  const std::string_view name = option.substr(0, equals);
  const std::string_view value =
      equals == std::string_view::npos ? std::string_view{} : option.substr(equals + 1);
  if (name == "ttl") {
    parsed.ttl = parse_number(url, name, value, 0, 255);
  } else if (name == "recv_buf_size") {
    parsed.recv_buf_size =
        parse_number(url, name, value, 2048, std::numeric_limits<int>::max() / 2);
  } else {
    fail(url, "unknown option \"" + std::string(name) + "\"; expected ttl or recv_buf_size");
  }
}

}  // namespace

std::string LcmUrl::to_string() const {
  if (in_memory) return std::string(kMemoryScheme);
  std::string text = std::string(kMulticastScheme) + group + ":" + std::to_string(port) +
                     "?ttl=" + std::to_string(ttl);
  if (recv_buf_size) text += "&recv_buf_size=" + std::to_string(*recv_buf_size);
  return text;
}

LcmUrl parse_lcm_url(const std::string& url) {
  LcmUrl parsed;
  if (url == kMemoryScheme) {
    parsed.in_memory = true;
    return parsed;
  }
  std::string_view rest = url;
  if (!rest.starts_with(kMulticastScheme)) {
    fail(url, "must begin with udpm://, as in " + std::string(kDefaultLcmUrl));
  }
  rest.remove_prefix(kMulticastScheme.size());
  const auto question = rest.find('?');
  parse_network(url, rest.substr(0, question), parsed);
  if (question == std::string_view::npos) return parsed;
  rest.remove_prefix(question + 1);
  while (!rest.empty()) {
    const auto ampersand = rest.find('&');
    parse_option(url, rest.substr(0, ampersand), parsed);
    if (ampersand == std::string_view::npos) break;
    rest.remove_prefix(ampersand + 1);
  }
  return parsed;
}

}  // namespace puck
