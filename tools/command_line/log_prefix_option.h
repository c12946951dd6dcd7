#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "common/messaging/bus_error.h"
#include "common/messaging/channels.h"

namespace puck {

/// Adds --prefix, of the channels in an LCM log. `prefix` must outlive the parsing.
inline void add_log_prefix_option(CLI::App& app, std::string& prefix) {
  app.add_option("--prefix", prefix, "of the channels in an LCM log")
      ->check([](const std::string& text) -> std::string {
        try {
          check_prefix(text, "it");
          return {};
        } catch (const BusError& error) {
          return error.what();
        }
      });
}

}  // namespace puck
