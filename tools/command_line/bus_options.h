#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/io/config.h"
#include "common/messaging/bus_settings.h"

namespace puck {

/// Options of a tool that listens on the bus.
struct BusOptions {
  std::string config_file;
  std::vector<std::string> settings;
  std::optional<std::string> lcm_url;
  std::optional<std::string> prefix;
};

/// --lcm-url, --config and --set; the tool adds --prefix.
inline void add_bus_options(CLI::App& app, BusOptions& options) {
  app.add_option("--lcm-url", options.lcm_url, "LCM URL of the bus; overrides the setting lcm.url")
      ->type_name("URL");
  app.add_option("--config", options.config_file,
                 "TOML file of any service; only its [lcm] section is used")
      ->type_name("FILE");
  app.add_option("--set", options.settings,
                 "One setting of these; overrides the file; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

/// Throws ConfigError, also for a key outside of [lcm] in --set.
inline BusParams bus_params(const BusOptions& options) {
  // Separate from the file, so that an unknown key is reported.
  Config assignments;
  for (const std::string& setting : options.settings) assignments.override_with(setting);
  read_bus_params(assignments);
  assignments.reject_unknown();
  Config config = options.config_file.empty() ? Config{} : Config::from_file(options.config_file);
  for (const std::string& setting : options.settings) config.override_with(setting);
  BusParams params = read_bus_params(config);
  config.reject_unknown_in("lcm");
  if (options.lcm_url) params.url = *options.lcm_url;
  if (options.prefix) params.prefix = *options.prefix;
  return params;
}

}  // namespace puck
