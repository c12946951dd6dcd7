#include "services/launch/command_line.h"

#include <CLI/CLI.hpp>
#include <doctest/doctest.h>

namespace puck {
namespace {

std::optional<int> parse(std::vector<const char*> arguments, CommandLine& line,
                         const AddOptions& add_options = {}) {
  arguments.insert(arguments.begin(), "puck-test");
  return parse_command_line("puck-test", "A test.", static_cast<int>(arguments.size()),
                            arguments.data(), add_options, line);
}

}  // namespace

TEST_CASE("the options of all services are read") {
  CommandLine line;
  CHECK(parse({"--config", "a.toml", "--set", "a.b=1", "--set", "c.d=x", "--lcm-url", "memq://",
               "--prefix", "LEFT", "--log-level", "debug", "--check"},
              line) == std::nullopt);
  CHECK(line.config_file == "a.toml");
  CHECK(line.settings == std::vector<std::string>{"a.b=1", "c.d=x"});
  CHECK(line.lcm_url == "memq://");
  CHECK(line.prefix == "LEFT");
  CHECK(line.log_level == "debug");
  CHECK(line.check);
}

TEST_CASE("without options a service runs on its defaults") {
  CommandLine line;
  CHECK(parse({}, line) == std::nullopt);
  CHECK(line.config_file.empty());
  CHECK_FALSE(line.lcm_url.has_value());
  CHECK(line.log_level == "info");
  CHECK_FALSE(line.check);
}

TEST_CASE("a usage error ends with 2, help and version with 0") {
  CommandLine line;
  CHECK(parse({"--nope"}, line) == 2);
  CHECK(parse({"stray"}, line) == 2);
  CHECK(parse({"--config"}, line) == 2);
  CHECK(parse({"--log-level", "loud"}, line) == 2);
  CHECK(parse({"--set", "a.b=1", "c.d=2"}, line) == 2);
  CHECK(parse({"--help"}, line) == 0);
  CHECK(parse({"--version"}, line) == 0);
}

TEST_CASE("a service adds its own options") {
  CommandLine line;
  bool stop = false;
  CHECK(parse({"--stop"}, line, [&](CLI::App& app) { app.add_flag("--stop", stop); }) ==
        std::nullopt);
  CHECK(stop);
}

}  // namespace puck
