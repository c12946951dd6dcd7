#include "tests/bench/live/live_system.h"

#include <algorithm>
#include <csignal>
#include <random>
#include <stdexcept>
#include <thread>

namespace puck {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr seconds kAnswer{10};

std::string private_url(const TwoMachines* machines) {
  std::random_device random;
  const int port = std::uniform_int_distribution(20'000, 60'000)(random);
  return "udpm://239.255.76.67:" + std::to_string(port) +
         (machines == nullptr ? "?ttl=0" : "?ttl=1") + "&recv_buf_size=4194304";
}

std::string end_of(const std::string& text) {
  constexpr std::size_t kEnd = 1000;
  return text.size() <= kEnd ? text : text.substr(text.size() - kEnd);
}

}  // namespace

LiveSystem::LiveSystem(const LiveSetup& setup, const std::vector<std::string>& tracker)
    : setup_(setup), url_(private_url(setup.machines)) {
  start("puck-logger", {"logger.path=" + (folder_ / "log.lcm").string()});
  start("puck-tracker", tracker);
  start("puck-bridge", {});
  start("puck-arm", {});
  await({"puck-logger", "puck-tracker", "puck-bridge", "puck-arm"});
}

void LiveSystem::start_camera(const std::vector<std::string>& settings) {
  start("puck-camera", settings);
  await({"puck-camera"});
}

LiveSystem::~LiveSystem() {
  listener_.reset();
  for (auto& [name, service] : services_) service->send(SIGTERM);
  // A service that does not end by itself is killed by its object's end.
  for (auto& [name, service] : services_) service->wait_for(seconds(2));
}

void LiveSystem::start(const std::string& name, const std::vector<std::string>& settings) {
  if (setup_.machines == nullptr || name != "puck-camera") return start_here(name, settings);
  setup_.machines->on_second([&] { start_here(name, settings); });
}

void LiveSystem::start_here(const std::string& name, const std::vector<std::string>& settings) {
  const std::string config = "config/" + name.substr(name.find('-') + 1) + ".toml";
  std::vector<std::string> command{
      (setup_.bin / name).string(), "--config", config, "--lcm-url", url_, "--log-level", "warn"};
  if (!setup_.key_file.empty()) {
    command.insert(command.end(), {"--set", "lcm.key_file=" + setup_.key_file});
  }
  for (const std::string& setting : settings) command.insert(command.end(), {"--set", setting});
  services_[name] = std::make_unique<ChildProcess>(
      command, ChildOptions{.folder = setup_.source, .errors = folder_ / name});
}

void LiveSystem::await(const std::vector<std::string>& names) {
  LiveListener& bus = listener();
  const bool all_speak = bus.until(
      [&] {
        check_alive();
        return std::all_of(names.begin(), names.end(),
                           [&](const std::string& name) { return bus.status(name) != nullptr; });
      },
      kAnswer);
  if (!all_speak) throw std::runtime_error("a service does not speak: " + names.front() + " …");
}

LiveListener& LiveSystem::listener() {
  if (!listener_) listener_.emplace(url_, setup_.key_file, setup_.stop);
  return *listener_;
}

void LiveSystem::check_alive() {
  for (auto& [name, service] : services_) {
    if (!service->is_running()) {
      throw std::runtime_error(name + " has ended: " + end_of(read_text(folder_ / name)));
    }
  }
}

CpuLoad LiveSystem::watch(milliseconds time) {
  stop_listening();
  const Watch watch = begin_watch();
  while (std::chrono::steady_clock::now() < watch.began + time) {
    if (setup_.stop.stop_requested()) throw Interrupted();
    check_alive();
    std::this_thread::sleep_for(milliseconds(50));
  }
  return end_watch(watch);
}

LiveSystem::Watch LiveSystem::begin_watch() {
  Watch watch{.began = std::chrono::steady_clock::now()};
  for (const auto& [name, service] : services_) watch.usage[name] = usage_of(service->pid());
  return watch;
}

CpuLoad LiveSystem::end_watch(const Watch& watch) {
  const std::chrono::duration<double> span = std::chrono::steady_clock::now() - watch.began;
  CpuLoad load;
  for (const auto& [name, before] : watch.usage) {
    const ProcessUsage now = usage_of(services_.at(name)->pid());
    load[name] = 100 * (now.cpu_s - before.cpu_s) / span.count();
    wake_ups_hz_[name] = static_cast<double>(now.wake_ups - before.wake_ups) / span.count();
  }
  return load;
}

void LiveSystem::stop_camera() {
  LiveListener& bus = listener();
  services_.at("puck-camera")->send(SIGTERM);
  const bool has_said_goodbye = bus.until(
      [&] {
        const service_status_t* status = bus.status("puck-camera");
        return status != nullptr && status->state == service_status_t::STATE_STOPPING &&
               bus.status("puck-tracker") != nullptr;
      },
      kAnswer);
  if (!has_said_goodbye)
    throw std::runtime_error("puck-camera does not say that it ends, or puck-tracker nothing");
  // The last messages may still be in a queue.
  std::int64_t received = -1;
  while (bus.counter("puck-tracker", "events_received") != received) {
    received = bus.counter("puck-tracker", "events_received");
    bus.listen(milliseconds(500));
  }
}

}  // namespace puck
