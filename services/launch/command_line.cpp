#include "services/launch/command_line.h"

#include <CLI/CLI.hpp>

namespace puck {

std::optional<int> parse_command_line(const std::string& name, const std::string& description,
                                      int argc, const char* const* argv,
                                      const AddOptions& add_options, CommandLine& line) {
  constexpr int kUsageError = 2;
  CLI::App app(description, name);
  app.add_option("--config", line.config_file, "TOML file with the settings")->type_name("FILE");
  app.add_option("--set", line.settings, "One setting; overrides the file; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--lcm-url", line.lcm_url, "LCM URL of the bus; overrides the setting lcm.url")
      ->type_name("URL");
  app.add_option("--prefix", line.prefix,
                 "Channel prefix: every channel is called P_PUCK_...; overrides lcm.prefix")
      ->type_name("P");
  app.add_option("--log-level", line.log_level, "Lowest level of the log lines on stderr")
      ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error", "off"}))
      ->capture_default_str();
  app.add_flag("--check", line.check,
               "Wait up to 2 s for the STATUS of a running " + name +
                   "; exit code 0: healthy, 1: not healthy or not found");
  app.set_version_flag("--version", name + " " + PUCK_VERSION);
  if (add_options) add_options(app);
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUsageError;
  }
}

}  // namespace puck
