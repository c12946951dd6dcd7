#include "services/arm/yarp_settings.h"

#include <fstream>
#include <sstream>
#include <string>

#include <doctest/doctest.h>

#include "tests/support/environment.h"

namespace puck {
namespace {

// The section of the board in config/arm.toml.
std::string yarp_section() {
  std::ifstream file(source_folder() / "config/arm.toml");
  std::string section;
  bool is_in_it = false;
  for (std::string line; std::getline(file, line);) {
    is_in_it = (is_in_it && !line.starts_with("[")) || line == "[arm.yarp]";
    if (is_in_it) section += line + "\n";
  }
  return section;
}

}  // namespace

TEST_CASE("config/arm.toml shows every key of the control board with its default") {
  Config shown = Config::from_text(yarp_section(), "arm.toml");
  Config defaults;
  read_yarp_params(shown);
  read_yarp_params(defaults);
  CHECK_NOTHROW(shown.reject_unknown());
  CHECK(shown.effective() == defaults.effective());
  std::istringstream settings(defaults.effective());
  int keys = 0;
  for (std::string line; std::getline(settings, line); ++keys) {
    CAPTURE(line);
    CHECK(shown.has(line.substr(0, line.find(' '))));
  }
  CHECK(keys == 13);
}

TEST_CASE("settings of the control board are read") {
  Config config = Config::from_text(
      "[arm.yarp]\nhost = \"icub-head\"\nport = 10001\npart = \"left_arm\"\njoints = [0, 3]\n"
      "start_within_deg = 0.5\n"
      "max_step_deg = 0.25\n",
      "test");
  const YarpParams params = read_yarp_params(config);
  CHECK(params.host == "icub-head");
  CHECK(params.port == 10001);
  CHECK(params.port_name("rpc:i") == "/icub/left_arm/rpc:i");
  CHECK(params.joints == std::vector<int>{0, 3});
  CHECK(params.start_within_deg == 0.5);
  CHECK(params.max_step_deg == 0.25);
}

TEST_CASE("impossible settings of the control board are refused by name") {
  for (const char* setting :
       {"port=0", "joints=[0.5]", "joints=[-1]", "joints=[64]", "silent_ms=39", "silent_ms=1001",
        "connect_timeout_ms=9", "answer_timeout_ms=9", "retry_ms=5001", "check_modes_ms=9",
        "start_within_deg=11", "max_step_deg=11", "host=5"}) {
    CAPTURE(setting);
    const std::string assignment = "arm.yarp." + std::string(setting);
    const std::string key = assignment.substr(0, assignment.find('='));
    Config config;
    config.override_with(assignment);
    CHECK_THROWS_WITH_AS(read_yarp_params(config), doctest::Contains(key.c_str()), ConfigError);
  }
}

}  // namespace puck
