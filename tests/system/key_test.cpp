// A game with a key, and a machine on the network without it.
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/temporary_folder.h"
#include "tests/system/system_bench.h"

namespace puck {
namespace {

std::string make_key(const TemporaryFolder& folder) {
  const auto path = folder / "key";
  std::ofstream(path) << std::string(32, 'k');
  std::filesystem::permissions(path, std::filesystem::perms::owner_read);
  return path.string();
}

/// Stops the arm as an operator would; returns the exit code of --stop with this key.
int operator_stop(const std::string& url, const std::vector<std::string>& settings) {
  std::vector<std::string> command = service_command("puck-arm", url, settings);
  command.emplace_back("--stop");
  return run_program(command, {.folder = source_folder()}).exit_code;
}

}  // namespace

TEST_CASE("with a key the game continues, and a machine without it is ignored, even its stop") {
  const TemporaryFolder folder;
  const std::string url = new_lcm_url();
  const std::string key = make_key(folder);
  BusListener bus(url, key);
  std::vector<std::unique_ptr<ChildProcess>> services;
  for (const std::string& name : kServices) {
    std::vector<std::string> settings{"lcm.key_file=" + key};
    if (name == "puck-logger") settings.push_back("logger.path=" + (folder / "a.lcm").string());
    services.push_back(
        std::unique_ptr<ChildProcess>(new ChildProcess(start_service(name, url, settings))));
  }
  REQUIRE(bus.hears(kServices));
  REQUIRE(bus.until([&] {
    return bus.fresh_estimates() > 50 && bus.counter("puck-arm", "commands_accepted") > 5;
  }));

  CHECK(operator_stop(url, {}) != 0);
  CHECK(bus.until([&] { return bus.counter("puck-arm", "messages_unauthenticated") > 0; }));
  const std::int64_t accepted = bus.counter("puck-arm", "commands_accepted");
  CHECK(bus.until([&] { return bus.counter("puck-arm", "commands_accepted") > accepted + 5; }));

  CHECK(operator_stop(url, {"lcm.key_file=" + key}) == 0);
  for (auto& service : services) {
    CHECK(service->is_running());
    service->send(SIGTERM);
    CHECK(service->wait_for(std::chrono::seconds(10)) == 0);
  }
}

}  // namespace puck
