#pragma once

#include <string>
#include <vector>

#include "tools/doctor/facts.h"

namespace puck {

/// The commands in one line, with sudo if this user is not root.
inline std::string as_root(const Facts& facts, const std::vector<std::string>& commands) {
  std::string line;
  for (const std::string& command : commands) {
    if (!line.empty()) line += " && ";
    if (!facts.is_root) line += "sudo ";
    line += command;
  }
  return line;
}

/// The option for a service or tool on this bus.
inline std::string lcm_url_option(const LcmUrl& url) {
  return "--lcm-url \"" + url.to_string() + "\"";
}

/// Updates a clone of the project.
inline constexpr const char* kUpdate =
    "git pull && cmake --preset release && cmake --build --preset release";

/// The option for another port, which separates the bus from foreign datagrams.
inline std::string other_port_option(LcmUrl url) {
  url.port = url.port < 65535 ? url.port + 1 : 7667;
  return lcm_url_option(url);
}

}  // namespace puck
