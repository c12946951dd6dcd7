#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace puck {

/// Command line options common to all services.
struct CommandLine {
  std::string config_file;            ///< Empty: built-in defaults.
  std::vector<std::string> settings;  ///< KEY=VALUE, in the given order.
  std::optional<std::string> lcm_url;
  std::optional<std::string> prefix;
  std::string log_level = "info";
  bool check = false;
};

/// Adds a service's own options.
using AddOptions = std::function<void(CLI::App&)>;

/// Parses into `line`. Returns an exit code if the program must end: 0 after --help and --version,
/// 2 after a usage error, which it prints to stderr.
std::optional<int> parse_command_line(const std::string& name, const std::string& description,
                                      int argc, const char* const* argv,
                                      const AddOptions& add_options, CommandLine& line);

}  // namespace puck
