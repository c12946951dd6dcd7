// A service that starts before the network does, in a network namespace of its own.
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"
#include "tests/system/system_bench.h"

namespace puck {
namespace {

bool is_permitted() {
  if (run_program({"unshare", "-n", "true"}).exit_code == 0) return true;
  MESSAGE("skipped: network namespaces need more rights than this user has");
  return false;
}

// unshare becomes the service, so its process id is the service's.
ChildProcess start_without_network(const std::string& name, const std::string& url,
                                   const TemporaryFolder& folder) {
  std::vector<std::string> command = service_command(name, url);
  command.insert(command.begin(), {"unshare", "-n"});
  return ChildProcess(command, {.folder = source_folder(), .errors = folder / "errors"});
}

bool says(const TemporaryFolder& folder, const std::string& part) {
  return wait_until([&] { return read_text(folder / "errors").find(part) != std::string::npos; });
}

Finished run_beside(const ChildProcess& service, const std::vector<std::string>& arguments) {
  std::vector<std::string> command{"nsenter", "-t", std::to_string(service.pid()), "-n"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return run_program(command);
}

}  // namespace

TEST_CASE("a service without a route reports it, and starts when a route exists") {
  if (!is_permitted()) return;
  const TemporaryFolder folder;
  const std::string url = new_lcm_url();
  ChildProcess tracker = start_without_network("puck-tracker", url, folder);
  REQUIRE(says(folder, "waiting: "));
  INFO(read_text(folder / "errors"));
  CHECK(read_text(folder / "errors").find("route") != std::string::npos);
  CHECK(tracker.is_running());
  CHECK(run_beside(tracker, {program("puck-tracker"), "--lcm-url", url, "--check"}).exit_code == 1);

  REQUIRE(run_beside(tracker, {"ip", "link", "set", "lo", "up"}).exit_code == 0);
  REQUIRE(run_beside(tracker, {"ip", "route", "add", "224.0.0.0/4", "dev", "lo"}).exit_code == 0);
  CHECK(says(folder, "on the bus: "));
  CHECK(run_beside(tracker, {program("puck-tracker"), "--lcm-url", url, "--check"}).exit_code == 0);
  tracker.send(SIGTERM);
  CHECK(tracker.wait_for(std::chrono::seconds(10)) == 0);
}

TEST_CASE("a service that waits for a route can be stopped") {
  if (!is_permitted()) return;
  for (const char* name : {"puck-tracker", "puck-bridge", "puck-arm", "puck-camera"}) {
    CAPTURE(name);
    const TemporaryFolder folder;
    ChildProcess service = start_without_network(name, new_lcm_url(), folder);
    REQUIRE(says(folder, "waiting: "));
    service.send(SIGTERM);
    CHECK(service.wait_for(std::chrono::seconds(2)) == 0);
  }
}

}  // namespace puck
