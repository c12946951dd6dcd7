#include "tests/system/system_bench.h"

#include <algorithm>
#include <random>
#include <stdexcept>
#include <thread>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/support/status_counter.h"

namespace puck {
std::string program(const std::string& name) { return program_path(name); }

Finished call_tool(const std::string& name, const TemporaryFolder& folder,
                   const std::vector<std::string>& arguments) {
  std::vector<std::string> command{program(name)};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return run_program(command, {.folder = folder.path()});
}

void run_tool(const std::string& name, const TemporaryFolder& folder,
              const std::vector<std::string>& arguments) {
  CAPTURE(name);
  const Finished finished = call_tool(name, folder, arguments);
  INFO(finished.errors);
  REQUIRE(finished.exit_code == 0);
}

nlohmann::json evaluate_game(const TemporaryFolder& folder,
                             const std::vector<std::string>& options) {
  std::vector<std::string> arguments{"game.raw", "--truth", "game.truth.csv", "--json", "a.json"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  run_tool("puck-evaluate", folder, arguments);
  return nlohmann::json::parse(read_text(folder / "a.json"));
}

std::string new_lcm_url() {
  std::random_device random;
  // Below the ports that the kernel assigns.
  const int port = std::uniform_int_distribution(20000, 32000)(random);
  return "udpm://239.255.76.67:" + std::to_string(port) + "?ttl=0&recv_buf_size=4194304";
}

std::vector<std::string> service_command(const std::string& name, const std::string& url,
                                         const std::vector<std::string>& settings) {
  const std::string config = "config/" + name.substr(name.find('-') + 1) + ".toml";
  std::vector<std::string> command{program(name), "--config", config, "--lcm-url", url};
  for (const std::string& setting : settings) command.insert(command.end(), {"--set", setting});
  return command;
}

ChildProcess start_service(const std::string& name, const std::string& url,
                           const std::vector<std::string>& settings) {
  std::vector<std::string> command = service_command(name, url, settings);
  command.insert(command.end(), {"--log-level", "error"});
  return ChildProcess(command, {.folder = source_folder()});
}

int check_service_program(const std::string& name, const std::string& url) {
  return run_program({program(name), "--lcm-url", url, "--check"}, {.folder = source_folder()})
      .exit_code;
}

bool poll_until(const std::function<bool()>& condition, const std::function<void()>& step,
                std::chrono::milliseconds timeout) {
  const auto end = std::chrono::steady_clock::now() + timeout;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    step();
  }
  return true;
}

BusListener::BusListener(const std::string& url, const std::string& key_file)
    : bus_({.url = url, .key_file = key_file}) {
  bus_.subscribe<service_status_t>([this](const service_status_t& status, const Receipt&) {
    statuses_[status.service] = status;
  });
  bus_.subscribe<puck_estimate_t>([this](const puck_estimate_t& estimate, const Receipt& at) {
    const auto verdict = tracker_.hear(estimate.session, estimate.seq, at.monotonic_us);
    if (verdict == SinglePublisher::Verdict::kNewPublisher) newest_event_us_ = -1;
    if (verdict == SinglePublisher::Verdict::kOtherPublisher) return;
    if (estimate.sensor_us <= newest_event_us_) return;
    newest_event_us_ = estimate.sensor_us;
    ++fresh_estimates_;
  });
  std::stop_source give_up;
  const bool started =
      bus_.start(give_up.get_token(), [&](const std::string&) { give_up.request_stop(); });
  if (!started) throw std::runtime_error("no multicast route on this machine");
}

bool BusListener::until(const std::function<bool()>& condition, std::chrono::milliseconds timeout) {
  return poll_until(
      condition, [&] { bus_.handle(std::chrono::milliseconds(5)); }, timeout);
}

bool BusListener::hears(const std::vector<std::string>& services) {
  return until([&] {
    return std::all_of(services.begin(), services.end(),
                       [&](const std::string& name) { return statuses_.contains(name); });
  });
}

std::optional<service_status_t> BusListener::status(const std::string& service) const {
  const auto found = statuses_.find(service);
  if (found == statuses_.end()) return std::nullopt;
  return found->second;
}

std::int64_t BusListener::counter(const std::string& service, const std::string& name) const {
  const auto found = statuses_.find(service);
  if (found == statuses_.end()) return -1;
  return test::counter(found->second, name).value_or(-1);
}

}  // namespace puck
