#pragma once

#include <string>
#include <vector>

#include "tools/doctor/facts.h"

namespace puck {

/// Commands that need an administrator, one after the other, as this user has to type them.
inline std::string as_root(const Facts& facts, const std::vector<std::string>& commands) {
  std::string line;
  for (const std::string& command : commands) {
    if (!line.empty()) line += " && ";
    if (!facts.is_root) line += "sudo ";
    line += command;
  }
  return line;
}

/// The option that makes a service or tool use this bus.
inline std::string lcm_url_option(const LcmUrl& url) {
  return "--lcm-url \"" + url.to_string() + "\"";
}

/// Brings a clone of the project up to date.
inline constexpr const char* kUpdate =
    "git pull && cmake --preset release && cmake --build --preset release";

/// Another port is another bus: that is how strangers are kept apart.
inline std::string other_port_option(LcmUrl url) {
  url.port = url.port < 65535 ? url.port + 1 : 7667;
  return lcm_url_option(url);
}

}  // namespace puck
